// Smooth lower bounds of the smallest quality and of the smallest relative corner area of all
// cells, with derivatives by the points. harmorph_quality.h states the values.
// tests/morph/test_cell_bounds.cpp covers this file.
#pragma once

#include "base/elementary.hpp"
#include "base/executor.hpp"
#include "basis/basis.hpp"
#include "boundary/first_layer.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Smooth bounds of the change of heights and angles of the first layer at the walls, with
// derivatives by the points. harmorph_quality.h states the values.

// An edge of the first layer, from a wall point to the point above, and the neighbours of the wall
// point along the wall, or none.
struct LayerEdge {
    Index foot, top, previous, next;
};

enum class LayerValue : std::int32_t { height, stretch, angle };

// Returns the bound of the values of all edges, and adds the derivatives of this bound to the
// gradient, if it is given. The values of `stretch` are minus the ratios of heights.
SmoothMinimum find_layer_bound(Span<const LayerEdge> edges, LayerValue which, Real sharpness,
                               Points at, Points start, MutablePoints gradient) noexcept;

// A bound that is computed if its sharpness is not 0. The gradient, if its points are given, must
// be 0 before; it receives the derivatives of the bound.
struct CellBound {
    Real sharpness = 0;
    MutablePoints gradient;
    SmoothMinimum found;
};

struct CellBoundPair {
    CellBound quality, area;
    bool kept = false;  // the quality is divided by the skew quality of the start
};

// Computes both bounds at the coordinates `at`, which must be finite; no cell may be inverted at
// `start`. The bits do not depend on the executor.
void find_cell_bounds(OrientedMesh const& cells, Points at, Points start, Executor const& executor,
                      CellBoundPair& bounds) noexcept;

// The start mesh with which smooth bounds compare: a copy of the coordinates, and the edges of the
// first layer.
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
