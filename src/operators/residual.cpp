#include "operators/residual.hpp"

namespace harmorph {

// Rows whose balances are computed one after the other.
struct BalancedRows {
    PositionRange rows;
    Index limit;  // Rows below this one belong to the task.
    // The list of the rows that are left over for rows after the limit begins here; see
    // Residual::next.
    Index left_over = none;
};

struct ResidualKernels {
    // Computes the balances of these rows for columns first .. first+n-1, and adds their squares to
    // norms. If `stores` is true, the balances are stored in the array of `work` that exists.
    void (*find_balances)(Residual const& work, Matrix const& matrix, DofValues const& dofs,
                          Index first, Index n, BalancedRows& task, bool stores,
                          Residual::Norms& norms) noexcept;
};

}  // namespace harmorph

#define HARMORPH_KERNELS "operators/residual_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

namespace {

class RotatedBalances {
public:
    RotatedBalances(Matrix const& matrix, DofValues const& dofs, Index first, Index n, Index width,
                    Span<Real> value) noexcept
        : matrix_(matrix), dofs_(dofs), first_(first), n_(n), width_(width), value_(value) {}

    Residual::Norms run() const noexcept {
        Residual::Norms norms;
        fill(value_, 0.0);
        take_right_hand_sides(norms.right_hand_side);
        add_rotated_flows(norms.rest);
        return norms;
    }

private:
    Real* row_of(Index position) const noexcept {
        return value_.data() + Offset{position} * width_;
    }
    const Real* at(Index position) const noexcept { return dofs_.at(position) + first_; }

    // Computes row -= entry x.
    void subtract(Real entry, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n_; ++k) row[k] -= entry * x[k];
    }
    // Subtracts the flow from x to own along a coupling: row -= entry (x - own).
    void take_flow(Real entry, const Real* own, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n_; ++k) row[k] -= entry * (x[k] - own[k]);
    }
    void add_squares(const Real* row, Real* sums) const noexcept {
        for (Index k = 0; k < n_; ++k) sums[k] += row[k] * row[k];
    }

    // Adds up the squares of right-hand sides; leaves their sources in the rows.
    void take_right_hand_sides(Real* squares) const noexcept {
        take_sources();
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = dofs_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1];
                 ++c) {
                subtract(matrix_.coupling_value[c], known, row_of(matrix_.coupling_row[c]));
            }
        }
        for (Index i = 0; i < matrix_.n; ++i) add_squares(row_of(i), squares);
        for (Index const i : matrix_.coupling_row)
            fill(Span<Real>(row_of(i), static_cast<Size>(n_)), 0.0);
        take_sources();
    }
    void take_sources() const noexcept {
        for (Index i = 0; i < matrix_.n && dofs_.source != nullptr; ++i) {
            const Real* const source = dofs_.source_at(i);
            for (Index k = 0; k < n_ && source != nullptr; ++k) row_of(i)[k] = source[first_ + k];
        }
    }

    struct Dof {
        Index point, component;
    };
    Dof dof_at(Index position) const noexcept {
        return {dofs_.dof_of_position[position] / 2, dofs_.dof_of_position[position] % 2};
    }
    bool slips(Index point) const noexcept { return matrix_.row_of(2 * point + 1) == none; }
    const Real* values_of_dof(Index point, Index component) const noexcept {
        return dofs_.values_of_dof(2 * point + component) + first_;
    }

    // The dof of a slipping point has a direction of its own. Flows are computed from displacements
    // along x and y, and only then rotated to the dofs, so that both end points get the same flow,
    // up to the rounding of the flow itself.
    void add_rotated_flows(Real* squares) const noexcept {
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = dofs_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1];
                 ++c) {
                Index const i = matrix_.coupling_row[c], point = dof_at(i).point;
                Real const along = slips(point) ? component(matrix_.direction(point), wall % 2) : 1;
                const Real* const own = values_of_dof(point, slips(point) ? 0 : wall % 2);
                Real* const row = row_of(i);
                for (Index k = 0; k < n_; ++k)
                    row[k] -= matrix_.coupling_value[c] * (known[k] - along * own[k]);
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
        // Any entry may change any row, so the squares are added last.
        for (Index i = 0; i < matrix_.n; ++i) add_squares(row_of(i), squares);
    }
    static Real component(Vec2 vector, Index number) noexcept {
        return number == 0 ? vector.x : vector.y;
    }

    // Adds the flow to fixed points; i is the position of a point's first dof.
    void add_fixed(Index i, Real re, Real im) const noexcept {
        Index const point = dof_at(i).point;
        const Real* const x = values_of_dof(point, 0);
        subtract(-re, x, row_of(i));
        if (slips(point)) return;
        const Real* const y = values_of_dof(point, 1);
        Real* const second_row = row_of(matrix_.row_of(2 * point + 1));
        subtract(im, y, row_of(i));
        subtract(-re, y, second_row);
        subtract(-im, x, second_row);
    }

    void add_entry(Index i, Index j, Real entry) const noexcept {
        Dof const a = dof_at(i), b = dof_at(j);
        if (slips(a.point) != slips(b.point)) {
            return slips(a.point) ? add_slipping(i, j, entry) : add_slipping(j, i, entry);
        }
        // The rest of this coupling is in fixed_value.
        if (slips(a.point) && matrix_.may_differ(a.point, b.point)) {
            subtract(entry, at(j), row_of(i));
            subtract(entry, at(i), row_of(j));
            return;
        }
        take_flow(entry, values_of_dof(a.point, b.component), at(j), row_of(i));
        take_flow(entry, values_of_dof(b.point, a.component), at(i), row_of(j));
    }

    // Adds the flow between a point that slips and one dof of a point that does not. The entries of
    // the two dofs of the free point are the conductance and circulation of the two points, rotated
    // by the slip direction.
    void add_slipping(Index slipping, Index free, Real entry) const noexcept {
        Dof const dof = dof_at(free);
        Vec2 const along = matrix_.direction(dof_at(slipping).point);
        const Real* const slid = at(slipping);
        const Real* const x = values_of_dof(dof.point, 0);
        const Real* const y = values_of_dof(dof.point, 1);
        Real* const own = row_of(slipping);
        Real* const same = row_of(free);
        Real* const other = row_of(matrix_.row_of(2 * dof.point + 1 - dof.component));
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

// Stores b - A F for columns first .. first+n-1 of F, n <= width, in value [matrix.n x width].
// Returns the norms.
Residual::Norms find_rotated_balances(Matrix const& matrix, DofValues const& dofs, Index first,
                                      Index n, Index width, Span<Real> value) noexcept {
    return RotatedBalances(matrix, dofs, first, n, width, value).run();
}

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
    auto const find = simd::table_of<ResidualKernels>(work.kernel).find_balances;
    list_couplings(work, matrix);
    Residual::Norms norms;
    Index left_over[max_subtrees];
    work.executor.for_each(subtrees.count, [&](Index i) {
        BalancedRows task{subtrees.subtree[i], subtrees.subtree[i].end};
        work.norms_of_subtree[i] = {};
        find(work, matrix, dofs, first, n, task, stores, work.norms_of_subtree[i]);
        left_over[i] = task.left_over;
    });
    for (Index i = 0; i < subtrees.count; ++i) {
        Residual::Norms const& of_subtree = work.norms_of_subtree[i];
        for (Index k = 0; k < n; ++k) {
            norms.right_hand_side[k] += of_subtree.right_hand_side[k];
            norms.rest[k] += of_subtree.rest[k];
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
    arena.take(norms_of_subtree, waits ? max_subtrees : 0);
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
        return find_rotated_balances(matrix, dofs, first, n, width, value);
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

// Calls rotate(tangent, number of the first dof, number of the second dof) for the numbers of each
// slipping point that is not joined to another one.
template <class Rotate>
void DofDirections::for_each_slipping(DofValues const& values, Index n_points,
                                      Rotate const& rotate) const noexcept {
    if (!matrix_.couples_xy()) return;
    for (Index point = 0; point < n_points; ++point) {
        if (!matrix_.slips(point) || values.dof_of_position[matrix_.row_of(2 * point)] != 2 * point)
            continue;
        Real* const x = values.values_of_dof(2 * point);
        Real* const y = values.values_of_dof(2 * point + 1);
        for (Index k = 0; k < values.length(); ++k) rotate(matrix_.direction(point), x[k], y[k]);
    }
}

void DofDirections::rotate_slipping(DofValues const& values, Index n_points) const noexcept {
    for_each_slipping(values, n_points, [](Vec2 along, Real& x, Real& y) {
        y = along.y * x;
        x = along.x * x;
    });
}

void DofDirections::rotate_slipping_back(DofValues const& values, Index n_points) const noexcept {
    for_each_slipping(values, n_points, [](Vec2 along, Real& x, Real& y) {
        x = along.x * x + along.y * y;
        y = 0;
    });
}

// Calls rotate(factor, number as a complex one) for the numbers of each point on a rotated side.
template <class Rotate>
void DofDirections::for_each_rotated(DofValues const& values, Index n_points,
                                     Rotate const& rotate) const noexcept {
    if (!matrix_.has_rotated_sides()) return;
    Index const n = values.columns(matrix_);
    for (Index point = 0; point < n_points; ++point) {
        Vec2 const factor = matrix_.rotation(point);
        if (matrix_.row_of(point) == none || (factor.x == 1 && factor.y == 0)) continue;
        Real* const re = values.values_of_dof(point);
        for (Index k = 0; k < n; ++k) {
            Vec2 const rotated = rotate(factor, Vec2{re[k], re[n + k]});
            re[k] = rotated.x;
            re[n + k] = rotated.y;
        }
    }
}

void DofDirections::rotate_sides(DofValues const& values, Index n_points) const noexcept {
    for_each_rotated(values, n_points,
                     [](Vec2 factor, Vec2 number) { return product(factor, number); });
}

void DofDirections::rotate_sides_back(DofValues const& values, Index n_points) const noexcept {
    for_each_rotated(values, n_points,
                     [](Vec2 factor, Vec2 number) { return product(conjugate(factor), number); });
}

}  // namespace harmorph
