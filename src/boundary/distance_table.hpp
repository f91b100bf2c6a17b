// Defines the table of the kernels of FaceDistance for one instruction set.
// tests/boundary/test_distance.cpp covers this file.
#pragma once

#include "boundary/distance.hpp"

namespace harmorph {

struct DistanceKernels {
    // Returns the squared distance, in units, of a point in units. The search begins at `group`,
    // where a good guess saves time; `group` then becomes the group of the nearest face.
    Real (*nearest_square)(FaceDistance const& tree, Vec2 from, Index& group) noexcept;
    // Computes k [lanes] of the points (x, y), which are searched together; this is fast if they
    // are neighbours. The search begins at `group`, which then becomes a good guess for the next
    // points.
    void (*weigh_eight)(FaceDistance const& tree, Index exponent_quarters, const Real* x,
                        const Real* y, Real* k, Index& group) noexcept;
    // Finds the nearest face of each of eight points in units, which are searched together; of
    // faces at equal distances, the one with the smallest number. The searches begin at the groups.
    void (*nearest_faces)(FaceDistance const& tree, const Real* x, const Real* y,
                          const Index* groups, Index* faces) noexcept;
};

DistanceKernels const& distance_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
