// An executor runs tasks on the caller's threads, if the caller gives any. The core has no threads.
// tests/base/test_shared_work.cpp covers this file.
#pragma once

#include "base/kernel.hpp"
#include "base/scalar.hpp"

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

}  // namespace harmorph
