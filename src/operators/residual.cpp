#include "harmorph/operators/residual.hpp"

#include "residual_table.hpp"

namespace harmorph {
namespace {

constexpr Index most_subtrees = 64;    // the norms of each are on the stack
constexpr Index least_subtree = 1024;  // rows that are worth a task

// Every coupling waits for its row; no row waits.
void begin_to_wait(Residual const& work, Matrix const& matrix) noexcept {
    fill(work.latest, none);
    Index const couplings = matrix.coupling_start[matrix.coupling_start.size() - 1];
    for (Index c = 0; c < couplings; ++c) {
        Index& list = work.latest[matrix.coupling_row[c]];
        work.next[matrix.n + c] = list;
        list = matrix.n + c;
    }
}

// Rows that have been left over by a subtree wait for rows behind the subtrees.
void go_on_waiting(Residual const& work, Matrix const& matrix, Index left_over) noexcept {
    for (Index row = left_over; row != none;) {
        Index const next = work.next[row];
        Index& list = work.latest[matrix.column[matrix.start[row] + work.passed[row]]];
        work.next[row] = list;
        list = row;
        row = next;
    }
}

template <class To>
void find_balances(Residual const& work, Matrix const& matrix, DofValues const& dofs, Index first, Index n, To* value,
                   Residual::Norms& norms) noexcept {
    SubtreeRanges const& subtrees = work.subtrees;
    auto const find = residual_kernels<To>(work.kernel).find_balances;
    begin_to_wait(work, matrix);
    Residual::Norms norms_of[most_subtrees];
    Index left_over[most_subtrees];
    work.executor.for_each(subtrees.count, [&](Index i) {
        BalancedRows its{subtrees.subtree[i], subtrees.subtree[i].end};
        find(work, matrix, dofs, first, n, its, value, norms_of[i]);
        left_over[i] = its.left_over;
    });
    for (Index i = 0; i < subtrees.count; ++i) {
        norms.add(norms_of[i], n);
        go_on_waiting(work, matrix, left_over[i]);
    }
    subtrees.for_each_between(matrix.n, [&](PositionRange rows) {
        BalancedRows its{rows, matrix.n};
        find(work, matrix, dofs, first, n, its, value, norms);
    });
}

// Balances where x and y are coupled: two dofs a point.
class TurnedBalances {
public:
    TurnedBalances(Matrix const& matrix, DofValues const& dofs, Index first, Index n, Index width,
                   Span<Real> value) noexcept
        : matrix_(matrix), dofs_(dofs), first_(first), n_(n), width_(width), value_(value) {}

    Residual::Norms run() const noexcept {
        Residual::Norms norms;
        fill(value_, 0.0);
        take_right_hand_sides(norms.right_hand_side);
        add_turned_flows(norms.rest);
        return norms;
    }

private:
    Real* row_of(Index position) const noexcept { return value_.data() + Offset{position} * width_; }
    const Real* at(Index position) const noexcept { return dofs_.at(position) + first_; }

    // row -= entry x
    void subtract(Real entry, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n_; ++k) row[k] -= entry * x[k];
    }
    // What flows from x to own along a coupling: row -= entry (x - own)
    void take_flow(Real entry, const Real* own, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n_; ++k) row[k] -= entry * (x[k] - own[k]);
    }
    void add_squares(const Real* row, Real* sums) const noexcept {
        for (Index k = 0; k < n_; ++k) sums[k] += row[k] * row[k];
    }

    // Adds up the squares of right-hand sides; leaves their sources in the rows.
    void take_right_hand_sides(Real* squares) const noexcept {
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = dofs_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1]; ++c) {
                subtract(matrix_.coupling_value[c], known, row_of(matrix_.coupling_row[c]));
            }
        }
        for (Index const i : matrix_.coupling_row) {
            add_squares(row_of(i), squares);
            fill(Span<Real>(row_of(i), static_cast<Size>(n_)), 0.0);
        }
        if (dofs_.source == nullptr) return;
        for (Index i = 0; i < matrix_.n; ++i) {
            for (Index k = 0; k < n_; ++k) row_of(i)[k] = dofs_.source_at(i)[first_ + k];
            add_squares(row_of(i), squares);
        }
    }

    struct Dof {
        Index point, component;
    };
    Dof dof_at(Index position) const noexcept { return {dofs_.of[position] / 2, dofs_.of[position] % 2}; }
    bool slips(Index point) const noexcept { return matrix_.row_of[2 * point + 1] == none; }
    const Real* of_dof(Index point, Index component) const noexcept {
        return dofs_.of_dof(2 * point + component) + first_;
    }

    // The dof of a slipping point has a direction of its own. Flows are computed from displacements along x and y, and
    // only then turned to the dofs: so both end points get the same flow, up to the rounding of the flow itself.
    void add_turned_flows(Real* squares) const noexcept {
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = dofs_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1]; ++c) {
                Index const i = matrix_.coupling_row[c], point = dof_at(i).point;
                Real const along = slips(point) ? component(matrix_.frame[point], wall % 2) : 1;
                const Real* const own = of_dof(point, slips(point) ? 0 : wall % 2);
                Real* const row = row_of(i);
                for (Index k = 0; k < n_; ++k) row[k] -= matrix_.coupling_value[c] * (known[k] - along * own[k]);
            }
        }
        for (Index h = 0; h < matrix_.fixed_row.count(); ++h) {
            add_fixed(matrix_.fixed_row[h], matrix_.fixed_value[h], matrix_.fixed_imaginary[h]);
        }
        for (Index i = 0; i < matrix_.n; ++i) {
            for (Offset e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e) {
                add_entry(i, matrix_.column[e], matrix_.value[e]);
            }
        }
        for (Index i = 0; i < matrix_.n; ++i) add_squares(row_of(i), squares);  // any entry may change any row
    }
    static Real component(Vec2 of, Index number) noexcept { return number == 0 ? of.x : of.y; }

    // i: the position of a point's first dof.
    void add_fixed(Index i, Real re, Real im) const noexcept {
        Index const point = dof_at(i).point;
        const Real* const x = of_dof(point, 0);
        subtract(-re, x, row_of(i));
        if (slips(point)) return;
        const Real* const y = of_dof(point, 1);
        Real* const second = row_of(matrix_.row_of[2 * point + 1]);
        subtract(im, y, row_of(i));
        subtract(-re, y, second);
        subtract(-im, x, second);
    }

    void add_entry(Index i, Index j, Real entry) const noexcept {
        Dof const a = dof_at(i), b = dof_at(j);
        if (slips(a.point) != slips(b.point)) {
            return slips(a.point) ? add_slipping(i, j, entry) : add_slipping(j, i, entry);
        }
        if (slips(a.point) && matrix_.turns(a.point, b.point)) {  // the rest of this coupling is in fixed_value
            subtract(entry, at(j), row_of(i));
            subtract(entry, at(i), row_of(j));
            return;
        }
        take_flow(entry, of_dof(a.point, b.component), at(j), row_of(i));
        take_flow(entry, of_dof(b.point, a.component), at(i), row_of(j));
    }

    // Between a point that slips and one dof of a point that does not. The conductance and circulation of the two
    // points, turned by the slip direction, are the entries of the two dofs of the free point.
    void add_slipping(Index slipping, Index free, Real entry) const noexcept {
        Dof const dof = dof_at(free);
        Vec2 const along = matrix_.frame[dof_at(slipping).point];
        const Real* const slid = at(slipping);
        const Real* const x = of_dof(dof.point, 0);
        const Real* const y = of_dof(dof.point, 1);
        Real* const own = row_of(slipping);
        Real* const same = row_of(free);
        Real* const other = row_of(matrix_.row_of[2 * dof.point + 1 - dof.component]);
        Real const across = dof.component == 0 ? entry : -entry;
        for (Index k = 0; k < n_; ++k) {
            Vec2 const rise{along.x * slid[k] - x[k], along.y * slid[k] - y[k]};
            own[k] += entry * component(rise, dof.component);
            same[k] -= entry * dot(along, rise);
            other[k] -= across * cross(along, rise);
        }
    }

    Matrix const& matrix_;
    DofValues const& dofs_;
    Index first_, n_, width_;
    Span<Real> value_;
};

// Adds the chosen columns of the rows `from` to F.
template <class Number>
Residual::Changes add_rows(Matrix const& matrix, DofValues const& dofs, const Number* from, Index width, Index first,
                           Index n, Residual::Choice const& chosen) noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Offset const plane = dofs.columns(matrix);
    Real change[Residual::widest] = {}, size[Residual::widest] = {};
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p, from += width) {
            Real* const to = dofs.at(i) + p * plane + first;
            for (Index k = 0; k < n; ++k) {
                Real const correction = static_cast<Real>(from[k]);
                to[k] = chosen.column[k] ? to[k] + correction : to[k];
                change[k] = larger(change[k], absolute(correction));
                size[k] = larger(size[k], absolute(to[k]));
            }
        }
    }
    Residual::Changes out;
    for (Index k = 0; k < n; ++k) out.column[k] = size[k] > 0 ? change[k] / size[k] : 0;
    return out;
}

// See Residual::beside_entries. Column 0 of `rows` has the residuals; column 1 is used for the sums of absolute
// entries.
template <class Number>
Real beside_entries_in(Matrix const& matrix, DofValues const& dofs, Index column, Number* rows, Index width) noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    auto const row_of = [&](Index i) { return rows + Offset{i} * planes * width; };
    auto const add = [&](Index i, Real size) { row_of(i)[1] += static_cast<Number>(size); };
    auto const size = [&](Span<Real> re, Span<Real> im, Offset e) {
        return absolute(re[e]) + (planes == 2 ? absolute(im[e]) : 0);
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
        for (Index p = 0; p < planes; ++p) largest = larger(largest, absolute(values[p * plane + column]));
    };
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) look(dofs.wall(wall));
    for (Index i = 0; i < matrix.n; ++i) look(dofs.at(i));
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p) {
            Real const left = absolute(static_cast<Real>(row_of(i)[p * width]));
            if (left == 0) continue;
            Real const relative = left / (static_cast<Real>(row_of(i)[1]) * largest);
            if (!(relative < infinity)) return infinity;
            worst = larger(worst, relative);
        }
    }
    return worst;
}

}  // namespace

void Residual::lay_out(Arena& arena, Index unknowns, Index couplings, MatrixKind kind, Index n_columns,
                       Precision precision) noexcept {
    width = n_columns;
    Offset const numbers = Offset{unknowns} * (kind == MatrixKind::complex ? 2 * width : width);
    arena.take(value, precision == Precision::in_double ? numbers : 0);
    arena.take(single, precision == Precision::in_single ? numbers : 0);
    bool const waits = kind != MatrixKind::coupled_xy;
    arena.take(latest, waits ? unknowns : 0);
    arena.take(next, waits ? Offset{unknowns} + couplings : 0);
    arena.take(passed, waits ? unknowns : 0);
}

void Residual::share_out(AssemblyTree const& tree, Executor const& by) noexcept {
    Index const rows = tree.count > 0 ? tree.nodes[tree.count - 1].end : 0;
    executor = by;
    subtrees.choose(tree, larger(rows / 16, least_subtree), most_subtrees);
}

Real Residual::Norms::relative(Index k) const noexcept {
    return square_root(rest[k]) / (right_hand_side[k] > 0 ? square_root(right_hand_side[k]) : 1);
}

void Residual::Norms::add(Norms const& of_other_rows, Index n) noexcept {
    for (Index k = 0; k < n; ++k) {
        right_hand_side[k] += of_other_rows.right_hand_side[k];
        rest[k] += of_other_rows.rest[k];
    }
}

Residual::Norms Residual::compute(Matrix const& matrix, DofValues const& dofs, Index first, Index n) const noexcept {
    if (matrix.kind == MatrixKind::coupled_xy) return TurnedBalances(matrix, dofs, first, n, width, value).run();
    Norms norms;
    if (single.empty()) {
        find_balances(*this, matrix, dofs, first, n, value.data(), norms);
    } else {
        find_balances(*this, matrix, dofs, first, n, single.data(), norms);
    }
    return norms;
}

Residual::Norms Residual::measure(Matrix const& matrix, DofValues const& dofs, Index first, Index n) const noexcept {
    Norms norms;
    find_balances(*this, matrix, dofs, first, n, static_cast<Real*>(nullptr), norms);
    return norms;
}

Real Residual::beside_entries(Matrix const& matrix, DofValues const& dofs, Index column) const noexcept {
    compute(matrix, dofs, column, 1);
    if (single.empty()) return beside_entries_in(matrix, dofs, column, value.data(), width);
    return beside_entries_in(matrix, dofs, column, single.data(), width);
}

Residual::Changes Residual::add_to(Matrix const& matrix, DofValues const& dofs, Index first, Index n,
                                   Choice const& chosen) const noexcept {
    if (single.empty()) return add_rows(matrix, dofs, value.data(), width, first, n, chosen);
    return add_rows(matrix, dofs, single.data(), width, first, n, chosen);
}

}  // namespace harmorph
