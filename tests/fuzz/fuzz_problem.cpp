// Any problem, valid or broken, through the calls of the C interface; what succeeds is compared
// with what it has to be.
#include <harmorph_study.h>
#include "describe.hpp"
#include <fixtures/memory.hpp>
#include "solution_check.hpp"
#include "target.hpp"

#include <cmath>
#include <cstring>

namespace fuzz {

SolutionCheck::SolutionCheck(Solution& solution, Judged judged, Input& input)
    : its_(solution), problem_(solution.problem), input_(input), judged_(std::move(judged)) {
    info_ = info_of(its_.basis);
    n_ = problem_.domain.points.size();
    move_.resize(2 * at(info_.functions));
    double const far = input_.any_of({1e-6, 0.02, 0.3, 2.0}) * extent();
    for (double& number : move_) number = far * input_.between(-1, 1);
    for (std::size_t k = 2 * at(problem_.on_walls.view.n_control) + 2; k < move_.size(); k += 4)
        move_[k] = input_.between(-2, 0.5),
        move_[k + 1] = input_.between(-1, 1);  // turns of bodies
}

void SolutionCheck::all() {
    values();
    wall();
    displacement();
    adjoint();
    if (input_.one_in(2)) derived_bases();
    if (input_.one_in(4)) improvement();
    if (input_.one_in(2)) safe_morph();
    its_.blocks.expect_intact();
}

double SolutionCheck::extent() const {
    Point low = problem_.domain.points[0], high = low;
    for (Point const& p : problem_.domain.points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return std::max(high.x - low.x, high.y - low.y) / 10;
}

std::vector<Point> SolutionCheck::moved(Numbers const& x, Numbers const& y) const {
    std::vector<Point> out;
    for (std::size_t k = 0; k < n_; ++k) out.push_back({x[k], y[k]});
    return out;
}

namespace {

// Returns the numbers of a solution, to compare bits: the functions, and the mesh after a movement,
// which needs more than one linear step in about half of the problems.
std::vector<double> results_of(Solution& solution) {
    hm_basis_info const info = info_of(solution.basis);
    std::size_t const n = solution.problem.domain.points.size();
    std::vector<double> all{double(solution.status), solution.report.residual}, values(n), x(n),
        y(n);
    for (std::int32_t i = 0; i < info.functions; ++i)
        for (std::int32_t number = 0; number < info.numbers_per_value; ++number) {
            hm_basis_values(solution.basis, i, number, values.data(), nullptr);
            all.insert(all.end(), values.begin(), values.end());
        }
    std::size_t bytes = 0;
    if (fixtures::safe_move_size(solution.plan, solution.basis, &bytes, nullptr) < 0) return all;
    std::vector<double> move(2 * at(info.functions));
    for (std::size_t k = 0; k < move.size(); ++k)
        move[k] = 0.05 * solution.problem.size() * (k % 3 == 0 ? 1 : -0.5);
    for (std::size_t k = 2 * at(solution.problem.on_walls.view.n_control) + 2; k < move.size();
         k += 4)
        move[k] = -0.5, move[k + 1] = 0.7;
    hm_points_out const out{x.data(), y.data(), 1};
    all.push_back(fixtures::safe_move(solution.plan, solution.basis, move.data(), &out, nullptr,
                                      solution.blocks.take(bytes).data(), bytes, nullptr, nullptr,
                                      nullptr));
    all.insert(all.end(), x.begin(), x.end());
    all.insert(all.end(), y.begin(), y.end());
    return all;
}

// The problem is solved again in blocks that held other bytes and begin at other addresses.
void expect_same_bits(Solution& one, Input& input) {
    Solution other(one.problem, input);
    expect(other.status == one.status, "other bytes in the blocks, another status");
    std::vector<double> const a = results_of(one), b = results_of(other);
    expect(a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0,
           "other bytes in the blocks, other bits");
}

// The mesh moves in its own arrays, the functions are solved there, and all has to hold again.
void again_after_movement(Problem& problem, Solution& solution, SolutionCheck& check,
                          Judged const& judged, Input& input) {
    std::vector<Point> const origin = problem.domain.points, points = check.next_mesh();
    if (points.empty()) return;
    problem.move_to(points);
    solution.solve();
    if (problem.options.scheme == HM_BOUNDED)
        return expect(solution.status == HM_UNSUPPORTED,
                      "the bounded scheme is solved with the triangles of another mesh");
    expect_done(solution.status, solution.error, "a solution on a mesh that has moved");
    SolutionCheck again(solution, judged, input);
    again.recovered_from(origin);
    again.all();
}

Outcome run_with(Cells cells, Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input, cells);
    bool const is_broken = !input.one_in(2);
    if (is_broken) break_something(*problem, input);
    Exceptions::clear();
    Solution solution(*problem, input);
    if (!is_broken && solution.status >= 0) Exceptions::expect_none("a solution");
    if (is_broken)
        Exceptions::expect_none(solution.status >= 0 ? "a broken problem that is solved"
                                                     : solution.error.text);
    if (!is_broken && solution.analysis != nullptr)
        expect(inverted_cells(judge_by_header(problem->domain), problem->domain.points,
                              -rounding_of_turns(problem->domain)) == 0,
               "a mesh with inverted cells is taken");
    if (solution.status < 0) return Outcome::refused;
    if (is_broken) return Outcome::done;
    told(*problem, [&] {
        if (input.one_in(4)) return expect_same_bits(solution, input);
        Judged const judged = judge_by_header(problem->domain);
        SolutionCheck check(solution, judged, input);
        check.all();
        if (input.one_in(3)) again_after_movement(*problem, solution, check, judged, input);
    });
    return Outcome::done;
}

}  // namespace

Outcome run_problem(Input& input) { return run_with(Cells::triangles_and_quads, input); }

Outcome run_polygons(Input& input) { return run_with(Cells::polygons, input); }

}  // namespace fuzz
