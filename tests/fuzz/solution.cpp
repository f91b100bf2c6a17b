#include "solution.hpp"

namespace fuzz {

void expect_told(hm_status status, hm_error const& error) {
    expect(status >= HM_CROSSING && status <= HM_POOR, "a status that does not exist");
    expect(error.code == status, "error.code is not the status");
    std::size_t const length = strnlen(error.text, sizeof error.text);
    expect(length < sizeof error.text, "a text without an end");
    if (status != HM_OK) expect(length > 10, "no text");
}

Block& Solution::block(std::size_t bytes) {
    blocks_.emplace_back(bytes, input_.one_in(2) ? input_.below(64) : 0,
                         input_.any_of({0, 0xFF, 0x7F, 0xA5}));
    return blocks_.back();
}

void Solution::expect_intact() const {
    for (Block const& block : blocks_) block.expect_intact();
}

Solution::Solution(Problem const& given_problem, Input& input)
    : problem(given_problem), input_(input) {
    auto const make = [&](auto const& size, auto const& init) {
        status = make_object([this](std::size_t bytes) -> Block& { return block(bytes); }, error,
                             size, init);
        return status >= 0;
    };
    bool const made =
        make(
            [&](std::size_t* bytes) {
                return hm_analysis_size(&problem.problem, &problem.options, bytes, &error);
            },
            [&](void* memory, std::size_t bytes) {
                return hm_analysis_init(&analysis, memory, bytes, &problem.problem,
                                        &problem.options, &error);
            }) &&
        make([&](std::size_t* bytes) { return hm_plan_size(analysis, bytes, &error); },
             [&](void* memory, std::size_t bytes) {
                 return hm_plan_init(&plan, memory, bytes, analysis, &error);
             }) &&
        make([&](std::size_t* bytes) { return hm_basis_size(analysis, bytes, &error); },
             [&](void* memory, std::size_t bytes) {
                 return hm_basis_init(&basis, memory, bytes, analysis, &error);
             });
    if (!made) return;
    status = hm_plan_factor(plan, nullptr, &error);
    expect_told(status, error);
    if (status < 0) return;
    report.struct_size = sizeof report;
    status = hm_plan_solve(plan, basis, &report, &error);
    expect_told(status, error);
    expect_intact();
}

}  // namespace fuzz
