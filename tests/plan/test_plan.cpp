// The functions are the solutions of Laplace's equation that they claim to be.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>

#include <complex>

using namespace fixtures;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// A function of the angle by its Fourier coefficients, found with the trapezoidal rule.
class Series {
public:
    template <class Function>
    explicit Series(Function value) {
        constexpr int n = 2048;
        std::vector<double> sample;
        for (int k = 0; k < n; ++k) sample.push_back(value(2 * pi * k / n));
        for (int m = 0; m <= modes; ++m) {
            Complex sum = 0;
            for (int k = 0; k < n; ++k)
                sum += sample[std::size_t(k)] * std::polar(1.0, -2 * pi * ((m * k) % n) / n);
            coefficient_.push_back((m == 0 ? 1.0 : 2.0) / n * sum);
        }
    }
    // Harmonic, with these values at radius r0 and 0 at r1.
    double annulus(Complex z, double r0, double r1) const {
        double const r = std::abs(z), angle = std::arg(z);
        double sum = coefficient_[0].real() * std::log(r1 / r) / std::log(r1 / r0);
        for (int m = 1; m <= modes; ++m) {
            double const decay = std::pow(r0 / r, m) * (1 - std::pow(r / r1, 2 * m)) /
                                 (1 - std::pow(r0 / r1, 2 * m));
            sum += decay * (coefficient_[std::size_t(m)] * std::polar(1.0, m * angle)).real();
        }
        return sum;
    }

private:
    static constexpr int modes = 120;
    std::vector<Complex> coefficient_;
};

// A B-spline basis function of ring(degree, n), by the angle.
Series basis_function(int degree, int n, int i) {
    Spline const spline = ring(degree, n, 1, 1);
    return Series([&](double angle) {
        harmorph::CurveBasis const basis =
            curve_basis(spline.curve(), ring_parameter(degree, n, angle), 0);
        double value = 0;
        for (int k = 0; k <= degree; ++k) value += basis.control[k] == i ? basis.value[0][k] : 0;
        return value;
    });
}

// Root mean square and largest difference over the points.
struct Errors {
    double rms = 0, max = 0;
};
template <class Exact>
Errors errors_of(std::vector<double> const& values, Mesh const& mesh, Exact exact) {
    Errors out;
    for (std::int32_t k = 0; k < mesh.n_points(); ++k) {
        double const error = std::fabs(values[std::size_t(k)] - exact(to_complex(mesh.point(k))));
        out.rms += error * error / mesh.n_points();
        out.max = std::fmax(out.max, error);
    }
    out.rms = std::sqrt(out.rms);
    return out;
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

TEST_CASE("annulus: the exact Fourier solution, to second order, on quads, triangles and both") {
    int const degree = 3, n = 8;
    Series const exact = basis_function(degree, n, 2);
    for (Cells const kind : kinds) {
        std::vector<Errors> found;
        for (int const refine : {1, 2, 4}) {
            Case setup = ring_case(6 * refine, 32 * refine, 0.5, 2, kind, degree, n);
            Solved const solved(setup);
            CHECK(solved.report.residual < 1e-12);
            CHECK(solved.report.boundary_error <= 1e-15);
            found.push_back(errors_of(solved.values(2), setup.mesh,
                                      [&](Complex z) { return exact.annulus(z, 0.5, 2); }));
        }
        INFO("largest errors " << found[0].max << " " << found[1].max << " " << found[2].max
                               << ", orders " << order(found[0].max, found[1].max) << " "
                               << order(found[1].max, found[2].max));
        CHECK(found[2].max < 2e-4);
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(order(found[k].rms, found[k + 1].rms) > 1.85);
            CHECK(order(found[k].max, found[k + 1].max) > 1.8);
        }
    }
}

TEST_CASE("a perturbed annulus: still second order in the mean") {
    Series const exact = basis_function(3, 8, 2);
    for (Cells const kind : kinds) {
        std::vector<Errors> found;
        for (int const refine : {2, 4, 8}) {
            Case setup = ring_case(6 * refine, 32 * refine, 0.5, 2, kind);
            perturb(setup.mesh, 0.25, 3);
            Solved const solved(setup);
            found.push_back(errors_of(solved.values(2), setup.mesh,
                                      [&](Complex z) { return exact.annulus(z, 0.5, 2); }));
        }
        INFO("orders " << order(found[0].rms, found[1].rms) << " "
                       << order(found[1].rms, found[2].rms));
        CHECK(order(found[0].rms, found[2].rms) / 2 > 1.8);
    }
}

TEST_CASE("a conformal image of the annulus has the same functions: an ellipse with a far field") {
    // z + c / z maps circles to confocal ellipses; harmonic functions stay harmonic.
    double const c = 0.16;
    Series const exact = basis_function(3, 8, 1);
    for (Cells const kind : kinds) {
        double error[2];
        for (int const refine : {1, 2}) {
            Case setup = ring_case(12 * refine, 64 * refine, 0.5, 2, kind);
            Mesh const circles = setup.mesh;
            for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
                Complex const z(circles.x[k], circles.y[k]), image = z + c / z;
                setup.mesh.x[k] = image.real();
                setup.mesh.y[k] = image.imag();
            }
            Solved const solved(setup);
            error[refine - 1] = errors_of(solved.values(1), circles, [&](Complex z) {
                                    return exact.annulus(z, 0.5, 2);
                                }).max;
        }
        CHECK(error[1] < 5e-4);
        CHECK(order(error[0], error[1]) > 1.8);
    }
}

TEST_CASE("a free symmetry line: half the annulus has half of the symmetric solution") {
    double const r0 = 0.5, r1 = 2;
    int const n_control = 9;
    Spline arc;  // clamped over the half circle; function 4 and its slope vanish at both ends
    arc.knots = clamped_knots(3, n_control);
    for (int k = 0; k < n_control; ++k) {
        arc.control.push_back(r0 * std::cos(pi * k / (n_control - 1)));
        arc.control.push_back(r0 * std::sin(pi * k / (n_control - 1)));
    }
    Series const exact([&](double angle) {  // even about the line
        harmorph::CurveBasis const basis =
            curve_basis(arc.curve(), (angle > pi ? 2 * pi - angle : angle) / pi, 0);
        double value = 0;
        for (int k = 0; k <= 3; ++k) value += basis.control[k] == 4 ? basis.value[0][k] : 0;
        return value;
    });
    for (Cells const kind : kinds) {
        double error[2];
        for (int const refine : {1, 2}) {
            int const n_r = 10 * refine, n_t = 30 * refine;
            Case setup;
            setup.mesh = half_annulus(n_r, n_t, r0, r1, kind);
            for (int i = 0; i <= n_t; ++i) setup.give(i, 1.0 * i / n_t);
            setup.curves = arc;
            setup.put_on_curves(body);
            setup.set_free(symmetry_line);
            Solved const solved(setup);
            CHECK(solved.report.curve_points ==
                  n_t + 1);  // the ends belong to both: the curve comes first
            error[refine - 1] = errors_of(solved.values(4), setup.mesh, [&](Complex z) {
                                    return exact.annulus(z, r0, r1);
                                }).max;
        }
        CHECK(error[1] < 1e-3);
        CHECK(order(error[0], error[1]) > 1.8);
    }
}

TEST_CASE("the sum of all functions is the harmonic measure of the wall for any curve") {
    for (Cells const kind : kinds) {
        std::vector<std::vector<double>> sums;
        for (int const degree : {1, 2, 3, 5})
            for (int const n : {6, 13}) {
                Case setup = ring_case(10, 40, 0.5, 2, kind, degree, n);
                perturb(setup.mesh, 0.2, 9);
                Solved const solved(setup);
                sums.push_back(solved.sum());
                for (std::size_t k = 0; k < 40; ++k)
                    CHECK(sums.back()[k] == doctest::Approx(1).epsilon(1e-15));
                CHECK(solved.report.partition_defect < 1e-15);
            }
        for (std::vector<double> const& sum : sums) CHECK(largest_difference(sum, sums[0]) < 1e-13);
    }
}

TEST_CASE("rational functions sum up to 1 on the curve as well") {
    Case setup = ring_case(8, 36, 0.5, 2, Cells::hybrid);
    Case weighted = setup;
    for (int k = 0; k < 8; ++k) weighted.curves.weights.push_back(0.5 + 0.3 * k);
    Solved const plain(setup), rational(weighted);
    CHECK(rational.report.partition_defect < 1e-15);
    CHECK(largest_difference(plain.sum(), rational.sum()) < 1e-13);
    CHECK(largest_difference(plain.values(3), rational.values(3)) > 1e-2);
}

TEST_CASE("maximum principle: on Delaunay triangles the functions stay between 0 and 1") {
    Case setup = ring_case(14, 60, 0.5, 2, Cells::triangles, 3, 11);
    perturb(setup.mesh, 0.3, 5);
    improve(setup.mesh, 3);  // flips until it is Delaunay
    Solved const solved(setup);
    CHECK(solved.report.min_value >= -1e-15);
    CHECK(solved.report.max_value <= 1);
    CHECK(solved.report.max_value > 0.6);  // a uniform cubic reaches 2/3
}

TEST_CASE("an airfoil with a sharp trailing edge: all that the report promises") {
    for (Cells const kind : kinds) {
        Case setup = airfoil_case(60, 20, kind);
        Solved const solved(setup);
        CHECK(solved.report.residual <= 1e-12);
        CHECK(solved.report.boundary_error <= 1e-12);
        CHECK(solved.report.partition_defect <= 1e-14);
        CHECK(solved.report.curve_points == 120);
        CHECK(solved.report.max_distance < 2e-2);
        std::vector<double> const tied = solved.values(0);  // the control point at both ends
        CHECK(tied[0] == 1);
    }
}
