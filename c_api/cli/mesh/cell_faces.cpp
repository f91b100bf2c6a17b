#include "mesh/cell_faces.hpp"

#include "basics/place.hpp"

#include <algorithm>
#include <tuple>

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

// Edges of a cell are searched in all its faces if these have at most so many points together, and
// otherwise in a sorted list.
constexpr std::int32_t max_searched = 64;

}  // namespace

bool CellFaces::Edge::operator<(const Edge& other) const {
    return std::tie(cell, a, b, face) < std::tie(other.cell, other.a, other.b, other.face);
}

void CellFaces::add_face(const std::int32_t* corners, std::size_t n) {
    faces.push_back(
        {static_cast<std::int32_t>(points.size()), static_cast<std::int32_t>(n), cells()});
    points.insert(points.end(), corners, corners + n);
}

void CellFaces::add(const std::int32_t* corners, std::size_t n) {
    const auto add_faces = [&](const FaceCorners* of_cell, std::size_t count) {
        for (std::size_t f = 0; f < count; ++f) {
            std::int32_t face[4];
            std::size_t filled = 0;
            for (const int corner : of_cell[f]) {
                // An edge whose ends are one point is no edge.
                if (corner < 0 || std::find(face, face + filled, corners[corner]) != face + filled)
                    continue;
                face[filled++] = corners[corner];
            }
            if (filled >= 3) add_face(face, filled);
        }
    };
    if (n == 4) add_faces(of_tetrahedron, 4);
    if (n == 5) add_faces(of_pyramid, 5);
    if (n == 6) add_faces(of_prism, 5);
    if (n == 8) add_faces(of_hexahedron, 6);
    end_cell();
}

CellFaces::Key CellFaces::key(const std::int32_t* corners, std::size_t n) {
    Key key = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX, static_cast<std::int32_t>(n)};
    std::partial_sort_copy(corners, corners + n, key.begin(), key.begin() + 4);
    return key;
}

// Faces are sorted by their keys: the faces of two cells then are neighbours in the list.
std::int32_t CellFaces::connect() {
    by_key_.clear();
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Face& face = faces[f];
        by_key_.push_back(
            {key(&points[place(face.first)], place(face.n)), static_cast<std::int32_t>(f)});
    }
    std::sort(by_key_.begin(), by_key_.end());
    std::int32_t third = -1;
    for (std::size_t k = 1; k < by_key_.size(); ++k) {
        if (by_key_[k].first != by_key_[k - 1].first) continue;
        Face &before = faces[place(by_key_[k - 1].second)],
             &after = faces[place(by_key_[k].second)];
        if (before.other >= 0) third = by_key_[k].second;
        before.other = by_key_[k].second;
        after.other = by_key_[k - 1].second;
    }
    index_large_cells();
    return third;
}

std::int32_t CellFaces::find(const std::int32_t* corners, std::size_t n) const {
    const std::pair<Key, std::int32_t> wanted = {key(corners, n), -1};
    const auto found = std::lower_bound(by_key_.begin(), by_key_.end(), wanted);
    return found != by_key_.end() && found->first == wanted.first ? found->second : -1;
}

void CellFaces::index_large_cells() {
    edges_.clear();
    for (std::int32_t cell = 0; cell < cells(); ++cell) {
        const std::int32_t begin = start[place(cell)], end = start[place(cell) + 1];
        std::int32_t n_points = 0;
        for (std::int32_t f = begin; f < end; ++f) n_points += faces[place(f)].n;
        for (std::int32_t f = begin; f < end && n_points > max_searched; ++f) {
            const std::int32_t* const corners = &points[place(faces[place(f)].first)];
            const std::int32_t n = faces[place(f)].n;
            for (std::int32_t k = 0; k < n; ++k) {
                const auto ends = std::minmax(corners[k], corners[k + 1 < n ? k + 1 : 0]);
                edges_.push_back({cell, ends.first, ends.second, f});
            }
        }
    }
    std::sort(edges_.begin(), edges_.end());
}

bool CellFaces::has_edge(const Face& face, std::int32_t a, std::int32_t b) const {
    const auto begin = points.begin() + face.first, end = begin + face.n;
    return std::find(begin, end, a) != end && std::find(begin, end, b) != end;
}

std::int32_t CellFaces::across(std::int32_t face, std::int32_t a, std::int32_t b) const {
    const std::int32_t cell = faces[place(face)].cell;
    const Edge wanted = {cell, std::min(a, b), std::max(a, b), -1};
    const auto first = std::lower_bound(edges_.begin(), edges_.end(), wanted);
    const bool is_large =
        !edges_.empty() && std::binary_search(edges_.begin(), edges_.end(), wanted,
                                              [](const Edge& one, const Edge& other) {
                                                  return one.cell < other.cell;
                                              });
    for (auto edge = first; is_large && edge != edges_.end() && edge->cell == cell &&
                            edge->a == wanted.a && edge->b == wanted.b;
         ++edge) {
        if (edge->face != face) return edge->face;
    }
    for (std::int32_t f = start[place(cell)]; !is_large && f < start[place(cell) + 1]; ++f) {
        if (f != face && has_edge(faces[place(f)], a, b)) return f;
    }
    return -1;
}

}  // namespace cli
