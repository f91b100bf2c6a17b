// Sliding points back onto their curves, and the transpose.
#include <harmorph_design.h>
#include "fixtures/options.hpp"
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/operators.hpp>

using namespace fixtures;

namespace {

// A ring whose outer circle slides; its points are moved at random.
struct Slid {
    Case its = ring_case(5, 24, 0.5, 2);
    Attempt attempt;
    std::vector<double> x, y;

    Slid() {
        its.set_slip(far_field);
        Options const options = options_of(HM_CONFORMAL);
        REQUIRE(attempt.analyse(its.problem(), &options));
        x = its.mesh.x;
        y = its.mesh.y;
        std::vector<double> const by = some_move(static_cast<std::int32_t>(x.size()), 0.1, 4);
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += by[2 * k];
            y[k] += by[2 * k + 1];
        }
    }
    bool slides(std::size_t point) const {
        return std::abs(to_complex(its.mesh.point(static_cast<int>(point)))) > 1.99;
    }
};

}  // namespace

TEST_CASE(
    "hm_slip: sliding points are on the circle, inner ones follow, the wall keeps its bits, twice "
    "is once") {
    Slid of;
    std::vector<double> x(of.x.size()), y(of.x.size());
    REQUIRE(hm_slip(of.attempt.analysis, points_in(of.x, of.y), points_out(x, y), nullptr) ==
            HM_OK);
    double inner_moves = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (of.slides(k)) {
            CHECK(std::fabs(std::hypot(x[k], y[k]) - 2) < 2e-7);
            // Straight beside the point: the distance is that from the circle.
            CHECK(std::fabs(std::hypot(x[k] - of.x[k], y[k] - of.y[k]) -
                            std::fabs(std::hypot(of.x[k], of.y[k]) - 2)) < 1e-6);
        } else {
            double const radius = std::abs(to_complex(of.its.mesh.point(static_cast<int>(k))));
            bool const on_wall = radius < 0.5001;
            if (on_wall) CHECK(x[k] == of.x[k]);
            if (on_wall) CHECK(y[k] == of.y[k]);
            double const by = std::hypot(x[k] - of.x[k], y[k] - of.y[k]), r = (2 - radius) / 1.5;
            // 0.15: more than the largest distance.
            CHECK(by <= 1e-15 + 1.05 * 0.15 * (1 - r) * (1 - r) * (1 + 2 * r));
            inner_moves = std::fmax(inner_moves, by);
        }
    }
    CHECK(inner_moves > 0.02);
    std::vector<double> in_place_x = of.x, in_place_y = of.y;
    REQUIRE(hm_slip(of.attempt.analysis, points_in(in_place_x, in_place_y),
                    points_out(in_place_x, in_place_y), nullptr) == HM_OK);
    CHECK(same_bits(in_place_x, x));
    CHECK(same_bits(in_place_y, y));
    REQUIRE(hm_slip(of.attempt.analysis, points_in(x, y), points_out(in_place_x, in_place_y),
                    nullptr) == HM_OK);
    CHECK(largest_difference(in_place_x, x) < 1e-15);
    CHECK(largest_difference(in_place_y, y) < 1e-15);
    // The start is on the curve bit by bit.
    std::vector<double> start_x = of.its.mesh.x, start_y = of.its.mesh.y;
    REQUIRE(hm_slip(of.attempt.analysis, points_in(start_x, start_y), points_out(start_x, start_y),
                    nullptr) == HM_OK);
    CHECK(same_bits(start_x, of.its.mesh.x));
    CHECK(same_bits(start_y, of.its.mesh.y));
}

TEST_CASE("hm_slip_adjoint is the transpose of the derivative") {
    Slid of;
    std::size_t const n = of.x.size();
    std::vector<double> const weight = some_move(static_cast<std::int32_t>(n), 1, 7);
    std::vector<double> jx(n), jy(n), gx(n), gy(n);
    for (std::size_t k = 0; k < n; ++k) {
        jx[k] = weight[2 * k];
        jy[k] = weight[2 * k + 1];
    }
    REQUIRE(hm_slip_adjoint(of.attempt.analysis, points_in(of.x, of.y), points_in(jx, jy),
                            points_out(gx, gy), nullptr) == HM_OK);
    auto const objective = [&](std::vector<double> x, std::vector<double> y) {
        REQUIRE(hm_slip(of.attempt.analysis, points_in(x, y), points_out(x, y), nullptr) == HM_OK);
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k) sum += jx[k] * x[k] + jy[k] * y[k];
        return sum;
    };
    double const h = 1e-5;
    for (std::size_t k = 0; k < n; k += of.slides(k) ? 1 : 17) {
        std::vector<double> more = of.x, less = of.x;
        more[k] += h;
        less[k] -= h;
        CHECK(std::fabs((objective(more, of.y) - objective(less, of.y)) / (2 * h) - gx[k]) < 1e-5);
        more = less = of.y;
        more[k] += h;
        less[k] -= h;
        CHECK(std::fabs((objective(of.x, more) - objective(of.x, less)) / (2 * h) - gy[k]) < 1e-5);
    }
    REQUIRE(hm_slip_adjoint(of.attempt.analysis, points_in(of.x, of.y), points_in(jx, jy),
                            points_out(jx, jy), nullptr) == HM_OK);
    CHECK(same_bits(jx, gx));
    CHECK(same_bits(jy, gy));
}

TEST_CASE("hm_slip: what is not finite is refused by its number, NULL is refused, outputs stay") {
    Slid of;
    std::vector<double> x(of.x.size(), 7), y(of.x.size(), 7);
    of.x.back() = std::numeric_limits<double>::quiet_NaN();
    hm_error error{};
    CHECK(hm_slip(of.attempt.analysis, points_in(of.x, of.y), points_out(x, y), &error) ==
          HM_BAD_MESH);
    CHECK(error.item == static_cast<std::int32_t>(of.x.size()) - 1);
    CHECK(std::string(error.text).find("which slips along a curve, has a coordinate") !=
          std::string::npos);
    CHECK(x[0] == 7);
    CHECK(hm_slip_adjoint(of.attempt.analysis, points_in(of.x, of.y), points_in(x, y),
                          points_out(x, y), &error) == HM_BAD_MESH);
    CHECK(hm_slip(nullptr, points_in(of.x, of.y), points_out(x, y), nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_slip(of.attempt.analysis, nullptr, points_out(x, y), nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_slip(of.attempt.analysis, points_in(of.x, of.y), nullptr, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_slip_adjoint(of.attempt.analysis, points_in(of.x, of.y), nullptr, points_out(x, y),
                          nullptr) == HM_BAD_ARGUMENT);
    of.x.back() = 2;
    of.x.front() = std::numeric_limits<double>::quiet_NaN();  // a wall's: of no concern
    CHECK(hm_slip(of.attempt.analysis, points_in(of.x, of.y), points_out(x, y), nullptr) == HM_OK);
}
