// Starts the threads of --threads for the library, and selects the kernel. With one thread, only
// the main thread of the program runs.
#pragma once

#include <harmorph_pthreads.h>

#include <cstddef>
#include <cstdint>
#include <functional>

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

}  // namespace cli
