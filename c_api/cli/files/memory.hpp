// The memory that the program can still allocate, and memory for large arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cli {

// Returns the smallest, in bytes, of the memory that the system can give without swapping, the
// limit of the program's control group, and the rest of the limit of the address space (`ulimit
// -v`). Returns infinity on systems that report none of these.
double free_memory();

// Memory for arrays whose lengths are known before they are filled.

// Touches the pages of memory that has not been used yet, by several threads: the system clears
// each page at the first touch. Pages have 2 MiB where the system has such pages.
void touch_pages(void* memory, std::size_t bytes, std::int32_t threads);

template <class Value>
void reserve_by_threads(std::vector<Value>& values, std::size_t n, std::int32_t threads) {
    values.reserve(n);
    touch_pages(values.data() + values.size(), (values.capacity() - values.size()) * sizeof(Value),
                threads);
}

}  // namespace cli
