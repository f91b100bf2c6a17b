// The matrix of the conformal operator: the energy that its solutions minimise, its kernel, its
// definiteness.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>
#include <fixtures/operators.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// The assembled matrix as a dense one over the mesh's points, whatever its unknowns are stored as.
class Hermitian {
public:
    Hermitian(Case& setup, std::vector<double> const& conductivity)
        : n(std::size_t(setup.mesh.n_points())) {
        Options const options = options_of(HM_CONFORMAL);
        Attempt seen;
        REQUIRE(seen.analyse(setup.problem(), &options));
        harmorph::Analysis const& a = inside(seen.analysis);
        AssembledMatrix assembled(a);
        harmorph::Matrix const& m = assembled.matrix;
        REQUIRE(assemble_stiffness(a.topology(), a.problem().mesh.points, span(conductivity), true,
                                   m, {}) == harmorph::none);
        Index const components = m.components();
        entries_.assign(n * n, 0);
        is_unknown.assign(n, 0);
        auto const line = [&](Index position) { return a.graph().line[a.order()[position]]; };
        for (Index i = 0; i < m.n; ++i) {
            is_unknown[std::size_t(line(i) / components)] = 1;
            add(line(i), line(i), components, {m.diagonal[i], 0});
            for (harmorph::Offset k = m.start[i]; k < m.start[i + 1]; ++k) {
                Complex const value{m.value[k], m.is_complex() ? m.imaginary[k] : 0};
                add(line(i), line(m.column[k]), components, value);
                add(line(m.column[k]), line(i), components, std::conj(value));
            }
        }
        for (Index wall = 0; wall + 1 < m.coupling_start.count(); ++wall)
            for (Index c = m.coupling_start[wall]; c < m.coupling_start[wall + 1]; ++c) {
                Index const coupling_line =
                    components * a.wall().point[wall / components] + wall % components;
                Complex const value{m.coupling_value[c],
                                    m.is_complex() ? m.coupling_imaginary[c] : 0};
                add(line(m.coupling_row[c]), coupling_line, components, value);
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

    // If a point has two real lines, an entry is [a -b; b a]. This checks that the second line
    // agrees with the first.
    bool rows_agree() const {
        for (Entry const& e : second_) {
            Complex const first = at(std::size_t(e.row / 2), std::size_t(e.column / 2));
            double const expected = e.column % 2 == 0 ? first.imag() : first.real();
            if (std::fabs(e.value - expected) >
                1e-14 * std::fabs(first.real()) + 1e-14 * std::fabs(first.imag()))
                return false;
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
        std::size_t const i = std::size_t(row / components), j = std::size_t(column / components);
        Complex& to = entries_[i * n + j];
        if (components == 1) {
            to += value;
        } else if (row % 2 == 0) {
            to += column % 2 == 0 ? value : Complex(0, -value.real());
        } else {
            second_.push_back({row, column, value.real()});
        }
    }
    std::vector<Entry> second_;  // of second lines
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
        // Grad of the shape function: (a.y - b.y, b.x - a.x) / twice.
        Point const a = p[(i + 1) % 3], b = p[(i + 2) % 3];
        slope += f[std::size_t(corner[i])] * Complex(a.y - b.y, b.x - a.x) / twice;
    }
    return 0.5 * twice * std::norm(slope);
}

}  // namespace

TEST_CASE("the conformal matrix is that of the integral of k |f_x + i f_y|^2, cell by cell") {
    for (Cells const kind : kinds) {
        Case setup = square_on_curve(7, kind, 0.4, 5);
        std::vector<double> const k = some_conductivity(setup.mesh, 6);
        Hermitian const a(setup, k);
        CHECK(a.rows_agree());
        std::mt19937 random(7);
        Field f(a.n, 0);
        for (std::size_t i = 0; i < a.n; ++i)
            if (a.is_unknown[i]) f[i] = {uniform(random) - 0.5, uniform(random) - 0.5};
        Field const af = a.times(f);
        Complex form = 0;
        for (std::size_t i = 0; i < a.n; ++i) form += std::conj(f[i]) * af[i];
        double expected = 0;
        harmorph::Mesh const mesh = core_mesh(setup.mesh);
        for (Index c = 0; c < mesh.n_cells; ++c) {
            harmorph::Cell const cell = mesh.cell(c);
            const Index* const q = cell.point;
            double const conductivity = k[std::size_t(c)];
            if (cell.n == 3) {
                expected += conductivity * energy(setup.mesh, f, {q[0], q[1], q[2]});
                continue;
            }
            for (int i = 0; i < 4; ++i)
                expected += 0.5 * conductivity *
                            energy(setup.mesh, f, {q[i], q[(i + 1) % 4], q[(i + 2) % 4]});
        }
        CHECK(std::fabs(form.imag()) < 1e-13 * expected);
        CHECK(form.real() == doctest::Approx(expected).epsilon(1e-13));
        // Anti-conformal maps are not in its kernel, so the sign of i is the right one.
        CHECK(expected > 0);
    }
}

TEST_CASE("the matrix is Hermitian, and maps z -> a z + b are in the kernel for any k") {
    for (Cells const kind : kinds)
        for (bool const mixed : {false, true}) {
            Case setup = square_on_curve(7, kind, 0.4, 8);
            if (mixed) reverse_some(setup.mesh, 9);
            Hermitian const a(setup, some_conductivity(setup.mesh, 10));
            CHECK(a.rows_agree());
            double size = 0;
            for (std::size_t i = 0; i < a.n; ++i)
                for (std::size_t j = 0; j < a.n; ++j) {
                    size = std::fmax(size, std::abs(a.at(i, j)));
                    if (a.is_unknown[i] && a.is_unknown[j])
                        CHECK(std::abs(a.at(i, j) - std::conj(a.at(j, i))) < 1e-13);
                }
            Field conformal, mirrored;
            for (Complex const z : positions(setup.mesh)) {
                conformal.push_back(Complex(0.3, -2) * z + Complex(5, 1));
                mirrored.push_back(std::conj(z));
            }
            double in_kernel = 0, outside = 0;
            for (Complex const r : a.times(conformal))
                in_kernel = std::fmax(in_kernel, std::abs(r));
            for (Complex const r : a.times(mirrored)) outside = std::fmax(outside, std::abs(r));
            CHECK(in_kernel < 1e-13 * size);
            CHECK(outside > 1e-2 * size);
        }
}

TEST_CASE("the matrix is positive definite on distorted and thin cells with varying weights") {
    for (Cells const kind : kinds)
        for (double const thin : {1.0, 1e-3}) {
            Case setup = square_on_curve(7, kind, 0.4, 11);
            for (double& y : setup.mesh.y) y *= thin;
            for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
                setup.curves.control[k] *= thin;
            std::vector<double> k = some_conductivity(setup.mesh, 12);
            for (double& value : k) value = std::pow(value, 3);
            Hermitian const a(setup, k);
            std::vector<std::size_t> unknown;
            for (std::size_t i = 0; i < a.n; ++i)
                if (a.is_unknown[i]) unknown.push_back(i);
            std::size_t const n = unknown.size();
            REQUIRE(n == 36);
            DenseMatrix real(2 * n);  // [re -im; im re]
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
