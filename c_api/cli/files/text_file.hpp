// A file in memory, usually text, which is read line by line. Errors name the file and the line,
// and say what was expected.
#pragma once

#include "basics/text.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

class TextFile {
public:
    explicit TextFile(const std::string& path);  // maps or reads the whole file
    // The given text takes the place of the contents of the file.
    TextFile(const std::string& path, std::string text);
    // The text is the value of an option, which messages then name in place of a file.
    static TextFile of_option(const std::string& option, std::string text);

    const std::string& path() const { return path_; }
    const char* noun() const { return is_option_ ? "option" : "file"; }
    std::string_view text() const { return text_; }  // copies of a TextFile share the text
    std::string place(std::size_t offset) const;  // "FILE:LINE"; after binary parts "FILE: byte N"
    // Sets other names of offsets, for a text in memory that is not the text of the file.
    void name_places(std::function<std::string(std::size_t)> name) {
        name_of_place_ = std::move(name);
    }
    [[noreturn]] void fail(std::size_t offset, std::string_view message) const;

    // Readers report how far they have come; after each hundredth of the file the listener gets
    // the fraction, 0 to 1.
    void listen(std::function<void(double)> listener);
    void passed(std::size_t offset) const {
        if (offset >= next_mark_) report(offset);
    }

private:
    void report(std::size_t offset) const;

    std::string path_;
    bool is_option_ = false;
    std::shared_ptr<const void> memory_;  // of the text
    std::string_view text_;
    std::function<std::string(std::size_t)> name_of_place_;
    std::function<void(double)> listener_;
    mutable std::size_t next_mark_ = std::numeric_limits<std::size_t>::max();
};

// Reads the lines that are not empty without their comments. A line ends with LF, CR LF or CR.
class LineReader {
public:
    // If lines may have names in quotes (quoted_name.hpp), blanks and comments in them are parts of
    // the name; they begin at the beginning of a word or after a comma.
    LineReader(const TextFile& file, char comment, bool has_quotes = false);

    bool next();                                             // false: the end of the file
    std::string_view line() const { return line_; }          // trimmed
    const std::vector<std::string_view>& words();            // between blanks and tabs
    std::size_t offset() const { return offset(line_); }     // of the line in the file's text
    std::size_t offset(std::string_view part) const;         // of a part of the line
    std::size_t next_offset() const { return next_; }        // of the next line
    void jump(std::size_t offset) { next_ = offset; }        // next() goes on there
    [[noreturn]] void fail(std::string_view message) const;  // about this line
    // Fails with "the file needs WHAT here, but LINE follows".
    [[noreturn]] void expected(std::string_view what) const;
    [[noreturn]] void expected(std::string_view what, std::string_view found) const;

private:
    void end_at_comment(std::size_t begin);

    const TextFile& file_;
    char comment_;
    bool has_quotes_;
    std::size_t next_ = 0;
    std::string_view line_;
    std::vector<std::string_view> words_;
};

// CSV files as RFC 4180 defines them: a line for each record, with cells between commas. A cell in
// quotation marks may have commas, line ends and quotation marks, each of which is written twice.

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
