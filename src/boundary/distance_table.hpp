// The searches of FaceDistance with one instruction set as a function table.
#pragma once

#include "harmorph/boundary/distance.hpp"

namespace harmorph {

struct DistanceKernels {
    // Squared distance in units, of a place in units. group: where it is tried first, and then where the nearest face is;
    // a good guess saves time.
    Real (*nearest_square)(FaceDistance const& tree, Vec2 from, Index& group) noexcept;
    // k [lanes] of the places (x, y), which search together: fast if they are neighbours. group: where they begin, and then
    // where the next ones should.
    void (*weigh_eight)(FaceDistance const& tree, Index quarters, const Real* x, const Real* y, Real* k, Index& group) noexcept;
};

DistanceKernels const& distance_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
