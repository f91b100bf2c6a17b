#include "basis/wall_movement.hpp"

namespace harmorph {
namespace {

// Both are relative to the mean diagonal entry. The first is added to all diagonal entries; the
// second is the weight of differences between the movements of neighbouring control points, and of
// turning offsets.
constexpr Real size_regularisation = 1e-14, bending_regularisation = 1e-7;
constexpr Index max_refinements = 200;

// Points with displacements that are given from call to call follow no function, unless modes move
// them.
bool follows_functions(Basis const& basis, Index slot) noexcept {
    return !basis.is_given(slot) || basis.header->counts.modes > 0;
}

Vec2 offset_at_start(Basis const& basis, Index slot) noexcept {
    return basis.wall_start[slot] -
           curve_point(basis.curve(basis.wall_curve[slot]), basis.wall_u[slot]);
}

bool is_zero(Vec2 a) noexcept { return a.x == 0 && a.y == 0; }

}  // namespace

void WallMovement::lay_out(Arena& arena, BasisCounts const& counts) noexcept {
    Offset const n = Offset{counts.functions()} + counts.curves;
    arena.take(matrix, n * n);
    arena.take(row, n);
    arena.take(unknown, n);
    arena.take(step, n);
    arena.take(scale, counts.curves);
}

Real WallMovement::extent(Basis const& basis, Points at) noexcept {
    Vec2 low, high;
    bool any = false;
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (!follows_functions(basis, slot)) continue;
        Vec2 const p = at[basis.wall_point[slot]];
        low = any ? Vec2{min(low.x, p.x), min(low.y, p.y)} : p;
        high = any ? Vec2{max(high.x, p.x), max(high.y, p.y)} : p;
        any = true;
    }
    return max(high.x - low.x, high.y - low.y);
}

// Fills `row` with the values at one point of the wall.
void WallMovement::find_row(Basis const& basis, Index slot) noexcept {
    Index const n = basis.n_functions();
    auto const value = basis.row(basis.in_single() ? slot : basis.wall_point[slot]);
    Index const imaginary = basis.kind() == ValueKind::matrix ? 2 * n : n;  // See ValueKind.
    for (Index i = 0; i < n; ++i) {
        row[i] = {value[i], basis.kind() == ValueKind::real ? 0 : value[imaginary + i]};
    }
    Index const curve = basis.wall_curve[slot];
    for (Index k = 0; k < scale.count(); ++k) row[n + k] = {};
    if (!basis.is_on_curve(slot) || scale[curve] == 0) return;
    row[n + curve] = (1 / scale[curve]) * offset_at_start(basis, slot);
}

// Returns the residual of the point of the wall for which find_row() was called last.
Vec2 WallMovement::residual(Basis const& basis, Index slot, Points at) noexcept {
    Vec2 rest = at[basis.wall_point[slot]] - basis.wall_start[slot];
    for (Index i = 0; i < row.count(); ++i) rest = rest - product(row[i], unknown[i]);
    return rest;
}

void WallMovement::set_up(Basis const& basis) noexcept {
    Real size = 0;
    for (Vec2 const start : basis.wall_start) size = max(size, largest_of(start));
    fill(scale, Real(0));
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (!basis.is_on_curve(slot) || basis.header->method.offset_correction != 0) continue;
        Real& curve_scale = scale[basis.wall_curve[slot]];
        curve_scale = max(curve_scale, length(offset_at_start(basis, slot)));
    }
    for (Real& curve_scale : scale) curve_scale = curve_scale > min_offset * size ? curve_scale : 0;
    fill(matrix, Vec2{});
    fill(unknown, Vec2{});
    Index const n = unknown.count();
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (!follows_functions(basis, slot)) continue;
        find_row(basis, slot);
        for (Index i = 0; i < n; ++i) {
            if (is_zero(row[i])) continue;
            for (Index j = 0; j <= i; ++j) {
                if (is_zero(row[j])) continue;
                Vec2& entry = matrix[Offset{i} * n + j];
                entry = entry + product(conjugate(row[i]), row[j]);
            }
        }
    }
    factor(regularise(basis));
}

// The expression (P_2 - P_1) (m_1 - m_0) - (P_1 - P_0) (m_2 - m_1), divided by the lengths, is 0
// for m = a P + b; its square is added to the energy.
void WallMovement::add_similarity(Curve const& curve, Index k, Real strength) noexcept {
    Vec2 const before = curve.point(k) - curve.point(k - 1),
               after = curve.point(k + 1) - curve.point(k);
    Real const lengths = length(before) + length(after);
    if (!(lengths > 0)) return;
    Vec2 const factor[3] = {(-1 / lengths) * after, (1 / lengths) * (before + after),
                            (-1 / lengths) * before};
    Offset const n = unknown.count();
    for (Index a = 0; a < 3; ++a) {
        Index const i = curve.control_point(k - 1 + a);
        for (Index b = 0; b < 3; ++b) {
            Index const j = curve.control_point(k - 1 + b);
            if (j > i) continue;
            Vec2& entry = matrix[i * n + j];
            entry = entry + strength * product(conjugate(factor[a]), factor[b]);
        }
    }
}

// Adds the regularisation. Returns the smallest entry that a diagonal may have.
Real WallMovement::regularise(Basis const& basis) noexcept {
    Offset const n = unknown.count();
    Index const shapes = basis.header->counts.shapes();
    Real sum = 0;
    for (Index i = 0; i < shapes; ++i) sum += matrix[i * n + i].x;
    // Diagonal entries of bodies and modes may have other units, so they do not enter the mean.
    Real const mean = sum > 0 ? sum / shapes : 1;
    for (Index i = 0; i < n; ++i) {
        Real& diagonal = matrix[i * n + i].x;
        diagonal += size_regularisation * (i < shapes || diagonal == 0 ? mean : diagonal);
    }
    for (Index i = basis.n_functions(); i < n; ++i)
        matrix[i * n + i].x += bending_regularisation * mean;
    Real const smallest = 0.5 * size_regularisation * mean;
    if (!basis.combination.empty()) return smallest;
    for (Index number = 0; number < scale.count(); ++number) {
        Curve const curve = basis.curve(number);
        for (Index k = 1; k + 1 < curve.n_indices; ++k)
            add_similarity(curve, k, bending_regularisation * mean);
    }
    return smallest;
}

void WallMovement::factor(Real smallest_pivot) noexcept {
    Offset const n = unknown.count();
    for (Offset k = 0; k < n; ++k) {
        // Rounding may remove from a small entry what was added to it.
        Real const pivot = sqrt(max(matrix[k * n + k].x, smallest_pivot));
        matrix[k * n + k] = {pivot, 0};
        for (Offset i = k + 1; i < n; ++i) matrix[i * n + k] = (1 / pivot) * matrix[i * n + k];
        for (Offset i = k + 1; i < n; ++i) {
            Vec2 const multiplier = matrix[i * n + k];
            if (is_zero(multiplier)) continue;
            for (Offset j = k + 1; j <= i; ++j) {
                Vec2& entry = matrix[i * n + j];
                entry = entry - product(multiplier, conjugate(matrix[j * n + k]));
            }
        }
    }
}

// Solves with the factor; the solution replaces the right-hand side in `step`.
void WallMovement::solve() noexcept {
    Offset const n = unknown.count();
    for (Offset i = 0; i < n; ++i) {
        for (Offset j = 0; j < i; ++j) step[i] = step[i] - product(matrix[i * n + j], step[j]);
        step[i] = (1 / matrix[i * n + i].x) * step[i];
    }
    for (Offset i = n; i-- > 0;) {
        for (Offset j = i + 1; j < n; ++j)
            step[i] = step[i] - product(conjugate(matrix[j * n + i]), step[j]);
        step[i] = (1 / matrix[i * n + i].x) * step[i];
    }
}

BoundaryError WallMovement::find(Basis const& basis, Points at) noexcept {
    set_up(basis);
    BoundaryError best;
    for (Index refinement = 0; refinement <= max_refinements; ++refinement) {
        BoundaryError worst;
        fill(step, Vec2{});
        for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
            if (!follows_functions(basis, slot)) continue;
            find_row(basis, slot);
            Vec2 const rest = residual(basis, slot, at);
            worst.include(length(rest), basis.wall_point[slot]);
            for (Index i = 0; i < row.count(); ++i)
                step[i] = step[i] + product(conjugate(row[i]), rest);
        }
        bool const still_falls = refinement < 2 || worst.error < 0.9 * best.error;
        best = worst;
        if (!still_falls || worst.point == none) break;
        solve();
        for (Index i = 0; i < unknown.count(); ++i) unknown[i] = unknown[i] + step[i];
    }
    return best;
}

}  // namespace harmorph
