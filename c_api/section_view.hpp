// Reads a section of the caller's curves, checks it, and joins the curves to an outline.
#pragma once

#include "bspline/section.hpp"
#include "bspline/variables.hpp"
#include "limits.hpp"

namespace harmorph {

// Limits coordinates so that fourth powers of lengths, and their derivatives, do not overflow.
inline Status check_moments(Curve const& curve, Fault& fault) noexcept {
    constexpr Real largest = 1e50;
    for (Index k = 0; k < curve.n_indices; ++k) {
        Index const point = curve.control_point(k);
        Vec2 const place{curve.control[2 * point], curve.control[2 * point + 1]};
        if (is_at_most(place.x, largest) && is_at_most(place.y, largest)) continue;
        return fault.refuse(
            Status::bad_curve,
            "control point # of the section has a coordinate that is not finite or beyond 1e50",
            control_point_item(point));
    }
    return Status::ok;
}

// If given is NULL, the section consists of all curves, with the chord of the curves.
inline Status open_section(const hm_curves* curves, const hm_section* given, CurvesView& view,
                           Section& section, CallFault& fault) noexcept {
    hm_section asked = {};
    HARMORPH_TRY(view_curves(curves, view, fault));
    if (given != nullptr) HARMORPH_TRY(open_struct(given, asked, "section", "hm_section", fault));
    if (asked.first_curve == 0 && asked.n_curves == 0) asked.n_curves = view.count();
    if (asked.first_curve < 0 || asked.n_curves < 1 ||
        asked.n_curves > view.count() - asked.first_curve) {
        return fault.refuse(Status::bad_argument,
                            "section.first_curve is # and section.n_curves is @, but the set does "
                            "not have these curves",
                            curve_item(asked.first_curve), plain(asked.n_curves));
    }
    if (asked.n_curves > Section::max_curves) {
        return fault.refuse(Status::bad_argument,
                            "section.n_curves is #, but a section has at most 8 curves",
                            plain(asked.n_curves));
    }
    section.leading_edge = {asked.leading_x, asked.leading_y};
    section.trailing_edge = {asked.trailing_x, asked.trailing_y};
    if (!is_coordinate(section.leading_edge) || !is_coordinate(section.trailing_edge)) {
        return fault.refuse(
            Status::bad_argument,
            "an end of the chord line of the section is not finite or beyond 1e100");
    }
    section.has_fixed_chord = !(asked.leading_x == 0 && asked.leading_y == 0 &&
                                asked.trailing_x == 0 && asked.trailing_y == 0);
    section.n_curves = asked.n_curves;
    section.first_curve = asked.first_curve;
    for (Index k = 0; k < asked.n_curves; ++k) {
        HARMORPH_TRY(view.checked_curve(asked.first_curve + k, section.curve[k], fault));
        HARMORPH_TRY(check_moments(section.curve[k], fault));
    }
    return section.connect(fault);
}

// Reads linear variables, whose box may be that of the control points.
Status open_variables(const hm_variables* given, CurvesView const& view, Variables& out,
                      Fault& fault) noexcept;

}  // namespace harmorph
