// Random legal calls in any order, and a model of what they do: each basis is a table of numbers,
// which a dense system of equations, products of dense matrices and copies of rows make. The
// equations are those of all operators of the compact scheme, with their weights, on the triangles
// of all cells, also of polygons, whose division is found independently. Whatever the library says
// that it has done, the numbers of its bases, and what they move, have to be those of the tables.
#include <harmorph_bases.h>
#include "private.h"
#include <harmorph_study.h>
#include "dense_solution.hpp"
#include "describe.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;

class Model {
public:
    Model(Solution& solved, Judged const& judged, Input& input)
        : its_(solved), problem_(solved.problem), input_(input) {
        hm_basis_info const info = info_of(solved.basis);
        n_points_ = at(info.points);
        Table on_walls(at(info.functions), Values(n_points_, 0));
        std::vector<bool> is_on_wall(n_points_, false);
        for (std::int32_t slot = 0; slot < info.curve_points; ++slot) {
            std::size_t const point = at(info.curve_point[slot]);
            is_on_wall[point] = true;
            Numbers const values =
                basis_functions(problem_.on_walls.view, info.point_curve[slot], info.point_u[slot]);
            for (std::size_t i = 0; i < values.size(); ++i) on_walls[i][point] = values[i];
        }
        whole_ = DenseSolution<Wide>(problem_, judged, on_walls, is_on_wall).values;
        held_.push_back({solved.basis, whole_, 0, true});
        // The library rounds as this does, at least.
        Table const rounded = DenseSolution<double>(problem_, judged, on_walls, is_on_wall).values;
        for (std::size_t i = 0; i < whole_.size(); ++i)
            for (std::size_t k = 0; k < n_points_; ++k)
                rounding_ = std::max(rounding_, 4 * std::abs(rounded[i][k] - whole_[i][k]));
    }

    Outcome run() {
        for (std::int32_t k = input_.from(2, 12); k > 0; --k) {
            call();
            check(held_[input_.below(static_cast<std::uint32_t>(held_.size()))]);
        }
        for (Held const& one : held_) check(one);
        its_.blocks.expect_intact();
        return Outcome::done;
    }

private:
    struct Held {
        hm_basis* basis;
        Table values;        // what the model says, of the functions that are stored
        std::int32_t first;  // of these functions
        bool is_whole;       // all points of the mesh, all functions of control points, in double
                             // precision
        bool is_solved = true;
        bool has_all = true;
        double tolerance = 1e-6;
    };

    void done(hm_status status, const char* what) { expect_done(status, error_, what); }
    template <class Size, class Init>
    void make(const char* what, Size const& size, Init const& init) {
        std::size_t bytes = 0;
        done(size(&bytes, &error_), what);
        done(init(its_.blocks.take(bytes).data(), bytes, &error_), what);
    }
    Held& some() { return held_[input_.below(static_cast<std::uint32_t>(held_.size()))]; }
    std::int32_t functions() const { return static_cast<std::int32_t>(whole_.size()); }

    void call() {
        Held from = some();  // a copy: the list of bases may grow
        bool const is_usable = from.is_solved && from.has_all;
        switch (input_.below(7)) {
            case 0: return solve();
            case 1: return share();
            case 2: return transfer();
            case 3: return is_usable ? extract(from) : void();
            case 4: return is_usable && from.tolerance < 1e-5 ? combine(from) : void();
            case 5: return is_usable && from.tolerance < 1e-5 ? single(from) : void();
            default: return is_usable ? move(from) : void();
        }
    }

    // A new basis; or again one of those that the plan knows.
    void solve() {
        hm_basis* basis = nullptr;
        make("a basis", size_by(fixtures::basis_size, its_.analysis),
             init_by(hm_basis_init, &basis, its_.analysis));
        bool const is_solved = input_.one_in(2);
        if (is_solved) done(hm_plan_solve(its_.plan, basis, nullptr, &error_), "a solution");
        held_.push_back({basis, whole_, 0, true, is_solved});
    }
    void share() {
        std::int32_t const first = input_.from(0, functions() - 1),
                           n = input_.from(1, functions() - first);
        hm_basis* basis = nullptr;
        make("a share", size_by(hm_private_share_size, its_.analysis, first, n),
             init_by(hm_private_share_init, &basis, its_.analysis, first, n));
        done(hm_plan_solve(its_.plan, basis, nullptr, &error_), "a share's solution");
        held_.push_back({basis, Table(whole_.begin() + first, whole_.begin() + first + n), first,
                         false, true, n == functions()});
    }
    // Within 1e-12 of the length of a side, a place is in both of its cells.
    bool has_extreme_sides() const {
        double least = HUGE_VAL, most = 0;
        for (Cell const& cell : problem_.domain.cells)
            for (std::size_t k = 0; k < cell.size(); ++k) {
                Point const a = problem_.domain.points[at(cell[k])],
                            b = problem_.domain.points[at(cell[(k + 1) % cell.size()])];
                double const side = std::hypot(b.x - a.x, b.y - a.y);
                if (side > 0) least = std::min(least, side);
                most = std::max(most, side);
            }
        return least < 1e-8 * most;
    }
    // Transfers functions from the mesh to itself; if this succeeds, the functions of one basis are
    // those of the other one.
    void transfer() {
        if (has_extreme_sides()) return;
        std::size_t const source = input_.below(static_cast<std::uint32_t>(held_.size()));
        std::size_t target = input_.below(static_cast<std::uint32_t>(held_.size()));
        while (!held_[target].is_whole) target = (target + 1) % held_.size();  // the first one is
        std::size_t bytes = 0;
        done(fixtures::transfer_size(its_.analysis, &problem_.mesh, &bytes, &error_),
             "a transfer's size");
        Block const work(bytes, 0, 0x7F);
        hm_status const status =
            hm_transfer(held_[target].basis, fixtures::Memory(work.data(), bytes), its_.analysis,
                        held_[source].basis, &problem_.mesh, nullptr, &error_);
        expect_told(status, error_);
        bool const is_legal = held_[source].is_whole && held_[source].is_solved && source != target;
        expect(status >= 0 || !is_legal, std::string("a transfer is refused: ") + error_.text);
        if (status < 0) return;
        held_[target].values = held_[source].values;  // were they those of the target?
        held_[target].is_solved = true;
    }
    void extract(Held const& from) {
        std::int32_t const base = problem_.mesh.index_base, n_from = info_of(from.basis).points;
        std::vector<std::int32_t> list(input_.below(20) + 1);
        for (std::int32_t& k : list) k = input_.from(0, n_from - 1) + base;
        std::int32_t const n = static_cast<std::int32_t>(list.size());
        hm_basis* basis = nullptr;
        make("rows", size_by(hm_private_extract_size, from.basis, n),
             init_by(hm_private_extract_init, &basis, from.basis, n, list.data()));
        Table values;
        for (Values const& function : from.values) {
            values.emplace_back();
            for (std::int32_t const k : list) values.back().push_back(function[at(k - base)]);
        }
        held_.push_back({basis, values, 0, false, true, true, from.tolerance});
    }
    void combine(Held const& from) {
        std::size_t const rows = from.values.size(),
                          n = 1 + input_.below(static_cast<std::uint32_t>(rows));
        std::size_t const numbers = 1 + input_.below(2);
        Numbers matrix(rows * n * numbers);
        for (double& entry : matrix) entry = input_.between(-1, 1);
        for (std::size_t j = 0; j < n; ++j)
            matrix[(j * n + j) * numbers] += 4;  // columns are far from dependent
        std::int32_t const columns = static_cast<std::int32_t>(n);
        hm_basis* basis = nullptr;
        make(
            "a combination",
            size_by(fixtures::combine_size, from.basis, columns, std::int32_t(numbers)),
            init_by(hm_combine, &basis, from.basis, columns, std::int32_t(numbers), matrix.data()));
        Table values(n, Values(from.values[0].size(), 0));
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < rows; ++i) {
                const double* const entry = &matrix[(i * n + j) * numbers];
                Complex const by(entry[0], numbers == 2 ? entry[1] : 0);
                for (std::size_t k = 0; k < values[j].size(); ++k)
                    values[j][k] += by * from.values[i][k];
            }
        held_.push_back({basis, values, 0, false});
    }
    void single(Held const& from) {
        hm_basis* basis = nullptr;
        make("a basis in single precision", size_by(fixtures::single_size, from.basis),
             init_by(hm_single_init, &basis, from.basis));
        held_.push_back({basis, from.values, 0, false, true, true, 2e-5});
    }

    // A movement, and the transpose, by sums over the table.
    void move(Held const& from) {
        std::size_t const n = from.values[0].size(), m = from.values.size();
        Numbers by(2 * m), x(n, 7), y(n, 7), dj(2 * n), gradient(2 * m);
        for (double& number : by) number = input_.between(-1, 1);
        for (double& number : dj) number = input_.between(-1, 1);
        hm_points_out const to{x.data(), y.data(), 1};
        done(hm_morph(from.basis, by.data(), nullptr, &to, nullptr, &error_), "a movement");
        hm_points const forces{dj.data(), dj.data() + 1, 2};
        done(hm_adjoint(from.basis, &forces, gradient.data(), nullptr, &error_), "a gradient");
        Values expected(m, 0);
        double const largest = largest_of(from.values);
        for (std::size_t k = 0; k < n; ++k) {
            Complex moved = 0;
            for (std::size_t i = 0; i < m; ++i) {
                moved += from.values[i][k] * Complex(by[2 * i], by[2 * i + 1]);
                expected[i] += std::conj(from.values[i][k]) * Complex(dj[2 * k], dj[2 * k + 1]);
            }
            expect(std::abs(moved - Complex(x[k], y[k])) <=
                       2 * (from.tolerance + rounding_) * largest * static_cast<double>(m),
                   "a point moves otherwise than in the model");
        }
        for (std::size_t i = 0; i < m; ++i)
            expect(std::abs(expected[i] - Complex(gradient[2 * i], gradient[2 * i + 1])) <=
                       2 * (from.tolerance + rounding_) * largest * static_cast<double>(n),
                   "a gradient differs from that of the model");
    }

    static double largest_of(Table const& values) {
        double out = 1;
        for (Values const& function : values)
            for (Complex const value : function) out = std::max(out, std::abs(value));
        return out;
    }
    void check(Held const& one) {
        expect((info_of(one.basis).solved == 1) == one.is_solved,
               "a basis is solved, or not, against the model");
        if (!one.is_solved) return;
        double const within = (one.tolerance + rounding_) * largest_of(one.values);
        std::int32_t const n_numbers = info_of(one.basis).numbers_per_value;
        for (std::size_t i = 0; i < one.values.size(); ++i) {
            std::int32_t const function = one.first + static_cast<std::int32_t>(i);
            Numbers found[2];
            for (Numbers& numbers : found) numbers.assign(one.values[i].size(), 0);
            for (std::int32_t number = 0; number < n_numbers; ++number)
                done(hm_basis_values(one.basis, function, number, found[number].data(), &error_),
                     "a function's values");
            for (std::size_t k = 0; k < one.values[i].size(); ++k) {
                double const off = std::abs(Complex(found[0][k], found[1][k]) - one.values[i][k]);
                expect(off <= within, "a function differs from the model by " + shown(off));
            }
        }
    }

    Solution& its_;
    Problem const& problem_;
    Input& input_;
    std::size_t n_points_ = 0;
    Table whole_;
    double rounding_ = 0;  // that of the dense solution in doubles
    std::vector<Held> held_;
    hm_error error_{};
};

// Walls on curves, any operator of the compact scheme; all else is fixed.
void simplify(Problem& problem, Input& input) {
    std::vector<hm_condition> kept;
    for (hm_condition const& condition : problem.conditions)
        if (condition.kind == HM_ON_CURVE) kept.push_back(condition);
    problem.conditions = kept;
    problem.problem.n_conditions = static_cast<std::int32_t>(kept.size());
    problem.problem.conditions = problem.conditions.data();
    const hm_executor* const executor = problem.options.executor;
    problem.options = Options();
    problem.options.operator_kind = input.from(HM_CONFORMAL, HM_WEIGHTED);
    if (problem.options.operator_kind != HM_LAPLACE && input.one_in(2))
        problem.options.exponent = 0.25 * input.from(-1, 16);
    problem.options.executor = executor;
}

}  // namespace

Outcome run_model(Input& input) {
    std::unique_ptr<Problem> const problem =
        make_problem(input, input.one_in(3) ? Cells::polygons : Cells::triangles_and_quads);
    simplify(*problem, input);
    if (problem->conditions.empty()) return Outcome::refused;
    Judged const judged = judge_by_header(problem->domain);
    if (judged.ambiguous > 0) return Outcome::refused;
    Solution solution(*problem, input);
    if (solution.status != HM_OK || solution.report.functions < 1) return Outcome::refused;
    return told(*problem, [&] { return Model(solution, judged, input).run(); });
}

}  // namespace fuzz
