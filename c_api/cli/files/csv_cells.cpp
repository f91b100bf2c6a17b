#include "files/csv_cells.hpp"

#include <algorithm>

namespace cli {

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
