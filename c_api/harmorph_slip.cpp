// The C interface: puts points that slip along curves back onto their curves.
#include "apart.hpp"
#include "base/vec2.hpp"
#include "handles.hpp"
#include "morph/slip_projection.hpp"

namespace harmorph {
namespace {

SlipProjection slip_of(Analysis const& analysis) noexcept {
    return {analysis.slip_curves(), analysis.slip_followers(), analysis.problem().mesh.n_points};
}

Status check_slipping(SlipCurves const& curves, Points points, Fault& fault) noexcept {
    curves.for_each([&](Index, Index point) {
        if (failed(fault.status) || is_coordinate(points[point])) return;
        fault.refuse(Status::bad_mesh,
                     "point #, which slips along a curve, has a coordinate that is not finite or "
                     "beyond 1e100",
                     point_item(point));
    });
    return fault.status;
}

struct Names {
    const char *in, *out;
};

// Checks the arrays of a derivative: `out` may be the arrays of `in`, but must be apart from the
// points `from`.
Status check_apart(Analysis const& analysis, Points from, Names names, Points in, MutablePoints out,
                   Fault& fault) noexcept {
    Index const n = analysis.problem().mesh.n_points;
    Apart arrays;
    arrays.add("from", from, n);
    HARMORPH_TRY(arrays.check(names.out, out, n, fault));
    return Apart::check_in_place(names.in, in, names.out, out, n, fault);
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_slip(const hm_analysis* analysis, const hm_points* from, const hm_points_out* to,
                  hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        Points before;
        MutablePoints after;
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        HARMORPH_TRY(view_points(from, "from", before, fault));
        HARMORPH_TRY(view_points(to, "to", after, fault));
        Index const n = opened->problem().mesh.n_points;
        HARMORPH_TRY(Apart::check_in_place("from", before, "to", after, n, fault));
        HARMORPH_TRY(check_slipping(opened->slip_curves(), before, fault));
        slip_of(*opened).project(before, after);
        return Status::ok;
    });
}

hm_status hm_slip_derivative(const hm_analysis* analysis, const hm_points* from,
                             const hm_points* d_from, const hm_points_out* d_to, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        Points before, velocity;
        MutablePoints after;
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        HARMORPH_TRY(view_points(from, "from", before, fault));
        HARMORPH_TRY(view_points(d_from, "d_from", velocity, fault));
        HARMORPH_TRY(view_points(d_to, "d_to", after, fault));
        HARMORPH_TRY(check_apart(*opened, before, {"d_from", "d_to"}, velocity, after, fault));
        HARMORPH_TRY(check_slipping(opened->slip_curves(), before, fault));
        slip_of(*opened).differentiate(before, velocity, after);
        return Status::ok;
    });
}

hm_status hm_slip_adjoint(const hm_analysis* analysis, const hm_points* from, const hm_points* dj,
                          const hm_points_out* dj_from, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        Points before, derivative;
        MutablePoints transposed;
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        HARMORPH_TRY(view_points(from, "from", before, fault));
        HARMORPH_TRY(view_points(dj, "dj", derivative, fault));
        HARMORPH_TRY(view_points(dj_from, "dj_from", transposed, fault));
        HARMORPH_TRY(
            check_apart(*opened, before, {"dj", "dj_from"}, derivative, transposed, fault));
        HARMORPH_TRY(check_slipping(opened->slip_curves(), before, fault));
        slip_of(*opened).transpose(before, derivative, transposed);
        return Status::ok;
    });
}

}  // extern "C"
