#include "mesh/cell_faces.hpp"

#include "basics/place.hpp"

#include <algorithm>
#include <numeric>

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

bool CellFaces::Face::is_same(const Face& face) const {
    return sorted(points) == sorted(face.points);
}

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

std::int32_t CellFaces::connect(std::int32_t n_points) {
    const auto lowest = [](const Face& face) {
        return place(*std::min_element(face.points.begin(), face.points.end()));
    };
    lowest_start_.assign(place(n_points) + 1, 0);
    for (const Face& face : faces) ++lowest_start_[lowest(face) + 1];
    std::partial_sum(lowest_start_.begin(), lowest_start_.end(), lowest_start_.begin());
    std::vector<std::int32_t> next(lowest_start_.begin(), lowest_start_.end() - 1);
    by_lowest_.resize(faces.size());
    std::int32_t third = -1;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::size_t point = lowest(faces[f]);
        for (std::int32_t i = lowest_start_[point]; i < next[point]; ++i) {
            Face& before = faces[place(by_lowest_[place(i)])];
            if (!before.is_same(faces[f])) continue;
            if (before.other >= 0) third = static_cast<std::int32_t>(f);
            before.other = static_cast<std::int32_t>(f);
            faces[f].other = by_lowest_[place(i)];
            break;
        }
        by_lowest_[place(next[point]++)] = static_cast<std::int32_t>(f);
    }
    return third;
}

std::int32_t CellFaces::find(const std::int32_t* points, std::size_t n) const {
    const Face wanted = {{points[0], points[1], points[2], points[n - 1]}, -1};
    const std::size_t lowest = place(*std::min_element(points, points + n));
    for (std::int32_t i = lowest_start_[lowest]; i < lowest_start_[lowest + 1]; ++i) {
        if (faces[place(by_lowest_[place(i)])].is_same(wanted)) return by_lowest_[place(i)];
    }
    return -1;
}

}  // namespace cli
