// An executor runs tasks on the caller's threads, if the caller gives any; the core has no threads.
// Sums in parallel, work that free threads take, and the caller's progress callback follow below.
// tests/base/test_shared_work.cpp covers this file.
#pragma once

#include "base/scalar.hpp"
#include "base/types.hpp"

namespace harmorph {

struct Executor {
    void (*run)(void* user, std::int32_t n_tasks, void (*task)(void* context, std::int32_t index),
                void* context) = nullptr;
    void* user = nullptr;
    Index n_threads = 1;
    // The kernel for this processor, if the caller has found it out.
    Kernel kernel = Kernel::automatic;

    static constexpr Index max_threads = 256;

    bool is_serial() const noexcept { return run == nullptr || n_threads < 2; }

    // Calls body(i) for each i in 0 .. n-1, in any order and on any thread.
    template <class Body>
    void for_each(Index n, Body const& body) const noexcept {
        if (is_serial() || n < 2) {
            for (Index i = 0; i < n; ++i) body(i);
            return;
        }
        auto const task = [](void* context, std::int32_t index) {
            (*static_cast<const Body*>(context))(index);
        };
        run(user, n, task, const_cast<void*>(static_cast<const void*>(&body)));
    }

    // Calls body(begin, end) for ranges that together cover 0 .. n-1. Each range has at least
    // min_items items, unless n is smaller. Every thread gets several ranges, in case some threads
    // are slower than others.
    template <class Body>
    void for_ranges(Index n, Index min_items, Body const& body) const noexcept {
        Index const max_ranges = is_serial() ? 1 : 4 * n_threads;
        Index const ranges = clamp(n / min_items, Index{1}, max_ranges);
        auto const bound = [&](Index i) { return static_cast<Index>(Offset{n} * i / ranges); };
        for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1)); });
    }
};

// Computes sums and extremes over all cells. The cells are divided into a fixed number of ranges,
// so that the results do not depend on the number of threads.

// The items 0 .. n-1 are divided into this number of ranges; range_start() returns the first item
// of range i.
inline constexpr Index reduced_ranges = 16;
inline Index range_start(Index n, Index i) noexcept {
    return static_cast<Index>(Offset{n} * i / reduced_ranges);
}

// Calls add(begin, end, result) for ranges that together cover 0 .. n-1, and merges the results in
// the order of the ranges by result.merge(later).
template <class Result, class Add>
Result reduce_ranges(Index n, Executor const& executor, Add const& add) noexcept {
    Result results[reduced_ranges];
    executor.for_each(reduced_ranges, [&](Index range) {
        Result result;
        add(range_start(n, range), range_start(n, range + 1), result);
        results[range] = result;
    });
    for (Index range = 1; range < reduced_ranges; ++range) results[0].merge(results[range]);
    return results[0];
}

// Divides the items 0 .. n-1 into ranges, and returns the first item that find(begin, end) returns
// for any of them, or none.
template <class Find>
Index find_in_ranges(Index n, Executor const& executor, Find const& find) noexcept {
    struct First {
        Index item = none;
        void merge(First const& later) noexcept { item = item == none ? later.item : item; }
    };
    auto const add = [&](Index begin, Index end, First& first) { first.item = find(begin, end); };
    return reduce_ranges<First>(n, executor, add).item;
}

// Calls visit(cell, result) for all cells and returns the merged results.
template <class Result, class Visit>
Result reduce_cells(Index n_cells, Executor const& executor, Visit const& visit) noexcept {
    return reduce_ranges<Result>(n_cells, executor, [&](Index begin, Index end, Result& result) {
        for (Index cell = begin; cell < end; ++cell) visit(cell, result);
    });
}

// Distributes items of work among the tasks of one Executor::for_each() at run time, because the
// time of each item is not known beforehand. Results must not depend on which task does an item.

// The counters of shared work are atomic. For a processor without atomic instructions, compilers
// would call a library, which the core does not have; there, one task does all the work.
#if __GCC_ATOMIC_INT_LOCK_FREE == 2 && __GCC_ATOMIC_BOOL_LOCK_FREE == 2
// Returns how many of the tasks may share work.
constexpr Index sharing(Index tasks) noexcept { return tasks; }
inline Index count_up(Index& count) noexcept {
    return __atomic_fetch_add(&count, 1, __ATOMIC_RELAXED);
}
inline void raise_flag(bool& flag) noexcept { __atomic_store_n(&flag, true, __ATOMIC_RELEASE); }
inline bool take_flag(bool& flag) noexcept {
    return __atomic_load_n(&flag, __ATOMIC_RELAXED) &&
           __atomic_exchange_n(&flag, false, __ATOMIC_ACQUIRE);
}
#else
constexpr Index sharing(Index tasks) noexcept { return min(tasks, Index{1}); }
inline Index count_up(Index& count) noexcept { return count++; }
inline void raise_flag(bool& flag) noexcept { flag = true; }
inline bool take_flag(bool& flag) noexcept {
    bool const was_up = flag;
    flag = false;
    return was_up;
}
#endif

// Lets one task after the other run a few instructions. The order is any, so what these leave
// behind must not depend on it, as sums of integers or a minimum.
class Lock {
public:
    template <class Body>
    void run(Body const& body) noexcept {
        while (!take_flag(is_free_)) {}
        body();
        raise_flag(is_free_);
    }

private:
    bool is_free_ = true;
};

// Gives out the numbers 0, 1, 2, ...; each number goes to one task only.
class NextItem {
public:
    Index take() noexcept { return count_up(next_); }

private:
    Index next_ = 0;
};

// Keeps the items 0 .. n-1 that become ready while tasks work on other items. A task that finds no
// ready item may end, because the task that adds an item takes it later, if no other task does.
template <Index n>
class ReadyItems {
public:
    // The task that takes the item sees everything that the caller wrote before this call.
    void add(Index item) noexcept { raise_flag(is_ready_[item]); }
    // Returns the first ready item and marks it as not ready; returns none if no item is ready.
    Index take() noexcept {
        for (Index item = 0; item < n; ++item) {
            if (take_flag(is_ready_[item])) return item;
        }
        return none;
    }

private:
    bool is_ready_[n] = {};
};

// Calls the caller's progress callback, which is told how far the work is and may stop it.
enum class Phase : std::int32_t {
    structure = 0,
    ordering = 1,
    symbolic = 2,
    assembly = 3,
    factor = 4,
    solve = 5,
    residual = 6
};

struct Progress {
    std::int32_t (*call)(void* user, std::int32_t phase, double fraction) = nullptr;
    void* user = nullptr;

    Status report(Phase phase, Real fraction, Fault& fault) const noexcept {
        if (call == nullptr || call(user, static_cast<std::int32_t>(phase), fraction) == 0)
            return Status::ok;
        return fault.refuse(Status::cancelled, "the progress callback stopped the call");
    }
};

}  // namespace harmorph
