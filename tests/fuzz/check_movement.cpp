// Morphs of a solution: displacements, admissible steps and quality against the reference, and the
// adjoint.
#include "solution_check.hpp"

#include <algorithm>
#include <cmath>

namespace fuzz {

void SolutionCheck::displacement() {
    Numbers dx(n_, 7), dy(n_, 7), x(n_, 7), y(n_, 7);
    hm_points_out const out{dx.data(), dy.data(), 1}, at{x.data(), y.data(), 1};
    hm_points const by{dx.data(), dy.data(), 1}, to{x.data(), y.data(), 1};
    expect(hm_morph(its_.basis, move_.data(), nullptr, &out, nullptr, &error_) == HM_OK,
           "no displacement");
    expect(
        hm_morph(its_.basis, move_.data(), &problem_.mesh.points, &at, nullptr, &error_) == HM_OK,
        "no morph");
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

// A component of the displacement of a point: real values f, complex ones a + i b, or matrices,
// times the movement.
void SolutionCheck::is_sum(double found, std::size_t point, std::size_t component) const {
    Wide sum = 0, size = 0;
    for (std::size_t i = 0; i < value_.size(); ++i) {
        auto const f = [&](std::size_t number) { return Wide(value_[i][number][point]); };
        Wide of_x = component == 0 ? f(0) : 0, of_y = component == 1 ? f(0) : 0;
        if (info_.numbers_per_value == 2)
            (component == 0 ? of_y : of_x) = component == 0 ? -f(1) : f(1);
        if (info_.numbers_per_value == 4) of_x = f(2 * component), of_y = f(2 * component + 1);
        sum += of_x * move_[2 * i] + of_y * move_[2 * i + 1];
        size += std::abs(of_x * move_[2 * i]) + std::abs(of_y * move_[2 * i + 1]);
    }
    expect(std::abs(found - double(sum)) <= 1e-14 * double(value_.size()) * double(size),
           "a displacement is not the sum");
}

// The header: points of a periodic pair by the same bits, those of a rotation pair turned.
void SolutionCheck::pairs_move_alike(Numbers const& dx, Numbers const& dy, double rounding) const {
    for (hm_condition const& condition : problem_.conditions) {
        bool const is_turned = condition.kind == HM_ROTATION_PAIR;
        if (!is_turned && condition.kind != HM_PERIODIC_PAIR) continue;
        double largest = 0;
        for (std::size_t k = 0; k < n_; ++k)
            largest = std::max({largest, std::abs(dx[k]), std::abs(dy[k])});
        // This is the accuracy of the angle that the coordinates allow.
        double const turning = is_turned ? 1e-13 * largest * problem_.size() / extent() : 0;
        for (Domain::Image const& image : problem_.domain.images) {
            std::size_t const from = std::size_t(image.source), to = std::size_t(image.at);
            Point const by{dx[from], dy[from]},
                expected = is_turned ? turned(by, problem_.domain.turn) : by;
            expect(std::abs(dx[to] - expected.x) <= turning + rounding,
                   "the points of a pair move differently");
            expect(std::abs(dy[to] - expected.y) <= turning + rounding,
                   "the points of a pair move differently");
        }
    }
}

void SolutionCheck::step(hm_points const& by, std::vector<Point> const& displacement) {
    hm_step_report report = sized<hm_step_report>();
    expect(hm_assess(its_.basis, &problem_.mesh, nullptr, &by, nullptr, nullptr, &report, nullptr,
                     &error_) == HM_OK,
           "no step");
    double const s = report.admissible;
    expect(s > 0, "no step is admissible from a valid mesh");
    for (double const part : {0.25, 0.5, 0.75, 0.999999}) {
        double const t = std::isfinite(s) ? part * s : 4 * part;
        double const sine = smallest_sine(judged_, problem_.domain.points, displacement, t);
        expect(sine > -1e-12, "a cell is inverted before the admissible step: sine " +
                                  std::to_string(sine * 1e12) + "e-12");
    }
    expect(!(report.boundary >= s) || std::isinf(report.boundary),
           "the boundary touches itself after the admissible step, where nothing is looked for");
    bool const crosses_already = find_crossings(problem_.domain, problem_.domain.points).crosses;
    for (double const part : {0.3, 0.6, 0.9, 0.999}) {
        if (crosses_already) break;  // what crosses before does not count
        double const t = part * std::min({report.boundary, s, 4.0});
        std::vector<Point> at = problem_.domain.points;
        for (std::size_t k = 0; k < at.size(); ++k) {
            at[k].x += t * displacement[k].x;
            at[k].y += t * displacement[k].y;
        }
        // Faces as short as the rounding of the coordinates cross by rounding alone.
        auto const is_short = [&](Face const& face) {
            Point const &from = at[std::size_t(face.from)], &to = at[std::size_t(face.to)];
            return std::hypot(to.x - from.x, to.y - from.y) < 1e-12 * problem_.size();
        };
        std::vector<Face> const& faces = problem_.domain.faces;
        if (std::any_of(faces.begin(), faces.end(), is_short)) break;
        expect(!find_crossings(problem_.domain, at).crosses,
               "the boundary crosses itself before it touches itself");
    }
    if (!std::isfinite(s) || judged_.ambiguous > 0) return;
    double const sine = smallest_sine(judged_, problem_.domain.points, displacement, s);
    expect(sine < 1e-9, "no cell has lost its area at the admissible step " + std::to_string(s) +
                            " of cell " + std::to_string(report.cell) + ": sine " +
                            std::to_string(sine));
}

void SolutionCheck::quality(hm_points const& to, std::vector<Point> const& at) {
    hm_quality_report report = sized<hm_quality_report>();
    Numbers cells(problem_.domain.cells.size() + 1, 7);  // the last number is no cell's
    report.cell_quality = cells.data();
    expect(hm_assess(its_.basis, &problem_.mesh, &to, nullptr, nullptr, nullptr, nullptr, &report,
                     &error_) == HM_OK,
           "no quality");
    // Four differences, two products and their difference are rounded to 2^-53 each: 4.5e-16 of the
    // sides' lengths.
    double const rounding = std::max(5e-16, rounding_of_turns(problem_.domain));
    std::int32_t const least = inverted_cells(judged_, at, -rounding),
                       most = inverted_cells(judged_, at, rounding) + judged_.ambiguous;
    expect(report.inverted >= least && report.inverted <= most,
           std::to_string(report.inverted) + " inverted cells instead of " + std::to_string(least));
    expect(
        std::isfinite(report.mean_quality) && report.min_quality >= 0 && report.mean_quality <= 1,
        "quality out of range");
    expect(cells.back() == 7, "a quality is written behind the last cell");
    cells.pop_back();
    auto const smallest = std::min_element(cells.begin(), cells.end());
    expect(*smallest == report.min_quality &&
               smallest - cells.begin() + problem_.mesh.index_base == report.min_quality_cell,
           "the quality of the poorest cell is not the smallest of all");
    expect(*std::max_element(cells.begin(), cells.end()) <= 1 + 1e-15, "a quality is above 1");
    expect(std::count(cells.begin(), cells.end(), 0.0) >= report.inverted,
           "the quality of an inverted cell is not 0");
    Crossings const expected = find_crossings(problem_.domain, at);
    if (expected.crosses) expect(report.self_crossing == 1, "a crossing is not found");
    if (report.self_crossing == 0)
        expect(report.crossing_points[0] == -1, "points of a crossing that is none");
}

std::vector<Point> SolutionCheck::next_mesh() {
    Numbers dx(n_, 7), dy(n_, 7), x(n_), y(n_);
    displace_by(its_.basis, move_, dx, dy);
    hm_points const by{dx.data(), dy.data(), 1};
    hm_step_report report = sized<hm_step_report>();
    expect_done(hm_assess(its_.basis, &problem_.mesh, nullptr, &by, nullptr, nullptr, &report,
                          nullptr, &error_),
                error_, "a step");
    double const part = std::min(1.0, 0.5 * std::min(report.admissible, report.boundary));
    for (std::size_t k = 0; k < n_; ++k) {
        x[k] = problem_.domain.points[k].x + part * dx[k];
        y[k] = problem_.domain.points[k].y + part * dy[k];
    }
    slide(x, y);
    std::vector<Point> const at = moved(x, y);
    bool const is_mesh =
        inverted_cells(judged_, at, 1e-9) == 0 && !find_crossings(problem_.domain, at).crosses;
    return is_mesh ? at : std::vector<Point>();
}

void SolutionCheck::recovered_from(std::vector<Point> const& origin) {
    hm_points const at = problem_.mesh.points;
    std::size_t bytes = 0;
    expect_done(fixtures::recover_movement_size(its_.basis, &bytes, &error_), error_,
                "the size of a movement");
    Numbers found(move_.size(), 7), dx(n_, 7), dy(n_, 7);
    expect_done(
        hm_recover_movement(its_.basis, &at, 0, found.data(), nullptr,
                            fixtures::Memory(its_.blocks.take(bytes).data(), bytes), &error_),
        error_, "the movement of a mesh");
    displace_by(its_.basis, found, dx, dy);
    for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
        std::size_t const k = std::size_t(info_.curve_point[slot]);
        Point const to = problem_.domain.points[k];
        expect(std::hypot(origin[k].x + dx[k] - to.x, origin[k].y + dy[k] - to.y) <=
                   1e-9 * problem_.size(),
               "the movement that is found does not lead the wall to where it is");
    }
}

// <g, sum F dP> = <F^T g, dP>.
void SolutionCheck::adjoint() {
    Numbers gx(n_), gy(n_), dx(n_), dy(n_), gradient(move_.size());
    for (std::size_t k = 0; k < n_; ++k)
        gx[k] = input_.between(-1, 1), gy[k] = input_.between(-1, 1);
    hm_points const g{gx.data(), gy.data(), 1};
    hm_points_out const out{dx.data(), dy.data(), 1};
    expect(hm_adjoint(its_.basis, &g, gradient.data(), nullptr, &error_) == HM_OK, "no gradient");
    expect(hm_morph(its_.basis, move_.data(), nullptr, &out, nullptr, &error_) == HM_OK,
           "no displacement");
    Wide left = 0, right = 0, size = 0;
    for (std::size_t k = 0; k < n_; ++k) {
        left += Wide(gx[k]) * dx[k] + Wide(gy[k]) * dy[k];
        size += std::abs(Wide(gx[k]) * dx[k]) + std::abs(Wide(gy[k]) * dy[k]);
    }
    for (std::size_t i = 0; i < move_.size(); ++i) {
        right += Wide(gradient[i]) * move_[i];
        size += std::abs(Wide(gradient[i]) * move_[i]);
    }
    Wide moves = 0;  // the header: sums are in units of 2^-63 of the product of the largest numbers
    for (double const number : move_) moves += std::abs(number);
    Wide const unit = 2 * largest_ * Wide(n_) * 0x1p-63L;
    // Large functions of both signs cancel in displacements, which were rounded before.
    Wide const rounding = largest_ * Wide(n_) * 0x1p-52L;
    expect(std::abs(left - right) <= 1e-13L * size + (unit + rounding) * moves,
           "the adjoint is not the transpose");
}

}  // namespace fuzz
