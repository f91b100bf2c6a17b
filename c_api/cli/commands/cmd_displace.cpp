// harmorph displace: moves the points of a wall as a file says, and the mesh with them; no curves
// are needed.
#include "basics/numbers.hpp"
#include "basics/elementary.hpp"
#include "basics/print.hpp"
#include "work/moves_file.hpp"
#include "commands/commands.hpp"
#include "commands/displacement.hpp"
#include "files/output_file.hpp"
#include "formats/format.hpp"
#include "work/engine.hpp"
#include "work/mesh_fields.hpp"
#include "work/read_mesh.hpp"
#include "work/solver.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

hm_basis_info info_of(const Mesh& mesh, const Solver& solver) {
    auto info = sized<hm_basis_info>();
    call(mesh, hm_basis_info_get, solver.basis(), &info);
    return info;
}

// Splits the rows of the table: those of points that a curve or body moves, and the other ones,
// which hm_displace takes.
WallField take_shared_rows(const hm_basis_info& info, WallField& wall) {
    const auto end = info.shared_point + info.shared_points;
    const WallField all = wall;
    WallField shared;
    wall = {};
    for (std::size_t k = 0; k < all.points.size(); ++k) {
        const bool is_shared = std::find(info.shared_point, end, all.points[k]) != end;
        WallField& to = is_shared ? shared : wall;
        to.points.push_back(all.points[k]);
        to.x.push_back(all.x[k]);
        to.y.push_back(all.y[k]);
    }
    return shared;
}

// Returns the diagonal of the box around the moving walls.
double extent_of(const Mesh& mesh, const hm_basis_info& info) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        const double at[2] = {mesh.x[point], mesh.y[point]};
        for (int i = 0; i < 2; ++i) {
            low[i] = std::min(low[i], at[i]);
            high[i] = std::max(high[i], at[i]);
        }
    }
    return length_of(high[0] - low[0], high[1] - low[1]);
}

// Returns why the movement tears two conditions of a point apart; empty if it does not. `shared`
// has the displacements that the table gives points of curves and bodies.
std::string tear_of(const Mesh& mesh, const Task& task, const Solver& solver,
                    const std::vector<double>& moves, const WallField& shared,
                    const Threads& threads) {
    if (moves.empty() && shared.points.empty()) return {};
    const hm_basis_info info = info_of(mesh, solver);
    Field by(mesh.x.size());
    if (!moves.empty()) {
        const hm_points at = mesh.coordinates();
        const hm_points_out to = by.write();
        double unused = 0;
        hm_error error = {};
        if (hm_boundary_error(solver.basis(), moves.data(), &at, &at, &unused, nullptr, &error) ==
            HM_TORN) {
            return why_torn(info, task.conditions, mesh, error.item - error.item_base,
                            error.other - error.other_base, error.value);
        }
        call(mesh, hm_morph, solver.basis(), moves.data(), nullptr, &to, threads.executor());
    }
    constexpr double tolerance = 1e-6;  // that of hm_boundary_error
    const double extent = extent_of(mesh, info);
    for (std::size_t k = 0; k < shared.points.size(); ++k) {
        const auto point = static_cast<std::size_t>(shared.points[k]);
        const double distance = length_of(by.x[point] - shared.x[k], by.y[point] - shared.y[k]);
        if (distance <= tolerance * extent) continue;
        const auto at =
            std::find(info.shared_point, info.shared_point + info.shared_points, shared.points[k]);
        return why_torn(info, task.conditions, mesh, *at,
                        info.shared_condition[2 * (at - info.shared_point) + 1], distance);
    }
    return {};
}

void displace(Solver& solver, const WallMovement& movement, const hm_points* from, Field& to,
              hm_memory& memory) {
    const hm_points given = movement.wall.read();
    const hm_points_out result = to.write();
    call(movement.path, hm_displace, solver.plan(), movement.wall.count(),
         movement.wall.points.data(), 1, &given, from, &result, &memory, nullptr);
}

// Computes the displacements of the mesh by control points and bodies alone, if there are any.
void displace_by_moves(const Mesh& mesh, const Solver& solver, const WallMovement& movement,
                       const Threads& threads, Field& to) {
    if (movement.moves.empty()) return;
    const hm_points_out result = to.write();
    call(mesh, hm_morph, solver.basis(), movement.moves.data(), nullptr, &result,
         threads.executor());
}

// The given displacements are added to those by control points and bodies: the boundary is checked
// for crossings with all displacements.
void at_once(const Mesh& mesh, Solver& solver, const WallMovement& movement, std::int32_t repeats,
             const Threads& threads, Displacement& found) {
    hm_memory memory = {};
    call(mesh, hm_displace, solver.plan(), 0, nullptr, 1, nullptr, nullptr, nullptr, &memory,
         nullptr);
    Block work(memory.bytes);
    memory.block = work.data();
    Field by_moves(mesh.x.size()), start(mesh.x.size());
    displace_by_moves(mesh, solver, movement, threads, by_moves);
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        start.x[point] = mesh.x[point] + by_moves.x[point];
        start.y[point] = mesh.y[point] + by_moves.y[point];
    }
    const hm_points from = start.read();
    displace(solver, movement, &from, found.moved,
             memory);  // refuses a boundary that crosses itself
    std::vector<double> seconds;
    for (std::int32_t i = 0; i < repeats; ++i) {
        const Stopwatch watch;
        displace(solver, movement, nullptr, found.by, memory);
        seconds.push_back(watch.seconds());
    }
    found.displace_seconds = median(seconds);
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        found.by.x[point] += by_moves.x[point];
        found.by.y[point] += by_moves.y[point];
    }
}

void safely(const Mesh& mesh, Solver& solver, const WallMovement& movement, hm_safe_options options,
            Displacement& found) {
    const hm_points given = movement.wall.read();
    auto target = sized<hm_safe_target>();
    if (!movement.moves.empty()) target.move = movement.moves.data();
    target.n = movement.wall.count();
    target.points = movement.wall.points.data();
    target.wall = &given;
    Block work;
    found.moved.x = mesh.x;
    found.moved.y = mesh.y;
    found.safe = sized<hm_safe_report>();
    const hm_points_out to = found.moved.write();
    found.moves = movement.moves;
    if (!found.moves.empty()) options.reached = found.moves.data();
    hm_error error = {};
    const Stopwatch watch;
    const hm_status status = with_memory(work, [&](hm_memory* memory) {
        return hm_move_safe(solver.plan(), solver.basis(), &target, &to, memory, &options,
                            &*found.safe, &error);
    });
    found.displace_seconds = watch.seconds();
    if (status < 0) refuse(error, mesh);
    (status == HM_SHORT ? found.refusal : found.warning) = status != HM_OK ? error.text : "";
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        found.by.x[point] = found.moved.x[point] - mesh.x[point];
        found.by.y[point] = found.moved.y[point] - mesh.y[point];
    }
}

Displacement displacement_of(const Arguments& arguments, const Mesh& mesh, const Task& task,
                             Solver& solver, WallMovement movement, bool is_first,
                             const Threads& threads) {
    const std::int32_t repeats = arguments.whole("--repeat", 1, 1, 1000000);
    Displacement found(mesh);
    const Stopwatch whole;
    solver.prepare();
    call(mesh, hm_plan_factor, solver.plan(), nullptr);
    found.factor_seconds = whole.seconds();
    found.engine = solver.engine_reason();
    found.info = info_of(mesh, solver);
    found.curve_points.assign(found.info.curve_point,
                              found.info.curve_point + found.info.curve_points);
    const WallField shared = take_shared_rows(found.info, movement.wall);
    found.moves = movement.moves;
    if (!movement.moves.empty())
        call(mesh, hm_plan_solve, solver.plan(), solver.unsolved(), nullptr);
    if (is_first) warn_of_shared_points(found.info, task.conditions, mesh);
    found.torn = tear_of(mesh, task, solver, movement.moves, shared, threads);
    if (!found.torn.empty() && !arguments.has("--force")) throw Failure(exit_unusable, found.torn);
    if (arguments.has("--safe")) {
        safely(mesh, solver, movement, safe_options_of(arguments), found);
    } else {
        at_once(mesh, solver, movement, repeats, threads, found);
        solver.put_on_curves(found.moved, found.by);
    }
    const hm_points linear = found.by.read();
    const hm_mesh view = mesh.view();
    call(mesh, hm_assess, solver.basis(), &view, nullptr, &linear, nullptr, threads.executor(),
         &found.step, nullptr);
    const bool may_improve = found.step.admissible > 1;
    if (!arguments.has("--safe") && arguments.has("--improve") && may_improve)
        solver.improve(found.moved, found.by, improve_options_of(arguments));
    found.measure_boundary(mesh, solver, movement);
    if (arguments.has("--report"))
        found.judged =
            std::make_shared<JudgedMesh>(mesh, solver.basis(), task.conditions, found.by);
    // The basis does not outlive this function.
    found.info.curve_point = found.info.shared_point = found.info.shared_condition = nullptr;
    // The quality is that of the coordinates in the file.
    round_as_file(mesh, found.moved.x, found.moved.y);
    const hm_points at = found.moved.read(), start = mesh.coordinates();
    call(mesh, hm_assess, solver.basis(), &view, &at, nullptr, &start, threads.executor(), nullptr,
         &found.quality);
    return found;
}

WallMovement movement_of(const Arguments& arguments, const Mesh& mesh, const Task& task) {
    const std::string& path = arguments.text("--wall");
    WallMovement movement = {
        path, read_wall_field(path, mesh, task.conditions, arguments.has("--in-order")), {}};
    const CurvesView curves(task.curves);
    Movable movable = {static_cast<std::int32_t>(task.curves.control.size() / 2), 0, 0,
                       task.conditions, [&curves]() -> const hm_curves& { return *curves.get(); }};
    for (const hm_condition& condition : task.conditions) {
        if (condition.kind == HM_RIGID)
            movable.n_bodies = std::max(movable.n_bodies, condition.body + 1);
    }
    for (const char* const option : {"--move", "--by"}) {
        if (arguments.has(option) && movable.functions() == 0)
            arguments.refuse(std::string(option) + " needs --curve or --rigid");
    }
    movable.n_curves = static_cast<std::int32_t>(task.curves.curves.size());
    std::vector<MovementError> errors;
    movement.moves = read_moves(texts_of_moves(arguments), movable, mesh, &errors);
    warn_of_errors(errors);
    return movement;
}

// Displaces by one operator. If operators are compared, or the chosen one does not reach the target
// safely, displaces by two and returns the better result.
Displacement best_displacement(const Arguments& arguments, const Mesh& mesh, const Task& task,
                               const WallMovement& movement, const Threads& threads) {
    const std::int32_t own = task.options.operator_kind;
    std::vector<OperatorTrial> trials;
    const auto run = [&](std::int32_t kind, OperatorTrial& trial) {
        Task by = task;
        if (kind != own) {
            by.options.operator_kind = kind;
            by.options.exponent = by.options.offset_correction = 0;
        }
        Solver solver(mesh, by, threads);
        Displacement found =
            displacement_of(arguments, mesh, by, solver, movement, trials.empty(), threads);
        trial.step_fraction = found.safe ? found.safe->step_fraction : found.valid() ? 1 : 0;
        trial.min_quality = found.quality.min_quality;
        trial.is_short = own != HM_CONFORMAL && !found.refusal.empty();
        return found;
    };
    Displacement best =
        best_of_operators(operators_to_compare(own), compares_operators(arguments), trials, run);
    best.trials = trials;
    return best;
}

}  // namespace

void run_displace(const Arguments& arguments) {
    if (!arguments.has("--given")) arguments.refuse("--given is missing");
    check_safe_options(arguments);
    const Mesh mesh = read_mesh(arguments, 0);
    if (compares_operators(arguments) && arguments.has("--exponent"))
        arguments.refuse(
            "--exponent cannot be used with --operator auto, which compares operators");
    const Task task = task_of(arguments, mesh);
    const WallMovement movement = movement_of(arguments, mesh, task);
    const Threads threads(threads_of(arguments), kernel_of(arguments));
    const Displacement found = best_displacement(arguments, mesh, task, movement, threads);
    if (found.safe) warn_of_heights(arguments, *found.safe, found.valid());
    const bool strict = arguments.has("--strict") && !found.warning.empty();
    const bool reached = found.valid() && found.refusal.empty() && !strict;
    OutputFiles files;  // the report is written for invalid meshes, too
    if (reached || arguments.has("--force")) write_displacement(arguments, mesh, found, files);
    if (arguments.has("--report"))
        write_displacement_page(files.add(arguments.text("--report")), mesh, task, movement, found);
    files.commit();
    if (arguments.has("--json")) print_json(found);
    else print_displacement(found);
    if (!found.valid()) throw Failure(exit_unusable, why_invalid(found, mesh));
    if (!reached)
        throw Failure(exit_unusable, found.refusal.empty() ? found.warning : found.refusal);
    if (!found.warning.empty()) warn(found.warning);
}

}  // namespace cli
