// Work that tasks share out among themselves: each piece is done once, by threads as by tasks one
// after the other.
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>

#include "base/executor.hpp"

#include <harmorph_pthreads.h>

#include <algorithm>

using harmorph::Index;

namespace {

// Items of a heap: whoever takes one makes its two children ready. Returns how often each was
// taken.
std::vector<int> take_all(harmorph::Executor const& executor, Index workers) {
    constexpr Index n = 1024;
    harmorph::ReadyItems<n> ready;
    std::vector<int> taken(n, 0);
    ready.add(1);
    executor.for_each(workers, [&](Index) {
        for (Index item = ready.take(); item != harmorph::none; item = ready.take()) {
            ++taken[std::size_t(item)];
            if (2 * item >= n) continue;
            ready.add(2 * item);
            ready.add(2 * item + 1);
        }
    });
    CHECK(ready.take() == harmorph::none);
    return taken;
}

}  // namespace

TEST_CASE("every item that becomes ready is taken once") {
    std::vector<int> once(1024, 1);
    once[0] = 0;  // never added
    CHECK(take_all({}, 1) == once);
    fixtures::Backwards order;
    CHECK(take_all({fixtures::Backwards::run, &order, 3}, 3) == once);
    hm_pthreads pool;
    hm_executor const executor = hm_pthreads_start(&pool, 4);
    for (int again = 0; again < 50; ++again)
        CHECK(take_all({executor.run, executor.user, 4}, 4) == once);
    hm_pthreads_stop(&pool);
}

TEST_CASE("each number is given to one task") {
    std::vector<int> taken(5000, 0);
    harmorph::NextItem next;
    hm_pthreads pool;
    hm_executor const executor = hm_pthreads_start(&pool, 4);
    harmorph::Executor{executor.run, executor.user, 4}.for_each(4, [&](Index) {
        for (Index k = next.take(); k < 5000; k = next.take()) ++taken[std::size_t(k)];
    });
    hm_pthreads_stop(&pool);
    CHECK(taken == std::vector<int>(5000, 1));
}

TEST_CASE("the first item is found in ranges, whatever the order of the ranges") {
    fixtures::Backwards order;
    for (harmorph::Executor const& executor :
         {harmorph::Executor{}, {fixtures::Backwards::run, &order, 3}}) {
        for (Index const n : {0, 1, 5, 16, 1000}) {
            for (Index const first : {0, 1, 4, 15, 500, 999, 2000}) {
                Index const found =
                    harmorph::find_in_ranges(n, executor, [&](Index begin, Index end) {
                        for (Index k = begin; k < end; ++k) {
                            if (k == first || k > first + 3) return k;
                        }
                        return harmorph::none;
                    });
                CHECK(found == (first < n ? first : harmorph::none));
            }
        }
    }
    CHECK(order.calls > 0);
}

TEST_CASE("ranges cover all items once, and none is shorter than allowed") {
    fixtures::Backwards order;
    for (harmorph::Executor const& executor :
         {harmorph::Executor{}, {fixtures::Backwards::run, &order, 3}}) {
        for (Index const n : {0, 1, 99, 100, 101, 5000}) {
            constexpr Index min_items = 100;
            std::vector<int> visited(std::size_t(n), 0);
            executor.for_ranges(n, min_items, [&](Index begin, Index end) {
                CHECK(end - begin >= std::min(n, min_items));
                for (Index k = begin; k < end; ++k) ++visited[std::size_t(k)];
            });
            CHECK(visited == std::vector<int>(std::size_t(n), 1));
        }
    }
    CHECK(order.calls > 0);
}
