// The conformal operator: the energy it claims to minimise, exact solutions, and what follows from its symmetries.
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/matrices.hpp>
#include <fixtures/operators.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

double const pi = std::acos(-1.0);
constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// The assembled matrix as a dense one over the mesh's points, whatever its unknowns are stored as.
class Hermitian {
public:
    Hermitian(Case& its, std::vector<double> const& conductivity) : n(static_cast<std::size_t>(its.mesh.n_points())) {
        hm_options const options = options_of(HM_CONFORMAL);
        Attempt seen;
        REQUIRE(seen.analyse(its.problem(), &options));
        harmorph::Analysis const& a = inside(seen.analysis);
        AssembledMatrix assembled(a);
        harmorph::Matrix const& m = assembled.matrix;
        REQUIRE(assemble_stiffness(a.topology, a.problem.mesh.points, span(conductivity), true, m, {}) ==
                harmorph::none);
        Index const components = m.components();
        entries_.assign(n * n, 0);
        is_unknown.assign(n, 0);
        auto const line = [&](Index position) { return a.graph.line[a.order[position]]; };
        for (Index i = 0; i < m.n; ++i) {
            is_unknown[static_cast<std::size_t>(line(i) / components)] = 1;
            add(line(i), line(i), components, {m.diagonal[i], 0});
            for (harmorph::Offset k = m.start[i]; k < m.start[i + 1]; ++k) {
                Complex const value{m.value[k], m.is_complex() ? m.imaginary[k] : 0};
                add(line(i), line(m.column[k]), components, value);
                add(line(m.column[k]), line(i), components, std::conj(value));
            }
        }
        for (Index wall = 0; wall + 1 < m.coupling_start.count(); ++wall)
            for (Index c = m.coupling_start[wall]; c < m.coupling_start[wall + 1]; ++c) {
                Index const its_line = components * a.wall.point[wall / components] + wall % components;
                Complex const value{m.coupling_value[c], m.is_complex() ? m.coupling_imaginary[c] : 0};
                add(line(m.coupling_row[c]), its_line, components, value);
            }
    }
    Complex at(std::size_t i, std::size_t j) const { return entries_[i * n + j]; }
    // In the rows of the unknowns.
    Field times(Field const& f) const {
        Field out(n, 0);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; is_unknown[i] && j < n; ++j) out[i] += at(i, j) * f[j];
        return out;
    }

    // Where a point has two real lines, an entry is [a -b; b a]: does the second line say what the first does?
    bool rows_agree() const {
        for (Entry const& e : second_) {
            Complex const first = at(static_cast<std::size_t>(e.row / 2), static_cast<std::size_t>(e.column / 2));
            double const expected = e.column % 2 == 0 ? first.imag() : first.real();
            if (std::fabs(e.value - expected) > 1e-14 * std::fabs(first.real()) + 1e-14 * std::fabs(first.imag())) return false;
        }
        return true;
    }

    std::size_t n;
    std::vector<char> is_unknown;

private:
    struct Entry {
        Index row, column;
        double value;
    };
    void add(Index row, Index column, Index components, Complex value) {
        std::size_t const i = static_cast<std::size_t>(row / components), j = static_cast<std::size_t>(column / components);
        Complex& to = entries_[i * n + j];
        if (components == 1) {
            to += value;
        } else if (row % 2 == 0) {
            to += column % 2 == 0 ? value : Complex(0, -value.real());
        } else {
            second_.push_back({row, column, value.real()});
        }
    }
    std::vector<Entry> second_;   // of second lines
    Field entries_;
};

std::vector<double> some_conductivity(Mesh const& mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> out;
    for (std::int32_t k = 0; k < mesh.n_cells(); ++k) out.push_back(0.1 + 10 * uniform(random));
    return out;
}

// The integral of |f_x + i f_y|^2 over a triangle with a linear f.
double energy(Mesh const& mesh, Field const& f, const std::int32_t (&corner)[3]) {
    Complex slope = 0;
    Point const p[] = {mesh.point(corner[0]), mesh.point(corner[1]), mesh.point(corner[2])};
    double const twice = twice_area(p[0], p[1], p[2]);
    for (int i = 0; i < 3; ++i) {
        Point const a = p[(i + 1) % 3], b = p[(i + 2) % 3];   // grad of the shape function: (a.y - b.y, b.x - a.x) / twice
        slope += f[static_cast<std::size_t>(corner[i])] * Complex(a.y - b.y, b.x - a.x) / twice;
    }
    return 0.5 * twice * std::norm(slope);
}

}  // namespace

TEST_CASE("the matrix is that of the integral of k |f_x + i f_y|^2, cell by cell, for quads the mean of both splits") {
    for (Cells const kind : kinds) {
        Case its = square_on_curve(7, kind, 0.4, 5);
        std::vector<double> const k = some_conductivity(its.mesh, 6);
        Hermitian const a(its, k);
        CHECK(a.rows_agree());
        std::mt19937 random(7);
        Field f(a.n, 0);
        for (std::size_t i = 0; i < a.n; ++i)
            if (a.is_unknown[i]) f[i] = {uniform(random) - 0.5, uniform(random) - 0.5};
        Field const af = a.times(f);
        Complex form = 0;
        for (std::size_t i = 0; i < a.n; ++i) form += std::conj(f[i]) * af[i];
        double expected = 0;
        harmorph::Mesh const mesh = core_mesh(its.mesh);
        for (Index c = 0; c < mesh.n_cells; ++c) {
            harmorph::Cell const cell = mesh.cell(c);
            const Index* const q = cell.point;
            double const its_k = k[static_cast<std::size_t>(c)];
            if (cell.n == 3) {
                expected += its_k * energy(its.mesh, f, {q[0], q[1], q[2]});
                continue;
            }
            for (int i = 0; i < 4; ++i)
                expected += 0.5 * its_k * energy(its.mesh, f, {q[i], q[(i + 1) % 4], q[(i + 2) % 4]});
        }
        CHECK(std::fabs(form.imag()) < 1e-13 * expected);
        CHECK(form.real() == doctest::Approx(expected).epsilon(1e-13));
        // Anti-conformal maps are not in its kernel, so the sign of i is the right one.
        CHECK(expected > 0);
    }
}

TEST_CASE("Hermitian; every map z -> a z + b is in its kernel whatever k is, the mirrored ones are not") {
    for (Cells const kind : kinds)
        for (bool const mixed : {false, true}) {
            Case its = square_on_curve(7, kind, 0.4, 8);
            if (mixed) reverse_some(its.mesh, 9);
            Hermitian const a(its, some_conductivity(its.mesh, 10));
            CHECK(a.rows_agree());
            double size = 0;
            for (std::size_t i = 0; i < a.n; ++i)
                for (std::size_t j = 0; j < a.n; ++j) {
                    size = std::fmax(size, std::abs(a.at(i, j)));
                    if (a.is_unknown[i] && a.is_unknown[j]) CHECK(std::abs(a.at(i, j) - std::conj(a.at(j, i))) < 1e-13);
                }
            Field conformal, mirrored;
            for (Complex const z : positions(its.mesh)) {
                conformal.push_back(Complex(0.3, -2) * z + Complex(5, 1));
                mirrored.push_back(std::conj(z));
            }
            double in_kernel = 0, outside = 0;
            for (Complex const r : a.times(conformal)) in_kernel = std::fmax(in_kernel, std::abs(r));
            for (Complex const r : a.times(mirrored)) outside = std::fmax(outside, std::abs(r));
            CHECK(in_kernel < 1e-13 * size);
            CHECK(outside > 1e-2 * size);
        }
}

TEST_CASE("positive definite on distorted and on thin cells, with conductivities that differ by 10^6") {
    for (Cells const kind : kinds)
        for (double const thin : {1.0, 1e-3}) {
            Case its = square_on_curve(7, kind, 0.4, 11);
            for (double& y : its.mesh.y) y *= thin;
            for (std::size_t k = 1; k < its.curves.control.size(); k += 2) its.curves.control[k] *= thin;
            std::vector<double> k = some_conductivity(its.mesh, 12);
            for (double& value : k) value = std::pow(value, 3);
            Hermitian const a(its, k);
            std::vector<std::size_t> unknown;
            for (std::size_t i = 0; i < a.n; ++i)
                if (a.is_unknown[i]) unknown.push_back(i);
            std::size_t const n = unknown.size();
            REQUIRE(n == 36);
            DenseMatrix real(2 * n);   // [re -im; im re]
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    Complex const value = a.at(unknown[i], unknown[j]);
                    real.at(i, j) = real.at(n + i, n + j) = value.real();
                    real.at(i, n + j) = -value.imag();
                    real.at(n + i, j) = value.imag();
                }
            CHECK(real.factor());
        }
}

TEST_CASE("without a weight the functions are Laplace's, and real") {
    for (Cells const kind : kinds) {
        Case its = two_body_case(kind, 8, 6);
        hm_options const conformal = options_of(HM_CONFORMAL, HM_NO_WEIGHT), paper = options_of(HM_LAPLACE);
        Solved const a(its, &conformal), b(its, &paper);
        CHECK(a.info().exponent_quarters == 0);
        for (std::int32_t i = 0; i < 20; ++i) CHECK(largest_difference(complex_values(a, i), complex_values(b, i)) < 1e-13);
        hm_options const weighted = options_of(HM_CONFORMAL);   // and with one they are not
        Solved const c(its, &weighted);
        CHECK(c.info().exponent_quarters == 6);
        double imaginary = 0;
        for (Complex const f : complex_values(c, 3)) imaginary = std::fmax(imaginary, std::fabs(f.imag()));
        CHECK(imaginary > 1e-2);
    }
}

TEST_CASE("the functions are N_i(u) on the curves, without imaginary part, and 0 on fixed points") {
    for (Cells const kind : kinds) {
        Case its = two_body_case(kind, 8, 6);
        hm_options const options = options_of(HM_CONFORMAL);
        Solved const solved(its, &options);
        CHECK(solved.report.boundary_error == 0);
        CHECK(solved.report.partition_defect < 1e-15);
        hm_basis_info const info = solved.info();
        std::vector<Field> functions;
        for (std::int32_t i = 0; i < 20; ++i) functions.push_back(complex_values(solved, i));
        for (std::int32_t k = 0; k < info.curve_points; ++k) {
            std::size_t const point = static_cast<std::size_t>(info.curve_point[k]);
            std::int32_t control[6];
            double value[6];
            REQUIRE(hm_curve_basis(&its.curves.view(), info.point_curve[k], info.point_u[k], 0, control, value, nullptr) ==
                    HM_OK);
            Field expected(20, 0);
            int const degree = its.curves.shapes[static_cast<std::size_t>(info.point_curve[k])].degree;
            for (int j = 0; j <= degree; ++j) expected[static_cast<std::size_t>(control[j])] += value[j];
            for (std::size_t i = 0; i < 20; ++i) CHECK(functions[i][point] == expected[i]);
        }
        for (std::int32_t const point : points_on(its.mesh, far_field))
            for (Field const& f : functions) CHECK(f[static_cast<std::size_t>(point)] == 0.0);
    }
}

TEST_CASE("a morph is linear over the complex numbers: turning all movements turns all displacements") {
    Case its = airfoil_case();
    hm_options const options = options_of(HM_CONFORMAL);
    Solved const solved(its, &options);
    std::vector<double> const move = some_move(12, 1, 13), other = some_move(12, 1, 14);
    Field const moved = displacement(solved, move), also = displacement(solved, other);
    for (Complex const by : {Complex(0, 1), Complex(-1, 0), Complex(0.6, 1.7)}) {
        Field expected;
        for (Complex const d : moved) expected.push_back(by * d);
        CHECK(largest_difference(displacement(solved, turned(move, by)), expected) < 1e-14);
    }
    std::vector<double> sum;
    for (std::size_t k = 0; k < move.size(); ++k) sum.push_back(move[k] + 3 * other[k]);
    Field expected;
    for (std::size_t k = 0; k < moved.size(); ++k) expected.push_back(moved[k] + 3.0 * also[k]);
    CHECK(largest_difference(displacement(solved, sum), expected) < 1e-13);
}

TEST_CASE("control points moved by a similarity move the wall by it") {
    Case its = ring_case(8, 32, 0.5, 2, Cells::hybrid);
    hm_options const options = options_of(HM_CONFORMAL);
    Solved const solved(its, &options);
    // Points on the fitted curve: the mesh's own are beside it and keep their offset, unturned.
    for (Complex const centre : {Complex(0, 0), Complex(0.7, -3)})
        for (Complex const s : {std::polar(1.0, 1.0), Complex(-2, 0.5)}) {
            Field const found = displacement(solved, similarity_move(its.curves, s, centre, {0.1, 0.2}));
            hm_basis_info const info = solved.info();
            for (std::int32_t k = 0; k < info.curve_points; ++k) {
                double xy[2];
                REQUIRE(hm_curve_point(&its.curves.view(), 0, info.point_u[k], 0, xy, nullptr) == HM_OK);
                Complex const expected = (s - 1.0) * (Complex(xy[0], xy[1]) - centre) + Complex(0.1, 0.2);
                CHECK(std::abs(found[static_cast<std::size_t>(info.curve_point[k])] - expected) < 1e-14);
            }
        }
}

namespace {

// Exact on an annulus with k = (r - r0)^-q: for the boundary values e^(i n angle) on r0 and 0 on r1 the minimum of
// the integral of k |f_x + i f_y|^2 is f = g(r) e^(i n angle) with k (g' - n g / r) = c r^(-n - 1), and so
//     g = (r / r0)^n (1 - I(r) / I(r1)),  I(r) = integral from r0 to r of s^(-2 n - 1) (s - r0)^q ds.
class ExactRing {
public:
    ExactRing(double r0, double r1, double q, int degree, int n_functions, int function) : r0_(r0), r1_(r1), q_(q) {
        Spline const spline = ring(degree, n_functions, 1, 1);
        constexpr int samples = 1024;
        std::vector<double> value(samples, 0.0);
        for (int k = 0; k < samples; ++k) {
            double const u = ring_parameter(degree, n_functions, 2 * pi * k / samples);
            harmorph::CurveBasis const basis = curve_basis(spline.curve(), u, 0);
            double& its = value[static_cast<std::size_t>(k)];
            for (int j = 0; j <= degree; ++j) its += basis.control[j] == function ? basis.value[0][j] : 0;
        }
        for (int n = -modes; n <= modes; ++n) {
            Complex sum = 0;
            for (int k = 0; k < samples; ++k)
                sum += value[static_cast<std::size_t>(k)] * std::polar(1.0, -2 * pi * ((n * k) % samples) / samples);
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
                std::size_t const its = static_cast<std::size_t>(n + modes);
                sum += coefficient_[its] * g[its] * std::polar(1.0, 2 * pi * n * k / n_t);
            }
            out.push_back(sum);
        }
        return out;
    }

private:
    static constexpr int modes = 40;   // coefficients fall like n^-4

    // Simpson's rule in t with s = r0 + t^2, which makes (s - r0)^q smooth enough.
    double integral(double from, double to, int n) const {
        constexpr int steps = 100;
        double const a = std::sqrt(std::fmax(from - r0_, 0.0)), b = std::sqrt(to - r0_), h = (b - a) / steps;
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

double rms_error(int refine, Cells kind, std::int32_t quarters) {
    int const n_r = 6 * refine, n_t = 32 * refine;
    double const r0 = 0.5, r1 = 2;
    Case its = ring_case(n_r, n_t, r0, r1, kind);
    hm_options const options = options_of(HM_CONFORMAL, quarters);
    Solved const solved(its, &options);
    Field const found = complex_values(solved, 2);
    ExactRing const exact(r0, r1, 0.25 * std::max(quarters, 0), 3, 8, 2);
    double sum = 0;
    for (int i = 0; i <= n_r; ++i) {
        Field const ring = exact.at(r0 * std::pow(r1 / r0, 1.0 * i / n_r), n_t);
        for (int k = 0; k < n_t; ++k)
            sum += std::norm(found[static_cast<std::size_t>(i * n_t + k)] - ring[static_cast<std::size_t>(k)]);
    }
    return std::sqrt(sum / static_cast<double>(found.size()));
}

}  // namespace

TEST_CASE("annulus: the exact solution with k = d^-q, to second order where quads are at the wall") {
    auto const order = [](Cells kind, std::int32_t quarters) {
        double const coarse = rms_error(2, kind, quarters), fine = rms_error(4, kind, quarters);
        CHECK(fine < 1.5e-3);
        return std::log2(coarse / fine);
    };
    for (Cells const kind : {Cells::quads, Cells::hybrid})
        for (std::int32_t const quarters : {+HM_NO_WEIGHT, 6, 8}) CHECK(order(kind, quarters) > 1.85);
    CHECK(order(Cells::quads, 3) > 1.65);   // its second derivatives are unbounded: f = d^(1 + q) beside smooth terms
    // In triangles barycentres lie at one or two thirds of a layer, as the chance of equal diagonals has it, and k jumps.
    CHECK(order(Cells::triangles, HM_NO_WEIGHT) > 1.85);
    CHECK(order(Cells::triangles, 6) > 1.3);
}

TEST_CASE("numbering, orientation, markers, place and size of the mesh do not change the functions") {
    Case const origin = airfoil_case(30, 10);
    hm_options const options = options_of(HM_CONFORMAL);
    Case its = origin;
    Solved const reference(its, &options);
    auto const compare = [&](Case& changed, std::vector<std::int32_t> const& new_of, bool mirrored) {
        Solved const solved(changed, &options);
        double worst = 0;
        for (std::int32_t i = 0; i < 10; ++i) {
            Field const expected = complex_values(reference, i), found = complex_values(solved, i);
            for (std::size_t k = 0; k < expected.size(); ++k) {
                Complex const f = found[new_of.empty() ? k : static_cast<std::size_t>(new_of[k])];
                worst = std::fmax(worst, std::abs((mirrored ? std::conj(f) : f) - expected[k]));
            }
        }
        CHECK(worst < 1e-10);
    };
    Case changed = origin;
    std::vector<std::int32_t> const new_of = renumber_points(changed.mesh, 3);
    shuffle_cells(changed.mesh, 4);
    compare(changed, new_of, false);
    changed = origin;
    reverse_all(changed.mesh);
    compare(changed, {}, false);
    reverse_some(changed.mesh, 5);
    rotate_starts(changed.mesh, 6);
    reverse_some_faces(changed.mesh, 7);
    split_marker(changed.mesh, body, 3, 31);
    changed.conditions.clear();
    for (std::int32_t const marker : {31, 32, 33}) changed.put_on_curves(marker);
    compare(changed, {}, false);
    changed = similar(origin, std::polar(3.0, 0.7), {2, -5});
    compare(changed, {}, false);
    changed = origin;   // the mirror image has the conjugate functions
    for (double& y : changed.mesh.y) y = -y;
    for (std::size_t k = 1; k < changed.curves.control.size(); k += 2) changed.curves.control[k] *= -1;
    compare(changed, {}, true);
    reverse_all(changed.mesh);
    compare(changed, {}, true);
}

TEST_CASE("units from thousandths to 1e30") {
    Case const origin = airfoil_case(20, 8);
    hm_options const options = options_of(HM_CONFORMAL);
    Case its = origin;
    Solved const reference(its, &options);
    for (double const unit : {1e-3, 1024.0, 1e30, 1e-30}) {
        Case scaled = similar(origin, unit, 0);
        Solved const solved(scaled, &options);
        for (std::int32_t i = 0; i < 8; ++i)
            CHECK(largest_difference(complex_values(solved, i), complex_values(reference, i)) < 1e-9);
    }
}

TEST_CASE("a free boundary is refused, with a word on what does go; unknown exponents are") {
    Case its = ring_case(6, 24, 0.5, 2);
    its.set_free(far_field);
    for (std::int32_t const quarters : {0, 6, +HM_NO_WEIGHT}) {
        hm_options const options = options_of(HM_CONFORMAL, quarters);
        Attempt const attempt(its.problem(), &options);
        CHECK(attempt.status == HM_UNSUPPORTED);
        CHECK(attempt.reached == "analysis size");
        CHECK(std::string(attempt.error.text).find("slip") != std::string::npos);
    }
    Attempt const by_default(its.problem(), nullptr);
    CHECK(by_default.status == HM_OK);   // the fixture's default is Laplace's operator
    its.conditions.pop_back();
    for (std::int32_t const quarters : {-2, 17, 2147483647}) {
        hm_options const options = options_of(HM_CONFORMAL, quarters);
        CHECK(Attempt(its.problem(), &options).status == HM_BAD_ARGUMENT);
    }
    hm_options options = options_of(HM_LAPLACE, 4);
    CHECK(Attempt(its.problem(), &options).status == HM_UNSUPPORTED);
    options = options_of(1000);
    CHECK(Attempt(its.problem(), &options).status == HM_UNSUPPORTED);
}

TEST_CASE("any number of threads gives the same bits, and kernels agree to rounding") {
    Case its = airfoil_case();
    hm_options const plain = options_of(HM_CONFORMAL);
    Solved const reference(its, &plain);
    std::vector<double> const move = some_move(12, 1, 15);
    Field const expected = displacement(reference, move);
    for (std::int32_t const threads : {2, 3}) {
        Backwards backwards;
        hm_executor const executor = backwards.executor(threads);
        hm_options options = plain;
        options.executor = &executor;
        Solved const solved(its, &options);
        CHECK(backwards.tasks > 0);
        CHECK(displacement(solved, move) == expected);
    }
    for (std::int32_t const kernel : {HM_KERNEL_BASELINE, HM_KERNEL_AVX2, HM_KERNEL_AVX512, HM_KERNEL_NEON}) {
        hm_options options = plain;
        options.kernel = kernel;
        Attempt const attempt(its.problem(), &options);
        if (attempt.status == HM_UNSUPPORTED) continue;
        REQUIRE(attempt.status == HM_OK);
        CHECK(largest_difference(displacement(attempt.basis, move), expected) < 1e-10);
    }
}
