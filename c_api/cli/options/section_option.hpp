// The option for the chord of the section in a curve file, of all commands that measure sections.
#pragma once

#include "basics/library.hpp"
#include "options/arguments.hpp"
#include "options/number_list.hpp"

#include <harmorph_design.h>

namespace cli {

inline hm_section section_of(const Arguments& arguments) {
    auto section = sized<hm_section>();
    if (!arguments.has("--chord")) return section;
    const std::vector<double> chord = number_list(arguments, "--chord");
    if (chord.size() != 4) arguments.refuse("--chord expects four numbers X,Y,X,Y");
    section.leading_x = chord[0];
    section.leading_y = chord[1];
    section.trailing_x = chord[2];
    section.trailing_y = chord[3];
    return section;
}

}  // namespace cli
