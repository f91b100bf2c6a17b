#include "mesh/cell_faces.hpp"

#include "basics/place.hpp"

#include <algorithm>

namespace cli {

namespace {

// Places of the corners of each face; -1 ends a triangle.
using FaceCorners = std::array<int, 4>;
constexpr FaceCorners of_tetrahedron[] = {
    {0, 1, 2, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 2, 3, -1}};
constexpr FaceCorners of_pyramid[] = {
    {0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
constexpr FaceCorners of_prism[] = {
    {0, 1, 2, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr FaceCorners of_hexahedron[] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                         {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::array<std::int32_t, 4> sorted(std::array<std::int32_t, 4> points) {
    if (points[3] == points[2]) points[3] = INT32_MAX;
    std::sort(points.begin(), points.end());
    return points;
}

}  // namespace

void CellFaces::add(const std::int32_t* points, std::size_t n) {
    const auto cell = cells();
    const auto add_faces = [&](const FaceCorners* of, std::size_t count) {
        for (std::size_t f = 0; f < count; ++f) {
            Face face = {{}, cell};
            std::size_t filled = 0;
            for (const int corner : of[f]) {  // a side whose ends are one point is none
                if (corner < 0) continue;
                const std::int32_t point = points[corner];
                const auto end = face.points.begin() + static_cast<std::ptrdiff_t>(filled);
                if (std::find(face.points.begin(), end, point) == end)
                    face.points[filled++] = point;
            }
            if (filled < 3) continue;
            if (filled == 3) face.points[3] = face.points[2];
            faces.push_back(face);
        }
    };
    if (n == 4) add_faces(of_tetrahedron, 4);
    if (n == 5) add_faces(of_pyramid, 5);
    if (n == 6) add_faces(of_prism, 5);
    if (n == 8) add_faces(of_hexahedron, 6);
    start.push_back(static_cast<std::int32_t>(faces.size()));
}

// Faces are put in order by their points: those of two cells then stand side by side.
std::int32_t CellFaces::connect() {
    by_points_.clear();
    for (std::size_t f = 0; f < faces.size(); ++f) {
        by_points_.push_back({sorted(faces[f].points), static_cast<std::int32_t>(f)});
    }
    std::sort(by_points_.begin(), by_points_.end());
    std::int32_t third = -1;
    for (std::size_t k = 1; k < by_points_.size(); ++k) {
        if (by_points_[k].first != by_points_[k - 1].first) continue;
        Face &before = faces[place(by_points_[k - 1].second)],
             &its = faces[place(by_points_[k].second)];
        if (before.other >= 0) third = by_points_[k].second;
        before.other = by_points_[k].second;
        its.other = by_points_[k - 1].second;
    }
    return third;
}

std::int32_t CellFaces::find(const std::int32_t* points, std::size_t n) const {
    const std::pair<Points, std::int32_t> wanted = {
        sorted({points[0], points[1], points[2], points[n - 1]}), -1};
    const auto found = std::lower_bound(by_points_.begin(), by_points_.end(), wanted);
    return found != by_points_.end() && found->first == wanted.first ? found->second : -1;
}

}  // namespace cli
