#include "operators/matrix.hpp"

#include "operators/matrix_cells.hpp"

namespace harmorph {

void Matrix::clear() const noexcept {
    clear_known();
    clear_rows({0, n});
}

void Matrix::clear_rows(RowRange rows) const noexcept {
    auto const clear = [](Span<Real> numbers, Offset begin, Offset end) {
        if (!numbers.empty()) fill(numbers.from(begin, end - begin), 0.0);
    };
    clear(diagonal, rows.begin, rows.end);
    clear(row_sum, rows.begin, rows.end);
    clear(row_sum_imaginary, rows.begin, rows.end);
    clear(value, start[rows.begin], start[rows.end]);
    clear(imaginary, start[rows.begin], start[rows.end]);
}

void Matrix::clear_known() const noexcept {
    fill(coupling_value, 0.0);
    fill(coupling_imaginary, 0.0);
    fill(fixed_value, 0.0);
    fill(fixed_imaginary, 0.0);
}

// i and j are rows as row_of() returns them.
Matrix::Entry Matrix::entry(RowRange rows, Index i, Index j) const noexcept {
    bool const is_conjugate = i < 0 || (j >= 0 && j < i);
    if (is_conjugate) {
        Index const first = i;
        i = j;
        j = first;
    }
    if (!rows.contain(i)) return {};
    if (j == none) {
        Index const at = find_in_order<Index>(fixed_row, 0, fixed_row.count(), i);
        return {fixed_value.data() + at, fixed_imaginary.data() + at, is_conjugate};
    }
    if (j >= 0) {
        Offset const at = find_in_row(column, start[i], start[i + 1], j);
        return {value.data() + at, imaginary.data() + at, is_conjugate};
    }
    Index const at =
        find_in_order<Index>(coupling_row, coupling_start[wall(j)], coupling_start[wall(j) + 1], i);
    return {coupling_value.data() + at, coupling_imaginary.data() + at, is_conjugate};
}

void Matrix::add(Index point, Index other, Real conductance) const noexcept {
    RowRange const all{0, n};
    Index const i = row_of(point), j = row_of(other);
    if (i == j) return;
    if (i >= 0) diagonal[i] += conductance;
    if (j >= 0) diagonal[j] += conductance;
    add_off_diagonal<false>(all, i, j, conductance, 0);
}

template <bool with_circulation>
void Matrix::add_off_diagonal(RowRange rows, Index i, Index j, Real conductance,
                              Real circulation) const noexcept {
    if (i == j) return;
    if (j < 0 && rows.contain(i)) {
        row_sum[i] += conductance;
        if (with_circulation) row_sum_imaginary[i] -= circulation;
    }
    if (i < 0 && rows.contain(j)) {
        row_sum[j] += conductance;
        if (with_circulation) row_sum_imaginary[j] += circulation;
    }
    Entry const stored = entry(rows, i, j);
    if (stored.value == nullptr) return;
    *stored.value -= conductance;
    if (with_circulation) *stored.imaginary += stored.is_conjugate ? -circulation : circulation;
}

template void Matrix::add_off_diagonal<false>(RowRange, Index, Index, Real, Real) const noexcept;
template void Matrix::add_off_diagonal<true>(RowRange, Index, Index, Real, Real) const noexcept;

void Matrix::add_turns(RowRange rows, Cell const& cell, CellConductances const& conductance,
                       Real circulation) const noexcept {
    for (Index k = 0; k < cell.n; ++k) {
        add_turn(rows, cell.point[k], cell.next(k), {-conductance.side[k], circulation});
    }
    for (Index k = 0; cell.n == 4 && k < 2; ++k) {
        add_turn(rows, cell.point[k], cell.point[k + 2], {-conductance.across[k], 0});
    }
}

// The entry between the displacements of two points becomes conjugate(direction) entry other
// direction between the numbers of their dofs. This function adds the difference. Points whose
// value is 0 are not turned.
void Matrix::add_turn(RowRange rows, Index point, Index other, Vec2 entry_value) const noexcept {
    Vec2 const own = turn(point), theirs = turn(other);
    Index const i = row_of(point), j = row_of(other);
    if ((own.x == theirs.x && own.y == theirs.y) || i == none || j == none) return;
    Vec2 const change = product(product(conjugate(own), theirs) - Vec2{1, 0}, entry_value);
    auto const add_to_sum = [&](Index row, Vec2 by) {
        if (!rows.contain(row)) return;
        Entry const rest = entry(rows, row, none);
        *rest.value -= by.x;
        *rest.imaginary -= by.y;
    };
    auto const add_to_row = [&](Index row, Vec2 by) {
        if (!rows.contain(row)) return;
        row_sum[row] += by.x;
        row_sum_imaginary[row] += by.y;
    };
    if (i == j) {  // The passage is one cell wide.
        if (rows.contain(i)) diagonal[i] += 2 * change.x;
        add_to_row(i, {2 * change.x, 0});
        return add_to_sum(i, {2 * change.x, 0});
    }
    Entry const stored = entry(rows, i, j);
    if (stored.value != nullptr) {
        *stored.value += change.x;
        *stored.imaginary += stored.is_conjugate ? -change.y : change.y;
    }
    if (j >= 0) add_to_row(i, change);
    if (i >= 0) add_to_row(j, conjugate(change));
    add_to_sum(i, change);
    add_to_sum(j, conjugate(change));
}

// Adds the complex entry of two points as a real 2 x 2 block along the directions of the dofs of
// these points; a slipping point has the first dof only.
void Matrix::add_coupled(RowRange rows, Index point, Index other, Real conductance,
                         Real circulation) const noexcept {
    if (row_of(2 * point) == row_of(2 * other)) return;
    Vec2 const complex_entry = product(conjugate(direction(point)),
                                       product({-conductance, circulation}, direction(other)));
    Real const block[2][2] = {{complex_entry.x, -complex_entry.y},
                              {complex_entry.y, complex_entry.x}};
    auto const add_to = [&](Span<Real> numbers, Index row, Real number) {
        if (rows.contain(row)) numbers[row] += number;
    };
    for (Index p = 0; p < 2; ++p) {
        Index const i = row_of(2 * point + p), own_j = row_of(2 * other + p);
        Index const own[] = {i, own_j};
        for (Index const row : own) {
            add_to(diagonal, row, conductance);
            add_to(row_sum, row, conductance);
        }
        for (Index q = 0; q < 2; ++q) {
            Index const j = row_of(2 * other + q);
            if (i == none || j == none) continue;
            Entry const at = entry(rows, i, j);
            if (at.value != nullptr) *at.value += block[p][q];
            if (i < 0 || j < 0) continue;
            add_to(row_sum, i, block[p][q]);
            add_to(row_sum, j, block[p][q]);
        }
    }
    if (is_beside_fixed(point, other)) couple_to_fixed(rows, point, conductance, circulation);
    if (is_beside_fixed(other, point)) couple_to_fixed(rows, other, conductance, -circulation);
}

void Matrix::couple_to_fixed(RowRange rows, Index point, Real conductance,
                             Real circulation) const noexcept {
    Entry const at = entry(rows, row_of(2 * point), none);
    if (at.value == nullptr) return;
    *at.value -= conductance;
    *at.imaginary += circulation;
}

void Matrix::mark_faces(Edges const& edges, Span<std::uint8_t> faces) const noexcept {
    fill(faces, std::uint8_t{0});
    auto const mark = [&](Index i, Index j) {
        if (i < 0 || j < 0 || i == j) return;
        Index const row = min(i, j);
        faces[find_in_row(column, start[row], start[row + 1], max(i, j))] = 1;
    };
    edges.for_each([&](Index, Index low, Index high) {
        if (components() == 1) return mark(row_of(low), row_of(high));
        bool const one_slips = slips(low) || slips(high);
        for (Index p = 0; p < 2; ++p) {
            for (Index q = 0; q < 2; ++q) {
                if (p == q || one_slips) mark(row_of(2 * low + p), row_of(2 * high + q));
            }
        }
    });
}

}  // namespace harmorph
