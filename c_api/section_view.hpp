// A section of the caller's curves, checked and joined to an outline.
#pragma once

#include "harmorph/bspline/section.hpp"
#include "views.hpp"

namespace harmorph {

// given NULL: all curves, with their own chord.
inline Status open_section(const hm_curves* curves, const hm_section* given, CurvesView& view, Section& section,
                           CallFault& fault) noexcept {
    hm_section asked = {};
    HARMORPH_TRY(view_curves(curves, view, fault));
    if (given != nullptr && !read_struct(given, asked)) {
        return fault.refuse(Status::bad_argument, "section.struct_size is not set");
    }
    if (asked.first_curve == 0 && asked.n_curves == 0) asked.n_curves = view.count();
    if (asked.first_curve < 0 || asked.n_curves < 1 || asked.n_curves > view.count() - asked.first_curve) {
        return fault.refuse(Status::bad_argument,
                            "section.first_curve and n_curves, # and @, exceed the curves of the set",
                            Counts::from_zero, asked.first_curve, asked.n_curves);
    }
    if (asked.n_curves > Section::most_curves) {
        return fault.refuse(Status::bad_argument, "section.n_curves is #: at most 8 curves form a section",
                            Counts::from_zero, asked.n_curves);
    }
    section.nose = {asked.nose_x, asked.nose_y};
    section.edge = {asked.edge_x, asked.edge_y};
    if (!is_in_range(section.nose) || !is_in_range(section.edge)) {
        return fault.refuse(Status::bad_argument, "section: an end of the chord line is not finite or beyond 1e100");
    }
    section.has_fixed_chord = !(asked.nose_x == 0 && asked.nose_y == 0 && asked.edge_x == 0 && asked.edge_y == 0);
    section.n_curves = asked.n_curves;
    for (Index k = 0; k < asked.n_curves; ++k) {
        HARMORPH_TRY(view.curve(asked.first_curve + k, section.curve[k], fault));
        HARMORPH_TRY(check_curve(section.curve[k], asked.first_curve + k, fault));
    }
    return section.connect(fault);
}

}  // namespace harmorph
