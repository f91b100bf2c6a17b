// The symmetric matrix of the unknowns in the order of elimination, and its columns of known curve values.
#pragma once

#include "harmorph/fronts.hpp"
#include "harmorph/symmetric_rows.hpp"
#include "harmorph/wall.hpp"

namespace harmorph {

// Row i holds its entries in later columns; what stands below the diagonal is implied. A coupling is the entry of an
// unknown's row in the column of a wall point: it belongs to the right-hand side.
struct Matrix {
    Index n = 0;
    Span<Index> place;           // [n_points] position of an unknown; wall(k) for wall point k; none where F = 0
    Span<Real> diagonal;         // [n]
    Span<Offset> start;          // [n + 1]
    Span<Index> column;
    Span<Real> value;
    Span<Index> coupling_start;  // [wall points + 1]
    Span<Index> coupling_row;
    Span<Real> coupling_value;

    struct Sizes {
        Offset entries = 0;
        Index couplings = 0;
    };

    static constexpr Index wall(Index slot) noexcept { return -2 - slot; }  // its own inverse
    static constexpr bool is_wall(Index place) noexcept { return place <= -2; }

    static Sizes count(Graph const& graph) noexcept { return {graph.start[graph.n] / 2, graph.couplings}; }
    void lay_out(Arena& arena, Index n_points, Index unknowns, Index wall_points, Sizes const& sizes) noexcept;
    // The pattern. slot [n_points]: number on the wall, or none; position [n]: of each unknown.
    void build(Mesh const& mesh, Edges const& edges, Span<const Index> representative, Graph const& graph,
               Span<const Index> order, Span<const Index> position, Span<const Index> slot) noexcept;

    void clear() const noexcept;
    // A conductance between two points: + on both diagonals, - off them. Points that are not unknown have known values.
    void add(Index point, Index other, Real conductance) const noexcept;

    // The unknowns' part; faces [entries] receives which of its entries are mesh edges.
    SymmetricRows rows(Edges const& edges, Span<std::uint8_t> faces) const noexcept;
};

}  // namespace harmorph
