// The conformal operator on an annulus, where the exact solution is known.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/operators.hpp>

using namespace fixtures;

namespace {

// Exact on an annulus with k = (r - r0)^-q: for the boundary values e^(i n angle) on r0 and 0 on r1
// the minimum of the integral of k |f_x + i f_y|^2 is f = g(r) e^(i n angle) with k (g' - n g / r)
// = c r^(-n - 1), and so
//     g = (r / r0)^n (1 - I(r) / I(r1)),  I(r) = integral from r0 to r of s^(-2 n - 1) (s - r0)^q
//     ds.
class ExactRing {
public:
    ExactRing(double r0, double r1, double q, int degree, int n_functions, int function)
        : r0_(r0), r1_(r1), q_(q) {
        Spline const spline = ring(degree, n_functions, 1, 1);
        constexpr int samples = 1024;
        std::vector<double> value(samples, 0.0);
        for (int k = 0; k < samples; ++k) {
            double const u = ring_parameter(degree, n_functions, 2 * pi * k / samples);
            harmorph::CurveBasis const basis = curve_basis(spline.curve(), u, 0);
            double& sum = value[std::size_t(k)];
            for (int j = 0; j <= degree; ++j)
                sum += basis.control[j] == function ? basis.value[0][j] : 0;
        }
        for (int n = -modes; n <= modes; ++n) {
            Complex sum = 0;
            for (int k = 0; k < samples; ++k)
                sum += value[std::size_t(k)] *
                       std::polar(1.0, -2 * pi * ((n * k) % samples) / samples);
            coefficient_.push_back(sum / (1.0 * samples));
        }
    }
    // All of an evenly divided ring's n_t points of radius r.
    Field at(double r, int n_t) const {
        std::vector<double> g;
        for (int n = -modes; n <= modes; ++n) {
            double const all = integral(r0_, r1_, n);
            g.push_back(r == r0_ ? 1 : std::pow(r / r0_, n) * (integral(r, r1_, n) / all));
        }
        Field out;
        for (int k = 0; k < n_t; ++k) {
            Complex sum = 0;
            for (int n = -modes; n <= modes; ++n) {
                std::size_t const mode = std::size_t(n + modes);
                sum += coefficient_[mode] * g[mode] * std::polar(1.0, 2 * pi * n * k / n_t);
            }
            out.push_back(sum);
        }
        return out;
    }

private:
    static constexpr int modes = 40;  // coefficients fall like n^-4

    // Simpson's rule in t with s = r0 + t^2, which makes (s - r0)^q smooth enough.
    double integral(double from, double to, int n) const {
        constexpr int steps = 100;
        double const a = std::sqrt(std::fmax(from - r0_, 0.0)), b = std::sqrt(to - r0_),
                     h = (b - a) / steps;
        double sum = 0;
        for (int k = 0; k <= steps; ++k) {
            double const t = a + k * h, weight = k == 0 || k == steps ? 1 : (k % 2 == 1 ? 4 : 2);
            double const s = r0_ + t * t;
            sum += weight * std::pow(s / r0_, -2 * n - 1) * std::pow(t, 2 * q_) * 2 * t;
        }
        return sum * h / 3;
    }
    double r0_, r1_, q_;
    Field coefficient_;
};

double rms_error(int refine, Cells kind, double exponent) {
    int const n_r = 6 * refine, n_t = 32 * refine;
    double const r0 = 0.5, r1 = 2;
    Case setup = ring_case(n_r, n_t, r0, r1, kind);
    Options const options = options_of(HM_CONFORMAL, exponent);
    Solved const solved(setup, &options);
    Field const found = complex_values(solved, 2);
    ExactRing const exact(r0, r1, std::max(exponent, 0.0), 3, 8, 2);
    double sum = 0;
    for (int i = 0; i <= n_r; ++i) {
        Field const ring = exact.at(r0 * std::pow(r1 / r0, 1.0 * i / n_r), n_t);
        for (int k = 0; k < n_t; ++k)
            sum += std::norm(found[std::size_t(i * n_t + k)] - ring[std::size_t(k)]);
    }
    return std::sqrt(sum / double(found.size()));
}

}  // namespace

TEST_CASE("functions on an annulus have second order for k = d^-q and quads at the wall") {
    auto const order = [](Cells kind, double exponent) {
        double const coarse = rms_error(2, kind, exponent), fine = rms_error(4, kind, exponent);
        CHECK(fine < 1.5e-3);
        return std::log2(coarse / fine);
    };
    for (Cells const kind : {Cells::quads, Cells::hybrid})
        for (double const exponent : {-1.0, 1.5, 2.0}) CHECK(order(kind, exponent) > 1.85);
    CHECK(order(Cells::quads, 0.75) >
          1.65);  // its second derivatives are unbounded: f = d^(1 + q) beside smooth terms
    // In triangles barycentres lie at one or two thirds of a layer, as the chance of equal
    // diagonals has it, and k jumps.
    CHECK(order(Cells::triangles, -1) > 1.85);
    CHECK(order(Cells::triangles, 1.5) > 1.3);
}
