// How accurately a basis, and the points that it has moved, follow the B-spline.
// tests/basis/test_basis.cpp and tests/plan/test_plan.cpp cover this file.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

struct BoundaryError {
    Real error = 0;
    Index point = none;

    void include(Real found, Index at) noexcept {
        if (point == none || exceeds(found, error)) *this = {found, at};
    }
};
// Compares how points of the wall moved with the B-spline, and how shared points moved with both of
// their conditions; returns the largest difference.
BoundaryError boundary_error(Basis const& basis, const Real* move, Points from, Points to) noexcept;

// The shared point whose two conditions differ most after a movement.
struct Tear {
    // As a fraction of the extent, the diagonal of the box around the wall.
    static constexpr Real tolerance = 1e-6;
    Real distance = 0;
    Index shared = none;  // The number of the point among the shared ones.
};
// Returns the largest tear beyond the tolerance. The displacements of given points are not known,
// so they are compared with nothing.
Tear find_tear(Basis const& basis, const Real* move, Points at) noexcept;
// Refuses the movement, or warns of it, by this status if it tears two conditions apart.
Status check_tear(Basis const& basis, const Real* move, Points at, Status status,
                  Fault& fault) noexcept;

// Compares values on the curves with boundary functions that are evaluated again, the sum of the
// values with 1, and the points with the curves.
struct BasisMeasures {
    BoundaryError value;
    BoundaryError distance;
    Real partition_defect = 0;
    Real min_value = 0, max_value = 0;
};
BasisMeasures measure_basis(Basis const& basis, Points points,
                            Executor const& executor = {}) noexcept;

}  // namespace harmorph
