// Edges where parts of a mesh end: what is matched, what is left over, and what is refused.
#include <doctest/doctest.h>

#include "private.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using Edges = std::vector<hm_private_edge>;

// Points of a square lattice of side 1000; their numbers tell where they are.
constexpr std::int64_t per_row = 1000;
hm_private_edge edge(std::int64_t begin, std::int64_t end) {
    auto const x = [](std::int64_t point) { return double(point % per_row); };
    auto const y = [](std::int64_t point) { return double(point / per_row); };
    return {begin, end, x(begin), y(begin), x(end), y(end), 0, 0};
}
hm_private_edge marked(std::int64_t begin, std::int64_t end, std::int32_t marker) {
    hm_private_edge out = edge(begin, end);
    out.marker = marker;
    out.marked = 1;
    return out;
}

struct Matched {
    hm_status status;
    Edges left;
    hm_error error{};
};
Matched match(Edges edges) {
    Matched out{};
    std::int64_t n = std::int64_t(edges.size());
    out.status = hm_private_match_edges(edges.data(), &n, &out.error);
    edges.resize(std::size_t(n));
    out.left = edges;
    return out;
}
bool same(hm_private_edge const& a, hm_private_edge const& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// Checks that edges of two triangles left and right of the edge 1-2, and others, are refused in any
// order.
void check_refused(Edges edges, const char* text, std::int32_t item) {
    std::mt19937 random(1);
    for (int shuffle = 0; shuffle < 5; ++shuffle) {
        Matched const found = match(edges);
        CHECK(found.status == HM_BAD_MESH);
        CHECK(std::string(found.error.text) == text);
        CHECK(found.error.item == item);
        std::shuffle(edges.begin(), edges.end(), random);
    }
}

}  // namespace

TEST_CASE("pairs of opposite edges vanish, and other edges stay in the order of their numbers") {
    Edges all = {edge(1, 2),      edge(2, 1), edge(7, 3),     edge(3, 7),
                 marked(2, 3, 5), edge(9, 2), marked(4, 2, 1)};
    std::mt19937 random(2);
    for (int shuffle = 0; shuffle < 20; ++shuffle) {
        Matched const found = match(all);
        REQUIRE(found.status == HM_OK);
        REQUIRE(found.left.size() == 3);
        CHECK(same(found.left[0], marked(2, 3, 5)));
        CHECK(same(found.left[1], marked(4, 2, 1)));
        CHECK(same(found.left[2], edge(9, 2)));
        std::shuffle(all.begin(), all.end(), random);
    }
}

TEST_CASE("edges that do not fit together are refused with the number of a point") {
    const char* const apart =
        "the point with global number 2 has different coordinates in two parts";
    hm_private_edge moved = edge(2, 1);
    moved.begin_x += 1;
    check_refused({edge(1, 2), moved}, apart, 2);
    moved = edge(2, 1);
    moved.begin_y += 1;
    check_refused({edge(1, 2), moved}, apart, 2);
    moved = edge(2, 1);
    moved.end_y += 1;
    check_refused({edge(1, 2), moved},
                  "the point with global number 1 has different coordinates in two parts", 1);
    check_refused(
        {edge(1, 2), edge(1, 2)},
        "cells of two parts overlap at the edge between the points with global numbers 1 and 2", 1);
    check_refused(
        {marked(1, 2, 5), marked(1, 2, 5)},
        "cells of two parts overlap at the edge between the points with global numbers 1 and 2", 1);
    const char* const both =
        "the edge between the points with global numbers 1 and 2 has a marker, but two parts have "
        "a cell at this edge";
    check_refused({marked(1, 2, 5), edge(2, 1)}, both, 1);
    check_refused({edge(1, 2), marked(2, 1, 5)}, both, 1);
    // Numbers that a 32-bit item cannot say.
    std::int64_t const large = std::int64_t{1} << 40;
    Matched const found = match({edge(large, 2), edge(large, 2)});
    CHECK(found.status == HM_BAD_MESH);
    CHECK(found.error.item == -1);
    // Three cells at one edge: two of them overlap, or the third one is beside a sound pair.
    check_refused(
        {edge(1, 2), edge(2, 1), edge(2, 1)},
        "the edge between the points with global numbers 1 and 2 belongs to more than two cells",
        1);
}
