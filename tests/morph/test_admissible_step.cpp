// The admissible step is where the first corner's area becomes 0: not before, not after.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/traps.hpp>

#include "morph/admissible_step.hpp"

using namespace fixtures;
using harmorph::AdmissibleStep;

namespace {

struct Displaced {
    Mesh mesh;
    std::vector<double> dx, dy;
    mutable std::vector<std::uint8_t> reversed;

    explicit Displaced(Mesh const& given_mesh)
        : mesh(given_mesh),
          dx(mesh.x.size(), 0.0),
          dy(dx),
          reversed(std::size_t(mesh.n_cells()), 0) {}

    AdmissibleStep step() const {
        harmorph::Mesh const view = core_mesh(mesh);
        return admissible_step({view, span(reversed)}, view.points, {dx.data(), dy.data(), 1}, {});
    }
    std::int32_t point(AdmissibleStep const& limit) const {
        return limiting_point({core_mesh(mesh), span(reversed)}, limit);
    }
    Mesh after(double s) const {
        Mesh out = mesh;
        for (std::size_t k = 0; k < dx.size(); ++k) {
            out.x[k] += s * dx[k];
            out.y[k] += s * dy[k];
        }
        return out;
    }
    bool valid_after(double s) const { return check(after(s)).min_corner > 0; }
};

double mean_quality(Solved const& solved, hm_mesh const& mesh, Mesh const& at,
                    Mesh const& reference) {
    auto report = sized<hm_quality_report>();
    REQUIRE(hm_assess(solved.basis, &mesh, points_in(at.x, at.y), nullptr,
                      points_in(reference.x, reference.y), nullptr, nullptr, &report,
                      nullptr) == HM_OK);
    return report.mean_quality;
}

Displaced one_triangle() {
    Mesh mesh;
    mesh.add_point({0, 0});
    mesh.add_point({1, 0});
    mesh.add_point({0, 1});
    mesh.add_cell({0, 1, 2});
    return Displaced(mesh);
}

Displaced random_displacement(Mesh const& mesh, double size, unsigned seed) {
    Displaced out(mesh);
    std::mt19937 random(seed);
    for (std::size_t k = 0; k < out.dx.size(); ++k) {
        out.dx[k] = size * (2 * uniform(random) - 1);
        out.dy[k] = size * (2 * uniform(random) - 1);
    }
    return out;
}

}  // namespace

TEST_CASE("roots of the quadratic, in all cases of its signs") {
    // Twice the area after a fraction s of these displacements is (1 + p s)(1 + q s) - r s^2 = 1 +
    // (p + q) s + (p q - r) s^2.
    double const values[] = {-3,      -1,  -0.5, -0x1p-10, 0,
                             0x1p-10, 0.5, 1,    3};  // exact, and so double roots are
    int unlimited = 0, limited = 0;
    for (double const p : values)
        for (double const q : values)
            for (double const r : {-20.0, -2.0, -0.25, 0.0, 0.25, 2.0, 20.0}) {
                Displaced displaced = one_triangle();
                displaced.dx[1] = p;
                displaced.dy[2] = q;
                displaced.dy[1] = 1;
                displaced.dx[2] = r;
                long double const a = static_cast<long double>(p) * q - r,
                                  b = static_cast<long double>(p) + q;
                long double const discriminant = b * b - 4 * a;
                long double expected = HUGE_VALL;
                auto const offer = [&](long double s) {
                    if (s > 0 && s < expected) expected = s;
                };
                if (discriminant >= 0) {
                    long double const root = std::sqrt(discriminant);
                    // Both forms of the quadratic formula lose digits somewhere.
                    if (b + root != 0) offer(-2 / (b + root));
                    if (b - root != 0) offer(-2 / (b - root));
                }
                AdmissibleStep const found = displaced.step();
                INFO("p " << p << " q " << q << " r " << r);
                if (expected == HUGE_VALL) {
                    CHECK(found.step == HUGE_VAL);
                    CHECK(found.cell == -1);
                    CHECK(displaced.point(found) == -1);
                    ++unlimited;
                } else {
                    CHECK(found.step == doctest::Approx(double(expected)).epsilon(1e-7));
                    CHECK(found.cell == 0);
                    CHECK(displaced.point(found) == 0);
                    ++limited;
                }
            }
    CHECK(unlimited > 50);
    CHECK(limited > 50);
}

// Needles: two sides of length 1 and one of 1e-10, at any angle and with the short side anywhere in
// the order of the points. The product of the long sides would have lost six digits of the area.
// Alone, and behind 64 cells that limit the step to a little more.
TEST_CASE("the step of a needle has the digits of its short side") {
    std::mt19937 random(8);
    int limited = 0;
    for (int trial = 0; trial < 300; ++trial) {
        double const angle = 6.3 * uniform(random), size = 1e-10;
        auto const any = [&] { return size * (2 * uniform(random) - 1); };
        double const turned =
            angle + 0.3 + 2.5 * uniform(random);  // of the short side against the long ones
        Point const corner[] = {{0, 0},
                                {std::cos(angle), std::sin(angle)},
                                {size * std::cos(turned), size * std::sin(turned)}};
        Mesh mesh;
        for (int k = 0; k < 3; ++k) mesh.add_point(corner[(k + trial) % 3]);
        mesh.add_cell({0, 1, 2});
        Displaced alone(mesh);
        for (std::size_t k = 0; k < 3; ++k) alone.dx[k] = any(), alone.dy[k] = any();

        auto const side = [&](std::vector<double> const& coordinates, int to) {
            std::size_t const from = std::size_t(3 - trial % 3) % 3;  // the point at the origin
            return static_cast<long double>(coordinates[(from + std::size_t(to)) % 3]) -
                   coordinates[from];
        };
        long double const ax = side(mesh.x, 1), ay = side(mesh.y, 1), bx = side(mesh.x, 2),
                          by = side(mesh.y, 2);
        long double const ux = side(alone.dx, 1), uy = side(alone.dy, 1), vx = side(alone.dx, 2),
                          vy = side(alone.dy, 2);
        long double const c = ax * by - ay * bx, b = ax * vy - ay * vx + ux * by - uy * bx,
                          a = ux * vy - uy * vx;
        long double const root = b * b - 4 * a * c;
        if (b >= 0 || root < 0.01L * b * b) continue;
        ++limited;
        double const expected = double(2 * c / (std::sqrt(root) - b));
        CHECK(alone.step().step == doctest::Approx(expected).epsilon(1e-12));

        Displaced last(Mesh{});
        for (int cell = 0; cell < 64; ++cell) {
            std::int32_t const first = std::int32_t(last.mesh.x.size());
            last.mesh.add_point({0, 0}), last.mesh.add_point({1, 0}), last.mesh.add_point({0, 1});
            last.mesh.add_cell({first, first + 1, first + 2});
            last.dx.insert(last.dx.end(), {0, -1 / (expected * (1 + 1e-7)), 0});
            last.dy.insert(last.dy.end(), {0, 0, 0});
        }
        std::int32_t const first = std::int32_t(last.mesh.x.size());
        for (std::size_t k = 0; k < 3; ++k) last.mesh.add_point({mesh.x[k], mesh.y[k]});
        last.mesh.add_cell({first, first + 1, first + 2});
        last.dx.insert(last.dx.end(), alone.dx.begin(), alone.dx.end());
        last.dy.insert(last.dy.end(), alone.dy.begin(), alone.dy.end());
        last.reversed.assign(65, 0);
        CHECK(last.step().cell == 64);
        CHECK(last.step().step == alone.step().step);
    }
    CHECK(limited > 50);
}

TEST_CASE("rigid and growing motions are unlimited; a collapse is not") {
    Mesh const mesh = square(6, Cells::hybrid, 2, 2);
    Displaced displaced(mesh);
    CHECK(displaced.step().step == HUGE_VAL);  // no motion
    for (std::size_t k = 0; k < displaced.dx.size(); ++k)
        displaced.dx[k] = 0.3, displaced.dy[k] = -7;
    CHECK(displaced.step().step == HUGE_VAL);
    for (std::size_t k = 0; k < displaced.dx.size(); ++k)
        displaced.dx[k] = mesh.x[k], displaced.dy[k] = mesh.y[k];
    CHECK(displaced.step().step == HUGE_VAL);
    // Turning and growing.
    for (std::size_t k = 0; k < displaced.dx.size(); ++k)
        displaced.dx[k] = -mesh.y[k], displaced.dy[k] = mesh.x[k];
    CHECK(displaced.step().step == HUGE_VAL);
    for (std::size_t k = 0; k < displaced.dx.size(); ++k)
        displaced.dx[k] = -mesh.x[k] / 3, displaced.dy[k] = 0;
    CHECK(displaced.step().step == doctest::Approx(3).epsilon(1e-12));
}

TEST_CASE("the admissible step on meshes is exact to a millionth") {
    int limited = 0;
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (unsigned seed = 0; seed < 20; ++seed) {
            Mesh mesh = annulus(5, 24, 0.5, 2, kind);
            perturb(mesh, 0.3, seed);
            Displaced const displaced = random_displacement(mesh, 0.01, seed + 100);
            AdmissibleStep const found = displaced.step();
            REQUIRE(found.step < HUGE_VAL);
            ++limited;
            CHECK(displaced.valid_after(found.step * 0.999999));
            CHECK(!displaced.valid_after(found.step * 1.000001));
            for (int k = 1; k < 50; ++k) CHECK(displaced.valid_after(found.step * k / 50));
            // The limiting corner is the one that is flat there.
            Mesh const flat = displaced.after(found.step);
            harmorph::Cell const cell = core_mesh(mesh).cell(found.cell);
            bool seen = false;
            for (int k = 0; k < cell.n; ++k) {
                Point const a = flat.point(cell.point[k]), b = flat.point(cell.next(k)),
                            c = flat.point(cell.previous(k));
                if (cell.point[k] == displaced.point(found))
                    seen = std::fabs(twice_area(a, b, c)) < 1e-12;
            }
            CHECK(seen);
        }
    CHECK(limited == 60);
}

TEST_CASE("clockwise cells have the same steps; an inverted mesh allows none") {
    Mesh const mesh = square(6, Cells::hybrid, 2, 2);
    Displaced const displaced = random_displacement(mesh, 0.01, 5);
    Displaced clockwise = displaced;
    reverse_all(clockwise.mesh);
    std::fill(clockwise.reversed.begin(), clockwise.reversed.end(), std::uint8_t{1});
    CHECK(clockwise.step().step == doctest::Approx(displaced.step().step).epsilon(1e-14));
    CHECK(clockwise.step().cell == displaced.step().cell);
    CHECK(clockwise.point(clockwise.step()) == displaced.point(displaced.step()));

    Displaced inverted = displaced;
    inverted.mesh.x[8] = -1;
    CHECK(inverted.step().step == 0);
    CHECK(inverted.step().cell == 0);
    Displaced flat = one_triangle();
    flat.mesh.x[2] = 2;
    flat.mesh.y[2] = 0;
    flat.dy[2] = 1;  // would become valid, but is not
    CHECK(flat.step().step == 0);
}

TEST_CASE("a displacement that is not a number allows no step") {
    Untrapped const untrapped;
    Mesh const mesh = square(6, Cells::hybrid, 2, 2);
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        Displaced displaced = random_displacement(mesh, 1e-3, 7);
        displaced.dy[point] = std::nan("");
        AdmissibleStep const found = displaced.step();
        CHECK(found.step == 0);
        harmorph::Cell const cell = core_mesh(mesh).cell(found.cell);
        CHECK(std::count(cell.point, cell.point + cell.n, std::int32_t(point)) == 1);
    }
}

TEST_CASE("a smaller displacement allows the larger step, exactly so for powers of two") {
    Mesh const mesh = annulus(5, 24, 0.5, 2, Cells::hybrid);
    Displaced const displaced = random_displacement(mesh, 0.01, 6);
    Displaced small = displaced;
    for (std::size_t k = 0; k < displaced.dx.size(); ++k) small.dx[k] /= 1024, small.dy[k] /= 1024;
    CHECK(small.step().step == 1024 * displaced.step().step);
    Displaced tiny = displaced;
    double const unit = std::ldexp(1.0, -40);
    for (std::size_t k = 0; k < displaced.dx.size(); ++k) {
        tiny.dx[k] *= unit, tiny.dy[k] *= unit;
        tiny.mesh.x[k] *= unit, tiny.mesh.y[k] *= unit;
    }
    CHECK(tiny.step().step == displaced.step().step);
}

TEST_CASE("the step from other coordinates than the mesh's own is that of the start") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    Displaced start(setup.mesh), now(setup.mesh);
    std::vector<double> const move = some_move(setup.curves.n_control(), 0.05, 3);
    REQUIRE(hm_morph(solved.basis, move.data(), nullptr, points_out(start.dx, start.dy), nullptr,
                     nullptr) == HM_OK);
    double const limit = start.step().step;
    now.mesh =
        start.after(0.5 * limit);  // as in a code that morphs from the first mesh at each time step
    hm_mesh const mesh = now.mesh.view();
    hm_step_report report{}, assessed{};
    report.struct_size = assessed.struct_size = sizeof report;
    auto quality = sized<hm_quality_report>();
    auto const from = points_in(setup.mesh.x, setup.mesh.y),
               displacement = points_in(start.dx, start.dy);
    REQUIRE(hm_assess(solved.basis, &mesh, from, displacement, nullptr, nullptr, &report, nullptr,
                      nullptr) == HM_OK);
    REQUIRE(hm_assess(solved.basis, &mesh, from, displacement, nullptr, nullptr, &assessed,
                      &quality, nullptr) == HM_OK);
    CHECK(assessed.admissible == report.admissible);
    CHECK(quality.mean_quality == mean_quality(solved, mesh, start.after(1), setup.mesh));

    double valid = 0, invalid = 1;
    while (start.valid_after(invalid)) valid = invalid, invalid += 0.125;
    for (int k = 0; k < 50; ++k) {
        double const middle = 0.5 * (valid + invalid);
        (start.valid_after(middle) ? valid : invalid) = middle;
    }
    CHECK(report.admissible == doctest::Approx(valid).epsilon(1e-10));

    REQUIRE(hm_assess(solved.basis, &mesh, nullptr, displacement, nullptr, nullptr, &report,
                      nullptr, nullptr) == HM_OK);
    CHECK(report.admissible == doctest::Approx(valid - 0.5 * limit).epsilon(1e-10));
}
