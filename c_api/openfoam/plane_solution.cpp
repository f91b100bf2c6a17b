#include "plane_solution.hpp"

namespace Foam {

PlaneField operator+(PlaneField a, const PlaneField& b) {
    for (std::size_t k = 0; k < a.x.size(); ++k) {
        a.x[k] += b.x[k];
        a.y[k] += b.y[k];
    }
    return a;
}

PlaneField operator-(PlaneField a, const PlaneField& b) {
    for (std::size_t k = 0; k < a.x.size(); ++k) {
        a.x[k] -= b.x[k];
        a.y[k] -= b.y[k];
    }
    return a;
}

PlaneSolution::PlaneSolution(const hm_mesh& plane, const PlaneField& at,
                             const std::vector<hm_condition>& conditions, const hm_options& options,
                             const Refusal& refusal)
    : at_(at), mesh_(plane), refusal_(refusal) {
    mesh_.points = at_.read();
    hm_problem problem;
    HM_INIT(problem);
    problem.mesh = &mesh_;
    problem.n_conditions = static_cast<std::int32_t>(conditions.size());
    problem.conditions = conditions.data();

    hm_error error;
    const char* const analyse = "analyse the mesh";
    const auto init_analysis = [&](hm_memory* memory) {
        return hm_analysis_init(&analysis_, memory, &problem, &options, &error);
    };
    const auto init_plan = [&](hm_memory* memory) {
        return hm_plan_init(&plan_, memory, analysis_, &error);
    };
    const auto init_basis = [&](hm_memory* memory) {
        return hm_basis_init(&basis_, memory, analysis_, &error);
    };
    refusal.check(with_memory(analysis_block_, init_analysis), analyse, error);
    refusal.check(with_memory(plan_block_, init_plan), analyse, error);
    refusal.check(with_memory(basis_block_, init_basis), analyse, error);
    given_.resize(static_cast<std::size_t>(mesh_.n_points));
    std::int32_t n = 0;
    refusal.check(hm_given_points(plan_, given_.data(), mesh_.n_points, &n, &error), analyse,
                  error);
    given_.resize(static_cast<std::size_t>(n));
    factor(at_);
}

void PlaneSolution::factor(const PlaneField& at) {
    hm_error error;
    const hm_points points = at.read();
    refusal_.check(hm_plan_factor(plan_, &points, &error), "factor the matrix", error);
}

PlaneField PlaneSolution::wall_of(const PlaneField& field) const {
    PlaneField wall(given_.size());
    for (std::size_t k = 0; k < given_.size(); ++k) {
        wall.x[k] = field.x[static_cast<std::size_t>(given_[k])];
        wall.y[k] = field.y[static_cast<std::size_t>(given_[k])];
    }
    return wall;
}

bool PlaneSolution::displace(const PlaneField& wall, const PlaneField& from, PlaneField& to,
                             hm_error& error) {
    const PlaneField own = wall_of(wall);
    const hm_points given = own.read(), start = from.read();
    PlaneField moved(from.x.size());
    const hm_points_out result = moved.write();
    const hm_status status = with_memory(work_, [&](hm_memory* memory) {
        return hm_displace(plan_, static_cast<std::int32_t>(given_.size()), given_.data(), 1,
                           &given, &start, &result, memory, nullptr, &error);
    });
    if (status == HM_CROSSING) return false;
    refusal_.check(status, "displace the mesh", error);
    const hm_points linear = moved.read();
    refusal_.check(hm_slip(analysis_, &linear, &result, &error),
                   "keep points on boundaries with slip", error);
    to = moved;
    return true;
}

hm_status PlaneSolution::displace_safely(const PlaneField& wall, PlaneField& to,
                                         hm_safe_report& report, hm_error& error) {
    const PlaneField own = wall_of(wall);
    const hm_points given = own.read();
    hm_safe_target target;
    HM_INIT(target);
    target.n = static_cast<std::int32_t>(given_.size());
    target.points = given_.data();
    target.wall = &given;
    to = at_;
    const hm_points_out result = to.write();
    HM_INIT(report);
    return with_memory(work_, [&](hm_memory* memory) {
        return hm_move_safe(plan_, basis_, &target, &result, memory, nullptr, &report, &error);
    });
}

void PlaneSolution::improve(PlaneField& moved) {
    hm_error error;
    const hm_points from = moved.read();
    const hm_points_out to = moved.write();
    const auto improve = [&](hm_memory* memory) {
        return hm_improve(plan_, &from, &to, memory, nullptr, nullptr, &error);
    };
    refusal_.check(with_memory(work_, improve), "improve the mesh", error);
}

Judgement PlaneSolution::judge(const PlaneField& from, const PlaneField& to) const {
    Judgement found;
    HM_INIT(found.step);
    HM_INIT(found.quality);
    hm_error error;
    const PlaneField movement = to - from;
    const hm_points start = from.read(), by = movement.read(), reference = at_.read();
    refusal_.check(hm_assess(basis_, &mesh_, &start, &by, &reference, nullptr, &found.step,
                             &found.quality, &error),
                   "judge the mesh", error);
    return found;
}

}  // namespace Foam
