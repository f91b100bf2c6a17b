// The start mesh with which smooth bounds compare: a copy of the coordinates, and the edges of the
// first layer. tests/morph/test_layer_bounds.cpp covers this file.
#pragma once

#include "basis/basis.hpp"
#include "mesh/topology.hpp"
#include "morph/layer_bounds.hpp"

namespace harmorph {

struct MeshQuality {
    OrientedMesh cells;  // refers to the caller's mesh and to the basis
    Span<Real> xy;       // [2 * n_points] x of all points, then y
    Span<LayerEdge> edge;
    Index n_edges = 0;

    void lay_out(Arena& arena, Basis const& basis, Mesh const& mesh) noexcept;
    // The basis must be one of these cells.
    void find(Basis const& basis, OrientedMesh const& mesh, Points at) noexcept;

    Points start() const noexcept { return {xy.data(), xy.data() + cells.mesh.n_points, 1}; }
    Span<const LayerEdge> edges() const noexcept { return edge.first(n_edges); }

private:
    // Used by find() only.
    FirstLayer layer_;
    Span<FaceDistance::Face> wall_face_;
    Span<Index> representative_;
    Span<std::uint8_t> is_wall_;
};

}  // namespace harmorph
