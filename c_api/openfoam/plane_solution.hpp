// The library's objects for one plane mesh: analysis, plan and basis, and the calls that carry
// displacements of the walls to all points.
#ifndef HARMORPH_PLANE_SOLUTION_HPP
#define HARMORPH_PLANE_SOLUTION_HPP

#include "refusal.hpp"

#include <harmorph_design.h>

namespace Foam {

// Two numbers for each point: coordinates or displacements in the plane.
struct PlaneField {
    std::vector<double> x, y;

    PlaneField() = default;
    explicit PlaneField(std::size_t n) : x(n), y(n) {}
    hm_points read() const { return {x.data(), y.data(), 1}; }
    hm_points_out write() { return {x.data(), y.data(), 1}; }
};
PlaneField operator+(PlaneField a, const PlaneField& b);
PlaneField operator-(PlaneField a, const PlaneField& b);

// Holds the reports of hm_assess on a movement and on the mesh after the movement.
struct Judgement {
    hm_step_report step;
    hm_quality_report quality;
    bool valid() const { return quality.inverted == 0 && quality.self_crossing == 0; }
};

class PlaneSolution {
public:
    // The mesh of the plane with its coordinates at `at`; factors there.
    PlaneSolution(const hm_mesh& plane, const PlaneField& at,
                  const std::vector<hm_condition>& conditions, const hm_options& options,
                  const Refusal& refusal);
    PlaneSolution(const PlaneSolution&) = delete;
    void operator=(const PlaneSolution&) = delete;

    void factor(const PlaneField& at);
    // Moves all points from `from` with the factor of the plan. `wall` is a field of all points, of
    // which the wall points are read. Returns false where the boundary crosses itself; `to` is then
    // unchanged, and `error` says where.
    bool displace(const PlaneField& wall, const PlaneField& from, PlaneField& to, hm_error& error);
    // Does the same safely, from the coordinates of the mesh. Returns the status.
    hm_status displace_safely(const PlaneField& wall, PlaneField& to, hm_safe_report& report,
                              hm_error& error);
    void improve(PlaneField& moved);
    Judgement judge(const PlaneField& from, const PlaneField& to) const;

private:
    PlaneField wall_of(const PlaneField& field) const;

    PlaneField at_;
    hm_mesh mesh_;
    const Refusal& refusal_;
    std::vector<unsigned char> analysis_block_, plan_block_, basis_block_, work_;
    hm_analysis* analysis_ = nullptr;
    hm_plan* plan_ = nullptr;
    hm_basis* basis_ = nullptr;
    std::vector<std::int32_t> given_;
};

}  // namespace Foam

#endif
