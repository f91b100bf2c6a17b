// The C interface: computes the map from design variables to control points.
#include "base/vec2.hpp"
#include "bspline/section_measures.hpp"
#include "bspline/variables.hpp"
#include "section_view.hpp"

namespace harmorph {
namespace {

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
    auto const refuse = [&](const char* why, Real value = 0) {
        return fault.refuse(Status::bad_argument, why, {}, {}, value);
    };
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
    if (!is_between(0, v.leading_exponent, 10)) {
        return refuse("variables.leading_exponent must be between 0 and 10, not ~",
                      v.leading_exponent);
    }
    if (!is_between(0, v.trailing_exponent, 10)) {
        return refuse("variables.trailing_exponent must be between 0 and 10, not ~",
                      v.trailing_exponent);
    }
    if (v.width != 0 && !is_between(1, v.width, 100))
        return refuse("variables.width must be 0 or between 1 and 100, not ~", v.width);
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

Status open_variables(const hm_variables* given, CurvesView const& view, Variables& out,
                      Fault& fault) noexcept {
    HARMORPH_TRY(require({{"variables", given}}, fault));
    hm_variables v;
    if (!read_struct(given, v))
        return fault.refuse(Status::bad_argument,
                            "variables.struct_size is not the size of an hm_variables; begin with "
                            "HM_INIT(variables)");
    if (v.kind < HM_FFD || v.kind > HM_NACA4) {
        return fault.refuse(
            Status::bad_argument,
            "variables.kind is #, but it must be HM_FFD, HM_CST, HM_HICKS_HENNE or HM_NACA4",
            plain(v.kind));
    }
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

// The arguments that a size query and hm_variables_map have in common.
struct VariablesTask {
    CurvesView view;
    Section section;
    Variables variables;

    Status open(const hm_curves* curves, const hm_section* given_section, const hm_variables* given,
                CallFault& fault) noexcept {
        HARMORPH_TRY(open_section(curves, given_section, view, section, fault));
        HARMORPH_TRY(open_variables(given, view, variables, fault));
        if (!variables.needs_chord()) return Status::ok;
        AreaMoments moments;
        HARMORPH_TRY(area_moments(section, moments, fault));  // finds the orientation
        return section.find_chord(true, fault);
    }
    void lay_out(Arena& arena, VariableMap& map) const noexcept {
        map.lay_out(arena, view.set.n_control, variables.count());
    }
};

hm_status variables_bytes(const hm_curves* curves, const hm_section* section,
                          const hm_variables* variables, int32_t* n, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        VariablesTask task;
        HARMORPH_TRY(task.open(curves, section, variables, fault));
        VariableMap map;
        HARMORPH_TRY(count_bytes(bytes, fault, [&](Arena& arena) { task.lay_out(arena, map); }));
        if (n != nullptr) *n = task.variables.count();
        return Status::ok;
    });
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_variables_map(const hm_curves* curves, const hm_section* section,
                           const hm_variables* variables, int32_t* n, hm_memory* memory,
                           double* matrix, double* error, hm_error* err) {
    if (asks(memory)) return variables_bytes(curves, section, variables, n, &memory->bytes, err);
    return guarded(err, [&](CallFault& fault) {
        VariablesTask task;
        HARMORPH_TRY(require({{"memory", memory}, {"matrix", matrix}}, fault));
        HARMORPH_TRY(task.open(curves, section, variables, fault));
        VariableMap map;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { task.lay_out(arena, map); }));
        VariablesOfSection const wanted{task.section, task.variables};
        HARMORPH_TRY(map.run(task.section, wanted.movements(), fault));
        HARMORPH_TRY(map.check_independence(fault));
        copy(Span<Real>(matrix, map.wanted.size()), Span<const Real>(map.wanted));
        if (error != nullptr)
            copy(Span<Real>(error, map.error.size()), Span<const Real>(map.error));
        if (n != nullptr) *n = task.variables.count();
        return Status::ok;
    });
}

}  // extern "C"
