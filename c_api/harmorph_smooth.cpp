// The C interface: smooth gradients.
#include "base/vec2.hpp"
#include "bspline/smooth_gradient.hpp"
#include "call.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

constexpr Real max_lengths = 1e6;  // of the extent of the control points

struct SmoothedCurves {
    CurvesView view;
    Index n_spans = 0, degree = 1, n_control = 0;
    Box box;  // of the control points that the curves use

    Status open(const hm_curves* curves, CallFault& fault) noexcept {
        HARMORPH_TRY(view_curves(curves, view, fault));
        Offset spans = 0;
        for (Index number = 0; number < view.count(); ++number) {
            Curve curve;
            HARMORPH_TRY(view.checked_curve(number, curve, fault));
            for (Index k = 0; k < curve.n_indices; ++k) box.include(curve.point(k));
            spans += curve.n_indices - curve.degree;
            degree = max(degree, curve.degree);
            n_control = curve.n_control;
        }
        n_spans = static_cast<Index>(spans);
        return Status::ok;
    }
    Real extent() const noexcept { return box.extent(); }
    void lay_out(Arena& arena, SmoothGradient& smooth) const noexcept {
        smooth.lay_out(arena, n_control, n_spans, degree);
    }
};

Status check_gradient(const double* gradient, Index n_control, CallFault& fault) noexcept {
    for (Index i = 0; i < 2 * n_control; ++i) {
        if (is_finite(gradient[i])) continue;
        return fault.refuse(Status::bad_argument,
                            "gradient: the derivative by control point # is not finite",
                            control_point_item(i / 2));
    }
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_smooth_gradient(const hm_curves* curves, double length, const double* gradient,
                             double* smoothed, hm_memory* memory, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        SmoothedCurves set;
        SmoothGradient smooth;
        HARMORPH_TRY(set.open(curves, fault));
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { set.lay_out(arena, smooth); }));
        HARMORPH_TRY(require({{"gradient", gradient}, {"smoothed", smoothed}}, fault));
        if (!is_at_most(length, max_lengths * set.extent()) || length < 0) {
            return fault.refuse(Status::bad_argument,
                                "length must be between 0 and 1e6 times the extent of the curves, "
                                "not ~",
                                {}, {}, length);
        }
        HARMORPH_TRY(check_gradient(gradient, set.n_control, fault));
        smooth.start();
        for (Index number = 0; number < set.view.count(); ++number) {
            Curve curve;
            HARMORPH_TRY(set.view.curve(number, curve, fault));
            smooth.add(curve);
        }
        smooth.solve(length, gradient, smoothed);
        return fault.status;
    });
}

}  // extern "C"
