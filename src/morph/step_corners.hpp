// The corners that limit the admissible step along a displacement, and the derivatives of their
// steps. tests/morph/test_step_corners.cpp covers this file.
#pragma once

#include "morph/admissible_step.hpp"

namespace harmorph {

// The area of a corner is 0 at y = x + s d, with positions x, the displacement d and the step s. A
// change of x and d changes the step by ds = -grad A(y) . (dx + s dd) / (grad A(y) . d).
struct StepCorner {
    Real step = infinity;
    Index cell = none;  // the cell or guard
    Index point[3] = {none, none, none};
    Vec2 by_position[3];
    // If false, the area only touches 0, so that the step has no derivative.
    bool has_derivative = false;
};

// Calls visit(user, corner) for the corners whose step is at most `max_step`, in the order of the
// cells. limit is the admissible step, which is positive; `max_step` is finite and not below the
// limit. A corner with the step of the limit is always visited.
void find_step_corners(OrientedMesh const& cells, Points points, Points displacement,
                       AdmissibleStep const& limit, Real max_step, Executor const& executor,
                       void (*visit)(void* user, StepCorner const& found), void* user) noexcept;
template <class Visit>
void find_step_corners(OrientedMesh const& cells, Points points, Points displacement,
                       AdmissibleStep const& limit, Real max_step, Executor const& executor,
                       Visit visit) noexcept {
    auto const call = [](void* user, StepCorner const& found) {
        (*static_cast<Visit*>(user))(found);
    };
    find_step_corners(cells, points, displacement, limit, max_step, executor, call, &visit);
}

}  // namespace harmorph
