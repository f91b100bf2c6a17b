// Large movements in meshes whose outer boundary slips along a curve.
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

Case slipping_ring(Cells kind = Cells::hybrid) {
    Case setup = ring_case(8, 32, 0.5, 2, kind);
    setup.set_slip(far_field);
    for (double& number : setup.curves.control)
        number *= 0.5 / 0.445;  // so that the curve is where the points are
    return setup;
}

double farthest_from_circle(Safe const& safe) {
    double off = 0;
    for (std::int32_t const point : points_on(safe.mesh, far_field)) {
        auto const k = std::size_t(point);
        off = std::fmax(off, std::fabs(std::hypot(safe.x[k], safe.y[k]) - 2));
    }
    return off;
}

}  // namespace

TEST_CASE("the body turns, and the mesh turns with it, the outer points along their circle") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = slipping_ring(kind);
        Safe safe(setup);
        safe.safe_options.skipped_strategies =
            without({HM_STRATEGY_OTHER, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
        safe.safe_options.min_quality = 0.95;  // one step leads there, too, but worse
        std::vector<double> const move =
            similarity_move(setup.curves, std::polar(1.0, 100 * pi / 180), 0, 0);
        REQUIRE(safe.run(move) >= HM_OK);
        CHECK(safe.report.strategy == HM_STRATEGY_SUBSTEPS);
        CHECK(safe.is_valid());
        CHECK(std::fabs(safe.boundary_error(move) - safe.report.rotated_offset) < 1e-13);
        CHECK(farthest_from_circle(safe) < 2e-8);
        CHECK(safe.report.min_quality > 0.75 * safe.report.start_quality);
        double turned = 0;  // the mean angle by which outer points have gone round
        for (std::int32_t const point : points_on(setup.mesh, far_field)) {
            auto const k = std::size_t(point);
            turned +=
                std::arg(Complex(safe.x[k], safe.y[k]) / to_complex(setup.mesh.point(point))) / 32;
        }
        CHECK(turned > 80 * pi / 180);
        CHECK(turned < 101 * pi / 180);
    }
}

TEST_CASE("in one step, in several, untangled or improved, outer points are on the circle") {
    for (unsigned const seed : {1u, 2u, 3u}) {
        Case setup = slipping_ring();
        Safe safe(setup);
        for (double const size : {0.05, 0.3, 0.5}) {
            for (std::int32_t const skipped :
                 {0, without({HM_STRATEGY_LINEAR}),
                  without({HM_STRATEGY_LINEAR, HM_STRATEGY_SUBSTEPS})}) {
                safe.safe_options.skipped_strategies = skipped;
                safe.safe_options.min_quality = 0;
                std::vector<double> const move = some_move(8, size, seed);
                if (safe.run(move) < 0) continue;  // the wall of this seed crosses itself
                CHECK(safe.is_valid());
                CHECK(farthest_from_circle(safe) < 2e-8);
            }
        }
    }
}

TEST_CASE("the derivative at slipping points agrees with differences to first order") {
    for (std::int32_t const skipped : {0, without({HM_STRATEGY_LINEAR})}) {
        Case setup = slipping_ring();
        Safe safe(setup);
        safe.safe_options.skipped_strategies = skipped;
        safe.safe_options.max_resolves = -1;  // one step: the functions are those of the start
        Attempt const derivative = prepared(setup.problem(), options_of(HM_CONFORMAL));
        std::vector<double> const move = some_move(8, 0.1, 5), by = some_move(8, 1, 6);
        REQUIRE(safe.run(move, derivative.basis) == HM_OK);
        std::vector<double> const x = safe.x, y = safe.y;
        Field const change = displacement(derivative.basis, by);
        auto const moved_by = [&](double h) {
            std::vector<double> there = move;
            for (std::size_t k = 0; k < there.size(); ++k) there[k] += h * by[k];
            REQUIRE(safe.run(there) == HM_OK);
            return safe.moved();
        };
        double const h = 1e-6;
        Field const more = moved_by(h), less = moved_by(-h);
        for (std::int32_t const point : points_on(setup.mesh, far_field)) {
            auto const k = std::size_t(point);
            Complex const difference = (more[k] - less[k]) / (2 * h);
            CHECK(std::abs(difference - change[k]) < 1e-8);
            CHECK(std::abs(change[k]) > 1e-3);
            CHECK(std::fabs((change[k] * std::conj(Complex(x[k], y[k]))).real()) <
                  1e-5 * std::abs(change[k]));
        }
    }
}
