// The C interface: fits another airfoil on the knots of a curve.
#include "bspline/refit.hpp"
#include "call.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// The curve of an airfoil in the caller's set, and its blunt base if it has one.
struct AirfoilCurves {
    CurvesView view;
    Curve curve, base;
    bool has_base = false;

    Status open(const hm_curves* curves, Index number, Index n_points, CallFault& fault) noexcept {
        HARMORPH_TRY(view_curves(curves, view, fault));
        HARMORPH_TRY(view.checked_curve(number, curve, fault));
        constexpr Index min_points = 3, max_points = Index{1} << 24;
        if (n_points < min_points || n_points > max_points) {
            return fault.refuse(Status::bad_argument, "n must be between 3 and 2^24, not #",
                                plain(n_points));
        }
        if (number + 1 == view.count()) return Status::ok;
        HARMORPH_TRY(view.checked_curve(number + 1, base, fault));
        has_base = is_base();
        return Status::ok;
    }
    Curve const* base_if() const noexcept { return has_base ? &base : nullptr; }

private:
    bool is_base() const noexcept {
        Index const a = curve.control_point(0), b = curve.control_point(curve.n_indices - 1);
        Index const c = base.control_point(0), d = base.control_point(base.n_indices - 1);
        return a != b && ((c == a && d == b) || (c == b && d == a));
    }
};

hm_refit_report report_of(RefitReport const& found, Closure closure, Index index_base) noexcept {
    hm_refit_report filled = {};
    filled.max_error = found.max_error;
    filled.rms_error = found.rms_error;
    filled.chord = found.chord;
    filled.closed_width = found.closed_width;
    filled.max_error_point = numbered(found.max_error_point, index_base);
    filled.closed = static_cast<std::int32_t>(closure);
    filled.rotation_x = found.rotation.x;
    filled.rotation_y = found.rotation.y;
    filled.shift_x = found.shift.x;
    filled.shift_y = found.shift.y;
    return filled;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_refit(const hm_curves* curves, int32_t curve, const hm_points* points, int32_t n,
                   int32_t is_loop, int32_t on_chord, double* movement, hm_refit_report* report,
                   hm_memory* memory, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        AirfoilCurves airfoil;
        Points view;
        Refit refit;
        RefitReport found;
        HARMORPH_TRY(airfoil.open(curves, curve, n, fault));
        HARMORPH_TRY(
            place(memory, fault, [&](Arena& arena) { refit.lay_out(arena, airfoil.curve, n); }));
        HARMORPH_TRY(require({{"movement", movement}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(view_points(points, "points", view, fault));
        HARMORPH_TRY(refit.run(airfoil.curve, airfoil.base_if(), view, n,
                               {is_loop != 0, on_chord != 0}, found, fault));
        for (Index i = 0; i < refit.control.count(); ++i)
            movement[i] = refit.control[i] - airfoil.curve.control[i];
        if (report != nullptr)
            write_struct(report_of(found, refit.closure(), curves->index_base), report);
        return fault.status;
    });
}

}  // extern "C"
