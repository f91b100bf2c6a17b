#include "files/threads.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <ostream>
#include <vector>

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

namespace {

class OrderedOutput {
public:
    OrderedOutput(std::ostream& out,
                  const std::function<void(std::size_t block, std::string& text)>& make)
        : out_(out), make_(make) {}

    // Makes a block, and writes the block when it is its turn. The next block to write is always
    // one that a thread works on, as blocks are begun in their order: so no thread waits for ever.
    void run(std::size_t block) {
        std::string text = free_text();
        try {
            make_(block, text);
        } catch (...) {
            write(block, {});
            throw;
        }
        write(block, std::move(text));
    }

private:
    std::string free_text() {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (free_.empty()) return {};
        std::string text = std::move(free_.back());
        free_.pop_back();
        return text;
    }

    void write(std::size_t block, std::string text) {
        std::unique_lock<std::mutex> lock(mutex_);
        turn_.wait(lock, [&] { return next_ == block; });
        lock.unlock();
        out_.write(text.data(), static_cast<std::streamsize>(text.size()));
        lock.lock();
        ++next_;
        text.clear();
        free_.push_back(std::move(text));
        turn_.notify_all();
    }

    std::ostream& out_;
    const std::function<void(std::size_t block, std::string& text)>& make_;
    std::mutex mutex_;
    std::condition_variable turn_;
    std::size_t next_ = 0;           // the block to write
    std::vector<std::string> free_;  // the memory of blocks that have been written
};

}  // namespace

void write_in_order(std::ostream& out, std::size_t n_blocks, std::int32_t threads,
                    const std::function<void(std::size_t block, std::string& text)>& make) {
    OrderedOutput output(out, make);
    run_tasks(n_blocks, threads, [&](std::size_t block) { output.run(block); });
}

}  // namespace cli
