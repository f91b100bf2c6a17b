// harmorph solve: solves the basis, the harmonic functions of all control points on a mesh.
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "work/basis_file.hpp"
#include "work/engine.hpp"
#include "work/mesh_fields.hpp"
#include "work/read_mesh.hpp"
#include "work/safe_way.hpp"
#include "work/solver.hpp"
#include "work/task.hpp"
#include "work/wall_field.hpp"

#include <harmorph_bases.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cli {

namespace {

constexpr std::size_t max_history = 200001;  // Runge-Kutta steps on one level, and the start

// Returns the median times of further runs. The first run, which also touches the memory for the
// first time, was made by the caller.
SolveTimes repeat(Solver& solver, std::int32_t runs) {
    std::vector<double> setup, factor, solve;
    for (std::int32_t i = 0; i < runs; ++i) {
        solver.run();
        setup.push_back(solver.times().setup);
        factor.push_back(solver.times().factor);
        solve.push_back(solver.times().solve);
    }
    return {median(setup), median(factor), median(solve)};
}

void print_json(const Solver& solver, const Stored& stored, const Mesh& mesh,
                const SolveTimes& times) {
    const hm_solve_report& report = solver.report();
    JsonObject object;
    object.add("points", mesh.points())
        .add("cells", mesh.cells())
        .add("functions", report.functions);
    object.add("boundary_error", report.boundary_error)
        .add("partition_defect", report.partition_defect);
    object.add("min_value", report.min_value)
        .add("max_value", report.max_value)
        .add("residual", report.residual);
    object.add("iterations", report.iterations)
        .add("work", report.work)
        .add("levels", report.levels);
    object.add("engine", solver.engine_reason());
    object.add("setup_seconds", times.setup)
        .add("factor_seconds", times.factor)
        .add("solve_seconds", times.solve);
    object.add("plan_bytes", static_cast<std::int64_t>(solver.plan_bytes()));
    object.add("basis_bytes", static_cast<std::int64_t>(stored.bytes()));
    object.add("storage", std::string(stored.in_single() ? "single" : "double"));
    print("%s\n", object.text().c_str());
}

void print_for_people(const Solver& solver, const Stored& stored, const Mesh& mesh,
                      const Task& task, const SolveTimes& times) {
    const hm_solve_report& report = solver.report();
    print("%s on %s and %s, %s\n", plural(report.functions, "function").c_str(),
          plural(mesh.points(), "point").c_str(), plural(mesh.cells(), "cell").c_str(),
          plural(report.unknowns, "unknown").c_str());
    print("engine           %s\n", solver.engine_reason().c_str());
    for (const std::string& passage : task.passages)
        print("passage          %s\n", passage.c_str());
    print("residual         %s (function %d)\n", brief(report.residual).c_str(),
          report.residual_function + 1);
    if (report.iterations > 0) {
        print("iterations       %s on %s, the work of %s sweeps over the finest\n",
              brief(report.iterations).c_str(), plural(report.levels, "level").c_str(),
              brief(report.work).c_str());
    }
    if (report.curve_points > 0) {
        print("boundary error   %s", brief(report.boundary_error).c_str());
        if (!task.curves.curves.empty())
            print("; sum of the functions there: 1 to %s", brief(report.partition_defect).c_str());
        print("\n");
    }
    if (!task.curves.curves.empty()) {  // there are functions of control points
        print("values           %s to %s\n", brief(report.min_value).c_str(),
              brief(report.max_value).c_str());
        print("mesh from curve  %s at most (point %d), kept by every morph\n",
              brief(report.max_distance).c_str(), report.max_distance_point);
    }
    const char* const preparation = report.factor_entries > 0 ? "factorisation" : "agglomeration";
    print("seconds          %s set-up, %s %s, %s solution\n", brief(times.setup).c_str(),
          brief(times.factor).c_str(), preparation, brief(times.solve).c_str());
    print("megabytes        %s plan, %s basis%s\n",
          brief(1e-6 * static_cast<double>(solver.plan_bytes())).c_str(),
          brief(1e-6 * static_cast<double>(stored.bytes())).c_str(),
          stored.in_single() ? " in single precision" : "");
}

// The functions whose wall values are tables, one for each file of --mode. They follow all other
// functions of the basis.
class Modes {
public:
    Modes(const Arguments& arguments, const Mesh& mesh, const Task& task)
        : paths_(arguments.all("--mode")) {
        if (paths_.empty()) return;
        if (!arguments.has("--given"))
            arguments.refuse(
                "--mode states displacements of the markers of --given, but --given is missing");
        const bool in_order = arguments.has("--in-order");
        for (const std::string& path : paths_)
            add(path, read_wall_field(path, mesh, task.conditions, in_order));
    }
    const hm_basis* append_to(Solver& solver) {
        if (paths_.empty()) return solver.basis();
        auto modes = sized<hm_modes>();
        modes.n_modes = static_cast<std::int32_t>(paths_.size());
        modes.n = static_cast<std::int32_t>(points_.size());
        modes.points = points_.data();
        modes.values = values_.data();
        hm_basis* basis = nullptr;
        with_memory(block_, [&](hm_memory* memory) {
            return call(paths_[0], hm_tabulate, &basis, memory, solver.plan(), solver.basis(),
                        &modes, nullptr);
        });
        return basis;
    }

private:
    // Adds the values of a file, in the order of the points of the first file.
    void add(const std::string& path, const WallField& field) {
        if (points_.empty()) points_ = field.points;
        std::vector<std::size_t> place(points_.size());
        std::iota(place.begin(), place.end(), std::size_t{0});
        if (field.points != points_) {
            for (std::size_t k = 0; k < points_.size(); ++k) {
                const auto found = std::find(field.points.begin(), field.points.end(), points_[k]);
                if (found == field.points.end() || field.points.size() != points_.size()) {
                    throw Failure(exit_file,
                                  path + ": the table does not have the points of " + paths_[0]);
                }
                place[k] = static_cast<std::size_t>(found - field.points.begin());
            }
        }
        for (const std::size_t k : place) {
            values_.push_back(field.x[k]);
            values_.push_back(field.y[k]);
        }
    }

    std::vector<std::string> paths_;
    std::vector<std::int32_t> points_;
    std::vector<double> values_;
    Block block_;
};

std::string why_not_converged(const Solver& solver, const hm_options& options) {
    const double residual = solver.report().residual;
    if (!(residual <= options.tolerance))
        return "the residual " + brief(residual) + " is above " + brief(options.tolerance);
    if (solver.found() == 0) return "values are still off by more than " + brief(options.tolerance);
    return "values may still be off by " + brief(solver.found()) + ", as cells are very thin";
}

}  // namespace

void run_solve(const Arguments& arguments) {
    const std::string path = arguments.text("-o");
    const std::int32_t repeats = arguments.whole("--repeat", 1, 1, 1000000);
    if (!arguments.has("--curve") && !arguments.has("--rigid") && !arguments.has("--mode")) {
        arguments.refuse("--curve MARKER=FILE, --rigid MARKER or --mode FIELD is missing");
    }
    if (compares_operators(arguments))
        arguments.refuse("--operator auto is only for displace and for morph --safe");
    const Mesh mesh = read_mesh(arguments, 0);
    Task task = task_of(arguments, mesh);
    Modes modes(arguments, mesh, task);
    std::vector<double> history(arguments.has("--history") ? max_history : 0);
    task.options.history = history.data();
    task.options.history_length = static_cast<std::int32_t>(history.size());
    const Threads threads(threads_of(arguments), kernel_of(arguments));
    Solver solver(mesh, task, threads);
    const bool converged = solver.run() == HM_OK;
    const SolveTimes times = repeats > 1 ? repeat(solver, repeats) : solver.times();
    const Stored stored(arguments, mesh, modes.append_to(solver));
    OutputFiles files;
    if (arguments.has("--history")) {
        write_history(files.add(arguments.text("--history")), history, solver.report().iterations);
    }
    if (converged || arguments.has("--force")) write_basis(files.add(path), stored.basis(), mesh);
    files.commit();
    auto info = sized<hm_basis_info>();
    call(mesh, hm_basis_info_get, solver.basis(), &info);
    warn_of_shared_points(info, task.conditions, mesh);
    if (arguments.has("--json")) {
        print_json(solver, stored, mesh, times);
    } else {
        print_for_people(solver, stored, mesh, task, times);
    }
    if (!converged)
        throw Failure(exit_unusable,
                      "the solution has not converged: " + why_not_converged(solver, task.options));
}

}  // namespace cli
