#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/airfoil.hpp>
#include <fixtures/curves.hpp>
#include <fixtures/memory.hpp>

#include <algorithm>
#include <functional>
#include <string>

using fixtures::CurveSet;
using fixtures::naca_section;
using fixtures::pi;
using fixtures::Spline;

namespace {

struct Map {
    hm_status status;
    hm_error error{};
    std::int32_t n = 0;
    std::vector<double> matrix, errors;

    double x(int point, int variable) const {
        return matrix[std::size_t(2 * (point * n + variable))];
    }
    double y(int point, int variable) const {
        return matrix[std::size_t(2 * (point * n + variable) + 1)];
    }
};

Map mapped(CurveSet& set, hm_variables const& variables, hm_section const* section = nullptr) {
    Map out;
    std::size_t bytes = 0;
    out.status =
        fixtures::variables_size(&set.view(), section, &variables, &out.n, &bytes, &out.error);
    if (out.status < 0) return out;
    out.matrix.assign(std::size_t(2 * set.n_control() * out.n), -7);
    out.errors.assign(std::size_t(2 * out.n), -7);
    fixtures::Guarded work(bytes);
    out.status = fixtures::variables_map(&set.view(), section, &variables, nullptr,
                                         fixtures::Memory(work.data(), bytes), out.matrix.data(),
                                         out.errors.data(), &out.error);
    CHECK(work.guards_intact());
    return out;
}

hm_variables kind(int number, int n_upper = 0, int n_lower = 0) {
    auto out = fixtures::sized<hm_variables>();
    out.kind = number;
    out.n_upper = n_upper;
    out.n_lower = n_lower;
    return out;
}

// The displacement of the curve by a variable at a parameter, and the point of the curve there.
struct Movement {
    double x, y, dx = 0, dy = 0;

    Movement(CurveSet& set, Map const& map, int variable, double u) {
        std::int32_t control[4];
        double value[4], at[2];
        REQUIRE(hm_curve_basis(&set.view(), 0, u, 0, control, value, nullptr) == HM_OK);
        REQUIRE(hm_curve_point(&set.view(), 0, u, 0, at, nullptr) == HM_OK);
        x = at[0];
        y = at[1];
        for (int k = 0; k < 4; ++k) {
            dx += value[k] * map.x(control[k], variable);
            dy += value[k] * map.y(control[k], variable);
        }
    }
};

double bernstein(int degree, int k, double t) {
    double value = std::pow(t, k) * std::pow(1 - t, degree - k);
    for (int i = 0; i < k; ++i) value *= double(degree - i) / (k - i);
    return value;
}

hm_section unit_chord() { return fixtures::chord(0, 0, 1, 0); }

// The largest difference between what a variable moves the curve by and shape(station, upper)
// normal to the chord (0,0)
// - (1,0), against the error that the library says. The sides meet where the curve is farthest from
// (1,0).
template <class Shape>
void check_shape(CurveSet& set, Map const& map, int variable, Shape const& shape) {
    double worst = 0, farthest = 0, leading = 0;
    for (int k = 0; k <= 4000; ++k) {
        Movement const at(set, map, variable, k / 4000.0);
        if (std::hypot(at.x - 1, at.y) > farthest) {
            farthest = std::hypot(at.x - 1, at.y);
            leading = k / 4000.0;
        }
    }
    double const upper_first = Movement(set, map, variable, 0.5 * leading).y > 0;
    for (int k = 0; k <= 4000; ++k) {
        double const u = k / 4000.0;
        if (std::fabs(u - leading) < 1e-3) continue;
        Movement const at(set, map, variable, u);
        bool const upper = (u < leading) == (upper_first != 0);
        double const t = std::min(std::max(at.x, 0.0), 1.0);
        worst = std::max({worst, std::fabs(at.dx), std::fabs(at.dy - shape(t, upper))});
    }
    INFO("variable " << variable << ", error " << map.errors[std::size_t(2 * variable + 1)]);
    CHECK(worst <= 1.1 * map.errors[std::size_t(2 * variable + 1)] + 1e-12);
    CHECK(map.errors[std::size_t(2 * variable)] <= map.errors[std::size_t(2 * variable + 1)]);
}

}  // namespace

TEST_CASE("an FFD box of degree 1 gives affine maps exactly; a box of any degree translations") {
    CurveSet set = naca_section(false, 20);
    for (int const degree : {1, 3}) {
        hm_variables box = kind(HM_FFD);
        box.degree_x = degree;
        box.degree_y = 1;
        box.x_min = -0.5;
        box.x_max = 1.5;
        box.y_min = -1;
        box.y_max = 1;
        Map const map = mapped(set, box);
        REQUIRE_MESSAGE(map.status == HM_OK, map.error.text);
        CHECK(map.n == (degree + 1) * 2);
        for (int i = 0; i < set.n_control(); ++i) {
            double dx = 0, dy = 0, sum = 0;
            for (int node = 0; node < map.n; ++node) {
                double const x = -0.5 + 2.0 * (node % (degree + 1)) / degree,
                             y = node / (degree + 1) == 0 ? -1 : 1;
                dx += map.x(i, node) * (0.1 + 0.3 * x - 0.7 * y);
                dy += map.x(i, node) * (-0.2 + 0.5 * x + 0.4 * y);
                sum += map.x(i, node);
                CHECK(map.y(i, node) == 0);
            }
            double const x = set.control[std::size_t(2 * i)],
                         y = set.control[std::size_t(2 * i + 1)];
            CHECK(sum == doctest::Approx(1).epsilon(1e-10));
            CHECK(dx == doctest::Approx(0.1 + 0.3 * x - 0.7 * y).epsilon(1e-9));
            CHECK(dy == doctest::Approx(-0.2 + 0.5 * x + 0.4 * y).epsilon(1e-9));
        }
    }
}

TEST_CASE("CST, bumps and NACA modes move the curve by their formulas within the reported error") {
    for (bool const blunt : {false, true}) {
        CurveSet set = naca_section(blunt, 30);
        hm_section const chord = unit_chord();
        Map const cst = mapped(set, kind(HM_CST, 4, 3), &chord);
        REQUIRE_MESSAGE(cst.status == HM_OK, cst.error.text);
        CHECK(cst.n == 7);
        Map const bumps = mapped(set, kind(HM_HICKS_HENNE, 3, 2), &chord);
        REQUIRE_MESSAGE(bumps.status == HM_OK, bumps.error.text);
        Map const naca = mapped(set, kind(HM_NACA4, 1), &chord);
        REQUIRE_MESSAGE(naca.status == HM_OK, naca.error.text);
        CHECK(naca.n == 2);
        for (int j = 0; j < 7; ++j) {
            if (j >= 4) continue;  // of the upper side: check_shape tells the sides by the sign
            check_shape(set, cst, j, [&](double t, bool upper) {
                return upper ? std::sqrt(t) * (1 - t) * bernstein(3, j, t) : 0;
            });
        }
        for (int j = 0; j < 3; ++j) {
            double const peak = (2 * j + 1) / 6.0;
            check_shape(set, bumps, j, [&](double t, bool upper) {
                return upper
                           ? std::pow(std::sin(pi * std::pow(t, std::log(0.5) / std::log(peak))), 3)
                           : 0;
            });
            CHECK(bumps.errors[std::size_t(2 * j)] < 0.06);
        }
        check_shape(set, naca, 0, [](double t, bool) {
            return t < 0.4 ? t * (0.8 - t) / 0.16 : (0.2 + 0.8 * t - t * t) / 0.36;
        });
        check_shape(set, naca, 1, [](double t, bool upper) {
            return fixtures::naca_half(upper ? 1 : -1, false, t);
        });
        CHECK(naca.errors[0] < 1e-3);
        CHECK(naca.errors[2] < 5e-3);
        // Ends are exact: these shapes vanish at the trailing edge.
        int const last = set.shapes[0].indices.back();
        for (int const end : {set.shapes[0].indices.front(), last})
            for (int j = 0; j < 7; ++j) CHECK(std::fabs(cst.y(end, j)) < 3e-3);
    }
}

TEST_CASE("more control points approximate the shapes better") {
    double before = 1;
    for (int const n : {12, 24, 48}) {
        CurveSet set = naca_section(false, n);
        Map const map = mapped(set, kind(HM_NACA4, 1));
        REQUIRE_MESSAGE(map.status == HM_OK, map.error.text);
        CHECK(map.errors[0] < 0.7 * before);
        before = map.errors[0];
    }
}

TEST_CASE("the given chord divides a periodic section of either direction") {
    CurveSet ring(fixtures::ring(3, 24, 0.5, 0.1, 0.5, 0));
    hm_section const chord = unit_chord();
    CHECK(mapped(ring, kind(HM_CST, 2, 2)).status == HM_BAD_CURVE);
    Map const map = mapped(ring, kind(HM_CST, 2, 2), &chord);
    REQUIRE_MESSAGE(map.status == HM_OK, map.error.text);
    CurveSet back = fixtures::reversed(ring);
    Map const reversed = mapped(back, kind(HM_CST, 2, 2), &chord);
    REQUIRE(reversed.status == HM_OK);
    for (int i = 0; i < ring.n_control(); ++i) {
        bool const upper = ring.control[std::size_t(2 * i + 1)] > 0.04;
        bool const lower = ring.control[std::size_t(2 * i + 1)] < -0.04;
        for (int j = 0; j < 4; ++j) {
            CHECK(map.y(i, j) == doctest::Approx(reversed.y(i, j)).epsilon(1e-9));
            if ((upper && j < 2) || (lower && j >= 2)) CHECK(map.y(i, j) > 0);
            if ((upper && j >= 2) || (lower && j < 2)) CHECK(std::fabs(map.y(i, j)) < 0.05);
        }
    }
}

TEST_CASE("the unit of a curve's parameter does not matter") {
    CurveSet set = naca_section(false, 20);
    hm_variables const modes = kind(HM_CST, 4, 4);
    Map const plain = mapped(set, modes);
    REQUIRE(plain.status == HM_OK);
    for (double const unit : {1.0 / (1 << 30), 1024.0 * 1024}) {  // powers of two: no bit changes
        CurveSet other = set;
        for (double& knot : other.shapes[0].knots) knot *= unit;
        Map const map = mapped(other, modes);
        CHECK(map.status == HM_OK);
        double worst = 0;
        for (std::size_t k = 0; k < plain.matrix.size(); ++k)
            worst = std::fmax(worst, std::fabs(map.matrix[k] - plain.matrix[k]));
        CHECK(worst < 1e-9);
    }
}

// The sides meet inside a span, at one fraction of the span or, backwards, at the rest.
TEST_CASE("functions and errors of a section with an inner leading edge ignore direction") {
    for (int const n : {9, 10, 11, 12, 13}) {
        CurveSet set = naca_section(false, n), back = fixtures::reversed(set);
        Map const map = mapped(set, kind(HM_CST, 3, 3)),
                  reversed = mapped(back, kind(HM_CST, 3, 3));
        REQUIRE_MESSAGE(map.status == HM_OK, map.error.text);
        REQUIRE_MESSAGE(reversed.status == HM_OK, reversed.error.text);
        for (std::size_t k = 0; k < map.matrix.size(); ++k)
            CHECK(std::fabs(map.matrix[k] - reversed.matrix[k]) < 1e-8);
        for (std::size_t k = 0; k < map.errors.size(); ++k)
            CHECK(std::fabs(map.errors[k] - reversed.errors[k]) < 1e-8);
    }
}

TEST_CASE("variables without effect, repeated or out of range are refused by name") {
    CurveSet set = naca_section(false, 20);
    auto const refusal = [&](hm_variables const& variables, std::string const& word) {
        Map const map = mapped(set, variables);
        CHECK_MESSAGE(std::string(map.error.text).find(word) != std::string::npos, map.error.text);
        for (double const entry : map.matrix) CHECK(entry == -7);
        return map.status;
    };
    hm_variables far = kind(HM_FFD);
    far.x_min = 5;
    far.x_max = 6;
    far.y_max = 1;
    CHECK(refusal(far, "variable 0 moves no control point") == HM_BAD_CONDITION);
    double const peaks[] = {0.3, 0.6, 0.3};
    hm_variables twice = kind(HM_HICKS_HENNE, 3, 0);
    twice.peaks = peaks;
    CHECK(refusal(twice, "variable 2 is a linear combination of the variables before it") ==
          HM_BAD_CONDITION);
}

TEST_CASE("a tied trailing edge moves by the mean of what both sides ask for") {
    CurveSet set = naca_section(false, 17);
    std::int32_t const edge = set.shapes[0].indices.front();
    REQUIRE(set.shapes[0].indices.back() == edge);
    int const n_upper = 4, n_lower = 3;
    hm_variables cst = kind(HM_CST, n_upper, n_lower);
    cst.leading_exponent =
        0.5;  // and an edge exponent of 0: the last variable of each side opens the edge
    Map const map = mapped(set, cst);
    REQUIRE_MESSAGE(map.status == HM_OK, map.error.text);
    double tip[2], leading[2] = {0, 0};
    REQUIRE(hm_curve_point(&set.view(), 0, set.shapes[0].knots.front(), 0, tip, nullptr) == HM_OK);
    for (int k = 0; k < 400; ++k) {  // the leading edge: farthest from the trailing edge
        double at[2];
        double const begin = set.shapes[0].knots.front(), end = set.shapes[0].knots.back();
        REQUIRE(hm_curve_point(&set.view(), 0, begin + (end - begin) * k / 400, 0, at, nullptr) ==
                HM_OK);
        if (std::hypot(at[0] - tip[0], at[1] - tip[1]) >
            std::hypot(leading[0] - tip[0], leading[1] - tip[1]))
            leading[0] = at[0], leading[1] = at[1];
    }
    for (int v = 0; v < n_upper + n_lower; ++v) {
        bool const opens = v == n_upper - 1 || v == n_upper + n_lower - 1;
        INFO("variable " << v);
        CHECK(map.x(edge, v) ==
              doctest::Approx(opens ? -0.5 * (tip[1] - leading[1]) : 0).epsilon(1e-3));
        CHECK(map.y(edge, v) ==
              doctest::Approx(opens ? 0.5 * (tip[0] - leading[0]) : 0).epsilon(1e-4));
    }
    CHECK(map.y(edge, n_upper - 1) == map.y(edge, n_upper + n_lower - 1));
}

TEST_CASE("the residual of each shape is orthogonal to all free basis functions") {
    struct Shapes {
        const char* name;
        hm_variables variables;
        std::function<double(int variable, double t, bool upper)> shape;
    };
    auto const bump = [](int bump_number, int n, double t) {
        double const peak = (2 * bump_number + 1) / (2.0 * n);
        return std::pow(std::sin(pi * std::pow(t, std::log(0.5) / std::log(peak))), 3);
    };
    Shapes const all[] = {
        {"CST", kind(HM_CST, 4, 3),
         [](int v, double t, bool upper) {
             if (upper != (v < 4)) return 0.0;
             return std::sqrt(t) * (1 - t) * (upper ? bernstein(3, v, t) : bernstein(2, v - 4, t));
         }},
        {"Hicks-Henne", kind(HM_HICKS_HENNE, 3, 2),
         [&](int v, double t, bool upper) {
             return upper != (v < 3) ? 0.0 : upper ? bump(v, 3, t) : bump(v - 3, 2, t);
         }},
        {"NACA", kind(HM_NACA4, 1),
         [](int v, double t, bool upper) {
             if (v == 0) return t < 0.4 ? t * (0.8 - t) / 0.16 : (0.2 + 0.8 * t - t * t) / 0.36;
             return fixtures::naca_half(upper ? 1 : -1, false, t);
         }},
    };
    hm_section const chord = unit_chord();
    for (Shapes const& shapes : all) {
        CurveSet set = naca_section(false, 24);
        Map const map = mapped(set, shapes.variables, &chord);
        REQUIRE_MESSAGE(map.status == HM_OK, map.error.text);
        int const n_samples = 20000;
        double const begin = set.shapes[0].knots[3],
                     end = set.shapes[0].knots[set.shapes[0].indices.size()];
        auto const parameter = [&](int k) { return begin + (end - begin) * (k + 0.5) / n_samples; };
        double farthest = 0, leading = 0, first_side = 0;
        for (int k = 0; k < n_samples; ++k) {
            Movement const at(set, map, 0, parameter(k));
            if (std::hypot(at.x - 1, at.y) <= farthest) continue;
            farthest = std::hypot(at.x - 1, at.y);
            leading = parameter(k);
        }
        first_side = Movement(set, map, 0, 0.5 * (begin + leading)).y;
        for (int v = 0; v < map.n; ++v) {
            std::vector<double> left(std::size_t(set.n_control()), 0.0), size = left;
            double along = 0;
            for (int k = 0; k < n_samples; ++k) {
                double const u = parameter(k);
                Movement const at(set, map, v, u);
                bool const upper = (u < leading) == (first_side > 0);
                double const wanted = shapes.shape(v, std::min(std::max(at.x, 0.0), 1.0), upper);
                std::int32_t control[4];
                double value[4];
                hm_curve_basis(&set.view(), 0, u, 0, control, value, nullptr);
                for (int i = 0; i < 4; ++i) {
                    left[std::size_t(control[i])] += value[i] * (wanted - at.dy);
                    size[std::size_t(control[i])] += value[i];
                }
                along = std::max(along, std::fabs(at.dx));
            }
            CHECK(along < 1e-12);
            for (std::int32_t i = 0; i < set.n_control(); ++i) {
                if (i == set.shapes[0].indices.front() || i == set.shapes[0].indices.back())
                    continue;
                INFO(std::string(shapes.name) << ", variable " << v << ", control point " << i);
                CHECK(std::fabs(left[std::size_t(i)] / size[std::size_t(i)]) < 2e-4);
            }
        }
    }
}

namespace {

struct SectionMove {
    hm_status status;
    hm_error error{};
    hm_section_move found = fixtures::sized<hm_section_move>();
    std::vector<double> move, derivatives, matrix;

    SectionMove(CurveSet& set, std::vector<hm_movement> const& movements,
                std::vector<double> const& values, bool wants_matrix = false) {
        std::int32_t const n = std::int32_t(movements.size());
        hm_section const chord = unit_chord();
        hm_memory memory{};
        status = hm_move_section(&set.view(), &chord, n, movements.data(), nullptr, &found, &memory,
                                 &error);
        if (status < 0) return;
        fixtures::Guarded work(memory.bytes);
        memory.block = work.data();
        std::size_t const length = std::size_t(2 * set.n_control());
        move.assign(length, 7);
        derivatives.assign(length * std::size_t(found.n_values), 7);
        matrix.assign(length * std::size_t(std::max(found.n_variables, 1)), 7);
        found.move = move.data();
        found.derivatives = derivatives.data();
        if (wants_matrix) found.matrix = matrix.data();
        std::vector<double> unit_errors(200, 7);
        found.unit_errors = unit_errors.data();
        status = hm_move_section(&set.view(), &chord, n, movements.data(),
                                 values.empty() ? nullptr : values.data(), &found, &memory, &error);
        CHECK(work.guards_intact());
        // Several movements have no variables of their own, and so no errors of these.
        std::size_t const n_errors = status < 0 ? 0 : std::size_t(2 * found.n_variables);
        for (std::size_t k = 0; k < unit_errors.size(); ++k)
            CHECK((unit_errors[k] == 7) == (k >= n_errors));
        found.unit_errors = nullptr;
    }
};

hm_movement linear(hm_variables const& variables) {
    auto out = fixtures::sized<hm_movement>();
    out.kind = HM_LINEAR;
    out.variables = &variables;
    return out;
}

}  // namespace

TEST_CASE("values of linear variables move the control points as their matrix does") {
    CurveSet set = naca_section(false, 20);
    for (bool const is_box : {false, true}) {
        auto variables = kind(is_box ? HM_FFD : HM_CST, is_box ? 0 : 3, is_box ? 0 : 2);
        if (is_box) variables.degree_x = 2, variables.degree_y = 1;
        hm_section const chord = unit_chord();
        Map const map = mapped(set, variables, &chord);
        std::vector<double> values(std::size_t(is_box ? 2 * map.n : map.n));
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = 0.01 * std::cos(3.0 * double(k));
        SectionMove const moved(set, {linear(variables)}, values, true);
        REQUIRE(moved.status == HM_OK);
        CHECK(moved.found.n_values == std::int32_t(values.size()));
        CHECK(moved.found.n_variables == map.n);
        CHECK(moved.matrix == map.matrix);
        double bound = 0;
        for (int j = 0; j < map.n; ++j) {
            double const size =
                is_box ? std::hypot(values[std::size_t(2 * j)], values[std::size_t(2 * j + 1)])
                       : std::fabs(values[std::size_t(j)]);
            bound += size * map.errors[std::size_t(2 * j + 1)];
        }
        CHECK(moved.found.error[1] == doctest::Approx(bound));
        for (int i = 0; i < set.n_control(); ++i) {
            double x = 0, y = 0;
            for (int j = 0; j < map.n; ++j) {
                double const a = values[std::size_t(is_box ? 2 * j : j)],
                             b = is_box ? values[std::size_t(2 * j + 1)] : 0;
                x += map.x(i, j) * a - map.y(i, j) * b;
                y += map.y(i, j) * a + map.x(i, j) * b;
            }
            CHECK(std::fabs(moved.move[std::size_t(2 * i)] - x) < 1e-15);
            CHECK(std::fabs(moved.move[std::size_t(2 * i + 1)] - y) < 1e-15);
        }
        for (double const number : SectionMove(set, {linear(variables)}, {}).move)
            CHECK(number == 0);
    }
}

TEST_CASE("a flap behind linear variables has the derivatives of both") {
    CurveSet set = naca_section(true, 24);
    auto const variables = kind(HM_HICKS_HENNE, 2, 2);
    auto flap = fixtures::sized<hm_movement>();
    flap.kind = HM_FLAP;
    flap.x = 0.7;
    std::vector<hm_movement> const movements = {linear(variables), flap};
    std::vector<double> const values = {0.01, -0.006, 0.004, 0.003, 12};
    SectionMove const at(set, movements, values);
    REQUIRE(at.status == HM_OK);
    CHECK(at.found.n_variables == 0);
    std::size_t const length = at.move.size();
    for (std::size_t j = 0; j < values.size(); ++j) {
        double const h = j < 4 ? 1e-5 : 1e-2;
        std::vector<double> more = values, less = values;
        more[j] += h;
        less[j] -= h;
        SectionMove const up(set, movements, more), down(set, movements, less);
        for (std::size_t k = 0; k < length; ++k) {
            double const slope = (up.move[k] - down.move[k]) / (2 * h);
            CHECK(std::fabs(at.derivatives[j * length + k] - slope) < 1e-7);
        }
    }
    SectionMove const refused(set, movements, values, true);
    CHECK(refused.status == HM_BAD_ARGUMENT);
    CHECK(std::string(refused.error.text).find("result.matrix must be NULL") != std::string::npos);
}
