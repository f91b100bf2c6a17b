// Files of design variables. A file of linear variables has the movement of each control point by
// one unit of each variable:
//
//     variables 12           # the number of variables
//     points 20              # the number of control points
//     knots 8431962          # a checksum of the knots of their curves; may be missing
//     1 3 0 0.0125           # control point, variable, dx, dy; other pairs move by 0
//
// Other files list movements of the section (hm_movement), in the order in which they are applied.
// The variables are the values of the movements:
//
//     movements 3
//     points 20
//     chord 0 0 1 0          # a chord line that does not move; may be missing
//     parsec                 # or blade X Y, or camber-thickness N M
//     flap 0.7 0 0.1         # hinge, length
//     turn 0.25 0            # centre; likewise scale, and shift without a place
#pragma once

#include "curves/section_movement.hpp"

#include <harmorph_design.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct VariableMap {
    std::int32_t points = 0, variables = 0;
    std::int64_t knots = 0;              // of a matrix: checksum_of_knots(); 0: not known
    std::vector<double> matrix;          // [points * variables * 2], as hm_move_section fills it
    std::vector<hm_movement> movements;  // if not empty, used instead of the matrix
    hm_section section;

    // Returns the movements of the control points of `curves` for these values of the variables,
    // both as pairs. `errors` receives what movements leave.
    std::vector<double> control_moves(const hm_curves& curves, const std::vector<double>& values,
                                      const std::string& path,
                                      std::vector<MovementError>* errors = nullptr) const;
    // Returns the derivatives by the variables at these values, as pairs, from derivatives by the
    // control points. `gradient` may have more pairs, which are not used.
    std::vector<double> variable_gradient(const hm_curves& curves,
                                          const std::vector<double>& values,
                                          const std::vector<double>& gradient,
                                          const std::string& path) const;
};

VariableMap read_variables(const std::string& path);
// Refuses variables of curves with another number of control points, or with other knots.
void check_curves(const VariableMap& map, const hm_curves& curves, const std::string& path);
std::int64_t checksum_of_knots(const hm_curves& curves);
void write_variables(std::ostream& out, const VariableMap& map);
// Reads lines "variable value" or "variable x y"; variables are counted from 1, and those without a
// line are 0. Returns pairs.
std::vector<double> read_values(const std::string& path, const VariableMap& map);

}  // namespace cli
