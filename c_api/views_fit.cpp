// Reads the options of fits from the caller's structs.
#include "limits.hpp"

namespace harmorph {
namespace {

constexpr const char* of_lengths =
    "details.smoothing and details.tolerance must be lengths of 0 or above";
constexpr Limit<hm_fit_details> details_limits[] = {
    {&hm_fit_details::smoothing, 0, largest_coordinate, of_lengths},
    {&hm_fit_details::tolerance, 0, largest_coordinate, of_lengths},
};

constexpr Limit<hm_fit_options> fit_limits[] = {
    {&hm_fit_options::closed, HM_CLOSED_AUTO, HM_PERIODIC,
     "options.closed is #, but it must be HM_CLOSED_AUTO, HM_OPEN, HM_TIED or HM_PERIODIC"},
    {&hm_fit_options::index_base, 0, 1, "options.index_base must be 0 or 1, not #"},
};

Status view_fit_details(const hm_fit_details* given, FitOptions& options,
                        CallFault& fault) noexcept {
    hm_fit_details d;
    HARMORPH_TRY(open_struct(given, d, "details", "hm_fit_details", fault));
    HARMORPH_TRY(check_limits(d, details_limits, fault));
    if (d.smoothing > 0 && options.degree < 2)
        return fault.refuse(Status::bad_argument,
                            "details.smoothing needs a curve of degree 2 or above");
    options.tangent[0] = {d.begin_x, d.begin_y};
    options.tangent[1] = {d.end_x, d.end_y};
    if (!is_coordinate(options.tangent[0]) || !is_coordinate(options.tangent[1]))
        return fault.refuse(Status::bad_argument,
                            "an end tangent of details is not finite or beyond 1e100");
    options.smoothing = d.smoothing;
    options.tolerance = d.tolerance;
    options.weight = d.weights;
    options.n_weights = d.n_weights;
    if ((d.weights == nullptr) == (d.n_weights == 0)) return Status::ok;
    return fault.refuse(
        Status::bad_argument,
        "details.n_weights is #; it must be 0 if details.weights is NULL, and positive otherwise",
        plain(d.n_weights));
}

}  // namespace

Status check_fit_weights(FitOptions const& options, Index n_points, Fault& fault) noexcept {
    if (options.weight == nullptr) return Status::ok;
    if (options.n_weights != n_points) {
        return fault.refuse(Status::bad_argument, "details.n_weights is #, but there are @ points",
                            plain(options.n_weights), plain(n_points));
    }
    bool any = false;
    for (Index k = 0; k < n_points; ++k) {
        Real const weight = options.weight[k];
        if (!is_between(0, weight, 1e30))
            return fault.refuse(Status::bad_argument,
                                "the weight of point # is ~, but it must be between 0 and 1e30",
                                point_item(k), {}, weight);
        any = any || weight > 0;
    }
    return any ? Status::ok : fault.refuse(Status::bad_argument, "all weights of the points are 0");
}

Status view_fit_options(const hm_fit_options* given, FitOptions& options,
                        CallFault& fault) noexcept {
    options = FitOptions{};
    if (given == nullptr) return Status::ok;
    hm_fit_options o;
    HARMORPH_TRY(open_struct(given, o, "options", "hm_fit_options", fault));
    HARMORPH_TRY(check_limits(o, fit_limits, fault));
    fault.bases.curves = o.index_base;
    if (o.degree != 0) options.degree = o.degree;
    if (o.n_control != 0) options.n_control = o.n_control;
    options.closure = static_cast<Closure>(o.closed);
    return o.details == nullptr ? Status::ok : view_fit_details(o.details, options, fault);
}

}  // namespace harmorph
