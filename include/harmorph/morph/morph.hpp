// Functions times movements: mesh points from control points.
#pragma once

#include "harmorph/basis/basis.hpp"
#include "harmorph/base/executor.hpp"

namespace harmorph {

// to = from + sum_i F_i move_i; move [2 * functions] x,y pairs. `from` not given: 0. Points whose sum is 0 keep their bits.
void morph(Basis const& basis, const Real* move, Points from, MutablePoints to, Executor const& executor) noexcept;

struct BoundaryError {
    Real error = 0;
    Index point = none;

    void include(Real its_error, Index its_point) noexcept {
        if (point == none || exceeds(its_error, error)) *this = {its_error, its_point};
    }
};
// What the points of the wall moved against what the B-spline did.
BoundaryError boundary_error(Basis const& basis, const Real* move, Points from, Points to) noexcept;

// Values on the curves against boundary functions evaluated anew; their sum against 1; the points' distances from the curves.
struct BasisMeasures {
    BoundaryError value;
    BoundaryError distance;
    Real partition_defect = 0;
    Real min_value = 0, max_value = 0;
};
BasisMeasures measure_basis(Basis const& basis, Points points) noexcept;

}  // namespace harmorph
