// The direct engine against dense Cholesky, and its residual on meshes of every kind.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>
#include <fixtures/traps.hpp>

#include <limits>

using namespace fixtures;
using harmorph::Index;

namespace {

// Solutions with a dense matrix, function by function: A F = -couplings N.
void check_against_dense(Case& setup, double tolerance) {
    Solved const solved(setup);
    harmorph::Analysis const& analysis = inside(solved.analysis);
    AssembledMatrix laplace(analysis);
    laplace.assemble();
    DenseMatrix a = laplace.unknowns();
    REQUIRE(a.factor());
    double worst = 0;
    for (Index i = 0; i < solved.report.functions; ++i) {
        std::vector<double> const found = solved.values(i);
        auto const on_wall = [&](Index slot) {
            return found[static_cast<std::size_t>(analysis.wall().point[slot])];
        };
        std::vector<double> b = laplace.couplings_times(on_wall);
        for (double& value : b) value = -value;
        std::vector<double> const expected = a.solve(b);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            double const error =
                std::fabs(found[static_cast<std::size_t>(laplace.point_at(static_cast<Index>(k)))] -
                          expected[k]);
            if (!(error <= worst)) worst = error;
        }
    }
    INFO(a.n << " unknowns");
    CHECK(worst < tolerance);
    CHECK(solved.report.unknowns == static_cast<Index>(a.n));
}

}  // namespace

TEST_CASE("small meshes of every kind: the same as dense Cholesky") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case tiny = tiny_case();
        check_against_dense(tiny, 1e-14);
        for (int const n_r : {2, 3, 7, 12}) {  // from a single leaf to several levels of separators
            Case setup = ring_case(n_r, 5 * n_r, 0.5, 2, kind, 2, 5);
            check_against_dense(setup, 1e-13);
        }
        Case two = two_body_case(kind, 8, 5);
        check_against_dense(two, 1e-13);
        Case with_free = ring_case(7, 30, 0.5, 2, kind);
        with_free.set_free(far_field);  // then every sum of functions is 1
        perturb(with_free.mesh, 0.3, 2);
        Solved const solved(with_free);
        // nothing is fixed: constants are known from the wall alone
        for (double const sum : solved.sum()) CHECK(std::fabs(sum - 1) < 1e-12);
        check_against_dense(with_free, 1e-12);
    }
}

TEST_CASE("any number of right-hand sides: 2 to 40, and more than a block of them") {
    for (int const n : {2, 3, 7, 8, 9, 16, 17, 31, 40, 130}) {
        Case setup = ring_case(6, n > 40 ? 150 : 48, 0.5, 2, Cells::hybrid, 1, n);
        Solved const solved(setup);
        CHECK(solved.report.functions == n);
        CHECK(solved.report.residual < 1e-13);
        CHECK(solved.report.partition_defect < 1e-15);
        CHECK(largest_difference(solved.sum(), Solved(setup).sum()) == 0);
    }
}

TEST_CASE("residuals stay at rounding on viscous meshes with sharp and with blunt trailing edges") {
    for (double const first : {1e-3, 1e-5})
        for (bool const blunt : {false, true}) {
            Naca4 naca;
            naca.blunt = blunt;
            HybridOptions options;
            options.first = first;
            options.layers = first < 1e-4 ? 30 : 12;
            options.fan = blunt ? 0 : 2;
            Case setup = airfoil_case();
            setup.mesh = hybrid_mesh(naca4(naca, 60), options);
            Solved const solved(setup);
            INFO(setup.mesh.n_points() << " points, residual " << solved.report.residual);
            CHECK(solved.report.residual < 1e-12);
            CHECK(solved.report.factor_entries > solved.report.unknowns);
        }
}

TEST_CASE("two parts that are not joined are solved side by side") {
    Case setup = tiny_case(), alone = setup;
    std::int32_t const first = setup.mesh.n_points();
    for (std::int32_t k = 0; k < first; ++k)
        setup.mesh.add_point({setup.mesh.point(k).x + 20, setup.mesh.point(k).y});
    for (std::size_t k = 0, n = setup.mesh.cells.size(); k < n; ++k)
        setup.mesh.cells.push_back(setup.mesh.cells[k] + first);
    for (std::size_t k = 1, n = setup.mesh.cell_start.size(); k < n; ++k)
        setup.mesh.cell_start.push_back(setup.mesh.cell_start[n - 1] + setup.mesh.cell_start[k]);
    for (std::size_t k = 0, n = setup.mesh.face_markers.size(); k < n; ++k)
        setup.mesh.add_face(setup.mesh.faces[2 * k] + first, setup.mesh.faces[2 * k + 1] + first,
                            setup.mesh.face_markers[k] == body ? second_body : far_field);
    setup.curves.add(polyline({{22, 2}, {24, 2}, {24, 4}, {22, 4}}));
    setup.put_on_curves(second_body, 1);
    Solved const both(setup), one(alone);
    for (std::int32_t i = 0; i < 4; ++i) {
        std::vector<double> const f = both.values(i), g = both.values(4 + i),
                                  expected = one.values(i);
        std::size_t const n = static_cast<std::size_t>(first);
        CHECK(largest_difference({f.begin(), f.begin() + first}, expected) < 1e-14);
        CHECK(largest_difference({g.begin() + first, g.end()}, expected) < 1e-14);
        for (std::size_t k = 0; k < n; ++k) {
            CHECK(f[n + k] == 0);
            CHECK(g[k] == 0);
        }
    }
}

namespace {

double largest_error(FrontalSystem const& system, std::vector<double> const& sides,
                     std::vector<double> const& found, ComplexDenseMatrix const& factored,
                     Index width) {
    double worst = 0;
    for (Index i = 0; i < width; ++i) {
        std::vector<std::complex<double>> b;
        for (std::size_t k = 0; k < system.assembled.size(); ++k)
            b.push_back(system.entry(sides, k, static_cast<std::size_t>(i)));
        b = factored.solve(b);
        for (std::size_t k = 0; k < b.size(); ++k) {
            double const error =
                std::abs(system.entry(found, k, static_cast<std::size_t>(i)) - b[k]);
            if (!(error <= worst)) worst = error;
        }
    }
    return worst;
}

// For an analysis with several lanes.
struct Threads {
    Backwards order;
    hm_executor executor;
    Options options{};

    explicit Threads(Index n) : executor(order.executor(n)) { options.executor = &executor; }
};

}  // namespace

TEST_CASE("targets: where the positions of a border are in the parent's front") {
    Case setup = ring_case(12, 60, 0.5, 2, Cells::triangles);
    Solved const solved(setup);
    FrontalSystem const system(inside(solved.analysis), false, 2);
    harmorph::Multifrontal const& engine = system.engine;
    Index wrong = 0, checked = 0;
    for (Index node = 0; node < engine.tree.count; ++node) {
        Index const parent = engine.tree.nodes[node].parent;
        if (parent == harmorph::none) continue;
        Index const pivots = engine.pivots_of(parent);
        for (Index k = 0; k < engine.border_of(node).count(); ++k, ++checked) {
            Index const target = engine.targets_of(node)[k];
            Index const found = target < pivots ? engine.tree.nodes[parent].begin + target
                                                : engine.border_of(parent)[target - pivots];
            if (found != engine.border_of(node)[k]) ++wrong;
        }
    }
    CHECK(checked > 500);
    CHECK(wrong == 0);
}

TEST_CASE("Hermitian matrices have the solutions of dense Cholesky") {
    for (Cells const kind : {Cells::quads, Cells::triangles})
        for (int const n_r : {3, 9})
            for (Index const threads : {1, 3}) {
                Case setup = ring_case(n_r, 5 * n_r, 0.5, 2, kind, 2, 5);
                for (Index const width : {1, 8, 11}) {
                    Threads const lanes(threads);
                    Analysed const seen(setup, &lanes.options);
                    FrontalSystem system(*seen.operator->(), true, width);
                    system.randomise(7, 0.8);
                    ComplexDenseMatrix dense = system.assembled.complex_unknowns();
                    REQUIRE(dense.factor());
                    system.factorise();
                    std::vector<double> const sides = system.some_sides();
                    std::vector<double> found = sides;
                    system.solve(found);
                    double const error = largest_error(system, sides, found, dense, width);
                    INFO(dense.n << " unknowns, " << threads << " threads, " << width << " sides");
                    CHECK(error < 1e-13);
                }
            }
}

TEST_CASE("right-hand sides of one number pass over most of the tree, wherever the number is") {
    for (Index const threads : {1, 3})
        for (bool const complex : {false, true}) {
            Case setup = ring_case(6, 30, 0.5, 2, Cells::hybrid, 2, 5);
            Threads const lanes(threads);
            Analysed const seen(setup, &lanes.options);
            Index const width = 3;
            FrontalSystem system(*seen.operator->(), complex, width);
            system.randomise(9, complex ? 0.8 : 0);
            ComplexDenseMatrix dense(system.assembled.size());
            if (complex) dense = system.assembled.complex_unknowns();
            else
                std::copy_n(system.assembled.unknowns().entries.begin(), dense.entries.size(),
                            dense.entries.begin());
            REQUIRE(dense.factor());
            system.factorise();
            std::size_t const n = dense.n, length = static_cast<std::size_t>(system.row_length());
            double worst = 0;
            for (std::size_t at = 0; at < n;
                 ++at) {  // of three sides two are apart, and one has nothing at all
                std::vector<double> sides(n * length, 0.0);
                sides[at * length] = 1;
                sides[(n - 1 - at) * length + length - 1] = -2;
                std::vector<double> found = sides;
                system.solve(found);
                worst = std::fmax(worst, largest_error(system, sides, found, dense, width));
                for (std::size_t k = 0; k < n; ++k)
                    worst = std::fmax(worst, std::fabs(found[k * length + 1]));
            }
            INFO(threads << " threads, complex " << complex);
            CHECK(worst < 1e-13);
            std::vector<double> nothing(n * length, 0.0);
            system.solve(nothing);
            CHECK(nothing == std::vector<double>(n * length, 0.0));
        }
}

TEST_CASE("right-hand sides that are not finite are told from zeros") {
    Untrapped const untrapped;
    for (Index const threads : {1, 3})
        for (double const bad :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            Case setup = ring_case(9, 45, 0.5, 2, Cells::hybrid, 2, 5);
            Threads const lanes(threads);
            Analysed const seen(setup, &lanes.options);
            FrontalSystem system(*seen.operator->(), false, 1);
            system.randomise(9, 0);
            system.factorise();
            std::size_t const n = system.assembled.size();
            for (std::size_t const at : {std::size_t{0}, n / 2, n - 1}) {
                std::vector<double> values(n, 0.0);
                values[at] = bad;
                system.solve(values);
                for (double const value : values) CHECK_FALSE(std::isfinite(value));
            }
        }
}

TEST_CASE("without circulation the complex engine gives the real one's answer") {
    Case setup = ring_case(12, 60, 0.5, 2, Cells::hybrid, 2, 5);
    {
        Analysed const seen(setup);
        FrontalSystem complex(*seen.operator->(), true, 9), real(*seen.operator->(), false, 18);
        complex.randomise(3, 0);
        real.randomise(3, 0);
        complex.factorise();
        real.factorise();
        // Real and imaginary parts: twice as many sides.
        std::vector<double> found = complex.some_sides(), expected = found;
        complex.solve(found);
        real.solve(expected);
        CHECK(largest_difference(found, expected) < 1e-14);
    }
}

TEST_CASE("a complex system is the real one of twice the size, [[a, -b], [b, a]]") {
    Case setup = ring_case(6, 30, 0.5, 2, Cells::triangles, 2, 5);
    Analysed const seen(setup);
    FrontalSystem system(*seen.operator->(), true, 1);
    system.randomise(11, 1.5);
    ComplexDenseMatrix const a = system.assembled.complex_unknowns();
    std::size_t const n = a.n;
    DenseMatrix twice(2 * n);
    std::vector<double> sides = system.some_sides(), b(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            twice.at(i, j) = twice.at(n + i, n + j) = a.at(i, j).real();
            twice.at(n + i, j) = a.at(i, j).imag();
            twice.at(i, n + j) = -a.at(i, j).imag();
        }
        b[i] = sides[2 * i];
        b[n + i] = sides[2 * i + 1];
    }
    REQUIRE(twice.factor());
    b = twice.solve(b);
    system.factorise();
    system.solve(sides);
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i)
        worst = std::fmax(worst, std::fmax(std::fabs(sides[2 * i] - b[i]),
                                           std::fabs(sides[2 * i + 1] - b[n + i])));
    CHECK(worst < 1e-13);
}

TEST_CASE("a Hermitian matrix that is not positive definite is refused, by position") {
    Case setup = ring_case(8, 40, 0.5, 2, Cells::triangles, 2, 5);
    for (Index const threads : {1, 3}) {
        for (Index const bad : {0, 17, 100, 250}) {
            Threads const lanes(threads);
            Analysed const seen(setup, &lanes.options);
            FrontalSystem system(*seen.operator->(), true, 4);
            system.randomise(5, 0.5);
            harmorph::Matrix& matrix = system.assembled.matrix;
            matrix.row_sum[bad] -= matrix.diagonal[bad] + 1;
            harmorph::Fault fault;
            CHECK(system.engine.factorise(matrix, harmorph::Progress{}, fault) ==
                  harmorph::Status::not_positive);
            CHECK(fault.item.number == bad);
        }
    }
}

TEST_CASE("of several pivots that are not positive the first is told, for any number of threads") {
    Case setup = ring_case(20, 120, 0.5, 2, Cells::triangles, 2, 5);
    for (Index const threads : {1, 2, 3, 5, 8}) {
        Threads lanes(threads);
        Analysed const seen(setup, &lanes.options);
        FrontalSystem system(*seen.operator->(), true, 4);
        Index const n = system.assembled.matrix.n;
        std::vector<Index> places{0, n - 1};  // and some of each front
        for (Index node = 0; node < seen->tree().count; node += 1 + seen->tree().count / 24)
            places.push_back(seen->tree().nodes[node].begin);
        std::sort(places.begin(), places.end());
        for (Index const first : places) {
            for (Index const second : places) {
                if (second < first) continue;
                system.randomise(5, 0.5);
                harmorph::Matrix& matrix = system.assembled.matrix;
                for (Index const bad : {first, second})
                    matrix.row_sum[bad] -= matrix.diagonal[bad] + 1;
                harmorph::Fault fault;
                CHECK(system.engine.factorise(matrix, harmorph::Progress{}, fault) ==
                      harmorph::Status::not_positive);
                INFO(threads << " threads, pivots " << first << " and " << second);
                CHECK(fault.item.number == first);
            }
        }
    }
}
