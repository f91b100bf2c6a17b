// Reads the description of linear design variables.
#include "limits.hpp"
#include "section_view.hpp"

namespace harmorph {
namespace {

using VariablesLimit = Limit<hm_variables>;
constexpr VariablesLimit kinds_of_variables[] = {
    {&hm_variables::kind, HM_FFD, HM_NACA4,
     "variables.kind is #, but it must be HM_FFD, HM_CST, HM_HICKS_HENNE or HM_NACA4"},
};
constexpr VariablesLimit variables_limits[] = {
    {&hm_variables::leading_exponent, 0, 10,
     "variables.leading_exponent must be between 0 and 10, not ~"},
    {&hm_variables::trailing_exponent, 0, 10,
     "variables.trailing_exponent must be between 0 and 10, not ~"},
    {&hm_variables::width, 1, 100, "variables.width must be 0 or between 1 and 100, not ~",
     VariablesLimit::Zero::is_default},
};

// Refuses fields that belong to another kind of variable, which would otherwise be ignored
// silently.
Status check_fields(hm_variables const& v, Fault& fault) noexcept {
    const char* wrong = nullptr;
    bool const ffd = v.kind == HM_FFD;
    bool const box = !(v.x_min == 0 && v.y_min == 0 && v.x_max == 0 && v.y_max == 0);
    if (!ffd && (v.degree_x != 0 || v.degree_y != 0 || box))
        wrong = "degree_x, degree_y and the box of variables must be 0 unless the kind is HM_FFD";
    if (ffd && (v.n_upper != 0 || v.n_lower != 0))
        wrong = "variables.n_upper and n_lower must be 0 for HM_FFD";
    if (v.kind == HM_NACA4 && v.n_lower != 0) wrong = "variables.n_lower must be 0 for HM_NACA4";
    if (v.peaks != nullptr && (ffd || v.kind == HM_CST)) {
        wrong = "variables.peaks must be NULL unless the kind is HM_HICKS_HENNE or HM_NACA4";
    }
    if (v.kind != HM_CST && !(v.leading_exponent == 0 && v.trailing_exponent == 0)) {
        wrong =
            "leading_exponent and trailing_exponent of variables must be 0 unless the kind is "
            "HM_CST";
    }
    if (v.kind != HM_HICKS_HENNE && v.width != 0)
        wrong = "variables.width must be 0 unless the kind is HM_HICKS_HENNE";
    return wrong == nullptr ? Status::ok : fault.refuse(Status::bad_argument, wrong);
}

Status check_numbers(hm_variables const& v, Fault& fault) noexcept {
    Index const min_total = v.kind == HM_FFD || v.kind == HM_NACA4 ? 0 : 1;
    if (v.n_upper < 0 || v.n_upper > Variables::max_count || v.n_lower < 0 ||
        v.n_lower > Variables::max_count || v.n_upper + v.n_lower < min_total) {
        return fault.refuse(Status::bad_argument,
                            "variables.n_upper is # and n_lower is @; each must be between 0 and "
                            "64, and their sum at least 1 (0 for HM_NACA4)",
                            plain(v.n_upper), plain(v.n_lower));
    }
    if (v.degree_x < 0 || v.degree_x >= Variables::max_count || v.degree_y < 0 ||
        v.degree_y >= Variables::max_count) {
        return fault.refuse(
            Status::bad_argument,
            "variables.degree_x is # and degree_y is @, but each must be between 0 and 63",
            plain(v.degree_x), plain(v.degree_y));
    }
    HARMORPH_TRY(check_limits(v, variables_limits, fault));
    for (Index k = 0; v.peaks != nullptr && k < v.n_upper + v.n_lower; ++k) {
        if (is_finite(v.peaks[k]) && v.peaks[k] > 1e-6 && v.peaks[k] < 1 - 1e-6) continue;
        return fault.refuse(Status::bad_argument,
                            "peak # of variables.peaks is ~, but it must lie between 0 and 1",
                            entry_item(k), {}, v.peaks[k]);
    }
    return Status::ok;
}

void use_box(hm_variables const& v, CurvesView const& view, Variables& out) noexcept {
    out.low = {v.x_min, v.y_min};
    out.high = {v.x_max, v.y_max};
    if (!(v.x_min == 0 && v.y_min == 0 && v.x_max == 0 && v.y_max == 0)) return;
    Box box;
    const double* const control = view.set.control;
    for (Index i = 0; i < view.set.n_control; ++i)
        box.include(Vec2{control[2 * i], control[2 * i + 1]});
    Vec2 const margin = 0.025 * box.size();
    out.low = box.low - margin;
    out.high = box.high + margin;
}

}  // namespace

Status open_variables(const hm_variables* given, CurvesView const& view, Variables& out,
                      Fault& fault) noexcept {
    hm_variables v;
    HARMORPH_TRY(open_struct(given, v, "variables", "hm_variables", fault));
    HARMORPH_TRY(check_limits(v, kinds_of_variables, fault));
    HARMORPH_TRY(check_fields(v, fault));
    HARMORPH_TRY(check_numbers(v, fault));
    out.kind = static_cast<VariableKind>(v.kind);
    out.n_upper = v.n_upper;
    out.n_lower = v.n_lower;
    out.degree_x = v.degree_x;
    out.degree_y = v.degree_y;
    out.peaks = v.peaks;
    if (!(v.leading_exponent == 0 && v.trailing_exponent == 0)) {
        out.leading_exponent = v.leading_exponent;
        out.trailing_exponent = v.trailing_exponent;
    }
    if (v.width != 0) out.width = v.width;
    if (out.kind != VariableKind::ffd) return Status::ok;
    use_box(v, view, out);
    if (is_coordinate(out.low) && is_coordinate(out.high) && out.low.x < out.high.x &&
        out.low.y < out.high.y)
        return Status::ok;
    return fault.refuse(Status::bad_argument,
                        "the box of the variables is empty or not finite; x_min must be below "
                        "x_max, and y_min below y_max");
}

}  // namespace harmorph
