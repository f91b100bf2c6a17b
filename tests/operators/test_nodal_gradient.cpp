// The scheme of nodal gradients: exact for linear fields, conservative, blind to checkerboards
// without correction.
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>
#include <fixtures/schemes.hpp>
#include <fixtures/wrong.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

double largest(std::vector<double> const& values) {
    double out = 0;
    for (double const value : values) out = std::fmax(out, std::fabs(value));
    return out;
}

// Gaussian elimination with row pivots.
std::vector<double> solve(DenseMatrix a, std::vector<double> b) {
    for (std::size_t k = 0; k < a.n; ++k) {
        std::size_t pivot = k;
        for (std::size_t r = k; r < a.n; ++r)
            if (std::fabs(a.at(r, k)) > std::fabs(a.at(pivot, k))) pivot = r;
        for (std::size_t c = k; c < a.n; ++c) std::swap(a.at(k, c), a.at(pivot, c));
        std::swap(b[k], b[pivot]);
        for (std::size_t r = k + 1; r < a.n; ++r) {
            double const factor = a.at(r, k) / a.at(k, k);
            if (factor == 0) continue;
            for (std::size_t c = k; c < a.n; ++c) a.at(r, c) -= factor * a.at(k, c);
            b[r] -= factor * b[k];
        }
    }
    for (std::size_t k = a.n; k-- > 0;) {
        for (std::size_t c = k + 1; c < a.n; ++c) b[k] -= a.at(k, c) * b[c];
        b[k] /= a.at(k, k);
    }
    return b;
}

// Root mean square of the error where points on `free` and inside are solved for, and the others
// know the exact values.
template <class Exact>
double error_of(Mesh const& mesh, bool corrected, Exact exact, std::int32_t free = -1) {
    Scheme const scheme(mesh, corrected);
    std::vector<char> known(mesh.x.size(), 0);
    for (std::size_t k = 0; k < mesh.faces.size(); ++k)
        if (mesh.face_markers[k / 2] != free) known[static_cast<std::size_t>(mesh.faces[k])] = 1;
    std::vector<std::size_t> unknowns;
    for (std::size_t k = 0; k < known.size(); ++k)
        if (!known[k]) unknowns.push_back(k);
    std::vector<double> const right = sampled(mesh, exact);
    std::vector<double> boundary = right;
    for (std::size_t const k : unknowns) boundary[k] = 0;
    std::vector<double> const from_boundary = scheme.balance(boundary);
    // All columns in one application.
    std::vector<double> columns(mesh.x.size() * unknowns.size(), 0.0);
    for (std::size_t j = 0; j < unknowns.size(); ++j)
        columns[unknowns[j] * unknowns.size() + j] = 1;
    columns = scheme.balance(columns, static_cast<std::int32_t>(unknowns.size()));
    DenseMatrix a(unknowns.size());
    std::vector<double> b;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        for (std::size_t j = 0; j < unknowns.size(); ++j)
            a.at(i, j) = columns[unknowns[i] * unknowns.size() + j];
        b.push_back(-from_boundary[unknowns[i]]);
    }
    std::vector<double> const found = solve(a, b);
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        sum += std::pow(found[i] - right[unknowns[i]], 2);
    return std::sqrt(sum / static_cast<double>(found.size()));
}

double harmonic(Point p) { return std::exp(2 * p.x) * std::cos(2 * p.y); }

}  // namespace

TEST_CASE("a linear field has no net flow out of any volume, also at the boundary") {
    for (Cells const kind : kinds)
        for (bool const corrected : {false, true})
            for (double const thin : {1.0, 1e-3}) {
                Mesh mesh = square(7, kind, 1, 3);
                perturb(mesh, 0.4, 4);
                for (double& y : mesh.y) y = 5 + thin * y;
                reverse_some(mesh, 5);
                Point const slope{0.7, -1.3};
                Scheme const scheme(mesh, corrected);
                auto const linear = [&](Point p) { return 2 + slope.x * p.x + slope.y * p.y; };
                std::vector<double> balance = scheme.balance(sampled(mesh, linear));
                for_each_half_face(mesh, [&](std::int32_t point, Point normal) {
                    balance[static_cast<std::size_t>(point)] +=
                        slope.x * normal.x + slope.y * normal.y;
                });
                CHECK(largest(balance) < 1e-13 / thin);
                CHECK(largest(scheme.balance(sampled(mesh, [](Point) { return 3.0; }))) == 0);
                auto const parabola = [](Point p) { return p.x * p.x; };
                CHECK(largest(scheme.balance(sampled(mesh, parabola))) >
                      1e-6);  // the test can fail
            }
}

TEST_CASE("what leaves one volume enters another") {
    std::mt19937 random(6);
    for (Cells const kind : kinds)
        for (bool const corrected : {false, true}) {
            Mesh mesh = two_bodies(5, 4, Ellipse{}, Ellipse{0.2, 0.05, 0.3}, kind);
            perturb(mesh, 0.3, 7);
            std::vector<double> values;
            for (std::size_t k = 0; k < mesh.x.size(); ++k) values.push_back(uniform(random));
            double sum = 0, size = 0;
            for (double const balance : Scheme(mesh, corrected).balance(values)) {
                sum += balance;
                size += std::fabs(balance);
            }
            CHECK(std::fabs(sum) < 1e-14 * size);
        }
}

TEST_CASE("the flux through a circle is that of the source within") {
    for (Cells const kind : kinds)
        for (bool const corrected : {false, true}) {
            double error[2];
            for (int const refine : {1, 2}) {
                Mesh const mesh = annulus(12 * refine, 40 * refine, 0.5, 2, kind, true);
                auto const source = [](Point p) { return std::log(std::hypot(p.x, p.y)); };
                std::vector<double> const balance =
                    Scheme(mesh, corrected).balance(sampled(mesh, source));
                double inner = 0,
                       outer =
                           0;  // known values: their volumes keep what the boundary lets through
                for (std::size_t k = 0; k < 40 * static_cast<std::size_t>(refine); ++k) {
                    inner += balance[k];
                    outer += balance[balance.size() - 1 - k];
                }
                error[refine - 1] = std::fmax(std::fabs(inner - 2 * pi), std::fabs(outer + 2 * pi));
            }
            INFO("errors " << error[0] << " " << error[1]);
            CHECK(error[1] < 0.2);
            CHECK(error[0] / error[1] > 1.8);
        }
}

TEST_CASE("a checkerboard has no gradient: the correction alone sees it") {
    Mesh const mesh = square(8);
    std::vector<double> checks;
    for (int j = 0; j <= 8; ++j)
        for (int i = 0; i <= 8; ++i) checks.push_back((i + j) % 2 == 0 ? 1 : -1);
    CHECK(largest(Scheme(mesh, false).balance(checks)) == 0);
    std::vector<double> const seen = Scheme(mesh, true).balance(checks);
    for (int j = 1; j < 8; ++j)
        for (int i = 1; i < 8;
             ++i) {  // four faces, each with the length and the distance of a cell
            std::size_t const k = static_cast<std::size_t>(9 * j + i);
            CHECK(seen[k] == doctest::Approx(-8 * checks[k]));
        }
}

TEST_CASE("several functions at once: the same bits as one by one") {
    Mesh mesh = two_bodies(5, 4, Ellipse{}, Ellipse{}, Cells::hybrid);
    std::vector<double> const a = sampled(mesh, harmonic),
                              b = sampled(mesh, [](Point p) { return p.x * p.y; });
    std::vector<double> both;
    for (std::size_t k = 0; k < a.size(); ++k) {
        both.push_back(a[k]);
        both.push_back(b[k]);
    }
    Scheme const scheme(mesh, true);
    std::vector<double> const one = scheme.balance(a), other = scheme.balance(b);
    both = scheme.balance(both, 2);
    Wrong wrong;
    for (std::size_t k = 0; k < one.size(); ++k) {
        wrong.compare(k, both[2 * k], one[k]);
        wrong.compare(k, both[2 * k + 1], other[k]);
    }
    CHECK(wrong == 0);
}

TEST_CASE("the corrected gradient has second order on uniform meshes and converges on others") {
    for (Cells const kind : kinds)
        for (double const amplitude : {0.0, 0.3}) {
            std::vector<double> error;
            for (int const n : {6, 12, 24}) {
                Mesh mesh = square(n, kind);
                perturb(mesh, amplitude, 8);
                error.push_back(error_of(mesh, true, harmonic));
            }
            INFO("errors " << error[0] << " " << error[1] << " " << error[2] << ", amplitude "
                           << amplitude);
            CHECK(std::log2(error[0] / error[2]) / 2 > (amplitude == 0 ? 1.8 : 1.4));
        }
}

TEST_CASE("a free symmetry line: half an annulus has half of the symmetric solution") {
    double const r0 = 0.5, r1 = 2;
    auto const exact = [&](Point p) {
        double const squared = p.x * p.x + p.y * p.y;
        return p.x * (r1 * r1 / squared - 1) / (r1 * r1 / r0 - r0);
    };
    for (Cells const kind : kinds)
        for (bool const corrected : {false, true}) {
            double const coarse =
                error_of(half_annulus(8, 14, r0, r1, kind), corrected, exact, symmetry_line);
            double const fine =
                error_of(half_annulus(16, 28, r0, r1, kind), corrected, exact, symmetry_line);
            INFO("errors " << coarse << " " << fine << ", corrected " << corrected);
            CHECK(std::log2(coarse / fine) > 1);
        }
}
