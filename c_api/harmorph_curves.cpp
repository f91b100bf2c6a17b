// The C interface: evaluation of curves.
#include "base/vec2.hpp"
#include "bspline/projection.hpp"
#include "call.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// Opens one curve of the caller's set and checks it.
Status open_curve(const hm_curves* curves, Index number, Curve& curve, CallFault& fault) noexcept {
    CurvesView view;
    HARMORPH_TRY(view_curves(curves, view, fault));
    return view.checked_curve(number, curve, fault);
}

Status check_parameter(Curve const& curve, Real u, Index n_derivatives, Fault& fault) noexcept {
    if (n_derivatives < 0 || n_derivatives > max_degree) {
        return fault.refuse(Status::bad_argument, "n_derivatives must be between 0 and 5, not #",
                            plain(n_derivatives));
    }
    if (is_between(curve.begin(), u, curve.end())) return Status::ok;
    return fault.refuse(Status::bad_argument,
                        "u is ~, which is outside the range of the parameter of the curve", {}, {},
                        u);
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_curves_check(const hm_curves* curves, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        CurvesView view;
        HARMORPH_TRY(view_curves(curves, view, fault));
        Curve curve;
        for (Index i = 0; i < view.count(); ++i) HARMORPH_TRY(view.checked_curve(i, curve, fault));
        return fault.status;
    });
}

hm_status hm_curve_basis(const hm_curves* curves, int32_t number, double u, int32_t n_derivatives,
                         int32_t* control, double* values, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Curve curve;
        HARMORPH_TRY(require({{"control", control}, {"values", values}}, fault));
        HARMORPH_TRY(open_curve(curves, number, curve, fault));
        HARMORPH_TRY(check_parameter(curve, u, n_derivatives, fault));
        CurveBasis const basis = curve_basis(curve, u, n_derivatives);
        for (Index k = 0; k < basis.order; ++k) {
            control[k] = numbered(basis.control[k], curve.index_base);
            for (Index d = 0; d <= n_derivatives; ++d)
                values[d * basis.order + k] = basis.value[d][k];
        }
        return Status::ok;
    });
}

hm_status hm_curve_point(const hm_curves* curves, int32_t number, double u, int32_t n_derivatives,
                         double* xy, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Curve curve;
        HARMORPH_TRY(require({{"xy", xy}}, fault));
        HARMORPH_TRY(open_curve(curves, number, curve, fault));
        HARMORPH_TRY(check_parameter(curve, u, n_derivatives, fault));
        Vec2 point[max_order];
        curve_point(curve, u, n_derivatives, point);
        for (Index d = 0; d <= n_derivatives; ++d) {
            xy[2 * d] = point[d].x;
            xy[2 * d + 1] = point[d].y;
        }
        return Status::ok;
    });
}

hm_status hm_curve_project(const hm_curves* curves, int32_t number, double x, double y, double* u,
                           double* distance, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Curve curve;
        HARMORPH_TRY(require({{"u", u}, {"distance", distance}}, fault));
        if (!is_coordinate({x, y})) {
            return fault.refuse(Status::bad_argument,
                                "x or y of the point to project is not finite or beyond 1e100");
        }
        HARMORPH_TRY(open_curve(curves, number, curve, fault));
        Projection const foot = project(curve, {x, y});
        *u = foot.u;
        *distance = foot.distance;
        return Status::ok;
    });
}

}  // extern "C"
