// The iterative engine: the direct engine's solutions, in a number of iterations that does not grow
// with the mesh.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/parts.hpp>
#include <fixtures/solved.hpp>
#include <fixtures/guarded.hpp>

#include "multigrid/multigrid.hpp"

#include "multigrid/multigrid_cycle.hpp"

using namespace fixtures;
using harmorph::Index;

namespace {

Options options_for(std::int32_t engine) {
    Options out{};
    out.operator_kind = HM_LAPLACE;
    out.engine = engine;
    return out;
}
Options multigrid() { return options_for(HM_MULTIGRID); }
Options direct() { return options_for(HM_DIRECT); }

Case o_mesh_case(int n_side, double first, int rings, Cells kind = Cells::quads) {
    Case out = airfoil_case(40, 12, Cells::quads);
    out.mesh = o_mesh(naca4({}, n_side), stretched(first, 8, rings), kind);
    return out;
}
// Cells as long as high.
Case even_case(int n_side) {
    double const step = 2.04 / (2 * n_side);
    return o_mesh_case(n_side, step, static_cast<int>(std::log1p(8 * 3.14 / 1.02) / 3.14 * n_side));
}

// A square of triangles that is compressed by this factor in a direction 30 degrees from its sides.
Case compressed_case(int n, double by) {
    Complex const turn = std::polar(1.0, std::acos(-1.0) / 6);
    auto const move = [&](double& x, double& y) {
        Complex const p = Complex(x, y) * turn, q = Complex(p.real(), p.imag() / by) / turn;
        x = q.real();
        y = q.imag();
    };
    Case out = square_on_curve(n, Cells::triangles, 0.3, 4);
    for (std::size_t k = 0; k < out.mesh.x.size(); ++k) move(out.mesh.x[k], out.mesh.y[k]);
    std::vector<Point> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (Point& corner : corners) move(corner.x, corner.y);
    out.curves = polyline(corners);
    return out;
}

double difference(Solved const& a, Solved const& b) {
    return largest_difference(a.all_values(), b.all_values());
}

std::vector<double> values_of(Attempt const& attempt) {
    hm_basis_info const info = info_of(attempt.basis);
    std::size_t const n = static_cast<std::size_t>(info.points);
    std::vector<double> out(n * static_cast<std::size_t>(info.functions));
    for (std::int32_t i = 0; i < info.functions; ++i)
        REQUIRE(hm_basis_values(attempt.basis, i, 0, &out[n * static_cast<std::size_t>(i)],
                                nullptr) == HM_OK);
    return out;
}

template <class Number>
std::vector<double> preconditioned(harmorph::Multigrid const& engine,
                                   std::vector<double> const& x) {
    std::vector<Number> bx(x.begin(), x.end());
    harmorph::Cycle<Number> cycle(engine, 4, reinterpret_cast<Number*>(engine.vectors.data()));
    cycle.descend(bx.data());
    cycle.ascend(bx.data(), nullptr, nullptr);
    return {bx.begin(), bx.end()};
}

// Returns A x for 4 vectors side by side.
std::vector<double> product(harmorph::SymmetricRows const& rows, std::vector<double> const& x) {
    std::vector<double> out(x.size());
    for (Index i = 0; i < rows.n; ++i)
        for (Index k = 0; k < 4; ++k) {
            std::size_t const own = 4 * std::size_t(i) + std::size_t(k);
            out[own] += rows.row_sum[i] * x[own];
            for (std::int64_t e = rows.start[i]; e < rows.start[i + 1]; ++e) {
                std::size_t const other = 4 * std::size_t(rows.column[e]) + std::size_t(k);
                double const flow = rows.value[e] * (x[other] - x[own]);
                out[own] += flow;
                out[other] -= flow;
            }
        }
    return out;
}

// B is compared with its transpose by products with random vectors. The eigenvalues of B A are at
// most 1: the energy of x is at least (A x).B (A x).
void check_preconditioner(Case setup, Index min_levels = 3) {
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    harmorph::Multigrid engine;
    harmorph::Iteration iteration;
    iteration.block_width = 8;
    auto const lay_out = [&](harmorph::Arena& arena) {
        engine.lay_out_levels(arena, front.rows.n, front.rows.entries());
        engine.lay_out(arena, front.rows.n, 4, iteration, {});
        engine.lay_out_work(arena, front.rows.n, front.rows.entries());
        engine.lay_out_vectors(arena, front.rows.n);
    };
    auto const block = laid_out(lay_out);
    harmorph::Fault fault;
    REQUIRE(engine.set_up(front.rows, {}, fault) == harmorph::Status::ok);
    REQUIRE(engine.levels.count >= min_levels);
    REQUIRE(engine.has_bottom);
    std::size_t const n = 4 * static_cast<std::size_t>(front.rows.n);
    std::vector<double> x;
    std::mt19937 random(2);
    for (std::size_t k = 0; k < n; ++k) x.push_back(2 * uniform(random) - 1);
    auto const by_b = [&](std::vector<double> const& v) {
        return engine.is_single ? preconditioned<float>(engine, v)
                                : preconditioned<double>(engine, v);
    };
    auto const dot = [&](std::vector<double> const& a, std::size_t i, std::vector<double> const& b,
                         std::size_t j) {
        double sum = 0;
        for (std::size_t k = 0; k < n; k += 4) sum += a[k + i] * b[k + j];
        return sum;
    };
    std::vector<double> const bx = by_b(x), ax = product(front.rows, x), bax = by_b(ax);
    double const rounding = engine.is_single ? 1e-4 : 1e-10;
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(dot(x, i, bx, i) > 0);
        CHECK(dot(ax, i, bax, i) <= (1 + rounding) * dot(x, i, ax, i));
        for (std::size_t j = 0; j < i; ++j)
            CHECK(dot(x, i, bx, j) == doctest::Approx(dot(x, j, bx, i)).epsilon(rounding));
    }
    CHECK(block->guards_intact());
}

}  // namespace

TEST_CASE("multigrid finds the functions of the direct engine on every kind of mesh") {
    for (int which = 0; which < 9; ++which) {
        Case setup = which < 3    ? two_body_case(static_cast<Cells>(which), 16, 10)
                     : which == 3 ? airfoil_case()
                     : which == 4 ? o_mesh_case(60, 1e-5, 40)
                     : which == 5 ? o_mesh_case(60, 1e-6, 40, Cells::triangles)
                     : which == 6 ? ring_case(16, 64, 0.5, 2)
                                  : airfoil_case();
        if (which == 1) setup.set_free(far_field);
        if (which == 7) setup.mesh = c_mesh(naca4({}, 30), 12, 4, stretched(1e-3, 4, 24)).mesh;
        // Couplings differ by 1e12.
        if (which == 8) setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-5, 60, 48)).mesh;
        Options iterative = multigrid(), exact = direct();
        if (which == 2) iterative.operator_kind = exact.operator_kind = HM_WEIGHTED;
        Solved const found(setup, &iterative), expected(setup, &exact);
        INFO("case " << which << ": " << found.report.iterations << " iterations to "
                     << found.report.residual);
        CHECK(difference(found, expected) < 2e-9);
        CHECK(found.report.residual <= 1e-10);
        CHECK(found.report.iterations > 1);
        CHECK(found.report.iterations <= 30);
        CHECK(found.report.levels >= 2);
        CHECK(found.report.factor_entries == 0);
        CHECK(found.report.refinements == 0);
        CHECK(found.report.boundary_error == 0);
    }
}

TEST_CASE("multigrid finds the conformal functions of the direct engine") {
    for (int which = 0; which < 7; ++which) {
        Case setup = which < 3    ? two_body_case(static_cast<Cells>(which), 16, 10)
                     : which == 3 ? o_mesh_case(60, 1e-6, 40, Cells::triangles)
                     : which == 4 ? ring_case(16, 64, 0.5, 2)
                     : which == 5 ? even_case(40)
                                  : airfoil_case();
        if (which == 6) setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-5, 60, 48)).mesh;
        for (double const exponent : {-1.0, 1.0, 1.5, 2.0, 4.0}) {
            Options iterative = multigrid(), exact = direct();
            iterative.operator_kind = exact.operator_kind = HM_CONFORMAL;
            iterative.exponent = exact.exponent = exponent;
            Solved const found(setup, &iterative), expected(setup, &exact);
            INFO("case " << which << ", exponent " << exponent << ": " << found.report.iterations
                         << " iterations to " << found.report.residual);
            double largest = 0;
            for (double const value : expected.all_values())
                largest = std::max(largest, std::fabs(value));
            CHECK(difference(found, expected) < 2e-9 * largest);
            CHECK(found.report.residual <= 1e-10);
            CHECK(found.report.iterations <= (exponent < 4 ? 40 : 60));
        }
    }
}

TEST_CASE("multigrid finds the functions of the direct engine for points that slide") {
    for (int which = 0; which < 5; ++which) {
        Case setup = which < 3    ? similar(two_body_case(static_cast<Cells>(which), 16, 10),
                                            std::polar(1.0, 0.8 * which), 0)
                     : which == 3 ? ring_case(16, 64, 0.5, 2, Cells::hybrid)
                                  : o_mesh_case(60, 1e-5, 40);
        setup.set_slip(far_field);
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_WEIGHTED}) {
            Options iterative = multigrid(), exact = direct();
            iterative.operator_kind = exact.operator_kind = operator_kind;
            Solved const found(setup, &iterative), expected(setup, &exact);
            INFO("case " << which << ": " << found.report.iterations << " iterations to "
                         << found.report.residual);
            std::vector<double> const move = some_move(found.report.functions, 1, 3);
            CHECK(largest_difference(displacement(found, move), displacement(expected, move)) <
                  2e-9);
            CHECK(found.report.residual <= 1e-10);
            CHECK(found.report.iterations <= 30);
            CHECK(found.report.levels >= 2);
        }
    }
}

TEST_CASE("walls along which points slip, on opposite sides, take no more iterations than fixed") {
    Options options = multigrid();
    for (bool const periodic : {false, true}) {
        Case slipping = slip_channel(60, periodic), fixed = slipping;
        fixed.conditions.resize(1);
        Solved const found(slipping, &options), other(fixed, &options);
        INFO(found.report.iterations << " and " << other.report.iterations << " iterations");
        CHECK(found.report.iterations <= other.report.iterations + 3);
    }
}

TEST_CASE("it converges on C-meshes of few columns and thin cells, however the far field is cut") {
    for (double const first : {1e-4, 1e-5, 1e-6, 1e-8})
        for (double const far : {60.0, 500.0})
            for (int const n_wake : {10, 18, 40}) {
                Case setup = airfoil_case(20, 12, Cells::quads);
                setup.mesh = c_mesh(naca4({}, 30), n_wake, far * 2 / 3,
                                    stretched(first, far, n_wake == 40 ? 80 : 60))
                                 .mesh;
                Options iterative = multigrid(), exact = direct();
                Solved const found(setup, &iterative), expected(setup, &exact);
                INFO("first cell " << first << ", far field " << far << ", wake " << n_wake << ": "
                                   << found.report.iterations);
                CHECK(difference(found, expected) < 1e-8);
                CHECK(found.report.iterations <= 30);
            }
}

TEST_CASE("a function's bits do not depend on which others are solved with it") {
    Case setup = airfoil_case(20, 12, Cells::quads);
    setup.mesh = c_mesh(naca4({}, 30), 10, 300, stretched(1e-5, 500, 48)).mesh;
    Options options = multigrid();
    Solved const all(setup, &options);
    for (std::int32_t const width : {4, 16}) {
        options.block_width = width;
        CHECK(same_bits(Solved(setup, &options).all_values(), all.all_values()));
    }
    for (std::int32_t const width : {1, 5})
        CHECK(same_bits(values_in_shares(all, width), all.all_values()));
}

TEST_CASE("multigrid needs at most 20 iterations on even cells, 30 on stretched cells") {
    Options options = multigrid();
    std::int32_t smallest = 1000;
    for (int const n_side : {20, 40, 80, 120}) {
        Case setup = even_case(n_side);
        Solved const solved(setup, &options);
        INFO(setup.mesh.n_points() << " points: " << solved.report.iterations);
        CHECK(solved.report.iterations <= 20);
        smallest = std::min(smallest, solved.report.iterations);
        CHECK(solved.report.iterations <= smallest + 4);
    }
    for (double const first : {1e-5, 1e-6})
        for (int const n_side : {40, 100}) {
            Case setup = o_mesh_case(n_side, first, 2 * n_side / 3,
                                     n_side == 40 ? Cells::hybrid : Cells::quads);
            Solved const solved(setup, &options);
            INFO(setup.mesh.n_points() << " points: " << solved.report.iterations);
            CHECK(solved.report.iterations <= 30);
        }
}

TEST_CASE("triangles stretched across the lines of the mesh need at most 24 iterations") {
    for (double const by : {10.0, 1000.0})
        for (int const n : {30, 100}) {
            Case setup = compressed_case(n, by);
            Options iterative = multigrid(), exact = direct();
            Solved const found(setup, &iterative), expected(setup, &exact);
            INFO("compressed by " << by << ", " << setup.mesh.n_points()
                                  << " points: " << found.report.iterations);
            CHECK(difference(found, expected) < 2e-9);
            CHECK(found.report.iterations <= (n == 30 ? 17 : 24));
        }
}

TEST_CASE("the sum of the functions is 1 for thin cells if no point has the value 0") {
    for (double const first : {1e-5, 1e-9}) {
        Case setup = airfoil_case(40, 12, Cells::quads);
        setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(first, 60, 60)).mesh;
        setup.set_free(far_field);
        Options options = multigrid();
        Solved const solved(setup, &options);
        std::vector<double> const values = solved.all_values();
        std::size_t const n = setup.mesh.x.size();
        double worst = 0;
        for (std::size_t point = 0; point < n; ++point) {
            double sum = -1;
            for (std::size_t k = point; k < values.size(); k += n) sum += values[k];
            worst = std::max(worst, std::fabs(sum));
        }
        INFO("first cell " << first << ", " << solved.report.iterations << " iterations");
        CHECK(worst < 3e-9);
        CHECK(solved.report.iterations <= 30);
    }
}

TEST_CASE("without coarser levels it takes many times as many iterations") {
    Options options = multigrid();
    options.max_iterations = 2000;
    Case setup = even_case(80);
    Solved const all(setup, &options);
    options.levels = 1;
    Solved const one(setup, &options);
    CHECK(one.report.levels == 1);
    CHECK(all.report.levels >= 4);
    CHECK(one.report.iterations > 4 * all.report.iterations);
    CHECK(difference(one, all) < 1e-7);
}

TEST_CASE("a limit of iterations ends with a status that says so, and with what there is") {
    Case setup = airfoil_case();
    Options options = multigrid();
    double last = 1;
    for (std::int32_t const limit : {1, 3, 5, 7}) {
        options.max_iterations = limit;
        Attempt const attempt(setup.problem(), &options);
        CHECK(attempt.status == HM_NOT_CONVERGED);
        CHECK(std::string(attempt.error.text).find("has the relative residual") !=
              std::string::npos);
        CHECK(attempt.report.iterations == limit);
        CHECK(attempt.report.residual > 1e-10);
        CHECK(attempt.report.residual < last);
        last = attempt.report.residual;
    }
}

TEST_CASE("the history begins at 1 and ends with the report's residual, at the tolerance") {
    Case setup = two_body_case(Cells::hybrid, 16, 10);
    for (double const tolerance : {1e-4, 1e-10}) {
        std::vector<double> history(60, -1.0);
        Options options = multigrid();
        options.tolerance = tolerance;
        options.history = history.data();
        options.history_length = static_cast<std::int32_t>(history.size());
        Solved const solved(setup, &options);
        std::size_t const n = static_cast<std::size_t>(solved.report.iterations);
        REQUIRE(n + 1 < history.size());
        CHECK(history[0] == doctest::Approx(1).epsilon(1e-12));
        CHECK(history[n] <= tolerance);
        CHECK(history[n] == doctest::Approx(solved.report.residual).epsilon(1e-3));
        for (std::size_t k = n + 1; k < history.size(); ++k) CHECK(history[k] == 0);
        options.history_length = 3;  // what does not fit is left out
        history.assign(60, -1.0);
        Solved const again(setup, &options);
        CHECK(history[2] > 0);
        CHECK(history[3] == -1);
    }
}

TEST_CASE("blocks of any width give the same functions, and threads the same bits") {
    Case setup = two_body_case(Cells::hybrid, 16, 10);  // 20 functions
    Options options = multigrid();
    options.block_width = 4;
    Solved const four(setup, &options);
    for (std::int32_t const width : {8, 16}) {
        options.block_width = width;
        Solved const wide(setup, &options);
        CHECK(difference(four, wide) < 1e-9);
    }
    options.block_width = 4;
    for (std::int32_t const threads : {2, 3, 16}) {
        Backwards backwards;
        hm_executor const executor = backwards.executor(threads);
        options.executor = &executor;
        std::vector<double> history(40);
        options.history = history.data();
        options.history_length = 40;
        Solved const threaded(setup, &options);
        CHECK(backwards.tasks > 0);
        CHECK(same_bits(threaded.all_values(), four.all_values()));
        CHECK(threaded.report.iterations == four.report.iterations);
        CHECK(history[static_cast<std::size_t>(threaded.report.iterations)] > 0);
    }
}

TEST_CASE("the preconditioner is symmetric, positive definite, and not larger than the inverse") {
    check_preconditioner(two_body_case(Cells::hybrid, 7, 4));
    Case setup = airfoil_case(20, 12, Cells::quads);
    setup.mesh = c_mesh(naca4({}, 6), 3, 40, stretched(1e-5, 60, 11)).mesh;
    check_preconditioner(setup);
    // From the third coarse level on, the levels are solved by two cycles.
    check_preconditioner(o_mesh_case(60, 1e-4, 40, Cells::triangles), 5);
    check_preconditioner(o_mesh_case(60, 1e-8, 40), 5);
}

TEST_CASE("single precision reaches residuals far below its rounding, at the same speed") {
    for (int which = 0; which < 3; ++which) {
        Case setup = which == 0   ? even_case(60)
                     : which == 1 ? o_mesh_case(60, 1e-4, 40, Cells::triangles)
                                  : two_body_case(Cells::hybrid, 16, 10);
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
            Options iterative = multigrid(), exact = direct();
            iterative.operator_kind = exact.operator_kind = operator_kind;
            Solved const half(setup, &iterative), expected(setup, &exact);
            iterative.tolerance = 1e-13;
            std::vector<double> history(100);
            iterative.history = history.data();
            iterative.history_length = static_cast<std::int32_t>(history.size());
            Solved const whole(setup, &iterative);
            INFO("case " << which << ", operator " << operator_kind << ": "
                         << half.report.iterations << " and " << whole.report.iterations);
            CHECK(whole.report.residual <= 1e-13);
            CHECK(difference(whole, expected) < 1e-11);
            CHECK(whole.report.iterations <= 1.4 * half.report.iterations + 1);
            // The residual that the iteration knows is the true one.
            CHECK(history[static_cast<std::size_t>(whole.report.iterations)] ==
                  doctest::Approx(whole.report.residual).epsilon(0.05));
        }
    }
}

TEST_CASE("memory: at most 432 bytes for each point") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = o_mesh_case(100, 1e-5, 60, kind);
        Options options = multigrid();
        Attempt attempt;
        std::size_t bytes = 0;
        REQUIRE(attempt.analyse(setup.problem(), &options));
        REQUIRE(fixtures::plan_size(attempt.analysis, &bytes, nullptr) == HM_OK);
        INFO(bytes << " bytes for " << setup.mesh.n_points() << " points");
        CHECK(bytes <= 432 * static_cast<std::size_t>(setup.mesh.n_points()));
    }
}

TEST_CASE("the levels of a plan can be read, and coarser cells are unions of finer cells") {
    Case setup = two_body_case(Cells::hybrid, 16, 10);
    Options options = options_for(HM_FAS);
    Solved const solved(setup, &options);
    std::size_t const n = setup.mesh.x.size();
    std::vector<std::int32_t> finer(n), cells(n);
    std::int32_t n_cells = 0, last = 0;
    for (std::int32_t level = 0; level < solved.report.levels;
         ++level, last = n_cells, finer = cells) {
        REQUIRE(hm_plan_level(solved.plan, level, cells.data(), &n_cells, nullptr) == HM_OK);
        CHECK(*std::max_element(cells.begin(), cells.end()) == n_cells - 1);
        if (level == 0) {
            CHECK(n_cells == solved.report.unknowns);
            CHECK(std::count(cells.begin(), cells.end(), -1) ==
                  static_cast<std::ptrdiff_t>(n) - n_cells);
            continue;
        }
        CHECK(3 * n_cells <= last);
        std::vector<std::int32_t> coarse_of(static_cast<std::size_t>(last), -2);
        for (std::size_t k = 0; k < n; ++k) {
            CHECK((cells[k] == -1) == (finer[k] == -1));
            if (finer[k] < 0) continue;
            std::int32_t& coarse_cell = coarse_of[static_cast<std::size_t>(finer[k])];
            CHECK((coarse_cell == -2 || coarse_cell == cells[k]));
            coarse_cell = cells[k];
        }
    }
    hm_error error{};
    CHECK(hm_plan_level(solved.plan, solved.report.levels, cells.data(), &n_cells, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(hm_plan_level(solved.plan, -1, cells.data(), &n_cells, nullptr) == HM_BAD_ARGUMENT);
    for (std::int32_t const engine : {HM_DIRECT, HM_MULTIGRID}) {
        Options without = options_for(engine);
        Solved const other(setup, &without);
        CHECK(hm_plan_level(other.plan, 0, cells.data(), &n_cells, nullptr) == HM_BAD_ARGUMENT);
    }
    CHECK(hm_plan_level(nullptr, 0, cells.data(), &n_cells, nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("what does not go together, and numbers out of range, are refused") {
    Case setup = tiny_case();
    auto const status = [&](auto change) {
        Options options = multigrid();
        change(options);
        return Attempt(setup.problem(), &options).status;
    };
    CHECK(status([](Options&) {}) == HM_OK);
    CHECK(status([](Options& o) { o.engine = 3; }) == HM_UNSUPPORTED);
    CHECK(status([](Options& o) {
              o.engine = HM_FAS;
              o.operator_kind = HM_CONFORMAL;
          }) == HM_UNSUPPORTED);
    CHECK(status([](Options& o) { o.levels = 21; }) == HM_BAD_ARGUMENT);
    CHECK(status([](Options& o) { o.levels = -1; }) == HM_BAD_ARGUMENT);
    CHECK(status([](Options& o) { o.agglomeration = 1; }) == HM_UNSUPPORTED);
    CHECK(status([](Options& o) { o.agglomeration = 3; }) == HM_BAD_ARGUMENT);
    CHECK(status([](Options& o) { o.block_width = 5; }) == HM_BAD_ARGUMENT);
    CHECK(status([](Options& o) { o.max_iterations = -1; }) == HM_BAD_ARGUMENT);
    CHECK(status([](Options& o) { o.history_length = 1; }) == HM_BAD_ARGUMENT);
    setup.set_slip(top);
    CHECK(status([](Options&) {}) == HM_OK);
    CHECK(status([](Options& o) { o.operator_kind = HM_CONFORMAL; }) == HM_UNSUPPORTED);
    CHECK(status([](Options& o) { o.engine = HM_FAS; }) == HM_UNSUPPORTED);
}

TEST_CASE("a solution into a solved basis starts from its functions") {
    for (int which = 0; which < 4; ++which) {
        Case setup = which == 0   ? even_case(60)
                     : which == 1 ? o_mesh_case(60, 1e-5, 40)
                     : which == 2 ? two_body_case(Cells::hybrid, 16, 10)
                                  : even_case(30);
        if (which == 3) setup.set_slip(far_field);
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
            if (which == 3 && operator_kind == HM_CONFORMAL) continue;
            Options options = multigrid();
            options.operator_kind = operator_kind;
            Solved const start(setup, &options);
            std::vector<double> const first = start.all_values();
            hm_solve_report report{};
            report.struct_size = sizeof report;
            REQUIRE(hm_plan_solve(start.plan, start.basis, &report, nullptr) == HM_OK);
            CHECK(report.iterations <= 1);
            CHECK(largest_difference(start.all_values(), first) < 1e-9);
            for (double const size : {1e-2, 1e-4, 1e-6, 1e-8}) {
                Field const moved = displacement(
                    start, some_move(report.functions, which == 1 ? 1e-3 * size : size, 3));
                std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
                for (std::size_t k = 0; k < x.size(); ++k) {
                    x[k] += moved[k].real();
                    y[k] += moved[k].imag();
                }
                Solved const warm(setup, &options);
                Attempt const cold = prepared(setup.problem(), options);
                hm_solve_report from_zero = report;
                for (Attempt const* each : {&cold, static_cast<Attempt const*>(&warm)}) {
                    REQUIRE(hm_plan_factor(each->plan, points_in(x, y), nullptr) == HM_OK);
                    hm_solve_report& to = each == &cold ? from_zero : report;
                    REQUIRE(hm_plan_solve(each->plan, each->basis, &to, nullptr) == HM_OK);
                }
                std::vector<double> const values = warm.all_values(), expected = values_of(cold);
                double const change = largest_difference(expected, first);
                INFO("case " << which << ", operator " << operator_kind << ": from zero "
                             << from_zero.iterations << " iterations, from functions that are "
                             << change << " apart " << report.iterations);
                CHECK(largest_difference(values, expected) < 2e-9);
                // So many digits are still to be found.
                double const digits = 10 + std::log10(std::max(change, 1e-10));
                CHECK(report.iterations <= 0.1 * digits * from_zero.iterations + 5);
            }
        }
    }
}

TEST_CASE("the callback can stop it; the plan then still solves") {
    struct Stopper {
        int calls = 0, stop_at = 0;
        static std::int32_t call(void* user, std::int32_t phase, double) {
            Stopper& self = *static_cast<Stopper*>(user);
            return phase == HM_PHASE_SOLVE && ++self.calls == self.stop_at;
        }
    } stopper;
    stopper.stop_at = 7;
    Case setup = two_body_case(Cells::hybrid, 16, 10);
    Options options = multigrid();
    Solved const expected(setup, &options);
    options.progress = Stopper::call;
    options.progress_user = &stopper;
    Attempt attempt(setup.problem(), &options);
    CHECK(attempt.status == HM_CANCELLED);
    CHECK(stopper.calls == 7);
    stopper.stop_at = 0;
    REQUIRE(hm_plan_solve(attempt.plan, attempt.basis, &attempt.report, nullptr) == HM_OK);
    CHECK(attempt.report.iterations == expected.report.iterations);
}
