// How the tasks of one Executor::for_each() share out work among themselves, where nobody knows beforehand how long each
// piece takes. What is done must not depend on who does it.
#pragma once

#include "harmorph/base/types.hpp"

namespace harmorph {

// Numbers from 0 on, each given to one of the tasks that ask for the next one.
class NextItem {
public:
    Index take() noexcept { return __atomic_fetch_add(&next_, 1, __ATOMIC_RELAXED); }

private:
    Index next_ = 0;
};

// Items 0 .. n-1 that become ready while others are worked on. A task that finds none ready may end: whoever adds
// items takes them itself, if nobody else does.
template <Index n>
class ReadyItems {
public:
    // What the caller wrote before is seen by the task that takes the item.
    void add(Index item) noexcept { __atomic_store_n(&is_ready_[item], true, __ATOMIC_RELEASE); }
    // The first one that is ready, which is no longer ready then; none if no item is.
    Index take() noexcept {
        for (Index item = 0; item < n; ++item) {
            if (!__atomic_load_n(&is_ready_[item], __ATOMIC_RELAXED)) continue;
            if (__atomic_exchange_n(&is_ready_[item], false, __ATOMIC_ACQUIRE)) return item;
        }
        return none;
    }

private:
    bool is_ready_[n] = {};
};

}  // namespace harmorph
