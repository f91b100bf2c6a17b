#include "files/text_file.hpp"

#include "basics/failure.hpp"
#include "basics/text.hpp"
#include "files/mapped_file.hpp"

#include <algorithm>
#include <array>

namespace cli {

namespace {

// The kind of each byte for a reader of lines.
enum : unsigned char { part_of_word, blank, end_of_line };

constexpr auto kinds_of_bytes() {
    std::array<unsigned char, 256> kind_of_byte = {};
    for (const char c : {' ', '\t', '\v', '\f'})
        kind_of_byte[static_cast<unsigned char>(c)] = blank;
    for (const char c : {'\r', '\n'}) kind_of_byte[static_cast<unsigned char>(c)] = end_of_line;
    return kind_of_byte;
}
constexpr std::array<unsigned char, 256> kind_of_byte = kinds_of_bytes();
unsigned char kind(char c) { return kind_of_byte[static_cast<unsigned char>(c)]; }

// Returns the length of the word at the beginning of the text, which may have names in quotes.
std::size_t end_of_word(std::string_view text) {
    std::size_t at = 0;
    for (bool is_start = true; at < text.size() && kind(text[at]) == part_of_word;) {
        const std::size_t behind = is_start ? behind_quoted(text, at) : at;
        is_start = behind == at && text[at] == ',';
        at = behind == at ? at + 1 : behind;
    }
    return at;
}

}  // namespace

TextFile::TextFile(const std::string& path) : path_(path) {
    const auto file = std::make_shared<const MappedFile>(path);
    text_ = {file->data(), file->size()};
    memory_ = file;
}

TextFile::TextFile(const std::string& path, std::string text) : path_(path) {
    const auto own = std::make_shared<const std::string>(std::move(text));
    text_ = *own;
    memory_ = own;
}

TextFile TextFile::of_option(const std::string& option, std::string text) {
    TextFile file(option, std::move(text));
    file.is_option_ = true;
    return file;
}

std::string TextFile::place(std::size_t offset) const {
    if (name_of_place_) return path_ + ": " + name_of_place_(offset);
    if (is_option_) {  // lines of an option are named by what they say
        const std::size_t at = std::min(offset, text_.size());
        const std::size_t end = std::min(text_.find('\n', at), text_.size());
        const std::size_t before = at == 0 ? text_.npos : text_.rfind('\n', at - 1);
        const std::size_t begin = before == text_.npos ? 0 : before + 1;
        return path_ + " " + in_quotes(text_.substr(begin, end - begin));
    }
    std::size_t line = 1;
    for (std::size_t i = 0; i < offset && i < text_.size(); ++i) {
        const bool lone_return =
            text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n');
        if (text_[i] == '\n' || lone_return) ++line;
        if (text_[i] == '\0') return path_ + ": byte " + std::to_string(offset);
    }
    return path_ + ":" + std::to_string(line);
}

void TextFile::fail(std::size_t offset, std::string_view message) const {
    // A basis in the place of another file has no lines that a message could name.
    if (text_.substr(0, 8) == "harmorph" && text_.substr(0, 16).find('\0') != text_.npos)
        throw Failure(exit_file, path_ +
                                     ": the file is a basis, which `harmorph solve` writes; "
                                     "another file is expected in this place");
    throw Failure(is_option_ ? exit_usage : exit_file, (place(offset) + ": ").append(message));
}

void TextFile::listen(std::function<void(double)> listener) {
    listener_ = std::move(listener);
    next_mark_ = listener_ ? 0 : std::numeric_limits<std::size_t>::max();
}

void TextFile::report(std::size_t offset) const {
    next_mark_ = offset + text_.size() / 100 + 1;
    listener_(std::min(1.0, static_cast<double>(offset) / static_cast<double>(text_.size() + 1)));
}

LineReader::LineReader(const TextFile& file, char comment, bool has_quotes)
    : file_(file), comment_(comment), has_quotes_(has_quotes) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (file.text().substr(0, 3) == byte_order_mark) next_ = byte_order_mark.size();
}

// One pass over the bytes of a line finds the end of the line, the comment, and the first and the
// last byte that are not blank.
bool LineReader::next() {
    const char* const text = file_.text().data();
    const std::size_t size = file_.text().size();
    file_.passed(next_);
    while (next_ < size) {
        std::size_t at = next_;
        while (at < size && kind(text[at]) == blank) ++at;
        const std::size_t begin = at;
        if (has_quotes_) {
            end_at_comment(begin);
            if (!line_.empty()) return true;
            continue;
        }
        std::size_t end = at;  // behind the last byte that is not blank
        for (; at < size && kind(text[at]) != end_of_line && text[at] != comment_; ++at) {
            if (kind(text[at]) == part_of_word) end = at + 1;
        }
        while (at < size && kind(text[at]) != end_of_line) ++at;
        next_ = at + (at < size ? 1 : 0) +
                (at + 1 < size && text[at] == '\r' && text[at + 1] == '\n' ? 1 : 0);
        line_ = std::string_view(text + begin, end - begin);
        if (!line_.empty()) return true;
    }
    line_ = std::string_view(text + size, 0);
    return false;
}

// The same for lines with names in quotes.
void LineReader::end_at_comment(std::size_t begin) {
    const std::string_view text = file_.text();
    std::size_t at = begin;
    for (bool is_start = true; at < text.size();) {
        const std::size_t behind = is_start ? behind_quoted(text, at) : at;
        is_start = behind == at && (text[at] == ',' || kind(text[at]) == blank);
        if (behind == at && (kind(text[at]) == end_of_line || text[at] == comment_)) break;
        at = behind == at ? at + 1 : behind;
    }
    line_ = text.substr(begin, at - begin);
    line_ = line_.substr(0, trimmed(line_).size());
    while (at < text.size() && kind(text[at]) != end_of_line) ++at;
    const bool is_pair = text.substr(std::min(at, text.size()), 2) == "\r\n";
    next_ = std::min(at + (is_pair ? 2 : 1), text.size());
}

const std::vector<std::string_view>& LineReader::words() {
    words_.clear();
    for (const char *at = line_.data(), *const end = at + line_.size(); at != end;) {
        const char* const begin = at;
        if (has_quotes_) at += end_of_word({at, static_cast<std::size_t>(end - at)});
        while (at != end && kind(*at) == part_of_word) ++at;
        words_.emplace_back(begin, static_cast<std::size_t>(at - begin));
        while (at != end && kind(*at) != part_of_word) ++at;
    }
    return words_;
}

std::size_t LineReader::offset(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - file_.text().data());
}

void LineReader::fail(std::string_view message) const { file_.fail(offset(), message); }

void LineReader::expected(std::string_view what) const { expected(what, line_); }

void LineReader::expected(std::string_view what, std::string_view found) const {
    const std::string noun = file_.noun();
    fail("the " + noun + " needs " + std::string(what) + " here, but " +
         (found.empty() ? "the end of the " + noun : in_quotes(found)) + " follows");
}

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

}  // namespace

std::string csv_cell(std::string_view text) {
    const bool is_plain = !text.empty() && text.find_first_of(",\"\r\n") == text.npos &&
                          trimmed(text).size() == text.size() && text[0] != '#' &&
                          text.substr(0, byte_order_mark.size()) != byte_order_mark;
    if (is_plain) return std::string(text);
    std::string cell = "\"";
    for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
    return cell + '"';
}

CsvReader::CsvReader(const TextFile& file) : file_(file), text_(file.text()) {
    if (text_.substr(0, byte_order_mark.size()) == byte_order_mark) at_ = byte_order_mark.size();
}

bool CsvReader::next() {
    for (;; at_ = std::min(text_.find_first_of("\r\n", at_), text_.size())) {
        at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
        if (at_ == text_.size()) return false;
        if (text_[at_] != '#') break;
    }
    begin_ = at_;
    file_.passed(begin_);
    std::size_t n = 0;
    for (;;) {
        if (cells_.size() == n) cells_.emplace_back();
        std::string& cell = cells_[n++];
        at_ = std::min(text_.find_first_not_of(" \t", at_), text_.size());
        if (at_ < text_.size() && text_[at_] == '"') {
            read_quoted(cell);
        } else {
            const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
            cell = trimmed(text_.substr(at_, end - at_));
            at_ = end;
        }
        if (at_ == text_.size() || at_line_end()) break;
        ++at_;  // over the comma
    }
    cells_.resize(n);
    return true;
}

// Goes to the comma or line end after a cell in quotation marks.
void CsvReader::read_quoted(std::string& cell) {
    cell.clear();
    const std::size_t first = at_++;
    for (;; ++at_) {
        const std::size_t end = text_.find('"', at_);
        if (end == text_.npos)
            file_.fail(first, "this quotation mark is not closed before the end of the file");
        cell += text_.substr(at_, end - at_);
        at_ = end + 1;
        if (at_ == text_.size() || text_[at_] != '"') break;
        cell += '"';
    }
    at_ = std::min(text_.find_first_not_of(" \t", at_), text_.size());
    if (at_ < text_.size() && text_[at_] != ',' && !at_line_end())
        file_.fail(at_, "a comma or the end of the line must follow a cell in quotation marks");
}

}  // namespace cli
