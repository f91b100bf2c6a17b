// Sorting, and the sums that turn counts into places.
#include <fixtures/core.hpp>

#include "base/sort.hpp"

using namespace fixtures;

TEST_CASE("the heap sort sorts lists of all sizes, with equal keys, sorted, reversed and random") {
    std::mt19937 random(1);
    for (int n = 0; n < 200; ++n)
        for (int kind = 0; kind < 4; ++kind) {
            std::vector<int> items;
            for (int k = 0; k < n; ++k)
                items.push_back(kind == 0   ? k
                                : kind == 1 ? -k
                                            : int(random() % (kind == 2 ? 5 : 100000)));
            std::vector<int> expected = items;
            std::sort(expected.begin(), expected.end());
            harmorph::sort(span(items), [](int a, int b) { return a < b; });
            CHECK(items == expected);
        }
}

TEST_CASE("the insertion sort sorts and keeps the order of equal keys") {
    std::mt19937 random(2);
    for (int n = 0; n < 60; ++n)
        for (int kind = 0; kind < 4; ++kind) {
            std::vector<std::pair<int, int>> items;
            for (int k = 0; k < n; ++k)
                items.push_back({kind == 0   ? k
                                 : kind == 1 ? -k
                                             : int(random() % (kind == 2 ? 5 : 100000)),
                                 k});
            std::vector<std::pair<int, int>> expected = items;
            std::stable_sort(expected.begin(), expected.end(),
                             [](auto const& a, auto const& b) { return a.first < b.first; });
            harmorph::sort_by_insertion(
                span(items), [](auto const& a, auto const& b) { return a.first < b.first; });
            CHECK(items == expected);
        }
}

TEST_CASE("counts become starts, and starts that filling has advanced are rewound") {
    std::vector<harmorph::Index> starts = {3, 0, 2, 5, 0, 99};  // the last place is for the total
    starts.back() = 0;
    CHECK(harmorph::counts_to_starts(span(starts)) == 10);
    CHECK(starts == std::vector<harmorph::Index>{0, 3, 3, 5, 10, 10});
    std::vector<harmorph::Index> const expected = starts;
    harmorph::Index const counts[] = {3, 0, 2, 5, 0};
    for (std::size_t k = 0; k < 5; ++k) starts[k] += counts[k];
    harmorph::rewind_starts(span(starts));
    CHECK(starts == expected);
}
