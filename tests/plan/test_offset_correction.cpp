// Offset correction: a wall that is not exactly on its curve turns with it.
#include <harmorph_design.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/operators.hpp>

#include "boundary/moving_boundary.hpp"

using namespace fixtures;

namespace {

Options corrected(std::int32_t correction = 1) {
    Options out = options_of(HM_CONFORMAL);
    out.offset_correction = correction;
    return out;
}

// Points of the inner circle up to `off` beside the curve they are on; parameters are found.
Case beside_its_curve(double off) {
    Case out = ring_case(8, 40, 0.5, 2, Cells::hybrid);
    Spline const spline = ring(3, 8, 0.5, 0.5);
    std::mt19937 random(3);
    for (std::size_t k = 0; k < 40; ++k) {
        harmorph::Vec2 p[2];
        curve_point(spline.curve(), out.known_u[k], 1, p);
        double const by = off * (2 * uniform(random) - 1) / length(p[1]);
        out.mesh.x[k] = p[0].x - by * p[1].y;
        out.mesh.y[k] = p[0].y + by * p[1].x;
    }
    return out;
}

double worst_on_wall(Solved const& solved, Case const& setup, Field const& moved, Complex s,
                     Complex centre, Complex shift) {
    hm_basis_info const info = solved.info();
    double worst = 0;
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        std::int32_t const point = info.curve_point[k];
        Complex const expected = (s - 1.0) * (to_complex(setup.mesh.point(point)) - centre) + shift;
        worst = std::fmax(worst, std::abs(moved[std::size_t(point)] - expected));
    }
    return worst;
}

}  // namespace

TEST_CASE("rigid motions and scalings of all control points move the wall rigidly") {
    Case setup = beside_its_curve(0.02);
    Options const with = corrected(), without = corrected(0);
    Solved const a(setup, &with), b(setup, &without);
    CHECK(a.info().offset_correction == 1);
    CHECK(a.report.max_distance > 0.015);
    CHECK(a.report.boundary_error < 1e-16);  // against the boundary data in use
    CHECK(a.report.partition_defect < 1e-14);
    for (Complex const s :
         {std::polar(1.0, 0.5), std::polar(1.0, 3.1), Complex(0.5, 0), Complex(1, 0)})
        for (Complex const centre : {Complex(0, 0), Complex(3, -2)}) {
            std::vector<double> const move = similarity_move(setup.curves, s, centre, {0.1, 0.7});
            CHECK(worst_on_wall(a, setup, displacement(a, move), s, centre, {0.1, 0.7}) < 1e-14);
            double const error =
                worst_on_wall(b, setup, displacement(b, move), s, centre, {0.1, 0.7});
            CHECK(error ==
                  doctest::Approx(std::abs(s - 1.0) * b.report.max_distance).epsilon(1e-6));
        }
}

TEST_CASE("general motions add e dC' / C' to the movement of the B-spline") {
    Case setup = beside_its_curve(0.01);
    Options const options = corrected();
    Solved const solved(setup, &options);
    std::vector<double> const move = some_move(8, 0.1, 4);
    Field const moved = displacement(solved, move),
                by_i = displacement(solved, turned(move, {0, 1}));
    for (std::size_t k = 0; k < moved.size(); ++k)
        CHECK(std::abs(by_i[k] - Complex(0, 1) * moved[k]) < 1e-14);
    CurveSet movement = setup.curves;
    movement.control = move;
    hm_basis_info const info = solved.info();
    double most = 0;
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        double at[4], by[4];
        REQUIRE(hm_curve_point(&setup.curves.view(), 0, info.point_u[k], 1, at, nullptr) == HM_OK);
        REQUIRE(hm_curve_point(&movement.view(), 0, info.point_u[k], 1, by, nullptr) == HM_OK);
        Complex const e = to_complex(setup.mesh.point(info.curve_point[k])) - Complex(at[0], at[1]);
        Complex const added = e * Complex(by[2], by[3]) / Complex(at[2], at[3]);
        most = std::fmax(most, std::abs(added));
        CHECK(std::abs(moved[std::size_t(info.curve_point[k])] - Complex(by[0], by[1]) - added) <
              1e-15);
    }
    CHECK(most > 1e-3);
}

TEST_CASE("a zero movement keeps every bit with offset correction, and the adjoint is exact") {
    Case setup = beside_its_curve(0.01);
    Options const options = corrected();
    Solved const solved(setup, &options);
    Moved const same = morphed(solved.basis, setup.mesh, std::vector<double>(16, 0.0));
    CHECK(same_bits(same.x, setup.mesh.x));
    CHECK(same_bits(same.y, setup.mesh.y));
    std::vector<double> const move = some_move(8, 0.2, 5);
    CHECK(boundary_error(solved.basis, move, setup.mesh, morphed(solved.basis, setup.mesh, move)) <
          1e-15);
    check_adjoint(solved.basis, move, 1e-14);
}

TEST_CASE("at corners nothing is known to turn: their points keep their offset") {
    Case setup =
        airfoil_case(30, 12, Cells::quads);  // a clamped curve whose two ends are one control point
    double const off = 1e-5;
    std::size_t const edge =
        std::size_t(points_on(setup.mesh, body)[0]);  // the trailing edge comes first
    setup.mesh.x[edge] += off;
    Options const options = corrected();
    Solved const solved(setup, &options);
    Complex const s = std::polar(1.0, 0.5), centre(0.25, 0);
    Field const moved = displacement(solved, similarity_move(setup.curves, s, centre));
    hm_basis_info const info = solved.info();
    std::int32_t corners = 0;
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        std::int32_t const point = info.curve_point[k];
        Complex const z = to_complex(setup.mesh.point(point)), rigid = (s - 1.0) * (z - centre);
        double const difference = std::abs(moved[std::size_t(point)] - rigid);
        if (info.point_u[k] > 0 && info.point_u[k] < 1) {
            CHECK(difference < 1e-13);
            continue;
        }
        ++corners;
        CHECK(difference == doctest::Approx(std::abs(s - 1.0) * off).epsilon(1e-6));
    }
    CHECK(corners == 1);
    // A polygon has corners inside, at knots; their points are left out, those on its sides are
    // not.
    Case polygon = tiny_case();
    polygon.mesh.x[16] -= 0.1;  // a corner and the middle of a side
    polygon.mesh.y[17] -= 0.1;
    Solved const sides(polygon, &options);
    Field const turned_field = displacement(sides, similarity_move(polygon.curves, s, {3, 3}));
    Complex const at_corner = (s - 1.0) * Complex(-1, -1), at_side = (s - 1.0) * Complex(0, -1.1);
    CHECK(std::abs(turned_field[16] - at_corner) < 1e-14);
    CHECK(std::abs(turned_field[17] - at_side) < 1e-14);
}

TEST_CASE("offset correction gives no huge values where the derivative of the curve is 0") {
    Case setup = ring_case(6, 24, 0.5, 2);
    // Degree 3, and four neighbouring control points all but coincide: so C' all but vanishes
    // there.
    for (std::size_t k = 0; k < 4; ++k) {
        setup.curves.control[2 * k] = 0.5;
        setup.curves.control[2 * k + 1] = 0.001 * double(k);
    }
    Options const options = corrected();
    Attempt const attempt(setup.problem(), &options);
    REQUIRE(attempt.status == HM_OK);
    for (double const value : {attempt.report.min_value, attempt.report.max_value})
        CHECK(std::fabs(value) < 2);  // what is added is smaller than 1
}

TEST_CASE("only the conformal operator can turn anything: others refuse the correction") {
    Case setup = tiny_case();
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_WEIGHTED}) {
        Options options = options_of(operator_kind);
        options.offset_correction = 1;
        CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
    }
}

TEST_CASE("no offset turns with the ends of an open curve, whether the curve is clamped or not") {
    for (bool const clamped : {false, true}) {
        std::vector<double> const control = {0, 0, 1, 1, 2, 1, 3, 0};
        std::vector<double> const knots = clamped ? std::vector<double>{3, 3, 3, 3, 4, 4, 4, 4}
                                                  : std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7};
        harmorph::Curve curve;
        curve.degree = 3;
        curve.n_indices = curve.n_control = 4;
        curve.knots = knots.data();
        curve.control = control.data();
        for (double const u : {3.0, 3.25, 3.5, 4.0}) {
            harmorph::Vec2 on_curve;
            curve_point(curve, u, 0, &on_curve);
            harmorph::Vec2 const beside{on_curve.x + 0.01, on_curve.y - 0.02};
            harmorph::Vec2 const offset = harmorph::offset_from(curve, u, beside);
            bool const inside = u > 3 && u < 4;
            CHECK(offset.x == doctest::Approx(inside ? 0.01 : 0));
            CHECK(offset.y == doctest::Approx(inside ? -0.02 : 0));
        }
    }
}
