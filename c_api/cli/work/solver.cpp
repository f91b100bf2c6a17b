#include "work/solver.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"

#include <harmorph_design.h>
#include <harmorph_study.h>

#include <algorithm>

namespace cli {

namespace {

// Names the option in the place of the field of the library.
[[noreturn]] void refuse_analysis(hm_error error, const Mesh& mesh) {
    const std::string field = "hm_problem.max_curve_distance", option = "--far-from-curve";
    std::string text = error.text;
    const std::size_t at = text.find(field);
    if (at != text.npos) text.replace(at, field.size(), option);
    text.copy(error.text, sizeof error.text - 1);
    error.text[std::min(text.size(), sizeof error.text - 1)] = '\0';
    refuse(error, mesh);
}

}  // namespace

Solver::Solver(const Mesh& mesh, const Task& task, const Threads& threads)
    : mesh_(mesh),
      mesh_view_(mesh.view()),
      curves_view_(task.curves),
      problem_(sized<hm_problem>()),
      options_(task.options),
      choice_(task.choice),
      report_(sized<hm_solve_report>()) {
    problem_.mesh = &mesh_view_;
    problem_.curves = task.curves.curves.empty() ? nullptr : curves_view_.get();
    problem_.n_conditions = static_cast<std::int32_t>(task.conditions.size());
    problem_.conditions = task.conditions.data();
    problem_.max_curve_distance = task.max_curve_distance;
    problem_.n_known = static_cast<std::int32_t>(task.known_points.size());
    problem_.known_points = task.known_points.data();
    problem_.known_curves = task.known_curves.data();
    problem_.known_u = task.known_u.data();
    task.fluxes.give_to(problem_);
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
    if (choice_.kinds.empty()) {
        analyse();
    } else {
        const auto try_kind = [this](const EngineKind& kind, double limit) {
            return memory_with(kind, limit);
        };
        engine_reason_ = choose_engine(choice_, try_kind);
        choice_.kinds.clear();  // another run has the same engine
    }
    lay_out();
}

// Makes the analysis for this kind of engine, unless the analysis alone needs more than the limit.
std::optional<MemoryNeed> Solver::memory_with(const EngineKind& kind, double limit) {
    options_.engine = kind.engine;
    hm_memory analysis = {}, plan = {}, basis = {};
    hm_error error = {};
    const bool is_first = kind.name == choice_.kinds[0].name;  // its refusal ends the command
    if (!is_first &&
        hm_analysis_init(nullptr, &analysis, &problem_, &options_, &error) == HM_UNSUPPORTED)
        return {};
    analysis = {};
    call(mesh_, hm_analysis_init, nullptr, &analysis, &problem_, &options_);
    MemoryNeed need = {static_cast<double>(hm_pages_room(analysis.bytes)), false};
    if (need.bytes > limit) return need;
    analyse();
    call(mesh_, hm_plan_init, nullptr, &plan, analysis_);
    call(mesh_, hm_basis_init, nullptr, &basis, analysis_);
    need.bytes += static_cast<double>(hm_pages_room(plan.bytes)) +
                  static_cast<double>(hm_pages_room(basis.bytes));
    need.is_of_all = true;
    return need;
}

void Solver::put_on_curves(Field& moved, Field& displacement) {
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

void Solver::take_off_curves(Field& by) {
    if (analysis_ == nullptr) analyse();
    const hm_points at = mesh_.coordinates(), on_curves = by.read();
    const hm_points_out before = by.write();
    call(mesh_, hm_slip_adjoint, analysis_, &at, &on_curves, &before);
}

void Solver::analyse() {
    hm_error error = {};
    const hm_status status = with_memory(analysis_block_, [&](hm_memory* memory) {
        return hm_analysis_init(&analysis_, memory, &problem_, &options_, &error);
    });
    if (status < 0) refuse_analysis(error, mesh_);
    const bool is_new = problem_.max_curve_distance != 0;  // not that of a basis
    if (status == HM_FAR_FROM_CURVE && is_new) warn(error.text);
}

void Solver::lay_out() {
    with_memory(plan_block_, [&](hm_memory* memory) {
        return call(mesh_, hm_plan_init, &plan_, memory, analysis_);
    });
    with_memory(basis_block_, [&](hm_memory* memory) {
        return call(mesh_, hm_basis_init, &basis_, memory, analysis_);
    });
}

void Solver::improve(Field& moved, Field& displacement, const hm_improve_options& options) {
    Block work;
    // hm_improve holds slipping points on the curves. Rounded coordinates may be beside the curves.
    put_on_curves(moved, displacement);
    const hm_points from = moved.read();
    const hm_points_out to = moved.write();
    with_memory(work, [&](hm_memory* memory) {
        return call(mesh_, hm_improve, plan_, &from, &to, memory, &options, nullptr);
    });
    for (std::size_t point = 0; point < mesh_.x.size(); ++point) {
        displacement.x[point] = moved.x[point] - mesh_.x[point];
        displacement.y[point] = moved.y[point] - mesh_.y[point];
    }
}

namespace {

struct Names {
    const hm_basis_info& info;
    const std::vector<hm_condition>& conditions;
    const Mesh& mesh;

    std::string of_condition(std::int32_t number) const {
        if (number < 0 || place(number) >= conditions.size()) return "another marker";
        const std::string name = mesh.name_of(conditions[place(number)]);
        return name.front() == '"' ? name : "'" + name + "'";
    }
    std::string of_point(std::int32_t point) const {
        return "point " + std::to_string(point) + " (" + brief(mesh.x[place(point)]) + ", " +
               brief(mesh.y[place(point)]) + ")";
    }
    // Returns both conditions of the shared point with this number.
    std::string of_both(std::int32_t shared) const {
        const std::int32_t first = info.shared_condition[2 * shared],
                           second = info.shared_condition[2 * shared + 1];
        if (first == second) return "both ends of the curve of " + of_condition(first);
        return of_condition(first) + " and to " + of_condition(second);
    }
    std::string remedy(std::int32_t shared) const {
        const auto is_rigid = [&](std::int32_t number) {
            return number >= 0 && conditions[place(number)].kind == HM_RIGID;
        };
        const std::int32_t* const both = info.shared_condition + 2 * shared;
        if (both[0] == both[1]) return "fit a tied curve, the ends of which are one control point";
        if (is_rigid(both[0]) && is_rigid(both[1])) return "make both markers one body";
        return "fit one curve through both markers (--marker A,B), or give the curves a common "
               "control point";
    }
};

}  // namespace

void warn_of_shared_points(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                           const Mesh& mesh) {
    constexpr std::int32_t max_told = 4;
    const Names names = {info, conditions, mesh};
    for (std::int32_t k = 0; k < std::min(info.shared_points, max_told); ++k) {
        warn(names.of_point(info.shared_point[k]) + " belongs to " + names.of_both(k) +
             ", which do not move it alike; a movement that takes them apart is refused: " +
             names.remedy(k));
    }
    if (info.shared_points > max_told) {
        warn(plural(info.shared_points - max_told, "more point") +
             " belong to two conditions that do not move them alike");
    }
}

std::string why_torn(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                     const Mesh& mesh, std::int32_t point, std::int32_t second, double distance) {
    const Names names = {info, conditions, mesh};
    for (std::int32_t k = 0; k < info.shared_points; ++k) {
        if (info.shared_point[k] != point || info.shared_condition[2 * k + 1] != second) continue;
        return "the movement tears the wall apart: " + names.of_point(point) + " belongs to " +
               names.of_both(k) + ", which would be " + brief(distance) + " apart there; " +
               names.remedy(k);
    }
    return "the movement tears the wall apart at " + names.of_point(point);
}

}  // namespace cli
