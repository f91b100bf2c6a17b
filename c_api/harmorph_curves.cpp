// The C interface: curves and their fit.
#include "call.hpp"
#include "base/range.hpp"
#include "bspline/fit.hpp"
#include "bspline/projection.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// One curve of the caller's set, checked.
Status open_curve(const hm_curves* curves, Index number, Curve& curve, CallFault& fault) noexcept {
    CurvesView view;
    HARMORPH_TRY(view_curves(curves, view, fault));
    if (number < 0 || number >= view.count()) {
        return fault.refuse(Status::bad_argument, "there is no curve #; the set has @",
                            curve_item(number), plain(view.count()));
    }
    HARMORPH_TRY(view.curve(number, curve, fault));
    return check_curve(curve, number, fault);
}

Status check_parameter(Curve const& curve, Real u, Index n_derivatives, Fault& fault) noexcept {
    if (n_derivatives < 0 || n_derivatives > max_degree) {
        return fault.refuse(Status::bad_argument, "n_derivatives must be between 0 and 5, not #",
                            plain(n_derivatives));
    }
    if (is_between(curve.begin(), u, curve.end())) return Status::ok;
    return fault.refuse(Status::bad_argument, "the parameter ~ is outside the curve", {}, {}, u);
}

// The block of a fit: the caller's structs, then the core's arrays.
struct FitBlock {
    Span<hm_curves> set;
    Span<hm_curve> curve;
    Fit fit;

    void lay_out(Arena& arena, Index n, FitOptions const& options) noexcept {
        arena.take(set, 1);
        arena.take(curve, 2);
        fit.lay_out(arena, n, options);
    }
    const hm_curves* present() const noexcept {
        for (Index i = 0; i < fit.n_curves; ++i) curve[i] = struct_of(fit.curve[i]);
        set[0] = {sizeof(hm_curves),  0,       fit.control.count() / 2,
                  fit.control.data(), nullptr, fit.n_curves,
                  curve.data()};
        return set.data();
    }
};

hm_fit_report report_of(FitReport const& made) noexcept {
    hm_fit_report filled = {};
    filled.max_error = made.max_error;
    filled.rms_error = made.rms_error;
    filled.max_error_point = made.max_error_point;
    filled.closed = static_cast<std::int32_t>(made.closure);
    filled.first_point = made.first_point;
    filled.base_points = made.base_points;
    filled.reason = static_cast<std::int32_t>(made.reason);
    filled.corners = made.corners;
    filled.backtrack_point = made.backtrack_point;
    return filled;
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
        for (Index i = 0; i < view.count(); ++i) {
            HARMORPH_TRY(view.curve(i, curve, fault));
            HARMORPH_TRY(check_curve(curve, i, fault));
        }
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
                                "the point to project is not finite, or beyond 1e100");
        }
        HARMORPH_TRY(open_curve(curves, number, curve, fault));
        Projection const foot = project(curve, {x, y});
        *u = foot.u;
        *distance = foot.distance;
        return Status::ok;
    });
}

hm_status hm_fit_size(int32_t n, const hm_fit_options* options, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        FitOptions asked;
        HARMORPH_TRY(require({{"bytes", bytes}}, fault));
        HARMORPH_TRY(view_fit_options(options, asked, fault));
        HARMORPH_TRY(check_fit(n, asked, fault));
        FitBlock made;
        return count_bytes(bytes, fault, [&](Arena& arena) { made.lay_out(arena, n, asked); });
    });
}

hm_status hm_fit(const hm_curves** curves, void* block, size_t bytes, const hm_points* points,
                 int32_t n, int32_t is_loop, const hm_fit_options* options, hm_fit_report* report,
                 hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Points view;
        FitOptions asked;
        HARMORPH_TRY(require({{"curves", curves}, {"block", block}}, fault));
        HARMORPH_TRY(check_report_if(report, fault));
        HARMORPH_TRY(view_points(points, "points", view, fault));
        HARMORPH_TRY(view_fit_options(options, asked, fault));
        HARMORPH_TRY(check_fit(n, asked, fault));
        FitBlock made;
        FitReport fitted;
        HARMORPH_TRY(
            place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, n, asked); }));
        HARMORPH_TRY(made.fit.run(view, n, is_loop != 0, asked, fitted, fault));
        *curves = made.present();
        if (report != nullptr) write_struct(report_of(fitted), report);
        return fault.status;
    });
}

}  // extern "C"
