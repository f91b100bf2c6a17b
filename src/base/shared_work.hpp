// How the tasks of one Executor::for_each() share out work among themselves, where nobody knows
// beforehand how long each piece takes. What is done must not depend on who does it.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// Operations of which a processor with threads does each as a whole. For a processor that has no
// such instructions compilers would call a library, which the core does not have: there one task
// does all the work.
#if __GCC_ATOMIC_INT_LOCK_FREE == 2 && __GCC_ATOMIC_BOOL_LOCK_FREE == 2
constexpr Index sharing(Index tasks) noexcept { return tasks; }  // so many may share
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

// Numbers from 0 on, each given to one of the tasks that ask for the next one.
class NextItem {
public:
    Index take() noexcept { return count_up(next_); }

private:
    Index next_ = 0;
};

// Items 0 .. n-1 that become ready while others are worked on. A task that finds none ready may
// end: whoever adds items takes them itself, if nobody else does.
template <Index n>
class ReadyItems {
public:
    // What the caller wrote before is seen by the task that takes the item.
    void add(Index item) noexcept { raise_flag(is_ready_[item]); }
    // The first one that is ready, which is no longer ready then; none if no item is.
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
