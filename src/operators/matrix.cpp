#include "operators/matrix.hpp"

#include "base/sort.hpp"
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

void Matrix::add_rotations(RowRange rows, Cell const& cell, CellConductances const& conductance,
                           Real circulation) const noexcept {
    for (Index k = 0; k < cell.n; ++k) {
        add_rotation(rows, cell.point[k], cell.next(k), {-conductance.side[k], circulation});
    }
    for (Index k = 0; cell.n == 4 && k < 2; ++k) {
        add_rotation(rows, cell.point[k], cell.point[k + 2], {-conductance.across[k], 0});
    }
}

// The entry between the displacements of two points becomes conjugate(direction) entry other
// direction between the numbers of their dofs. This function adds the difference. Points whose
// value is 0 are not rotated.
void Matrix::add_rotation(RowRange rows, Index point, Index other,
                          Vec2 entry_value) const noexcept {
    Vec2 const own = rotation(point), theirs = rotation(other);
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

namespace {

// Exchanges two numbers that are not in order, without a branch that could be mispredicted.
inline void put_in_order(Index& a, Index& b) noexcept {
    Index const low = min(a, b), high = max(a, b);
    a = low;
    b = high;
}

// Sorts a row of at most short_row columns by a sorting network; returns whether any column is
// repeated. The row must have room for short_row columns; those after its end are overwritten.
bool sort_short_row(Index* row, Index length) noexcept {
    static_assert(Matrix::short_row == 8, "the network of 19 exchanges sorts eight numbers");
    // After the end of the row the network gets larger numbers without repetition.
    auto const at = [&](Index k) { return k < length ? row[k] : INT32_MAX - k; };
    Index a = at(0), b = at(1), c = at(2), d = at(3), e = at(4), f = at(5), g = at(6), h = at(7);
    put_in_order(a, c), put_in_order(b, d), put_in_order(e, g), put_in_order(f, h);
    put_in_order(a, e), put_in_order(b, f), put_in_order(c, g), put_in_order(d, h);
    put_in_order(a, b), put_in_order(c, d), put_in_order(e, f), put_in_order(g, h);
    put_in_order(c, e), put_in_order(d, f);
    put_in_order(b, e), put_in_order(d, g);
    put_in_order(b, c), put_in_order(d, e), put_in_order(f, g);
    Index const sorted[] = {a, b, c, d, e, f, g, h};
    for (Index k = 0; k < Matrix::short_row; ++k) row[k] = sorted[k];
    return (a == b) | (b == c) | (c == d) | (d == e) | (e == f) | (f == g) | (g == h);
}

void sort_row(Span<Index> row) noexcept {
    sort(row, [](Index a, Index b) { return a < b; });
}

// Removes repeated columns: across a periodic pair two points may share cells on both sides.
// Returns the number of distinct columns.
Offset drop_repeats(Span<Index> row) noexcept {
    Size n = 0;
    for (Size i = 0; i < row.size(); ++i) {
        if (i == 0 || row[i] != row[i - 1]) row[n++] = row[i];
    }
    return static_cast<Offset>(n);
}

// Calls visit(unknown) for the unknowns of rotated points, and for all that share a cell with one;
// some are visited repeatedly.
template <class Visit>
void for_each_beside_rotated(Graph const& graph, Span<const Index> times,
                             Visit const& visit) noexcept {
    for (Index point = 0; point < times.count(); ++point) {
        if (times[point] == 0 || graph.unknown[point] == none) continue;
        visit(graph.unknown[point]);
        for (Index const neighbour : graph.neighbours(graph.unknown[point])) visit(neighbour);
    }
}

}  // namespace

Matrix::Sizes Matrix::count(Graph const& graph, MatrixKind kind,
                            Periodicity const& periodicity) noexcept {
    Sizes sizes{graph.start[graph.n] / 2, graph.couplings, graph.fixed, kind,
                periodicity.rotation.any};
    for_each_beside_rotated(graph, periodicity.times, [&](Index) { ++sizes.fixed; });
    return sizes;
}

void Matrix::lay_out(Arena& arena, Index n_points, Index unknowns, Index wall_points,
                     Sizes const& sizes) noexcept {
    n = unknowns;
    lay_out_rows(arena, n_points, sizes.kind);
    arena.take(diagonal, n);
    arena.take(row_sum, n);
    arena.take(row_sum_imaginary, is_complex() ? n : 0);
    arena.take(start, Offset{n} + 1);
    // Rows are written and searched beyond their end.
    arena.take(column, sizes.entries + short_row);
    arena.take(value, sizes.entries);
    arena.take(imaginary, is_complex() ? sizes.entries : 0);
    arena.take(coupling_start, Offset{components()} * wall_points + 1);
    arena.take(coupling_row, sizes.couplings);
    arena.take(coupling_value, sizes.couplings);
    arena.take(coupling_imaginary, is_complex() ? sizes.couplings : 0);
    arena.take(fixed_row, sizes.fixed);
    arena.take(fixed_value, sizes.fixed);
    arena.take(fixed_imaginary, kind() != MatrixKind::real ? sizes.fixed : 0);
    lay_out_directions(arena, n_points, sizes.rotates);
}

void Matrix::fit(Index unknowns, Index wall_points, Sizes const& sizes) noexcept {
    auto const shorten = [](auto& array, Offset count) {
        if (!array.empty()) array = array.first(count);
    };
    n = unknowns;
    shorten(diagonal, n);
    shorten(row_sum, n);
    shorten(row_sum_imaginary, n);
    shorten(start, Offset{n} + 1);
    shorten(column, sizes.entries + short_row);
    shorten(value, sizes.entries);
    shorten(imaginary, sizes.entries);
    shorten(coupling_start, Offset{components()} * wall_points + 1);
    shorten(coupling_row, sizes.couplings);
    shorten(coupling_value, sizes.couplings);
    shorten(coupling_imaginary, sizes.couplings);
    shorten(fixed_row, sizes.fixed);
    shorten(fixed_value, sizes.fixed);
    shorten(fixed_imaginary, sizes.fixed);
}

void Matrix::build(Span<const Index> representative, Graph const& graph, Span<const Index> order,
                   Span<const Index> position, Span<const Index> slot, Span<const Vec2> tangent,
                   Periodicity const& periodicity) noexcept {
    find(representative, graph, position, slot, tangent, periodicity);
    build_rows(graph, order, position);
    build_known_columns(graph, position, slot, periodicity);
}

void Matrix::build_rows(Graph const& graph, Span<const Index> order,
                        Span<const Index> position) noexcept {
    Offset filled = 0;
    Span<Index> const columns = column;
    for (Index row = 0; row < n; ++row) {
        Offset const begin = filled;
        graph.prefetch_neighbours(order, row, n);
        for (Index const neighbour : graph.neighbours(order[row])) {
            Index const later = position[neighbour];
            columns[filled] = later;
            filled += later > row ? 1 : 0;
        }
        Span<Index> const row_columns = columns.from(begin, filled - begin);
        start[row] = begin;
        if (row_columns.count() <= short_row) {
            if (!sort_short_row(row_columns.data(), row_columns.count())) continue;
        } else {
            sort_row(row_columns);
        }
        filled = begin + drop_repeats(row_columns);
    }
    start[n] = filled;
}

void Matrix::build_known_columns(Graph const& graph, Span<const Index> position,
                                 Span<const Index> slot, Periodicity const& periodicity) noexcept {
    auto const wall_dof = [&](Index dof) {
        Index const on_wall = slot[dof / components()];
        return on_wall != none ? components() * on_wall + dof % components() : none;
    };
    Index n_fixed = 0;
    fill(coupling_start, Index{0});
    graph.for_each_known([&](Index, Index dof) {
        Index const known = wall_dof(dof);
        if (known != none) ++coupling_start[known];
    });
    counts_to_starts(coupling_start);
    graph.for_each_known([&](Index unknown, Index dof) {
        Index const known = wall_dof(dof);
        if (known != none) {
            coupling_row[coupling_start[known]++] = position[unknown];
        } else if (components() == 1 || stands_for_fixed(graph.line[unknown], dof)) {
            fixed_row[n_fixed++] = position[unknown];
        }
    });
    for_each_beside_rotated(graph, periodicity.times,
                            [&](Index unknown) { fixed_row[n_fixed++] = position[unknown]; });
    rewind_starts(coupling_start);
    for (Index known = 0; known + 1 < coupling_start.count(); ++known) {
        sort_row(coupling_row.from(coupling_start[known],
                                   coupling_start[known + 1] - coupling_start[known]));
    }
    fixed_row = fixed_row.first(n_fixed);
    sort_row(fixed_row);
}

// Two points with two dofs each make several pairs of dofs; only the first pair makes an entry of
// fixed_row.
bool Matrix::stands_for_fixed(Index dof, Index other_dof) const noexcept {
    Index const point = dof / 2, other = other_dof / 2;
    bool const first_pair = dof % 2 == 0 && other_dof % 2 == (row_of(2 * other) == none ? 0 : 1);
    return first_pair && is_beside_fixed(point, other);
}

bool Matrix::is_beside_fixed(Index point, Index other) const noexcept {
    if (row_of(components() * point) < 0 ||
        row_of(components() * point) == row_of(components() * other))
        return false;
    if (row_of(components() * other) == none) return true;
    return couples_xy() && slips(point) && slips(other) && may_differ(point, other);
}

}  // namespace harmorph
