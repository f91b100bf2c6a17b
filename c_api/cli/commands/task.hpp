// What is to be solved: curves, conditions, operator; from the command line, or once more as a
// basis was solved.
#pragma once

#include "basics/arguments.hpp"
#include "mesh/basis_file.hpp"
#include "commands/solve_options.hpp"
#include "curves/curves.hpp"

#include <memory>
#include <vector>

namespace cli {

struct Task {
    Curves curves;
    std::vector<hm_condition> conditions;
    std::vector<std::shared_ptr<const CurveSet>> slip_curves;  // that conditions point to
    std::vector<std::string> passages;  // pairs of sides that are turned, in words
    std::vector<std::int32_t> given_points, given_curves;  // parameters that are known
    std::vector<double> given_u;
    SolveOptions options;
};

std::vector<Option> task_options();
Task task_of(const Arguments& arguments, const Mesh& mesh);
Task task_of(const Basis& basis);

}  // namespace cli
