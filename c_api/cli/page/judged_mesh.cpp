#include "page/judged_mesh.hpp"

#include "basics/library.hpp"
#include "mesh/mesh_analysis.hpp"

#include <harmorph_design.h>
#include <harmorph_fields.h>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

namespace cli {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::vector<std::int32_t> moving_markers(const std::vector<hm_condition>& conditions) {
    std::vector<std::int32_t> markers;
    for (const hm_condition& condition : conditions) {
        const std::int32_t kind = condition.kind;
        if (kind == HM_ON_CURVE || kind == HM_RIGID || kind == HM_GIVEN)
            markers.push_back(condition.marker);
    }
    std::sort(markers.begin(), markers.end());
    markers.erase(std::unique(markers.begin(), markers.end()), markers.end());
    return markers;
}

// Joins faces, which are in order along the boundary, to walls. A wall that begins where another
// one ends is the rest of that.
std::vector<JudgedWall> joined_faces(const hm_walls_info& info) {
    std::vector<JudgedWall> walls;
    for (std::int32_t face = 0; face < info.n_faces; ++face) {
        const std::int32_t a = info.face_points[2 * face], b = info.face_points[2 * face + 1];
        if (walls.empty() || walls.back().points.back() != a || walls.back().is_closed)
            walls.push_back({info.face_markers[face], false, {a}, {}, {}, {}});
        if (b == walls.back().points.front()) walls.back().is_closed = true;
        else walls.back().points.push_back(b);
    }
    for (auto wall = walls.begin(); wall != walls.end();) {
        const auto before = std::find_if(walls.begin(), walls.end(), [&](const JudgedWall& other) {
            return !other.is_closed && !wall->is_closed && &other != &*wall &&
                   other.points.back() == wall->points.front();
        });
        if (before == walls.end()) {
            ++wall;
            continue;
        }
        before->points.insert(before->points.end(), wall->points.begin() + 1, wall->points.end());
        wall = walls.erase(wall);
    }
    return walls;
}

// The two points that are farthest apart, the one with the smaller x first.
std::pair<std::int32_t, std::int32_t> ends_of(const std::vector<std::int32_t>& points,
                                              const Mesh& mesh) {
    std::pair<std::int32_t, std::int32_t> ends = {points[0], points[0]};
    double most = 0;
    for (const std::int32_t a : points) {
        for (const std::int32_t b : points) {
            const double dx = mesh.x[place(b)] - mesh.x[place(a)],
                         dy = mesh.y[place(b)] - mesh.y[place(a)], apart = dx * dx + dy * dy;
            if (!(dx >= 0) || !(apart > most)) continue;
            ends = {a, b};
            most = apart;
        }
    }
    return ends;
}

// The lines between the points are a B-spline of degree 1.
OutlineMeasures measures_of(const JudgedWall& wall, const std::vector<double>& x,
                            const std::vector<double>& y, std::int32_t leading,
                            std::int32_t trailing) {
    const auto n = static_cast<std::int32_t>(wall.points.size());
    std::vector<double> control, knots = {0};
    std::vector<std::int32_t> indices;
    for (std::int32_t k = 0; k <= n; ++k) {
        indices.push_back(k % n);
        knots.push_back(k);
        if (k == n) break;
        const std::size_t point = place(wall.points[place(k)]);
        control.insert(control.end(), {x[point], y[point]});
    }
    knots.push_back(n);
    auto curve = sized<hm_curve>();
    curve.degree = 1;
    curve.n_indices = n + 1;
    curve.indices = indices.data();
    curve.knots = knots.data();
    auto curves = sized<hm_curves>();
    curves.n_control = n;
    curves.control = control.data();
    curves.n_curves = 1;
    curves.curve = &curve;
    auto section = sized<hm_section>();
    section.leading_x = x[place(leading)];
    section.leading_y = y[place(leading)];
    section.trailing_x = x[place(trailing)];
    section.trailing_y = y[place(trailing)];
    const auto measure = [&](std::int32_t kind) {
        auto quantity = sized<hm_quantity>();
        quantity.kind = kind;
        double value = nothing;
        hm_measure(&curves, &section, 1, &quantity, &value, nullptr, nullptr, nullptr);
        return value;
    };
    const double chord = measure(HM_CHORD);
    return {measure(HM_MAX_THICKNESS) / chord, measure(HM_MAX_CAMBER) / chord, measure(HM_AREA)};
}

}  // namespace

JudgedMesh::JudgedMesh(const Mesh& mesh, const hm_basis* basis,
                       const std::vector<hm_condition>& conditions, const Field& displacement)
    : mesh_(mesh), moved_(mesh.x.size()) {
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        moved_.x[point] = mesh.x[point] + displacement.x[point];
        moved_.y[point] = mesh.y[point] + displacement.y[point];
    }
    judge_cells(basis, displacement);
    const std::vector<std::int32_t> markers = moving_markers(conditions);
    if (!markers.empty()) find_walls(markers);
}

void JudgedMesh::judge_cells(const hm_basis* basis, const Field& displacement) {
    const hm_mesh view = mesh_.view();
    const hm_points by = displacement.read();
    const auto judge = [&](const hm_points* moved_by, std::vector<double>& quality) {
        const hm_points* const own = nullptr;
        hm_step_report* const no_step = nullptr;
        auto report = sized<hm_quality_report>();
        quality.resize(place(mesh_.cells()));
        report.cell_quality = quality.data();
        call(mesh_, hm_assess, basis, &view, own, moved_by, own, nullptr, no_step, &report);
    };
    judge(nullptr, before);
    judge(&by, after);
}

void JudgedMesh::find_walls(const std::vector<std::int32_t>& markers) {
    const MeshAnalysis analysis(mesh_);
    Block block;
    hm_walls* found = nullptr;
    const hm_points* const own = nullptr;
    with_memory(block, [&](hm_memory* memory) {
        return call(mesh_, hm_walls_init, &found, memory, analysis.get(),
                    static_cast<std::int32_t>(markers.size()), markers.data(), own);
    });
    auto info = sized<hm_walls_info>();
    call(mesh_, hm_walls_info_get, found, &info);
    const auto n = place(info.n_wall_points);
    std::vector<double> angle(n), height(n);
    const hm_points start = mesh_.coordinates(), at = moved_.read();
    double* const no_heights = nullptr;
    call(mesh_, hm_first_layer, found, &start, &at, no_heights, height.data(), angle.data());
    std::unordered_map<std::int32_t, std::size_t> slot;
    for (std::size_t k = 0; k < n; ++k) slot.emplace(info.wall_points[k], k);
    walls = joined_faces(info);
    double arc = 0;
    for (JudgedWall& wall : walls) {
        const std::int32_t* last = wall.points.data();
        for (const std::int32_t& point : wall.points) {
            arc += distance({mesh_.x[place(*last)], mesh_.y[place(*last)]},
                            {mesh_.x[place(point)], mesh_.y[place(point)]});
            last = &point;
            const std::size_t k = slot.at(point);
            const bool has_edge = info.layer_points[k] >= 0;
            wall.arc.push_back(arc);
            wall.angle.push_back(has_edge ? angle[k] : nothing);
            wall.height.push_back(has_edge ? height[k] : nothing);
        }
    }
}

std::pair<OutlineMeasures, OutlineMeasures> JudgedMesh::measures(const JudgedWall& wall) const {
    const auto [leading, trailing] = ends_of(wall.points, mesh_);
    return {measures_of(wall, mesh_.x, mesh_.y, leading, trailing),
            measures_of(wall, moved_.x, moved_.y, leading, trailing)};
}

}  // namespace cli
