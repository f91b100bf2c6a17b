// The residual sees what is wrong, and refinement takes it away.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/o_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/matrices.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/wrong.hpp>
#include <fixtures/guarded.hpp>

#include "plan/plan.hpp"

using namespace fixtures;
using harmorph::Index;

namespace {

harmorph::Plan& inside(hm_plan* plan) { return *reinterpret_cast<harmorph::Plan*>(plan); }

// A solved basis whose values stand in rows of points again, as equations see them.
harmorph::Basis in_rows(Solved const& solved) {
    harmorph::Basis const basis = harmorph::Basis::view(static_cast<void*>(solved.basis));
    std::vector<double> rows;
    for (Index point = 0; point < basis.n_points(); ++point)
        for (Index k = 0; k < basis.row_length(); ++k) rows.push_back(basis.row(point)[k]);
    std::copy(rows.begin(), rows.end(), basis.value.begin());
    return basis;
}

struct Progressed {
    std::int32_t phase = 0;
    double fraction = 0;
    Wrong backwards;  // fractions smaller than the one before, in which phase
    static std::int32_t call(void* user, std::int32_t phase, double fraction) {
        Progressed& self = *static_cast<Progressed*>(user);
        bool const is_earlier =
            phase < self.phase || (phase == self.phase && fraction < self.fraction);
        self.backwards.add(is_earlier, phase, fraction);
        self.phase = phase;
        self.fraction = fraction;
        return 0;
    }
};

}  // namespace

TEST_CASE("one wrong value leaves its column of the matrix") {
    Case setup = two_body_case(Cells::hybrid, 6, 4);
    Solved const solved(setup);
    harmorph::Analysis const& analysis = fixtures::inside(solved.analysis);
    AssembledMatrix laplace(analysis);
    laplace.assemble();
    DenseMatrix const a = laplace.unknowns();
    harmorph::Plan& plan = inside(solved.plan);
    harmorph::Basis const basis = in_rows(solved);
    harmorph::Residual residual;
    Index const couplings = plan.equations().matrix().coupling_row.count();
    auto const block = laid_out_part(residual, plan.equations().matrix().n, couplings,
                                     plan.equations().matrix().kind());

    Index const width = residual.width;
    Index const function = width + 1,
                wrong = plan.equations().matrix().n / 2;  // of the second group of functions
    double const by = 1e-3;
    harmorph::DofValues const dofs(basis, plan.equations().dof_of(), 1);
    dofs.at(wrong)[function] += by;
    harmorph::Residual::Norms const norms =
        residual.compute(plan.equations().matrix(), dofs, width, width);
    double squares = 0, b = 0, worst = 0;
    std::vector<double> const known =
        laplace.couplings_times([&](Index slot) { return dofs.wall(slot)[function]; });
    for (std::size_t i = 0; i < a.n; ++i) {
        double const expected = -by * a.at(i, static_cast<std::size_t>(wrong));
        squares += expected * expected;
        b += known[i] * known[i];
        const double* const row = residual.value.data() + width * static_cast<std::ptrdiff_t>(i);
        worst = std::fmax(worst, std::fabs(row[1] - expected));
        worst = std::fmax(worst, std::fabs(row[0]));  // the function beside it is right
    }
    CHECK(worst < 1e-15);
    CHECK(norms.relative(1) == doctest::Approx(std::sqrt(squares / b)).epsilon(1e-9));
    CHECK(norms.relative(0) < 1e-14);
    CHECK(block->guards_intact());
}

TEST_CASE("the residual of points that slip is b - A F, also where lines meet at an angle") {
    struct Kind {
        std::int32_t kind;
        bool has_source;
    };
    for (auto const [kind, has_source] :
         {Kind{HM_LAPLACE, false}, Kind{HM_WEIGHTED, false}, Kind{HM_CONFORMAL, false},
          Kind{HM_LAPLACE, true}, Kind{HM_CONFORMAL, true}}) {
        Case setup = similar(two_body_case(Cells::hybrid, 5, 4), std::polar(1.0, 0.7), 0);
        setup.conditions.clear();
        setup.put_on_curves(body, 0);  // the other body is held
        setup.set_slip(far_field);  // four lines: next to corners points of two of them share cells
        Options const options = options_of(kind);
        Solved const solved(setup, &options);
        harmorph::Plan const& plan = inside(solved.plan);
        harmorph::Matrix const& matrix = plan.equations().matrix();
        harmorph::Basis const basis = in_rows(solved);
        harmorph::DofValues dofs{basis, plan.equations().dof_of(), 2};
        std::mt19937 random(5);
        fill(basis.value, 0.0);
        std::vector<double> source(static_cast<std::size_t>(basis.value.count()));
        for (double& one : source) one = uniform(random) - 0.5;
        if (has_source) dofs.source = source.data();
        for (Index i = 0; i < matrix.n; ++i) dofs.at(i)[0] = uniform(random) - 0.5;
        for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall)
            dofs.wall(wall)[0] = has_source ? 0 : uniform(random) - 0.5;
        std::vector<double> expected(static_cast<std::size_t>(matrix.n));
        auto const subtract = [&](Index row, double by) {
            expected[static_cast<std::size_t>(row)] -= by;
        };
        for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall)
            for (Index c = matrix.coupling_start[wall]; c < matrix.coupling_start[wall + 1]; ++c)
                subtract(matrix.coupling_row[c], matrix.coupling_value[c] * dofs.wall(wall)[0]);
        double right_hand_side = 0;
        for (double const b : expected) right_hand_side += b * b;
        for (Index i = 0; i < matrix.n && has_source; ++i) {
            subtract(i, -dofs.source_at(i)[0]);
            right_hand_side += dofs.source_at(i)[0] * dofs.source_at(i)[0];
        }
        for (Index i = 0; i < matrix.n; ++i) {
            subtract(i, matrix.diagonal[i] * dofs.at(i)[0]);
            for (harmorph::Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
                subtract(i, matrix.value[e] * dofs.at(matrix.column[e])[0]);
                subtract(matrix.column[e], matrix.value[e] * dofs.at(i)[0]);
            }
        }
        harmorph::Residual::Norms const norms =
            plan.refinement().residual.compute(matrix, dofs, 0, 1);
        double worst = 0, squares = 0;
        for (Index i = 0; i < matrix.n; ++i) {
            double const found =
                plan.refinement()
                    .residual.value[harmorph::Offset{i} * plan.refinement().residual.width];
            worst = std::fmax(worst, std::fabs(found - expected[static_cast<std::size_t>(i)]));
            squares += found * found;
        }
        CHECK(worst < 1e-12 * std::sqrt(squares));
        CHECK(norms.rest[0] == doctest::Approx(squares).epsilon(1e-12));
        CHECK(norms.right_hand_side[0] == doctest::Approx(right_hand_side).epsilon(1e-12));
    }
}

TEST_CASE("refinement reduces the residual of a wrong factor, and progress never goes back") {
    for (double const error : {0.0, 1e-9, 1e-6, 1e-1}) {
        Case setup = ring_case(12, 48, 0.5, 2, Cells::hybrid, 3, 19);
        Progressed progressed;
        Options options = laplace();
        options.progress = Progressed::call;
        options.progress_user = &progressed;
        Solved const reference(setup);
        Attempt attempt;
        REQUIRE(attempt.analyse(setup.problem(), &options));
        REQUIRE(attempt.prepare());
        REQUIRE(hm_plan_factor(attempt.plan, nullptr, nullptr) == HM_OK);
        for (double& entry : inside(attempt.plan).engine().direct.factor.numbers.factor)
            entry *= 1 + error;
        hm_status const status =
            hm_plan_solve(attempt.plan, attempt.basis, &attempt.report, nullptr);
        INFO("error " << error << ": " << attempt.report.refinements << " steps to "
                      << attempt.report.residual);
        CHECK(progressed.backwards == 0);
        if (error == 0) CHECK(attempt.report.refinements == 0);
        if (error > 0) CHECK(attempt.report.refinements >= 1);
        if (error < 1e-2) {
            CHECK(status == HM_OK);
            CHECK(attempt.report.residual < 1e-12);
            std::vector<double> values(setup.mesh.x.size());
            REQUIRE(hm_basis_values(attempt.basis, 7, 0, values.data(), nullptr) == HM_OK);
            CHECK(largest_difference(values, reference.values(7)) < 1e-12);
        } else {
            CHECK(status == HM_NOT_CONVERGED);  // and says so where it does not help
            CHECK(attempt.report.residual > 1e-10);
        }
    }
}

namespace {

// Cells of the wake's cut are `first` high and longer than the chord: next to their couplings those
// around drown.
Case thin_case(double first, bool free) {
    Case out = airfoil_case(40, 12, Cells::quads);
    out.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(first, 60, 60)).mesh;
    if (free) out.set_free(far_field);
    return out;
}

Options with(std::int32_t operator_kind, std::int32_t engine) {
    Options out{};
    out.operator_kind = operator_kind;
    out.engine = engine;
    return out;
}

// Returns how far the sum of all functions is from 1, at most.
double worst_defect(Solved const& solved, std::size_t n) {
    std::vector<double> const values = solved.all_values();
    double worst = 0;
    for (std::size_t point = 0; point < n; ++point) {
        double sum = -1;
        for (std::size_t k = point; k < values.size(); k += n) sum += values[k];
        worst = std::max(worst, std::fabs(sum));
    }
    return worst;
}

}  // namespace

TEST_CASE("functions on thin cells sum to 1 for a free far field, and are those of multigrid") {
    for (double const first : {1e-7, 1e-9, 1e-11}) {
        for (bool const free : {true, false}) {
            Case setup = thin_case(first, free);
            Options const exact = with(HM_LAPLACE, HM_DIRECT),
                          iterative = with(HM_LAPLACE, HM_MULTIGRID);
            Solved const found(setup, &exact), other(setup, &iterative);
            INFO("first cell " << first << ", free " << free << ": "
                               << inside(found.plan).engine().direct.factor.min_pivot_ratio()
                               << " left of a pivot");
            CHECK(inside(found.plan).engine().trusted());  // it has lost nothing
            CHECK(found.report.refinements == 0);
            CHECK(largest_difference(found.all_values(), other.all_values()) < 1e-8);
            if (free) CHECK(worst_defect(found, setup.mesh.x.size()) < 1e-13);
        }
    }
}

TEST_CASE("even cells are not refined") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL}) {
        for (bool const free : {false, true}) {
            if (free && kind == HM_CONFORMAL) continue;
            Case setup = two_body_case(Cells::hybrid, 16, 10);
            if (free) setup.set_free(far_field);
            Options const options = with(kind, HM_DIRECT);
            Solved const solved(setup, &options);
            CHECK(solved.report.refinements == 0);
            CHECK(inside(solved.plan).engine().trusted());
        }
    }
}

TEST_CASE("constants leave a residual of 0 to the bit, except beside known values") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Case setup = thin_case(1e-9, false);
        Options const options = with(kind, HM_DIRECT);
        Solved const solved(setup, &options);
        harmorph::Plan const& plan = inside(solved.plan);
        harmorph::Matrix const& matrix = plan.equations().matrix();
        harmorph::Basis const basis = in_rows(solved);
        harmorph::DofValues const dofs{basis, plan.equations().dof_of(), 1};
        std::vector<bool> beside_known(static_cast<std::size_t>(matrix.n));
        for (Index const row : matrix.fixed_row) beside_known[static_cast<std::size_t>(row)] = true;
        for (Index const row : matrix.coupling_row)
            beside_known[static_cast<std::size_t>(row)] = true;
        for (Index i = 0; i < matrix.n; ++i) {
            for (Index k = 0; k < dofs.length(); ++k) dofs.at(i)[k] = 1;
        }
        Index const n = plan.refinement().residual.width, planes = matrix.is_complex() ? 2 : 1;
        plan.refinement().residual.compute(matrix, dofs, 0, n);
        Wrong inside_rows;
        double largest = 0;
        for (Index i = 0; i < matrix.n; ++i) {
            const double* const row = plan.refinement().residual.value.data() +
                                      static_cast<std::ptrdiff_t>(i) * planes * n;
            for (Index k = 0; k < planes * n; ++k) {
                if (beside_known[static_cast<std::size_t>(i)])
                    largest = std::max(largest, std::fabs(row[k]));
                else inside_rows.compare(i, row[k], 0);
            }
        }
        CHECK(inside_rows == 0);
        CHECK(largest > 0);
    }
}

TEST_CASE("kernels give the same bits, of whole blocks of columns and of parts of one") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Case setup = thin_case(1e-3, false);  // 12 functions
        Options const options = with(kind, HM_DIRECT);
        Solved const solved(setup, &options);
        harmorph::Plan const& plan = inside(solved.plan);
        harmorph::Basis const basis = in_rows(solved);
        harmorph::Residual residual = plan.refinement().residual;
        for (Index n = 1; n <= residual.width; ++n) {
            residual.kernel = harmorph::Kernel::baseline;
            harmorph::Residual::Norms const plain = residual.compute(
                plan.equations().matrix(), {basis, plan.equations().dof_of(), 1}, 12 - n, n);
            std::vector<double> const expected(residual.value.begin(), residual.value.end());
            for (harmorph::Kernel const kernel : usable_kernels()) {
                residual.kernel = kernel;
                harmorph::Residual::Norms const fast = residual.compute(
                    plan.equations().matrix(), {basis, plan.equations().dof_of(), 1}, 12 - n, n);
                CHECK(same_bits(expected, {residual.value.begin(), residual.value.end()}));
                for (Index k = 0; k < n; ++k) CHECK(plain.relative(k) == fast.relative(k));
            }
        }
    }
}

TEST_CASE("subtrees of rows have the residuals of rows in turn for any number of threads") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Index const n_functions = 8;
        Case setup = ring_case(60, 130, 0.5, 2, Cells::hybrid, 3, n_functions);
        Options const options = with(kind, HM_DIRECT);
        Solved const solved(setup, &options);
        harmorph::Plan const& plan = inside(solved.plan);
        harmorph::Basis const basis = in_rows(solved);
        harmorph::DofValues const dofs(basis, plan.equations().dof_of(), 1);
        harmorph::Matrix const& matrix = plan.equations().matrix();
        harmorph::Residual residual = plan.refinement().residual;
        REQUIRE(residual.subtrees.count > 4);
        REQUIRE(matrix.fixed_row.count() > 0);
        Index const n = residual.width, wrong = matrix.n / 3;
        REQUIRE(n < n_functions);
        for (Index const column : {1, n}) dofs.at(wrong)[column] += 1e-3;  // more than rounding
        residual.choose_subtrees({}, {});
        harmorph::Residual::Norms const beyond = residual.compute(matrix, dofs, n, n_functions - n);
        harmorph::Residual::Norms const plain = residual.compute(matrix, dofs, 0, n);
        std::vector<double> const expected(residual.value.begin(), residual.value.end());
        std::vector<double> first;
        for (Index const threads : {1, 2, 3, 8}) {
            Backwards order;
            hm_executor const executor = order.executor(threads);
            residual.subtrees = plan.refinement().residual.subtrees;
            residual.executor = {executor.run, executor.user, threads};
            harmorph::Residual::Norms const shared = residual.compute(matrix, dofs, 0, n);
            CHECK((order.calls > 0) == (threads > 1));
            std::vector<double> found(residual.value.begin(), residual.value.end());
            CHECK(largest_difference(found, expected) < 1e-14);
            for (Index k = 0; k < n; ++k) {
                CHECK(shared.right_hand_side[k] ==
                      doctest::Approx(plain.right_hand_side[k]).epsilon(1e-13));
                CHECK(std::fabs(shared.rest[k] - plain.rest[k]) < 1e-9 * plain.rest[1]);
                found.push_back(shared.right_hand_side[k]);
                found.push_back(shared.rest[k]);
            }
            // The norms alone, of more columns than are stored at a time.
            harmorph::Residual::Norms const all = residual.measure(matrix, dofs, 0, n_functions);
            for (Index k = 0; k < n_functions; ++k) {
                double const expected_rest = k < n ? plain.rest[k] : beyond.rest[k - n];
                CHECK(std::fabs(all.rest[k] - expected_rest) < 1e-9 * plain.rest[1]);
                found.push_back(all.right_hand_side[k]);
                found.push_back(all.rest[k]);
            }
            if (first.empty()) first = found;
            CHECK(same_bits(found, first));
        }
    }
}
