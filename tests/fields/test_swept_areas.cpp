// Swept areas: the discrete geometric conservation law holds for each cell and each control volume
// in every layout of cells, to rounding.
#include <harmorph_fields.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/double_double.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/polygons.hpp>

#include <cmath>
#include <random>
#include <string>

using fixtures::DoubleDouble;

namespace {

struct Positions {
    std::vector<double> x, y;
    hm_points view() const { return {x.data(), y.data(), 1}; }
};

// A mesh in one layout, with the points of each cell in order and its first entry.
struct Layout {
    std::string name;
    hm_mesh mesh;
    std::vector<std::int32_t> list, quads, sizes;
    std::vector<std::vector<std::int32_t>> cell;
    std::vector<std::int64_t> first;
    std::int64_t entries = 0;
};

void add_cell(Layout& layout, std::vector<std::int32_t> points) {
    layout.first.push_back(layout.entries);
    layout.entries += static_cast<std::int64_t>(points.size());
    layout.cell.push_back(std::move(points));
}

// A grid of quadrilaterals in all layouts that can express it.
void make(Layout& layout, std::int32_t kind, std::int32_t ni, std::int32_t nj, std::int32_t base) {
    hm_mesh& mesh = layout.mesh;
    mesh = hm_mesh{};
    mesh.struct_size = sizeof mesh;
    mesh.index_base = base;
    mesh.n_points = ni * nj;
    mesh.cell_layout = kind;
    auto const at = [&](std::int32_t i, std::int32_t j) { return i + ni * j; };
    auto const put = [&](std::vector<std::int32_t>& to, std::vector<std::int32_t> const& points) {
        for (std::int32_t const p : points) to.push_back(p + base);
    };
    layout.sizes = {base};  // cell_start
    for (std::int32_t pass = 0; pass < 2; ++pass) {
        for (std::int32_t j = 0; j + 1 < nj; ++j) {
            for (std::int32_t i = 0; i + 1 < ni; ++i) {
                std::int32_t const a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                                   d = at(i, j + 1);
                bool const split = (i + 2 * j) % 3 == 0;
                std::vector<std::vector<std::int32_t>> cells{{a, b, c, d}};
                if (kind == HM_CELLS_TRIANGLES || (kind == HM_CELLS_MIXED && split))
                    cells = {{a, b, c}, {c, d, a}};
                if (kind == HM_CELLS_ROWS && split) cells = {{a, c, b}, {a, d, c}};  // clockwise
                if (kind == HM_CELLS_QUADS && split) cells = {{a, b, c, c}, {d, a, c, c}};
                if (kind == HM_CELLS_POLYGONS) {
                    if (i % 2 == 1 || i + 2 >= ni) {
                        if (i % 2 == 0) cells = {{a, b, c, d}};
                        else continue;
                    } else {
                        cells = {{a, b, at(i + 2, j), at(i + 2, j + 1), c, d}};
                    }
                }
                for (auto const& points : cells) {
                    bool const is_triangle = points.size() == 3;
                    if (kind == HM_CELLS_MIXED && is_triangle != (pass == 0)) continue;
                    if (kind != HM_CELLS_MIXED && pass == 1) continue;
                    add_cell(layout, points);
                    bool const to_quads = kind == HM_CELLS_MIXED && !is_triangle;
                    put(to_quads ? layout.quads : layout.list, points);
                    if (to_quads) ++mesh.n_quads;
                    layout.sizes.push_back(static_cast<std::int32_t>(layout.list.size()) + base);
                    ++mesh.n_cells;
                }
            }
        }
    }
    mesh.cell_points = layout.list.data();
    mesh.cell_start = layout.sizes.data();
    if (kind == HM_CELLS_MIXED) mesh.quad_points = layout.quads.data();
    if (kind == HM_CELLS_STRUCTURED) {
        mesh.ni = ni;
        mesh.nj = nj;
    }
    if (kind == HM_CELLS_BLOCKS) {
        layout.sizes = {ni, nj};
        mesh.n_blocks = 1;
        mesh.block_sizes = layout.sizes.data();
    }
}

DoubleDouble exact(double a, double b) { return DoubleDouble(a) - DoubleDouble(b); }

// Twice the area of a polygon given by differences from one of its points, which are exact.
DoubleDouble twice_area_of(Positions const& at, std::vector<std::int32_t> const& cell) {
    DoubleDouble sum = 0;
    auto const x = [&](std::size_t k) {
        return exact(at.x[static_cast<std::size_t>(cell[k])],
                     at.x[static_cast<std::size_t>(cell[0])]);
    };
    auto const y = [&](std::size_t k) {
        return exact(at.y[static_cast<std::size_t>(cell[k])],
                     at.y[static_cast<std::size_t>(cell[0])]);
    };
    for (std::size_t k = 1; k + 1 < cell.size(); ++k) sum += x(k) * y(k + 1) - y(k) * x(k + 1);
    return sum;
}

// Twice the area of the part of the control volume of corner k in a cell: a quadrilateral, whose
// area is half the cross product of its diagonals.
DoubleDouble twice_share_of(Positions const& at, std::vector<std::int32_t> cell, std::size_t k) {
    std::vector<std::int32_t> distinct = cell;
    if (distinct.size() == 4 && distinct[2] == distinct[3]) distinct.pop_back();
    std::size_t const n = distinct.size();
    auto const number = [&](std::size_t j) { return static_cast<std::size_t>(distinct[j % n]); };
    std::size_t const here = number(k), next = number(k + 1), previous = number(k + n - 1);
    DoubleDouble to_mean[2], across[2];
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> const& c = axis == 0 ? at.x : at.y;
        DoubleDouble sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += exact(c[number(j)], c[here]);
        to_mean[axis] = sum / DoubleDouble(static_cast<double>(n));
        across[axis] = exact(c[previous], c[next]) * DoubleDouble(0.5);
    }
    return to_mean[0] * across[1] - to_mean[1] * across[0];
}

struct Motion {
    const char* name;
    double height;  // of the first layer, relative to the width of the grid
    double offset;  // of the origin
    double random;  // random displacements in parts of the local spacing
    double turn;    // angle of a rotation
};
constexpr Motion motions[] = {
    {"small random motions", 0.1, 0, 0.2, 0}, {"thin layers", 1e-7, 0, 0.2, 0},
    {"a far origin", 0.1, 1e6, 0.2, 0},       {"a far origin and thin layers", 1e-7, 1e3, 0.2, 0},
    {"a large rotation", 1e-7, 10, 0, 2.5},   {"random motions across cells", 0.1, 0, 5, 0.7},
    {"no motion", 1e-7, 1e3, 0, 0},
};

// Rows of growing height, sheared so that no side is parallel to an axis.
Positions start_of(std::int32_t ni, std::int32_t nj, Motion const& motion) {
    Positions out;
    for (std::int32_t j = 0; j < nj; ++j) {
        double const y = j == 0 ? 0 : motion.height * std::pow(1 / motion.height, (j - 1.0) / nj);
        for (std::int32_t i = 0; i < ni; ++i) {
            double const x = static_cast<double>(i) / ni;
            out.x.push_back(motion.offset + x - 0.3 * y);
            out.y.push_back(-motion.offset + y + 0.4 * x);
        }
    }
    return out;
}
Positions moved(Positions const& start, std::int32_t ni, Motion const& motion, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Positions out = start;
    double const c = std::cos(motion.turn), s = std::sin(motion.turn);
    for (std::size_t k = 0; k < start.x.size(); ++k) {
        std::size_t const above = std::min(k + static_cast<std::size_t>(ni), start.x.size() - 1),
                          below = k < static_cast<std::size_t>(ni)
                                      ? k
                                      : k - static_cast<std::size_t>(ni);
        double const spacing = std::fabs(start.y[above] - start.y[below]);
        if (motion.turn != 0) {
            out.x[k] = c * start.x[k] - s * start.y[k];
            out.y[k] = s * start.x[k] + c * start.y[k];
        }
        if (motion.random != 0) {
            out.x[k] += motion.random * spacing * uniform(random);
            out.y[k] += motion.random * spacing * uniform(random);
        }
    }
    return out;
}

struct Swept {
    std::vector<double> sides, duals, halves;
    explicit Swept(std::int64_t n)
        : sides(static_cast<std::size_t>(n), -7.0), duals(sides), halves(2 * sides.size(), -7.0) {}
};

// The sum, and the bound of its error: 4 times 2^-52 of the sum of the absolute values.
struct Balance {
    DoubleDouble sum = 0, twice_change = 0;
    double size = 0;
    void add(double area, int sign = 1) {
        sum += DoubleDouble(sign * area);
        size += std::fabs(area);
    }
    bool holds() const {
        DoubleDouble const error = sum - twice_change * DoubleDouble(0.5);
        return std::fabs(error.high) <= 4 * 0x1p-52 * size;
    }
};

}  // namespace

TEST_CASE("cells and control volumes change by what their sides sweep, in every layout") {
    for (std::int32_t kind = HM_CELLS_ROWS; kind <= HM_CELLS_POLYGONS; ++kind) {
        for (Motion const& motion : motions) {
            std::int32_t const ni = 14, nj = 23, base = kind % 2;
            CAPTURE(kind);
            CAPTURE(motion.name);
            Layout layout;
            make(layout, kind, ni, nj, base);
            Positions const from = start_of(ni, nj, motion), to = moved(from, ni, motion, 5);
            layout.mesh.points = from.view();
            std::int64_t n = 0;
            hm_error error;
            REQUIRE(hm_swept_count(&layout.mesh, &n, &error) == HM_OK);
            REQUIRE(n == layout.entries);
            Swept swept(n);
            hm_points const target = to.view();
            hm_status const status =
                hm_swept_areas(&layout.mesh, nullptr, &target, swept.sides.data(),
                               swept.duals.data(), swept.halves.data(), nullptr, &error);
            INFO(error.text);
            REQUIRE(status == HM_OK);
            std::vector<Balance> volume(from.x.size());
            int broken = 0, moved_though_still = 0;
            for (std::size_t i = 0; i < layout.cell.size(); ++i) {
                std::vector<std::int32_t> const& cell = layout.cell[i];
                std::size_t const first = static_cast<std::size_t>(layout.first[i]),
                                  w = cell.size();
                Balance area;
                area.twice_change = twice_area_of(to, cell) - twice_area_of(from, cell);
                std::size_t const distinct = w == 4 && cell[2] == cell[3] ? 3 : w;
                for (std::size_t k = 0; k < w; ++k) {
                    std::size_t const e = first + k;
                    area.add(swept.sides[e]);
                    std::size_t const before = first + (k == 0 ? w : k) - 1;
                    Balance& of_point = volume[static_cast<std::size_t>(cell[k])];
                    of_point.add(swept.duals[e]);
                    of_point.add(swept.duals[before], -1);
                    of_point.add(swept.halves[2 * e]);
                    of_point.add(swept.halves[2 * before + 1]);
                    if (k < distinct) {
                        of_point.twice_change +=
                            twice_share_of(to, cell, k) - twice_share_of(from, cell, k);
                    }
                    double const parts = swept.halves[2 * e] + swept.halves[2 * e + 1];
                    if (std::fabs(parts - swept.sides[e]) >
                        0x1p-52 *
                            (std::fabs(swept.halves[2 * e]) + std::fabs(swept.halves[2 * e + 1])))
                        ++broken;
                    if (motion.random == 0 && motion.turn == 0 &&
                        (swept.sides[e] != 0 || swept.duals[e] != 0 || swept.halves[2 * e] != 0 ||
                         std::signbit(swept.sides[e])))
                        ++moved_though_still;
                }
                if (!area.holds()) ++broken;
            }
            for (Balance const& of_point : volume) broken += of_point.holds() ? 0 : 1;
            CHECK(broken == 0);
            CHECK(moved_though_still == 0);
        }
    }
}

TEST_CASE("a side has exactly opposite areas in its two cells; threads do not change bits") {
    fixtures::Mesh const mesh = fixtures::two_bodies(40, 30, {}, fixtures::Ellipse{0.25, 0.06, 0.4},
                                                     fixtures::Cells::hybrid);
    Positions to{mesh.x, mesh.y};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-0.01, 0.01);
    for (double& x : to.x) x += uniform(random);
    for (double& y : to.y) y += uniform(random);
    hm_mesh const view = mesh.view();
    hm_points const target = to.view();
    std::int64_t n = 0;
    REQUIRE(hm_swept_count(&view, &n, nullptr) == HM_OK);
    Swept one(n), many(n);
    fixtures::Backwards threads;
    hm_executor const executor = threads.executor(4);
    REQUIRE(hm_swept_areas(&view, nullptr, &target, one.sides.data(), one.duals.data(), nullptr,
                           nullptr, nullptr) == HM_OK);
    REQUIRE(hm_swept_areas(&view, nullptr, &target, many.sides.data(), many.duals.data(), nullptr,
                           &executor, nullptr) == HM_OK);
    CHECK(one.sides == many.sides);
    CHECK(one.duals == many.duals);
    CHECK(one.halves[0] == -7);
    std::map<fixtures::Edge, double> seen;
    int pairs = 0, different = 0;
    for (std::size_t i = 0; i + 1 < mesh.cell_start.size(); ++i) {
        std::int32_t const begin = mesh.cell_start[i], end = mesh.cell_start[i + 1];
        for (std::int32_t k = begin; k < end; ++k) {
            std::int32_t const
                a = mesh.cells[static_cast<std::size_t>(k)],
                b = mesh.cells[static_cast<std::size_t>(k + 1 == end ? begin : k + 1)];
            auto const other = seen.find({b, a});
            seen[{a, b}] = one.sides[static_cast<std::size_t>(k)];
            if (other == seen.end()) continue;
            ++pairs;
            if (other->second != -one.sides[static_cast<std::size_t>(k)]) ++different;
        }
    }
    CHECK(pairs > 1000);
    CHECK(different == 0);
}

TEST_CASE("the sign: a side that moves outwards from a counter-clockwise cell is positive") {
    double const x[] = {0, 1, 0}, y[] = {0, 0, 1}, to_x[] = {0, 2, 0};
    std::int32_t const cell[] = {0, 1, 2};
    auto mesh = fixtures::sized<hm_mesh>();
    mesh.n_points = 3;
    mesh.points = {x, y, 1};
    mesh.cell_layout = HM_CELLS_TRIANGLES;
    mesh.n_cells = 1;
    mesh.cell_points = cell;
    hm_points const to = {to_x, y, 1};
    double sides[3] = {}, duals[3] = {}, halves[6] = {};
    REQUIRE(hm_swept_areas(&mesh, nullptr, &to, sides, duals, halves, nullptr, nullptr) == HM_OK);
    CHECK(sides[0] == 0);    // slides along itself
    CHECK(sides[1] == 0.5);  // turns about point 2
    CHECK(sides[2] == 0);    // does not move
    CHECK(halves[2] == 0.375);
    CHECK(halves[3] == 0.125);
    CHECK(duals[0] > 0);  // moves away from point 0, whose control volume grows
}

TEST_CASE("refused swept areas leave the arrays as they were") {
    fixtures::Mesh const mesh =
        fixtures::two_bodies(8, 5, {}, fixtures::Ellipse{0.25, 0.06, 0.4}, fixtures::Cells::quads);
    hm_mesh view = mesh.view();
    hm_points to = view.points;
    std::int64_t n = 0;
    REQUIRE(hm_swept_count(&view, &n, nullptr) == HM_OK);
    Swept swept(n);
    hm_error error;
    auto const call = [&] {
        return hm_swept_areas(&view, nullptr, &to, swept.sides.data(), nullptr, nullptr, nullptr,
                              &error);
    };
    std::vector<double> bad = mesh.x;
    bad[7] = NAN;
    to.x = bad.data();
    CHECK(call() == HM_BAD_MESH);
    CHECK(error.item == 7);
    to.x = nullptr;
    CHECK(call() == HM_BAD_ARGUMENT);
    to = view.points;
    CHECK(hm_swept_areas(&view, nullptr, &to, nullptr, nullptr, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "sides, duals and halves are all NULL; ask for at least one array");
    CHECK(hm_swept_areas(&view, nullptr, nullptr, swept.sides.data(), nullptr, nullptr, nullptr,
                         &error) == HM_BAD_ARGUMENT);
    CHECK(hm_swept_count(&view, nullptr, &error) == HM_BAD_ARGUMENT);
    std::vector<std::int32_t> cells = mesh.cells;
    cells[3] = view.n_points;
    view.cell_points = cells.data();
    CHECK(call() == HM_BAD_MESH);
    for (double const area : swept.sides) CHECK(area == -7);
}
