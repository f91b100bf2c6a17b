// Flux balances by nodal gradients for values that are stored in any arrangement, so that engines
// need no copies. tests/operators/test_nodal_gradient.cpp covers this file.
#pragma once

#include "operators/nodal_gradient.hpp"

namespace harmorph {

// Adds the integral of the gradient over a cell (Green-Gauss, trapezoidal rule on the sides) to all
// corners of the cell. Contributions of a side that two cells at a corner share cancel, so the sum
// is the integral along the outline of all cells round the corner.
template <class Width, class ValueOf>
void add_cell_gradients(NodalGradient const& scheme, Width width, ValueOf value_of,
                        Real* gradient) noexcept {
    Index const n = width;
    for (NodalGradient::CellRows const& cell : scheme.cells) {
        Index const corners = cell.row[3] == none ? 3 : 4;
        const Real* const first = value_of(cell.row[0]);
        const Real* const last = corners == 3 ? first : value_of(cell.row[3]);
        const Real* const second = value_of(cell.row[1]);
        const Real* const third = value_of(cell.row[2]);
        Real* to[4];
        for (Index k = 0; k < corners; ++k) to[k] = gradient + Offset{cell.row[k]} * (2 * n);
        for (Index f = 0; f < n; ++f) {
            Real const a = first[f] - third[f], b = second[f] - last[f];
            Real const x = a * cell.across[1].x + b * cell.across[0].x;
            Real const y = a * cell.across[1].y + b * cell.across[0].y;
            for (Index k = 0; k < corners; ++k) {
                to[k][f] += x;
                to[k][n + f] += y;
            }
        }
    }
}

// Adds the flux balances of `width` functions; Width is an integer or an integral_constant.
// value_of(row) returns the row's values; balance_of(row) returns the place to which the row's
// balance is added, or null; gradient [rows * 2 width] is working space.
template <class Width, class ValueOf, class BalanceOf>
void add_balances(NodalGradient const& scheme, Width width, ValueOf value_of, Span<Real> gradient,
                  BalanceOf balance_of) noexcept {
    Index const n = width;
    fill(gradient, 0.0);
    add_cell_gradients(scheme, width, value_of, gradient.data());
    for (MedianDual::Face const& face : scheme.dual.faces) {
        Real* const into = balance_of(face.begin);
        Real* const out_of = balance_of(face.end);
        if (into == nullptr && out_of == nullptr) continue;
        const Real* const from = value_of(face.begin);
        const Real* const to = value_of(face.end);
        const Real* const from_gradient = gradient.data() + Offset{face.begin} * (2 * n);
        const Real* const to_gradient = gradient.data() + Offset{face.end} * (2 * n);
        // The flux is g . n with (F_Q - F_P) / |e| in place of the component of g along the edge e.
        // With n = direct e + rest, rest normal to e, the flux is g . n = direct (F_Q - F_P) + g .
        // rest.
        Real const direct =
            scheme.corrected ? dot(face.along, face.normal) / square(face.along) : 0;
        Vec2 const rest = 0.5 * (face.normal - direct * face.along);
        Vec2 const from_weight = scheme.inverse_area[face.begin] * rest;
        Vec2 const to_weight = scheme.inverse_area[face.end] * rest;
        auto const flux = [&](Index f) {
            return from_weight.x * from_gradient[f] + from_weight.y * from_gradient[n + f] +
                   to_weight.x * to_gradient[f] + to_weight.y * to_gradient[n + f] +
                   direct * (to[f] - from[f]);
        };
        if (into != nullptr && out_of != nullptr) {
            for (Index f = 0; f < n; ++f) {
                Real const through_face = flux(f);
                into[f] += through_face;
                out_of[f] -= through_face;
            }
        } else if (into != nullptr) {
            for (Index f = 0; f < n; ++f) into[f] += flux(f);
        } else {
            for (Index f = 0; f < n; ++f) out_of[f] -= flux(f);
        }
    }
}

}  // namespace harmorph
