// Improvements and safe morphs of a solution: valid meshes, and walls where the B-splines are.
#include <harmorph_design.h>

#include "solution_check.hpp"

#include <cmath>

namespace fuzz {

// Better cells where hm_morph has led, if that is a mesh.
void SolutionCheck::improvement() {
    Numbers from_x(n_), from_y(n_), x(n_, 7), y(n_, 7);
    hm_points_out const moved_to{from_x.data(), from_y.data(), 1}, out{x.data(), y.data(), 1};
    hm_points const from{from_x.data(), from_y.data(), 1};
    Numbers small = move_;
    for (double& number : small) number *= 0.05;
    expect(hm_morph(its_.basis, small.data(), &problem_.mesh.points, &moved_to, nullptr, &error_) ==
               HM_OK,
           "no morph");
    slide(from_x, from_y);
    hm_improve_options options{};
    options.struct_size = sizeof options;
    options.max_iterations = input_.from(0, 20);
    hm_improve_report report{};
    report.struct_size = sizeof report;
    hm_status const status = make_object(
        in_its_blocks(), error_,
        [&](std::size_t* bytes) { return hm_improve_size(its_.plan, bytes, &error_); },
        [&](void* memory, std::size_t bytes) {
            return hm_improve(its_.plan, &from, &out, memory, bytes, &options, &report, &error_);
        });
    if (status < 0) {
        for (std::size_t k = 0; k < n_; ++k)
            expect(x[k] == 7 && y[k] == 7, "a refused call has written");
        return;
    }
    expect(inverted_cells(judged_, moved(x, y), rounding_of_turns()) == 0,
           "an improved mesh has inverted cells");
    expect(report.min_quality > 0, "the report of an improvement has inverted cells");
    expect(report.min_quality >= report.min_quality_before,
           "an improvement lowers the smallest quality");
}

// Onto the curves of the sides that slide, in place: points of other sides stay.
void SolutionCheck::slide(Numbers& x, Numbers& y) {
    Numbers const before_x = x, before_y = y;
    hm_points const from{x.data(), y.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    hm_status const status = hm_slip(its_.analysis, &from, &to, &error_);
    expect_told(status, error_);
    std::vector<std::int32_t> slides(n_, 1);
    for (Face const& face : problem_.domain.faces)
        if (!marker_slides(face.marker))
            slides[std::size_t(face.from)] = slides[std::size_t(face.to)] = 0;
    for (std::size_t k = 0; k < n_; ++k) {
        bool const is_same = x[k] == before_x[k] && y[k] == before_y[k];
        if (status < 0) expect(is_same, "a refused call of hm_slip has written");
        if (slides[k] == 0) expect(is_same, "hm_slip moves a point of another boundary");
        expect(std::isfinite(x[k]) && std::isfinite(y[k]), "hm_slip leads to what is not finite");
    }
}

bool SolutionCheck::marker_slides(std::int32_t marker) const {
    for (hm_condition const& condition : problem_.conditions)
        if (condition.marker == marker) return condition.kind == HM_SLIP;
    return false;
}

void SolutionCheck::safe_morph() {
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
    hm_basis* const derivative = input_.one_in(3) ? another_basis() : nullptr;
    status = hm_morph_safe(its_.plan, its_.basis, move_.data(), &out, derivative, work.data(),
                           bytes - 1, &options, &report, &error_);
    expect(status < 0, "work space that is one byte too small is taken");
    Exceptions::clear();
    status = hm_morph_safe(its_.plan, its_.basis, move_.data(), &out, derivative, work.data(),
                           bytes, &options, &report, &error_);
    expect_told(status, error_);
    if (status >= 0) Exceptions::expect_none("hm_morph_safe");
    if (status < 0) {
        for (std::size_t k = 0; k < n_; ++k)
            expect(x[k] == 7 && y[k] == 7, "a refused call has written");
        for (double const number : reached)
            expect(number == 7, "a refused call has written the movement that it reached");
        return;
    }
    std::vector<Point> const at = moved(x, y);
    for (Point const& p : at)
        expect(std::isfinite(p.x) && std::isfinite(p.y),
               "a safe morph leads to what is not finite");
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
    if (derivative != nullptr) walls_follow(derivative, report.step_fraction);
}

// A basis of the same analysis, not solved.
hm_basis* SolutionCheck::another_basis() {
    hm_basis* made = nullptr;
    hm_status const status = make_object(
        in_its_blocks(), error_,
        [&](std::size_t* bytes) { return hm_basis_size(its_.analysis, bytes, &error_); },
        [&](void* memory, std::size_t bytes) {
            return hm_basis_init(&made, memory, bytes, its_.analysis, &error_);
        });
    expect(status >= 0, std::string("no basis for a derivative: ") + error_.text);
    return made;
}

// The derivative by the movement is exact at points of curves: in however many steps the mesh has
// moved, it is that of the B-spline, times the part of the movement that was reached.
void SolutionCheck::walls_follow(hm_basis* derivative, double fraction) {
    if (info_.offset_correction != 0) return;
    Numbers by(move_.size()), dx(n_), dy(n_);
    double largest = 0;
    for (double& number : by) {
        number = input_.between(-1, 1);
        largest = std::max(largest, std::abs(number));
    }
    hm_points_out const to{dx.data(), dy.data(), 1};
    expect(hm_morph(derivative, by.data(), nullptr, &to, nullptr, &error_) == HM_OK,
           std::string("a derivative is no basis: ") + error_.text);
    for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
        std::int32_t const curve = info_.point_curve[slot];
        if (curve >= info_.curves) continue;
        Numbers const basis = basis_functions(problem_.on_walls.view, curve, info_.point_u[slot]);
        std::size_t const k = std::size_t(info_.curve_point[slot]);
        Wide x = 0, y = 0;
        for (std::size_t i = 0; i < basis.size(); ++i)
            x += Wide(basis[i]) * by[2 * i], y += Wide(basis[i]) * by[2 * i + 1];
        double const error = std::hypot(double(fraction * x) - dx[k], double(fraction * y) - dy[k]);
        expect(error <= 1e-9 * largest,
               "the derivative at a point of a curve differs from the B-spline's by " +
                   shown(error / largest) + " at the part " + shown(fraction));
    }
}

// Points of curves have moved as the B-spline of the movement that was reached, but for offsets
// that turned along.
void SolutionCheck::wall_is_at(std::vector<Point> const& at, Numbers const& reached,
                               double turned_offset) {
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

}  // namespace fuzz
