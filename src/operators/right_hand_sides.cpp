#include "operators/right_hand_sides.hpp"

namespace harmorph {
namespace {

// The values of a dof on the wall that are not 0.
struct KnownValues {
    static constexpr Index max_count = 2 * max_order;
    Index n = 0;
    Index at[max_count];
    Real value[max_count];

    KnownValues(Basis const& basis, BoundaryFunctions const& functions, Index component,
                Index components) noexcept {
        Index const n_functions = basis.n_functions(),
                    planes = numbers_of(basis.kind()) / components;
        for (Index k = 0; k < functions.order; ++k) {
            Numbers const numbers = numbers_of(basis.kind(), functions.value[k]);
            for (Index p = 0; p < planes; ++p) {
                Real const number = numbers.plane[component * planes + p];
                if (number == 0) continue;
                at[n] = p * n_functions + functions.function[k];
                value[n++] = number;
            }
        }
    }
};

// Subtracts coupling * values of the boundary functions from `row`, for complex equations.
void subtract_complex(BoundaryFunctions const& functions, Vec2 coupling, Index plane,
                      Real* row) noexcept {
    for (Index k = 0; k < functions.order; ++k) {
        Vec2 const term = product(coupling, functions.value[k]);
        row[functions.function[k]] -= term.x;
        row[plane + functions.function[k]] -= term.y;
    }
}

// Calls visit(coupling, numbers of the dof on the wall, numbers of the unknown, columns) for each
// coupling.
template <class Visit>
void for_each_coupling(Matrix const& matrix, DofValues const& dofs, Visit const& visit) noexcept {
    Index const n = dofs.columns(matrix);
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) {
        for (Index c = matrix.coupling_start[wall]; c < matrix.coupling_start[wall + 1]; ++c) {
            visit(c, dofs.wall(wall), dofs.at(matrix.coupling_row[c]), n);
        }
    }
}

void add_product(Real factor, const Real* from, Real* to, Index n) noexcept {
    for (Index k = 0; k < n; ++k) to[k] += factor * from[k];
}

}  // namespace

void set_right_hand_sides(Matrix const& matrix, Basis const& basis, DofValues const& dofs,
                          Executor const& executor) noexcept {
    constexpr Index min_task_rows = 4096;
    Offset const length = basis.row_length();
    executor.for_ranges(static_cast<Index>(whole_blocks(basis.n_points())), min_task_rows,
                        [&](Index begin, Index end) {
                            fill(basis.value.from(begin * length, (end - begin) * length), 0.0);
                        });
    set_wall_values(matrix, basis, dofs);
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) {
        BoundaryFunctions const functions = basis.stored_boundary_functions(wall / dofs.components);
        KnownValues const known(basis, functions, wall % dofs.components, dofs.components);
        for (Index c = matrix.coupling_start[wall]; c < matrix.coupling_start[wall + 1]; ++c) {
            Real* const row = dofs.at(matrix.coupling_row[c]);
            if (matrix.is_complex()) {
                Vec2 const coupling{matrix.coupling_value[c], matrix.coupling_imaginary[c]};
                subtract_complex(functions, coupling, dofs.columns(matrix), row);
                continue;
            }
            for (Index k = 0; k < known.n; ++k)
                row[known.at[k]] -= matrix.coupling_value[c] * known.value[k];
        }
    }
}

void set_wall_values(Matrix const& matrix, Basis const& basis, DofValues const& dofs) noexcept {
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) {
        BoundaryFunctions const functions = basis.stored_boundary_functions(wall / dofs.components);
        KnownValues const known(basis, functions, wall % dofs.components, dofs.components);
        Real* const own = dofs.wall(wall);
        fill(Span<Real>(own, static_cast<Size>(dofs.length())), 0.0);
        for (Index k = 0; k < known.n; ++k) own[known.at[k]] += known.value[k];
    }
}

void subtract_couplings(Matrix const& matrix, DofValues const& dofs) noexcept {
    for_each_coupling(matrix, dofs, [&](Index c, const Real* known, Real* row, Index n) {
        add_product(-matrix.coupling_value[c], known, row, n);
        if (!matrix.is_complex()) return;
        add_product(matrix.coupling_imaginary[c], known + n, row, n);
        add_product(-matrix.coupling_value[c], known + n, row + n, n);
        add_product(-matrix.coupling_imaginary[c], known, row + n, n);
    });
}

void subtract_transposed_couplings(Matrix const& matrix, DofValues const& dofs) noexcept {
    for_each_coupling(matrix, dofs, [&](Index c, Real* known, const Real* row, Index n) {
        add_product(-matrix.coupling_value[c], row, known, n);
        if (!matrix.is_complex()) return;
        add_product(-matrix.coupling_imaginary[c], row + n, known, n);
        add_product(-matrix.coupling_value[c], row + n, known + n, n);
        add_product(matrix.coupling_imaginary[c], row, known + n, n);
    });
}

}  // namespace harmorph
