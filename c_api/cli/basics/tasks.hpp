// Tasks of the program itself, by several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace cli {

using RangeTask = std::function<void(std::size_t begin, std::size_t end, std::size_t range)>;

// Runs task(0), ..., task(n - 1), which are begun in this order. After all of them, throws what the
// first of the tasks that failed has thrown.
void run_tasks(std::size_t n, std::int32_t threads, const std::function<void(std::size_t)>& task);

// Does the same for the numbers 0, ..., n - 1 in one range for each thread, some of which may be
// empty.
void run_ranges(std::size_t n, std::int32_t threads, const RangeTask& task);

// Reserves memory for n values. The system clears each page at the first touch: here that is done
// by several threads.
template <class Value>
void reserve_by_threads(std::vector<Value>& values, std::size_t n, std::int32_t threads) {
    values.reserve(n);
    constexpr std::size_t page = 4096;
    const std::size_t pages = (values.capacity() - values.size()) * sizeof(Value) / page;
    auto* const storage = reinterpret_cast<volatile char*>(values.data() + values.size());
    run_ranges(pages, threads, [storage](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t k = begin; k < end; ++k) storage[k * page] = 0;
    });
}

}  // namespace cli
