// The step at which a boundary first touches itself, against all pairs of points and faces in more
// digits, and against crossings along the way.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/solved.hpp>

#include "morph/crossing.hpp"

using namespace fixtures;
using harmorph::Touch;

namespace {

using Wide = long double;

struct Moving {
    std::vector<double> x, y, dx, dy;
    std::vector<std::int32_t> point, loop_start{0};

    void add(std::vector<Point> const& corners, std::vector<Point> const& moves) {
        for (std::size_t k = 0; k < corners.size(); ++k) {
            point.push_back(std::int32_t(x.size()));
            x.push_back(corners[k].x), y.push_back(corners[k].y);
            dx.push_back(moves[k].x), dy.push_back(moves[k].y);
        }
        loop_start.push_back(std::int32_t(point.size()));
    }
    void add(std::vector<Point> const& corners, Point move) {
        add(corners, std::vector<Point>(corners.size(), move));
    }
    Touch find(double limit = HUGE_VAL) const {
        return harmorph::first_touch({span(point), span(loop_start)}, {x.data(), y.data(), 1},
                                     {dx.data(), dy.data(), 1}, limit);
    }
    bool crosses_at(double s) const {
        std::vector<double> at_x = x, at_y = y;
        for (std::size_t k = 0; k < x.size(); ++k) at_x[k] += s * dx[k], at_y[k] += s * dy[k];
        return harmorph::find_crossing({span(point), span(loop_start)},
                                       {at_x.data(), at_y.data(), 1})
            .found;
    }

    std::int32_t after(std::int32_t k, std::size_t loop) const {
        return k + 1 < loop_start[loop + 1] ? k + 1 : loop_start[loop];
    }
    // The definition: the smallest root of all pairs at which the point is between the face's ends.
    Wide brute_force() const {
        Wide least = HUGE_VALL;
        for (std::size_t loop = 0; loop + 1 < loop_start.size(); ++loop)
            for (std::int32_t a = loop_start[loop]; a < loop_start[loop + 1]; ++a)
                for (std::int32_t p = 0; p < std::int32_t(x.size()); ++p)
                    if (p != a && p != after(a, loop))
                        least = std::min(least, touch(std::size_t(p), std::size_t(a),
                                                      std::size_t(after(a, loop))));
        return least;
    }
    Wide touch(std::size_t p, std::size_t a, std::size_t b) const {
        Wide const ux = Wide(x[b]) - x[a], uy = Wide(y[b]) - y[a];
        Wide const wx = Wide(x[p]) - x[a], wy = Wide(y[p]) - y[a];
        Wide const vx = Wide(dx[b]) - dx[a], vy = Wide(dy[b]) - dy[a];
        Wide const zx = Wide(dx[p]) - dx[a], zy = Wide(dy[p]) - dy[a];
        Wide const c = ux * wy - uy * wx, q = vx * zy - vy * zx;
        Wide const l = ux * zy - uy * zx + vx * wy - vy * wx;
        std::vector<Wide> roots;
        if (q == 0) {
            if (l != 0) roots = {-c / l};
        } else if (l * l >= 4 * q * c) {
            Wide const root = std::sqrt(l * l - 4 * q * c);
            roots = {(-l - root) / (2 * q), (-l + root) / (2 * q)};
        }
        Wide least = HUGE_VALL;
        for (Wide const s : roots) {
            Wide const sx = ux + s * vx, sy = uy + s * vy;
            Wide const along = sx * (wx + s * zx) + sy * (wy + s * zy);
            if (s > 0 && along >= 0 && along <= sx * sx + sy * sy) least = std::min(least, s);
        }
        return least;
    }
};

bool near(double a, double b) { return a == b || a == doctest::Approx(b).epsilon(1e-12); }

std::vector<Point> ring(int n, double rx, double ry, Point centre) {
    std::vector<Point> out;
    for (int k = 0; k < n; ++k) {
        double const angle = -2 * pi * k / n;
        out.push_back({centre.x + rx * std::cos(angle), centre.y + ry * std::sin(angle)});
    }
    return out;
}

}  // namespace

TEST_CASE("random bodies in random motion: the first touch of all pairs, and no crossing before") {
    std::mt19937 random(3);
    auto const between = [&](double low, double high) {
        return low + (high - low) * uniform(random);
    };
    int touched = 0, apart = 0;
    for (int trial = 0; trial < 400; ++trial) {
        Moving moving;
        for (int body = 0; body < 1 + trial % 4; ++body) {
            int const n = 3 + int(random() % 60);
            std::vector<Point> const corners =
                ring(n, between(0.2, 0.9), between(0.05, 0.9), {2.0 * body, 2.0 * (body % 2)});
            Point const by{between(-1, 1), between(-1, 1)};
            double const rough = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 0.02 : 1;
            std::vector<Point> moves;
            for (int k = 0; k < n; ++k) {
                moves.push_back({by.x + rough * between(-1, 1), by.y + rough * between(-1, 1)});
            }
            moving.add(corners, moves);
        }
        auto const expected = double(moving.brute_force());
        Touch const found = moving.find();
        INFO("trial " << trial);
        if (expected == HUGE_VAL) {
            CHECK(found.step == HUGE_VAL);
            CHECK(found.point == -1);
            ++apart;
            continue;
        }
        ++touched;
        REQUIRE(found.step == doctest::Approx(expected).epsilon(1e-9));
        auto const named = double(moving.touch(std::size_t(found.point), std::size_t(found.face[0]),
                                               std::size_t(found.face[1])));
        CHECK(named == doctest::Approx(expected).epsilon(1e-9));
        for (double const part : {0.1, 0.4, 0.7, 0.9, 0.999999}) {
            CHECK(!moving.crosses_at(part * found.step));
        }
        CHECK(moving.find(1.0001 * expected).step == found.step);
        CHECK(moving.find(0.9999 * expected).point == -1);
    }
    CHECK(touched > 100);
    CHECK(apart > 30);
}

TEST_CASE("the walls of a body that becomes thin meet inside it, at the fraction that is known") {
    for (int const n : {8, 40, 400}) {
        Moving moving;
        std::vector<Point> const corners = ring(n, 1, 0.1, {0, 0});
        std::vector<Point> moves;
        for (Point const p : corners) moves.push_back({0, -1.25 * p.y});  // thickness 1 - 1.25 s
        moving.add(corners, moves);
        CHECK(moving.find().step == doctest::Approx(0.8).epsilon(1e-12));
        CHECK(!moving.crosses_at(0.799));
        CHECK(moving.find(0.5).step == HUGE_VAL);
    }
}

TEST_CASE("a table of two bodies: faces, corners and lines that meet, and what only passes by") {
    std::vector<Point> const square = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    struct {
        const char* name;
        std::vector<Point> other;
        Point move;
        double step;
    } const all[] = {
        {"a side on a side", {{2, 0}, {2, 1}, {3, 1}, {3, 0}}, {-2, 0}, 0.5},
        {"a side on a part of a side", {{2, .2}, {2, .8}, {3, .8}, {3, .2}}, {-4, 0}, 0.25},
        {"a corner on a side", {{2, .5}, {3, 1}, {3, 0}}, {-2, 0}, 0.5},
        {"a corner on a corner", {{2, 2}, {2, 3}, {3, 3}}, {-2, -2}, 0.5},
        {"a corner along a diagonal, exactly", {{3, 3}, {3, 4}, {4, 4}}, {-8, -8}, 0.25},
        {"a side that slides along a line with a side",
         {{3, 1}, {3, 2}, {5, 2}, {5, 1}},
         {-4, 0},
         0.5},
        {"past", {{2, 1.5}, {2, 2}, {3, 2}, {3, 1.5}}, {-9, 0}, HUGE_VAL},
        {"away", {{2, 0}, {2, 1}, {3, 1}, {3, 0}}, {1, 0}, HUGE_VAL},
        {"with it", {{2, 0}, {2, 1}, {3, 1}, {3, 0}}, {0, 0}, HUGE_VAL},
        {"touching, and away", {{1, 0}, {1, 1}, {3, 1}, {3, 0}}, {1, 0}, HUGE_VAL},
        {"faces that lie on each other all the way, from before the movement",
         {{1, .2}, {1, .8}, {3, .8}, {3, .2}},
         {0, .1},
         2},
        {"touching, and through", {{1, .2}, {1, .8}, {3, .8}, {3, .2}}, {-.5, 0}, 0}};
    for (auto const& one : all) {
        INFO(std::string(one.name));
        Moving moving;
        moving.add(square, Point{0, 0});
        moving.add(one.other, one.move);
        CHECK(near(moving.find().step, one.step));
        CHECK((moving.find().point == -1) == (one.step == HUGE_VAL));
        Moving both;  // seen from the other body, to rounding
        both.add(square, Point{-one.move.x, -one.move.y});
        both.add(one.other, Point{0, 0});
        CHECK(near(both.find().step, one.step));
    }
}

TEST_CASE("the two sides of a wall without thickness move together, part, and close again") {
    std::vector<Point> const plate = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 0}, {1, 0}};
    Moving together;
    together.add(plate, Point{0.3, -0.7});
    CHECK(together.find().step == HUGE_VAL);
    Moving bent;
    bent.add(plate, {{0, 0}, {0, .1}, {0, .4}, {0, .9}, {0, .4}, {0, .1}});
    CHECK(bent.find().step == HUGE_VAL);
}

TEST_CASE("the two sides of a wall without thickness may differ by rounding") {
    std::mt19937 random(3);
    std::vector<Point> const line = {{0, 0}, {.1, .01}, {.2, .05}, {.3, .07}, {.4, .05}};
    for (int trial = 0; trial < 200; ++trial) {
        // The upper side, and back along the lower side, each rounded in its own way.
        auto const rounded = [&](double a) { return a * (1 + 1e-15 * (uniform(random) - .5)); };
        double const angle = 6 * uniform(random), c = std::cos(angle), s = std::sin(angle);
        std::vector<Point> plate, turned;
        for (std::size_t k = 0; k < 8; ++k) {
            Point const p = line[k > 4 ? 8 - k : k];
            plate.push_back({rounded(p.x), rounded(p.y)});
            turned.push_back(
                {(c - 1) * plate[k].x - s * plate[k].y + 7, s * plate[k].x + (c - 1) * plate[k].y});
        }
        Moving together, apart, through;
        together.add(plate, turned);
        apart.add(plate, {{}, {}, {}, {}, {}, {0, -.01}, {0, -.02}, {0, -.01}});
        through.add(plate, {{}, {}, {}, {}, {}, {}, {0, .02}, {}});
        for (Moving const* moving : {&together, &apart, &through}) {
            bool const crosses = moving == &through;
            CHECK((moving->find().step < 1e-9) == crosses);
            CHECK((moving->find().step == HUGE_VAL) != crosses);
            CHECK(harmorph::find_crossing({span(moving->point), span(moving->loop_start)},
                                          {moving->x.data(), moving->y.data(), 1},
                                          {moving->dx.data(), moving->dy.data(), 1})
                      .found == crosses);
        }
    }
}

TEST_CASE("the smaller step is that of a wall which crosses itself without an inverted cell") {
    Case setup = airfoil_case(60, 16, Cells::quads);
    Solved const solved(setup);
    hm_mesh const mesh = setup.mesh.view();
    // A control point above the middle of the chord goes down, through the lower wall.
    std::vector<double> move(2 * std::size_t(setup.curves.n_control()));
    move[9] = -0.2;
    Moved const by = displaced(solved.basis, move);
    auto quality = sized<hm_quality_report>();
    hm_step_report const step = step_of(solved.basis, mesh, by),
                         assessed = step_of(solved.basis, mesh, by, &quality);
    CHECK(std::memcmp(&step, &assessed, sizeof step) == 0);
    INFO("cells " << step.admissible << ", boundary " << step.boundary);
    REQUIRE(quality.self_crossing == 1);
    REQUIRE(quality.inverted == 0);
    REQUIRE(step.admissible > 1);
    CHECK(step.boundary < 1);
    for (std::int32_t const point : step.boundary_points) CHECK(point >= 0);
    for (double const factor : {0.9999, 1.0001}) {  // just before, and just after
        Mesh at = setup.mesh;
        for (std::size_t k = 0; k < at.x.size(); ++k) {
            at.x[k] += factor * step.boundary * by.x[k];
            at.y[k] += factor * step.boundary * by.y[k];
        }
        CHECK(quality_of(solved.basis, mesh, at).self_crossing == (factor > 1 ? 1 : 0));
    }
}
