// CSV files as RFC 4180 defines them: a line for each record, with cells between commas. A cell in
// quotation marks may have commas, line ends and quotation marks, each of which is written twice.
#pragma once

#include "files/text_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Returns the text as a cell that CsvReader reads as the same text: in quotation marks if a comma,
// a quotation mark, a line end, a blank at an end or a # at the beginning needs them.
std::string csv_cell(std::string_view text);

// Reads the records of a file one after another. Empty lines, and lines that begin with #, are
// passed over. A line ends with LF, CR LF or CR.
class CsvReader {
public:
    explicit CsvReader(const TextFile& file);

    bool next();  // false: the end of the file
    // Without the blanks around a cell, except for those in quotation marks.
    const std::vector<std::string>& cells() const { return cells_; }
    std::size_t offset() const { return begin_; }  // of the record in the text of the file
    [[noreturn]] void fail(std::string_view message) const { file_.fail(begin_, message); }

private:
    void read_quoted(std::string& cell);
    bool at_line_end() const { return text_[at_] == '\n' || text_[at_] == '\r'; }

    const TextFile& file_;
    std::string_view text_;
    std::size_t at_ = 0, begin_ = 0;  // the place of reading; the record
    std::vector<std::string> cells_;
};

}  // namespace cli
