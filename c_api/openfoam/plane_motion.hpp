// The mesh of the plane as the walls move: by one factorisation as long as this serves, then by
// another one on the mesh as it is, then by safe steps. Only the master has an object.
#ifndef HARMORPH_PLANE_MOTION_HPP
#define HARMORPH_PLANE_MOTION_HPP

#include "patch_conditions.hpp"
#include "plane_solution.hpp"

#include <memory>

namespace Foam {

struct MotionSettings {
    hm_options options;
    bool safe;
    // Factors again where the mesh could follow less than `refactor` times the movement since the
    // last factorisation; 0: never.
    scalar refactor;
    scalar improve;  // improves meshes whose smallest quality is lower; 0: never
};

// Says how the mesh reached the last target.
struct MotionReport {
    Judgement judgement;
    bool factored, stepped_safely, improved;
    point worst;  // a corner of the poorest cell, in points0
};

class PlaneMotion {
public:
    PlaneMotion(const polyMesh& mesh, const GatheredMesh& points, const PatchConditions& patches,
                const MotionSettings& settings);

    // Fields of displacements from points0, in the order of GatheredMesh: the mesh as it is, and
    // the mesh on which the matrix was factored. Together they are the state of a restart.
    void restore(const std::vector<vector>& now, const std::vector<vector>& reference);
    const std::vector<vector>& now() const { return now_; }
    const std::vector<vector>& reference() const { return reference_; }

    // Moves the mesh so that points with is_given are displaced by `wall`.
    void move(const std::vector<vector>& wall, const std::vector<char>& is_given);
    const MotionReport& report() const { return report_; }

private:
    void find_plane(const hm_space_mesh& space);
    std::int32_t add_axis();
    void require_plane(const std::vector<vector>& wall, const std::vector<char>& is_given) const;
    PlaneField in_plane(const std::vector<vector>& displacement) const;
    std::vector<vector> in_space(const PlaneField& displacement) const;
    void factor_at(const PlaneField& displacement);
    bool try_linear(const PlaneField& wall, scalar margin, PlaneField& moved, hm_error& error);
    void step_safely(const PlaneField& wall, PlaneField& moved);

    const GatheredMesh& points_;
    MotionSettings settings_;
    Refusal refusal_;
    std::vector<unsigned char> block_;
    hm_plane* plane_ = nullptr;
    hm_plane_info info_;
    hm_mesh mesh_;
    std::vector<std::int32_t> face_points_, face_markers_;  // with those of the axis of a wedge
    PlaneField start_;
    std::vector<hm_condition> conditions_;
    std::unique_ptr<PlaneSolution> solution_;
    std::vector<vector> now_, reference_;
    MotionReport report_;
};

}  // namespace Foam

#endif
