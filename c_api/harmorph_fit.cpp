// The C interface: fits B-splines to points in order.
#include "fitted_set.hpp"
#include "request.hpp"

namespace harmorph {
namespace {

struct FitBlock {
    FittedSet made;
    Fit fit;

    void lay_out(Arena& arena, Index n, FitOptions const& options) noexcept {
        made.lay_out(arena, 1, options.n_control, options.degree);
        fit.lay_out(arena, n, options);
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_fit(const hm_curves** curves, hm_memory* memory, const hm_points* points, int32_t n,
                 int32_t is_loop, const hm_fit_options* options, hm_fit_report* report,
                 hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Points view;
        FitOptions asked;
        HARMORPH_TRY(view_fit_options(options, asked, fault));
        HARMORPH_TRY(check_fit(n, asked, fault));
        FitBlock made;
        FitReport fitted;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, n, asked); }));
        HARMORPH_TRY(require({{"curves", curves}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(view_points(points, "points", view, fault));
        HARMORPH_TRY(check_fit_weights(asked, n, fault));
        HARMORPH_TRY(made.fit.run(view, n, is_loop != 0, asked, fitted, fault));
        made.made.add(made.fit);
        hm_fit_report filled = report_of(fitted, 1, options == nullptr ? 0 : fault.bases.curves);
        *curves = made.made.present(memory->block, memory->bytes, filled.bytes);
        if (report != nullptr) write_struct(filled, report);
        return fault.status;
    });
}

}  // extern "C"
