// Views of curves and conditions. They are apart from the other views so that a program that only
// moves meshes does not link them.
#include "base/vec2.hpp"
#include "limits.hpp"

namespace harmorph {
namespace {

constexpr Index max_curves = Index{1} << 24;
constexpr Limit<hm_curves> curves_limits[] = {
    {&hm_curves::index_base, 0, 1, "curves.index_base must be 0 or 1, not #"},
    {&hm_curves::n_control, 2, max_curves, "curves.n_control must be between 2 and 2^24, not #",
     Status::bad_curve},
    {&hm_curves::n_curves, 1, max_curves, "curves.n_curves must be between 1 and 2^24, not #",
     Status::bad_curve},
};

}  // namespace

Status view_curves(const hm_curves* given, CurvesView& view, CallFault& fault) noexcept {
    HARMORPH_TRY(open_struct(given, view.set, "curves", "hm_curves", fault));
    hm_curves const& set = view.set;
    fault.bases.curves = set.index_base;
    if (set.control == nullptr || set.curve == nullptr) {
        return fault.refuse(Status::bad_argument, "curves.control or curves.curve is NULL");
    }
    return check_limits(set, curves_limits, fault);
}

Status CurvesView::checked_curve(Index number, Curve& out, Fault& fault) const noexcept {
    if (number < 0 || number >= count()) {
        return fault.refuse(Status::bad_argument, "curve # does not exist; curves.n_curves is @",
                            curve_item(number), plain(count()));
    }
    HARMORPH_TRY(curve(number, out, fault));
    return check_curve(out, number, fault);
}

Status CurvesView::curve(Index number, Curve& out, Fault& fault) const noexcept {
    hm_curve c;
    HARMORPH_TRY(
        open_element(set.curve, number, c, curve_item(number), "curve", "hm_curve", fault));
    if (c.knots == nullptr) {
        return fault.refuse(Status::bad_argument, "the array of knots of curve # is NULL",
                            curve_item(number));
    }
    out = Curve{};
    out.degree = c.degree;
    out.n_indices = c.n_indices;
    out.index_base = set.index_base;
    out.n_control = set.n_control;
    out.indices = c.indices;
    out.knots = c.knots;
    out.control = set.control;
    out.weights = set.weights;
    return Status::ok;
}

namespace {

// Refuses fields that belong to another kind of condition, which would otherwise be ignored
// silently.
Status check_fields(hm_condition const& c, Index number, Fault& fault) noexcept {
    unsigned const fields = condition_traits[c.kind].fields;
    auto const has_not = [&](ConditionField field) { return !contains(fields, field); };
    const char* wrong = nullptr;
    if ((c.first_curve != 0 && has_not(ConditionField::curves)) ||
        (c.n_curves != 0 && has_not(ConditionField::curves) && has_not(ConditionField::along))) {
        wrong =
            "first_curve or n_curves of condition # is set, but the kind of the condition is @, "
            "not HM_ON_CURVE";
    } else if (c.along != nullptr && has_not(ConditionField::along)) {
        wrong = "along of condition # is set, but the kind of the condition is @, not HM_SLIP";
    } else if (c.body != 0 && has_not(ConditionField::body)) {
        wrong = "body of condition # is set, but the kind of the condition is @, not HM_RIGID";
    } else if (!(c.x == 0 && c.y == 0) && has_not(ConditionField::centre)) {
        wrong =
            "x or y of condition # is set, but the kind of the condition is @, not HM_RIGID or "
            "HM_ROTATION_PAIR";
    } else if (c.piece < 0 || c.piece > 1 || c.reserved != 0) {
        wrong =
            "piece of condition # must be 0 or 1, and reserved must be 0; the kind of the "
            "condition is @";
    } else if (c.piece != 0 && has_not(ConditionField::piece)) {
        wrong =
            "condition # chooses a piece of a marker, but the kind of the condition is @, a pair "
            "of whole markers";
    } else if (c.piece == 0 && !(c.near_x == 0 && c.near_y == 0)) {
        wrong =
            "near_x or near_y of condition # is set, but piece is 0; the kind of the condition is "
            "@";
    } else if (c.partner != 0 && has_not(ConditionField::partner)) {
        wrong =
            "partner of condition # is set, but the kind of the condition is @, not "
            "HM_PERIODIC_PAIR, HM_ROTATION_PAIR or HM_INTERFACE";
    }
    if (wrong != nullptr)
        return fault.refuse(Status::bad_condition, wrong, condition_item(number), plain(c.kind));
    if (has_not(ConditionField::along)) return Status::ok;
    if (c.along == nullptr && c.n_curves != 0) {
        return fault.refuse(Status::bad_condition,
                            "condition # slips along @ curves, but its `along` is NULL; give the "
                            "curves again, which hm_basis_along takes from a basis",
                            condition_item(number), plain(c.n_curves));
    }
    hm_curves set;
    bool const fits = c.along == nullptr || (read_struct(c.along, set) &&
                                             set.n_curves == c.n_curves && set.n_curves >= 1);
    if (fits) return Status::ok;
    return fault.refuse(
        Status::bad_condition,
        "n_curves of condition # is @, but its `along` has another number of curves",
        condition_item(number), plain(c.n_curves));
}

}  // namespace

Status view_condition(const hm_condition* array, Index number, Condition& out,
                      Fault& fault) noexcept {
    hm_condition c;
    HARMORPH_TRY(
        open_element(array, number, c, condition_item(number), "condition", "hm_condition", fault));
    if (!has_row(condition_traits, c.kind)) {
        return fault.refuse(
            Status::bad_argument,
            "the kind of condition # is @, but it must be one of HM_ON_CURVE to HM_INTERFACE",
            condition_item(number), plain(c.kind));
    }
    constexpr Index max_bodies = Index{1} << 20;
    if (c.kind == HM_RIGID && (c.body < 0 || c.body >= max_bodies)) {
        return fault.refuse(Status::bad_condition,
                            "condition # names rigid body @, but there can be no more than 2^20 "
                            "bodies, numbered without gaps",
                            condition_item(number), body_item(c.body));
    }
    HARMORPH_TRY(check_fields(c, number, fault));
    if (!is_coordinate({c.near_x, c.near_y})) {
        return fault.refuse(Status::bad_condition,
                            "near_x or near_y of condition # is not finite or beyond 1e100",
                            condition_item(number));
    }
    out = {c.marker,
           static_cast<ConditionKind>(c.kind),
           c.first_curve,
           c.n_curves,
           c.body,
           c.partner,
           {c.x, c.y},
           c.piece,
           0,
           {c.near_x, c.near_y}};
    return Status::ok;
}

}  // namespace harmorph
