// Reads the numbers of a file one after another, in text with blanks, commas and ends of lines
// between them, or in binary. Every error names the line, or the byte, and what was expected there.
#pragma once

#include "files/text_file.hpp"
#include "files/threads.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

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

// Reads long tables of text by several threads. The text is divided at ends of lines. First all
// rows are counted, so that the number of each row is known; then the pieces are read at the same
// time, each row into its place of the table. A row that is not plain (a comment, an empty line, a
// rare notation, an error) ends the reading; the reader of the format then reads or refuses this
// row.

struct TableEnd {                      // of the rows that have been read
    std::int64_t rows = 0, items = 0;  // items: numbers that vary from row to row, such as corners
};

// Walks over the text of one row.
class PlainRow {
public:
    PlainRow(std::string_view text, std::size_t at)
        : begin_(text.data()), at_(begin_ + at), end_(begin_ + text.size()) {}

    std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
    void over_blanks() {
        while (at_ < end_ && (*at_ == ' ' || *at_ == '\t')) ++at_;
    }
    bool at_digit() const { return at_ < end_ && *at_ >= '0' && *at_ <= '9'; }
    // Reads digits up to a blank or the end of the line, and skips the blanks.
    bool whole(std::int32_t& value) {
        constexpr int max_digits = 9;  // every such number fits
        const char* const first = at_;
        std::int32_t read = 0;
        for (; at_digit() && at_ - first < max_digits; ++at_) read = 10 * read + (*at_ - '0');
        if (at_ == first || !ends_word()) return false;
        value = read;
        over_blanks();
        return true;
    }
    bool real(double& value);  // reads a finite number in the same way
    bool end_of_line() {       // LF, or CR LF
        if (at_ < end_ && *at_ == '\r') ++at_;
        if (at_ == end_ || *at_ != '\n') return false;
        ++at_;
        return true;
    }

private:
    bool ends_word() const {
        return at_ < end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\n' || *at_ == '\r');
    }

    const char *begin_, *at_, *end_;
};

// Appends rows to a table until the table has n rows, or the next row is not plain. Begins at `at`,
// which becomes the place of the next row. A table has
//     std::int64_t items(PlainRow row) const       the number of items of a row
//     void resize(TableEnd end)                    makes room for these numbers of rows and items
//     bool read(PlainRow& row, TableEnd& end)      stores a row at `end`, and advances `row` and
//                                                  `end`; false: the row is not plain
template <class Table>
void read_plain_rows(std::string_view text, std::size_t& at, std::int64_t n, std::int32_t threads,
                     Table& table, TableEnd& done) {
    constexpr std::size_t bytes_of_piece = 1 << 19, n_pieces = 16;
    struct Piece {
        std::size_t begin, end;
        TableEnd from, to;
    };
    const auto after_line = [text](std::size_t from) {
        const void* const found = from < text.size()
                                      ? std::memchr(text.data() + from, '\n', text.size() - from)
                                      : nullptr;
        return found ? static_cast<std::size_t>(static_cast<const char*>(found) - text.data()) + 1
                     : text.size();
    };
    for (bool all_plain = true; all_plain && done.rows < n && at < text.size();) {
        std::vector<Piece> pieces;
        for (std::size_t begin = at; begin < text.size() && pieces.size() < n_pieces;) {
            const std::size_t end =
                after_line(begin + std::min(bytes_of_piece, text.size() - begin) - 1);
            pieces.push_back({begin, end, {}, {}});
            begin = end;
        }
        run_tasks(pieces.size(), threads, [&](std::size_t k) {
            Piece& piece = pieces[k];
            for (std::size_t line = piece.begin; line < piece.end; line = after_line(line)) {
                ++piece.to.rows;
                piece.to.items += table.items(PlainRow(text, line));
            }
        });
        TableEnd end = done;
        for (Piece& piece : pieces) {
            piece.from = end;
            end.rows += piece.to.rows;
            end.items += piece.to.items;
            piece.to = end;
        }
        // Lines after the table were counted too, but room for them could exceed the capacity.
        table.resize({std::min(end.rows, n), end.items});
        run_tasks(pieces.size(), threads, [&](std::size_t k) {
            Piece& piece = pieces[k];
            PlainRow row(text, piece.begin);
            TableEnd read = piece.from;
            while (read.rows < std::min(piece.to.rows, n) && table.read(row, read))
                piece.begin = row.offset();
            piece.from = read;
        });
        for (std::size_t k = 0; k < pieces.size() && all_plain && done.rows < n; ++k) {
            done = pieces[k].from;
            at = pieces[k].begin;
            all_plain = done.rows == pieces[k].to.rows && done.items == pieces[k].to.items;
        }
    }
    table.resize(done);
}

}  // namespace cli
