// The calls of harmorph_quality.h with random problems: smooth bounds of the quality against their
// definition in the header, in more digits, and their derivatives against differences.
#include <harmorph_quality.h>
#include "corner_area.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;

class Quality {
public:
    Quality(Solution& solved, Judged const& judged, Input& input)
        : solved_(solved), problem_(solved.problem), judged_(judged), input_(input) {
        start_ = problem_.domain.points;
        by_.resize(start_.size());
        Numbers move(2 * at(problem_.functions()));
        double const size = problem_.size() * input_.any_of({0.01, 1.0, 10.0});
        for (double& number : move) number = size * input_.between(-1, 1);
        hm_points_out const out{&by_[0].x, &by_[0].y, 2};
        done(hm_morph(solved_.basis, move.data(), nullptr, &out, nullptr, &error_), "a morph");
        hm_step_report report = sized<hm_step_report>();
        hm_points const by = in(by_);
        done(hm_assess(solved_.basis, &problem_.mesh, nullptr, &by, nullptr, nullptr, &report,
                       nullptr, &error_),
             "a step");
        step_ = report.admissible;
    }

    void run() {
        if (input_.one_in(2)) bounds();
        if (step_ > 0) check_step_corners(solved_, judged_, by_, step_, input_);
        solved_.blocks.expect_intact();
    }

private:
    void done(hm_status status, const char* what) const { expect_done(status, error_, what); }
    std::vector<Point> moved(double step) const {
        std::vector<Point> out = start_;
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] = {out[k].x + step * by_[k].x, out[k].y + step * by_[k].y};
        return out;
    }

    // Twice the area of a cell.
    static Wide area_of_cell(Cell const& cell, std::vector<Point> const& place) {
        Wide sum = 0;
        Point const o = place[at(cell[0])];
        for (std::size_t k = 1; k + 1 < cell.size(); ++k) {
            Point const p = place[at(cell[k])], q = place[at(cell[k + 1])];
            sum += (Wide(p.x) - o.x) * (Wide(q.y) - o.y) - (Wide(p.y) - o.y) * (Wide(q.x) - o.x);
        }
        return sum;
    }
    // The shape of a cell without inverted corners: f of the header.
    Wide shape(std::size_t number, std::vector<JudgedCorner> const& corners,
               std::vector<Point> const& place) const {
        Cell const& cell = problem_.domain.cells[number];
        Wide inverse = 0, squares = 0, m = 0;
        for (JudgedCorner const& corner : corners) {
            Point const p = place[at(corner.before)], q = place[at(corner.here)],
                        r = place[at(corner.after)];
            Wide const ax = Wide(q.x) - p.x, ay = Wide(q.y) - p.y, bx = Wide(r.x) - q.x,
                       by = Wide(r.y) - q.y;
            squares += ax * ax + ay * ay;
            if (corner.sine != 0) continue;  // flat or reflex
            inverse += std::hypot(ax, ay) * std::hypot(bx, by) / (ax * by - ay * bx);
            m += 1;
        }
        if (cell.size() == 3) return 2 * std::sqrt(Wide(3)) * area_of_cell(cell, place) / squares;
        if (m < 3) return 1;
        Wide const pi = std::acos(Wide(-1));
        return (judged_.is_divided[number] ? m / std::sin(2 * pi / m) : 4) / inverse;
    }

    struct Values {
        std::vector<Wide> value;
        Wide rounding = 0;
    };
    // The values of HM_BOUND_QUALITY, _KEPT_QUALITY or _AREA.
    Values values(std::int32_t kind, std::vector<Point> const& place) const {
        Values out;
        std::vector<Point> const rest(start_.size(), {0, 0});
        std::size_t next = 0;
        for (std::size_t c = 0; c < problem_.domain.cells.size(); ++c) {
            Cell const& cell = problem_.domain.cells[c];
            std::vector<JudgedCorner> own, around;
            for (; next < judged_.corners.size() && judged_.corners[next].cell == c; ++next)
                own.push_back(judged_.corners[next]);
            around.assign(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(cell.size()));
            for (JudgedCorner const& corner : own) {
                Area const before = area_of(corner, start_, rest, 0),
                           after = area_of(corner, place, rest, 0);
                Wide const lost = after.rounding / std::abs(after.value) +
                                  before.rounding / std::abs(before.value);
                Wide const ratio = after.value / before.value;
                out.rounding = std::max(out.rounding, lost * std::max(Wide(1), ratio));
                if (kind == HM_BOUND_AREA && (cell.size() > 3 || &corner == &own[0]))
                    out.value.push_back(ratio);
            }
            if (kind == HM_BOUND_AREA) continue;
            Wide const t = area_of_cell(cell, place) / area_of_cell(cell, start_),
                       s = std::sqrt(2 * t / (1 + t * t)), f = shape(c, around, place);
            out.value.push_back(s * f / (kind == HM_BOUND_QUALITY ? 1 : shape(c, around, start_)));
        }
        return out;
    }

    void bounds() {
        hm_quality* quality = nullptr;
        hm_points const start = in(start_);
        bool const is_given = input_.one_in(2);
        done(solved_.blocks.make(error_,
                                 size_by(fixtures::quality_size, solved_.basis, &problem_.mesh),
                                 init_by(hm_quality_init, &quality, solved_.basis, &problem_.mesh,
                                         is_given ? &start : nullptr)),
             "a quality");
        double const most = std::min(1.0, step_);
        double const step = most * input_.any_of({0.0, 0.1, 0.5, 0.9});
        std::vector<Point> const place = moved(step);
        hm_bound bound = sized<hm_bound>();
        bound.kind = input_.from(-1, 6);
        bound.sharpness = input_.any_of({0.0, 1.0, 30.0, 1000.0, 1e6});
        bool const is_wild = input_.one_in(12);
        if (is_wild) bound.sharpness = input_.any_of({double(NAN), -1.0, 0.5, 1e7, HUGE_VAL});
        hm_bound_value value = sized<hm_bound_value>();
        value.bound = 7;
        std::vector<Point> gradient(place.size(), {7, 7});
        hm_points_out const to{&gradient[0].x, &gradient[0].y, 2};
        hm_points const coordinates = in(place);
        hm_status const status = hm_quality_bounds(quality, &coordinates, 1, &bound, &value, &to,
                                                   problem_.options.executor, &error_);
        expect_told(status, error_);
        bool const is_legal = bound.kind >= 0 && bound.kind <= 5 && !is_wild;
        expect(status < 0 || is_legal, "a bound is computed that does not exist");
        bool const is_of_layer = bound.kind >= HM_BOUND_HEIGHT;
        if (status < 0) {
            expect(!is_legal || is_of_layer, std::string("a bound is refused: ") + error_.text);
            expect(value.bound == 7, "a refused call has written");
            for (Point const& p : gradient)
                expect(p.x == 7 && p.y == 7, "a refused call has written");
            return;
        }
        double const rho = bound.sharpness == 0 ? 200 : bound.sharpness,
                     sign = bound.kind == HM_BOUND_STRETCH ? -1 : 1;
        expect(value.count >= 1 && std::isfinite(value.bound), "a bound without values");
        expect(sign * (value.extreme - value.bound) >= -1e-12 * std::abs(value.bound),
               "a bound is on the wrong side");
        double const widest = std::log(double(value.count)) / rho;
        expect(sign * (value.extreme - value.bound) <= widest * (1 + 1e-9) + 1e-15,
               "a gap is too large");
        if (!is_of_layer && inverted_cells(judged_, place, 1e-12) == 0) {
            Values const expected = values(bound.kind, place);
            expect(at(static_cast<std::int32_t>(value.count)) == expected.value.size(),
                   "a bound of another number of values");
            Wide least = HUGE_VALL, sum = 0;
            for (Wide const each : expected.value) least = std::min(least, each);
            for (Wide const each : expected.value) sum += std::exp(-rho * (each - least));
            Wide const within = 1e-11L + 8 * expected.rounding;
            expect(std::abs(value.extreme - least) <= within * std::max(Wide(1), std::abs(least)),
                   "the smallest value " + shown(value.extreme) + " differs from the reference " +
                       shown(double(least)) + " by " + shown(double(value.extreme - least)));
            expect(std::abs(value.bound - (least - std::log(sum) / rho)) <=
                       within * std::max(Wide(1), std::abs(least)),
                   "a bound differs from the reference");
        }
        if (most > 0) slope(quality, bound, step, most, gradient);
    }

    // The derivative along the displacement, against central differences of two lengths, whose
    // difference says how accurate they are.
    void slope(hm_quality const* quality, hm_bound const& bound, double step, double most,
               std::vector<Point> const& gradient) {
        auto const bound_at = [&](double s) {
            std::vector<Point> const place = moved(s);
            hm_points const coordinates = in(place);
            hm_bound_value value = sized<hm_bound_value>();
            done(hm_quality_bounds(quality, &coordinates, 1, &bound, &value, nullptr, nullptr,
                                   &error_),
                 "a bound at a point nearby");
            return value.bound;
        };
        Wide sum = 0, size = 0;
        for (std::size_t k = 0; k < gradient.size(); ++k) {
            Wide const x = Wide(gradient[k].x) * by_[k].x, y = Wide(gradient[k].y) * by_[k].y;
            sum += x + y;
            size += std::abs(x) + std::abs(y);
        }
        // Another value becomes the extreme one within a change of the bound of 1 / rho.
        double const rho = std::max(1.0, bound.sharpness),
                     h = std::min(most * 1e-3 / std::sqrt(rho), 1e-2 / (rho * double(size)));
        auto const difference = [&](double length) {
            return (bound_at(step + length) - bound_at(step - length)) / (2 * length);
        };
        double const coarse = difference(h), middle = difference(h / 4), fine = difference(h / 16);
        double const known = std::abs(coarse - middle) + std::abs(middle - fine);
        // The bound is rounded to 2^-53 of the values, which are of the order of 1.
        double const rounded = 0x1p-50 * std::max(1.0, std::abs(bound_at(step))) / h;
        expect(std::abs(double(sum) - fine) <=
                   4 * known + rounded + 1e-5 * (std::abs(fine) + double(size)),
               "the derivative of a bound is " + shown(double(sum)) + ", differences are " +
                   shown(coarse) + ", " + shown(middle) + " and " + shown(fine));
    }

    Solution& solved_;
    Problem const& problem_;
    Judged const& judged_;
    Input& input_;
    std::vector<Point> start_, by_;
    double step_ = 0;
    hm_error error_{};
};

}  // namespace

Outcome run_quality(Input& input) {
    std::unique_ptr<Problem> const problem =
        make_problem(input, input.one_in(3) ? Cells::polygons : Cells::triangles_and_quads);
    Judged const judged = judge_by_header(problem->domain);
    if (judged.ambiguous > 0) return Outcome::refused;
    Solution solution(*problem, input);
    if (solution.status < 0 || problem->functions() < 1) return Outcome::refused;
    Quality(solution, judged, input).run();
    return Outcome::done;
}

}  // namespace fuzz
