// The results of hm_fit and hm_fit_marker: a set of curves inside the caller's block, and the
// report. tests/c_api/test_fit_marker.cpp covers this file.
#pragma once

#include "views.hpp"

#include "bspline/fit.hpp"

namespace harmorph {

// The structs that the caller receives for a set of fitted curves, index_base 0.
struct FittedSet {
    Span<hm_curves> set;
    Span<hm_curve> curve;

    void lay_out(Arena& arena, Offset n_curves) noexcept {
        arena.take(set, 1);
        arena.take(curve, n_curves);
    }
    const hm_curves* present(Span<Real> control, Index n_curves) const noexcept {
        set[0] = {sizeof(hm_curves), 0,        control.count() / 2, control.data(),
                  nullptr,           n_curves, curve.data()};
        return set.data();
    }
};

inline hm_fit_report report_of(FitReport const& fitted, Index n_pieces) noexcept {
    hm_fit_report filled = {};
    filled.max_error = fitted.max_error;
    filled.rms_error = fitted.rms_error;
    filled.max_error_point = fitted.max_error_point;
    filled.closed = static_cast<std::int32_t>(fitted.closure);
    filled.first_point = fitted.first_point;
    filled.base_points = fitted.base_points;
    filled.corners = fitted.corners;
    filled.backtrack_point = fitted.backtrack_point;
    filled.pieces = n_pieces;
    filled.departure_point = fitted.departure_point;
    filled.max_departure = fitted.max_departure;
    return filled;
}

}  // namespace harmorph
