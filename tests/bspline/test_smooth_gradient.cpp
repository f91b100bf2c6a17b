#include <doctest/doctest.h>
#include <harmorph_design.h>

#include <fixtures/curves.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/memory.hpp>

#include <algorithm>
#include <string>

using fixtures::CurveSet;
using fixtures::Spline;

namespace {

hm_status smooth(CurveSet& set, double length, std::vector<double> const& gradient,
                 std::vector<double>& out, hm_error* error = nullptr) {
    fixtures::Guarded work = fixtures::block_of(fixtures::smooth_gradient_size, &set.view());
    return hm_smooth_gradient(&set.view(), length, gradient.data(), out.data(),
                              fixtures::Memory(work.data(), work.size()), error);
}
std::vector<double> smoothed(CurveSet& set, double length, std::vector<double> const& gradient) {
    std::vector<double> out(gradient.size(), 7);
    hm_error error{};
    CHECK_MESSAGE(smooth(set, length, gradient, out, &error) == HM_OK, error.text);
    return out;
}

std::vector<double> random_gradient(CurveSet const& set, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> out(set.control.size());
    for (double& g : out) g = uniform(random);
    return out;
}

double dot(std::vector<double> const& a, std::vector<double> const& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// D and K of the header by the midpoint rule on a fine grid.
struct Dense {
    std::vector<double> mass;
    std::vector<std::vector<double>> stiffness;

    explicit Dense(CurveSet const& set) {
        auto const n = std::size_t(set.n_control());
        mass.assign(n, 0);
        stiffness.assign(n, std::vector<double>(n, 0));
        for (CurveSet::Shape const& shape : set.shapes) {
            Spline const spline{shape.degree, shape.knots, set.control, {}, shape.indices};
            harmorph::Curve const curve = spline.curve();
            int const steps = 200000;
            double const width = (curve.end() - curve.begin()) / steps;
            for (int k = 0; k < steps; ++k) {
                double const u = curve.begin() + (k + 0.5) * width;
                harmorph::Vec2 c[2];
                harmorph::curve_point(curve, u, 1, c);
                auto const basis = harmorph::curve_basis(curve, u, 1);
                double const speed = length(c[1]);
                for (int a = 0; a < basis.order; ++a) {
                    auto const i = std::size_t(basis.control[a]);
                    mass[i] += width * speed * basis.value[0][a];
                    for (int b = 0; b < basis.order; ++b)
                        stiffness[i][std::size_t(basis.control[b])] +=
                            width / speed * basis.value[1][a] * basis.value[1][b];
                }
            }
        }
    }
    // (I + L^2 D^-1/2 K D^-1/2) s
    std::vector<double> apply(double length, std::vector<double> const& s) const {
        std::vector<double> out = s;
        for (std::size_t i = 0; i < mass.size(); ++i)
            for (std::size_t j = 0; j < mass.size(); ++j)
                for (std::size_t c = 0; c < 2; ++c)
                    out[2 * i + c] += length * length * stiffness[i][j] /
                                      std::sqrt(mass[i] * mass[j]) * s[2 * j + c];
        return out;
    }
};

CurveSet round_body(fixtures::periodic(3, 14, 0.4, 2));

}  // namespace

TEST_CASE("the smooth gradient solves the equation that the header states") {
    Dense const dense(round_body);
    std::vector<double> const g = random_gradient(round_body, 1);
    for (double const length : {0.01, 0.3, 5.0}) {
        std::vector<double> const back = dense.apply(length, smoothed(round_body, length, g));
        for (std::size_t i = 0; i < g.size(); ++i) CHECK(std::fabs(back[i] - g[i]) < 1e-7);
    }
    // K annihilates constants: this gradient is as smooth as can be.
    std::vector<double> constant(g.size());
    for (std::size_t i = 0; i < g.size(); ++i) constant[i] = std::sqrt(dense.mass[i / 2]);
    std::vector<double> const same = smoothed(round_body, 1, constant);
    for (std::size_t i = 0; i < g.size(); ++i) CHECK(std::fabs(same[i] - constant[i]) < 1e-8);
}

TEST_CASE("smoothing is symmetric and positive, and longer lengths damp waves more") {
    std::vector<double> const a = random_gradient(round_body, 3),
                              b = random_gradient(round_body, 4);
    std::vector<double> const smooth = smoothed(round_body, 0.5, a);
    CHECK(dot(smooth, a) > 0);
    CHECK(std::fabs(dot(smooth, b) - dot(a, smoothed(round_body, 0.5, b))) < 1e-13);
    CHECK(smoothed(round_body, 0, a) == a);
    std::vector<double> wave(a.size());
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = i / 2 % 2 == 0 ? 1 : -1;
    double last = dot(wave, wave);
    for (double const length : {0.1, 0.3, 1.0}) {
        std::vector<double> const damped = smoothed(round_body, length, wave);
        CHECK(dot(damped, damped) < last);
        last = dot(damped, damped);
    }
    CHECK(last < 0.05 * dot(wave, wave));
}

TEST_CASE("units of length and gradient and the direction of the curve do not matter") {
    std::vector<double> const g = random_gradient(round_body, 5);
    std::vector<double> const first = smoothed(round_body, 0.4, g);
    Spline large = fixtures::periodic(3, 14, 0.4, 2);
    for (double& c : large.control) c *= 1024;
    std::vector<double> huge = g;
    for (double& x : huge) x *= 1e250;
    CurveSet large_body(large);
    std::vector<double> const scaled = smoothed(large_body, 0.4 * 1024, huge);
    for (std::size_t i = 0; i < g.size(); ++i)
        CHECK(std::fabs(scaled[i] / 1e250 - first[i]) < 1e-13);

    CurveSet there(fixtures::clamped(3, 9, 6)), back = reversed(there);
    std::vector<double> const h = random_gradient(there, 7);
    std::vector<double> const s = smoothed(there, 2, h), t = smoothed(back, 2, h);
    for (std::size_t i = 0; i < h.size(); ++i) CHECK(std::fabs(s[i] - t[i]) < 1e-12);
}

TEST_CASE("curves without common control points are independent; unused points stay") {
    CurveSet one(fixtures::clamped(2, 6, 8)), both = one;
    both.add(fixtures::clamped(3, 7, 9));
    both.control.resize(both.control.size() + 4, 0.5);
    std::vector<double> g = random_gradient(both, 10);
    std::vector<double> const s = smoothed(both, 1.5, g);
    std::vector<double> const first(g.begin(), g.begin() + 12);
    std::vector<double> const alone = smoothed(one, 1.5, first);
    for (std::size_t i = 0; i < 12; ++i) CHECK(std::fabs(alone[i] - s[i]) < 1e-13);
    for (std::size_t i = g.size() - 4; i < g.size(); ++i) CHECK(std::fabs(s[i] - g[i]) < 1e-15);
}

TEST_CASE("refused calls name the argument and leave the result unchanged") {
    std::vector<double> g = random_gradient(round_body, 11), out(g.size(), 7);
    hm_error error{};
    auto const refused = [&](double length, char const* words) {
        CHECK(smooth(round_body, length, g, out, &error) == HM_BAD_ARGUMENT);
        CHECK_MESSAGE(std::string(error.text).find(words) != std::string::npos, error.text);
        CHECK(std::count(out.begin(), out.end(), 7) == static_cast<long>(out.size()));
    };
    refused(-1, "between 0 and 1e6 times");
    refused(std::nan(""), "between 0 and 1e6 times");
    refused(1e9, "between 0 and 1e6 times");
    g[9] = std::nan("");
    refused(1, "derivative by control point 4 is not finite");
    CHECK(error.item_kind == HM_ITEM_CONTROL_POINT);
}
