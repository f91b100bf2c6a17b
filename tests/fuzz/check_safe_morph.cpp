// Improvements and safe morphs of a solution: valid meshes, and walls where the B-splines are.
#include <harmorph_design.h>

#include "solution_check.hpp"
#include <fixtures/memory.hpp>

#include <cmath>
#include <complex>

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
    hm_improve_options options = sized<hm_improve_options>();
    options.max_solutions = input_.from(0, 20);
    hm_improve_report report = sized<hm_improve_report>();
    hm_status const status = its_.blocks.make(error_, size_by(fixtures::improve_size, its_.plan),
                                              [&](void* memory, std::size_t bytes, hm_error* e) {
                                                  return hm_improve(its_.plan, &from, &out,
                                                                    fixtures::Memory(memory, bytes),
                                                                    &options, &report, e);
                                              });
    if (status < 0) return expect_untouched(x), expect_untouched(y);
    expect(inverted_cells(judged_, moved(x, y), -rounding_of_turns(problem_.domain)) == 0,
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
    hm_status status = fixtures::safe_move_size(its_.plan, its_.basis, &bytes, &error_);
    expect_told(status, error_);
    if (status < 0) return;
    Numbers x(n_, 7), y(n_, 7), reached(move_.size(), 7);
    hm_points_out const out{x.data(), y.data(), 1};
    hm_safe_options options = sized<hm_safe_options>();
    options.max_resolves = input_.from(-1, 3);
    options.skipped_strategies = static_cast<std::int32_t>(input_.one_in(3) ? input_.below(32) : 0);
    options.heights = input_.any_of({0.0, 0.0, 0.5, 1.0});
    options.reached = reached.data();
    hm_safe_report report = sized<hm_safe_report>();
    Block& work = its_.blocks.take(bytes);
    hm_basis* const derivative = input_.one_in(3) ? another_basis() : nullptr;
    status = fixtures::safe_move(its_.plan, its_.basis, move_.data(), &out, derivative, work.data(),
                                 bytes - 1, &options, &report, &error_);
    expect(status < 0, "work space that is one byte too small is taken");
    Exceptions::clear();
    status = fixtures::safe_move(its_.plan, its_.basis, move_.data(), &out, derivative, work.data(),
                                 bytes, &options, &report, &error_);
    expect_told(status, error_);
    if (status >= 0) Exceptions::expect_none("hm_move_safe");
    if (status < 0) return expect_untouched(x), expect_untouched(y), expect_untouched(reached);
    std::vector<Point> const at = moved(x, y);
    for (Point const& p : at)
        expect(std::isfinite(p.x) && std::isfinite(p.y),
               "a safe morph leads to what is not finite");
    std::int32_t const inverted = inverted_cells(judged_, at, -rounding_of_turns(problem_.domain));
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
    if (is_real()) expect(report.rotated_offset == 0, "real functions turn no offset");
    wall_is_at(at, reached, report.rotated_offset);
    if (derivative == nullptr) return;
    walls_follow(derivative, report.step_fraction);
    field_follows(derivative, options, report);
}

// A basis of the same analysis, not solved.
hm_basis* SolutionCheck::another_basis() {
    hm_basis* made = nullptr;
    expect_done(its_.blocks.make(error_, size_by(fixtures::basis_size, its_.analysis),
                                 init_by(hm_basis_init, &made, its_.analysis)),
                error_, "a basis for a derivative");
    return made;
}

// The derivative by the movement at points of curves: in however many steps the mesh has moved, it
// is that of the B-spline where the whole movement was reached. Of a part, the walls that turn
// along have a common complex factor, and those that go straight the part.
void SolutionCheck::walls_follow(hm_basis* derivative, double fraction) {
    if (info_.offset_correction != 0) return;
    using Complex = std::complex<Wide>;
    struct Pair {
        Complex spline, found;
    };
    Numbers const by = some_movement();
    Numbers dx(n_), dy(n_);
    displace_by(derivative, by, dx, dy);
    std::vector<std::vector<Pair>> on(std::size_t(info_.curves));
    for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
        std::int32_t const curve = info_.point_curve[slot];
        if (curve >= info_.curves) continue;
        Numbers const basis = basis_functions(problem_.on_walls.view, curve, info_.point_u[slot]);
        std::size_t const k = std::size_t(info_.curve_point[slot]);
        Complex spline = 0;
        for (std::size_t i = 0; i < basis.size(); ++i)
            spline += Wide(basis[i]) * Complex(by[2 * i], by[2 * i + 1]);
        on[std::size_t(curve)].push_back({spline, Complex(dx[k], dy[k])});
    }
    for (std::vector<Pair> const& pairs : on) {
        Complex factor = fraction;
        Wide largest = 0;
        for (Pair const& pair : pairs)
            if (fraction < 1 && !is_real() && std::abs(pair.spline) > largest)
                largest = std::abs(pair.spline), factor = pair.found / pair.spline;
        for (Pair const& pair : pairs) {
            double const error = double(std::abs(factor * pair.spline - pair.found));
            expect(error <= 1e-9,
                   "the derivative at a point of a curve differs from the B-spline's by " +
                       shown(error) + " at the part " + shown(fraction));
        }
    }
}

// Numbers between -1 and 1, one of which is 1.
SolutionCheck::Numbers SolutionCheck::some_movement() {
    Numbers by(move_.size());
    for (double& number : by) number = input_.between(-1, 1);
    by[input_.below(static_cast<std::uint32_t>(by.size()))] = 1;
    return by;
}

void SolutionCheck::displace_by(hm_basis* basis, Numbers const& by, Numbers& dx, Numbers& dy) {
    hm_points_out const to{dx.data(), dy.data(), 1};
    expect_done(hm_morph(basis, by.data(), nullptr, &to, nullptr, &error_), error_,
                "a movement by a derivative");
}

// The derivative against differences of safe morphs that go the same way. One linear step is exact
// at all points if no offset turns and nothing slips; elsewhere the header names terms that are
// left out: HARMORPH_DERIVATIVE in the environment shows how large they are.
void SolutionCheck::field_follows(hm_basis* derivative, hm_safe_options const& given,
                                  hm_safe_report const& first) {
    bool const slides =
        std::any_of(problem_.conditions.begin(), problem_.conditions.end(),
                    [](hm_condition const& condition) { return condition.kind == HM_SLIP; });
    bool const is_exact = first.strategy == HM_STRATEGY_LINEAR && first.steps == 1 &&
                          first.heights == 0 && first.step_fraction == 1 &&
                          first.rotated_offset == 0 && !slides;
    static bool const is_shown = std::getenv("HARMORPH_DERIVATIVE") != nullptr;
    if (its_.status != HM_OK || first.steps == 0 || (!is_exact && !is_shown)) return;
    Numbers const by = some_movement();
    double const h = 1e-6 * extent();
    Numbers dx(n_), dy(n_), place[2][2];
    displace_by(derivative, by, dx, dy);
    hm_safe_options options = given;
    options.reached = nullptr;
    std::size_t bytes = 0;
    expect(fixtures::safe_move_size(its_.plan, its_.basis, &bytes, &error_) == HM_OK, "no size");
    for (int way = 0; way < 2; ++way) {
        Numbers move = move_;
        for (std::size_t k = 0; k < move.size(); ++k) move[k] += (way == 0 ? -h : h) * by[k];
        for (Numbers& axis : place[way]) axis.assign(n_, 7);
        hm_points_out const to{place[way][0].data(), place[way][1].data(), 1};
        hm_safe_report report = sized<hm_safe_report>();
        hm_status const status = fixtures::safe_move(
            its_.plan, its_.basis, move.data(), &to, is_exact ? nullptr : derivative,
            its_.blocks.take(bytes).data(), bytes, &options, &report, &error_);
        bool const is_alike = report.strategy == first.strategy && report.steps == first.steps &&
                              report.resolves == first.resolves &&
                              report.step_fraction == first.step_fraction;
        if (status < 0 || !is_alike) return;  // another way
    }
    double largest = 0, worst = 0;
    for (std::size_t k = 0; k < n_; ++k) {
        double const x = (place[1][0][k] - place[0][0][k]) / (2 * h),
                     y = (place[1][1][k] - place[0][1][k]) / (2 * h);
        largest = std::max(largest, std::hypot(dx[k], dy[k]));
        worst = std::max(worst, std::hypot(x - dx[k], y - dy[k]));
    }
    if (!is_exact)
        std::printf("derivative: %d steps, strategy %d, heights %g, offset %g: error %.3g\n",
                    first.steps, first.strategy, first.heights,
                    first.rotated_offset / problem_.size(), worst / largest);
    double const rounding = 1e-15 * problem_.size() / h;
    expect(!is_exact || worst <= 1e-8 * largest + rounding,
           "the derivative of one linear step differs from differences by " + shown(worst));
}

// Points of rigid bodies have moved as hm_morph moves them by the movement that was reached, points
// of curves as the B-spline, but for offsets that turned along.
void SolutionCheck::wall_is_at(std::vector<Point> const& at, Numbers const& reached,
                               double rotated_offset) {
    double const size = problem_.size();
    double largest = size;
    for (double const number : reached) largest = std::max(largest, std::abs(number));
    Numbers body_x(n_, 7), body_y(n_, 7);
    displace_by(its_.basis, reached, body_x, body_y);
    for (std::int32_t slot = 0; slot < info_.curve_points; ++slot) {
        std::int32_t const curve = info_.point_curve[slot];
        if (curve >= info_.curves) {
            std::size_t const point = std::size_t(info_.curve_point[slot]);
            Point const from = problem_.domain.points[point];
            expect(std::hypot(at[point].x - from.x - body_x[point],
                              at[point].y - from.y - body_y[point]) <= 1e-12 * largest,
                   "a point of a rigid body is not where the movement leads");
            continue;
        }
        if (info_.offset_correction != 0) continue;
        Numbers const basis = basis_functions(problem_.on_walls.view, curve, info_.point_u[slot]);
        std::size_t const k = std::size_t(info_.curve_point[slot]);
        Wide dx = 0, dy = 0;
        for (std::size_t i = 0; i < basis.size(); ++i)
            dx += Wide(basis[i]) * reached[2 * i], dy += Wide(basis[i]) * reached[2 * i + 1];
        Point const from = problem_.domain.points[k];
        expect(std::abs(at[k].x - double(from.x + dx)) <= rotated_offset + 1e-12 * largest,
               "a wall point is not where the B-spline is");
        expect(std::abs(at[k].y - double(from.y + dy)) <= rotated_offset + 1e-12 * largest,
               "a wall point is not where the B-spline is");
    }
}

}  // namespace fuzz
