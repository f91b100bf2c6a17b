// How the cells of a mesh are connected: the orientation of each, which points are joined, and the
// edges between cells.
#pragma once

#include "mesh/edges.hpp"

namespace harmorph {

// The caller's cells, whichever way they run, read counter-clockwise.
struct OrientedMesh {
    Mesh mesh;
    Span<std::uint8_t> reversed;  // [cells and guards] 1: the cell's points are in clockwise order;
                                  // empty: of no cell

    Cell cell(Index i) const noexcept {
        Cell out = mesh.cell(i);
        if (!reversed.empty() && reversed[i] != 0) out.reverse();
        return out;
    }
};

// Made by Analysis::run() in this order: points that a cut joins have one representative, edges are
// those between representatives, cells are oriented by their common edges. Periodic pairs are
// joined last: their points have one representative then, but each side keeps separate edges.
// Nothing here depends on coordinates; `mesh` still points to those the mesh was analysed with.
struct Topology : OrientedMesh {
    Edges edges;
    Span<Index> representative;  // [n_points] of points that are joined: the smallest

    void lay_out(Arena& arena, Mesh const& counts) noexcept {
        arena.take(reversed, counts.n_checked());
        edges.lay_out(arena, counts);
        arena.take(representative, counts.n_points);
    }
};

}  // namespace harmorph
