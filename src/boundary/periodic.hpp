// Joins periodic pairs of boundaries. One boundary of a pair is the other one after a translation
// or a rotation about a centre. Corresponding points have equal displacements, or equal
// displacements after the rotation.
#pragma once

#include "boundary/conditions.hpp"
#include "mesh/periodic_motion.hpp"

namespace harmorph {

// Describes how the sides of pairs are mapped onto each other.
struct Periodicity {
    Translations translations;
    Rotation rotation;
    // [n_points] If there is a rotation, the displacement of a point is the displacement of its
    // unknown, rotated this number of times. Points of the marker that a condition names first are
    // not rotated.
    Span<Index> times;

    void lay_out(Arena& arena, Index n_points, Demands const& demands) noexcept {
        arena.take(times, demands.rotation ? n_points : 0);
    }
};

// Ties each point of a pair to its image: both get one representative, and the kind of higher
// precedence. `tangent` has the tangents of slip lines, or is empty; slip lines cannot be combined
// with rotations. chain [points on boundaries] is working space. Refuses sides that are not one
// open chain or not images of each other, walls that end on a pair, translations that do not form a
// lattice, and rotations with several centres or angles.
Status tie_periodic(Topology& topology, Boundary const& boundary, Span<const Condition> conditions,
                    Span<Index> chain, Span<PointKind> kinds, Span<Vec2> tangent,
                    Periodicity& periodicity, Fault& fault) noexcept;

}  // namespace harmorph
