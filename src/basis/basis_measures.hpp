// How exactly a basis, and what it has moved, follow the B-spline.
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
// What the points of the wall moved against what the B-spline did.
BoundaryError boundary_error(Basis const& basis, const Real* move, Points from, Points to) noexcept;

// Values on the curves against boundary functions evaluated anew; their sum against 1; the points'
// distances from the curves.
struct BasisMeasures {
    BoundaryError value;
    BoundaryError distance;
    Real partition_defect = 0;
    Real min_value = 0, max_value = 0;
};
BasisMeasures measure_basis(Basis const& basis, Points points,
                            Executor const& executor = {}) noexcept;

}  // namespace harmorph
