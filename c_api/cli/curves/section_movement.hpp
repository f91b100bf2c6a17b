// Movements of whole sections: lines of a file of moves, and design variables.
//
//     turn MARKER degrees [X,Y]            about (X, Y); default: about the quarter chord
//     shift MARKER dx dy
//     scale MARKER factor [X,Y]
//     flap MARKER X,Y degrees [length]     see HM_FLAP in harmorph_design.h
#pragma once

#include "files/text_file.hpp"

#include <harmorph_design.h>

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

// Reads the two numbers of "X,Y". Returns false for other texts.
bool parse_place(std::string_view word, double& x, double& y);

// What the control points of a curve cannot follow of a movement [length].
struct MovementError {
    std::string name;  // of the movement
    double rms = 0, largest = 0;
    double chord = 0;  // the larger side of the box around the control points
};

struct MovedSection {
    std::vector<double> move;         // of the control points [2*n_control]
    std::vector<double> derivatives;  // of `move` by each value [values * 2*n_control]
    std::vector<double> start;        // the values of the curves before the movement
    double rms_error = 0, max_error = 0;
};
// Applies movements with these values. Returns false, with the error, if the library refuses.
bool move_section(const hm_curves& curves, const hm_section& section,
                  const std::vector<hm_movement>& movements, const std::vector<double>& values,
                  MovedSection& moved, hm_error& error);
MovementError movement_error(std::string name, const hm_curves& curves, const MovedSection& moved);
bool find_quarter_chord(const hm_curves& curves, const hm_section& section, double& x, double& y,
                        hm_error& error);

// Returns the names of the values of a movement, in their order, with the unit of angles.
std::vector<std::string> value_names(const hm_movement& movement);

}  // namespace cli
