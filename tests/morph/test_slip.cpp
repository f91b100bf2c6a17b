// Sliding points back onto their curves, and the transpose.
#include <harmorph_design.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/operators.hpp>

using namespace fixtures;

namespace {

// A ring whose outer circle slides; its points are moved at random.
struct Slid {
    Case setup = ring_case(5, 24, 0.5, 2);
    Attempt attempt;
    std::vector<double> x, y;

    Slid() {
        setup.set_slip(far_field);
        Options const options = options_of(HM_CONFORMAL);
        REQUIRE(attempt.analyse(setup.problem(), &options));
        x = setup.mesh.x;
        y = setup.mesh.y;
        std::vector<double> const by = some_move(std::int32_t(x.size()), 0.1, 4);
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += by[2 * k];
            y[k] += by[2 * k + 1];
        }
    }
    bool slides(std::size_t point) const {
        return std::abs(to_complex(setup.mesh.point(int(point)))) > 1.99;
    }
};

}  // namespace

TEST_CASE("hm_slip puts sliding points on the circle, and a second call changes nothing") {
    Slid moved;
    std::vector<double> x(moved.x.size()), y(moved.x.size());
    REQUIRE(hm_slip(moved.attempt.analysis, points_in(moved.x, moved.y), points_out(x, y),
                    nullptr) == HM_OK);
    double inner_moves = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (moved.slides(k)) {
            CHECK(std::fabs(std::hypot(x[k], y[k]) - 2) < 2e-7);
            // Straight beside the point: the distance is that from the circle.
            CHECK(std::fabs(std::hypot(x[k] - moved.x[k], y[k] - moved.y[k]) -
                            std::fabs(std::hypot(moved.x[k], moved.y[k]) - 2)) < 1e-6);
        } else {
            double const radius = std::abs(to_complex(moved.setup.mesh.point(int(k))));
            bool const on_wall = radius < 0.5001;
            if (on_wall) CHECK(x[k] == moved.x[k]);
            if (on_wall) CHECK(y[k] == moved.y[k]);
            double const by = std::hypot(x[k] - moved.x[k], y[k] - moved.y[k]),
                         r = (2 - radius) / 1.5;
            // 0.15: more than the largest distance.
            CHECK(by <= 1e-15 + 1.05 * 0.15 * (1 - r) * (1 - r) * (1 + 2 * r));
            inner_moves = std::fmax(inner_moves, by);
        }
    }
    CHECK(inner_moves > 0.02);
    std::vector<double> in_place_x = moved.x, in_place_y = moved.y;
    REQUIRE(hm_slip(moved.attempt.analysis, points_in(in_place_x, in_place_y),
                    points_out(in_place_x, in_place_y), nullptr) == HM_OK);
    CHECK(same_bits(in_place_x, x));
    CHECK(same_bits(in_place_y, y));
    REQUIRE(hm_slip(moved.attempt.analysis, points_in(x, y), points_out(in_place_x, in_place_y),
                    nullptr) == HM_OK);
    CHECK(largest_difference(in_place_x, x) < 1e-15);
    CHECK(largest_difference(in_place_y, y) < 1e-15);
    // The start is on the curve bit by bit.
    std::vector<double> start_x = moved.setup.mesh.x, start_y = moved.setup.mesh.y;
    REQUIRE(hm_slip(moved.attempt.analysis, points_in(start_x, start_y),
                    points_out(start_x, start_y), nullptr) == HM_OK);
    CHECK(same_bits(start_x, moved.setup.mesh.x));
    CHECK(same_bits(start_y, moved.setup.mesh.y));
}

TEST_CASE("hm_slip_derivative agrees with differences, and hm_slip_adjoint is its transpose") {
    Slid moved;
    std::size_t const n = moved.x.size();
    std::vector<double> const some = some_move(std::int32_t(n), 1, 3),
                              weight = some_move(std::int32_t(n), 1, 7);
    std::vector<double> dx(n), dy(n), jx(n), jy(n), tx(n), ty(n), gx(n), gy(n);
    for (std::size_t k = 0; k < n; ++k) {
        dx[k] = some[2 * k], dy[k] = some[2 * k + 1];
        jx[k] = weight[2 * k], jy[k] = weight[2 * k + 1];
    }
    REQUIRE(hm_slip_derivative(moved.attempt.analysis, points_in(moved.x, moved.y),
                               points_in(dx, dy), points_out(tx, ty), nullptr) == HM_OK);
    REQUIRE(hm_slip_adjoint(moved.attempt.analysis, points_in(moved.x, moved.y), points_in(jx, jy),
                            points_out(gx, gy), nullptr) == HM_OK);
    double after = 0, before = 0, size = 0;
    for (std::size_t k = 0; k < n; ++k) {
        after += jx[k] * tx[k] + jy[k] * ty[k];
        before += gx[k] * dx[k] + gy[k] * dy[k];
        size += std::fabs(jx[k] * tx[k]) + std::fabs(jy[k] * ty[k]);
    }
    CHECK(std::fabs(after - before) <= 1e-14 * size);
    auto const worst = [&](double h) {
        auto const slid = [&](double step) {
            std::vector<double> x = moved.x, y = moved.y;
            for (std::size_t k = 0; k < n; ++k) x[k] += step * dx[k], y[k] += step * dy[k];
            REQUIRE(hm_slip(moved.attempt.analysis, points_in(x, y), points_out(x, y), nullptr) ==
                    HM_OK);
            x.insert(x.end(), y.begin(), y.end());
            return x;
        };
        std::vector<double> const more = slid(h), less = slid(-h);
        double largest = 0;
        for (std::size_t k = 0; k < n; ++k) {
            largest = std::max({largest, std::fabs((more[k] - less[k]) / (2 * h) - tx[k]),
                                std::fabs((more[n + k] - less[n + k]) / (2 * h) - ty[k])});
        }
        return largest;
    };
    CHECK(worst(1e-4) < 1e-5);
    REQUIRE(hm_slip_derivative(moved.attempt.analysis, points_in(moved.x, moved.y),
                               points_in(dx, dy), points_out(dx, dy), nullptr) == HM_OK);
    CHECK(same_bits(dx, tx));
    CHECK(same_bits(dy, ty));
    REQUIRE(hm_slip_adjoint(moved.attempt.analysis, points_in(moved.x, moved.y), points_in(jx, jy),
                            points_out(jx, jy), nullptr) == HM_OK);
    CHECK(same_bits(jx, gx));
    CHECK(same_bits(jy, gy));
}

TEST_CASE("a point of a slip line that is not finite is refused by name, and the outputs stay") {
    Slid moved;
    std::vector<double> x(moved.x.size(), 7), y(moved.x.size(), 7);
    moved.x.back() = std::numeric_limits<double>::quiet_NaN();
    hm_error error{};
    CHECK(hm_slip(moved.attempt.analysis, points_in(moved.x, moved.y), points_out(x, y), &error) ==
          HM_BAD_MESH);
    CHECK(error.item == std::int32_t(moved.x.size()) - 1);
    CHECK(says(error, "which slips along a curve, has a coordinate"));
    CHECK(x[0] == 7);
    CHECK(hm_slip_adjoint(moved.attempt.analysis, points_in(moved.x, moved.y), points_in(x, y),
                          points_out(x, y), &error) == HM_BAD_MESH);
    moved.x.back() = 2;
    moved.x.front() = std::numeric_limits<double>::quiet_NaN();  // a wall's: of no concern
    CHECK(hm_slip(moved.attempt.analysis, points_in(moved.x, moved.y), points_out(x, y), nullptr) ==
          HM_OK);
}
