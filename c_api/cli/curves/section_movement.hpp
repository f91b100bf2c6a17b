// Movements of whole sections, as lines of files of moves have them, and their values as design
// variables.
//
//     turn MARKER degrees [X,Y]            about (X, Y); without, about the quarter chord
//     shift MARKER dx dy
//     scale MARKER factor [X,Y]
//     flap MARKER X,Y degrees [length]     see HM_FLAP in harmorph_design.h
#pragma once

#include <harmorph_design.h>
#include "basics/text_file.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

struct SectionMovement {
    std::string marker;
    hm_movement movement;
    std::vector<double> values;
    bool has_centre = true;  // false: the quarter chord
};

bool is_section_movement(std::string_view word);  // the first word of a line
SectionMovement section_movement_of(LineReader& lines);

// The two numbers of "X,Y".
bool parse_place(std::string_view word, double& x, double& y);

// The movement of the control points [2*n_control] by values of movements, and, unless NULL, its
// derivatives and the values that the curves have. Returns false if the library refuses.
struct MovedSection {
    std::vector<double> move, derivatives, start;
    double rms_error = 0, max_error = 0;
};
bool move_section(const hm_curves& curves, const hm_section& section,
                  const std::vector<hm_movement>& movements, const std::vector<double>& values,
                  MovedSection& moved, hm_error& error);
bool find_quarter_chord(const hm_curves& curves, const hm_section& section, double& x, double& y,
                        hm_error& error);

// What the values of a movement are, in their order.
std::vector<std::string> value_names(const hm_movement& movement);

}  // namespace cli
