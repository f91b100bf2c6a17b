// Starts the threads of --threads for the library, and selects the kernel. With one thread, only
// the main thread of the program runs.
#pragma once

#include <harmorph_pthreads.h>

#include <cstdint>

namespace cli {

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
