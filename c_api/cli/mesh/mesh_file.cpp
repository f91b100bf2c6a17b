#include "mesh/mesh_file.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

std::int32_t Mesh::faces(std::int32_t marker) const {
    return static_cast<std::int32_t>(std::count(face_markers.begin(), face_markers.end(), marker));
}

hm_mesh Mesh::view() const {
    hm_mesh mesh = {};
    mesh.struct_size = sizeof mesh;
    mesh.n_points = points();
    mesh.points = coordinates();
    mesh.cell_layout = has_polygons ? HM_CELLS_POLYGONS : HM_CELLS_ROWS;
    mesh.n_cells = cells();
    mesh.cell_start = cell_start.data();
    mesh.cell_points = cell_points.data();
    mesh.n_faces = faces();
    mesh.face_points = face_points.data();
    mesh.face_markers = face_markers.data();
    return mesh;
}

std::int32_t Mesh::add_marker(std::string_view tag) {
    if (marker_numbers_.size() != markers.size()) {  // markers were dropped, or renumbered
        marker_numbers_.clear();
        for (std::size_t marker = 0; marker < markers.size(); ++marker)
            marker_numbers_.emplace(markers[marker], static_cast<std::int32_t>(marker));
    }
    const auto next = static_cast<std::int32_t>(markers.size());
    const auto known = marker_numbers_.emplace(std::string(tag), next);
    if (known.second) markers.emplace_back(tag);
    return known.first->second;
}

void Mesh::remark(const std::string& text) {
    constexpr std::size_t max_remarks = 100;  // each remark is compared with all earlier ones
    if (remarks.size() >= max_remarks) return;
    if (std::find(remarks.begin(), remarks.end(), text) == remarks.end()) remarks.push_back(text);
}

void Mesh::add_point(double point_x, double point_y, std::size_t x_offset) {
    x.push_back(point_x);
    y.push_back(point_y);
    point_offset.push_back(x_offset);
}

void Mesh::refuse_polygons(const std::string& who) const {
    for (std::size_t cell = 0; cell + 1 < cell_start.size(); ++cell) {
        if (cell_start[cell + 1] - cell_start[cell] <= 4) continue;
        throw Failure(exit_usage, file.path() +
                                      " has cells of more than four corners (the first is cell " +
                                      std::to_string(cell) + "), but " + who +
                                      " takes triangles and quadrilaterals only");
    }
}

void Mesh::find_polygons() {
    const auto at = [this](std::int32_t i) {
        return static_cast<std::size_t>(cell_points[static_cast<std::size_t>(i)]);
    };
    for (std::size_t cell = 0; cell + 1 < cell_start.size() && !has_polygons; ++cell) {
        const std::int32_t first = cell_start[cell], n = cell_start[cell + 1] - first;
        has_polygons = n > 4;
        double min_turn = 0, max_turn = 0;  // sines of the turns at the corners
        for (std::int32_t k = 0; k < n && n == 4; ++k) {
            const std::size_t a = at(first + k), b = at(first + (k + 1) % n),
                              c = at(first + (k + 2) % n);
            const double ux = x[b] - x[a], uy = y[b] - y[a], vx = x[c] - x[b], vy = y[c] - y[b];
            const double size = std::hypot(ux, uy) * std::hypot(vx, vy);
            const double turn = size > 0 ? (ux * vy - uy * vx) / size : 0;
            min_turn = k == 0 ? turn : std::min(min_turn, turn);
            max_turn = k == 0 ? turn : std::max(max_turn, turn);
        }
        constexpr double flat = 1e-6;
        has_polygons = has_polygons || (n == 4 && min_turn < flat && max_turn > -flat);
    }
}

void Mesh::add_face(std::int32_t a, std::int32_t b, std::int32_t marker, std::size_t offset) {
    face_points.insert(face_points.end(), {a, b});
    face_markers.push_back(marker);
    face_offset.push_back(offset);
}

}  // namespace cli
