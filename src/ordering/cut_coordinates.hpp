// The coordinates of the unknowns in each direction in which a dissection may cut, and how far
// their neighbours reach.
#pragma once

#include "base/executor.hpp"
#include "ordering/graph.hpp"

namespace harmorph {

// The coordinates: x, y, both diagonals, the number of the layer round the curves, and the steps in
// the graph from a first cut across the layers. Parts that these cut badly get one more: the level
// of a breadth-first search of the part.
inline constexpr Index directions = 6, direction_lanes = 8;
inline constexpr Index straight_directions = 4, layer_direction = 4, across_direction = 5,
                       level_direction = 6;
inline constexpr Index border_lane = 7;  // no direction: 1 next to a separator above, otherwise 0
constexpr Index prefetch_ahead = 16;  // unknowns: their coordinates are read in no order of memory

// Numbers of four directions: compilers split wider vectors on the plain architecture.
typedef float Four __attribute__((vector_size(16), aligned(4), may_alias));
typedef std::int32_t FourCounts __attribute__((vector_size(16)));
inline constexpr Index halves = direction_lanes / 4;

// By value: through references clang assumes that the vectors are aligned to 16 bytes.
inline Four four(const float* numbers, Index half) noexcept {
    return *reinterpret_cast<const Four*>(numbers + 4 * half);
}
inline void set_four(float* numbers, Index half, Four to) noexcept {
    *reinterpret_cast<Four*>(numbers + 4 * half) = to;
}

// Coordinates of an unknown, and the largest distance to a neighbour, rounded up: an unknown
// farther than that from a cut has no neighbour on the other side. Single precision suffices to
// choose cuts. One line of the caches.
struct CutPosition {
    float at[direction_lanes], reach[direction_lanes];
};

struct CutCoordinates {
    Span<CutPosition> of;  // [n]
    Span<Index> queue;     // [n] working space of searches
    Span<float> step;      // [n] working space of searches; no number below 0 is left between them
    Span<float>
        layer;  // [n] of each unknown, until keep_searches(), and the queue of the search for them
    Span<Index> layer_queue;

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // Separate: these arrays may share memory with what is not used before keep_searches().
    void lay_out_layers(Arena& arena, Index max_unknowns) noexcept;
    // Computes the straight coordinates.
    void place(Graph const& graph, Points points, Executor const& executor) const noexcept;
    // The searches for layers and across them may run at the same time, as they use different
    // arrays. Both need keep_searches(), which makes coordinates of what they have found.
    void find_layers(Graph const& graph) const noexcept;
    // Steps from a piece of a separator, positive on the side where is_ahead(unknown), negative on
    // the other: where the mesh runs round a body, the two meet on the far side of the body.
    template <class IsPiece, class IsAhead>
    void find_across(Graph const& graph, Index start, IsPiece is_piece,
                     IsAhead is_ahead) const noexcept;
    void keep_searches(Graph const& graph, Executor const& executor) const noexcept;
    // Levels of a part: steps from an unknown at one end of the part. Neighbours outside the part
    // are done and not reached again. by_level [part]: out, the part by increasing level. (After N.
    // E. Gibbs, W. G. Poole, P. K. Stockmeyer, SIAM J. Numer. Anal. 13 (1976) 236.)
    void find_levels(Graph const& graph, Span<const Index> part,
                     Span<Index> by_level) const noexcept;

private:
    void find_reach(Graph const& graph, Index u) const noexcept;
};

template <class IsPiece, class IsAhead>
void CutCoordinates::find_across(Graph const& graph, Index start, IsPiece is_piece,
                                 IsAhead is_ahead) const noexcept {
    Index filled = 0;
    auto const reach = [&](Index v, float steps) {
        if (step[v] != 0) return;
        step[v] = steps;
        queue[filled++] = v;
    };
    reach(start, 1);
    for (Index read = 0; read < filled; ++read) {
        for (Index const v : graph.of(queue[read])) {
            if (is_piece(v)) reach(v, 1);
        }
    }
    Index const piece = filled;
    for (Index read = 0; read < piece; ++read) {
        for (Index const v : graph.of(queue[read])) reach(v, is_ahead(v) ? 2 : -1);
    }
    for (Index read = 0; read < filled; ++read) {
        graph.expect(queue, read, filled);
        float const here = step[queue[read]], next = here + (here > 0 ? 1.0f : -1.0f);
        for (Index const v : graph.of(queue[read])) reach(v, next);
    }
}

}  // namespace harmorph
