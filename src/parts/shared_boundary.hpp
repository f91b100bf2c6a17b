// The boundary of a whole mesh, from the edges that its parts have left over, and everything that
// conditions say about this boundary: the same on every process, and of a size that does not grow
// with the cells.
#pragma once

#include "base/executor.hpp"
#include "basis/options.hpp"
#include "boundary/moving_boundary.hpp"
#include "boundary/periodic.hpp"
#include "boundary/slip.hpp"
#include "parts/part.hpp"

namespace harmorph {

// Sorts edges of several parts by their ends, and drops those that two parts share: edges[0 .. n-1]
// are left.
Status match_edges(Span<OpenEdge> edges, Offset& n, Fault& fault) noexcept;

// What is asked, beside curves and conditions: the same in all parts.
struct PartProblem {
    Method method;
    Demands demands;
    Executor executor;
};

// Points are counted from 0 in the order of their global numbers. Where a fault names points, they
// are global numbers.
struct SharedBoundary {
    Span<Curve> curves;          // set by the caller before run()
    Span<Condition> conditions;  // likewise
    Index n_points = 0;
    Span<OpenEdge> edges;  // sorted
    Span<Offset> number;   // [n_points]
    Span<Real> x, y;
    Topology topology;  // no cells; edges: those of the boundary; representative: of cuts and
                        // periodic pairs
    Boundary boundary;
    Span<PointKind> kinds;
    Span<Vec2> tangent;  // where there are slip lines
    SlipCurves slip_curves;
    Periodicity periodicity;  // translations alone
    Wall wall;
    WallWork wall_work;  // slot: number on the wall of each point, or none

    void lay_out(Arena& arena, Index n_edges, PartProblem const& problem, Index n_curves,
                 Index n_conditions) noexcept;
    Status run(Span<const OpenEdge> given, PartProblem const& problem, Fault& fault) noexcept;

    Points points() const noexcept { return {x.data(), y.data(), 1}; }
    Index find(Offset wanted) const noexcept;  // the point with this global number, or none
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
