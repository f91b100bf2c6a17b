#include "sampling/wall_chains.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace cli {

namespace {

// Returns the faces of the walls, with the mesh on the left, as the next point of each point.
std::map<std::int32_t, std::int32_t> directed_faces(const Mesh& mesh,
                                                    const std::vector<std::int32_t>& markers) {
    std::set<std::pair<std::int32_t, std::int32_t>> faces;
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        if (std::find(markers.begin(), markers.end(), mesh.face_markers[face]) == markers.end())
            continue;
        const std::int32_t a = mesh.face_points[2 * face], b = mesh.face_points[2 * face + 1];
        faces.insert({std::min(a, b), std::max(a, b)});
    }
    std::map<std::int32_t, std::int32_t> next;
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const auto first = static_cast<std::size_t>(mesh.cell_start[cell]),
                   n = static_cast<std::size_t>(mesh.cell_start[cell + 1]) - first;
        double area = 0;
        const auto at = [&](std::size_t k) { return mesh.cell_points[first + k % n]; };
        const auto o = static_cast<std::size_t>(at(0));
        for (std::size_t k = 0; k < n; ++k) {
            const auto a = static_cast<std::size_t>(at(k)), b = static_cast<std::size_t>(at(k + 1));
            area += (mesh.x[a] - mesh.x[o]) * (mesh.y[b] - mesh.y[o]) -
                    (mesh.x[b] - mesh.x[o]) * (mesh.y[a] - mesh.y[o]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            const std::int32_t a = at(k), b = at(k + 1);
            if (faces.count({std::min(a, b), std::max(a, b)}) == 0) continue;
            if (area > 0) next[a] = b;
            else next[b] = a;
        }
    }
    return next;
}

}  // namespace

WallChains::WallChains(const Mesh& mesh, const std::vector<std::int32_t>& markers) {
    std::map<std::int32_t, std::int32_t> next = directed_faces(mesh, markers);
    std::set<std::int32_t> followed;
    for (const auto& face : next) followed.insert(face.second);
    const auto walk = [&](std::int32_t from, bool is_loop) {
        const auto begin = static_cast<std::ptrdiff_t>(points_.size());
        points_.push_back(from);
        for (auto face = next.find(from); face != next.end(); face = next.find(points_.back())) {
            const std::int32_t to = face->second;
            next.erase(face);
            if (to != from) points_.push_back(to);
        }
        const auto right = [&](std::int32_t a, std::int32_t b) {
            return mesh.x[static_cast<std::size_t>(a)] < mesh.x[static_cast<std::size_t>(b)];
        };
        const auto first = points_.begin() + begin;
        if (is_loop)
            std::rotate(first, std::max_element(first, points_.end(), right), points_.end());
        start_.push_back(static_cast<std::int32_t>(points_.size()));
        is_loop_.push_back(is_loop);
    };
    std::vector<std::int32_t> ends;
    for (const auto& face : next)
        if (followed.count(face.first) == 0) ends.push_back(face.first);
    for (const std::int32_t end : ends) walk(end, false);
    while (!next.empty()) walk(next.begin()->first, true);
}

void WallChains::measure(const std::vector<double>& coordinates, std::vector<double>& normals,
                         std::vector<double>& arcs) const {
    const auto at = [&](std::int32_t place, int axis) {
        const auto point = static_cast<std::size_t>(points_[static_cast<std::size_t>(place)]);
        return coordinates[2 * point + static_cast<std::size_t>(axis)];
    };
    for (std::size_t piece = 0; piece < is_loop_.size(); ++piece) {
        const std::int32_t first = start_[piece], end = start_[piece + 1];
        double arc = 0;
        for (std::int32_t k = first; k < end; ++k) {
            const std::int32_t before = k > first         ? k - 1
                                        : is_loop_[piece] ? end - 1
                                                          : k,
                               after = k + 1 < end       ? k + 1
                                       : is_loop_[piece] ? first
                                                         : k;
            const double x = at(after, 0) - at(before, 0), y = at(after, 1) - at(before, 1),
                         length = std::hypot(x, y);
            normals.push_back(length > 0 ? -y / length : 0);
            normals.push_back(length > 0 ? x / length : 0);
            if (k > first) arc += std::hypot(at(k, 0) - at(k - 1, 0), at(k, 1) - at(k - 1, 1));
            arcs.push_back(arc);
        }
    }
}

}  // namespace cli
