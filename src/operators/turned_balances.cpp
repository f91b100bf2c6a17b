#include "operators/turned_balances.hpp"

namespace harmorph {
namespace {

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
    // along x and y, and only then turned to the dofs, so that both end points get the same flow,
    // up to the rounding of the flow itself.
    void add_turned_flows(Real* squares) const noexcept {
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
    // the two dofs of the free point are the conductance and circulation of the two points, turned
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

}  // namespace

Residual::Norms find_turned_balances(Matrix const& matrix, DofValues const& dofs, Index first,
                                     Index n, Index width, Span<Real> value) noexcept {
    return TurnedBalances(matrix, dofs, first, n, width, value).run();
}

}  // namespace harmorph
