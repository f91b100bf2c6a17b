#include "operators/residual.hpp"

#include "operators/residual_table.hpp"
#include "operators/turned_balances.hpp"

namespace harmorph {
namespace {

constexpr Index max_subtrees = 64;
// A task treats at least so many rows.
constexpr Index min_subtree_rows = 1024;

// Enters every coupling in the list of its row; no row is in a list.
void list_couplings(Residual const& work, Matrix const& matrix) noexcept {
    fill(work.latest, none);
    Index const couplings = matrix.coupling_start[matrix.coupling_start.size() - 1];
    for (Index c = 0; c < couplings; ++c) {
        Index& list = work.latest[matrix.coupling_row[c]];
        work.next[matrix.n + c] = list;
        list = matrix.n + c;
    }
}

// Moves rows that a subtree has left over to the lists of rows after the subtrees.
void list_rows_left_over(Residual const& work, Matrix const& matrix, Index left_over) noexcept {
    for (Index row = left_over; row != none;) {
        Index const next = work.next[row];
        Index& list = work.latest[matrix.column[matrix.start[row] + work.passed[row]]];
        work.next[row] = list;
        list = row;
        row = next;
    }
}

Residual::Norms find_balances(Residual const& work, Matrix const& matrix, DofValues const& dofs,
                              Index first, Index n, bool stores) noexcept {
    SubtreeRanges const& subtrees = work.subtrees;
    auto const find = residual_kernels(work.kernel).find_balances;
    list_couplings(work, matrix);
    Residual::Norms norms;
    Index left_over[max_subtrees];
    work.executor.for_each(subtrees.count, [&](Index i) {
        BalancedRows task{subtrees.subtree[i], subtrees.subtree[i].end};
        Residual::Norms of_subtree;
        find(work, matrix, dofs, first, n, task, stores, of_subtree);
        Real* const numbers = work.norms_of_subtree(i);
        for (Index k = 0; k < n; ++k) {
            numbers[2 * k] = of_subtree.right_hand_side[k];
            numbers[2 * k + 1] = of_subtree.rest[k];
        }
        left_over[i] = task.left_over;
    });
    for (Index i = 0; i < subtrees.count; ++i) {
        const Real* const numbers = work.norms_of_subtree(i);
        for (Index k = 0; k < n; ++k) {
            norms.right_hand_side[k] += numbers[2 * k];
            norms.rest[k] += numbers[2 * k + 1];
        }
        list_rows_left_over(work, matrix, left_over[i]);
    }
    subtrees.for_each_between(matrix.n, [&](PositionRange rows) {
        BalancedRows task{rows, matrix.n};
        find(work, matrix, dofs, first, n, task, stores, norms);
    });
    return norms;
}

// Adds the chosen columns of the rows `from` to F.
Residual::Changes add_rows(Matrix const& matrix, DofValues const& dofs, const Real* from,
                           Index width, Index first, Index n,
                           Residual::Choice const& chosen) noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Offset const plane = dofs.columns(matrix);
    Real change[Residual::max_width] = {}, size[Residual::max_width] = {};
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p, from += width) {
            Real* const to = dofs.at(i) + p * plane + first;
            for (Index k = 0; k < n; ++k) {
                Real const correction = from[k];
                to[k] = chosen.column[k] ? to[k] + correction : to[k];
                change[k] = max(change[k], abs(correction));
                size[k] = max(size[k], abs(to[k]));
            }
        }
    }
    Residual::Changes out;
    for (Index k = 0; k < n; ++k) out.column[k] = size[k] > 0 ? change[k] / size[k] : 0;
    return out;
}

// See Residual::backward_error(). Column 0 of `rows` has the residuals; column 1 receives the sums
// of absolute entries.
Real backward_error_in(Matrix const& matrix, DofValues const& dofs, Index column, Real* rows,
                       Index width) noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    auto const row_of = [&](Index i) { return rows + Offset{i} * planes * width; };
    auto const add = [&](Index i, Real size) { row_of(i)[1] += size; };
    auto const size = [&](Span<Real> re, Span<Real> im, Offset e) {
        return abs(re[e]) + (planes == 2 ? abs(im[e]) : 0);
    };
    for (Index i = 0; i < matrix.n; ++i) row_of(i)[1] = 0;
    for (Index i = 0; i < matrix.n; ++i) {
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            Real const entry_size = size(matrix.value, matrix.imaginary, e);
            add(i, entry_size);
            add(matrix.column[e], entry_size);
        }
    }
    for (Index c = 0; c < matrix.coupling_row.count(); ++c) {
        add(matrix.coupling_row[c], size(matrix.coupling_value, matrix.coupling_imaginary, c));
    }
    for (Index h = 0; h < matrix.fixed_row.count(); ++h) {
        add(matrix.fixed_row[h], size(matrix.fixed_value, matrix.fixed_imaginary, h));
    }
    Real largest = 0, worst = 0;
    Offset const plane = dofs.columns(matrix);
    auto const look = [&](const Real* values) {
        for (Index p = 0; p < planes; ++p) largest = max(largest, abs(values[p * plane + column]));
    };
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) look(dofs.wall(wall));
    for (Index i = 0; i < matrix.n; ++i) look(dofs.at(i));
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p) {
            Real const left = abs(row_of(i)[p * width]);
            if (left == 0) continue;
            Real const relative = left / (row_of(i)[1] * largest);
            if (!(relative < infinity)) return infinity;
            worst = max(worst, relative);
        }
    }
    return worst;
}

}  // namespace

void Residual::lay_out(Arena& arena, Index unknowns, Index couplings, MatrixKind kind,
                       Index n_columns) noexcept {
    width = n_columns;
    Offset const numbers = Offset{unknowns} * (kind == MatrixKind::complex ? 2 * width : width);
    arena.take(value, numbers);
    bool const waits = kind != MatrixKind::coupled_xy;
    arena.take(latest, waits ? unknowns : 0);
    arena.take(next, waits ? Offset{unknowns} + couplings : 0);
    arena.take(passed, waits ? unknowns : 0);
    arena.take(norms, waits ? 2 * max_subtrees * width : 0);
}

void Residual::choose_subtrees(AssemblyTree const& tree, Executor const& by) noexcept {
    Index const rows = tree.count > 0 ? tree.nodes[tree.count - 1].end : 0;
    executor = by;
    subtrees.choose(tree, max(rows / 16, min_subtree_rows), max_subtrees);
}

Real Residual::Norms::relative(Index k) const noexcept {
    return sqrt(rest[k]) / (right_hand_side[k] > 0 ? sqrt(right_hand_side[k]) : 1);
}

Residual::Norms Residual::compute(Matrix const& matrix, DofValues const& dofs, Index first,
                                  Index n) const noexcept {
    if (matrix.kind() == MatrixKind::coupled_xy)
        return find_turned_balances(matrix, dofs, first, n, width, value);
    return find_balances(*this, matrix, dofs, first, n, true);
}

Residual::Norms Residual::measure(Matrix const& matrix, DofValues const& dofs, Index first,
                                  Index n) const noexcept {
    return find_balances(*this, matrix, dofs, first, n, false);
}

Real Residual::backward_error(Matrix const& matrix, DofValues const& dofs,
                              Index column) const noexcept {
    compute(matrix, dofs, column, 1);
    return backward_error_in(matrix, dofs, column, value.data(), width);
}

Residual::Changes Residual::add_to(Matrix const& matrix, DofValues const& dofs, Index first,
                                   Index n, Choice const& chosen) const noexcept {
    return add_rows(matrix, dofs, value.data(), width, first, n, chosen);
}

}  // namespace harmorph
