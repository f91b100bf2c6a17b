// The caller's threads, if any. The core has none.
#pragma once

#include "base/kernel.hpp"
#include "base/scalar.hpp"

namespace harmorph {

struct Executor {
    void (*run)(void* user, std::int32_t n_tasks, void (*task)(void* context, std::int32_t index),
                void* context) = nullptr;
    void* user = nullptr;
    Index n_threads = 1;
    Kernel kernel = Kernel::automatic;  // of the processor, if the caller has found it out

    static constexpr Index most_threads = 256;

    bool is_serial() const noexcept { return run == nullptr || n_threads < 2; }

    // body(i) for i in 0 .. n-1, in any order and on any thread.
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

    // body(begin, end) for ranges that together are 0 .. n-1, of at least `least` items.
    template <class Body>
    void for_ranges(Index n, Index least, Body const& body) const noexcept {
        Index const most =
            is_serial() ? 1 : 4 * n_threads;  // several each, in case some are slower
        Index const ranges = clamp(n / least, Index{1}, most);
        auto const bound = [&](Index i) { return static_cast<Index>(Offset{n} * i / ranges); };
        for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1)); });
    }
};

}  // namespace harmorph
