#include "bspline/curve_refinement.hpp"

namespace harmorph {

bool has_periodic_points(Curve const& curve) noexcept {
    Index const p = curve.degree, n = curve.n_indices - p;
    if (curve.indices == nullptr || n < 1) return false;
    Real const period = curve.end() - curve.begin();
    for (Index k = 0; k < p; ++k) {
        if (curve.indices[k] != curve.indices[k + n]) return false;
    }
    for (Index k = 0; k <= 2 * p; ++k) {
        if (!(abs(curve.knots[k + n] - curve.knots[k] - period) <= 1e-12 * period)) return false;
    }
    return true;
}

Status CurveRefinement::check(Curve const& old, Fault& fault) const noexcept {
    if (elevates) {
        if (old.degree < max_degree) return Status::ok;
        return fault.refuse(
            Status::bad_curve,
            "the degree of curve # cannot be raised, because @ is the largest degree",
            curve_item(curve), plain(old.degree));
    }
    bool const periodic = has_periodic_points(old);
    for (Index k = 0; k < knots.count(); ++k) {
        Real const u = knots[k];
        bool const inside =
            is_finite(u) && (u > old.begin() || (periodic && u == old.begin())) && u < old.end();
        if (!inside) {
            return fault.refuse(Status::bad_argument,
                                "knot # to be inserted, ~, is not inside the range of curve @",
                                knot_item(k), curve_item(curve), u);
        }
        Index fold = 0;
        for (Real const other : knots) fold += other == u ? 1 : 0;
        for (Index i = 0; i < old.n_indices + old.degree + 1; ++i)
            fold += old.knots[i] == u ? 1 : 0;
        if (fold > old.degree) {
            return fault.refuse(
                Status::bad_curve,
                "knot #, ~, would be repeated @ times, more often than the degree allows",
                knot_item(k), plain(fold), u);
        }
    }
    return Status::ok;
}

// A knot is inserted with its images one period before and after it; a raised degree at most
// doubles the knots.
Index CurveRefinement::max_knots(Curve const& old) const noexcept {
    Index const n = old.n_indices + old.degree + 1;
    return max_order + (elevates ? 2 * n : n + 3 * knots.count());
}

}  // namespace harmorph
