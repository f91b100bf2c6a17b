#include "work/morph.hpp"

#include "basics/numbers.hpp"
#include "basics/progress.hpp"
#include "formats/format.hpp"
#include "work/solver.hpp"

#include <harmorph_study.h>

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

void move_points(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves, Field& to,
                 const Threads& threads) {
    const hm_points from = mesh.coordinates();
    const hm_points_out result = to.write();
    call(basis.path(), hm_morph, basis.get(), moves.data(), &from, &result, threads.executor());
}

double median_seconds(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves,
                      Field& to, std::int32_t repeats, const Threads& threads) {
    std::vector<double> seconds;
    for (std::int32_t i = 0; i < repeats; ++i) {
        const Stopwatch watch;
        move_points(basis, mesh, moves, to, threads);
        seconds.push_back(watch.seconds());
    }
    return median(seconds);
}

// `error` names the point and its second condition.
std::string why_torn_by(const Basis& basis, const Mesh& mesh, const hm_error& error) {
    return why_torn(basis.info(), basis.conditions(), mesh, error.item - error.item_base,
                    error.other - error.other_base, error.value);
}

}  // namespace

Field displacement(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves,
                   const Threads& threads) {
    Field field(mesh.x.size());
    const hm_points_out result = field.write();
    call(basis.path(), hm_morph, basis.get(), moves.data(), nullptr, &result, threads.executor());
    return field;
}

hm_step_report admissible_step(const Basis& basis, const Mesh& mesh, const Field& displacement,
                               const Threads& threads) {
    const hm_mesh view = mesh.view();
    const hm_points along = displacement.read();
    auto report = sized<hm_step_report>();
    call(mesh, hm_assess, basis.get(), &view, nullptr, &along, nullptr, threads.executor(), &report,
         nullptr);
    return report;
}

double valid_fraction(const hm_step_report& step) {
    return std::min(step.admissible, step.boundary);
}

Morph::Morph(const Basis& basis, const Mesh& mesh, const std::vector<double>& moves_of_functions,
             std::int32_t repeats, const Threads& threads)
    : moves(moves_of_functions),
      displacement(cli::displacement(basis, mesh, moves, threads)),
      moved(mesh.x.size()),
      step(sized<hm_step_report>()),
      quality(sized<hm_quality_report>()),
      safe(sized<hm_safe_report>()) {
    if (repeats > 1) move_points(basis, mesh, moves, moved, threads);  // a warm-up
    seconds = median_seconds(basis, mesh, moves, moved, repeats, threads);
    put_on_curves(basis, mesh, threads);
    judge(basis, mesh, threads);
}

Morph::Morph(const Basis& basis, const Mesh& mesh, const std::vector<double>& target,
             hm_safe_options options, std::int32_t operator_kind, const Threads& threads,
             const FluxList& fluxes)
    : moves(target.size()),
      displacement(mesh.x.size()),
      moved(mesh.x.size()),
      step(sized<hm_step_report>()),
      quality(sized<hm_quality_report>()),
      safe(sized<hm_safe_report>()) {
    const Stopwatch watch;
    Task task = task_of(basis);
    task.fluxes = fluxes;
    const bool is_own = operator_kind == task.options.operator_kind;
    if (!is_own) {
        task.options.operator_kind = operator_kind;
        task.options.exponent = 0;
        task.options.offset_correction = 0;
    }
    Solver solver(mesh, task, threads);
    if (is_own) solver.prepare();
    else solver.run();
    const hm_basis* const functions = is_own ? basis.get() : solver.basis();
    auto to_move = sized<hm_safe_target>();
    to_move.move = target.data();
    Block work;
    moved.x = mesh.x;
    moved.y = mesh.y;
    options.reached = moves.data();  // all values stay 0 if the target is refused
    const hm_points_out to = moved.write();
    hm_error error = {};
    const hm_status status = with_memory(work, [&](hm_memory* memory) {
        return hm_move_safe(solver.plan(), functions, &to_move, &to, memory, &options, &safe,
                            &error);
    });
    if (status < 0 && status != HM_CROSSING) refuse(error, mesh);
    impossible = status == HM_CROSSING;
    const bool is_torn = status == HM_CROSSING && error.other_kind == HM_ITEM_CONDITION;
    if (is_torn) {
        refusal = why_torn_by(basis, mesh, error);
    } else if (status == HM_POOR || status == HM_NOT_CONVERGED) {
        warning = error.text;
    } else if (status != HM_OK) {
        refusal = error.text;
    }
    seconds = watch.seconds();
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        displacement.x[point] = moved.x[point] - mesh.x[point];
        displacement.y[point] = moved.y[point] - mesh.y[point];
    }
    judge(basis, mesh, threads);
}

std::vector<double> Morph::moved_control(const Basis& basis) const {
    const hm_curves& before = basis.curves();
    std::vector<double> control(before.control, before.control + 2 * before.n_control);
    for (std::size_t i = 0; i < control.size(); ++i) control[i] += moves[i];
    return control;
}

void Morph::improve(const Basis& basis, const Mesh& mesh, const Threads& threads,
                    const hm_improve_options& options) {
    const Stopwatch watch;
    const Task task = task_of(basis);
    Solver solver(mesh, task, threads);
    solver.prepare();
    solver.improve(moved, displacement, options);
    seconds += watch.seconds();
    const hm_step_report step_of_morph = step;
    judge(basis, mesh, threads);
    step = step_of_morph;
}

Curves Morph::moved_curves(const Basis& basis) const {
    Curves curves = copied(basis.curves());
    curves.control = moved_control(basis);
    return curves;
}

// Puts points that slip along curves onto the curves.
void Morph::put_on_curves(const Basis& basis, const Mesh& mesh, const Threads& threads) {
    const Task task = task_of(basis);
    if (!task.slips()) return;
    Solver solver(mesh, task, threads);
    solver.put_on_curves(moved, displacement);
}

void Morph::judge(const Basis& basis, const Mesh& mesh, const Threads& threads) {
    round_as_file(mesh, moved.x, moved.y);  // what is judged is what can be written
    const hm_mesh view = mesh.view();
    const hm_points along = displacement.read(), to = moved.read();
    call(mesh, hm_assess, basis.get(), &view, nullptr, &along, nullptr, threads.executor(), &step,
         &quality);
    hm_error error = {};
    const hm_status status = hm_boundary_error(basis.get(), moves.data(), &view.points, &to,
                                               &boundary_error, nullptr, &error);
    if (status < 0) refuse(error, mesh);
    if (status == HM_TORN) torn = why_torn_by(basis, mesh, error);
    boundary_error =
        std::fabs(boundary_error - safe.rotated_offset);  // without the offsets that turned
    boundary_error += basis.distance_from_curves();       // the distance before this movement
}

}  // namespace cli
