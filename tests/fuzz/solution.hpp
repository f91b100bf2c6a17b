// A problem on its way through the calls: analysis, plan, basis, each in a block of exactly its
// size.
#pragma once

#include "problem.hpp"

#include <deque>

namespace fuzz {

// Objects of one problem, as far as they could be made. Each call's promises about refusals and
// blocks are checked.
class Solution {
public:
    Solution(Problem const& problem, Input& input);

    Problem const& problem;
    hm_analysis* analysis = nullptr;
    hm_plan* plan = nullptr;
    hm_basis* basis = nullptr;
    hm_status status = 0;  // of the last call: negative if it was refused
    hm_error error{};
    hm_solve_report report{};

    // A block for a further object, of arbitrary bytes.
    Block& block(std::size_t bytes);
    void expect_intact() const;

private:
    Input& input_;
    std::deque<Block> blocks_;
};

// That a refusal has a code, and a text of one line.
void expect_told(hm_status status, hm_error const& error);

// The size, one byte less, exactly that. block(bytes) gives a Block; size(bytes) and init(memory,
// bytes) write `error`.
template <class MakeBlock, class Size, class Init>
hm_status make_object(MakeBlock const& block, hm_error& error, Size const& size, Init const& init) {
    std::size_t bytes = 0;
    hm_status status = size(&bytes);
    expect_told(status, error);
    if (status < 0) return status;
    expect(bytes > 0, "an object without a size");
    if (bytes > std::size_t{1} << 28) return HM_BAD_ARGUMENT;  // of counts that were made wrong
    Block& made = block(bytes);
    hm_status const less = init(made.data(), bytes - 1);
    expect_told(less, error);
    expect(less < 0, "a block that is one byte too small is taken");
    bool const was_too_small = less == HM_BLOCK_TOO_SMALL;
    status = init(made.data(), bytes);
    expect_told(status, error);
    made.expect_intact();
    if (status >= 0) expect(was_too_small, "one byte less: another reason");
    expect(status != HM_BLOCK_TOO_SMALL, "a block of the stated size is too small");
    return status;
}

}  // namespace fuzz
