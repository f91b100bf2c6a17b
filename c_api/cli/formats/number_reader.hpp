// Numbers that stand one after another in a file, in text with blanks and ends of lines between
// them, or in binary. Every error names the line, or the byte, and what was expected there.
#pragma once

#include "basics/text_file.hpp"

#include <cstdint>

namespace cli {

class NumberReader {
public:
    explicit NumberReader(const TextFile& file) : file_(file), end_(file.text().size()) {}

    bool is_binary = false;  // what whole() and real() read
    bool swapped = false;    // binary: not in this machine's byte order

    std::int64_t whole(const char* what, int bytes = 4);  // signed; bytes: in binary, 1, 4 or 8
    double real(const char* what, int bytes = 8);         // finite; number_offset() tells where
    std::int64_t count(const char* what, int bytes = 4);  // not negative, at most 2^31 - 1

    std::string_view word();  // the next, empty at the end
    std::string_view
    next_line();  // the next that is not empty, trimmed; what is left of the present one counts
    void skip_bytes(std::size_t n, const char* what);
    bool at_end();  // nothing but blanks follows (text), nothing (binary)

    std::size_t offset() const { return at_; }
    std::size_t number_offset() const { return number_; }
    void jump(std::size_t offset) { at_ = offset; }
    void stop_at(std::size_t offset) {
        end_ = offset;
    }  // nothing from there on is read: as if the file ended there
    const TextFile& file() const { return file_; }
    [[noreturn]] void expected(
        std::string_view what) const;  // at the last number or word, or at the end
    [[noreturn]] void fail(const std::string& message) const { file_.fail(number_, message); }

private:
    const char* take(std::size_t bytes, const char* what);

    const char* found_end() const;

    const TextFile& file_;
    std::size_t at_ = 0, number_ = 0, end_;
    std::string_view word_;
};

}  // namespace cli
