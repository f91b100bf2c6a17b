// Finds the points that move: points on curves, whose parameters the caller gives or projection
// along the boundary finds; points on rigid bodies; and points whose displacements are given in
// each call.
#pragma once

#include "boundary/conditions.hpp"
#include "bspline/projection.hpp"

namespace harmorph {

// Where a point is on what moves it.
struct WallPlace {
    // The number of the curve. Numbers after the last curve are rigid bodies; the number after the
    // last body stands for given displacements.
    Index curve = 0;
    Real u = 0;  // the parameter on a curve
    // On a rigid body, the vector from the centre of the body; on a curve with offset correction,
    // the vector from the curve; otherwise 0.
    Vec2 offset;
};

// A point that a second condition would move by other functions than the first condition, such as
// the trailing edge between two curves that do not share their end control point.
struct SharedPoint {
    Index slot = 0;
    Index condition[2] = {none, none};  // the one that moves the point, and the other one
    WallPlace place;                    // by the other condition
};

struct Wall {
    Index count = 0;
    Span<Index> point;  // [count] mesh points in the order of the boundary loops
    Span<Index> curve;  // [count] see WallPlace
    Span<Real> u;
    Span<Vec2> offset;
    Index n_shared = 0;
    Span<SharedPoint> shared;  // [n_shared] in the order of their slots

    WallPlace place(Index slot) const noexcept { return {curve[slot], u[slot], offset[slot]}; }
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
};

// Returns the offset e of a point from its curve, if the offset can rotate with the curve;
// otherwise 0: at corners, which have no single direction, and where e N_i' / C' would be larger
// than the functions N_i, as it is if C' is nearly 0.
Vec2 offset_from(Curve const& curve, Real u, Vec2 point) noexcept;

// The working space of parametrise().
struct WallWork {
    Span<Index> slot;         // [n_points] the number of the point on the wall, or none
    Span<Index> chain_point;  // the points of all chains of one condition, in order
    Span<Index> chain_start;  // where each chain begins in chain_point
    Span<std::uint8_t> is_loop;
    Span<std::uint8_t> is_break;  // whether a curve begins or ends at this entry of chain_point
    Span<Vec2> position;          // the points of one segment between breaks
    Span<Real> u, best_u;
    ChainWork projection;

    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
};

struct GivenParameters {
    Index index_base = 0;  // the number of the first mesh point
    Span<const Index> point, curve;
    Span<const Real> u;
};

// Finds the curve and the parameter of each point whose marker is on curves, the points of rigid
// bodies, and the points with given displacements; wall.shared has all other places of these points
// until find_shared() is called. Curves meet, begin and end at break points of
// the boundary, which are the points nearest to the ends of curves that are not periodic. Each
// segment between breaks belongs to the nearest curve. max_distance: see check_distances().
Status parametrise(Topology const& topology, Boundary const& boundary,
                   Span<const Condition> conditions, Span<const Curve> curves,
                   GivenParameters const& given, Real max_distance, WallWork const& work,
                   Wall& wall, Fault& fault) noexcept;

// Computes wall.offset of all points.
void find_offsets(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                  bool offset_correction, Wall& wall) noexcept;

// Keeps the shared points that their two conditions move differently, and finds these conditions.
// Warns of the first one (Status::torn), unless there is another warning already. slot_of_point
// [n_points] is that of WallWork. find_offsets() must have been called.
void find_shared(Boundary const& boundary, Span<const Condition> conditions,
                 Span<const Curve> curves, Span<const Index> slot_of_point, Wall& wall,
                 Fault& fault) noexcept;

// Returns a fingerprint of the kinds of all points and of the wall, on which the matrix and the
// right-hand sides depend.
std::uint64_t fingerprint_of(Span<const PointKind> kinds, Wall const& wall) noexcept;

}  // namespace harmorph
