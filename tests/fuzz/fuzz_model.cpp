// Random legal calls in any order, and a model of what they do: each basis is a table of numbers,
// which a dense system of equations, products of dense matrices and copies of rows make. The
// equations are those of Laplace's operator on the triangles of all cells, also of polygons, whose
// division is found independently. Whatever the library says that it has done, the numbers of its
// bases, and what they move, have to be those of the tables.
#include <harmorph_bases.h>
#include <harmorph_parts.h>
#include <harmorph_study.h>
#include "describe.hpp"
#include "reference.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <map>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;
using Table = std::vector<Numbers>;  // of each function the values at all points of a basis

// The functions of the control points on the mesh, by elimination in a dense matrix.
class DenseSolution {
public:
    DenseSolution(Domain const& domain, Judged const& judged, Table const& on_walls,
                  std::vector<bool> const& is_on_wall)
        : points_(domain.points), same_(points_.size()), row_of_(points_.size(), -1) {
        std::vector<Point> const& points = points_;
        std::map<std::pair<double, double>, std::size_t> first;  // points at one place are one
        for (std::size_t k = 0; k < points.size(); ++k)
            same_[k] = first.try_emplace({domain.points[k].x, domain.points[k].y}, k).first->second;
        std::vector<bool> known(points.size(), true);
        for (Cell const& cell : domain.cells)
            for (std::int32_t const k : cell) known[same_[at(k)]] = false;
        for (Face const& face : domain.faces)
            known[same_[at(face.from)]] = known[same_[at(face.to)]] = true;
        for (std::size_t k = 0; k < points.size(); ++k)
            if (same_[k] == k && !known[k]) row_of_[k] = n_++;
        columns_ = on_walls.size();
        rows_.assign(at(n_), std::vector<long double>(at(n_) + columns_, 0));
        for (auto const& [a, b, c] : judged.triangles) {
            std::int32_t const corner[] = {a, b, c};
            add_triangle(corner, 1, on_walls, is_on_wall);
        }
        for (std::size_t number = 0; number < domain.cells.size(); ++number) {
            Cell const& cell = domain.cells[number];
            for (std::size_t k = 0; k < cell.size();
                 ++k) {  // a triangle once, a quadrilateral by both its splits
                if (judged.is_divided[number] || (cell.size() == 3 && k > 0)) break;
                std::int32_t const corner[] = {cell[(k + cell.size() - 1) % cell.size()], cell[k],
                                               cell[(k + 1) % cell.size()]};
                add_triangle(corner, cell.size() == 3 ? 1 : 0.5L, on_walls, is_on_wall);
            }
        }
        eliminate();
        values.assign(columns_, Numbers(points.size(), 0));
        for (std::size_t i = 0; i < columns_; ++i)
            for (std::size_t k = 0; k < points.size(); ++k) {
                std::int32_t const row = row_of_[same_[k]];
                if (row >= 0) values[i][k] = static_cast<double>(rows_[at(row)][at(n_) + i]);
                else if (is_on_wall[same_[k]]) values[i][k] = on_walls[i][same_[k]];
            }
    }

    Table values;

private:
    void add_triangle(std::int32_t const (&corner)[3], long double weight, Table const& on_walls,
                      std::vector<bool> const& is_on_wall) {
        for (std::size_t apex = 0; apex < 3; ++apex) {
            std::size_t const a = at(corner[(apex + 1) % 3]), b = at(corner[(apex + 2) % 3]),
                              c = at(corner[apex]);
            long double const ux = points_[a].x - points_[c].x, uy = points_[a].y - points_[c].y,
                              vx = points_[b].x - points_[c].x, vy = points_[b].y - points_[c].y;
            long double const k = 0.5L * weight * (ux * vx + uy * vy) / (ux * vy - uy * vx);
            for (bool const turned : {false, true}) {
                std::size_t const p = same_[turned ? b : a], q = same_[turned ? a : b];
                if (row_of_[p] < 0) continue;
                std::vector<long double>& row = rows_[at(row_of_[p])];
                row[at(row_of_[p])] += k;
                if (row_of_[q] >= 0) row[at(row_of_[q])] -= k;
                for (std::size_t i = 0; i < columns_ && is_on_wall[q]; ++i)
                    row[at(n_) + i] += k * on_walls[i][q];
            }
        }
    }
    void eliminate() {
        std::size_t const n = at(n_);
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t pivot = k;
            for (std::size_t r = k; r < n; ++r)
                if (std::abs(rows_[r][k]) > std::abs(rows_[pivot][k])) pivot = r;
            std::swap(rows_[k], rows_[pivot]);
            for (std::size_t r = 0; r < n; ++r) {
                if (r == k || rows_[r][k] == 0) continue;
                long double const factor = rows_[r][k] / rows_[k][k];
                for (std::size_t c = k; c < n + columns_; ++c) rows_[r][c] -= factor * rows_[k][c];
            }
        }
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = n; i < n + columns_; ++i) rows_[k][i] /= rows_[k][k];
    }

    std::vector<Point> points_;
    std::vector<std::size_t> same_;
    std::vector<std::int32_t> row_of_;
    std::int32_t n_ = 0;
    std::size_t columns_ = 0;
    std::vector<std::vector<long double>> rows_;
};

class Model {
public:
    Model(Solution& solved, Judged const& judged, Input& input)
        : its_(solved), problem_(solved.problem), input_(input) {
        hm_basis_info const info = info_of(solved.basis);
        n_points_ = at(info.points);
        Table on_walls(at(info.functions), Numbers(n_points_, 0));
        std::vector<bool> is_on_wall(n_points_, false);
        for (std::int32_t slot = 0; slot < info.curve_points; ++slot) {
            std::size_t const point = at(info.curve_point[slot]);
            is_on_wall[point] = true;
            Numbers const values =
                basis_functions(problem_.on_walls.view, info.point_curve[slot], info.point_u[slot]);
            for (std::size_t i = 0; i < values.size(); ++i) on_walls[i][point] = values[i];
        }
        DenseSolution const solution(problem_.domain, judged, on_walls, is_on_wall);
        whole_ = solution.values;
        held_.push_back({solved.basis, whole_, 0, true});
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
        make("a basis", size_by(hm_basis_size, its_.analysis),
             init_by(hm_basis_init, &basis, its_.analysis));
        bool const is_solved = input_.one_in(2);
        if (is_solved) done(hm_plan_solve(its_.plan, basis, nullptr, &error_), "a solution");
        held_.push_back({basis, whole_, 0, true, is_solved});
    }
    void share() {
        std::int32_t const first = input_.from(0, functions() - 1),
                           n = input_.from(1, functions() - first);
        hm_basis* basis = nullptr;
        make("a share", size_by(hm_share_size, its_.analysis, first, n),
             init_by(hm_share_init, &basis, its_.analysis, first, n));
        done(hm_plan_solve(its_.plan, basis, nullptr, &error_), "a share's solution");
        held_.push_back({basis, Table(whole_.begin() + first, whole_.begin() + first + n), first,
                         false, true, n == functions()});
    }
    // Transfers functions from the mesh to itself; if this succeeds, the functions of one basis are
    // those of the other one.
    void transfer() {
        std::size_t const source = input_.below(static_cast<std::uint32_t>(held_.size()));
        std::size_t target = input_.below(static_cast<std::uint32_t>(held_.size()));
        while (!held_[target].is_whole) target = (target + 1) % held_.size();  // the first one is
        std::size_t bytes = 0;
        done(hm_transfer_size(its_.analysis, &problem_.mesh, &bytes, &error_), "a transfer's size");
        Block const work(bytes, 0, 0x7F);
        hm_status const status = hm_transfer(held_[target].basis, work.data(), bytes, its_.analysis,
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
        make("rows", size_by(hm_extract_size, from.basis, n),
             init_by(hm_extract_init, &basis, from.basis, n, list.data()));
        Table values;
        for (Numbers const& function : from.values) {
            values.emplace_back();
            for (std::int32_t const k : list) values.back().push_back(function[at(k - base)]);
        }
        held_.push_back({basis, values, 0, false, true, true, from.tolerance});
    }
    void combine(Held const& from) {
        std::size_t const rows = from.values.size(),
                          n = 1 + input_.below(static_cast<std::uint32_t>(rows));
        Numbers matrix(rows * n);
        for (double& entry : matrix) entry = input_.between(-1, 1);
        for (std::size_t j = 0; j < n; ++j)
            matrix[j * n + j] += 4;  // columns are far from dependent
        std::int32_t const columns = static_cast<std::int32_t>(n);
        hm_basis* basis = nullptr;
        make("a combination", size_by(hm_combine_size, from.basis, columns, 1),
             init_by(hm_combine, &basis, from.basis, columns, 1, matrix.data()));
        Table values(n, Numbers(from.values[0].size(), 0));
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < rows; ++i)
                for (std::size_t k = 0; k < values[j].size(); ++k)
                    values[j][k] += matrix[i * n + j] * from.values[i][k];
        held_.push_back({basis, values, 0, false});
    }
    void single(Held const& from) {
        hm_basis* basis = nullptr;
        make("a basis in single precision", size_by(hm_single_size, from.basis),
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
        Numbers expected(2 * m, 0);
        double largest = largest_of(from.values);
        for (std::size_t k = 0; k < n; ++k) {
            double moved_x = 0, moved_y = 0;
            for (std::size_t i = 0; i < m; ++i) {
                moved_x += from.values[i][k] * by[2 * i];
                moved_y += from.values[i][k] * by[2 * i + 1];
                expected[2 * i] += from.values[i][k] * dj[2 * k];
                expected[2 * i + 1] += from.values[i][k] * dj[2 * k + 1];
            }
            double const within = from.tolerance * largest * static_cast<double>(m);
            expect(std::abs(moved_x - x[k]) <= within && std::abs(moved_y - y[k]) <= within,
                   "a point moves otherwise than in the model");
        }
        for (std::size_t i = 0; i < 2 * m; ++i)
            expect(std::abs(expected[i] - gradient[i]) <=
                       from.tolerance * largest * static_cast<double>(n),
                   "a gradient differs from that of the model");
    }

    static double largest_of(Table const& values) {
        double out = 1;
        for (Numbers const& function : values)
            for (double const value : function) out = std::max(out, std::abs(value));
        return out;
    }
    void check(Held const& one) {
        expect((info_of(one.basis).solved == 1) == one.is_solved,
               "a basis is solved, or not, against the model");
        if (!one.is_solved) return;
        double const within = one.tolerance * largest_of(one.values);
        for (std::size_t i = 0; i < one.values.size(); ++i) {
            Numbers found(one.values[i].size(), 7);
            std::int32_t const function = one.first + static_cast<std::int32_t>(i);
            done(hm_basis_values(one.basis, function, 0, found.data(), &error_),
                 "a function's values");
            for (std::size_t k = 0; k < found.size(); ++k)
                expect(std::abs(found[k] - one.values[i][k]) <= within,
                       "a function differs from the model by " +
                           std::to_string(found[k] - one.values[i][k]));
        }
    }

    Solution& its_;
    Problem const& problem_;
    Input& input_;
    std::size_t n_points_ = 0;
    Table whole_;
    std::vector<Held> held_;
    hm_error error_{};
};

// Walls on curves with Laplace's operator; all else is fixed.
void simplify(Problem& problem) {
    std::vector<hm_condition> kept;
    for (hm_condition const& condition : problem.conditions)
        if (condition.kind == HM_ON_CURVE) kept.push_back(condition);
    problem.conditions = kept;
    problem.problem.n_conditions = static_cast<std::int32_t>(kept.size());
    problem.problem.conditions = problem.conditions.data();
    const hm_executor* const executor = problem.options.executor;
    problem.options = Options();
    problem.options.operator_kind = HM_LAPLACE;
    problem.options.executor = executor;
}

}  // namespace

Outcome run_model(Input& input) {
    std::unique_ptr<Problem> const problem =
        make_problem(input, input.one_in(3) ? Cells::polygons : Cells::triangles_and_quads);
    simplify(*problem);
    if (problem->conditions.empty()) return Outcome::refused;
    Judged const judged = judge_by_header(problem->domain);
    if (judged.ambiguous > 0) return Outcome::refused;
    Solution solution(*problem, input);
    if (solution.status != HM_OK || solution.report.functions < 1) return Outcome::refused;
    return told(*problem, [&] { return Model(solution, judged, input).run(); });
}

}  // namespace fuzz
