#include "operators/dof_directions.hpp"

namespace harmorph {

// Calls turn(tangent, number of the first dof, number of the second dof) for the numbers of each
// slipping point that is not joined to another one.
template <class Turn>
void DofDirections::for_each_slipping(DofValues const& values, Index n_points,
                                      Turn const& turn) const noexcept {
    if (!matrix_.couples_xy()) return;
    for (Index point = 0; point < n_points; ++point) {
        if (!matrix_.slips(point) || values.dof_of_position[matrix_.row_of(2 * point)] != 2 * point)
            continue;
        Real* const x = values.values_of_dof(2 * point);
        Real* const y = values.values_of_dof(2 * point + 1);
        for (Index k = 0; k < values.length(); ++k) turn(matrix_.direction(point), x[k], y[k]);
    }
}

void DofDirections::turn_slipping(DofValues const& values, Index n_points) const noexcept {
    for_each_slipping(values, n_points, [](Vec2 along, Real& x, Real& y) {
        y = along.y * x;
        x = along.x * x;
    });
}

void DofDirections::turn_slipping_back(DofValues const& values, Index n_points) const noexcept {
    for_each_slipping(values, n_points, [](Vec2 along, Real& x, Real& y) {
        x = along.x * x + along.y * y;
        y = 0;
    });
}

// Calls turn(factor, number as a complex one) for the numbers of each point on a turned side.
template <class Turn>
void DofDirections::for_each_turned(DofValues const& values, Index n_points,
                                    Turn const& turn) const noexcept {
    if (!matrix_.turns_sides()) return;
    Index const n = values.columns(matrix_);
    for (Index point = 0; point < n_points; ++point) {
        Vec2 const factor = matrix_.turn(point);
        if (matrix_.row_of(point) == none || (factor.x == 1 && factor.y == 0)) continue;
        Real* const re = values.values_of_dof(point);
        for (Index k = 0; k < n; ++k) {
            Vec2 const turned = turn(factor, Vec2{re[k], re[n + k]});
            re[k] = turned.x;
            re[n + k] = turned.y;
        }
    }
}

void DofDirections::turn_sides(DofValues const& values, Index n_points) const noexcept {
    for_each_turned(values, n_points,
                    [](Vec2 factor, Vec2 number) { return product(factor, number); });
}

void DofDirections::turn_sides_back(DofValues const& values, Index n_points) const noexcept {
    for_each_turned(values, n_points,
                    [](Vec2 factor, Vec2 number) { return product(conjugate(factor), number); });
}

}  // namespace harmorph
