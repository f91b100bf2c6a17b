// The boundary of a whole mesh, from the edges that its parts have left over, and all data that
// conditions give for this boundary. The result is the same on every process, and its size does not
// grow with the cells. tests/parts/test_shared_edges.cpp and tests/parts/test_parts.cpp cover this
// file.
#pragma once

#include "base/executor.hpp"
#include "basis/options.hpp"
#include "boundary/moving_boundary.hpp"
#include "boundary/periodic.hpp"
#include "boundary/slip.hpp"
#include "parts/part.hpp"

namespace harmorph {

// Sorts edges of several parts by their ends, and drops those that two parts share; edges[0 .. n-1]
// remain.
Status match_edges(Span<OpenEdge> edges, Offset& n, Fault& fault) noexcept;

// The options of the solution, beside curves and conditions; they are the same in all parts.
struct PartProblem {
    Method method;
    Demands demands;
    Executor executor;
    Real max_curve_distance = infinity;
};

// Points are counted from 0 in the order of their global numbers. Points that a fault names are
// global numbers.
struct SharedBoundary {
    Span<Curve> curves;          // The caller sets the curves before run().
    Span<Condition> conditions;  // The caller sets the conditions before run().
    Index n_points = 0;
    Span<OpenEdge> edges;  // The edges are sorted.
    Span<Offset> number;   // [n_points]
    Span<Real> x, y;
    // There are no cells, and no edges but the boundary's; `representative` joins the points of
    // cuts and periodic pairs.
    Topology topology;
    Boundary boundary;
    Span<PointKind> kinds;
    Span<Vec2> tangent;  // Empty without slip lines.
    SlipCurves slip_curves;
    Periodicity periodicity;  // Only translations are possible.
    Wall wall;
    WallWork wall_work;  // The array `slot` has the number on the wall of each point, or none.

    void lay_out(Arena& arena, Index n_edges, PartProblem const& problem, Index n_curves,
                 Index n_conditions) noexcept;
    Status run(Span<const OpenEdge> given, PartProblem const& problem, Fault& fault) noexcept;

    Points points() const noexcept { return {x.data(), y.data(), 1}; }
    // Returns the point with this global number, or none.
    Index find(Offset wanted) const noexcept;
    bool is_wall_face(Index face) const noexcept;
    Index count_wall_faces() const noexcept;

private:
    Mesh mesh() const noexcept;
    Status find_points(Fault& fault) noexcept;
    Status find_boundary(Fault& fault) noexcept;
    Status analyse(PartProblem const& problem, Fault& fault) noexcept;
    void take_edges(Fault& fault) noexcept;
};

}  // namespace harmorph
