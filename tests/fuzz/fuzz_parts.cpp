// Work in parts: shares of the functions, or a mesh that is cut into parts.
#include "describe.hpp"
#include "target.hpp"
#include "work_in_parts.hpp"

namespace fuzz {

Outcome run_parts(Input& input) {
    std::unique_ptr<Problem> const problem =
        make_problem(input, input.one_in(3) ? Cells::polygons : Cells::triangles_and_quads);
    Solution solution(*problem, input);
    if (solution.status < 0) return Outcome::refused;
    told(*problem, [&] {
        if (input.one_in(2)) check_shares(solution, input);
        else check_cut_mesh(solution, input);
    });
    return Outcome::done;
}

}  // namespace fuzz
