// The residual sees what is wrong, and refinement takes it away.
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>

#include <harmorph/harmonic.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

harmorph::Plan& inside(hm_plan* plan) { return *reinterpret_cast<harmorph::Plan*>(plan); }

struct Progressed {
    std::int32_t phase = 0;
    double fraction = 0;
    int backwards = 0;
    static std::int32_t call(void* user, std::int32_t phase, double fraction) {
        Progressed& self = *static_cast<Progressed*>(user);
        if (phase < self.phase || (phase == self.phase && fraction < self.fraction)) ++self.backwards;
        self.phase = phase;
        self.fraction = fraction;
        return 0;
    }
};

}  // namespace

TEST_CASE("one wrong value leaves its column of the matrix") {
    Case its = two_body_case(Cells::hybrid, 6, 4);
    Solved const solved(its);
    harmorph::Analysis const& analysis = fixtures::inside(solved.analysis);
    AssembledMatrix laplace(analysis);
    laplace.assemble();
    DenseMatrix const a = laplace.unknowns();
    harmorph::Plan& plan = inside(solved.plan);
    harmorph::Basis const basis = harmorph::Basis::view(static_cast<void*>(solved.basis));
    harmorph::Arena counting;
    harmorph::Residual residual;
    residual.lay_out(counting, plan.matrix.n, false);
    Guarded block(counting.bytes());
    harmorph::Arena placing(block.data(), block.size());
    residual.lay_out(placing, plan.matrix.n, false);

    Index const width = residual.width;
    Index const function = width + 1, wrong = plan.matrix.n / 2;   // of the second group of functions
    double const by = 1e-3;
    basis.row(plan.line_of[wrong])[function] += by;
    harmorph::Residual::Norms const norms = residual.compute(plan.matrix, {basis, plan.line_of, 1}, width, width);
    double squares = 0, b = 0, worst = 0;
    std::vector<double> const known =
        laplace.couplings_times([&](Index slot) { return basis.row(basis.wall_point[slot])[function]; });
    for (std::size_t i = 0; i < a.n; ++i) {
        double const expected = -by * a.at(i, static_cast<std::size_t>(wrong));
        squares += expected * expected;
        b += known[i] * known[i];
        const double* const row = residual.value.data() + width * static_cast<std::ptrdiff_t>(i);
        worst = std::fmax(worst, std::fabs(row[1] - expected));
        worst = std::fmax(worst, std::fabs(row[0]));   // the function beside it is right
    }
    CHECK(worst < 1e-15);
    CHECK(norms.relative(1) == doctest::Approx(std::sqrt(squares / b)).epsilon(1e-9));
    CHECK(norms.relative(0) < 1e-14);
    CHECK(block.guards_intact());
}

TEST_CASE("a factor that is slightly wrong: refinement brings the residual down, and progress never goes back") {
    for (double const error : {0.0, 1e-9, 1e-6, 1e-1}) {
        Case its = ring_case(12, 48, 0.5, 2, Cells::hybrid, 3, 19);
        Progressed progressed;
        hm_options options = laplace();
        options.progress = Progressed::call;
        options.progress_user = &progressed;
        Solved const reference(its);
        Attempt attempt;
        REQUIRE((attempt.analyse(its.problem(), &options) && attempt.prepare()));
        REQUIRE(hm_plan_factor(attempt.plan, nullptr, nullptr, 0, nullptr) == HM_OK);
        for (double& entry : inside(attempt.plan).engine.doubles.factor) entry *= 1 + error;
        hm_status const status = hm_plan_solve(attempt.plan, attempt.basis, &attempt.report, nullptr);
        INFO("error " << error << ": " << attempt.report.refinements << " steps to " << attempt.report.residual);
        CHECK(progressed.backwards == 0);
        if (error == 0) CHECK(attempt.report.refinements == 0);
        if (error > 0) CHECK(attempt.report.refinements >= 1);
        if (error < 1e-2) {
            CHECK(status == HM_OK);
            CHECK(attempt.report.residual < 1e-12);
            std::vector<double> values(its.mesh.x.size());
            REQUIRE(hm_basis_values(attempt.basis, 7, 0, values.data(), nullptr) == HM_OK);
            CHECK(largest_difference(values, reference.values(7)) < 1e-12);
        } else {
            CHECK(status == HM_NOT_CONVERGED);   // and says so where it does not help
            CHECK(attempt.report.residual > 1e-10);
        }
    }
}
