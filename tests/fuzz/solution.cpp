#include "solution.hpp"
#include <fixtures/memory.hpp>

namespace fuzz {

Solution::Solution(Problem const& given_problem, Input& input)
    : problem(given_problem), blocks(input, true) {
    auto const make = [&](auto const& size, auto const& init) {
        status = blocks.make(error, size, init);
        return status >= 0;
    };
    bool const made =
        make(size_by(fixtures::analysis_size, &problem.problem, &problem.options),
             init_by(hm_analysis_init, &analysis, &problem.problem, &problem.options)) &&
        make(size_by(fixtures::plan_size, analysis), init_by(hm_plan_init, &plan, analysis)) &&
        make(size_by(fixtures::basis_size, analysis), init_by(hm_basis_init, &basis, analysis));
    if (made) solve();
}

void Solution::solve() {
    status = hm_plan_factor(plan, nullptr, &error);
    expect_told(status, error);
    if (status < 0) return;
    report.struct_size = sizeof report;
    status = hm_plan_solve(plan, basis, &report, &error);
    expect_told(status, error);
    blocks.expect_intact();
}

}  // namespace fuzz
