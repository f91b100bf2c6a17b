#include "operators/matrix.hpp"

#include "base/sort.hpp"

namespace harmorph {
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

// Calls visit(unknown) for the unknowns of turned points, and for all that share a cell with one;
// some are visited repeatedly.
template <class Visit>
void for_each_beside_turned(Graph const& graph, Span<const Index> times,
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
    for_each_beside_turned(graph, periodicity.times, [&](Index) { ++sizes.fixed; });
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
    lay_out_directions(arena, n_points, sizes.turns);
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
    for_each_beside_turned(graph, periodicity.times,
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
