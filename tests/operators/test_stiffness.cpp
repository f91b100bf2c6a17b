// The compact scheme against the cotangents of each cell's triangles, and the cell that is named
// where one is inverted.
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/matrices.hpp>
#include <fixtures/wrong.hpp>

#include "mesh/cell_shape.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Vec2;

namespace {

// Adds `weight` times the stiffness matrix of linear finite elements on the triangle, by points.
void add_triangle(DenseMatrix& to, harmorph::Points points, Index const (&corner)[3],
                  double weight) {
    for (int apex = 0; apex < 3; ++apex) {
        Index const p = corner[apex], a = corner[(apex + 1) % 3], b = corner[(apex + 2) % 3];
        Vec2 const u = points[a] - points[p], v = points[b] - points[p];
        double const conductance = 0.5 * weight * dot(u, v) / cross(u, v);
        std::size_t const i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        to.at(i, i) += conductance;
        to.at(j, j) += conductance;
        to.at(i, j) -= conductance;
        to.at(j, i) -= conductance;
    }
}

DenseMatrix of_finite_elements(harmorph::Mesh const& mesh,
                               std::vector<double> const& conductivity) {
    DenseMatrix out(static_cast<std::size_t>(mesh.n_points));
    for (Index i = 0; i < mesh.n_cells; ++i) {
        harmorph::Cell const cell = mesh.cell(i);
        double const k = conductivity[static_cast<std::size_t>(i)];
        for (int corner = 0; corner < (cell.n == 3 ? 1 : 4);
             ++corner) {  // both splits of a quad, each by half
            Index const triangle[] = {cell.previous(corner), cell.point[corner], cell.next(corner)};
            add_triangle(out, mesh.points, triangle, cell.n == 3 ? k : 0.5 * k);
        }
    }
    return out;
}

}  // namespace

TEST_CASE("the matrix is the sum of the cotangents of all triangles and of both splits of quads") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        for (int const n :
             {5, 6, 9}) {  // groups of cells are full, or odd, or one cell is left over
            Case setup = square_on_curve(n, kind, 0.2, 7);
            Analysed const seen(setup);
            harmorph::Mesh const mesh = core_mesh(setup.mesh);
            std::mt19937 random(3);
            std::vector<double> k(static_cast<std::size_t>(mesh.n_cells));
            for (double& one : k) one = std::exp(uniform(random));
            AssembledMatrix assembled(*seen.operator->());
            Index const bad = assemble_stiffness(seen->topology(), mesh.points, span(k), false,
                                                 assembled.matrix, {});
            REQUIRE(bad == harmorph::none);
            DenseMatrix const expected = of_finite_elements(mesh, k), found = assembled.unknowns();
            Wrong entries, sums;
            for (std::size_t i = 0; i < assembled.size(); ++i) {
                std::size_t const p =
                    static_cast<std::size_t>(assembled.point_at(static_cast<Index>(i)));
                double const scale = expected.at(p, p);
                double known = 0;  // the row sum is what the columns of known values take
                for (std::size_t q = 0; q < static_cast<std::size_t>(mesh.n_points); ++q)
                    known -= seen->graph().unknown[q] == harmorph::none ? expected.at(p, q) : 0;
                double const sum = assembled.matrix.row_sum[i];
                sums.add(std::fabs(sum - known) > 1e-13 * scale, static_cast<Index>(i), sum);
                for (std::size_t j = 0; j < assembled.size(); ++j) {
                    std::size_t const q =
                        static_cast<std::size_t>(assembled.point_at(static_cast<Index>(j)));
                    double const error = std::fabs(found.at(i, j) - expected.at(p, q));
                    entries.add(error > 1e-13 * scale, static_cast<Index>(i), error);
                }
            }
            CHECK(entries == 0);
            CHECK(sums == 0);
        }
    }
}

TEST_CASE("the first cell without positive area is returned, wherever it lies among the others") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = square_on_curve(7, kind, 0.1, 5);
        Analysed const seen(setup);
        AssembledMatrix assembled(*seen.operator->());
        std::size_t n_inverted = 0;
        for (std::size_t point = 0; point < setup.mesh.x.size(); ++point) {
            double const before = setup.mesh.x[point];
            for (double const moved : {before - 3, before + 3}) {
                setup.mesh.x[point] = moved;
                harmorph::Mesh const mesh = core_mesh(setup.mesh);
                Index const first = mesh.find_cell([&](Index, harmorph::Cell const& cell) {
                    return is_inverted(harmorph::CellShape(cell, mesh.points, false));
                });
                n_inverted += first != harmorph::none ? 1 : 0;
                CHECK(assemble_stiffness(seen->topology(), mesh.points, {}, false, assembled.matrix,
                                         {}) == first);
            }
            setup.mesh.x[point] = before;
        }
        CHECK(n_inverted > setup.mesh.x.size());  // of twice as many movements
    }
}

TEST_CASE("of several inverted cells the first is returned, for any number of threads") {
    Case setup = square_on_curve(131, Cells::hybrid, 0.1, 5);  // four ranges of rows
    Analysed const seen(setup);
    AssembledMatrix assembled(*seen.operator->());
    std::size_t const n = setup.mesh.x.size();
    for (std::size_t const first : {n / 9, n / 2, n - n / 9}) {
        for (std::size_t const second : {n / 7, n - n / 7}) {
            std::vector<double> const before = setup.mesh.x;
            setup.mesh.x[first] += 3;
            setup.mesh.x[second] -= 3;
            harmorph::Mesh const mesh = core_mesh(setup.mesh);
            Index const expected = mesh.find_cell([&](Index, harmorph::Cell const& cell) {
                return is_inverted(harmorph::CellShape(cell, mesh.points, false));
            });
            REQUIRE(expected != harmorph::none);
            for (Index const threads : {1, 2, 3, 4}) {
                Backwards order;
                harmorph::Executor const executor{Backwards::run, &order, threads};
                harmorph::Matrix const& matrix = assembled.matrix;
                Index const found =
                    assemble_stiffness(seen->topology(), mesh.points, {}, false, matrix, executor);
                INFO(threads << " threads, points " << first << " and " << second);
                CHECK(found == expected);
                if (threads > 1) CHECK(order.tasks == threads);
            }
            setup.mesh.x = before;
        }
    }
}
