// The points that are moved: on curves, with parameters given by the caller or found by projection
// along the boundary; on rigid bodies; and those whose displacements are given from call to call.
#pragma once

#include "boundary/conditions.hpp"
#include "bspline/projection.hpp"

namespace harmorph {

struct Wall {
    Index count = 0;
    Span<Index> point;  // [count] mesh points in the order in which the boundary loops pass them
    Span<Index> curve;  // number of the curve; behind the last curve, that of the rigid body;
                        // behind these: given
    Span<Real> u;       // on a curve
    Span<Vec2> offset;  // on a rigid body: from its centre; on a curve with offset correction: from
                        // the curve; else 0

    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
};

// How far a point is off its curve, e, where that is to turn with the curve. 0 at corners, where it
// is not known what turns, and where e N_i' / C' would outgrow the functions N_i themselves, as it
// does where C' vanishes.
Vec2 offset_from(Curve const& curve, Real u, Vec2 point) noexcept;

// Working arrays of parametrise().
struct WallWork {
    Span<Index> slot;         // [n_points] number of the point on the wall, or none
    Span<Index> chain;        // points of one condition's pieces of the boundary, in order
    Span<Index> piece_start;  // pieces of `chain`
    Span<std::uint8_t> is_loop;
    Span<std::uint8_t> is_break;  // a curve begins or ends at this point of `chain`
    Span<Vec2> position;          // of one segment between breaks
    Span<Real> u, best_u;
    ChainWork projection;

    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
};

struct GivenParameters {
    Index index_base = 0;  // of `point`
    Span<const Index> point, curve;
    Span<const Real> u;
};

// Finds curve and parameter of every point on a marker that is on curves, the points of rigid
// bodies, and those of given displacements. Curves meet, begin and end at break points of the
// boundary: the points nearest to the ends of curves that are not periodic. Each segment between
// breaks belongs to the curve it is closest to.
Status parametrise(Topology const& topology, Boundary const& boundary,
                   Span<const Condition> conditions, Span<const Curve> curves,
                   GivenParameters const& given, WallWork const& work, Wall& wall,
                   Fault& fault) noexcept;

// wall.offset of all points.
void find_offsets(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                  bool offset_correction, Wall& wall) noexcept;

// Kinds of all points, and the parameters of those on curves: what right-hand sides and matrix are
// made of.
std::uint64_t fingerprint_of(Span<const PointKind> kinds, Wall const& wall) noexcept;

}  // namespace harmorph
