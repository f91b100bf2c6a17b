// A problem on its way through the calls: analysis, plan, basis, each in a block of exactly its
// size.
#pragma once

#include "problem.hpp"

namespace fuzz {

// Objects of one problem, as far as they could be made. Each call's promises about refusals and
// blocks are checked.
class Solution {
public:
    Solution(Problem const& problem, Input& input);
    void solve();  // at the coordinates of the mesh, which may have moved

    Problem const& problem;
    hm_analysis* analysis = nullptr;
    hm_plan* plan = nullptr;
    hm_basis* basis = nullptr;
    hm_status status = 0;  // of the last call: negative if it was refused
    hm_error error{};
    hm_solve_report report{};

    Blocks blocks;  // for further objects, too
};

}  // namespace fuzz
