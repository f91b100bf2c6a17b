// Calls in any order, with objects of two problems that may or may not belong together. Each is
// refused with a reason and writes nothing, or succeeds with finite numbers.
#include <harmorph_design.h>
#include <harmorph_parts.h>
#include <harmorph_study.h>
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <optional>

namespace fuzz {
namespace {

class Sequence {
public:
    explicit Sequence(Input& input)
        : input_(input), problem_{make_problem(input), make_problem(input)} {
        for (std::size_t k = 0; k < 2; ++k) {
            all_[k].emplace(*problem_[k], input);
            std::size_t bytes = 0;
            if (all_[k]->analysis == nullptr ||
                hm_basis_size(all_[k]->analysis, &bytes, nullptr) < 0)
                continue;
            hm_basis* fresh = nullptr;  // a basis that is not solved
            if (hm_basis_init(&fresh, all_[k]->block(bytes).data(), bytes, all_[k]->analysis,
                              nullptr) >= 0)
                fresh_[k] = fresh;
        }
        std::size_t const most =
            std::max(problem_[0]->domain.points.size(), problem_[1]->domain.points.size());
        x_.assign(most, 7);
        y_.assign(most, 7);
        move_.resize(2 * most + 200);
        for (double& number : move_) number = 0.01 * input.between(-1, 1);
    }

    Outcome run() {
        bool any = false;
        for (std::int32_t k = input_.from(3, 20); k > 0; --k) {
            error_ = {};
            hm_status const status = call();
            if (status == none) continue;
            expect_told(status, error_);
            any = any || status >= 0;
            if (status < 0) expect_untouched();
            std::fill(x_.begin(), x_.end(), 7.0);
            std::fill(y_.begin(), y_.end(), 7.0);
        }
        for (std::optional<Solution>& its : all_) its->expect_intact();
        return any ? Outcome::done : Outcome::refused;
    }

private:
    static constexpr hm_status none = 1000;

    Solution& some() { return *all_[input_.below(2)]; }
    hm_basis* some_basis() {
        std::uint32_t const k = input_.below(2);
        return input_.one_in(3) && fresh_[k] != nullptr ? fresh_[k] : all_[k]->basis;
    }
    void expect_untouched() const {
        for (double const its : x_) expect(its == 7, "a refused call has written");
        for (double const its : y_) expect(its == 7, "a refused call has written");
    }

    hm_status call() {
        hm_basis* const basis = some_basis();
        hm_plan* const plan = some().plan;
        hm_mesh const& mesh = problem_[input_.below(2)]->mesh;
        hm_points_out const out{x_.data(), y_.data(), 1};
        hm_points const in{x_.data(), y_.data(), 1};
        if (basis == nullptr || plan == nullptr) return none;
        std::size_t bytes = 0;
        switch (input_.below(11)) {
            case 0: return hm_plan_factor(plan, nullptr, &error_);
            case 1: {
                hm_solve_report report{};
                report.struct_size = sizeof report;
                return hm_plan_solve(plan, basis, &report, &error_);
            }
            case 2:
                return hm_morph(basis, move_.data(), input_.one_in(2) ? &in : nullptr, &out,
                                nullptr, &error_);
            case 3: {
                std::vector<double> gradient(move_.size());
                return hm_adjoint(basis, &in, gradient.data(), nullptr, &error_);
            }
            case 4: {
                hm_quality_report report{};
                report.struct_size = sizeof report;
                return hm_assess(basis, &mesh, nullptr, nullptr, nullptr, nullptr, nullptr, &report,
                                 &error_);
            }
            case 5: {
                hm_step_report report{};
                report.struct_size = sizeof report;
                return hm_assess(basis, &mesh, nullptr, &in, nullptr, nullptr, &report, nullptr,
                                 &error_);
            }
            case 6: {
                hm_status const status = hm_morph_safe_size(plan, basis, &bytes, &error_);
                if (status < 0) return status;
                Block const work(bytes, 0, 0x7F);
                hm_safe_options options{};
                options.struct_size = sizeof options;
                const hm_basis* const other = some_basis();
                if (input_.one_in(3)) options.others = &other, options.n_others = 1;
                hm_basis* const derivative = input_.one_in(3) ? some_basis() : nullptr;
                if (derivative == basis || (options.n_others > 0 && other == nullptr)) return none;
                return hm_morph_safe(plan, basis, move_.data(), &out, derivative, work.data(),
                                     bytes, &options, nullptr, &error_);
            }
            case 7: {
                Solution& fine = some();
                if (fine.analysis == nullptr) return none;
                hm_status const status = hm_transfer_size(fine.analysis, &mesh, &bytes, &error_);
                if (status < 0) return status;
                Block const work(bytes, 0, 0x7F);
                hm_basis* const coarse = some_basis();
                if (coarse == nullptr || coarse == basis) return none;
                return hm_transfer(basis, work.data(), bytes, fine.analysis, coarse, &mesh, nullptr,
                                   &error_);
            }
            case 8: {
                double doubles[4096];
                std::int64_t n = 0;
                std::int32_t const points[] = {mesh.index_base, mesh.index_base + 1};
                hm_status const status = hm_parcel_size(basis, 2, &n, &error_);
                if (status < 0 || n > 4096) return status;
                return hm_parcel_pack(basis, 2, points, doubles, &error_);
            }
            case 9: {
                Solution& its = some();
                if (its.analysis == nullptr) return none;
                std::int32_t const functions = its.problem.functions(),
                                   first = input_.from(-1, functions);
                hm_status const status = hm_share_size(
                    its.analysis, first, input_.from(-1, functions + 1), &bytes, &error_);
                return status;
            }
            default: {
                double worst = 0;
                return hm_boundary_error(basis, move_.data(), &in, &in, &worst, nullptr, &error_);
            }
        }
    }

    Input& input_;
    std::unique_ptr<Problem> problem_[2];
    std::optional<Solution> all_[2];
    hm_basis* fresh_[2] = {};
    std::vector<double> x_, y_, move_;
    hm_error error_{};
};

}  // namespace

Outcome run_sequence(Input& input) { return Sequence(input).run(); }

}  // namespace fuzz
