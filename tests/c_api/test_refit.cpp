// Another airfoil on the knots of a curve, from the points of a section to the morphed mesh.
#include <doctest/doctest.h>
#include <harmorph_design.h>

#include <fixtures/airfoil.hpp>
#include <fixtures/bodies.hpp>
#include <fixtures/memory.hpp>

#include <string>

using namespace fixtures;

namespace {

struct Section {
    std::vector<double> x, y;
    explicit Section(Naca4 const& shape) {
        for (Point const& p : naca4(shape, 50).points) x.push_back(p.x), y.push_back(p.y);
    }
    std::int32_t count() const { return std::int32_t(x.size()); }
    hm_points view() const { return {x.data(), y.data(), 1}; }
};

// The curve of NACA 0012, and a movement to another section.
struct Airfoil {
    std::vector<unsigned char> block, work;
    hm_curves const* curves = nullptr;
    std::vector<double> movement;
    hm_refit_report report{};
    hm_error error{};
    Section const section{{0.02, 0.4, 0.12, false}};

    Airfoil() {
        Section const start({0, 0.4, 0.12, false});
        hm_points const points = start.view();
        std::size_t bytes = 0;
        REQUIRE(fixtures::fit_size(start.count(), nullptr, &bytes, nullptr) == HM_OK);
        block.resize(bytes);
        REQUIRE(hm_fit(&curves, fixtures::Memory(block.data(), bytes), &points, start.count(), 1,
                       nullptr, nullptr, nullptr) == HM_OK);
        movement.assign(std::size_t(2 * curves->n_control), 7);
        REQUIRE(fixtures::refit_size(curves, 0, section.count(), &bytes, &error) == HM_OK);
        work.resize(bytes);
        HM_INIT(report);
    }
    hm_status refit(Section const& to, std::int32_t curve = 0, std::size_t missing = 0) {
        hm_points const points = to.view();
        return hm_refit(curves, curve, &points, to.count(), 1, 0, movement.data(), &report,
                        fixtures::Memory(work.data(), work.size() - missing), &error);
    }
};

}  // namespace

TEST_CASE("the moved curve passes the points of the section as near as the report says") {
    Airfoil airfoil;
    REQUIRE(airfoil.refit(airfoil.section) == HM_OK);
    CHECK(airfoil.report.closed == HM_TIED);
    CHECK(airfoil.report.max_error < 2e-4);
    CHECK(airfoil.report.rms_error <= airfoil.report.max_error);
    hm_curves moved = *airfoil.curves;
    std::vector<double> control(moved.control, moved.control + 2 * moved.n_control);
    for (std::size_t i = 0; i < control.size(); ++i) control[i] += airfoil.movement[i];
    moved.control = control.data();
    double worst = 0;
    for (std::size_t k = 0; k < airfoil.section.x.size(); ++k) {
        double u = 0, distance = 0;
        REQUIRE(hm_curve_project(&moved, 0, airfoil.section.x[k], airfoil.section.y[k], &u,
                                 &distance, nullptr) == HM_OK);
        worst = std::max(worst, distance);
    }
    CHECK(std::fabs(worst - airfoil.report.max_error) < 1e-12);
}

TEST_CASE("points of the report of a fit and of a refit count from the index base of the call") {
    Airfoil airfoil;
    REQUIRE(airfoil.refit(airfoil.section) == HM_OK);
    hm_curves from_1 = *airfoil.curves;
    hm_curve curve = from_1.curve[0];
    std::vector<std::int32_t> indices;
    for (std::int32_t k = 0; k < curve.n_indices; ++k)
        indices.push_back((curve.indices == nullptr ? k : curve.indices[k]) + 1);
    curve.indices = indices.data();
    from_1.index_base = 1;
    from_1.curve = &curve;
    hm_refit_report report;
    HM_INIT(report);
    hm_points const points = airfoil.section.view();
    REQUIRE(hm_refit(&from_1, 0, &points, airfoil.section.count(), 1, 0, airfoil.movement.data(),
                     &report, fixtures::Memory(airfoil.work.data(), airfoil.work.size()),
                     &airfoil.error) == HM_OK);
    CHECK(report.max_error_point == airfoil.report.max_error_point + 1);

    hm_fit_report found[2];
    for (std::int32_t base = 0; base < 2; ++base) {
        hm_fit_options options;
        const hm_curves* curves = nullptr;
        HM_INIT(options);
        HM_INIT(found[base]);
        options.index_base = base;
        REQUIRE(hm_fit(&curves, fixtures::Memory(airfoil.block.data(), airfoil.block.size()),
                       &points, airfoil.section.count(), 1, &options, &found[base],
                       nullptr) == HM_OK);
        CHECK(curves->index_base == 0);
    }
    CHECK(found[1].max_error_point == found[0].max_error_point + 1);
    CHECK(found[1].first_point == found[0].first_point + 1);
    CHECK(found[1].departure_point == found[0].departure_point + 1);
    CHECK(found[1].backtrack_point == -1);
}

TEST_CASE("refused calls name the argument and leave the movement as it was") {
    Airfoil airfoil;
    auto const untouched = [&] {
        for (double const m : airfoil.movement) CHECK(m == 7);
    };
    CHECK(airfoil.refit(airfoil.section, 1) == HM_BAD_ARGUMENT);
    CHECK(says(airfoil.error, "curve 1 does not exist"));
    CHECK(airfoil.error.item_kind == HM_ITEM_CURVE);
    untouched();
    CHECK(airfoil.refit(airfoil.section, 0, 1) == HM_BLOCK_TOO_SMALL);
    untouched();
    Section bad = airfoil.section;
    bad.y[17] = std::nan("");
    CHECK(airfoil.refit(bad) == HM_BAD_CURVE);
    CHECK(airfoil.error.item_kind == HM_ITEM_POINT);
    CHECK(airfoil.error.item == 17);
    untouched();
    std::size_t bytes = 5;
    CHECK(fixtures::refit_size(airfoil.curves, 0, 2, &bytes, &airfoil.error) == HM_BAD_ARGUMENT);
    CHECK(says(airfoil.error, "between 3 and 2^24"));
    CHECK(bytes == 5);
}
