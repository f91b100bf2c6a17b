// Output in blocks of text that threads make at the same time, and that are written in their order:
// the bytes do not depend on the number of threads.
#pragma once

#include "basics/text_out.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

namespace cli {

// make(block, text) appends the text of a block, from 0 to n_blocks - 1; it may throw.
void write_in_order(std::ostream& out, std::size_t n_blocks, std::int32_t threads,
                    const std::function<void(std::size_t block, std::string& text)>& make);

// Does the same for n rows, one after another: make(row, to), to a TextOut.
template <class Make>
void write_rows(std::ostream& out, std::size_t n, std::int32_t threads, const Make& make) {
    constexpr std::size_t rows_of_block = 4096;  // so that the text of a block stays in the cache
    write_in_order(out, (n + rows_of_block - 1) / rows_of_block, threads,
                   [&](std::size_t block, std::string& text) {
                       const std::size_t begin = block * rows_of_block,
                                         end =
                                             begin + rows_of_block < n ? begin + rows_of_block : n;
                       TextOut to(text);
                       for (std::size_t row = begin; row < end; ++row) make(row, to);
                   });
}

}  // namespace cli
