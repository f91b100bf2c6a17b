#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <algorithm>

#include <fixtures/curves.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/memory.hpp>

#include <cmath>
#include <random>

using fixtures::CurveSet;

namespace {

struct Modes {
    hm_status status;
    std::vector<double> modes, singular;
};

Modes modes_of(CurveSet& set, std::vector<double> const& movements, int n) {
    Modes out{HM_OK, movements, std::vector<double>(std::size_t(n), -7)};
    std::size_t bytes = 0;
    REQUIRE(fixtures::family_modes_size(&set.view(), std::max(n, 1), &bytes, nullptr) == HM_OK);
    fixtures::Guarded work(bytes);
    out.status = fixtures::family_modes(&set.view(), n, out.modes.data(), out.singular.data(),
                                        fixtures::Memory(work.data(), bytes), nullptr);
    CHECK(work.guards_intact());
    return out;
}

// The integral of each basis function by the arc length, by Simpson's rule on many intervals.
std::vector<double> weights(CurveSet& set) {
    std::vector<double> out(std::size_t(set.n_control()));
    double total = 0;
    int const n = 24000, spans = set.n_control();
    for (int k = 0; k <= n; ++k) {
        double const u = double(spans) * k / n;
        std::int32_t control[4];
        double value[4], at[4];
        REQUIRE(hm_curve_basis(&set.view(), 0, u, 0, control, value, nullptr) == HM_OK);
        REQUIRE(hm_curve_point(&set.view(), 0, u, 1, at, nullptr) == HM_OK);
        double const w = (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2) * std::hypot(at[2], at[3]);
        for (int i = 0; i < 4; ++i) {
            out[std::size_t(control[i])] += w * value[i];
            total += w * value[i];
        }
    }
    for (double& w : out) w /= total;
    return out;
}

}  // namespace

TEST_CASE("modes are orthonormal, and their sums give back all movements") {
    CurveSet set(fixtures::ring(3, 14, 2, 1));
    std::vector<double> const weight = weights(set);
    auto const dot = [&](const double* a, const double* b) {
        double sum = 0;
        for (std::size_t i = 0; i < weight.size(); ++i)
            sum += weight[i] * (a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1]);
        return sum;
    };
    int const n = 6, rank = 4;
    std::size_t const length = 28;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<double> movements(n * length);
    for (std::size_t k = 0; k < rank * length; ++k) movements[k] = any(random);
    for (std::size_t k = 0; k < length; ++k) {  // two combinations of the others
        movements[4 * length + k] = movements[k] - 2 * movements[length + k];
        movements[5 * length + k] = movements[2 * length + k] + movements[3 * length + k];
    }
    Modes const out = modes_of(set, movements, n);
    REQUIRE(out.status == HM_OK);
    double squares = 0, captured = 0;
    for (int k = 0; k < n; ++k) {
        const double* const mode = &out.modes[std::size_t(k) * length];
        auto const s = std::size_t(k);
        squares += dot(&movements[s * length], &movements[s * length]);
        captured += out.singular[s] * out.singular[s];
        if (k > 0) CHECK(out.singular[s] <= out.singular[s - 1]);
        for (int j = 0; j <= k && k < rank; ++j) {
            double const found = dot(mode, &out.modes[std::size_t(j) * length]);
            CHECK(found == doctest::Approx(j == k ? 1 : 0).epsilon(1e-10).scale(1));
        }
        for (std::size_t i = 0; k >= rank && i < length; ++i) CHECK(mode[i] == 0);
    }
    CHECK(captured == doctest::Approx(squares).epsilon(1e-10));
    for (std::size_t k = 0; k < std::size_t(n); ++k) {
        std::vector<double> rest(movements.begin() + static_cast<std::ptrdiff_t>(k * length),
                                 movements.begin() + static_cast<std::ptrdiff_t>((k + 1) * length));
        for (std::size_t j = 0; j < rank; ++j) {
            double const amplitude = dot(&movements[k * length], &out.modes[j * length]);
            for (std::size_t i = 0; i < length; ++i)
                rest[i] -= amplitude * out.modes[j * length + i];
        }
        CHECK(std::sqrt(dot(rest.data(), rest.data())) < 1e-9);
    }
}

TEST_CASE("modes of rational curves of any degree are orthonormal to rounding") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int const degree : {1, 2, 3, 5}) {
        for (double const uneven : {0.3, 0.9}) {
            int const n_control = 9;
            fixtures::Spline spline = fixtures::clamped(degree, n_control, unsigned(degree));
            for (int k = 0; k < n_control; ++k) spline.weights.push_back(1 + uneven * any(random));
            CurveSet set(spline);
            // Gauss' rule with 3 points on many intervals: the error falls with their length^6.
            std::vector<double> weight(std::size_t(n_control), 0.0);
            double total = 0;
            int const intervals = 3000;
            for (int span = 0; span < n_control - degree; ++span) {
                double const low = spline.knots[std::size_t(degree + span)],
                             high = spline.knots[std::size_t(degree + span + 1)],
                             half = 0.5 * (high - low) / intervals;
                for (int k = 0; k < 3 * intervals; ++k) {
                    double const node = k % 3 == 0   ? -std::sqrt(0.6)
                                        : k % 3 == 1 ? 0
                                                     : std::sqrt(0.6);
                    double const u = low + half * (2 * (k / 3) + 1 + node);
                    std::int32_t control[6];
                    double value[6], at[4];
                    REQUIRE(hm_curve_basis(&set.view(), 0, u, 0, control, value, nullptr) == HM_OK);
                    REQUIRE(hm_curve_point(&set.view(), 0, u, 1, at, nullptr) == HM_OK);
                    double const w = half * (k % 3 == 1 ? 8. : 5.) / 9 * std::hypot(at[2], at[3]);
                    for (int i = 0; i <= degree; ++i)
                        weight[std::size_t(control[i])] += w * value[i];
                    total += w;
                }
            }
            std::size_t const length = 2 * std::size_t(n_control);
            std::vector<double> movements(4 * length);
            for (double& number : movements) number = any(random);
            Modes const out = modes_of(set, movements, 4);
            REQUIRE(out.status == HM_OK);
            for (std::size_t a = 0; a < 4; ++a) {
                for (std::size_t b = 0; b <= a; ++b) {
                    double product = 0;
                    for (std::size_t i = 0; i < length; ++i)
                        product += weight[i / 2] / total * out.modes[a * length + i] *
                                   out.modes[b * length + i];
                    CHECK(std::fabs(product - (a == b ? 1 : 0)) < 1e-12);
                }
            }
        }
    }
}

TEST_CASE("one movement is its own mode, and movements that cannot be used are refused") {
    CurveSet set(fixtures::ring(3, 14, 2, 1));
    std::vector<double> shift(28);
    for (std::size_t i = 0; i < 28; i += 2) shift[i] = -0.25;
    Modes const one = modes_of(set, shift, 1);
    REQUIRE(one.status == HM_OK);
    CHECK(one.singular[0] == doctest::Approx(0.25).epsilon(1e-14));
    for (std::size_t i = 0; i < 28; ++i)
        CHECK(one.modes[i] == doctest::Approx(i % 2 == 0 ? 1 : 0).epsilon(1e-14));
    CHECK(modes_of(set, std::vector<double>(28), 1).status == HM_BAD_ARGUMENT);
    shift[3] = std::nan("");
    Modes const refused = modes_of(set, shift, 1);
    CHECK(refused.status == HM_BAD_ARGUMENT);
    CHECK(refused.singular[0] == -7);
    CHECK(refused.modes[0] == -0.25);
}
