#include "mesh/one_cell_thick.hpp"

#include "formats/tidy.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

}  // namespace

std::string OneCellThick::place(std::int32_t point) const {
    const auto& x = space_.points.x;
    return "(" + brief(x[0][at(point)]) + ", " + brief(x[1][at(point)]) + ", " +
           brief(x[2][at(point)]) + ")";
}

std::array<double, 3> OneCellThick::corner(std::int32_t face, std::size_t k) const {
    const auto point = at(cells_.faces[at(face)].points[k]);
    return {space_.points.x[0][point], space_.points.x[1][point], space_.points.x[2][point]};
}

void OneCellThick::add_cell(const std::int32_t* points, std::size_t n, std::size_t offset) {
    cells_.add(points, n);
    cell_offset_.push_back(offset);
}

void OneCellThick::add_side(const std::int32_t* points, std::size_t n, std::int32_t marker,
                            std::size_t offset) {
    sides_.push_back({{points[0], points[1], points[2], points[n - 1]}, n, offset, marker});
}

// From a face of one cell to the faces beyond its edges, in the neighbours there. False: this is no
// plane of the mesh, as one of the faces has cells on both sides, or a cell beside one that was
// reached was not.
bool OneCellThick::spread(std::int32_t first, PlaneFaces& plane,
                          std::vector<std::int32_t>& cells) const {
    const std::vector<CellFaces::Face>& faces = cells_.faces;
    cells = {faces[at(first)].cell};
    plane[at(cells[0])] = first;
    bool holds = true;
    for (std::size_t k = 0; k < cells.size() && holds; ++k) {
        const CellFaces::Face& its = faces[at(plane[at(cells[k])])];
        const auto begin = cells_.start[at(cells[k])], end = cells_.start[at(cells[k]) + 1];
        holds = its.other < 0;
        for (std::size_t corner = 0; corner < its.n() && holds; ++corner) {
            const std::int32_t a = its.points[corner], b = its.points[(corner + 1) % its.n()];
            for (std::int32_t side = begin; side < end && holds; ++side) {
                const CellFaces::Face& across = faces[at(side)];
                if (&across == &its || across.other < 0 || !across.has(a) || !across.has(b))
                    continue;
                const std::int32_t next = faces[at(across.other)].cell;
                std::int32_t beyond = -1;
                for (std::int32_t f = cells_.start[at(next)]; f < cells_.start[at(next) + 1]; ++f) {
                    if (f != across.other && faces[at(f)].has(a) && faces[at(f)].has(b)) beyond = f;
                }
                std::int32_t& known = plane[at(next)];
                if (known < 0) cells.push_back(next);
                holds = beyond >= 0 && (known < 0 || known == beyond);
                known = beyond;
            }
        }
    }
    for (std::size_t k = 0; k < cells.size() && holds; ++k) {
        for (std::int32_t f = cells_.start[at(cells[k])];
             f < cells_.start[at(cells[k]) + 1] && holds; ++f) {
            const std::int32_t other = faces[at(f)].other;
            holds = other < 0 || plane[at(faces[at(other)].cell)] >= 0;
        }
    }
    if (!holds) {
        for (const std::int32_t cell : cells) plane[at(cell)] = -1;
    }
    return holds;
}

// How far faces lie from the plane of the first one, on average.
double OneCellThick::distance(const PlaneFaces& plane,
                              const std::vector<std::int32_t>& cells) const {
    double sum = 0;
    for (const std::int32_t cell : cells) {
        const std::array<double, 3> p = corner(plane[at(cell)], 0);
        double off = 0;
        for (std::size_t d = 0; d < 3; ++d) off += (p[d] - origin_[d]) * normal_[d];
        sum += std::fabs(off) / static_cast<double>(cells.size());
    }
    return sum;
}

// Of the cells that are connected with this one. Of several such parts, planes that lie together
// are one.
void OneCellThick::find_planes(std::int32_t cell) {
    const bool is_first = cell == 0;
    PlaneFaces(&found)[2] = found_;
    std::vector<std::int32_t> cells;
    int n = 0;
    for (std::int32_t face = cells_.start[at(cell)]; face < cells_.start[at(cell) + 1] && n < 2;
         ++face) {
        if (n == 1 && found[0][at(cell)] == face) continue;
        if (spread(face, found[n], cells)) ++n;
    }
    if (n < 2) {
        const std::int32_t first = cells_.start[at(cell)];
        const bool has_faces =
            cells_.start[at(cell) + 1] > first;  // none, if all its corners are one point
        const std::string where =
            has_faces ? "begins at " + place(cells_.faces[at(first)].points[0]) : "is a point";
        mesh_.file.fail(cell_offset_[at(cell)],
                        "the mesh has three dimensions and is not one cell thick: "
                        "there are no two planes in which each cell has a face; "
                        "cell " +
                            std::to_string(cell + 1) + " " + where);
    }
    bool swapped = false;
    if (is_first) {  // the plane of the lower coordinates
        std::array<double, 3> centre[2] = {};
        for (const int side : {0, 1}) {
            for (std::size_t k = 0; k < 3; ++k) {
                for (std::size_t d = 0; d < 3; ++d)
                    centre[side][d] += corner(found[side][at(cell)], k)[d];
            }
        }
        std::size_t across = 2;
        for (const std::size_t d : {1u, 0u}) {
            const auto apart = [&](std::size_t axis) {
                return std::fabs(centre[1][axis] - centre[0][axis]);
            };
            if (apart(d) > apart(across)) across = d;
        }
        swapped = centre[1][across] < centre[0][across];
        const std::int32_t face = found[swapped ? 1 : 0][at(cell)];
        origin_ = corner(face, 0);
        const std::array<double, 3> a = corner(face, 1), b = corner(face, 2);
        double size = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
            normal_[d] = (a[e] - origin_[e]) * (b[f] - origin_[f]) -
                         (a[f] - origin_[f]) * (b[e] - origin_[e]);
            size += normal_[d] * normal_[d];
        }
        for (double& its : normal_) its /= size > 0 ? std::sqrt(size) : 1;
    } else {
        swapped = distance(found[1], cells) < distance(found[0], cells);
    }
    for (const std::int32_t its : cells) {
        for (const int side : {0, 1})
            planes_[side][at(its)] = found[side == 0 ? swapped : !swapped][at(its)];
    }
    for (const std::int32_t its : cells) found[0][at(its)] = found[1][at(its)] = -1;
}

void OneCellThick::finish() {
    const std::int32_t third = cells_.connect();
    if (third >= 0) {
        mesh_.file.fail(cell_offset_[at(cells_.faces[at(third)].cell)],
                        "three cells have a common face; it begins at " +
                            place(cells_.faces[at(third)].points[0]));
    }
    for (const int side : {0, 1}) {
        planes_[side].assign(at(cells_.cells()), -1);
        found_[side].assign(at(cells_.cells()), -1);
    }
    for (std::int32_t cell = 0; cell < cells_.cells(); ++cell) {
        if (planes_[0][at(cell)] < 0) find_planes(cell);
        const CellFaces::Face& face = cells_.faces[at(planes_[0][at(cell)])];
        std::array<std::int32_t, 4> points = face.points;
        space_.face_points.insert(space_.face_points.end(), points.begin(),
                                  points.begin() + std::ptrdiff_t(face.n()));
        space_.face_start.push_back(static_cast<std::int32_t>(space_.face_points.size()));
        space_.face_offset.push_back(cell_offset_[at(cell)]);
    }
    for (const Side& side : sides_) {
        const std::int32_t face = cells_.find(side.points.data(), side.n);
        if (face < 0) {
            mesh_.file.fail(
                side.offset,
                "a face of the boundary is that of no cell; it begins at " + place(side.points[0]));
        }
        const auto cell = at(cells_.faces[at(face)].cell);
        if (planes_[0][cell] == face || planes_[1][cell] == face) continue;
        space_.side_points.insert(space_.side_points.end(), side.points.begin(), side.points.end());
        space_.side_markers.push_back(side.marker);
        space_.side_offset.push_back(side.offset);
    }
    take_plane(mesh_, space_);
    drop_empty_markers(mesh_);
}

}  // namespace cli
