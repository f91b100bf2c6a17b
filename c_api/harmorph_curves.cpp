// The C interface, part 2: curves and their fit.
#include "fault_text.hpp"
#include "harmorph/bspline/fit.hpp"
#include "harmorph/bspline/projection.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// One curve of the caller's set, checked.
Status open_curve(const hm_curves* curves, Index number, Curve& curve, Index& base, Fault& fault) noexcept {
    CurvesView view;
    HARMORPH_TRY(view_curves(curves, view, fault));
    base = view.set.index_base;
    if (number < 0 || number >= view.count()) {
        return fault.refuse(Status::bad_argument, "there is no curve # (from 0); the set has @", Counts::from_zero, number, view.count());
    }
    HARMORPH_TRY(view.curve(number, curve, fault));
    return check_curve(curve, number, fault);
}

Status check_parameter(Curve const& curve, Real u, Index n_derivatives, Fault& fault) noexcept {
    if (n_derivatives < 0 || n_derivatives > max_degree) {
        return fault.refuse(Status::bad_argument, "n_derivatives must be between 0 and 5, not #", Counts::from_zero,
                            n_derivatives);
    }
    if (u >= curve.begin() && u <= curve.end()) return Status::ok;
    return fault.refuse(Status::bad_argument, "the parameter ~ is outside the curve", Counts::from_zero, none, none, u);
}

Status null_argument(Fault& fault) noexcept { return fault.refuse(Status::bad_argument, "an argument is NULL"); }

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
        for (Index i = 0; i < fit.n_curves; ++i) {
            Curve const& its = fit.curve[i];
            curve[i] = {sizeof(hm_curve), its.degree, its.n_indices, its.indices, its.knots};
        }
        set[0] = {sizeof(hm_curves), 0, fit.control.count() / 2, fit.control.data(), nullptr, fit.n_curves, curve.data()};
        return set.data();
    }
};

Status size_fit(Index n, const hm_fit_options* given, size_t* bytes, Fault& fault) noexcept {
    if (bytes == nullptr) return null_argument(fault);
    FitOptions options;
    HARMORPH_TRY(view_fit_options(given, options, fault));
    HARMORPH_TRY(check_fit(n, options, fault));
    Arena counting;
    FitBlock block;
    block.lay_out(counting, n, options);
    HARMORPH_TRY(counting.verify(0, fault));
    *bytes = counting.bytes();
    return Status::ok;
}

Status run_fit(const hm_curves** curves, void* memory, Size bytes, const hm_points* given_points, Index n, bool is_loop,
               const hm_fit_options* given, hm_fit_report* report, Fault& fault) noexcept {
    if (curves == nullptr || memory == nullptr) return null_argument(fault);
    if (report != nullptr) HARMORPH_TRY(check_report(report, fault));
    Points points;
    HARMORPH_TRY(view_points(given_points, "points", points, fault));
    FitOptions options;
    HARMORPH_TRY(view_fit_options(given, options, fault));
    HARMORPH_TRY(check_fit(n, options, fault));
    Arena arena(memory, bytes);
    FitBlock block;
    block.lay_out(arena, n, options);
    HARMORPH_TRY(arena.verify(bytes, fault));
    FitReport made;
    HARMORPH_TRY(block.fit.run(points, n, is_loop, options, made, fault));
    *curves = block.present();
    if (report == nullptr) return Status::ok;
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
    write_struct(filled, report);
    return fault.status;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_curves_check(const hm_curves* curves, hm_error* err) {
    Fault fault;
    CurvesView view;
    if (!failed(view_curves(curves, view, fault))) {
        Curve curve;
        for (Index i = 0; i < view.count() && !failed(fault.status); ++i) {
            if (!failed(view.curve(i, curve, fault))) check_curve(curve, i, fault);
        }
    }
    return tell(err, fault, {0, view.set.index_base});
}

hm_status hm_curve_basis(const hm_curves* curves, int32_t number, double u, int32_t n_derivatives, int32_t* control,
                         double* values, hm_error* err) {
    Fault fault;
    Curve curve;
    Index base = 0;
    if (control == nullptr || values == nullptr) null_argument(fault);
    if (!failed(fault.status) && !failed(open_curve(curves, number, curve, base, fault)) &&
        !failed(check_parameter(curve, u, n_derivatives, fault))) {
        CurveBasis const basis = curve_basis(curve, u, n_derivatives);
        for (Index k = 0; k < basis.order; ++k) {
            control[k] = basis.control[k] + base;
            for (Index d = 0; d <= n_derivatives; ++d) values[d * basis.order + k] = basis.value[d][k];
        }
    }
    return tell(err, fault, {0, base});
}

hm_status hm_curve_point(const hm_curves* curves, int32_t number, double u, int32_t n_derivatives, double* xy, hm_error* err) {
    Fault fault;
    Curve curve;
    Index base = 0;
    if (xy == nullptr) null_argument(fault);
    if (!failed(fault.status) && !failed(open_curve(curves, number, curve, base, fault)) &&
        !failed(check_parameter(curve, u, n_derivatives, fault))) {
        Vec2 point[max_order];
        curve_point(curve, u, n_derivatives, point);
        for (Index d = 0; d <= n_derivatives; ++d) {
            xy[2 * d] = point[d].x;
            xy[2 * d + 1] = point[d].y;
        }
    }
    return tell(err, fault, {0, base});
}

hm_status hm_curve_project(const hm_curves* curves, int32_t number, double x, double y, double* u, double* distance,
                           hm_error* err) {
    Fault fault;
    Curve curve;
    Index base = 0;
    if (u == nullptr || distance == nullptr) null_argument(fault);
    if (!is_finite(x) || !is_finite(y)) fault.refuse(Status::bad_argument, "the point to project is not finite");
    if (!failed(fault.status) && !failed(open_curve(curves, number, curve, base, fault))) {
        Projection const foot = project(curve, {x, y});
        *u = foot.u;
        *distance = foot.distance;
    }
    return tell(err, fault, {0, base});
}

hm_status hm_fit_size(int32_t n, const hm_fit_options* options, size_t* bytes, hm_error* err) {
    Fault fault;
    size_fit(n, options, bytes, fault);
    return tell(err, fault);
}

hm_status hm_fit(const hm_curves** curves, void* block, size_t bytes, const hm_points* points, int32_t n, int32_t is_loop,
                 const hm_fit_options* options, hm_fit_report* report, hm_error* err) {
    Fault fault;
    run_fit(curves, block, bytes, points, n, is_loop != 0, options, report, fault);
    return tell(err, fault);
}

}  // extern "C"
