#include "work/task.hpp"

#include "basics/numbers.hpp"
#include "options/operators.hpp"
#include "work/engine.hpp"
#include "work/safe_way.hpp"

#include <harmorph_study.h>

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// Returns the exponent as the library expects it: 0 for the default, -1 for no weight.
double exponent_of(const Arguments& arguments) {
    if (!arguments.has("--exponent")) return 0;
    double exponent = 0;
    const bool is_number = parse(arguments.text("--exponent"), exponent);
    if (!is_number || !(exponent >= 0 && exponent <= 4) || std::fmod(exponent, 0.25) != 0) {
        arguments.refuse("--exponent expects a number from 0 to 4 in steps of 1/4, not " +
                         in_quotes(arguments.text("--exponent")));
    }
    return exponent == 0 ? -1 : exponent;
}

}  // namespace

bool Task::slips() const {
    return std::any_of(conditions.begin(), conditions.end(),
                       [](const hm_condition& condition) { return condition.kind == HM_SLIP; });
}

std::vector<Option> task_options() {
    const std::vector<Option> scheme_options = {
        {"--scheme", "SCHEME",
         "compact (default): on the mesh's cells; bounded: on Delaunay triangles of its points, so "
         "that\n"
         "laplace and weighted functions stay between 0 and 1; nodal-gradient: laplace by "
         "averaged\n"
         "gradients, engines direct and fas; nodal-gradient-plain: the paper's text, engine fas"},
        {"--offset-correction", nullptr,
         "conformal: the offsets of wall points from their curve turn with the curve"},
        {"--far-from-curve", nullptr,
         "accept points that are farther from their curve than .01 of the diagonal of the box "
         "around the curve;\n"
         "they keep their distance in every movement. From .001 on there is a warning"},
        {"--tol", "T", "largest relative residual that counts as converged (default 1e-10)"}};
    return condition_options() + operator_options() + scheme_options;
}

Task task_of(const Arguments& arguments, const Mesh& mesh) {
    Task task;
    task.options.tolerance = arguments.positive("--tol", 1e-10);
    task.options.operator_kind =
        compares_operators(arguments) ? HM_CONFORMAL : operator_of(arguments);
    task.options.exponent = exponent_of(arguments);
    task.options.scheme =
        arguments.choice("--scheme", {{"compact", HM_COMPACT},
                                      {"nodal-gradient", HM_NODAL_GRADIENT},
                                      {"nodal-gradient-plain", HM_NODAL_GRADIENT_PLAIN},
                                      {"bounded", HM_BOUNDED}});
    task.options.offset_correction = arguments.has("--offset-correction") ? 1 : 0;
    set_engine(arguments, task);
    constexpr double farthest = 0.01;
    task.max_curve_distance = arguments.has("--far-from-curve") ? 1e100 : farthest;
    add_conditions(arguments, mesh, task);
    return task;
}

Task task_of(const Basis& basis) {
    Task task;
    const hm_basis_info& info = basis.info();
    task.options.operator_kind = info.operator_kind;
    task.options.scheme = info.scheme;
    task.options.engine = info.engine;
    task.options.exponent = info.exponent == 0 ? -1 : info.exponent;
    task.options.offset_correction = info.offset_correction;
    task.conditions = basis.conditions();
    task.slip_curves = basis.slip_curves();
    task.curves =
        copied(basis.why_on_no_curve().empty() ? basis.curves() : basis.curves_at_start());
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        if (info.point_curve[k] >= info.curves) continue;  // the point is on no curve
        task.given_points.push_back(info.curve_point[k]);
        task.given_curves.push_back(info.point_curve[k]);
        task.given_u.push_back(info.point_u[k]);
    }
    return task;
}

}  // namespace cli
