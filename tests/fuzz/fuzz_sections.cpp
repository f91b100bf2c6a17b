// Movements of airfoil sections (hm_move_section) and fits of one airfoil on the knots of another
// (hm_refit). Maps of control points are computed again by the formulas of the header, derivatives
// are compared with differences, and the distances of a report with projections.
#include <harmorph_design.h>
#include "exceptions.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <fixtures/airfoil.hpp>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;

class Section {
public:
    explicit Section(Input& input) : input_(input), blocks_(input) {
        is_blunt_ = input.one_in(3);
        size_ = input.any_of({1.0, 1.0, 1e-6, 1e6});
        camber_ = input.between(-0.05, 0.05);
        thickness_ = input.between(0.06, 0.2);
        std::vector<Point> const points = outline(80, camber_, thickness_);
        curves_.add(points, false, input);
        curves_.finish(input);
        set_ = curves_.view;
        trailing_ = {(points.front().x + points.back().x) / 2,
                     (points.front().y + points.back().y) / 2};
    }

    Outcome run() {
        Outcome const outcome = input_.one_in(3) ? refit() : move();
        blocks_.expect_intact();
        return outcome;
    }

private:
    // From the trailing edge over the upper side to the leading edge, and back below.
    std::vector<Point> outline(std::int32_t n, double camber, double thickness) const {
        double const pi = std::acos(-1.0);
        std::vector<Point> out;
        for (std::int32_t k = 0; k <= n; ++k) {
            double const angle = 2 * pi * k / n, x = 0.5 * (1 + std::cos(angle));
            double const half = fixtures::naca_half(thickness, is_blunt_, x),
                         middle = 4 * camber * x * (1 - x);
            out.push_back({size_ * x, size_ * (middle + (2 * k < n ? half : -half))});
        }
        return out;
    }

    // ---- hm_move_section ----

    hm_movement movement(bool is_first) {
        hm_movement out = sized<hm_movement>();
        out.kind = input_.from(HM_ROTATE, is_first ? HM_BLADE : HM_FLAP);
        if (input_.one_in(30)) out.kind = input_.wild_index();
        bool const has_place =
            out.kind != HM_SHIFT && out.kind != HM_CAMBER_THICKNESS && out.kind != HM_PARSEC;
        if (has_place || input_.one_in(30)) {
            out.x =
                size_ * (out.kind == HM_FLAP ? input_.between(0.3, 0.9) : input_.between(-1, 2));
            out.y = size_ * input_.between(-0.1, 0.1);
        }
        if (out.kind == HM_FLAP && input_.one_in(2)) out.length = size_ * input_.between(0.02, 0.3);
        if (out.kind == HM_CAMBER_THICKNESS)
            out.n_camber = input_.from(0, 4), out.n_thickness = input_.from(0, 4);
        if (input_.one_in(40)) out.length = input_.wild();
        return out;
    }
    Numbers values_of(std::vector<hm_movement> const& movements) {
        Numbers out;
        auto const add = [&](double value) {
            out.push_back(input_.one_in(60) ? input_.wild() : value);
        };
        for (hm_movement const& movement : movements) {
            switch (movement.kind) {
                case HM_ROTATE: add(input_.between(-90, 90)); break;
                case HM_SHIFT:
                    add(size_ * input_.between(-1, 1));
                    add(size_ * input_.between(-1, 1));
                    break;
                case HM_SCALE: add(input_.between(-0.6, 1)); break;
                case HM_FLAP: add(input_.between(-30, 30)); break;
                case HM_CAMBER_THICKNESS:
                    for (std::int32_t k = movement.n_camber + movement.n_thickness; k > 0; --k)
                        add(input_.between(-0.05, 0.05));
                    break;
                case HM_PARSEC:
                    for (int k = 0; k < 11; ++k) add(input_.between(-0.01, 0.01));
                    break;
                default:
                    for (int k = 0; k < 3; ++k) add(input_.between(-5, 5));
            }
        }
        return out;
    }

    struct Moved {
        hm_status status = 0;
        Numbers move, derivatives, start, difference;
    };
    Moved moved(hm_section const& section, std::vector<hm_movement> const& movements,
                Numbers const& values) {
        Moved out;
        std::size_t const coordinates = curves_.control.size();
        std::int32_t const count = static_cast<std::int32_t>(movements.size());
        std::int32_t n = 0;
        out.status = blocks_.make(
            error_,
            size_by(fixtures::move_section_size, &set_, &section, count, movements.data(), &n),
            [&](void* memory, std::size_t bytes, hm_error* e) {
                expect(at(n) == values.size(), "another number of values than the kinds have");
                out.move.assign(coordinates, 7);
                out.derivatives.assign(values.size() * coordinates, 7);
                out.start.assign(values.size(), 7);
                out.difference.assign(2, 7);
                Exceptions::clear();
                hm_status const status = fixtures::move_section(
                    &set_, &section, count, movements.data(), nullptr, values.data(),
                    out.move.data(), out.derivatives.data(), out.start.data(),
                    out.difference.data(), fixtures::Memory(memory, bytes), e);
                Exceptions::expect_none("fixtures::move_section, " + in_words(movements, values));
                return status;
            });
        return out;
    }

    Outcome move() {
        hm_section section = sized<hm_section>();
        bool const has_chord = input_.one_in(2);
        if (has_chord) section.trailing_x = trailing_.x, section.trailing_y = trailing_.y;
        std::vector<hm_movement> movements;
        for (std::int32_t k = input_.from(1, 4); k > 0; --k)
            movements.push_back(movement(movements.empty()));
        Numbers const values = values_of(movements);
        Moved const found = moved(section, movements, values);
        if (found.status < 0) {
            expect_untouched(found.move), expect_untouched(found.derivatives);
            expect_untouched(found.start), expect_untouched(found.difference);
            return Outcome::refused;
        }
        for (Numbers const* const numbers :
             {&found.move, &found.derivatives, &found.start, &found.difference})
            for (double const number : *numbers) expect(std::isfinite(number), "not finite");
        if (movements[0].kind <= HM_SCALE || (has_chord && movements[0].kind == HM_FLAP))
            is_map(movements, values, found.move, has_chord);
        slopes(section, movements, values, found);
        return Outcome::done;
    }

    // Turn, shift, scale and flap map control points. A flap needs the direction of the chord.
    void is_map(std::vector<hm_movement> const& movements, Numbers const& values,
                Numbers const& found, bool has_chord) const {
        using Wide = long double;
        Wide const pi = std::acos(Wide(-1)), chord = std::hypot(Wide(trailing_.x), trailing_.y);
        for (std::size_t k = 0; k < curves_.control.size(); k += 2) {
            Wide x = curves_.control[k], y = curves_.control[k + 1];
            const double* value = values.data();
            for (hm_movement const& by : movements) {
                if (by.kind == HM_FLAP && !has_chord) return;
                if (by.kind == HM_SHIFT) {
                    x += value[0], y += value[1];
                    value += 2;
                    continue;
                }
                Wide const dx = x - by.x, dy = y - by.y;
                Wide turn = by.kind == HM_SCALE ? 0 : value[0] * pi / 180;
                Wide const scale = by.kind == HM_SCALE ? 1 + Wide(value[0]) : 1;
                if (by.kind == HM_FLAP) {
                    Wide const length = by.length > 0 ? by.length : chord / 10,
                               behind = (dx * trailing_.x + dy * trailing_.y) / chord,
                               t = std::min(Wide(1), std::max(Wide(0), behind / length));
                    turn *= t * t * t * (10 - 15 * t + 6 * t * t);
                }
                Wide const c = scale * std::cos(turn), s = scale * std::sin(turn);
                x = by.x + c * dx - s * dy;
                y = by.y + s * dx + c * dy;
                ++value;
            }
            double const error = std::hypot(double(x - curves_.control[k]) - found[k],
                                            double(y - curves_.control[k + 1]) - found[k + 1]);
            expect(error <= 1e-12 * (size_ + std::hypot(found[k], found[k + 1])),
                   "a control point moves otherwise than by the formula: " + shown(error));
        }
    }

    // Exact derivatives, against central differences of two lengths.
    void slopes(hm_section const& section, std::vector<hm_movement> const& movements,
                Numbers const& values, Moved const& found) {
        std::size_t const j = input_.below(static_cast<std::uint32_t>(values.size())),
                          coordinates = found.move.size();
        bool const is_wild = std::any_of(values.begin(), values.end(), [this](double value) {
            return std::abs(value) > 360 * std::max(1.0, size_);
        });
        if (is_wild) return;  // the movement has no digits left for differences
        double largest = 0;
        for (std::size_t k = 0; k < coordinates; ++k)
            largest = std::max(largest, std::abs(found.derivatives[j * coordinates + k]));
        std::vector<bool> is_length;  // of each value
        for (hm_movement const& movement : movements) {
            std::int32_t n = 0;
            std::size_t bytes = 0;
            fixtures::move_section_size(&set_, &section, 1, &movement, &n, &bytes, &error_);
            is_length.insert(is_length.end(), at(n), movement.kind == HM_SHIFT);
        }
        double reach = size_;  // the largest coordinate, whose rounding the differences have
        for (double const number : found.move) reach = std::max(reach, std::abs(number));
        double rounding = 0;
        Numbers slope[2];
        for (int way = 0; way < 2; ++way) {
            double const least = 1e-2 * (is_length[j] ? size_ : 1),
                         h = (way == 0 ? 1e-3 : 2.5e-4) * std::max(std::abs(values[j]), least);
            rounding = 0x1p-50 * reach / h;
            Numbers above = values, below = values;
            above[j] += h, below[j] -= h;
            Moved const up = moved(section, movements, above),
                        down = moved(section, movements, below);
            if (up.status < 0 || down.status < 0) return;  // at the end of the range
            for (std::size_t k = 0; k < coordinates; ++k)
                slope[way].push_back((up.move[k] - down.move[k]) / (above[j] - below[j]));
        }
        for (std::size_t k = 0; k < coordinates; ++k) {
            double const known = std::abs(slope[0][k] - slope[1][k]),
                         error = std::abs(slope[1][k] - found.derivatives[j * coordinates + k]);
            expect(error <= 2 * known + rounding + 1e-5 * largest,
                   "the derivative " + shown(found.derivatives[j * coordinates + k]) +
                       " by value " + std::to_string(j) + " is " + shown(slope[0][k]) + " and " +
                       shown(slope[1][k]) + " by differences; " + in_words(movements, values));
        }
    }

    static std::string in_words(std::vector<hm_movement> const& movements, Numbers const& values) {
        std::string out = "kinds";
        for (hm_movement const& movement : movements) out += ' ' + std::to_string(movement.kind);
        out += ", values";
        for (double const value : values) out += ' ' + shown(value);
        return out;
    }

    // ---- hm_refit ----

    Outcome refit() {
        std::vector<Point> points = outline(2 * input_.from(10, 40), input_.between(-0.06, 0.06),
                                            input_.between(0.05, 0.2));
        if (!is_blunt_ && input_.one_in(2)) points.pop_back();  // a loop
        bool const is_loop = points.size() % 2 == 0, on_chord = input_.one_in(3);
        if (input_.one_in(2)) std::reverse(points.begin(), points.end());
        double const turn = on_chord ? input_.between(-1, 1) : 0;
        for (Point& p : points) p = turned(p, {std::cos(turn), std::sin(turn)});
        bool const is_wild = input_.one_in(8);
        if (is_wild)
            points[input_.below(static_cast<std::uint32_t>(points.size()))].y = input_.wild();
        std::int32_t const n = static_cast<std::int32_t>(points.size()),
                           curve = input_.one_in(20) ? input_.wild_index() : 0;
        hm_points const through{&points[0].x, &points[0].y, 2};
        Numbers movement(curves_.control.size(), 7);
        hm_refit_report report = sized<hm_refit_report>();
        hm_status const status = blocks_.make(
            error_, size_by(fixtures::refit_size, &set_, curve, n),
            [&](void* memory, std::size_t bytes, hm_error* e) {
                return hm_refit(&set_, curve, &through, n, is_loop, on_chord, movement.data(),
                                &report, fixtures::Memory(memory, bytes), e);
            });
        if (status < 0) {
            expect_untouched(movement);
            return Outcome::refused;
        }
        for (double const number : movement) expect(std::isfinite(number), "not finite");
        if (is_wild || on_chord || report.closed_width > 0) return Outcome::done;
        Numbers control = curves_.control;
        for (std::size_t k = 0; k < control.size(); ++k) control[k] += movement[k];
        hm_curves changed = set_;
        changed.control = control.data();
        double largest = 0;
        for (Point const& p : points) {
            double u = 0, distance = 0;
            expect(hm_curve_project(&changed, 0, p.x, p.y, &u, &distance, &error_) == HM_OK,
                   "no nearest place on the moved curve");
            largest = std::max(largest, distance);
        }
        expect(largest <= report.max_error + 1e-6 * size_,
               "a point is farther from the moved curve than the report says: " +
                   shown(largest / size_) + " and " + shown(report.max_error / size_) + " chords");
        expect(report.rms_error <= report.max_error * (1 + 1e-12), "the mean is above the largest");
        expect(std::abs(report.chord - size_) <= 0.02 * size_, "another chord");
        return Outcome::done;
    }

    Input& input_;
    bool is_blunt_ = false;
    double size_ = 1, camber_ = 0, thickness_ = 0;
    Point trailing_{1, 0};
    CurveArrays curves_;
    hm_curves set_{};
    hm_error error_{};
    Blocks blocks_;
};

}  // namespace

Outcome run_sections(Input& input) { return Section(input).run(); }

}  // namespace fuzz
