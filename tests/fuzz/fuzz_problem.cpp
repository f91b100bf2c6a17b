// Any problem, valid or broken, through the calls of the C interface; what succeeds is compared with what it has to be.
#include "describe.hpp"
#include "exceptions.hpp"
#include "reference.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>

namespace fuzz {
namespace {

class Check {
public:
    Check(Solution& solution, Input& input) : its_(solution), problem_(solution.problem), input_(input) {
        info_.struct_size = sizeof info_;
        expect(hm_basis_info_get(its_.basis, &info_, &error_) == HM_OK, "no information about a solved basis");
        judged_ = judge_by_header(problem_.domain);
        n_ = problem_.domain.points.size();
        move_.resize(2 * static_cast<std::size_t>(info_.functions));
        double const far = input_.any_of({1e-6, 0.02, 0.3, 2.0}) * extent();
        for (double& number : move_) number = far * input_.between(-1, 1);
        for (std::size_t k = 2 * static_cast<std::size_t>(problem_.on_walls.view.n_control) + 2; k < move_.size(); k += 4)
            move_[k] = input_.between(-2, 0.5), move_[k + 1] = input_.between(-1, 1);   // turns of bodies
    }

    void all() {
        values();
        wall();
        displacement();
        adjoint();
        if (input_.one_in(2)) derived_bases();
        if (input_.one_in(4)) improvement();
        if (input_.one_in(2)) safe_morph();
        its_.expect_intact();
    }

private:
    using Numbers = std::vector<double>;

    double extent() const {
        Point low = problem_.domain.points[0], high = low;
        for (Point const& p : problem_.domain.points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        return std::max(high.x - low.x, high.y - low.y) / 10;
    }
    auto in_its_blocks() const {
        return [this](std::size_t bytes) -> Block& { return its_.block(bytes); };
    }
    // Turned corners are not exact: those of a smaller sine may be on either side.
    double rounding_of_turns() const { return problem_.domain.has_polygons ? -1e-15 : 0; }
    bool is_real() const { return info_.numbers_per_value == 1; }

    // The functions, finite, and solutions of their equation.
    void values() {
        auto const numbers = std::size_t(info_.numbers_per_value);
        value_.assign(std::size_t(info_.functions), std::vector<Numbers>(numbers, Numbers(n_)));
        std::vector<bool> inside(n_, true);
        for (Face const& face : problem_.domain.faces)
            inside[std::size_t(face.from)] = inside[std::size_t(face.to)] = false;
        for (std::int32_t i = 0; i < info_.functions; ++i)
            for (std::int32_t number = 0; number < info_.numbers_per_value; ++number) {
                Numbers& found = value_[std::size_t(i)][std::size_t(number)];
                expect(hm_basis_values(its_.basis, i, number, found.data(), &error_) == HM_OK, "no values");
                for (double const its : found) {
                    expect(std::isfinite(its), "a value is not finite");
                    largest_ = std::max(largest_, std::abs(its));
                }
            }
        bool const is_laplace = problem_.options.operator_kind == HM_LAPLACE && problem_.options.scheme == HM_COMPACT;
        if (!is_laplace || judged_.ambiguous > 0 || its_.status != HM_OK || problem_.options.engine != HM_DIRECT) return;
        for (std::vector<Numbers> const& function : value_)
            for (Numbers const& its : function) {
                double const residual = laplace_residual(problem_.domain, judged_, its, inside);
                expect(residual < 1e-7, "Laplace's equation has the residual " + std::to_string(residual));
            }
    }

    // Points on curves have the basis functions at their parameter.
    void wall() {
        if (info_.offset_correction != 0) return;
        for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
            std::int32_t const curve = info_.point_curve[slot];
            if (curve >= info_.curves) continue;
            Numbers const expected = basis_functions(problem_.on_walls.view, curve, info_.point_u[slot]);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                double const found = value_[i][0][std::size_t(info_.curve_point[slot])];
                expect(std::abs(found - expected[i]) < 1e-11, "a point of the wall has another basis function");
            }
        }
    }

    std::vector<Point> moved(Numbers const& x, Numbers const& y) const {
        std::vector<Point> out;
        for (std::size_t k = 0; k < n_; ++k) out.push_back({x[k], y[k]});
        return out;
    }

    void displacement() {
        Numbers dx(n_, 7), dy(n_, 7), x(n_, 7), y(n_, 7);
        hm_points_out const out{dx.data(), dy.data(), 1}, at{x.data(), y.data(), 1};
        hm_points const by{dx.data(), dy.data(), 1}, to{x.data(), y.data(), 1};
        expect(hm_morph(its_.basis, move_.data(), nullptr, &out, nullptr, &error_) == HM_OK, "no displacement");
        expect(hm_morph(its_.basis, move_.data(), &problem_.mesh.points, &at, nullptr, &error_) == HM_OK, "no morph");
        double largest = 0;
        for (double const number : move_) largest = std::max(largest, std::abs(number));
        for (std::size_t k = 0; k < n_; ++k) {
            is_sum(dx[k], k, 0);
            is_sum(dy[k], k, 1);
            Point const from = problem_.domain.points[k];
            if (dx[k] == 0) expect(x[k] == from.x, "a point that stays has other bits");
            expect(std::abs(x[k] - (from.x + dx[k])) <= 4e-16 * (std::abs(from.x) + std::abs(dx[k])),
                   "a morph is not x + dx");
        }
        pairs_move_alike(dx, dy, 0);
        step(by, moved(dx, dy));
        quality(to, moved(x, y));
    }

    // A component of the displacement of a point: real values f, complex ones a + i b, or matrices, times the movement.
    void is_sum(double found, std::size_t point, std::size_t component) const {
        Wide sum = 0, size = 0;
        for (std::size_t i = 0; i < value_.size(); ++i) {
            auto const f = [&](std::size_t number) { return Wide(value_[i][number][point]); };
            Wide of_x = component == 0 ? f(0) : 0, of_y = component == 1 ? f(0) : 0;
            if (info_.numbers_per_value == 2) (component == 0 ? of_y : of_x) = component == 0 ? -f(1) : f(1);
            if (info_.numbers_per_value == 4) of_x = f(2 * component), of_y = f(2 * component + 1);
            sum += of_x * move_[2 * i] + of_y * move_[2 * i + 1];
            size += std::abs(of_x * move_[2 * i]) + std::abs(of_y * move_[2 * i + 1]);
        }
        expect(std::abs(found - double(sum)) <= 1e-14 * double(value_.size()) * double(size),
               "a displacement is not the sum");
    }

    // The header: points of a periodic pair by the same bits, those of a rotation pair turned.
    void pairs_move_alike(Numbers const& dx, Numbers const& dy, double rounding) const {
        for (hm_condition const& condition : problem_.conditions) {
            bool const is_turned = condition.kind == HM_ROTATION_PAIR;
            if (!is_turned && condition.kind != HM_PERIODIC_PAIR) continue;
            double largest = 0;
            for (std::size_t k = 0; k < n_; ++k) largest = std::max({largest, std::abs(dx[k]), std::abs(dy[k])});
            // How well the angle is known from the coordinates.
            double const turning = is_turned ? 1e-13 * largest * problem_.size() / extent() : 0;
            for (Domain::Image const& image : problem_.domain.images) {
                std::size_t const from = std::size_t(image.of), to = std::size_t(image.at);
                Point const by{dx[from], dy[from]}, expected = is_turned ? turned(by, problem_.domain.turn) : by;
                expect(std::abs(dx[to] - expected.x) <= turning + rounding, "the points of a pair move differently");
                expect(std::abs(dy[to] - expected.y) <= turning + rounding, "the points of a pair move differently");
            }
        }
    }

    void step(hm_points const& by, std::vector<Point> const& displacement) {
        hm_step_report report{};
        report.struct_size = sizeof report;
        expect(hm_admissible_step(its_.basis, &problem_.mesh, nullptr, &by, nullptr, &report, &error_) == HM_OK,
               "no step");
        double const s = report.admissible;
        expect(s > 0, "no step is admissible from a valid mesh");
        for (double const part : {0.25, 0.5, 0.75, 0.999999}) {
            double const t = std::isfinite(s) ? part * s : 4 * part;
            double const sine = smallest_sine(judged_, problem_.domain.points, displacement, t);
            expect(sine > -1e-12,
                   "a cell is inverted before the admissible step: sine " + std::to_string(sine * 1e12) + "e-12");
        }
        if (!std::isfinite(s) || judged_.ambiguous > 0) return;
        double const sine = smallest_sine(judged_, problem_.domain.points, displacement, s);
        expect(sine < 1e-9, "no cell has lost its area at the admissible step " + std::to_string(s) + " of cell " +
                                std::to_string(report.cell) + ": sine " + std::to_string(sine));
    }

    void quality(hm_points const& to, std::vector<Point> const& at) {
        hm_quality_report report{};
        report.struct_size = sizeof report;
        expect(hm_quality(its_.basis, &problem_.mesh, &to, nullptr, nullptr, &report, &error_) == HM_OK, "no quality");
        // Four differences, two products and their difference are rounded to 2^-53 each: 4.5e-16 of the sides' lengths.
        double const rounding = 5e-16;
        std::int32_t const least = inverted_cells(judged_, at, -rounding),
                           most = inverted_cells(judged_, at, rounding) + judged_.ambiguous;
        expect(report.inverted >= least && report.inverted <= most,
               std::to_string(report.inverted) + " inverted cells instead of " + std::to_string(least));
        expect(std::isfinite(report.mean_quality) && report.min_quality >= 0 && report.mean_quality <= 1,
               "quality out of range");
        Crossings const expected = find_crossings(problem_.domain, at);
        if (expected.crosses) expect(report.self_crossing == 1, "a crossing is not found");
        if (report.self_crossing == 0) expect(report.crossing_points[0] == -1, "points of a crossing that is none");
    }

    // <g, sum F dP> = <F^T g, dP>.
    void adjoint() {
        Numbers gx(n_), gy(n_), dx(n_), dy(n_), gradient(move_.size());
        for (std::size_t k = 0; k < n_; ++k) gx[k] = input_.between(-1, 1), gy[k] = input_.between(-1, 1);
        hm_points const g{gx.data(), gy.data(), 1};
        hm_points_out const out{dx.data(), dy.data(), 1};
        expect(hm_adjoint(its_.basis, &g, gradient.data(), nullptr, &error_) == HM_OK, "no gradient");
        expect(hm_morph(its_.basis, move_.data(), nullptr, &out, nullptr, &error_) == HM_OK, "no displacement");
        Wide left = 0, right = 0, size = 0;
        for (std::size_t k = 0; k < n_; ++k) {
            left += Wide(gx[k]) * dx[k] + Wide(gy[k]) * dy[k];
            size += std::abs(Wide(gx[k]) * dx[k]) + std::abs(Wide(gy[k]) * dy[k]);
        }
        for (std::size_t i = 0; i < move_.size(); ++i) {
            right += Wide(gradient[i]) * move_[i];
            size += std::abs(Wide(gradient[i]) * move_[i]);
        }
        Wide moves = 0;   // the header: sums are in units of 2^-63 of the product of the largest numbers
        for (double const number : move_) moves += std::abs(number);
        Wide const unit = 2 * largest_ * Wide(n_) * 0x1p-63L;
        expect(std::abs(left - right) <= 1e-13L * size + unit * moves, "the adjoint is not the transpose");
    }

    // In single precision, for some points, and for some points of that.
    void derived_bases() {
        hm_basis *single = nullptr, *rows = nullptr, *combined = nullptr;
        hm_status const made = make_object(
            in_its_blocks(), error_, [&](std::size_t* bytes) { return hm_single_size(its_.basis, bytes, &error_); },
            [&](void* memory, std::size_t bytes) {
                return hm_single_init(&single, memory, bytes, its_.basis, &error_);
            });
        std::vector<std::int32_t> points(input_.below(20) + 1);
        for (std::int32_t& k : points) k = input_.from(0, problem_.mesh.n_points - 1) + problem_.mesh.index_base;
        std::int32_t const n = static_cast<std::int32_t>(points.size());
        hm_basis const* const whole = made >= 0 && input_.one_in(2) ? single : its_.basis;
        std::size_t bytes = 0;   // for any n points: these may need less
        expect(hm_extract_size(whole, n, &bytes, &error_) == HM_OK, "no size of an extract");
        expect(hm_extract_init(&rows, its_.block(bytes).data(), bytes, whole, n, points.data(), &error_) == HM_OK,
               "no extract");
        Numbers matrix(static_cast<std::size_t>(2 * info_.functions));
        for (double& number : matrix) number = input_.between(-1, 1);
        make_object(
            in_its_blocks(), error_, [&](std::size_t* size) { return hm_combine_size(its_.basis, 2, 1, size, &error_); },
            [&](void* memory, std::size_t size) {
                return hm_combine(&combined, memory, size, its_.basis, 2, 1, matrix.data(), &error_);
            });
        Numbers x(n_), y(n_), few_x(points.size()), few_y(points.size());
        hm_points_out const all{x.data(), y.data(), 1}, few{few_x.data(), few_y.data(), 1};
        expect(hm_morph(whole, move_.data(), nullptr, &all, nullptr, &error_) == HM_OK, "no displacement");
        expect(hm_morph(rows, move_.data(), nullptr, &few, nullptr, &error_) == HM_OK, "no displacement of an extract");
        for (std::size_t k = 0; k < points.size(); ++k)
            expect(few_x[k] == x[static_cast<std::size_t>(points[k] - problem_.mesh.index_base)],
                   "an extract moves otherwise");
    }

    // Better cells where hm_morph has led, if that is a mesh.
    void improvement() {
        Numbers from_x(n_), from_y(n_), x(n_, 7), y(n_, 7);
        hm_points_out const moved_to{from_x.data(), from_y.data(), 1}, out{x.data(), y.data(), 1};
        hm_points const from{from_x.data(), from_y.data(), 1};
        Numbers small = move_;
        for (double& number : small) number *= 0.05;
        expect(hm_morph(its_.basis, small.data(), &problem_.mesh.points, &moved_to, nullptr, &error_) == HM_OK, "no morph");
        slide(from_x, from_y);
        hm_improve_options options{};
        options.struct_size = sizeof options;
        options.max_iterations = input_.from(0, 20);
        hm_improve_report report{};
        report.struct_size = sizeof report;
        hm_status const status = make_object(
            in_its_blocks(), error_, [&](std::size_t* bytes) { return hm_improve_size(its_.plan, bytes, &error_); },
            [&](void* memory, std::size_t bytes) {
                return hm_improve(its_.plan, &from, &out, memory, bytes, &options, &report, &error_);
            });
        if (status < 0) {
            for (std::size_t k = 0; k < n_; ++k) expect(x[k] == 7 && y[k] == 7, "a refused call has written");
            return;
        }
        expect(inverted_cells(judged_, moved(x, y), rounding_of_turns()) == 0, "an improved mesh has inverted cells");
        expect(report.min_quality > 0, "the report of an improvement has inverted cells");
        expect(report.min_quality >= report.min_quality_before, "an improvement lowers the smallest quality");
    }

    // Onto the curves of the sides that slide, in place: points of other sides stay.
    void slide(Numbers& x, Numbers& y) {
        Numbers const before_x = x, before_y = y;
        hm_points const from{x.data(), y.data(), 1};
        hm_points_out const to{x.data(), y.data(), 1};
        hm_status const status = hm_slide(its_.analysis, &from, &to, &error_);
        expect_told(status, error_);
        std::vector<std::int32_t> slides(n_, 1);
        for (Face const& face : problem_.domain.faces)
            if (!marker_slides(face.marker)) slides[std::size_t(face.from)] = slides[std::size_t(face.to)] = 0;
        for (std::size_t k = 0; k < n_; ++k) {
            bool const is_same = x[k] == before_x[k] && y[k] == before_y[k];
            if (status < 0) expect(is_same, "a refused call of hm_slide has written");
            if (slides[k] == 0) expect(is_same, "hm_slide moves a point of another boundary");
            expect(std::isfinite(x[k]) && std::isfinite(y[k]), "hm_slide leads to what is not finite");
        }
    }
    bool marker_slides(std::int32_t marker) const {
        for (hm_condition const& its : problem_.conditions)
            if (its.marker == marker) return its.kind == HM_SLIP;
        return false;
    }

    void safe_morph() {
        std::size_t bytes = 0;
        hm_status status = hm_morph_safe_size(its_.plan, its_.basis, &bytes, &error_);
        expect_told(status, error_);
        if (status < 0) return;
        Numbers x(n_, 7), y(n_, 7), reached(move_.size(), 7);
        hm_points_out const out{x.data(), y.data(), 1};
        hm_safe_options options{};
        options.struct_size = sizeof options;
        options.max_resolves = input_.from(-1, 3);
        options.skipped_strategies = static_cast<std::int32_t>(input_.one_in(3) ? input_.below(32) : 0);
        options.heights = input_.any_of({0.0, 0.0, 0.5, 1.0});
        options.reached = reached.data();
        hm_safe_report report{};
        report.struct_size = sizeof report;
        Block& work = its_.block(bytes);
        status = hm_morph_safe(its_.plan, its_.basis, move_.data(), &out, nullptr, work.data(), bytes - 1, &options,
                               &report, &error_);
        expect(status < 0, "work space that is one byte too small is taken");
        Exceptions::clear();
        status = hm_morph_safe(its_.plan, its_.basis, move_.data(), &out, nullptr, work.data(), bytes, &options,
                               &report, &error_);
        expect_told(status, error_);
        if (status >= 0) Exceptions::expect_none("hm_morph_safe");
        if (status < 0) {
            for (std::size_t k = 0; k < n_; ++k) expect(x[k] == 7 && y[k] == 7, "a refused call has written");
            for (double const its : reached)
                expect(its == 7, "a refused call has written the movement that it reached");
            return;
        }
        std::vector<Point> const at = moved(x, y);
        for (Point const& p : at)
            expect(std::isfinite(p.x) && std::isfinite(p.y), "a safe morph leads to what is not finite");
        std::int32_t const inverted = inverted_cells(judged_, at, rounding_of_turns());
        expect(inverted == 0, std::to_string(inverted) + " inverted cells after a safe morph");
        expect(report.inverted == 0, "the report of a safe morph counts inverted cells");
        if (!find_crossings(problem_.domain, problem_.domain.points).crosses)
            expect(!find_crossings(problem_.domain, at).crosses, "a crossing after a safe morph");
        if (status == HM_OK || status == HM_POOR) {
            expect(report.step_fraction == 1, "a part of the movement, and no warning");
            expect(reached == move_, "HM_OK, and another movement is reached");
        }
        Numbers dx(n_), dy(n_);
        for (std::size_t k = 0; k < n_; ++k) {
            dx[k] = x[k] - problem_.domain.points[k].x;
            dy[k] = y[k] - problem_.domain.points[k].y;
        }
        pairs_move_alike(dx, dy, 1e-14 * problem_.size());
        if (is_real()) expect(report.turned_offset == 0, "real functions turn no offset");
        wall_is_at(at, reached, report.turned_offset);
    }

    // Points of curves have moved as the B-spline of the movement that was reached, but for offsets that turned along.
    void wall_is_at(std::vector<Point> const& at, Numbers const& reached, double turned_offset) {
        double const size = problem_.size();
        double largest = size;
        for (double const number : reached) largest = std::max(largest, std::abs(number));
        for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
            std::int32_t const curve = info_.point_curve[slot];
            if (curve >= info_.curves || info_.offset_correction != 0) continue;
            Numbers const basis = basis_functions(problem_.on_walls.view, curve, info_.point_u[slot]);
            std::size_t const k = std::size_t(info_.curve_point[slot]);
            Wide dx = 0, dy = 0;
            for (std::size_t i = 0; i < basis.size(); ++i)
                dx += Wide(basis[i]) * reached[2 * i], dy += Wide(basis[i]) * reached[2 * i + 1];
            Point const from = problem_.domain.points[k];
            expect(std::abs(at[k].x - double(from.x + dx)) <= turned_offset + 1e-12 * largest,
                   "a wall point is not where the B-spline is");
            expect(std::abs(at[k].y - double(from.y + dy)) <= turned_offset + 1e-12 * largest,
                   "a wall point is not where the B-spline is");
        }
    }

    Solution& its_;
    Problem const& problem_;
    Input& input_;
    Judged judged_;
    hm_basis_info info_{};
    hm_error error_{};
    std::size_t n_ = 0;
    Numbers move_;
    double largest_ = 0;   // of the functions' values
    std::vector<std::vector<Numbers>> value_;   // of each function, its numbers at each point
};

// What a solution gives, to compare bits: its functions, and where it takes the mesh by a movement that needs more than
// one linear step, as often as not.
std::vector<double> results_of(Solution& its) {
    hm_basis_info info{};
    info.struct_size = sizeof info;
    expect(hm_basis_info_get(its.basis, &info, nullptr) == HM_OK, "no information about a solved basis");
    std::size_t const n = its.problem.domain.points.size();
    std::vector<double> all{double(its.status), its.report.residual}, values(n), x(n), y(n);
    for (std::int32_t i = 0; i < info.functions; ++i)
        for (std::int32_t number = 0; number < info.numbers_per_value; ++number) {
            hm_basis_values(its.basis, i, number, values.data(), nullptr);
            all.insert(all.end(), values.begin(), values.end());
        }
    std::size_t bytes = 0;
    if (hm_morph_safe_size(its.plan, its.basis, &bytes, nullptr) < 0) return all;
    std::vector<double> move(2 * static_cast<std::size_t>(info.functions));
    for (std::size_t k = 0; k < move.size(); ++k) move[k] = 0.05 * its.problem.size() * (k % 3 == 0 ? 1 : -0.5);
    for (std::size_t k = 2 * static_cast<std::size_t>(its.problem.on_walls.view.n_control) + 2; k < move.size(); k += 4)
        move[k] = -0.5, move[k + 1] = 0.7;
    hm_points_out const out{x.data(), y.data(), 1};
    all.push_back(hm_morph_safe(its.plan, its.basis, move.data(), &out, nullptr, its.block(bytes).data(), bytes, nullptr,
                                nullptr, nullptr));
    all.insert(all.end(), x.begin(), x.end());
    all.insert(all.end(), y.begin(), y.end());
    return all;
}

// The same in blocks that held other bytes and begin elsewhere.
void expect_same_bits(Solution& one, Input& input) {
    Solution other(one.problem, input);
    expect(other.status == one.status, "other bytes in the blocks, another status");
    std::vector<double> const a = results_of(one), b = results_of(other);
    expect(a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0,
           "other bytes in the blocks, other bits");
}

Outcome run_with(Cells cells, Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input, cells);
    bool const is_broken = !input.one_in(2);
    if (is_broken) break_something(*problem, input);
    Exceptions::clear();
    Solution solution(*problem, input);
    if (!is_broken && solution.status >= 0) Exceptions::expect_none("a solution");
    if (is_broken) Exceptions::expect_none(solution.status >= 0 ? "a broken problem that is solved" : solution.error.text);
    if (!is_broken && solution.analysis != nullptr)
        expect(inverted_cells(judge_by_header(problem->domain), problem->domain.points) == 0, "a mesh with inverted cells is taken");
    if (solution.status < 0) return Outcome::refused;
    if (is_broken) return Outcome::done;
    try {
        if (input.one_in(4)) expect_same_bits(solution, input);
        else Check(solution, input).all();
    } catch (Failure const& failure) {
        throw Failure(failure.what() + std::string("\n") + describe(*problem) +
                      "    solved: " + hm_status_name(solution.status));
    }
    return Outcome::done;
}

}   // namespace

Outcome run_problem(Input& input) { return run_with(Cells::triangles_and_quads, input); }

Outcome run_polygons(Input& input) { return run_with(Cells::polygons, input); }

}   // namespace fuzz
