#include "mesh/one_cell_thick.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "mesh/tidy.hpp"

#include <algorithm>
#include <cmath>
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

std::string OneCellThick::coordinates(std::int32_t point) const {
    const auto& x = space_.points.x;
    return "(" + brief(x[0][place(point)]) + ", " + brief(x[1][place(point)]) + ", " +
           brief(x[2][place(point)]) + ")";
}

std::array<double, 3> OneCellThick::corner(std::int32_t face, std::size_t k) const {
    const auto point = place(cells_.points[place(cells_.faces[place(face)].first) + k]);
    return {space_.points.x[0][point], space_.points.x[1][point], space_.points.x[2][point]};
}

void OneCellThick::add_cell(const std::int32_t* points, std::size_t n, std::size_t offset) {
    cells_.add(points, n);
    cell_offset_.push_back(offset);
}

void OneCellThick::end_cell(std::size_t offset) {
    cells_.end_cell();
    cell_offset_.push_back(offset);
}

void OneCellThick::add_side(const std::int32_t* points, std::size_t n, std::int32_t marker,
                            std::size_t offset) {
    sides_.push_back({side_points_.size(), n, offset, marker});
    side_points_.insert(side_points_.end(), points, points + n);
}

// Collects the faces that are connected with the first face by edges, one in each cell. Returns
// false if these faces are no plane of the mesh: one of the faces has cells on both sides, or one
// of the cells has a neighbour that is not among the cells.
bool OneCellThick::spread(std::int32_t first, PlaneFaces& plane,
                          std::vector<std::int32_t>& cells) const {
    const std::vector<CellFaces::Face>& faces = cells_.faces;
    cells = {faces[place(first)].cell};
    plane[place(cells[0])] = first;
    bool holds = true;
    for (std::size_t k = 0; k < cells.size() && holds; ++k) {
        const std::int32_t here = plane[place(cells[k])];
        const CellFaces::Face& face = faces[place(here)];
        holds = face.other < 0;
        for (std::int32_t c = 0; c < face.n && holds; ++c) {
            const std::int32_t a = cells_.points[place(face.first + c)];
            const std::int32_t b = cells_.points[place(face.first + (c + 1) % face.n)];
            const std::int32_t side = cells_.across(here, a, b);
            if (side < 0 || faces[place(side)].other < 0) continue;
            const std::int32_t opposite = faces[place(side)].other;
            const std::int32_t beyond = cells_.across(opposite, a, b);
            std::int32_t& known = plane[place(faces[place(opposite)].cell)];
            if (known < 0) cells.push_back(faces[place(opposite)].cell);
            holds = beyond >= 0 && (known < 0 || known == beyond);
            known = beyond;
        }
    }
    for (std::size_t k = 0; k < cells.size() && holds; ++k) {
        const std::int32_t end = cells_.start[place(cells[k]) + 1];
        for (std::int32_t f = cells_.start[place(cells[k])]; f < end && holds; ++f) {
            const std::int32_t other = faces[place(f)].other;
            holds = other < 0 || plane[place(faces[place(other)].cell)] >= 0;
        }
    }
    if (!holds) {
        for (const std::int32_t cell : cells) plane[place(cell)] = -1;
    }
    return holds;
}

// Returns the mean distance of faces from the plane of the first face.
double OneCellThick::distance(const PlaneFaces& plane,
                              const std::vector<std::int32_t>& cells) const {
    double sum = 0;
    for (const std::int32_t cell : cells) {
        const std::array<double, 3> p = corner(plane[place(cell)], 0);
        double off = 0;
        for (std::size_t d = 0; d < 3; ++d) off += (p[d] - origin_[d]) * normal_[d];
        sum += std::fabs(off) / static_cast<double>(cells.size());
    }
    return sum;
}

// Selects the plane of the mesh by the first cell: the plane with the lower coordinates. Returns
// whether this is the second plane in found_.
bool OneCellThick::put_in_order(std::int32_t cell) {
    std::array<double, 3> centre[2] = {};
    for (const int side : {0, 1}) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t d = 0; d < 3; ++d)
                centre[side][d] += corner(found_[side][place(cell)], k)[d];
        }
    }
    std::size_t across = 2;
    for (const std::size_t d : {1u, 0u}) {
        const auto apart = [&](std::size_t axis) {
            return std::fabs(centre[1][axis] - centre[0][axis]);
        };
        if (apart(d) > apart(across)) across = d;
    }
    const bool swapped = centre[1][across] < centre[0][across];
    const std::int32_t face = found_[swapped ? 1 : 0][place(cell)];
    origin_ = corner(face, 0);
    const std::array<double, 3> a = corner(face, 1), b = corner(face, 2);
    double size = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
        normal_[d] =
            (a[e] - origin_[e]) * (b[f] - origin_[f]) - (a[f] - origin_[f]) * (b[e] - origin_[e]);
        size += normal_[d] * normal_[d];
    }
    for (double& component : normal_) component /= size > 0 ? std::sqrt(size) : 1;
    return swapped;
}

// Finds both planes of the cells that are connected with this cell. The planes of another connected
// part are assigned to the planes of the first part that are closer.
void OneCellThick::find_planes(std::int32_t cell) {
    std::vector<std::int32_t> cells;
    const std::int32_t first = cells_.start[place(cell)], end = cells_.start[place(cell) + 1];
    int n = 0;
    for (std::int32_t face = first; face < end && n < 2; ++face) {
        // A face with n edges in a plane lies opposite one face and beside at most n.
        if (cells_.faces[place(face)].n + 2 < end - first) continue;
        if (n == 1 && found_[0][place(cell)] == face) continue;
        if (spread(face, found_[n], cells)) ++n;
    }
    if (n < 2) {
        // A cell has no faces if no face of the file names the cell, or if all its corners are one
        // point.
        const std::string where =
            first < end
                ? "begins at " + coordinates(cells_.points[place(cells_.faces[place(first)].first)])
                : "has no faces";
        mesh_.file.fail(cell_offset_[place(cell)],
                        "the mesh has three dimensions and is not one cell thick: there are no two "
                        "planes in which each cell has a face; cell " +
                            std::to_string(cell + 1) + " " + where);
    }
    const bool swapped =
        cell == 0 ? put_in_order(cell) : distance(found_[1], cells) < distance(found_[0], cells);
    for (const std::int32_t reached : cells) {
        for (const int side : {0, 1})
            planes_[side][place(reached)] = found_[side == 0 ? swapped : !swapped][place(reached)];
    }
    for (const std::int32_t reached : cells)
        found_[0][place(reached)] = found_[1][place(reached)] = -1;
}

void OneCellThick::add_plane_face(std::int32_t cell) {
    const CellFaces::Face& face = cells_.faces[place(planes_[0][place(cell)])];
    const auto begin = cells_.points.begin() + face.first;
    space_.face_points.insert(space_.face_points.end(), begin, begin + face.n);
    space_.face_start.push_back(static_cast<std::int32_t>(space_.face_points.size()));
    space_.face_offset.push_back(cell_offset_[place(cell)]);
}

void OneCellThick::keep_side(const Side& side) {
    const std::int32_t* const points = &side_points_[side.first];
    const std::int32_t face = cells_.find(points, side.n);
    if (face < 0) {
        mesh_.file.fail(side.offset, "no cell has this face of the boundary, which begins at " +
                                         coordinates(points[0]));
    }
    const auto cell = place(cells_.faces[place(face)].cell);
    if (planes_[0][cell] == face || planes_[1][cell] == face) return;
    if (side.n > 4) {
        mesh_.file.fail(side.offset, "a face of the boundary between the two planes has " +
                                         std::to_string(side.n) +
                                         " points, so the mesh is not one cell thick");
    }
    const std::int32_t last = points[side.n - 1];
    space_.side_points.insert(space_.side_points.end(), {points[0], points[1], points[2], last});
    space_.side_markers.push_back(side.marker);
    space_.side_offset.push_back(side.offset);
}

void OneCellThick::finish() {
    const std::int32_t third = cells_.connect();
    if (third >= 0) {
        const CellFaces::Face& face = cells_.faces[place(third)];
        mesh_.file.fail(cell_offset_[place(face.cell)],
                        "three cells share a face, which begins at " +
                            coordinates(cells_.points[place(face.first)]));
    }
    for (const int side : {0, 1}) {
        planes_[side].assign(place(cells_.cells()), -1);
        found_[side].assign(place(cells_.cells()), -1);
    }
    for (std::int32_t cell = 0; cell < cells_.cells(); ++cell) {
        if (planes_[0][place(cell)] < 0) find_planes(cell);
        add_plane_face(cell);
    }
    for (const Side& side : sides_) keep_side(side);
    take_plane(mesh_, space_);
    drop_empty_markers(mesh_);
}

}  // namespace cli
