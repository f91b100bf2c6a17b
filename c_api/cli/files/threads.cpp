#include "files/threads.hpp"

#include <algorithm>
#include <exception>
#include <mutex>

namespace cli {

namespace {

struct Tasks {
    const std::function<void(std::size_t)>& task;
    std::mutex mutex;
    std::int32_t failed = INT32_MAX;  // the first task that failed
    std::exception_ptr failure;

    void run(std::int32_t number) {
        try {
            task(static_cast<std::size_t>(number));
        } catch (...) {
            const std::lock_guard<std::mutex> lock(mutex);
            if (number > failed) return;
            failed = number;
            failure = std::current_exception();
        }
    }
};

}  // namespace

void run_tasks(std::size_t n, std::int32_t threads, const std::function<void(std::size_t)>& task) {
    const auto used = static_cast<std::int32_t>(
        std::min(n, static_cast<std::size_t>(std::max(threads, std::int32_t{1}))));
    if (used <= 1) {
        for (std::size_t number = 0; number < n; ++number) task(number);
        return;
    }
    Tasks tasks = {task, {}, INT32_MAX, nullptr};
    {
        const Threads pool(used);
        const hm_executor& executor = *pool.executor();
        executor.run(
            executor.user, static_cast<std::int32_t>(n),
            [](void* context, std::int32_t number) { static_cast<Tasks*>(context)->run(number); },
            &tasks);
    }
    if (tasks.failure) std::rethrow_exception(tasks.failure);
}

void run_ranges(std::size_t n, std::int32_t threads, const RangeTask& task) {
    const auto ranges = static_cast<std::size_t>(std::max(threads, std::int32_t{1}));
    const std::size_t length = n / ranges + 1;
    run_tasks(ranges, threads, [&](std::size_t range) {
        task(std::min(range * length, n), std::min((range + 1) * length, n), range);
    });
}

}  // namespace cli
