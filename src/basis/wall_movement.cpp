#include "basis/wall_movement.hpp"

namespace harmorph {
namespace {

// This number, relative to the mean diagonal entry, is added to all diagonal entries.
constexpr Real regularisation = 1e-12;
// The residual of the solution with rotated offsets must be below this fraction of that without.
constexpr Real much_better = 0.1;
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
    arena.take(first, n);
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

// Returns what the first columns leave of the movement of the point of the wall for which
// find_row() was called last.
Vec2 WallMovement::rest(Basis const& basis, Index slot, Index n_columns, Points at) noexcept {
    Vec2 rest = at[basis.wall_point[slot]] - basis.wall_start[slot];
    for (Index i = 0; i < n_columns; ++i) rest = rest - product(row[i], unknown[i]);
    return rest;
}

// Tells whether more points follow the curve than it has functions and a rotation. The marks of
// functions are in `step`.
bool WallMovement::determines_rotation(Basis const& basis, Index curve) noexcept {
    Index surplus = -1;
    fill(step, Vec2{});
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (basis.wall_curve[slot] != curve) continue;
        ++surplus;
        find_row(basis, slot);
        for (Index i = 0; i < basis.n_functions(); ++i) {
            if (is_zero(row[i]) || !is_zero(step[i])) continue;
            step[i] = {1, 0};
            --surplus;
        }
    }
    return surplus > 0;
}

// Finds the scales of the curves whose offsets may have rotated. Returns whether there are any.
bool WallMovement::find_scales(Basis const& basis) noexcept {
    Real size = 0;
    for (Vec2 const start : basis.wall_start) size = max(size, largest_of(start));
    fill(scale, Real(0));
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (!basis.is_on_curve(slot) || basis.header->method.offset_correction != 0) continue;
        Real& curve_scale = scale[basis.wall_curve[slot]];
        curve_scale = max(curve_scale, length(offset_at_start(basis, slot)));
    }
    bool any = false;
    for (Index curve = 0; curve < scale.count(); ++curve) {
        bool const rotates = scale[curve] > min_offset * size && determines_rotation(basis, curve);
        if (!rotates) scale[curve] = 0;
        any = any || rotates;
    }
    return any;
}

void WallMovement::set_up(Basis const& basis) noexcept {
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
    regularise(basis);
    factor();
}

// Adds the regularisation. Half of what a diagonal entry gets, which `step` receives, is the
// smallest pivot of its row.
void WallMovement::regularise(Basis const& basis) noexcept {
    Offset const n = unknown.count();
    Index const shapes = basis.header->counts.shapes();
    Real sum = 0;
    for (Index i = 0; i < shapes; ++i) sum += matrix[i * n + i].x;
    // Diagonal entries of bodies and modes may have other units, so they do not enter the mean.
    Real const mean = sum > 0 ? sum / shapes : 1;
    for (Index i = 0; i < n; ++i) {
        Real& diagonal = matrix[i * n + i].x;
        Real const added = regularisation * (i < shapes || diagonal == 0 ? mean : diagonal);
        diagonal += added;
        step[i] = {added / 2, 0};
    }
}

void WallMovement::factor() noexcept {
    Offset const n = unknown.count();
    for (Offset k = 0; k < n; ++k) {
        // Rounding may remove from a small entry what was added to it.
        Real const pivot = sqrt(max(matrix[k * n + k].x, step[k].x));
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

// Returns the largest residual, which the rotated offsets have made smaller.
BoundaryError WallMovement::find_solution(Basis const& basis, Points at) noexcept {
    set_up(basis);
    BoundaryError best;
    for (Index refinement = 0; refinement <= max_refinements; ++refinement) {
        BoundaryError worst;
        fill(step, Vec2{});
        for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
            if (!follows_functions(basis, slot)) continue;
            find_row(basis, slot);
            Vec2 const left = rest(basis, slot, row.count(), at);
            worst.include(length(left), basis.wall_point[slot]);
            for (Index i = 0; i < row.count(); ++i)
                step[i] = step[i] + product(conjugate(row[i]), left);
        }
        bool const still_falls = refinement < 2 || worst.error < 0.9 * best.error;
        best = worst;
        if (!still_falls || worst.point == none) break;
        solve();
        for (Index i = 0; i < unknown.count(); ++i) unknown[i] = unknown[i] + step[i];
    }
    return best;
}

// Measures where the functions alone lead the points, as a morph does.
void WallMovement::measure(Basis const& basis, Points at) noexcept {
    residual = {};
    rotated_offset = 0;
    Index const n = basis.n_functions();
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        if (!follows_functions(basis, slot)) continue;
        find_row(basis, slot);
        residual.include(length(rest(basis, slot, n, at)), basis.wall_point[slot]);
        for (Index k = n; k < row.count(); ++k)
            rotated_offset = max(rotated_offset, length(product(row[k], unknown[k])));
    }
}

void WallMovement::find(Basis const& basis, Points at) noexcept {
    fill(scale, Real(0));
    following = find_solution(basis, at);
    for (Index i = 0; i < unknown.count(); ++i) first[i] = unknown[i];
    if (find_scales(basis)) {
        BoundaryError const rotated = find_solution(basis, at);
        if (rotated.error < much_better * following.error) {
            following = rotated;
        } else {
            fill(scale, Real(0));
            for (Index i = 0; i < unknown.count(); ++i) unknown[i] = first[i];
        }
    }
    measure(basis, at);
}

}  // namespace harmorph
