// A problem on its way through the calls: analysis, plan, basis, each in a block of exactly its size.
#pragma once

#include "problem.hpp"

#include <deque>

namespace fuzz {

// Objects of one problem, as far as they could be made. Each call's promises about refusals and blocks are checked.
class Solution {
public:
    Solution(Problem const& problem, Input& input);

    Problem const& problem;
    hm_analysis* analysis = nullptr;
    hm_plan* plan = nullptr;
    hm_basis* basis = nullptr;
    hm_status status = 0;   // of the last call: negative if it was refused
    hm_error error{};
    hm_solve_report report{};

    // A block for a further object, of arbitrary bytes.
    Block& block(std::size_t bytes);
    void expect_intact() const;

private:
    template <class Size, class Init>
    bool make(Size const& size, Init const& init);

    Input& input_;
    std::deque<Block> blocks_;
};

// That a refusal has a code, and a text of one line.
void expect_told(hm_status status, hm_error const& error);

}   // namespace fuzz
