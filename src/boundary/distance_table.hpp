// The searches of FaceDistance with one instruction set as a function table.
#pragma once

#include "boundary/distance.hpp"

namespace harmorph {

struct DistanceKernels {
    // Squared distance in units, of a point in units. group: in, the group that is tried first,
    // where a good guess saves time; out, the group of the nearest face.
    Real (*nearest_square)(FaceDistance const& tree, Vec2 from, Index& group) noexcept;
    // k [lanes] of the points (x, y), searched together: fast if they are neighbours. group: in,
    // the group that is tried first; out, a good one for the next points.
    void (*weigh_eight)(FaceDistance const& tree, Index quarters, const Real* x, const Real* y,
                        Real* k, Index& group) noexcept;
};

DistanceKernels const& distance_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
