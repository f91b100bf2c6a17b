// harmorph adjoint: computes derivatives by control points, bodies and design variables from
// derivatives by mesh points, which an adjoint flow solver writes.
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "curves/variables_file.hpp"
#include "files/output_file.hpp"
#include "files/threads.hpp"
#include "work/mesh_fields.hpp"
#include "work/read_mesh.hpp"
#include "work/sensitivity.hpp"
#include "work/solver.hpp"

#include <harmorph_design.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cli {

namespace {

SensitivityColumns columns_of(const Arguments& arguments) {
    SensitivityColumns columns;
    if (arguments.has("--vector")) {
        for (const char* option : {"--x", "--y", "--normal"})
            if (arguments.has(option))
                arguments.refuse(std::string(option) + " and --vector exclude each other");
        columns.x = arguments.text("--vector") + "_x";
        columns.y = arguments.text("--vector") + "_y";
    }
    if (arguments.has("--x")) columns.x = arguments.text("--x");
    if (arguments.has("--y")) columns.y = arguments.text("--y");
    if (!arguments.has("--normal")) {
        for (const char* option : {"--into", "--per-length"})
            if (arguments.has(option)) arguments.refuse(std::string(option) + " needs --normal");
        return columns;
    }
    for (const char* option : {"--x", "--y"})
        if (arguments.has(option))
            arguments.refuse(std::string(option) + " and --normal exclude each other");
    columns.normal = arguments.text("--normal");
    if (!arguments.has("--into"))
        arguments.refuse("--normal needs --into fluid or --into body: where the normals point");
    columns.into_fluid = arguments.choice("--into", {{"fluid", 1}, {"body", 0}}) == 1;
    columns.per_length = arguments.has("--per-length");
    return columns;
}

// Returns the largest s for which the movement -s * gradient inverts no cell, and for which the
// boundary does not touch itself.
double admissible_descent(const Mesh& mesh, const Basis& basis, std::vector<double> gradient,
                          const Threads& threads) {
    for (double& g : gradient) g = -g;
    Field by(mesh.x.size());
    const hm_points_out out = by.write();
    call(mesh, hm_morph, basis.get(), gradient.data(), nullptr, &out, threads.executor());
    const hm_mesh view = mesh.view();
    const hm_points along = by.read();
    auto step = sized<hm_step_report>();
    call(mesh, hm_assess, basis.get(), &view, nullptr, &along, nullptr, threads.executor(), &step,
         nullptr);
    return std::min(step.admissible, step.boundary);
}

void smooth(const Mesh& mesh, const Basis& basis, double length, std::vector<double>& gradient) {
    Block work;
    with_memory(work, [&](hm_memory* memory) {
        return call(mesh, hm_smooth_gradient, &basis.curves(), length, gradient.data(),
                    gradient.data(), memory);
    });
}

// The design variables of --variables, at the values of --at on the curves with which the basis was
// solved; without values, at 0 on the curves of the mesh, from where a morph goes on.
struct VariablesAt {
    std::string path;
    VariableMap map;
    std::vector<double> values;  // pairs
    const hm_curves* curves;
};

// Refuses values by which the mesh, which has moved, has not moved.
void check_values(const Arguments& arguments, const Basis& basis, const VariablesAt& at) {
    if (!basis.mesh_has_moved()) return;
    constexpr double digits_of_files = 1e-4;
    const hm_curves &start = basis.curves_at_start(), &now = basis.curves();
    const std::vector<double> moves = at.map.control_moves(start, at.values, at.path);
    double off = 0, largest = 0;
    for (std::size_t k = 0; k < moves.size(); ++k) {
        off = std::max(off, std::fabs(start.control[k] + moves[k] - now.control[k]));
        largest = std::max(largest, std::fabs(now.control[k]));
    }
    if (off > digits_of_files * largest)
        arguments.refuse(
            "--at: these values do not move the curve to where the mesh is; without "
            "--at, derivatives are those of the next morph of the mesh");
}

std::optional<VariablesAt> variables_at(const Arguments& arguments, const Basis& basis) {
    if (!arguments.has("--variables")) {
        if (arguments.has("--at")) arguments.refuse("--at needs --variables");
        return {};
    }
    const std::string path = arguments.text("--variables");
    VariablesAt at = {path, read_variables(path), {}, &basis.curves_at_start()};
    check_curves(at.map, basis.curves_at_start(), path);
    at.values.resize(2 * static_cast<std::size_t>(at.map.variables));
    if (!arguments.has("--at")) {
        if (!at.map.movements.empty()) at.curves = &basis.curves();
        return at;
    }
    at.values = read_values(arguments.text("--at"), at.map);
    check_values(arguments, basis, at);
    return at;
}

// slip: puts points that slip along curves onto these curves after a morph; nullptr: a morph is
// linear.
Gradient gradient_of(const Arguments& arguments, const std::string& path, const Mesh& mesh,
                     const Basis& basis, const std::optional<VariablesAt>& variables,
                     const Threads& threads, Solver* slip) {
    Sensitivity sensitivity =
        read_sensitivity(path, columns_of(arguments), mesh, arguments.has("--in-order"));
    Gradient found;
    found.objective = path;
    found.points = sensitivity.rows;
    found.by_functions.resize(2 * static_cast<std::size_t>(basis.functions()));
    if (slip != nullptr) slip->take_off_curves(sensitivity.by);
    const hm_points by = sensitivity.by.read();
    call(mesh, hm_adjoint, basis.get(), &by, found.by_functions.data(), threads.executor());
    if (arguments.has("--smooth")) {
        if (basis.n_control() == 0)
            arguments.refuse("--smooth: the basis has no curve along which to smooth");
        smooth(mesh, basis, arguments.positive("--smooth", 0), found.by_functions);
    }
    found.admissible_descent = admissible_descent(mesh, basis, found.by_functions, threads);
    if (variables) {
        found.by_variables = variables->map.variable_gradient(*variables->curves, variables->values,
                                                              found.by_functions, variables->path);
        found.variables_are_movements = !variables->map.movements.empty();
    }
    return found;
}

}  // namespace

void run_adjoint(const Arguments& arguments) {
    const std::vector<std::string> paths = arguments.all("--sensitivity");
    if (paths.empty()) arguments.refuse("--sensitivity is required");
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    const Threads threads(threads_of(arguments));
    const std::optional<VariablesAt> variables = variables_at(arguments, basis);
    const Task task = task_of(basis);
    std::optional<Solver> slip;
    if (task.slips() && basis.mesh_has_moved()) slip.emplace(mesh, task, threads);
    std::vector<Gradient> gradients;
    for (const std::string& path : paths)
        gradients.push_back(
            gradient_of(arguments, path, mesh, basis, variables, threads, slip ? &*slip : nullptr));
    if (arguments.has("-o")) {
        OutputFiles files;
        const std::string& path = arguments.text("-o");
        write_gradients(files.add(path), path, gradients, basis, mesh);
        files.commit();
    }
    if (arguments.has("--json")) {
        print("%s\n", gradients_json(gradients, basis, mesh).text().c_str());
        return;
    }
    for (const Gradient& gradient : gradients) {
        print("objective        %s: derivatives at %s of the mesh's %d\n",
              gradient.objective.c_str(),
              plural(static_cast<std::int64_t>(gradient.points), "point").c_str(), mesh.points());
        const double limit = gradient.admissible_descent;
        print("steepest descent %s\n",
              std::isinf(limit) ? "no limit"
                                : (brief(limit) + " times the gradient, subtracted from the "
                                                  "control points, is admissible")
                                      .c_str());
    }
}

}  // namespace cli
