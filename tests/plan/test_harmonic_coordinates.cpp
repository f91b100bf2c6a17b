// Classical harmonic coordinates: degree 1 on polygonal cages, positions instead of displacements:
// X = sum_i F_i P_i. (P. Joshi et al., Harmonic coordinates for character articulation, ACM Trans.
// Graph. 26 (2007) 71.)
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/solved.hpp>

using namespace fixtures;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// Unit square with a square hole: a cage round it, with further corners on two sides, and another
// one round the hole.
Case cages(int n, Cells kind, double perturbed) {
    Case out;
    out.mesh = square(n, kind, n / 3, n / 3);
    if (perturbed > 0) perturb(out.mesh, perturbed, 5);
    out.curves.add(polyline({{0, 0}, {1.0 / 3, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2.0 / 3}}));
    out.curves.add(
        polyline({{1.0 / 3, 1.0 / 3}, {2.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3}, {1.0 / 3, 2.0 / 3}}));
    for (std::int32_t const side : {bottom, right, top, left}) out.put_on_curves(side, 0);
    out.put_on_curves(body, 1);
    return out;
}

// Cell lists keep those cells that are not in the upper right quarter: an L with a cage of six
// corners.
Case l_shape(int n, Cells kind) {
    Mesh const whole = square(2 * n, kind);
    Case out;
    std::vector<std::int32_t> new_of(whole.x.size(), -1);
    for (std::size_t k = 0; k < whole.x.size(); ++k) {
        if (whole.x[k] <= 0.5 || whole.y[k] <= 0.5)
            new_of[k] = out.mesh.add_point(whole.point(std::int32_t(k)));
    }
    for (std::size_t cell = 0; cell + 1 < whole.cell_start.size(); ++cell) {
        std::vector<std::int32_t> corners;
        double x = 0, y = 0;
        for (std::int32_t k = whole.cell_start[cell]; k < whole.cell_start[cell + 1]; ++k) {
            std::size_t const point = std::size_t(whole.cells[std::size_t(k)]);
            corners.push_back(new_of[point]);
            x += whole.x[point];
            y += whole.y[point];
        }
        double const size = double(corners.size());
        if (x > 0.5 * size && y > 0.5 * size) continue;
        out.mesh.cells.insert(out.mesh.cells.end(), corners.begin(), corners.end());
        out.mesh.cell_start.push_back(std::int32_t(out.mesh.cells.size()));
    }
    auto const id = [&](int i, int j) { return new_of[std::size_t(j * (2 * n + 1) + i)]; };
    for (int k = 0; k < 2 * n; ++k) {
        int const edge = k < n ? 2 * n : n;  // how far the L reaches
        out.mesh.add_face(id(k, 0), id(k + 1, 0), body);
        out.mesh.add_face(id(0, k + 1), id(0, k), body);
        out.mesh.add_face(id(edge, k), id(edge, k + 1), body);
        out.mesh.add_face(id(k + 1, edge), id(k, edge), body);
    }
    out.curves = polyline({{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}});
    out.put_on_curves(body);
    return out;
}

struct Affine {
    double a, b, c, d, x, y;
    std::vector<double> mapped(std::vector<double> const& control) const {
        std::vector<double> out;
        for (std::size_t k = 0; k < control.size(); k += 2) {
            out.push_back(a * control[k] + b * control[k + 1] + x);
            out.push_back(c * control[k] + d * control[k + 1] + y);
        }
        return out;
    }
};

// Largest distance of the mesh's points, moved affinely, from the sum over the cage that was moved
// affinely.
double affine_error(Solved const& solved, Case const& setup, Affine const& map) {
    // X = sum_i F_i P_i: with positions for movements, and without coordinates.
    Moved const found = displaced(solved.basis, map.mapped(setup.curves.control));
    double worst = 0;
    for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
        std::vector<double> const to = map.mapped({setup.mesh.x[k], setup.mesh.y[k]});
        worst = std::fmax(worst, distance({found.x[k], found.y[k]}, {to[0], to[1]}));
    }
    return worst;
}

constexpr Affine maps[] = {{1, 0, 0, 1, 0, 0},
                           {0, -1, 1, 0, 2, -3},
                           {1, 0.7, 0, 1, 0, 0},
                           {-2, 0.5, 0.3, 0.1, 0, 1},
                           {0, 0, 0, 0, 5, 4}};

}  // namespace

TEST_CASE("affine maps of a cage are affine maps of the inside, also with holes") {
    for (Cells const kind : kinds) {
        for (Case setup : {cages(12, kind, 0), cages(15, kind, 0.25), l_shape(6, kind)}) {
            Solved const solved(setup);
            for (Affine const& map : maps) CHECK(affine_error(solved, setup, map) < 1e-13);
        }
    }
}

TEST_CASE("coordinates are 1 or 0 at corners of the cage, linear on edges, and sum up to 1") {
    for (Case setup : {cages(12, Cells::quads, 0), l_shape(6, Cells::triangles)}) {
        Solved const solved(setup);
        std::vector<double> const& control = setup.curves.control;
        CHECK(largest_difference(solved.sum(), std::vector<double>(setup.mesh.x.size(), 1.0)) <
              1e-14);
        for (std::int32_t i = 0; i < setup.curves.n_control(); ++i) {
            std::vector<double> const f = solved.values(i);
            for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
                CHECK(f[k] >= 0);
                CHECK(f[k] <= 1);
                for (std::int32_t j = 0; j < setup.curves.n_control(); ++j) {
                    std::size_t const at = 2 * std::size_t(j);
                    if (distance(setup.mesh.point(std::int32_t(k)),
                                 {control[at], control[at + 1]}) > 1e-12)
                        continue;
                    CHECK(f[k] == doctest::Approx(i == j ? 1.0 : 0.0).epsilon(1e-13));
                }
            }
        }
    }
    Case setup =
        l_shape(6, Cells::hybrid);  // the lower side, from control point 0 at (0, 0) to 1 at (1, 0)
    Solved const solved(setup);
    std::vector<double> const first = solved.values(0), second = solved.values(1),
                              other = solved.values(4);
    int on_side = 0;
    for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
        if (setup.mesh.y[k] != 0) continue;
        CHECK(first[k] == doctest::Approx(1 - setup.mesh.x[k]).epsilon(1e-13));
        CHECK(second[k] == doctest::Approx(setup.mesh.x[k]).epsilon(1e-13));
        CHECK(other[k] == 0);
        ++on_side;
    }
    CHECK(on_side == 13);
}

TEST_CASE("a further corner in the middle of an edge takes half of its neighbours' coordinates") {
    Case setup = l_shape(6, Cells::triangles), finer = setup;
    finer.curves = polyline({{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}});
    Solved const solved(setup), finer_solved(finer);
    std::vector<double> const middle = finer_solved.values(1);
    for (std::int32_t i = 0; i < 6; ++i) {
        std::vector<double> sum = finer_solved.values(i == 0 ? 0 : i + 1);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += i < 2 ? 0.5 * middle[k] : 0;
        CHECK(largest_difference(sum, solved.values(i)) < 1e-14);
    }
}

TEST_CASE("positions and displacements are the same thing where the cage is the boundary") {
    Case setup = cages(12, Cells::hybrid, 0.2);
    Solved const solved(setup);
    std::vector<double> const move = some_move(setup.curves.n_control(), 0.05, 3);
    std::vector<double> control = setup.curves.control;
    for (std::size_t k = 0; k < control.size(); ++k) control[k] += move[k];
    Moved const places = displaced(solved.basis, control),
                to = morphed(solved.basis, setup.mesh, move);
    CHECK(largest_difference(places.x, to.x) < 1e-14);
    CHECK(largest_difference(places.y, to.y) < 1e-14);
}
