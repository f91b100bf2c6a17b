#include "plane_motion.hpp"

#include <algorithm>
#include <map>

namespace Foam {

namespace {

vector of_three(const double (&v)[3]) { return vector(v[0], v[1], v[2]); }

}  // namespace

PlaneMotion::PlaneMotion(const polyMesh& mesh, const GatheredMesh& points,
                         const PatchConditions& patches, const MotionSettings& settings)
    : points_(points),
      settings_(settings),
      refusal_(points, mesh.boundaryMesh().names()),
      now_(static_cast<std::size_t>(points.size()), Zero),
      reference_(now_),
      report_() {
    find_plane(points.view());
    const std::int32_t axis = info_.kind == HM_WEDGE ? add_axis() : -1;
    conditions_ = patches.conditions(mesh, info_, axis);
    solution_ =
        std::make_unique<PlaneSolution>(mesh_, start_, conditions_, settings_.options, refusal_);
}

void PlaneMotion::find_plane(const hm_space_mesh& space) {
    hm_error error;
    const char* const find = "find the mesh of the plane";
    const auto init = [&](hm_memory* m) { return hm_plane_init(&plane_, m, &space, &error); };
    refusal_.check(with_memory(block_, init), find, error);
    HM_INIT(info_);
    HM_INIT(mesh_);
    refusal_.check(hm_plane_info_get(plane_, &info_, &error), find, error);
    refusal_.check(hm_plane_mesh(plane_, &mesh_, &error), find, error);
    refusal_.set_plane(info_);
    const std::size_t stride =
        static_cast<std::size_t>(mesh_.points.stride ? mesh_.points.stride : 1);
    start_ = PlaneField(static_cast<std::size_t>(mesh_.n_points));
    for (std::size_t k = 0; k < start_.x.size(); ++k) {
        start_.x[k] = mesh_.points.x[k * stride];
        start_.y[k] = mesh_.points.y[k * stride];
    }
}

// No face of the mesh lies on the axis of a wedge. The edges of cells there receive a marker of
// their own, whose number is returned; -1: the mesh does not reach the axis.
std::int32_t PlaneMotion::add_axis() {
    using Edge = std::pair<std::int32_t, std::int32_t>;
    std::map<Edge, int> open;
    const auto count = [&](std::int32_t a, std::int32_t b) {
        if (a != b) ++open[{std::min(a, b), std::max(a, b)}];
    };
    for (std::int32_t cell = 0; cell < mesh_.n_cells; ++cell) {
        const std::int32_t begin = mesh_.cell_start[cell], end = mesh_.cell_start[cell + 1];
        for (std::int32_t k = begin; k < end; ++k)
            count(mesh_.cell_points[k], mesh_.cell_points[k + 1 < end ? k + 1 : begin]);
    }
    for (std::int32_t k = 0; k < mesh_.n_faces; ++k)
        count(mesh_.face_points[2 * k], mesh_.face_points[2 * k + 1]);
    const std::int32_t axis =
        1 + *std::max_element(mesh_.face_markers, mesh_.face_markers + mesh_.n_faces);
    face_points_.assign(mesh_.face_points, mesh_.face_points + 2 * mesh_.n_faces);
    face_markers_.assign(mesh_.face_markers, mesh_.face_markers + mesh_.n_faces);
    for (const auto& edge : open) {
        if (edge.second != 1) continue;
        face_points_.push_back(edge.first.first);
        face_points_.push_back(edge.first.second);
        face_markers_.push_back(axis);
    }
    if (static_cast<std::int32_t>(face_markers_.size()) == mesh_.n_faces) return -1;
    mesh_.n_faces = static_cast<std::int32_t>(face_markers_.size());
    mesh_.face_points = face_points_.data();
    mesh_.face_markers = face_markers_.data();
    return axis;
}

// Points opposite to one another must move alike, and in the plane.
void PlaneMotion::require_plane(const std::vector<vector>& wall,
                                const std::vector<char>& is_given) const {
    if (info_.kind != HM_PLANES) return;
    const vector normal = of_three(info_.normal);
    for (std::size_t k = 0; k < wall.size(); ++k) {
        if (!is_given[k]) continue;
        const std::size_t leader = static_cast<std::size_t>(info_.space_point[info_.follows[k]]);
        const scalar tolerance = 1e-6 * mag(wall[k]);
        if (std::abs(wall[k] & normal) > tolerance || mag(wall[k] - wall[leader]) > tolerance) {
            FatalErrorInFunction << "pointDisplacement displaces the point at "
                                 << points_.position(static_cast<label>(k)) << " by " << wall[k]
                                 << " and the point in the other plane, at "
                                 << points_.position(static_cast<label>(leader)) << ", by "
                                 << wall[leader]
                                 << ". Both must move alike and stay in their planes, as the "
                                    "motion is two-dimensional."
                                 << exit(FatalError);
        }
    }
}

PlaneField PlaneMotion::in_plane(const std::vector<vector>& displacement) const {
    const vector x = of_three(info_.x_direction), y = of_three(info_.y_direction);
    PlaneField field(start_.x.size());
    for (std::size_t k = 0; k < start_.x.size(); ++k) {
        const vector& by = displacement[static_cast<std::size_t>(info_.space_point[k])];
        field.x[k] = by & x;
        field.y[k] = by & y;
    }
    return field;
}

std::vector<vector> PlaneMotion::in_space(const PlaneField& displacement) const {
    std::vector<vector> field(now_.size(), Zero);
    double* const first = field.front().data();
    const hm_points by = displacement.read();
    const hm_space_points_out to = {first, first + 1, first + 2, 3};
    hm_error error;
    refusal_.check(hm_plane_spread(plane_, &by, nullptr, &to, nullptr, &error),
                   "move the points of the mesh", error);
    return field;
}

void PlaneMotion::restore(const std::vector<vector>& now, const std::vector<vector>& reference) {
    now_ = now;
    const bool same = std::equal(reference.begin(), reference.end(), reference_.begin());
    reference_ = reference;
    if (!same) solution_->factor(start_ + in_plane(reference_));
}

void PlaneMotion::factor_at(const PlaneField& displacement) {
    reference_ = in_space(displacement);
    solution_->factor(start_ + in_plane(reference_));
    report_.factored = true;
}

// One step from the reference by the factor of the plan. False: the mesh could not follow `margin`
// times as far, or crosses itself.
bool PlaneMotion::try_linear(const PlaneField& wall, scalar margin, PlaneField& moved,
                             hm_error& error) {
    const PlaneField reference = in_plane(reference_), from = start_ + reference;
    if (!solution_->displace(wall - reference, from, moved, error)) return false;
    report_.judgement = solution_->judge(from, moved);
    const Judgement& found = report_.judgement;
    if (!found.valid()) {
        error.code = HM_BAD_MESH;
        error.item_kind = HM_ITEM_CELL;
        error.item = found.quality.first_inverted;
        error.other_kind = HM_ITEM_NONE;
        std::snprintf(error.text, sizeof error.text,
                      "%d cells of the mesh would be inverted, or the boundary would cross itself",
                      static_cast<int>(found.quality.inverted));
        return false;
    }
    return std::min(found.step.admissible, found.step.boundary) > margin;
}

void PlaneMotion::step_safely(const PlaneField& wall, PlaneField& moved) {
    const PlaneField now = in_plane(now_);
    PlaneSolution from_here(mesh_, start_ + now, conditions_, settings_.options, refusal_);
    hm_safe_report safe;
    hm_error error;
    const hm_status status = from_here.displace_safely(wall - now, moved, safe, error);
    if (status < 0 || status == HM_SHORT) refusal_.refuse("move the mesh safely", error);
    report_.stepped_safely = true;
    factor_at(moved - start_);
}

void PlaneMotion::move(const std::vector<vector>& wall, const std::vector<char>& is_given) {
    require_plane(wall, is_given);
    report_ = MotionReport();
    const PlaneField target = in_plane(wall);
    // A factor of the mesh as it is cannot be replaced by a better one.
    const bool refactors = settings_.refactor > 0 && now_ != reference_;
    PlaneField moved;
    hm_error error = {};
    bool done = try_linear(target, refactors ? settings_.refactor : 1, moved, error);
    if (!done && refactors) {
        factor_at(in_plane(now_));
        done = try_linear(target, 1, moved, error);
    }
    if (!done && settings_.safe) {
        step_safely(target, moved);
    } else if (!done) {
        refusal_.refuse("move the mesh", error);
    }
    report_.judgement = solution_->judge(start_, moved);
    if (report_.judgement.quality.min_quality < settings_.improve) {
        solution_->improve(moved);
        factor_at(moved - start_);
        report_.improved = true;
        report_.judgement = solution_->judge(start_, moved);
    }
    report_.worst = refusal_.cell_at(report_.judgement.quality.min_quality_cell);
    now_ = in_space(moved - start_);
}

}  // namespace Foam
