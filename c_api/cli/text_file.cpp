#include "text_file.hpp"

#include "failure.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace cli {

namespace {

constexpr std::string_view blanks = " \t\v\f\r\n";

std::string read_whole(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    std::string text;
    std::size_t filled = 0;
    while (file && !std::feof(file.get()) && !std::ferror(file.get())) {
        text.resize(std::max<std::size_t>(2 * filled, 1 << 16));
        filled += std::fread(&text[filled], 1, text.size() - filled, file.get());
    }
    if (!file || std::ferror(file.get())) {
        throw Failure(exit_file, path + ": cannot be read: " + std::strerror(errno));
    }
    text.resize(filled);
    return text;
}

} // namespace

TextFile::TextFile(const std::string& path) : path_(path), text_(read_whole(path)) {}

std::string TextFile::place(std::size_t offset) const {
    std::size_t line = 1;
    for (std::size_t i = 0; i < offset && i < text_.size(); ++i) {
        const bool lone_return = text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n');
        if (text_[i] == '\n' || lone_return) ++line;
    }
    return path_ + ":" + std::to_string(line);
}

void TextFile::fail(std::size_t offset, const std::string& message) const {
    throw Failure(exit_file, place(offset) + ": " + message);
}

LineReader::LineReader(const TextFile& file, char comment) : file_(file), comment_(comment) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (std::string_view(file.text()).substr(0, 3) == byte_order_mark) next_ = byte_order_mark.size();
}

std::string_view LineReader::take_line() {
    const std::string_view rest = std::string_view(file_.text()).substr(next_);
    const std::size_t length = std::min(rest.find_first_of("\r\n"), rest.size());
    const bool two_characters = rest.substr(length, 2) == "\r\n";
    next_ = std::min(next_ + length + (two_characters ? 2 : 1), file_.text().size());
    return rest.substr(0, length);
}

bool LineReader::next() {
    while (next_ < file_.text().size()) {
        const std::string_view whole = take_line();
        line_ = trimmed(whole.substr(0, whole.find(comment_)));
        if (!line_.empty()) return true;
    }
    line_ = std::string_view(file_.text()).substr(file_.text().size());
    return false;
}

const std::vector<std::string_view>& LineReader::words() {
    words_.clear();
    for (std::size_t begin = 0; begin < line_.size();) {
        const std::size_t end = std::min(line_.find_first_of(blanks, begin), line_.size());
        words_.push_back(line_.substr(begin, end - begin));
        begin = std::min(line_.find_first_not_of(blanks, end), line_.size());
    }
    return words_;
}

std::size_t LineReader::offset(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - file_.text().data());
}

void LineReader::fail(const std::string& message) const { file_.fail(offset(), message); }

void LineReader::expected(const std::string& what) const { expected(what, line_); }

void LineReader::expected(const std::string& what, std::string_view found) const {
    fail("expected " + what + ", found " + (found.empty() ? "the end of the file" : quoted(found)));
}

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(begin);
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 48;
    std::string result = "'";
    for (const char c : text.substr(0, longest)) result += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
    return result + (text.size() > longest ? "...'" : "'");
}

} // namespace cli
