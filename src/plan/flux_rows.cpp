#include "plan/flux_rows.hpp"

namespace harmorph {
namespace {

// The factors by which a dof takes a real flux of both components: one for each plane of its
// numbers. An equation of a dof is that of the displacement, multiplied by the dof's direction.
struct FluxFactors {
    Real plane[2];

    FluxFactors(Matrix const& matrix, Index point, Index component) noexcept {
        Vec2 factor{1, 0};
        if (matrix.couples_xy()) {
            factor = component == 0 ? Vec2{1, 0} : Vec2{0, 1};
            if (matrix.slips(point)) factor = matrix.direction(point);
        }
        plane[0] = factor.x;
        plane[1] = factor.y;
    }
};

}  // namespace

void FluxRows::lay_out(Arena& arena, Analysis const& analysis, Index max_numbers) noexcept {
    Fluxes const& fluxes = analysis.problem().fluxes;
    Index const n = fluxes.count();
    if (n == 0) return;
    n_control = fluxes.n_control;
    arena.take(end, 2 * n);
    arena.take(value, Offset{n} * n_control);
    arena.take(half_length, n);
    arena.take(row_of, analysis.graph().n);
    Index const components = analysis.problem().method.components(analysis.problem().demands);
    arena.take(row, Offset{2 * n} * components * max_numbers);
}

void FluxRows::init(Analysis const& analysis) noexcept {
    if (!any()) return;
    Fluxes const& fluxes = analysis.problem().fluxes;
    n_control = fluxes.n_control;
    for (Index k = 0; k < end.count(); ++k)
        end[k] = analysis.topology().representative[fluxes.end(k / 2, k % 2)];
    copy(value, fluxes.value);
}

void FluxRows::measure(Points points) const noexcept {
    for (Index k = 0; k < half_length.count(); ++k)
        half_length[k] = 0.5 * length(points[end[2 * k + 1]] - points[end[2 * k]]);
}

void FluxRows::find_rows(Matrix const& matrix) const noexcept {
    fill(row_of, none);
    Index n = 0;
    for (Index const point : end) {
        for (Index c = 0; c < matrix.components(); ++c) {
            Index const position = matrix.row_of(matrix.components() * point + c);
            if (position >= 0 && row_of[position] == none) row_of[position] = n++;
        }
    }
}

void FluxRows::add_face(Matrix const& matrix, DofValues const& dofs, Index flux,
                        Index point) const noexcept {
    const Real* const flux_of = value.data() + Offset{flux} * n_control + dofs.first_function;
    Index const n = min(n_control - dofs.first_function, dofs.n_functions),
                planes = dofs.length() / dofs.n_functions;
    for (Index c = 0; c < matrix.components(); ++c) {
        Index const position = matrix.row_of(matrix.components() * point + c);
        if (position < 0) continue;
        FluxFactors const factors(matrix, point, c);
        Real* const to = row.data() + Offset{row_of[position]} * dofs.length();
        for (Index p = 0; p < planes; ++p) {
            Real const factor = factors.plane[p] * half_length[flux];
            for (Index i = 0; i < n; ++i) to[p * dofs.n_functions + i] += factor * flux_of[i];
        }
    }
}

void FluxRows::add_to(Matrix const& matrix, DofValues& dofs) const noexcept {
    if (!any() || dofs.first_function >= n_control) return;
    find_rows(matrix);
    fill(row, 0.0);
    for (Index k = 0; k < end.count(); ++k) add_face(matrix, dofs, k / 2, end[k]);
    dofs.source = row.data();
    dofs.source_row = row_of;
    if (dofs.is_start) return;
    for (Index i = 0; i < row_of.count(); ++i) {
        const Real* const from = dofs.source_at(i);
        if (from == nullptr) continue;
        Real* const to = dofs.at(i);
        for (Index k = 0; k < dofs.length(); ++k) to[k] += from[k];
    }
}

}  // namespace harmorph
