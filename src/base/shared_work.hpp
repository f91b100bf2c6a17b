// Distributes items of work among the tasks of one Executor::for_each() at run time, because the
// time of each item is not known beforehand. Results must not depend on which task does an item.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// These operations are atomic. For a processor without atomic instructions, compilers would call a
// library, which the core does not have; there, one task does all the work.
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
class Turns {
public:
    template <class Body>
    void take(Body const& body) noexcept {
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

}  // namespace harmorph
