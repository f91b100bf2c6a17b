#include "fixtures/memory.hpp"
#include "describe.hpp"

#include <cstdio>

namespace fuzz {

std::string describe(Problem const& problem) {
    std::string out;
    char line[300];
    auto const add = [&](auto const... numbers) {
        std::snprintf(line, sizeof line, numbers...);
        out += line;
    };
    Options const& o = problem.options;
    add("    operator %d, scheme %d, engine %d, exponent %g, offset %d\n", o.operator_kind,
        o.scheme, o.engine, o.exponent, o.offset_correction);
    add("    %d points of size %g, %zu cells in layout %d, %d control points\n",
        problem.mesh.n_points, problem.size(), problem.domain.cells.size(),
        problem.mesh.cell_layout, problem.on_walls.view.n_control);
    for (hm_condition const& condition : problem.conditions)
        add("    marker %d: condition %d, curves %d + %d\n", condition.marker, condition.kind,
            condition.first_curve, condition.n_curves);
    for (hm_curve const& curve : problem.on_walls.curve)
        add("    curve of degree %d, %d indices\n", curve.degree, curve.n_indices);
    return out;
}

}  // namespace fuzz
