// Where the unknowns are in each of the directions in which a dissection may cut, and how far their neighbours reach.
#pragma once

#include "harmorph/base/executor.hpp"
#include "harmorph/ordering/graph.hpp"

namespace harmorph {

// x, y, both diagonals, the layer round the curves, and the steps from a first cut across them; then, for parts that these
// cut badly, a level of their own.
inline constexpr Index directions = 6, direction_lanes = 8;
inline constexpr Index straight_directions = 4, layer_direction = 4, across_direction = 5, level_direction = 6;
inline constexpr Index border_lane = 7;  // no direction: 1 next to a separator above, otherwise 0
constexpr Index places_ahead = 16;  // how many are asked for before they are needed: they lie anywhere

// Numbers of four directions: wider vectors would be taken apart on the plain architecture.
typedef float Four __attribute__((vector_size(16), aligned(4), may_alias));
typedef std::int32_t FourCounts __attribute__((vector_size(16)));
inline constexpr Index halves = direction_lanes / 4;

// Never references to them: clang forgets then that they may begin at any number.
inline Four four(const float* numbers, Index half) noexcept { return *reinterpret_cast<const Four*>(numbers + 4 * half); }
inline void set_four(float* numbers, Index half, Four to) noexcept { *reinterpret_cast<Four*>(numbers + 4 * half) = to; }

// Where an unknown is, and how far off its neighbours are, rounded outwards: farther from a cut than that, it has none
// across. Single precision suffices to choose cuts. One line of the caches.
struct Place {
    float at[direction_lanes], reach[direction_lanes];
};

struct Places {
    Span<Place> place;  // [n]
    Span<Index> queue;  // [n] working space of searches,
    Span<float> step;   // [n] and theirs, too: between them, nothing below 0

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // All but the steps across and the levels.
    void find(Graph const& graph, Points points, Executor const& executor) const noexcept;
    // Steps from a piece of a separator, positive on its side where is_ahead(unknown), negative on the other: where the mesh
    // runs round a body, the two meet at its back.
    template <class IsPiece, class IsAhead>
    void find_across(Graph const& graph, Index start, IsPiece is_piece, IsAhead is_ahead) const noexcept;
    // Levels of a part: steps from an unknown at its end. Neighbours outside have had theirs. its_queue [part] is the part
    // by increasing level. (After N. E. Gibbs, W. G. Poole, P. K. Stockmeyer, SIAM J. Numer. Anal. 13 (1976) 236.)
    void find_levels(Graph const& graph, Span<const Index> part, Span<Index> its_queue) const noexcept;

private:
    void find_layers(Graph const& graph) const noexcept;
    Index spread(Graph const& graph, Span<Index> its_queue, Index read, Index filled) const noexcept;
    void find_reach(Graph const& graph, Index u) const noexcept;
};

template <class IsPiece, class IsAhead>
void Places::find_across(Graph const& graph, Index start, IsPiece is_piece, IsAhead is_ahead) const noexcept {
    Index filled = 0;
    auto const reach = [&](Index v, float its) {
        if (step[v] != 0) return;
        step[v] = its;
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
        if (read + 16 < filled) __builtin_prefetch(&place[queue[read + 16]]);
        Index const u = queue[read];
        float const here = step[u], next = here + (here > 0 ? 1.0f : -1.0f);
        float farthest = 1;
        for (Index const v : graph.of(u)) {
            reach(v, next);
            farthest = larger(farthest, here < step[v] ? step[v] - here : here - step[v]);
        }
        place[u].at[across_direction] = here;
        place[u].reach[across_direction] = farthest;
    }
    fill(step.first(graph.n), 0.0f);
}

}  // namespace harmorph
