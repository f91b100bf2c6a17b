// Reads the numbers of a file one after another, in text with blanks, commas and ends of lines
// between them, or in binary. Every error names the line, or the byte, and what was expected there.
#pragma once

#include "files/text_file.hpp"

#include <cstdint>

namespace cli {

class NumberReader {
public:
    explicit NumberReader(const TextFile& file) : file_(file), end_(file.text().size()) {}

    bool is_binary = false;  // whole() and real() read binary numbers
    bool swapped = false;    // binary numbers are not in the byte order of this machine

    std::int64_t whole(const char* what,
                       int bytes = 4);             // signed; bytes of a binary number: 1, 4 or 8
    double real(const char* what, int bytes = 8);  // finite; number_offset() is its place
    std::int64_t count(const char* what, int bytes = 4);  // between 0 and 2^31 - 1

    std::string_view word();       // the next word; empty at the end
    std::string_view next_line();  // the rest of this line, or the next line that is not empty;
                                   // without outer blanks
    void skip_bytes(std::size_t n, const char* what);
    bool at_end();  // only blanks follow (text), nothing follows (binary)

    std::size_t offset() const { return at_; }
    std::size_t number_offset() const { return number_; }
    void jump(std::size_t offset) { at_ = offset; }
    void stop_at(std::size_t offset) { end_ = offset; }  // reads as if the file ended there
    const TextFile& file() const { return file_; }
    [[noreturn]] void expected(
        std::string_view what) const;  // names the last number or word, or the end
    [[noreturn]] void fail(const std::string& message) const { file_.fail(number_, message); }

private:
    const char* take(std::size_t bytes, const char* what);

    const char* found_end() const;

    const TextFile& file_;
    std::size_t at_ = 0, number_ = 0, end_;
    std::string_view word_;
};

}  // namespace cli
