#include <harmorph_design.h>
#include <harmorph_study.h>
#include "commands/solver.hpp"

namespace cli {

Solver::Solver(const Mesh& mesh, const Task& task, const Threads& threads)
    : mesh_(mesh),
      mesh_view_(mesh.view()),
      curves_view_(task.curves),
      problem_(sized<hm_problem>()),
      options_(task.options),
      report_(sized<hm_solve_report>()) {
    problem_.mesh = &mesh_view_;
    problem_.curves = task.curves.curves.empty() ? nullptr : curves_view_.get();
    problem_.n_conditions = static_cast<std::int32_t>(task.conditions.size());
    problem_.conditions = task.conditions.data();
    problem_.n_given = static_cast<std::int32_t>(task.given_points.size());
    problem_.given_points = task.given_points.data();
    problem_.given_curves = task.given_curves.data();
    problem_.given_u = task.given_u.data();
    options_.executor = threads.executor();
    progress_.listen(options_);
}

hm_status Solver::run() {
    const Stopwatch watch;
    prepare();
    call(mesh_, hm_plan_factor, plan_, nullptr);
    const double before_solving = watch.seconds();
    hm_error error = {};
    const hm_status status = hm_plan_solve(plan_, basis_, &report_, &error);
    if (status < 0) refuse(error, mesh_);
    found_ = error.value;
    progress_.wipe();
    times_.factor = progress_.seconds(HM_PHASE_ORDERING) + progress_.seconds(HM_PHASE_SYMBOLIC) +
                    progress_.seconds(HM_PHASE_FACTOR);
    times_.setup = before_solving - times_.factor;
    times_.solve = progress_.seconds(HM_PHASE_SOLVE);
    return status;
}

void Solver::prepare() {
    analyse();
    lay_out();
}

void Solver::slide(Field& moved, Field& displacement) {
    if (analysis_ == nullptr) analyse();
    const Field before = moved;
    const hm_points from = before.read();
    const hm_points_out to = moved.write();
    call(mesh_, hm_slip, analysis_, &from, &to);
    for (std::size_t point = 0; point < moved.x.size(); ++point) {
        if (moved.x[point] != before.x[point])
            displacement.x[point] = moved.x[point] - mesh_.x[point];
        if (moved.y[point] != before.y[point])
            displacement.y[point] = moved.y[point] - mesh_.y[point];
    }
}

void Solver::analyse() {
    std::size_t bytes = 0;
    call(mesh_, hm_analysis_size, &problem_, &options_, &bytes);
    analysis_block_.resize(bytes);
    call(mesh_, hm_analysis_init, &analysis_, analysis_block_.data(), bytes, &problem_, &options_);
}

void Solver::lay_out() {
    std::size_t bytes = 0;
    call(mesh_, hm_plan_size, analysis_, &bytes);
    plan_block_.resize(bytes);
    call(mesh_, hm_plan_init, &plan_, plan_block_.data(), bytes, analysis_);
    call(mesh_, hm_basis_size, analysis_, &bytes);
    basis_block_.resize(bytes);
    call(mesh_, hm_basis_init, &basis_, basis_block_.data(), bytes, analysis_);
}

}  // namespace cli
