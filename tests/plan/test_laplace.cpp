// The operator: conservative, exact for linear fields, positive definite, and on triangles the
// finite elements'.
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// Largest |A f| over the rows, against the size of the terms; f a function of the place.
template <class Field>
double residual_of(Case& setup, Field field) {
    Analysed const seen(setup);
    AssembledMatrix laplace(*seen.operator->());
    laplace.assemble();
    auto const at = [&](Index point) { return field(setup.mesh.point(point)); };
    DenseMatrix const a = laplace.unknowns();
    std::vector<double> sum =
        laplace.couplings_times([&](Index slot) { return at(seen->wall().point[slot]); });
    double worst = 0, size = 0;
    for (std::size_t i = 0; i < laplace.size(); ++i) {
        for (std::size_t j = 0; j < laplace.size(); ++j) {
            sum[i] += a.at(i, j) * at(laplace.point_at(Index(j)));
            size = std::fmax(size, std::fabs(a.at(i, j)));
        }
        worst = std::fmax(worst, std::fabs(sum[i]));
    }
    return worst / size;
}

// Stiffness of linear elements from the gradients of their shape functions.
void add_element(DenseMatrix& k, Mesh const& mesh, const Index (&corner)[3], double weight) {
    Point const p[] = {mesh.point(corner[0]), mesh.point(corner[1]), mesh.point(corner[2])};
    double const twice = twice_area(p[0], p[1], p[2]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            Point const a = p[(i + 1) % 3], b = p[(i + 2) % 3], c = p[(j + 1) % 3],
                        d = p[(j + 2) % 3];
            double const product = (b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y);
            k.at(std::size_t(corner[i]), std::size_t(corner[j])) += weight * product / (2 * twice);
        }
}

}  // namespace

TEST_CASE("rows sum up to 0, and linear fields are reproduced, on any valid mesh") {
    for (Cells const kind : kinds)
        for (double const amplitude : {0.0, 0.4}) {
            Case setup = square_on_curve(9, kind, amplitude, 3);
            CHECK(residual_of(setup, [](Point) { return 1.0; }) < 1e-14);
            CHECK(residual_of(setup, [](Point p) { return p.x; }) < 1e-14);
            CHECK(residual_of(setup, [](Point p) { return 3 * p.y - p.x + 0.5; }) < 1e-13);
            CHECK(residual_of(setup, [](Point p) { return p.x * p.x; }) >
                  1e-3);  // the test can fail
        }
}

TEST_CASE("on a uniform grid quadratic harmonics are reproduced, too") {
    for (Cells const kind : kinds) {
        Case setup = square_on_curve(8, kind, 0, 0);
        CHECK(residual_of(setup, [](Point p) { return p.x * p.x - p.y * p.y; }) < 1e-14);
        CHECK(residual_of(setup, [](Point p) { return p.x * p.y; }) < 1e-14);
    }
}

TEST_CASE("stretched cells: exact for linear fields up to rounding at an aspect ratio of 10^4") {
    for (Cells const kind : kinds) {
        Case setup = square_on_curve(8, kind, 0.3, 4);
        for (double& y : setup.mesh.y) y *= 1e-4;
        for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
            setup.curves.control[k] *= 1e-4;
        CHECK(residual_of(setup, [](Point p) { return p.x + 1e4 * p.y; }) < 1e-12);
    }
}

TEST_CASE("the entries are linear finite elements', for quads the mean of both their splits") {
    for (Cells const kind : kinds)
        for (int change = 0; change < 2; ++change) {
            Case setup = square_on_curve(7, kind, 0.4, 5);
            DenseMatrix expected(std::size_t(setup.mesh.n_points()));
            harmorph::Mesh const mesh = core_mesh(setup.mesh);
            for (Index c = 0; c < mesh.n_cells; ++c) {
                harmorph::Cell const cell = mesh.cell(c);
                const Index* const q = cell.point;
                if (cell.n == 3) {
                    add_element(expected, setup.mesh, {q[0], q[1], q[2]}, 1);
                } else {
                    add_element(expected, setup.mesh, {q[0], q[1], q[2]}, 0.5);
                    add_element(expected, setup.mesh, {q[0], q[2], q[3]}, 0.5);
                    add_element(expected, setup.mesh, {q[0], q[1], q[3]}, 0.5);
                    add_element(expected, setup.mesh, {q[1], q[2], q[3]}, 0.5);
                }
            }
            if (change == 1) reverse_some(setup.mesh, 6);  // the sense of a cell does not matter
            Analysed const seen(setup);
            AssembledMatrix laplace(*seen.operator->());
            laplace.assemble();
            DenseMatrix const found = laplace.unknowns();
            double worst = 0;
            for (std::size_t i = 0; i < found.n; ++i) {
                std::size_t const p = std::size_t(laplace.point_at(Index(i)));
                for (std::size_t j = 0; j < found.n; ++j) {
                    std::size_t const q = std::size_t(laplace.point_at(Index(j)));
                    worst = std::fmax(worst, std::fabs(found.at(i, j) - expected.at(p, q)));
                }
            }
            CHECK(worst < 1e-13);
        }
}

TEST_CASE("the matrix is positive definite with one known value on distorted and thin cells") {
    for (Cells const kind : kinds)
        for (double const thin : {1.0, 1e-3}) {
            Case setup;
            setup.mesh = square(8, kind);
            perturb(setup.mesh, 0.4, 7);
            for (double& y : setup.mesh.y) y *= thin;
            setup.curves = polyline({{0, 0}, {1, 0}, {1, thin}, {0, thin}});
            setup.put_on_curves(bottom);
            for (std::int32_t const side : {right, top, left}) setup.set_free(side);
            Analysed const seen(setup);
            AssembledMatrix laplace(*seen.operator->());
            laplace.assemble();
            DenseMatrix a = laplace.unknowns();
            CHECK(a.n == 72);
            CHECK(a.factor());
        }
}
