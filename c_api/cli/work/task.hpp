// A problem to solve: curves, conditions and operator, as the command line says, or as a basis was
// solved.
#pragma once

#include "curves/curves.hpp"
#include "options/arguments.hpp"
#include "work/basis_file.hpp"
#include "work/engine.hpp"
#include "work/wall_field.hpp"

#include <memory>
#include <vector>

namespace cli {

struct Task {
    Curves curves;
    std::vector<hm_condition> conditions;
    std::vector<std::shared_ptr<const CurveSet>> slip_curves;  // conditions point to these
    std::vector<std::string> passages;                     // descriptions of pairs of turned sides
    std::vector<std::int32_t> known_points, known_curves;  // points with known parameters
    std::vector<double> known_u;
    FluxList fluxes;
    double max_curve_distance = 0;  // of hm_problem
    SolveOptions options;
    EngineChoice choice;  // if not empty, replaces the engine of `options`

    bool slips() const;  // tells whether points of a marker slip
};

// Adds the conditions of the command line, with their curves.
void add_conditions(const Arguments& arguments, const Mesh& mesh, Task& task);

Task task_of(const Arguments& arguments, const Mesh& mesh);
Task task_of(const Basis& basis);

}  // namespace cli
