// Periodic pairs: two boundaries, one of which is the other moved by a translation or turned about
// a centre. Their points move alike, or alike but turned.
#pragma once

#include "boundary/conditions.hpp"
#include "mesh/periodic_rotation.hpp"
#include "mesh/periodic_translations.hpp"

namespace harmorph {

// How the sides of pairs are mapped onto each other.
struct Periodicity {
    Translations translations;
    Rotation rotation;
    // [n_points] where there is a rotation: the displacement of a point is that of its unknown,
    // turned so many times. Points of the markers that are named first in their conditions are not
    // turned.
    Span<Index> times;

    void lay_out(Arena& arena, Index n_points, Demands const& demands) noexcept {
        arena.take(times, demands.rotation ? n_points : 0);
    }
};

// Ties every point of a periodic partner to the image: both have one representative from now on,
// and the kind of higher precedence. tangent: of slip lines, or empty; slip lines do not go with
// rotations. chain [points on boundaries]: working space. Refuses pairs that are not one piece each
// or not images of each other, walls that end on them, translations that form no lattice, and
// rotations about several centres or by several angles.
Status tie_periodic(Topology& topology, Boundary const& boundary, Span<const Condition> conditions,
                    Span<Index> chain, Span<PointKind> kinds, Span<Vec2> tangent,
                    Periodicity& periodicity, Fault& fault) noexcept;

}  // namespace harmorph
