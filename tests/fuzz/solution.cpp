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
    blocks_.emplace_back(bytes, input_.one_in(2) ? input_.below(64) : 0, input_.any_of({0, 0xFF, 0x7F, 0xA5}));
    return blocks_.back();
}

void Solution::expect_intact() const {
    for (Block const& its : blocks_) its.expect_intact();
}

// The size, one byte less, exactly that.
template <class Size, class Init>
bool Solution::make(Size const& size, Init const& init) {
    std::size_t bytes = 0;
    status = size(&bytes);
    expect_told(status, error);
    if (status < 0) return false;
    expect(bytes > 0, "an object without a size");
    if (bytes > std::size_t{1} << 28) return status = HM_BAD_ARGUMENT, false;   // of counts that were made wrong
    Block& its = block(bytes);
    hm_status const less = init(its.data(), bytes - 1);
    expect_told(less, error);
    expect(less < 0, "a block that is one byte too small is taken");
    bool const was_too_small = less == HM_BLOCK_TOO_SMALL;
    status = init(its.data(), bytes);
    expect_told(status, error);
    its.expect_intact();
    if (status >= 0) expect(was_too_small, "one byte less: another reason");
    expect(status != HM_BLOCK_TOO_SMALL, "a block of the stated size is too small");
    return status >= 0;
}

Solution::Solution(Problem const& its_problem, Input& input) : problem(its_problem), input_(input) {
    bool const made =
        make([&](std::size_t* bytes) { return hm_analysis_size(&problem.problem, &problem.options, bytes, &error); },
             [&](void* memory, std::size_t bytes) {
                 return hm_analysis_init(&analysis, memory, bytes, &problem.problem, &problem.options, &error);
             }) &&
        make([&](std::size_t* bytes) { return hm_plan_size(analysis, bytes, &error); },
             [&](void* memory, std::size_t bytes) { return hm_plan_init(&plan, memory, bytes, analysis, &error); }) &&
        make([&](std::size_t* bytes) { return hm_basis_size(analysis, bytes, &error); },
             [&](void* memory, std::size_t bytes) { return hm_basis_init(&basis, memory, bytes, analysis, &error); });
    if (!made) return;
    status = hm_plan_factor(plan, nullptr, &error);
    expect_told(status, error);
    if (status < 0) return;
    report.struct_size = sizeof report;
    status = hm_plan_solve(plan, basis, &report, &error);
    expect_told(status, error);
    expect_intact();
}

}   // namespace fuzz
