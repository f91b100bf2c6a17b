// Starts the threads of --threads for the library, and selects the kernel. With one thread, only
// the main thread of the program runs.
#pragma once

#include "basics/text_out.hpp"

#include <harmorph_pthreads.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

namespace cli {

// Tasks of the program itself, by several threads.

using RangeTask = std::function<void(std::size_t begin, std::size_t end, std::size_t range)>;

// Runs task(0), ..., task(n - 1), which are begun in this order. If tasks throw exceptions, the
// exception of the first of these tasks is thrown when all tasks have ended.
void run_tasks(std::size_t n, std::int32_t threads, const std::function<void(std::size_t)>& task);

// Does the same for the numbers 0, ..., n - 1 in one range for each thread, some of which may be
// empty.
void run_ranges(std::size_t n, std::int32_t threads, const RangeTask& task);

class Threads {
public:
    explicit Threads(std::int32_t count, std::int32_t kernel = hm_best_kernel())
        : started_(count > 1) {
        executor_.struct_size = sizeof executor_;
        if (started_) executor_ = hm_pthreads_start(&pool_, count);
        executor_.kernel = kernel;
    }
    ~Threads() {
        if (started_) hm_pthreads_stop(&pool_);
    }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

    const hm_executor* executor() const { return &executor_; }

private:
    bool started_;
    hm_pthreads pool_;
    hm_executor executor_ = {};
};

// Output in blocks of text that threads make at the same time, and that are written in their order:
// the bytes do not depend on the number of threads.

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
