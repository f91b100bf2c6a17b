#include "one_cell_thick.hpp"

#include "numbers.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

constexpr double rounding = 1e-6; // of the thickness, for coordinates that should be equal
const char* const names[] = {"x", "y", "z"};

std::string place(const SpacePoints& space, std::int32_t point) {
    const auto i = static_cast<std::size_t>(point);
    return "point " + std::to_string(point + 1) + " of the file (" + brief(space.x[0][i]) + ", " +
           brief(space.x[1][i]) + ", " + brief(space.x[2][i]) + ")";
}

// The first point that lies in neither plane; -1: there is none.
std::int32_t split(const std::vector<double>& values, std::vector<char>& upper) {
    const auto range = std::minmax_element(values.begin(), values.end());
    const double low = *range.first, high = *range.second, tolerance = rounding * (high - low);
    if (!(high > low)) return 0;
    upper.assign(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] - low <= tolerance) continue;
        if (high - values[i] > tolerance) return static_cast<std::int32_t>(i);
        upper[i] = 1;
    }
    return -1;
}

} // namespace

Planes find_planes(const Mesh& mesh, const SpacePoints& space) {
    Planes planes = {};
    std::string offenders;
    for (const int normal : {2, 1, 0}) {
        const auto n = static_cast<std::size_t>(normal);
        const std::int32_t offender = split(space.x[n], planes.upper);
        if (offender < 0) {
            planes.normal = normal;
            planes.first = normal == 0 ? 1 : 0;
            planes.second = normal == 2 ? 1 : 2;
            return planes;
        }
        offenders += (offenders.empty() ? "" : "; ") + std::string("not two planes ") + names[normal] +
                     " = constant: " + place(space, offender);
    }
    mesh.file.fail(space.offset[0].empty() ? 0 : space.offset[0][0],
                   "the mesh has three dimensions and is not one cell thick: " + offenders);
}

namespace {

void follow(Mesh& mesh, const SpacePoints& space, const Planes& planes, std::int32_t point, std::size_t from) {
    const auto p = static_cast<std::size_t>(point);
    const auto one = [&](int axis, std::int32_t rule, double value) {
        const auto a = static_cast<std::size_t>(axis);
        // What is not the same to the last bit moves as far, and stays as different.
        if (space.x[a][from] != value || std::signbit(space.x[a][from]) != std::signbit(value)) {
            std::vector<Direction>& directions = mesh.in_file.directions;
            if (directions.empty()) directions = {{{1, 0}}, {{0, 1}}};
            rule = rule == takes_x ? 0 : 1;
        }
        mesh.in_file.slots.push_back({space.offset[a][from], point, rule});
    };
    one(planes.first, takes_x, mesh.x[p]);
    one(planes.second, takes_y, mesh.y[p]);
}

} // namespace

void add_plane_point(Mesh& mesh, const SpacePoints& space, const Planes& planes, std::int32_t point,
                     std::int32_t partner) {
    const auto i = static_cast<std::size_t>(point);
    const auto first = static_cast<std::size_t>(planes.first), second = static_cast<std::size_t>(planes.second);
    const std::int32_t number = mesh.points();
    mesh.x.push_back(space.x[first][i]);
    mesh.y.push_back(space.x[second][i]);
    mesh.point_offset.push_back(space.offset[first][i]);
    follow_both(mesh, space, planes, number, point, partner);
}

void follow_both(Mesh& mesh, const SpacePoints& space, const Planes& planes, std::int32_t number, std::int32_t point,
                 std::int32_t partner) {
    const auto i = static_cast<std::size_t>(point), j = static_cast<std::size_t>(partner);
    follow(mesh, space, planes, number, i);
    if (partner < 0) return;
    const auto normal = static_cast<std::size_t>(planes.normal);
    const double thickness = std::fabs(space.x[normal][j] - space.x[normal][i]);
    for (const int axis : {planes.first, planes.second}) {
        const auto a = static_cast<std::size_t>(axis);
        if (std::fabs(space.x[a][j] - space.x[a][i]) <= rounding * thickness) continue;
        mesh.file.fail(space.offset[a][j], place(space, partner) + " is not opposite " + place(space, point) +
                                               ": the mesh is not one cell thick");
    }
    if (thickness == 0) {
        mesh.file.fail(space.offset[normal][j],
                       place(space, partner) + " is in the same plane as " + place(space, point));
    }
    follow(mesh, space, planes, number, j);
}

OneCellThick::OneCellThick(Mesh& mesh, const SpacePoints& space)
    : mesh_(mesh), space_(space), planes_(find_planes(mesh, space)), partner_(space.x[0].size(), -1) {}

void OneCellThick::pair(std::int32_t lower, std::int32_t upper, std::size_t offset) {
    std::int32_t& partner = partner_[static_cast<std::size_t>(lower)];
    if (partner == -1) partner = upper;
    if (partner == upper) return;
    mesh_.file.fail(offset, place(space_, lower) + " has two points opposite: " + place(space_, partner) + " and " +
                                place(space_, upper));
}

void OneCellThick::add_cell(const std::int32_t* points, std::size_t n, std::size_t offset) {
    // Ways to see the cell as one side and the points opposite; a prism has one, a hexahedron three.
    static constexpr int sides[3][8] = {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 3, 7, 4, 1, 2, 6, 5}, {0, 1, 5, 4, 3, 2, 6, 7}};
    const std::size_t half = n / 2;
    for (std::size_t way = 0; way < (n == 8 ? 3u : 1u); ++way) {
        const auto at = [&](std::size_t k) { return points[n == 8 ? static_cast<std::size_t>(sides[way][k]) : k]; };
        const bool flipped = is_upper(at(0));
        bool fits = true;
        for (std::size_t k = 0; k < half; ++k) {
            fits = fits && is_upper(at(k)) == flipped && is_upper(at(k + half)) != flipped;
        }
        if (!fits) continue;
        Item cell = {{}, static_cast<std::int32_t>(half), -1, offset};
        for (std::size_t k = 0; k < half; ++k) {
            const std::int32_t a = at(k), b = at(k + half);
            cell.points[k] = flipped ? b : a;
            pair(flipped ? b : a, flipped ? a : b, offset);
        }
        cells_.push_back(cell);
        return;
    }
    mesh_.file.fail(offset, "a cell does not reach from one plane to the other with a side in each; it begins at " +
                                place(space_, points[0]));
}

void OneCellThick::add_side(const std::int32_t* points, std::size_t n, const std::string& marker, std::size_t offset) {
    Item side = {{}, 0, -1, offset};
    for (std::size_t k = 0; k < n; ++k) {
        if (!is_upper(points[k])) side.points[static_cast<std::size_t>(side.n++)] = points[k];
    }
    if (side.n == 0 || side.n == static_cast<std::int32_t>(n)) return; // of a plane
    if (n != 4 || side.n != 2) {
        mesh_.file.fail(offset,
                        "a face of the boundary is neither in a plane nor a quadrilateral from one to the other; "
                        "it begins at " +
                            place(space_, points[0]));
    }
    side.marker = mesh_.add_marker(marker);
    sides_.push_back(side);
}

void OneCellThick::finish() {
    std::vector<std::int32_t> number(partner_.size(), -1);
    for (std::size_t point = 0; point < partner_.size(); ++point) {
        if (partner_[point] < 0) continue;
        number[point] = mesh_.points();
        add_plane_point(mesh_, space_, planes_, static_cast<std::int32_t>(point), partner_[point]);
    }
    std::vector<std::int32_t> points;
    for (const Item& cell : cells_) {
        points.clear();
        for (std::int32_t k = 0; k < cell.n; ++k) {
            points.push_back(number[static_cast<std::size_t>(cell.points[static_cast<std::size_t>(k)])]);
        }
        mesh_.add_cell(points, cell.offset);
    }
    for (const Item& side : sides_) {
        const std::int32_t a = number[static_cast<std::size_t>(side.points[0])];
        const std::int32_t b = number[static_cast<std::size_t>(side.points[1])];
        if (a < 0 || b < 0) mesh_.file.fail(side.offset, "a face of the boundary has points that no cell has");
        mesh_.add_face(a, b, side.marker, side.offset);
    }
}

} // namespace cli
