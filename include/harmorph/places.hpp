// Where the unknowns are in each of the directions in which a dissection may cut, and how far their neighbours reach.
#pragma once

#include "harmorph/executor.hpp"
#include "harmorph/graph.hpp"

namespace harmorph {

// x, y, both diagonals, and the layer round the curves; then, for parts that these cut badly, a level of their own. Eight
// numbers, because vectors of numbers are; the last are not used.
inline constexpr Index directions = 5, direction_lanes = 8, layer_direction = 4, level_direction = 5;

// Numbers of four directions: wider vectors would be taken apart on the plain architecture.
typedef float Four __attribute__((vector_size(16), aligned(4), may_alias));
typedef std::int32_t FourCounts __attribute__((vector_size(16)));
inline constexpr Index halves = direction_lanes / 4;

// Never references to them: clang forgets then that they may begin at any number.
inline Four four(const float* numbers, Index half) noexcept { return *reinterpret_cast<const Four*>(numbers + 4 * half); }
inline void set_four(float* numbers, Index half, Four to) noexcept { *reinterpret_cast<Four*>(numbers + 4 * half) = to; }

// Single precision suffices to choose cuts.
struct Place {
    float at[direction_lanes];
};

// How far forwards and backwards an unknown's neighbours are, rounded outwards: farther from a cut than that, it has none
// across.
struct Reach {
    float ahead[direction_lanes], behind[direction_lanes];
};

struct Places {
    Span<Place> place;  // [n]
    Span<Reach> reach;  // [n]
    Span<Index> queue;  // [n] working space

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    void find(Graph const& graph, Points points, Executor const& executor) const noexcept;
    // Levels of a part: steps from an unknown at its end. Neighbours outside have had theirs. its_queue [part] is the part
    // by increasing level. (After N. E. Gibbs, W. G. Poole, P. K. Stockmeyer, SIAM J. Numer. Anal. 13 (1976) 236.)
    void find_levels(Graph const& graph, Span<const Index> part, Span<Index> its_queue) const noexcept;

private:
    void find_layers(Graph const& graph) const noexcept;
    Index spread(Graph const& graph, Index direction, Span<Index> its_queue, Index read, Index filled) const noexcept;
    void find_reach(Graph const& graph, Index u) const noexcept;
};

}  // namespace harmorph
