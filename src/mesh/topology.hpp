// Describes how the cells of a mesh are connected: the orientation of each cell, the points that
// are joined, and the edges between cells. tests/mesh/test_orientation.cpp covers this file.
#pragma once

#include "mesh/edges.hpp"

namespace harmorph {

// Gives all cells of the caller in counter-clockwise order.
struct OrientedMesh {
    Mesh mesh;
    // [cells and guards] 1 if the cell's points are in clockwise order; the array is empty if no
    // cell is clockwise.
    Span<std::uint8_t> reversed;

    Cell cell(Index i) const noexcept {
        Cell out = mesh.cell(i);
        if (!reversed.empty() && reversed[i] != 0) out.reverse();
        return out;
    }
};

// Analysis::run() builds the topology in this order: points that a cut joins get one
// representative, the edges between representatives are found, and cells are oriented by their
// common edges. The points of periodic pairs are joined last, so that both sides of a pair keep
// separate edges. The topology does not depend on coordinates; `mesh` still points to the
// coordinates with which the mesh was analysed.
struct Topology : OrientedMesh {
    Edges edges;
    Span<Index> representative;  // [n_points] the smallest of the points to which a point is joined

    void lay_out(Arena& arena, Mesh const& counts) noexcept {
        arena.take(reversed, counts.n_checked());
        edges.lay_out(arena, counts);
        arena.take(representative, counts.n_points);
    }
};

}  // namespace harmorph
