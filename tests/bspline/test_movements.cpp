#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/curves.hpp>
#include <fixtures/memory.hpp>

#include <algorithm>
#include <string>

using fixtures::chord;
using fixtures::CurveSet;
using fixtures::pi;
using fixtures::Spline;

namespace {

CurveSet airfoil(bool blunt = false, double camber = 0.02) {
    return fixtures::naca_section(blunt, 30, camber);
}

hm_movement movement(int kind, double x = 0, double y = 0, double length = 0) {
    auto out = fixtures::sized<hm_movement>();
    out.kind = kind;
    out.x = x;
    out.y = y;
    out.length = length;
    return out;
}

hm_movement camber_thickness(int n_camber, int n_thickness) {
    hm_movement out = movement(HM_CAMBER_THICKNESS);
    out.n_camber = n_camber;
    out.n_thickness = n_thickness;
    return out;
}

struct Moved {
    hm_status status;
    hm_error error{};
    std::int32_t n = 0;
    std::vector<double> move, derivatives, start, difference;
};

Moved moved(CurveSet& set, std::vector<hm_movement> const& movements,
            std::vector<double> const& values, hm_section const* section = nullptr) {
    Moved out;
    std::size_t bytes = 0;
    auto const n = std::int32_t(movements.size());
    out.status = fixtures::move_section_size(&set.view(), section, n, movements.data(), &out.n,
                                             &bytes, &out.error);
    if (out.status < 0) return out;
    REQUIRE(std::size_t(out.n) == values.size());
    auto const length = std::size_t(2 * set.n_control());
    out.move.assign(length, -7);
    out.derivatives.assign(values.size() * length, -7);
    out.start.assign(values.size(), -7);
    out.difference.assign(2, -7);
    fixtures::Guarded work(bytes);
    out.status = fixtures::move_section(&set.view(), section, n, movements.data(), nullptr,
                                        values.data(), out.move.data(), out.derivatives.data(),
                                        out.start.data(), out.difference.data(),
                                        fixtures::Memory(work.data(), bytes), &out.error);
    CHECK(work.guards_intact());
    return out;
}

CurveSet after(CurveSet const& set, Moved const& by) {
    CurveSet out = set;
    for (std::size_t k = 0; k < out.control.size(); ++k) out.control[k] += by.move[k];
    return out;
}

struct At {
    double x, y;
};
At curve_at(CurveSet& set, double u) {
    double xy[2];
    REQUIRE(hm_curve_point(&set.view(), 0, u, 0, xy, nullptr) == HM_OK);
    return {xy[0], xy[1]};
}

hm_section const unit_chord = chord(0, 0, 1, 0);

double measured(CurveSet& set, int kind, double station = 0) {
    hm_quantity const asked = fixtures::quantity(kind, station);
    double value = 0;
    REQUIRE(hm_measure(&set.view(), &unit_chord, 1, &asked, &value, nullptr, nullptr, nullptr) ==
            HM_OK);
    return value;
}

struct Case {
    std::string name;
    std::vector<hm_movement> movements;
    std::vector<double> values;
    double step;
};

std::vector<Case> cases() {
    std::vector<double> const parsec = {0.002, 0.01,  0.004, 0.05, -0.01, -0.003,
                                        0.04,  0.002, 0.001, 0.8,  1.5};
    return {{"turn", {movement(HM_ROTATE, 0.25, 0.1)}, {17}, 1e-2},
            {"shift", {movement(HM_SHIFT)}, {0.3, -0.2}, 1e-2},
            {"scale", {movement(HM_SCALE, 1, 2)}, {0.4}, 1e-2},
            {"flap", {movement(HM_FLAP, 0.7, 0.01, 0.15)}, {-12}, 1e-2},
            {"flap, scale, turn, shift",
             {movement(HM_FLAP, 0.7, 0), movement(HM_SCALE, 0.5, 0), movement(HM_ROTATE, 0.25, 0),
              movement(HM_SHIFT)},
             {-9, 0.2, 5, 0.1, 0.2},
             1e-2},
            {"camber and thickness",
             {camber_thickness(3, 4)},
             {0.05, 0.08, -0.04, .01, .02, -.01, .03},
             1e-3},
            {"PARSEC", {movement(HM_PARSEC)}, parsec, 2e-4},
            {"blade", {movement(HM_BLADE, 0.3, 0.1)}, {6, -8, 20}, 1e-2},
            {"blade and flap",
             {movement(HM_BLADE, 0.3, 0.1), movement(HM_FLAP, 0.8, 0), movement(HM_ROTATE, 0, 0)},
             {6, -8, 4, 5, -30},
             1e-2}};
}

// The section and the centres of movements turned about the origin, so that no direction is that of
// an axis.
void turn_by_fifty_degrees(CurveSet& set, std::vector<hm_movement>& movements) {
    double const c = 0.6427876096865394, s = 0.7660444431189780;
    auto const turn = [&](double& x, double& y) {
        double const along = x;
        x = c * along - s * y;
        y = s * along + c * y;
    };
    for (std::size_t k = 0; k < set.control.size(); k += 2)
        turn(set.control[k], set.control[k + 1]);
    for (hm_movement& each : movements) turn(each.x, each.y);
}

}  // namespace

TEST_CASE("derivatives of movements agree with differences, of fourth order under refinement") {
    std::vector<Case> const straight = cases();
    for (std::size_t i = 0; i < 2 * straight.size(); ++i) {
        Case one = straight[i / 2];
        CurveSet set = airfoil();
        if (i % 2 == 1) turn_by_fifty_degrees(set, one.movements);
        Moved const at = moved(set, one.movements, one.values);
        INFO(one.name);
        INFO("turned: " << i % 2);
        REQUIRE(at.status == HM_OK);
        auto const length = std::size_t(2 * set.n_control());
        double coarse = 0, fine = 0, largest = 0;
        for (std::size_t j = 0; j < one.values.size(); ++j) {
            // The five-point formula, with two steps.
            auto const differences = [&](double h) {
                auto const f = [&](double times) {
                    std::vector<double> values = one.values;
                    values[j] += times * h;
                    return moved(set, one.movements, values).move;
                };
                std::vector<double> const two_back = f(-2), back = f(-1), ahead = f(1),
                                          two_ahead = f(2);
                std::vector<double> found(length);
                for (std::size_t k = 0; k < length; ++k)
                    found[k] = (8 * (ahead[k] - back[k]) - (two_ahead[k] - two_back[k])) / (12 * h);
                return found;
            };
            double const h = one.step * std::max(1.0, std::fabs(one.values[j]));
            std::vector<double> const by_long_steps = differences(4 * h),
                                      by_short_steps = differences(h);
            for (std::size_t k = 0; k < length; ++k) {
                double const exact = at.derivatives[j * length + k];
                largest = std::max(largest, std::fabs(exact));
                coarse = std::max(coarse, std::fabs(by_long_steps[k] - exact));
                fine = std::max(fine, std::fabs(by_short_steps[k] - exact));
            }
        }
        INFO("largest " << largest << ", differences " << coarse << ", " << fine);
        CHECK(largest > 1e-3);
        CHECK(fine <= 1e-8 * largest);
        CHECK((fine <= coarse / 100 || fine <= 1e-11 * largest));
    }
}

TEST_CASE("values that are 0 move nothing, to the bit") {
    for (Case const& one : cases()) {
        CurveSet set = airfoil(true);
        INFO(one.name);
        Moved const at = moved(set, one.movements, std::vector<double>(one.values.size()));
        REQUIRE(at.status == HM_OK);
        for (double const move : at.move) CHECK(move == 0);
    }
}

TEST_CASE("turn, shift and scale move the curve exactly") {
    CurveSet set = airfoil();
    Moved const by =
        moved(set, {movement(HM_ROTATE, 0.25, 0), movement(HM_SCALE, 1, 0), movement(HM_SHIFT)},
              {90, 1, 3, 4});
    REQUIRE(by.status == HM_OK);
    CHECK(by.difference[1] == 0);
    CurveSet now = after(set, by);
    for (int k = 0; k <= 50; ++k) {
        At const p = curve_at(set, k / 50.0), q = curve_at(now, k / 50.0);
        double const x = 0.25 - p.y, y = p.x - 0.25;
        CHECK(q.x == doctest::Approx(1 + 2 * (x - 1) + 3).epsilon(1e-14));
        CHECK(q.y == doctest::Approx(2 * y + 4).epsilon(1e-14));
    }
}

TEST_CASE("a turn of a periodic curve needs no chord, and moves its control points alone") {
    CurveSet set;
    set.add(fixtures::ring(3, 12, 1, 0.5));
    set.add(fixtures::ring(3, 12, 1, 0.5, 5, 0));
    auto second = fixtures::sized<hm_section>();
    second.first_curve = second.n_curves = 1;
    Moved const by = moved(set, {movement(HM_ROTATE, 5, 0)}, {180}, &second);
    REQUIRE(by.status == HM_OK);
    for (std::size_t k = 0; k < 24; ++k) {
        CHECK(by.move[k] == 0);
        double const from_centre = set.control[24 + k] - (k % 2 == 0 ? 5 : 0);
        CHECK(by.move[24 + k] == doctest::Approx(-2 * from_centre).epsilon(1e-15));
    }
    CHECK(moved(set, {movement(HM_FLAP, 5, 0)}, {1}, &second).status == HM_BAD_CURVE);
}

TEST_CASE("the error of a flap is the distance of the curve from the map of its points") {
    for (double const length : {0.1, 0.3}) {
        for (double const degrees : {-15.0, 4.0}) {
            CurveSet set = airfoil();
            double const x = 0.6, y = 0.01;
            Moved const by = moved(set, {movement(HM_FLAP, x, y, length)}, {degrees});
            REQUIRE(by.status == HM_OK);
            CurveSet bent = after(set, by);
            double largest = 0;
            double const begin = set.shapes[0].knots.front(), end = set.shapes[0].knots.back();
            for (int k = 0; k <= 5000; ++k) {
                double const u = begin + (end - begin) * k / 5000;
                At const from = curve_at(set, u), to = curve_at(bent, u);
                // The chord is the x axis to 1e-3.
                double const t = std::min(std::max((from.x - x) / length, 0.0), 1.0),
                             a = degrees * pi / 180 * t * t * t * (10 - t * (15 - 6 * t));
                double const dx = from.x - x, dy = from.y - y;
                largest =
                    std::max(largest, std::hypot(to.x - x - std::cos(a) * dx + std::sin(a) * dy,
                                                 to.y - y - std::sin(a) * dx - std::cos(a) * dy));
            }
            CHECK(largest > 1e-4);
            CHECK(by.difference[1] == doctest::Approx(largest).epsilon(0.05));
            CHECK(by.difference[0] > 0);
            CHECK(by.difference[0] < by.difference[1]);
            // A turn after the flap, which is an isometry, changes no distance.
            Moved const both = moved(
                set, {movement(HM_FLAP, x, y, length), movement(HM_ROTATE, 0, 0)}, {degrees, 40});
            CHECK(both.difference[1] == doctest::Approx(by.difference[1]).epsilon(1e-9));
        }
    }
    CurveSet set = airfoil();
    Moved const rigid =
        moved(set, {movement(HM_ROTATE, 0.25, 0), movement(HM_SCALE), movement(HM_SHIFT)},
              {10, 0.2, 1, 2});
    CHECK(rigid.difference == std::vector<double>{0, 0});
}

TEST_CASE("a flap leaves control points ahead of the hinge, and turns those behind as a body") {
    CurveSet set = airfoil();
    double const x = 0.6, y = 0.01, length = 0.2, degrees = -15;
    Moved const by = moved(set, {movement(HM_FLAP, x, y, length)}, {degrees});
    REQUIRE(by.status == HM_OK);
    double const c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    int ahead = 0, behind = 0;
    for (int i = 0; i < set.n_control(); ++i) {
        auto const k = std::size_t(2 * i);
        double const dx = set.control[k] - x, dy = set.control[k + 1] - y;
        // The chord is the x axis to 1e-3.
        if (dx < -1e-3) {
            ++ahead;
            CHECK(by.move[k] == 0);
            CHECK(by.move[k + 1] == 0);
        } else if (dx > length + 1e-3) {
            ++behind;
            CHECK(by.move[k] == doctest::Approx((c - 1) * dx - s * dy).epsilon(1e-13));
            CHECK(by.move[k + 1] == doctest::Approx(s * dx + (c - 1) * dy).epsilon(1e-13));
        }
    }
    CHECK(ahead > 5);
    CHECK(behind >= 3);
}

TEST_CASE("a flap may begin as suddenly as numbers allow, without an overflow") {
    CurveSet set = airfoil();
    Moved const by = moved(set, {movement(HM_FLAP, 0.7, 0, 5e-324)}, {10});
    REQUIRE(by.status == HM_OK);
    double const c = std::cos(pi / 18) - 1, s = std::sin(pi / 18);
    for (std::size_t k = 0; k < set.control.size(); k += 2) {
        double const dx = set.control[k] - 0.7, dy = set.control[k + 1];
        bool const is_behind = dx > 0.01;
        if (std::fabs(dx) <= 0.01) continue;  // the chord is not exactly the x axis
        CHECK(by.move[k] == doctest::Approx(is_behind ? c * dx - s * dy : 0).epsilon(1e-12));
        CHECK(by.move[k + 1] == doctest::Approx(is_behind ? s * dx + c * dy : 0).epsilon(1e-12));
    }
}

TEST_CASE("thickness is added on both sides of a straight camber line, and camber keeps it") {
    CurveSet set = airfoil(false, 0);
    Moved const thicker = moved(set, {camber_thickness(0, 1)}, {0.05}, &unit_chord);
    REQUIRE(thicker.status == HM_OK);
    CurveSet now = after(set, thicker);
    for (double const s : {0.1, 0.3, 0.6, 0.9}) {
        double const added = 2 * 0.05 * std::sqrt(s) * (1 - s);
        CHECK(measured(now, HM_THICKNESS, s) - measured(set, HM_THICKNESS, s) ==
              doctest::Approx(added).epsilon(0.01));
    }
    // With camber, thickness stays normal to the camber line: the area changes in second order
    // only, and points at the largest camber move along the normal of the chord.
    Moved const cambered = moved(set, {camber_thickness(1, 0)}, {0.4}, &unit_chord);
    REQUIRE(cambered.status == HM_OK);
    CurveSet bent = after(set, cambered);
    CHECK(measured(bent, HM_CAMBER, 0.5) == doctest::Approx(0.1).epsilon(1e-3));
    CHECK(measured(bent, HM_THICKNESS, 0.5) ==
          doctest::Approx(measured(set, HM_THICKNESS, 0.5)).epsilon(5e-3));
}

TEST_CASE("a section that PARSEC has changed has the new parameter") {
    struct Changed {
        std::size_t parameter;
        double by, tolerance;
    };
    for (bool const blunt : {false, true}) {
        CurveSet set = airfoil(blunt);
        for (Changed const& one :
             {Changed{0, 0.002, 4e-4}, Changed{1, 0.03, 1e-3}, Changed{2, 0.01, 2e-5},
              Changed{3, 0.1, 1e-2}, Changed{5, 0.01, 2e-5}, Changed{7, 0.01, 1e-8},
              Changed{9, 1.5, 0.1}, Changed{10, 1.5, 0.1}}) {
            std::vector<double> values(11);
            values[one.parameter] = one.by;
            Moved const parsec = moved(set, {movement(HM_PARSEC)}, values, &unit_chord);
            REQUIRE(parsec.status == HM_OK);
            CurveSet now = after(set, parsec);
            Moved const again =
                moved(now, {movement(HM_PARSEC)}, std::vector<double>(11), &unit_chord);
            REQUIRE(again.status == HM_OK);
            double const change = again.start[one.parameter] - parsec.start[one.parameter];
            INFO("parameter " << one.parameter << " changed by " << change);
            CHECK(std::fabs(change - one.by) < one.tolerance);
        }
    }
}

TEST_CASE("a blade has the metal angles and the stagger that were asked for") {
    CurveSet set = airfoil();
    Moved const blade = moved(set, {movement(HM_BLADE, 0.5, 0)}, {12, -10, 25}, &unit_chord);
    REQUIRE(blade.status == HM_OK);
    CHECK(blade.start[2] == 0);
    CurveSet now = after(set, blade);
    double const c = 0.5 * std::cos(25 * pi / 180), d = 0.5 * std::sin(25 * pi / 180);
    hm_section const new_chord = chord(0.5 - c, -d, 0.5 + c, d);
    Moved const again = moved(now, {movement(HM_BLADE)}, {0, 0, 0}, &new_chord);
    REQUIRE(again.status == HM_OK);
    CHECK(std::fabs(again.start[0] - blade.start[0] - 12) < 0.05);
    CHECK(std::fabs(again.start[1] - blade.start[1] + 10) < 0.05);
    CHECK(std::fabs(again.start[2] - 25) < 1e-12);
}

TEST_CASE("movements that cannot be made are refused, and the outputs stay") {
    CurveSet set = airfoil(), ring(fixtures::ring(3, 12, 1, 0.5));
    struct Refused {
        CurveSet& set;
        std::vector<hm_movement> movements;
        std::vector<double> values;
        hm_status status;
        const char* text;
    };
    hm_movement unknown = movement(9), spoiled = movement(HM_SHIFT),
                long_turn = movement(HM_ROTATE);
    spoiled.struct_size = 1;
    long_turn.length = 1;
    hm_variables const linear = fixtures::sized<hm_variables>();
    hm_movement with_variables = movement(HM_FLAP), with_members = movement(HM_SHIFT);
    with_variables.variables = &linear;
    with_members.n_members = 1;
    std::vector<double> back(11), flat(11);
    back[1] = 1;
    flat[0] = -1;
    hm_movement reserved = movement(HM_ROTATE);
    reserved.reserved = 7;
    std::vector<Refused> const table = {
        {set, {unknown}, {0}, HM_BAD_ARGUMENT, "must be one of HM_ROTATE to HM_FAMILY"},
        {set, {spoiled}, {0, 0}, HM_BAD_ARGUMENT, "not the size of an hm_movement"},
        {set, {reserved}, {0}, HM_BAD_ARGUMENT, "reserved of movement 0 must be 0, not 7"},
        {set, {long_turn}, {0}, HM_BAD_ARGUMENT, "must be 0 unless the kind is HM_FLAP"},
        {set, {movement(HM_SHIFT, 1, 0)}, {0, 0}, HM_BAD_ARGUMENT, "and 0 if the kind"},
        {set, {movement(HM_FLAP, 0, 0, -1)}, {0}, HM_BAD_ARGUMENT, "must be 0 or above, not -1"},
        {set, {camber_thickness(0, 0)}, {}, HM_BAD_ARGUMENT, "their sum at least 1"},
        {set, {camber_thickness(65, 0)}, {}, HM_BAD_ARGUMENT, "between 0 and 64"},
        {set, {movement(HM_SHIFT), movement(HM_PARSEC)}, {}, HM_BAD_ARGUMENT, "must come first"},
        {set, {movement(HM_SHIFT), movement(HM_SCALE)}, {0, 0, -1}, HM_BAD_ARGUMENT, "value 2"},
        {set, {movement(HM_LINEAR)}, {}, HM_BAD_ARGUMENT, "variables of movement 0 is NULL"},
        {set, {with_variables}, {}, HM_BAD_ARGUMENT, "variables of movement 0 must be NULL unless"},
        {set, {movement(HM_FAMILY)}, {}, HM_BAD_ARGUMENT, "members of movement 0 is NULL"},
        {set, {with_members}, {}, HM_BAD_ARGUMENT, "must be 0 unless the kind is HM_FAMILY"},
        {set, {movement(HM_ROTATE)}, {361}, HM_BAD_ARGUMENT, "value 0 of the movements is 361"},
        {set, {movement(HM_ROTATE)}, {std::nan("")}, HM_BAD_ARGUMENT, "out of range"},
        {set, {movement(HM_BLADE)}, {0, 90, 0}, HM_BAD_ARGUMENT, "value 1 of the movements is 90"},
        {set, {movement(HM_PARSEC)}, back, HM_BAD_ARGUMENT, "value 1 of"},
        {set, {movement(HM_PARSEC)}, flat, HM_BAD_ARGUMENT, "value 0 of"},
        {set,
         {movement(HM_SHIFT), movement(HM_SHIFT)},
         {9e99, 0, 9e99, 0},
         HM_BAD_ARGUMENT,
         "the values move control point"},
        {ring, {movement(HM_PARSEC)}, back, HM_BAD_CURVE, "no trailing edge"}};
    for (Refused const& one : table) {
        INFO(one.text);
        if (one.values.empty()) {
            std::int32_t n = -7;
            std::size_t bytes = 7;
            hm_error error{};
            CHECK(fixtures::move_section_size(
                      &one.set.view(), nullptr, std::int32_t(one.movements.size()),
                      one.movements.data(), &n, &bytes, &error) == one.status);
            CHECK(std::string(error.text).find(one.text) != std::string::npos);
            CHECK(n == -7);
            continue;
        }
        Moved const out = moved(one.set, one.movements, one.values);
        CHECK(out.status == one.status);
        CHECK(std::string(out.error.text).find(one.text) != std::string::npos);
        for (double const value : out.move) CHECK(value == -7);
        for (double const value : out.start) CHECK(value == -7);
    }
}
