// Calls with curves alone: points and projections, refined and elevated curves, measures and design
// variables. Each is refused with a reason, without an exception, and writes nothing, or succeeds
// with finite numbers; changed curves are the same curves.
#include <harmorph_design.h>
#include "exceptions.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

class Shape {
public:
    Shape(Problem const& problem, Input& input)
        : problem_(problem), set_(problem.on_walls.view), input_(input), blocks_(input) {
        number_ =
            input.one_in(16) ? input.wild_index() : input.from(0, std::max(0, set_.n_curves - 1));
        for (double const value : problem.on_walls.control)
            size_ = std::max(size_, std::abs(value));
    }

    Outcome run() {
        hm_status const status = hm_curves_check(&set_, &error_);
        expect_told(status, error_);
        is_valid_ = status >= 0;
        Outcome const outcome = call();
        blocks_.expect_intact();
        return outcome;
    }

private:
    using Numbers = std::vector<double>;

    double number() { return input_.one_in(12) ? input_.wild() : input_.between(-0.2, 1.2); }
    Outcome judged(hm_status status) const {
        expect_told(status, error_);
        if (status < 0) Exceptions::expect_none(error_.text);
        return status < 0 ? Outcome::refused : Outcome::done;
    }
    static void expect_finite(Numbers const& numbers, const char* what) {
        for (double const value : numbers)
            expect(std::isfinite(value), std::string(what) + ": not finite");
    }

    Outcome call() {
        switch (input_.below(5)) {
            case 0: return point();
            case 1: return finer(false);
            case 2: return finer(true);
            case 3: return measure();
            default: return variables();
        }
    }

    Outcome point() {
        Numbers xy(12, 7);
        double u = number(), distance = 7;
        if (is_valid_ && number_ >= 0 && number_ < set_.n_curves) {
            const double* const knots = set_.curve[number_].knots;
            u = knots[0] + u * (knots[set_.curve[number_].n_indices] - knots[0]);
        }
        Exceptions::clear();
        hm_status status = hm_curve_point(&set_, number_, u, input_.from(0, 2), xy.data(), &error_);
        if (status < 0) expect_untouched(xy);
        else expect_finite(xy, "a point of a curve");
        if (judged(status) == Outcome::refused) return Outcome::refused;
        double const x = size_ * number(), y = size_ * number();
        Exceptions::clear();
        status = hm_curve_project(&set_, number_, x, y, &u, &distance, &error_);
        if (judged(status) == Outcome::refused) return Outcome::refused;
        expect(hm_curve_point(&set_, number_, u, 0, xy.data(), &error_) == HM_OK,
               "no point at the foot");
        double const found = std::hypot(xy[0] - x, xy[1] - y);
        expect(std::abs(found - distance) <= 1e-9 * (found + size_),
               "the distance is not that to the foot");
        return Outcome::done;
    }

    // A curve with more knots, or of one degree more, has the same points.
    Outcome finer(bool elevated) {
        Numbers u(input_.below(4) + 1);
        if (is_valid_ && number_ >= 0 && number_ < set_.n_curves) {
            hm_curve const& curve = set_.curve[number_];
            double const begin = curve.knots[curve.degree], end = curve.knots[curve.n_indices];
            for (double& knot : u)
                knot = input_.one_in(12) ? input_.wild()
                                         : begin + input_.between(0, 1) * (end - begin);
        }
        std::int32_t const n = elevated ? 0 : static_cast<std::int32_t>(u.size());
        bool const is_curve = is_valid_ && number_ >= 0 && number_ < set_.n_curves;
        std::int32_t const degree = !elevated ? 0 : is_curve ? set_.curve[number_].degree + 1 : 4;
        Exceptions::clear();
        const hm_curves* made = nullptr;
        const double* matrix = nullptr;
        hm_status const status = blocks_.make(
            error_, size_by(fixtures::refine_size, &set_, number_, degree, n, u.data()),
            [&](void* memory, std::size_t bytes, hm_error* e) {
                return hm_refine(&made, &matrix, fixtures::Memory(memory, bytes), &set_, number_,
                                 degree, n, u.data(), e);
            });
        if (judged(status) == Outcome::refused) return Outcome::refused;
        expect(hm_curves_check(made, &error_) == HM_OK,
               std::string("a changed curve is refused: ") + error_.text);
        hm_curve const& curve = set_.curve[number_];
        for (int k = 0; k < 5; ++k) {
            double const at = curve.knots[curve.degree] +
                              0.25 * k * (curve.knots[curve.n_indices] - curve.knots[curve.degree]);
            double before[2], after[2];
            expect(hm_curve_point(&set_, number_, at, 0, before, &error_) == HM_OK,
                   "no point of a curve");
            expect(hm_curve_point(made, number_, at, 0, after, &error_) == HM_OK,
                   "no point of a changed curve");
            double const off = std::hypot(after[0] - before[0], after[1] - before[1]);
            expect(off <= 1e-9 * size_, "a changed curve is another one");
        }
        return Outcome::done;
    }

    hm_section section() {
        hm_section out = sized<hm_section>();
        if (input_.one_in(2)) out.n_curves = 1, out.first_curve = number_;
        if (input_.one_in(3))
            out.leading_x = size_ * number(), out.trailing_x = size_ * number(),
            out.trailing_y = size_ * number();
        return out;
    }

    Outcome measure() {
        Numbers const polygon{size_ * number(), size_ * number(), 0, 0,
                              size_ * number(), size_ * number()};
        hm_quantity quantity = sized<hm_quantity>();
        quantity.kind = input_.from(HM_AREA, HM_DISTANCE + (input_.one_in(16) ? 1 : 0));
        if (quantity.kind == HM_THICKNESS || quantity.kind == HM_CAMBER)
            quantity.station = number();
        if (quantity.kind == HM_MIN_THICKNESS) quantity.station = 0.3, quantity.last_station = 0.6;
        if (quantity.kind >= HM_CLEARANCE && quantity.kind != HM_TWIST && input_.one_in(2))
            quantity.sharpness = 1 + std::fabs(number());
        if (quantity.kind == HM_DISTANCE)
            quantity.other_curve = input_.from(0, 3), quantity.n_other = 1;
        if (quantity.kind == HM_CLEARANCE)
            quantity.polygon = polygon.data(), quantity.n_polygon = input_.from(1, 3);
        Numbers value(1, 7), at(2, 7), gradient(problem_.on_walls.control.size(), 7);
        hm_section const outline = section();
        Exceptions::clear();
        hm_status const status =
            hm_measure(&set_, input_.one_in(2) ? &outline : nullptr, 1, &quantity, value.data(),
                       at.data(), gradient.data(), &error_);
        if (status < 0) expect_untouched(value), expect_untouched(at), expect_untouched(gradient);
        else
            expect_finite(value, "a measure"), expect_finite(at, "where it is"),
                expect_finite(gradient, "its gradient");
        if (judged(status) == Outcome::refused) return Outcome::refused;
        if (quantity.kind == HM_TRAILING_EDGE_ANGLE) turned(quantity, value[0]);
        bool const is_extreme = quantity.kind == HM_MAX_THICKNESS || quantity.kind == HM_MAX_CAMBER;
        if (is_extreme && problem_.on_walls.curve[0].degree == 1)
            along_one_number(quantity, value[0], gradient);
        return Outcome::done;
    }

    // The curves with other control points, measured with their own chord.
    double measured(hm_quantity const& quantity, Numbers const& control) {
        hm_curves changed = set_;
        changed.control = control.data();
        double value = NAN;
        hm_measure(&changed, nullptr, 1, &quantity, &value, nullptr, nullptr, &error_);
        return value;
    }

    // The angle between two ends does not jump where the section is turned.
    void turned(hm_quantity const& quantity, double value) {
        Numbers control = problem_.on_walls.control;
        double const angle = input_.between(0, 6.3), c = std::cos(angle), s = std::sin(angle);
        for (std::size_t k = 0; k < control.size(); k += 2) {
            double const x = control[k], y = control[k + 1];
            control[k] = c * x - s * y;
            control[k + 1] = s * x + c * y;
        }
        double const found = measured(quantity, control),
                     whole = measured(quantity, problem_.on_walls.control);
        expect(value >= -90 && value <= 270, "an edge angle out of range");
        expect(!(std::abs(found - whole) > 90),
               "an edge angle depends on the direction of the section");
    }

    // The derivative lies between the two differences along one number: the extreme of a polygon is
    // at a corner.
    void along_one_number(hm_quantity const& quantity, double value, Numbers const& gradient) {
        Numbers control = problem_.on_walls.control;
        if (measured(quantity, control) != value) return;  // with another chord
        if (std::abs(value) < 1e-12 * size_) return;  // no camber: every station is the extreme one
        std::size_t const k = input_.below(static_cast<std::uint32_t>(control.size()));
        double const h = 1e-7 * size_, start = control[k];
        control[k] = start + h;
        double const above = (measured(quantity, control) - value) / h;
        control[k] = start - h;
        double const below = (value - measured(quantity, control)) / h;
        double largest = 0;
        for (double const number : gradient) largest = std::max(largest, std::abs(number));
        double const rounding = 1e-6 + 1e-3 * (largest + std::abs(above) + std::abs(below));
        bool const is_between = gradient[k] >= std::min(above, below) - rounding &&
                                gradient[k] <= std::max(above, below) + rounding;
        bool const is_known = std::isfinite(above) && std::isfinite(below);
        expect(is_between || !is_known,
               "an extreme has the derivative " + std::to_string(gradient[k]) +
                   ", which is not between the differences " + std::to_string(below) + " and " +
                   std::to_string(above));
    }

    Outcome variables() {
        hm_variables variables = sized<hm_variables>();
        variables.kind = input_.from(HM_FFD, HM_NACA4);
        Numbers peaks(16);
        for (double& peak : peaks) peak = number();
        if (variables.kind == HM_FFD)
            variables.degree_x = input_.from(0, 4), variables.degree_y = input_.from(0, 3);
        else
            variables.n_upper = input_.from(0, 6),
            variables.n_lower = variables.kind == HM_NACA4 ? 0 : input_.from(0, 6);
        if (variables.kind == HM_FFD && input_.one_in(3))
            variables.x_min = -size_, variables.x_max = size_ * number(), variables.y_max = size_;
        if (variables.kind == HM_CST && input_.one_in(2))
            variables.leading_exponent = number(), variables.trailing_exponent = number();
        if (variables.kind == HM_HICKS_HENNE && input_.one_in(2))
            variables.width = 3 * number(), variables.peaks = peaks.data();
        hm_section const outline = section();
        const hm_section* const given = input_.one_in(2) ? &outline : nullptr;
        std::int32_t n = 0;
        std::size_t size = 0;
        Exceptions::clear();
        hm_status status = fixtures::variables_size(&set_, given, &variables, &n, &size, &error_);
        if (judged(status) == Outcome::refused) return Outcome::refused;
        Numbers matrix(problem_.on_walls.control.size() * at(n), 7), error(2 * at(n), 7);
        status =
            blocks_.make(error_, size_by(fixtures::variables_size, &set_, given, &variables, &n),
                         [&](void* memory, std::size_t bytes, hm_error* e) {
                             return fixtures::variables_map(&set_, given, &variables, nullptr,
                                                            fixtures::Memory(memory, bytes),
                                                            matrix.data(), error.data(), e);
                         });
        if (status < 0) expect_untouched(matrix), expect_untouched(error);
        else expect_finite(matrix, "a map of variables"), expect_finite(error, "its error");
        return judged(status);
    }

    Problem const& problem_;
    hm_curves const& set_;
    Input& input_;
    std::int32_t number_ = 0;
    bool is_valid_ = false;
    double size_ = 0;
    hm_error error_{};
    Blocks blocks_;
};

}  // namespace

Outcome run_shape(Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input);
    if (problem->on_walls.curve.empty()) return Outcome::refused;
    if (input.one_in(3)) break_something(*problem, input);
    return Shape(*problem, input).run();
}

}  // namespace fuzz
