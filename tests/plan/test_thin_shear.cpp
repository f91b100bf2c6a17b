// Thin cells far from the wall. Where they lean, some of their conductances are negative, and
// cancel others as the factor is made; where they stand upright, flows through them dwarf those at
// the wall, and so does the rounding of these flows.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/double_double.hpp>
#include <fixtures/operators.hpp>

#include "plan/plan.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Offset;

namespace {

harmorph::Plan const& inside(const hm_plan* plan) {
    return *reinterpret_cast<const harmorph::Plan*>(plan);
}

// A flat wall from x = -1 to 1 below rows of cells; those between two rows lean by 2 * lean of a
// cell's length.
Case plate(std::vector<double> const& steps, Cells kind, double lean) {
    Case out;
    int const n = 16, row = n + 1, n_rows = int(steps.size());
    double y = 0;
    for (int j = 0; j <= n_rows; ++j) {
        for (int i = 0; i <= n; ++i) {
            bool const is_inside = j > 0 && j < n_rows && i > 0 && i < n;
            out.mesh.add_point({(i + (is_inside ? (j % 2 == 1 ? lean : -lean) : 0)) / 8 - 1, y});
        }
        if (j < n_rows) y += steps[std::size_t(j)];
    }
    for (int k = 0; k < n_rows * row; k += row)
        for (int i = k; i < k + n; ++i) {
            bool const split = kind == Cells::triangles || (kind == Cells::hybrid && i % 3 == 0);
            out.mesh.add_quad(i, i + 1, i + 1 + row, i + row, split);
        }
    for (int i = 0; i < n; ++i) {
        out.mesh.add_face(i, i + 1, body);
        out.mesh.add_face(n_rows * row + i + 1, n_rows * row + i, far_field);
    }
    for (int k = 0; k < n_rows * row; k += row) {
        out.mesh.add_face(k + n, k + n + row, far_field);
        out.mesh.add_face(k + row, k, far_field);
    }
    out.curves = flat_wall();
    out.put_on_curves(body);
    for (int i = 0; i <= n; ++i) out.give(i, 1.0 * i / n);
    return out;
}

// Largest error of all functions beside their largest value, 1: of the plan's equations, by dense
// elimination with twice a double's digits.
double largest_error(Attempt const& solved) {
    harmorph::Plan const& plan = inside(solved.plan);
    harmorph::Matrix const& matrix = plan.equations().matrix();
    std::size_t const n = std::size_t(matrix.n);
    std::vector<DoubleDouble> a(n * n, 0);
    auto const at = [&](Index i, Index j) -> DoubleDouble& {
        return a[std::size_t(i) * n + std::size_t(j)];
    };
    for (Index i = 0; i < matrix.n; ++i)
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            Index const j = matrix.column[e];
            at(i, j) += matrix.value[e];
            at(i, i) -= matrix.value[e];
            at(j, j) -= matrix.value[e];
        }
    for (Index h = 0; h < matrix.fixed_row.count(); ++h)
        at(matrix.fixed_row[h], matrix.fixed_row[h]) -= matrix.fixed_value[h];
    std::vector<std::vector<double>> values;
    for (std::int32_t f = 0; f < solved.report.functions; ++f) {
        values.emplace_back(plan.equations().matrix().rows_of_dofs().size());
        REQUIRE(hm_basis_values(solved.basis, f, 0, values.back().data(), nullptr) == HM_OK);
    }
    std::vector<std::vector<DoubleDouble>> sides(values.size(), std::vector<DoubleDouble>(n, 0));
    for (Index point = 0; point < matrix.rows_of_dofs().count(); ++point) {
        if (!harmorph::Matrix::is_wall(matrix.row_of(point))) continue;
        Index const wall = harmorph::Matrix::wall(matrix.row_of(point));
        for (Index c = matrix.coupling_start[wall]; c < matrix.coupling_start[wall + 1]; ++c) {
            Index const i = matrix.coupling_row[c];
            DoubleDouble const entry = matrix.coupling_value[c];
            at(i, i) -= entry;
            for (std::size_t f = 0; f < values.size(); ++f)
                sides[f][std::size_t(i)] -= entry * values[f][std::size_t(point)];
        }
    }
    for (Index k = 0; k < matrix.n; ++k)
        for (Index r = k + 1; r < matrix.n; ++r) {
            DoubleDouble const factor = at(k, r) / at(k, k);
            if (factor.is_zero()) continue;
            for (Index c = r; c < matrix.n; ++c) at(r, c) -= factor * at(k, c);
            for (auto& side : sides) side[std::size_t(r)] -= factor * side[std::size_t(k)];
        }
    double worst = 0;
    for (std::size_t f = 0; f < sides.size(); ++f)
        for (Index k = matrix.n - 1; k >= 0; --k) {
            DoubleDouble& x = sides[f][std::size_t(k)];
            for (Index c = k + 1; c < matrix.n; ++c) x -= at(k, c) * sides[f][std::size_t(c)];
            x /= at(k, k);
            double const error =
                std::fabs((x - values[f][std::size_t(plan.equations().point_of(k))]).high);
            if (!(error <= worst)) worst = error;
        }
    return worst;
}

std::vector<double> const far_and_thin(double h) { return {.1, .1, h, h, h, .1, .2}; }

// Solves again with another factor: what is called done must be right. Counts what is refined away,
// and what is told.
struct Damage {
    int healed = 0, told = 0;

    template <class Change>
    void test(Attempt& solved, double& entry, Change change) {
        double const before = entry;
        entry = change(before);
        hm_status const status =
            hm_plan_solve(solved.plan, solved.basis, &solved.report, &solved.error);
        INFO(before << " became " << entry << ": residual " << solved.report.residual);
        CHECK(status >= 0);
        if (status == HM_OK) {
            double const error = largest_error(solved);
            CHECK(error < 1e-9);
            ++healed;
        } else {
            ++told;
        }
        entry = before;
    }
};

}  // namespace

TEST_CASE("functions that are reported as solved are accurate, and others have a warning") {
    int trusted = 0, refined = 0, missed = 0;
    for (double const h : {1e-3, 1e-7, 1e-9, 1e-11})
        for (std::vector<double> const& steps :
             {std::vector<double>{h, h, h, .1, .1, .2, .2}, {h, h, .1, .1, h, h, .1, .2}})
            for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
                for (double const lean : {0.0, 0.1, 0.3})
                    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_WEIGHTED}) {
                        Case setup = plate(steps, kind, lean);
                        setup.set_free(far_field);
                        Options const options = options_of(operator_kind);
                        Attempt const solved(setup.problem(), &options);
                        double const error = largest_error(solved);
                        INFO("cells " << h << " thin, lean " << lean << ", operator "
                                      << operator_kind << ": off by " << error << ", "
                                      << solved.report.refinements << " steps, "
                                      << solved.error.text);
                        if (solved.status == HM_OK) {
                            CHECK(error < 1e-9);
                            ++(inside(solved.plan).engine().trusted() ? trusted : refined);
                            continue;
                        }
                        CHECK(solved.status == HM_NOT_CONVERGED);
                        CHECK(error < 100 * solved.error.value);
                        ++missed;
                    }
    CHECK(trusted > 0);
    CHECK(refined > 0);
    CHECK(missed > 0);
}

TEST_CASE("thin cells that are upright or held by the wall lose no accuracy") {
    for (double const h : {1e-6, 1e-8})
        for (double const lean : {0.0, 0.3}) {
            Case setup = plate(lean > 0 ? std::vector<double>{h, h, h, .1, .1, .2}
                                        : std::vector<double>{.1, .1, h, h, .1, .2},
                               Cells::quads, lean);
            Options const options = options_of(HM_LAPLACE);
            Attempt const solved(setup.problem(), &options);
            CHECK(inside(solved.plan).engine().trusted());
            CHECK(largest_error(solved) < 1e-11);
        }
}

TEST_CASE("residuals that are rounding of flows through thin cells are no errors") {
    for (double const h : {1e-3, 1e-7, 1e-9, 1e-11, 1e-13})
        for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
            for (std::int32_t const operator_kind : {HM_LAPLACE, HM_WEIGHTED}) {
                Case setup = plate(far_and_thin(h), kind, 0);
                Options options = options_of(operator_kind);
                Solved const solved(setup, &options);
                CHECK(largest_error(solved) < 1e-12);
                CHECK((h > 1e-8 || solved.report.residual > options.tolerance));
                if (h < 1e-8) CHECK(solved.report.residual > 1e-10);
                options.operator_kind = HM_CONFORMAL;  // the same functions, with complex numbers
                options.exponent = -1;
                if (operator_kind == HM_LAPLACE)
                    CHECK(largest_difference(Solved(setup, &options).all_values(),
                                             solved.all_values()) < 1e-11);
                options = options_of(operator_kind);
                options.tolerance = 1e-300;  // what nothing reaches is told
                CHECK(Attempt(setup.problem(), &options).status == HM_NOT_CONVERGED);
            }
}

TEST_CASE("a factor that is damaged is healed by refinement, or the functions are called wrong") {
    for (double const h : {1e-1, 1e-6, 1e-9, 1e-12}) {
        Damage damage;
        Case setup = plate(far_and_thin(h), Cells::hybrid, 0);
        Options const options = options_of(HM_LAPLACE);
        Solved solved(setup, &options);
        harmorph::Span<double> const factor =
            inside(solved.plan).engine().direct.factor.numbers.factor;
        std::mt19937 random(3);
        for (int k = 0; k < 60; ++k) {
            double& entry = factor[random() % factor.size()];
            damage.test(solved, entry, [](double) { return 0.0; });
            damage.test(solved, entry, [](double x) { return -x; });
            damage.test(solved, entry, [](double x) { return 1.01 * x; });
            damage.test(solved, entry, [](double x) { return 1e9 * x; });
            damage.test(solved, entry, [](double x) { return x + 1e-4; });
        }
        INFO("cells " << h << " thin");
        CHECK(damage.healed > 0);
        CHECK(damage.told > 0);
    }
}

TEST_CASE("solutions that are spoilt before they are judged are refined, those in thin cells too") {
    struct Spoiler {
        double* value = nullptr;
        std::size_t first = 0, n = 0, stride = 1;
        static std::int32_t call(void* user, std::int32_t phase, double fraction) {
            Spoiler& spoiler = *static_cast<Spoiler*>(user);
            if (phase != HM_PHASE_SOLVE || fraction < 1 || spoiler.value == nullptr) return 0;
            for (std::size_t k = 0; k < spoiler.n * spoiler.stride; ++k)
                spoiler.value[spoiler.first * spoiler.stride + k] += 1e-3;
            return 0;
        }
    };
    for (double const h : {1e-1, 1e-6, 1e-9, 1e-12})
        for (std::size_t const n_rows : {1u, 2u, 3u, 4u}) {
            Spoiler spoiler;
            Case setup = plate(far_and_thin(h), Cells::quads, 0);
            Options options = options_of(HM_LAPLACE);
            options.progress = Spoiler::call;
            options.progress_user = &spoiler;
            Solved solved(setup, &options);
            harmorph::Basis const basis = harmorph::Basis::view(static_cast<void*>(solved.basis));
            spoiler = {basis.value.data(), 2 * 17, 17 * n_rows, std::size_t(basis.row_length())};
            REQUIRE(hm_plan_solve(solved.plan, solved.basis, &solved.report, nullptr) == HM_OK);
            CHECK(solved.report.refinements > 0);
            CHECK(largest_error(solved) < 1e-12);
        }
}
