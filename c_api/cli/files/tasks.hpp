// Tasks of the program itself, by several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace cli {

using RangeTask = std::function<void(std::size_t begin, std::size_t end, std::size_t range)>;

// Runs task(0), ..., task(n - 1), which are begun in this order. If tasks throw exceptions, the
// exception of the first of these tasks is thrown when all tasks have ended.
void run_tasks(std::size_t n, std::int32_t threads, const std::function<void(std::size_t)>& task);

// Does the same for the numbers 0, ..., n - 1 in one range for each thread, some of which may be
// empty.
void run_ranges(std::size_t n, std::int32_t threads, const RangeTask& task);

}  // namespace cli
