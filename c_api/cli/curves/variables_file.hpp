// Files of design variables: the movement of each control point by one unit of each variable.
//
//     variables 12           # how many
//     points 20              # control points
//     1 3 0 0.0125           # control point, variable, dx, dy; pairs that are not named are 0
#pragma once

#include <harmorph_design.h>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct VariableMap {
    std::int32_t points = 0, variables = 0;
    std::vector<double> matrix;  // [points * variables * 2], as hm_variables_map fills it

    // Returns the movements of the control points for these values of the variables, both as pairs.
    std::vector<double> control_moves(const std::vector<double>& values) const;
    // The transpose: derivatives by the values, both pairs. gradient: by the control points at
    // least.
    std::vector<double> variable_gradient(const std::vector<double>& gradient) const;
};

VariableMap read_variables(const std::string& path);
void write_variables(std::ostream& out, const VariableMap& map);
// Reads lines "variable value" or "variable x y"; variables are counted from 1, and those that are
// not named are 0. Returns pairs.
std::vector<double> read_values(const std::string& path, const VariableMap& map);

}  // namespace cli
