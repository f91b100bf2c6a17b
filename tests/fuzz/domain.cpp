#include "problem.hpp"

#include <algorithm>
#include <cmath>

namespace fuzz {
namespace {

constexpr std::int32_t low = 1, right = 2, high = 3, left = 4, first_wall = 5;

struct Grid {
    std::int32_t nx, ny;   // cells
    bool is_ring;          // column nx is column 0; row 0 is the wall
    bool has_tip = false;  // row 0 is one point

    std::int32_t at(std::int32_t i, std::int32_t j) const {
        if (has_tip && j == 0) return 0;
        return (is_ring ? i % nx : i) + (is_ring ? nx : nx + 1) * j;
    }
};

// Rectangles of cells that are taken out; they have no point in common with each other or with the
// sides.
struct Hole {
    std::int32_t i0, i1, j0, j1;
    bool has(std::int32_t i, std::int32_t j) const {
        return i >= i0 && i < i1 && j >= j0 && j < j1;
    }
};

void add_hole(Domain& domain, Grid const& grid, Hole const& hole, std::int32_t marker) {
    std::vector<std::int32_t> loop;
    for (std::int32_t i = hole.i0; i < hole.i1; ++i) loop.push_back(grid.at(i, hole.j0));
    for (std::int32_t j = hole.j0; j < hole.j1; ++j) loop.push_back(grid.at(hole.i1, j));
    for (std::int32_t i = hole.i1; i > hole.i0; --i) loop.push_back(grid.at(i, hole.j1));
    for (std::int32_t j = hole.j1; j > hole.j0; --j) loop.push_back(grid.at(hole.i0, j));
    for (std::size_t k = 0; k < loop.size(); ++k)
        domain.faces.push_back({loop[k], loop[(k + 1) % loop.size()], marker});
    domain.walls.push_back(loop);
}

void add_cell(Domain& domain, Input& input, std::uint32_t split, std::int32_t a, std::int32_t b,
              std::int32_t c, std::int32_t d) {
    if (a == b) {  // at the tip
        domain.cells.push_back({a, c, d});
    } else if (split == 0 || (split == 1 && input.one_in(2))) {
        domain.cells.push_back({a, b, c, d});
        domain.ni = split == 0 ? domain.ni : 0;
    } else if (input.one_in(2)) {
        domain.cells.insert(domain.cells.end(), {{a, b, c}, {a, c, d}});
    } else {
        domain.cells.insert(domain.cells.end(), {{a, b, d}, {b, c, d}});
    }
}

// Points that cells do not use go; the others keep their order.
void drop_unused(Domain& domain) {
    std::vector<std::int32_t> new_of(domain.points.size(), -1);
    for (Cell const& cell : domain.cells)
        for (std::int32_t const k : cell) new_of[at(k)] = 0;
    std::int32_t n = 0;
    std::vector<Point> points;
    for (std::size_t k = 0; k < new_of.size(); ++k)
        if (new_of[k] == 0) {
            new_of[k] = n++;
            points.push_back(domain.points[k]);
        }
    auto const renumber = [&](std::int32_t& k) { k = new_of[at(k)]; };
    for (Cell& cell : domain.cells)
        for (std::int32_t& k : cell) renumber(k);
    for (Face& face : domain.faces) renumber(face.from), renumber(face.to);
    for (std::vector<std::int32_t>& wall : domain.walls)
        for (std::int32_t& k : wall) renumber(k);
    for (Domain::Image& image : domain.images) renumber(image.source), renumber(image.at);
    domain.points = points;
}

// The last column of cells of a ring gets points of its own on the side of the first column, with
// equal coordinates: the seam of an O-mesh, whose points are joined.
void cut_ring(Domain& domain, Grid const& grid) {
    std::int32_t const n = grid.nx;
    auto const copy_of = [&](std::int32_t point) { return n * (grid.ny + 1) + point / n; };
    for (std::int32_t j = 0; j <= grid.ny; ++j) {
        Point const copied = domain.points[at(n * j)];
        domain.points.push_back(copied);
    }
    for (Cell& cell : domain.cells) {
        bool const is_last =
            std::any_of(cell.begin(), cell.end(), [n](std::int32_t k) { return k % n == n - 1; });
        for (std::int32_t& k : cell)
            if (is_last && k % n == 0) k = copy_of(k);
    }
    for (Face& face : domain.faces)
        if (face.from % n == n - 1) face.to = copy_of(face.to);
}

// The rectangle becomes one passage of an annulus: x is the angle, y the radius, and the sides may
// be curved. With a tip it is a sector.
void bend(Domain& domain, Grid const& grid, Input& input) {
    double const angle = 2 * std::acos(-1.0) / input.from(2, 40),
                 twist = input.any_of({0.0, 0.0, 0.1, -0.3});
    double const highest = domain.points.back().y,
                 hub = grid.has_tip ? 0 : grid.nx / angle * input.between(0.2, 3);
    for (Point& p : domain.points) {
        double const from_top = angle * p.x / grid.nx + twist * p.y / highest, radius = hub + p.y;
        p = {radius * std::sin(from_top), radius * std::cos(from_top)};
    }
    domain.is_passage = true;
    domain.turn = {std::cos(angle), -std::sin(angle)};
    for (Domain::Image const& image : domain.images) {
        Point const from = domain.points[at(image.source)];
        domain.points[at(image.at)] = turned(from, domain.turn);
    }
}

}  // namespace

Domain make_domain(Input& input) {
    Domain out;
    Grid grid{input.from(2, 11), input.from(2, 9), input.one_in(3)};
    if (grid.is_ring) grid.nx = std::max(grid.nx, 3);
    std::vector<Hole> holes;
    if (!grid.is_ring && grid.nx > 2 && grid.ny > 2 && !input.one_in(4)) {
        std::int32_t const middle = grid.nx / 2, two = grid.nx >= 6 && input.one_in(2);
        auto const hole_in = [&](std::int32_t from, std::int32_t to) {
            std::int32_t const i = input.from(from, to - 1), j = input.from(1, grid.ny - 2);
            holes.push_back({i, input.from(i + 1, to), j, input.from(j + 1, grid.ny - 1)});
        };
        hole_in(1, two ? middle - 1 : grid.nx - 1);
        if (two) hole_in(middle + 1, grid.nx - 1);
    }

    double const stretch = input.any_of({1.0, 1.0, 1.2, 3.0, 10.0}),
                 noise = input.any_of({0.0, 0.1, 0.3, 0.6});
    double const pi = std::acos(-1.0), growth = input.between(1.2, 2);
    double const ratio = input.between(0.3, 1);  // of a ring's axes
    std::int32_t const columns = grid.is_ring ? grid.nx : grid.nx + 1;
    for (std::int32_t j = 0; j <= grid.ny; ++j)
        for (std::int32_t i = 0; i < columns; ++i) {
            double const along = i + noise * input.between(-0.5, 0.5),
                         up = j + (j > 0 ? noise * input.between(-0.5, 0.5) : 0);
            double const height = stretch == 1 ? up : (std::pow(stretch, up) - 1) / (stretch - 1);
            if (!grid.is_ring) out.points.push_back({along, height});
            else {
                double const angle = 2 * pi * along / grid.nx, radius = std::pow(growth, height);
                out.points.push_back({radius * std::cos(angle), radius * ratio * std::sin(angle)});
            }
        }
    std::uint32_t const sides = grid.is_ring ? 2 : input.below(9);
    if (sides % 3 != 2) {  // sides are straight again, and opposite ones translates of each other
        for (std::int32_t i = 0; i < columns; ++i) {
            Point &bottom = out.points[at(grid.at(i, 0))],
                  &top = out.points[at(grid.at(i, grid.ny))];
            double const highest =
                stretch == 1 ? grid.ny : (std::pow(stretch, grid.ny) - 1) / (stretch - 1);
            bottom = {i + 0.0, 0};
            top = {i + 0.0, highest};
        }
        for (std::int32_t j = 1; j < grid.ny; ++j) {
            Point &start = out.points[at(grid.at(0, j))],
                  &end = out.points[at(grid.at(grid.nx, j))];
            start.x = 0;
            end = {grid.nx + 0.0, start.y};
        }
        bool const is_passage = !holes.empty() && (sides == 3 || sides == 6);
        grid.has_tip = is_passage && input.one_in(4);
        for (std::int32_t j = 0; j <= grid.ny; ++j)
            out.images.push_back({grid.at(0, j), grid.at(grid.nx, j)});
        if (is_passage) bend(out, grid, input);
    }

    std::uint32_t const split = input.below(3);
    if (!grid.is_ring && holes.empty()) out.ni = grid.nx + 1, out.nj = grid.ny + 1;
    for (std::int32_t j = 0; j < grid.ny; ++j)
        for (std::int32_t i = 0; i < grid.nx; ++i) {
            bool is_hole = false;
            for (Hole const& hole : holes) is_hole = is_hole || hole.has(i, j);
            if (is_hole) continue;
            std::int32_t a = grid.at(i, j), b = grid.at(i + 1, j), c = grid.at(i + 1, j + 1),
                         d = grid.at(i, j + 1);
            if (grid.is_ring) std::swap(b, d);  // all cells run counter-clockwise
            add_cell(out, input, split, a, b, c, d);
        }
    if (split != 0 || grid.has_tip) out.ni = 0;

    if (grid.is_ring) {
        std::vector<std::int32_t> wall;
        for (std::int32_t i = 0; i < grid.nx; ++i) {
            out.faces.push_back({grid.at(i, 0), grid.at(i + 1, 0), first_wall});
            out.faces.push_back({grid.at(i, grid.ny), grid.at(i + 1, grid.ny), high});
            wall.push_back(grid.at(i, 0));
        }
        out.walls.push_back(wall);
    } else {
        bool const side_moves = holes.empty();
        for (std::int32_t i = 0; i < grid.nx; ++i) {
            if (!grid.has_tip)
                out.faces.push_back(
                    {grid.at(i, 0), grid.at(i + 1, 0), side_moves ? first_wall : low});
            out.faces.push_back({grid.at(i, grid.ny), grid.at(i + 1, grid.ny), high});
        }
        for (std::int32_t j = 0; j < grid.ny; ++j) {
            out.faces.push_back({grid.at(0, j), grid.at(0, j + 1), left});
            out.faces.push_back({grid.at(grid.nx, j), grid.at(grid.nx, j + 1), right});
        }
        if (side_moves) {
            out.walls_are_loops = false;
            out.walls.emplace_back();
            for (std::int32_t i = 0; i <= grid.nx; ++i) out.walls[0].push_back(grid.at(i, 0));
        }
        for (Hole const& hole : holes)
            add_hole(out, grid, hole, first_wall + static_cast<std::int32_t>(&hole - holes.data()));
    }
    if (grid.is_ring && input.one_in(2)) cut_ring(out, grid);
    if (out.ni == 0) drop_unused(out);

    double const size = input.one_in(6) ? std::pow(10.0, input.from(-95, 95)) : 1;
    Point const centre =
        input.one_in(6) ? Point{size * input.from(-1000000, 1000000), size} : Point{0, 0};
    for (Point& p : out.points) p = {centre.x + size * p.x, centre.y + size * p.y};
    out.centre = centre;
    return out;
}

}  // namespace fuzz
