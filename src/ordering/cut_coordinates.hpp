// The coordinates of the unknowns in each direction in which a dissection may cut, and the
// distances to their neighbours.
#pragma once

#include "base/executor.hpp"
#include "ordering/graph.hpp"

namespace harmorph {

// The coordinates are x, y, both diagonals, the number of the layer round the curves, and the
// number of steps in the graph from a first cut across the layers. Regions that these cut badly get
// one more: the level of a breadth-first search of the region.
inline constexpr Index directions = 6, direction_lanes = 8;
inline constexpr Index straight_directions = 4, layer_direction = 4, across_direction = 5,
                       level_direction = 6;
// The lane of the border is no direction: 1 next to a separator above, and 0 elsewhere.
inline constexpr Index border_lane = 7;
// Coordinates of unknowns are read in an irregular order, so those of the unknown that follows at
// this distance are prefetched.
constexpr Index prefetch_ahead = 16;

// The numbers of four directions. Compilers split wider vectors on the architecture without
// extensions.
using Four [[gnu::vector_size(16), gnu::aligned(4), gnu::may_alias]] = float;
using FourCounts [[gnu::vector_size(16)]] = std::int32_t;
inline constexpr Index halves = direction_lanes / 4;

// Vectors are passed by value, because clang assumes for references that they are aligned to 16
// bytes.
inline Four four(const float* numbers, Index half) noexcept {
    return *reinterpret_cast<const Four*>(numbers + 4 * half);
}
inline void set_four(float* numbers, Index half, Four to) noexcept {
    *reinterpret_cast<Four*>(numbers + 4 * half) = to;
}

// The coordinates of an unknown, and the largest distance to a neighbour in each direction, rounded
// up. An unknown that is farther than that from a cut has no neighbour on the other side. Single
// precision suffices to choose cuts. The struct fills one cache line.
struct CutPosition {
    float at[direction_lanes], reach[direction_lanes];
};

struct CutCoordinates {
    Span<CutPosition> position;  // [n]
    Span<Index> queue;           // [n] This array is working space of searches.
    Span<float> step;            // [n] Working space of searches, which leave no number below 0.
    // [n] The layer of each unknown until keep_searches(), and the queue of the search for layers.
    Span<float> layer;
    Span<Index> layer_queue;

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // The layers are laid out apart, as they may share memory with arrays that are not used
    // before keep_searches().
    void lay_out_layers(Arena& arena, Index max_unknowns) noexcept;
    // Computes the straight coordinates.
    void place(Graph const& graph, Points points, Executor const& executor) const noexcept;
    // The searches for layers and across layers may run at the same time, as they use different
    // arrays. keep_searches() converts the results of both into coordinates.
    void find_layers(Graph const& graph) const noexcept;
    // Counts steps from a connected run of a separator, positive on the side where
    // is_ahead(unknown) is true, and negative on the other. If the mesh surrounds a body, the two
    // sides meet on the far side of the body.
    template <class IsOnRun, class IsAhead>
    void find_across(Graph const& graph, Index start, IsOnRun is_on_run,
                     IsAhead is_ahead) const noexcept;
    void keep_searches(Graph const& graph, Executor const& executor) const noexcept;
    // Finds the levels of a region: the steps from an unknown at one end of the region. Neighbours
    // outside the region count as reached already. by_level [region] receives the region in the
    // order of increasing levels. (After N. E. Gibbs, W. G. Poole, P. K. Stockmeyer, SIAM J. Numer.
    // Anal. 13 (1976) 236.)
    void find_levels(Graph const& graph, Span<const Index> region,
                     Span<Index> by_level) const noexcept;

private:
    void find_reach(Graph const& graph, Index u) const noexcept;
};

template <class IsOnRun, class IsAhead>
void CutCoordinates::find_across(Graph const& graph, Index start, IsOnRun is_on_run,
                                 IsAhead is_ahead) const noexcept {
    Index filled = 0;
    auto const reach = [&](Index v, float steps) {
        if (step[v] != 0) return;
        step[v] = steps;
        queue[filled++] = v;
    };
    reach(start, 1);
    for (Index read = 0; read < filled; ++read) {
        for (Index const v : graph.neighbours(queue[read])) {
            if (is_on_run(v)) reach(v, 1);
        }
    }
    Index const run = filled;
    for (Index read = 0; read < run; ++read) {
        for (Index const v : graph.neighbours(queue[read])) reach(v, is_ahead(v) ? 2 : -1);
    }
    for (Index read = 0; read < filled; ++read) {
        graph.prefetch_neighbours(queue, read, filled);
        float const here = step[queue[read]], next = here + (here > 0 ? 1.0f : -1.0f);
        for (Index const v : graph.neighbours(queue[read])) reach(v, next);
    }
}

}  // namespace harmorph
