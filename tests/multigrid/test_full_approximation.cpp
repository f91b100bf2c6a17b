// The paper's iteration: the order of its Runge-Kutta scheme, that it diffuses, that one level is
// that scheme alone, and that coarser levels save most of the work without changing what it
// converges to.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/agglomerated.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/guarded.hpp>

#include "multigrid/full_approximation.hpp"

using namespace fixtures;
using harmorph::Index;

namespace {

Options fas(std::int32_t cycle = HM_CYCLE_PAPER) {
    Options out{};
    out.cycle = cycle;
    out.operator_kind = HM_LAPLACE;
    out.engine = HM_FAS;
    return out;
}
Options direct() {
    Options out = fas();
    out.engine = HM_DIRECT;
    return out;
}
double difference(Solved const& a, Solved const& b) {
    return largest_difference(a.all_values(), b.all_values());
}

// dF/dt = R(F) from F = start over the given time.
template <class R>
double integrate(R const& r, double start, double time, int steps) {
    double f = start;
    for (int k = 0; k < steps; ++k) {
        double const old = f;
        for (double const alpha : harmorph::stage_coefficient)
            f = old + alpha * time / steps * r(f);
    }
    return f;
}

Case viscous_case(Cells kind) {
    Case setup = airfoil_case(40, 12, Cells::quads);
    setup.mesh = o_mesh(naca4({}, 40), stretched(1e-5, 8, 36), kind);
    return setup;
}

// The finest level's rows, volumes and rates, with the memory of an engine of one level.
struct Explicit {
    Analysed seen;
    FrontMatrix front;
    harmorph::FullApproximation engine;
    std::unique_ptr<Guarded> block;

    explicit Explicit(Case& setup) : seen(setup), front(*seen.operator->()) {
        harmorph::Iteration iteration;
        iteration.merging.max_levels = 1;
        auto const lay_out = [&](harmorph::Arena& arena) {
            engine.lay_out(arena, front.rows.n, 8, iteration, {});
            engine.lay_out_work(arena, front.rows.n, front.rows.entries());
        };
        block = laid_out(lay_out);
        harmorph::Mesh const& mesh = seen->problem().mesh;
        engine.volumes.measure(seen->topology(), mesh.points, front.matrix.rows_of_dofs());
        harmorph::Fault fault;
        REQUIRE(engine.set_up(front.rows, fault) == harmorph::Status::ok);
    }
};

}  // namespace

TEST_CASE("the scheme is of second order, and not of third") {
    auto const decay = [](double f) { return -f * f; };  // f = 1 / (1 + t)
    double last = 0;
    for (int const steps : {8, 16, 32, 64}) {
        double const error = std::fabs(integrate(decay, 1, 1, steps) - 0.5);
        if (last > 0) CHECK(last / error == doctest::Approx(4).epsilon(0.15));
        last = error;
    }
}

TEST_CASE("one step damps what decays, up to the limit, and short waves by half") {
    auto const factor = [](double x) {
        return integrate([&](double f) { return -x * f; }, 1, 1, 1);
    };
    for (double x = 0.01; x < 5.2; x += 0.01) CHECK(std::fabs(factor(x)) < 1);
    for (double x = 0.7; x <= harmorph::damping_limit; x += 0.01)
        CHECK(std::fabs(factor(x)) <= 0.51);
    CHECK(std::fabs(factor(5.3)) > 1);
}

TEST_CASE("with one level an iteration is one Runge-Kutta step of the flux balances") {
    Case setup = two_body_case(Cells::hybrid, 8, 5);
    Explicit const parts(setup);
    harmorph::SymmetricRows const& rows = parts.front.rows;
    DenseMatrix const a = dense_of(rows);
    std::size_t const n = a.n;
    Index const function = 3;
    std::vector<double> b(n, 0.0), f(n, 0.0);
    harmorph::Analysis const& analysis = *parts.seen.operator->();
    harmorph::Matrix const& matrix = parts.front.matrix;
    for (Index slot = 0; slot < analysis.wall().count; ++slot) {
        harmorph::CurveBasis const wall_basis =
            curve_basis(analysis.curves()[analysis.wall().curve[slot]], analysis.wall().u[slot], 0);
        for (Index k = 0; k < wall_basis.order; ++k)
            for (Index c = matrix.coupling_start[slot];
                 wall_basis.control[k] == function && c < matrix.coupling_start[slot + 1]; ++c)
                b[static_cast<std::size_t>(matrix.coupling_row[c])] -=
                    matrix.coupling_value[c] * wall_basis.value[0][k];
    }
    constexpr int steps = 4;
    for (int k = 0; k < steps; ++k) {
        std::vector<double> const old = f;
        for (double const alpha : harmorph::stage_coefficient) {
            std::vector<double> const now = f;
            for (std::size_t i = 0; i < n; ++i) {
                double balance = b[i];
                for (std::size_t j = 0; j < n; ++j) balance -= a.at(i, j) * now[j];
                f[i] = old[i] + alpha * parts.engine.rate[0][i] * balance;
            }
        }
    }
    Options options = fas();
    options.levels = 1;
    options.max_iterations = steps;
    Attempt const attempt(setup.problem(), &options);
    REQUIRE(attempt.status == HM_NOT_CONVERGED);
    CHECK(attempt.report.iterations == steps);
    // One more product of the matrix tells the last residual.
    CHECK(attempt.report.work == steps + 0.25);
    CHECK(attempt.report.levels == 1);
    std::vector<double> values(setup.mesh.x.size());
    REQUIRE(hm_basis_values(attempt.basis, function, 0, values.data(), nullptr) == HM_OK);
    double worst = 0, largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Index const point = analysis.graph().point(parts.front.order[i]);
        worst = std::max(worst, std::fabs(values[static_cast<std::size_t>(point)] - f[i]));
        largest = std::max(largest, std::fabs(f[i]));
    }
    CHECK(worst < 1e-14);
    CHECK(largest > 0.1);
}

TEST_CASE("local steps are cfl (0.5 shortest edge)^2, and never longer than what damps all waves") {
    for (double const thin : {1.0, 1e-3}) {
        Case setup = square_on_curve(12, Cells::quads, 0.2, 7);
        for (double& y : setup.mesh.y) y *= thin;
        for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
            setup.curves.control[k] *= thin;
        Explicit const parts(setup);
        DenseMatrix const a = dense_of(parts.front.rows);
        for (std::size_t i = 0; i < a.n; ++i) {
            double row = 0;
            for (std::size_t j = 0; j < a.n; ++j) row += std::fabs(a.at(i, j));
            double const dt = parts.engine.rate[0][i] * parts.engine.volumes.area[i];
            double const half = 0.5 * parts.engine.volumes.shortest_edge[i];
            double const limit = harmorph::damping_limit * parts.engine.volumes.area[i] / row;
            CHECK(dt ==
                  doctest::Approx(std::min(harmorph::FullApproximation::cfl * half * half, limit))
                      .epsilon(1e-12));
        }
    }
}

TEST_CASE("full approximation converges to the functions of the direct engine with either rule") {
    for (int which = 0; which < 7; ++which) {
        Case setup = which < 3    ? two_body_case(static_cast<Cells>(which), 12, 8)
                     : which == 3 ? airfoil_case()
                                  : viscous_case(which == 4 ? Cells::quads : Cells::triangles);
        if (which == 1) setup.set_free(far_field);
        // Couplings differ by 1e12.
        if (which == 6) setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-5, 60, 48)).mesh;
        Options iterative = fas(which % 2), exact = direct();
        iterative.agglomeration = which >= 5 ? HM_AGGLOMERATE_DIRECTIONAL : HM_AGGLOMERATE_AUTO;
        Solved const found(setup, &iterative), expected(setup, &exact);
        INFO("case " << which << ": " << found.report.iterations << " cycles, work "
                     << found.report.work);
        CHECK(difference(found, expected) < 1e-8);
        CHECK(found.report.residual <= 1e-10);
        // Each cycle makes two steps on the finest level before the correction and two after it.
        CHECK(found.report.work > 4 * found.report.iterations);
        CHECK(found.report.levels >= 3);
    }
}

TEST_CASE("coarser levels save half of the work, and improved cycles a third of the rest") {
    Case two_bodies = two_body_case(Cells::hybrid, 16, 10);
    Options one_level = fas(), improved = fas(HM_CYCLE_IMPROVED);
    one_level.levels = 1;
    Options const paper = fas();
    Solved const single(two_bodies, &one_level), v_cycles(two_bodies, &paper),
        w_cycles(two_bodies, &improved);
    INFO("work: " << single.report.work << " with one level, " << v_cycles.report.work
                  << " with V-cycles on " << v_cycles.report.levels << " levels, "
                  << w_cycles.report.work << " with improved cycles");
    CHECK(single.report.work > 2 * v_cycles.report.work);
    CHECK(v_cycles.report.work > 1.5 * w_cycles.report.work);
    CHECK(difference(single, v_cycles) < 1e-8);
    CHECK(difference(single, w_cycles) < 1e-8);
}

TEST_CASE("the number of improved cycles does not grow with the mesh, and that of V-cycles does") {
    Options options = fas(HM_CYCLE_IMPROVED);
    auto const cycles = [&](int n_side, double wall_spacing, double layers_to_those_of_squares) {
        double const along_wall = 1.02 / n_side,
                     squares = std::log1p(8 * 3.14 / 1.02) / 3.14 * n_side;
        Case setup = airfoil_case(40, 4, Cells::quads);
        setup.mesh = o_mesh(naca4({}, n_side),
                            stretched(wall_spacing * along_wall, 8,
                                      static_cast<int>(layers_to_those_of_squares * squares)));
        Solved const solved(setup, &options);
        return solved.report.iterations;
    };
    CHECK(cycles(60, 1, 1) < 1.3 * cycles(30, 1, 1));  // squares, 2000 and 8000 points
    CHECK(cycles(68, 1e-3, 1.2) <
          1.3 * cycles(34, 1e-3, 1.2));  // thin cells at the wall, 3000 and 12 000 points
    options = fas(HM_CYCLE_PAPER);
    CHECK(cycles(60, 1, 1) > 1.3 * cycles(30, 1, 1));
}

TEST_CASE("the start from the coarsest level is worth a cycle at least") {
    Case setup = two_body_case(Cells::hybrid, 16, 10);
    std::vector<double> history(400);
    Options options = fas();
    options.history = history.data();
    options.history_length = static_cast<std::int32_t>(history.size());
    Solved const solved(setup, &options);
    CHECK(history[0] == doctest::Approx(1));
    double const last = history[static_cast<std::size_t>(solved.report.iterations)];
    double const cycle = std::pow(last / history[1], 1.0 / (solved.report.iterations - 1));
    INFO("one cycle: " << cycle << ", the start and one: " << history[1]);
    CHECK(history[1] < std::pow(cycle, 2));
    for (std::int32_t k = 1; k < solved.report.iterations; ++k)
        CHECK(history[static_cast<std::size_t>(k) + 1] <
              1.5 * history[static_cast<std::size_t>(k)]);
}

TEST_CASE("full approximation from zero converges to the same functions") {
    Case setup = two_body_case(Cells::hybrid, 16, 10);
    std::vector<double> history(400);
    Options options = fas();
    Solved const level_by_level(setup, &options);
    options.start = HM_START_ZERO;
    options.history = history.data();
    options.history_length = static_cast<std::int32_t>(history.size());
    Solved const from_zero(setup, &options);
    CHECK(difference(level_by_level, from_zero) < 1e-8);
    CHECK(from_zero.report.iterations >= level_by_level.report.iterations);
    CHECK(history[0] == doctest::Approx(1));
    CHECK(history[1] > 1e-3);
    options.start = 2;
    CHECK(Attempt(setup.problem(), &options).status == HM_BAD_ARGUMENT);
    options = fas(2);
    CHECK(Attempt(setup.problem(), &options).status == HM_BAD_ARGUMENT);
    options = fas(HM_CYCLE_IMPROVED);
    options.engine = HM_MULTIGRID;
    CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
}

TEST_CASE("threads change no bit; limits end with a status") {
    Case setup = two_body_case(Cells::hybrid, 12, 8);
    Options options = fas();
    options.block_width = 4;
    options.max_iterations = 5;
    auto const values = [&] {
        Attempt attempt(setup.problem(), &options);
        REQUIRE(attempt.status == HM_NOT_CONVERGED);
        CHECK(attempt.report.iterations == 5);
        std::vector<double> out(setup.mesh.x.size());
        REQUIRE(hm_basis_values(attempt.basis, 6, 0, out.data(), nullptr) == HM_OK);
        return out;
    };
    std::vector<double> const serial = values();
    Backwards backwards;
    hm_executor const executor = backwards.executor(3);
    options.executor = &executor;
    CHECK(same_bits(values(), serial));
    CHECK(backwards.tasks > 0);
}

TEST_CASE("full approximation that ends early with a small residual has not converged") {
    Case setup = airfoil_case(20, 12);
    setup.mesh = c_mesh(naca4({}, 20), 10, 8, stretched(1e-3, 8, 20)).mesh;
    Options options = fas(), exact = direct();
    options.operator_kind = exact.operator_kind = HM_WEIGHTED;
    options.exponent = exact.exponent = 2.25;
    options.agglomeration = HM_AGGLOMERATE_ISOTROPIC;
    options.start = HM_START_ZERO;
    options.max_iterations = 400;
    Attempt const attempt(setup.problem(), &options);
    std::vector<double> values(setup.mesh.x.size());
    REQUIRE(hm_basis_values(attempt.basis, 0, 0, values.data(), nullptr) == HM_OK);
    CHECK(attempt.report.residual < 1e-10);
    CHECK(largest_difference(values, Solved(setup, &exact).values(0)) > 1e-8);
    CHECK(attempt.status == HM_NOT_CONVERGED);
    CHECK(std::string(attempt.error.text).find("values") != std::string::npos);
}
