// Calls with curves and sections that are refused, with the whole sentence of each refusal.
#include <harmorph_design.h>

#include <fixtures/curves.hpp>
#include <fixtures/refused.hpp>
#include <fixtures/sized.hpp>

#include <cmath>
#include <limits>

using namespace fixtures;

namespace {

// A square from its corner (1, 0) on, against the clock: polygons of `n` pieces, each a curve.
struct Square {
    std::vector<double> control{1, 0, 1, 1, 0, 1, 0, 0};
    std::vector<std::int32_t> indices{0, 1, 2, 3, 0};
    double knots[7] = {0, 0, 1, 2, 3, 4, 4};
    std::vector<hm_curve> curve;
    hm_curves set{};

    explicit Square(std::size_t n = 1) {
        auto one = sized<hm_curve>();
        one.degree = 1;
        one.n_indices = 5;
        one.indices = indices.data();
        one.knots = knots;
        curve.assign(n, one);
        set.struct_size = sizeof set;
        set.n_control = 4;
        set.control = control.data();
        set.n_curves = std::int32_t(n);
        set.curve = curve.data();
    }
};

double const not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("refused evaluations and refinements of curves have the stated texts") {
    Square square;
    double xy[4], u[1];
    std::size_t bytes = 0;
    auto const refine = [&](double knot) {
        return [&, knot](hm_error* e) {
            return u[0] = knot, hm_refine_size(&square.set, 0, 0, 1, u, &bytes, e);
        };
    };
    check_texts({
        {HM_BAD_ARGUMENT, "u is 9, which is outside the range of the parameter of the curve",
         call_by(hm_curve_point, &square.set, 0, 9, 0, xy)},
        {HM_BAD_ARGUMENT, "u is NaN, which is outside the range of the parameter of the curve",
         call_by(hm_curve_point, &square.set, 0, not_a_number, 0, xy)},
        {HM_BAD_ARGUMENT, "n_derivatives must be between 0 and 5, not 6",
         call_by(hm_curve_point, &square.set, 0, 1, 6, xy)},
        {HM_BAD_ARGUMENT, "n_derivatives must be between 0 and 5, not -1",
         call_by(hm_curve_point, &square.set, 0, 1, -1, xy)},
        {HM_BAD_ARGUMENT, "curve 1 does not exist; curves.n_curves is 1",
         call_by(hm_curve_point, &square.set, 1, 1, 0, xy)},
        {HM_BAD_ARGUMENT, "curve -1 does not exist; curves.n_curves is 1",
         call_by(hm_curve_point, &square.set, -1, 1, 0, xy)},
        {HM_BAD_ARGUMENT, "knot 0 to be inserted, 4, is not inside the range of curve 0",
         refine(4)},
        {HM_BAD_ARGUMENT, "knot 0 to be inserted, 0, is not inside the range of curve 0",
         refine(0)},
        {HM_BAD_ARGUMENT, "knot 0 to be inserted, NaN, is not inside the range of curve 0",
         refine(not_a_number)},
        {HM_BAD_CURVE, "knot 0, 2, would be repeated 2 times, more often than the degree allows",
         refine(2)},
    });
}

TEST_CASE("refused sections have the stated texts") {
    Square square(9), flat, point;
    point.control = {1, 1, 1, 1, 1, 1, 1, 1};
    point.set.control = point.control.data();
    flat.control = {1, 0, 0.5, 0, 0, 0, 0.5, 0};  // there and back
    flat.set.control = flat.control.data();
    hm_section section{};
    hm_quantity quantity{};
    double value = 0;
    auto const measure = [&](std::uint64_t size, std::int32_t first, std::int32_t n) {
        return [&, size, first, n](hm_error* e) {
            section = {size, first, n, 0, 0, 1, 0};
            quantity.struct_size = sizeof quantity;
            quantity.kind = HM_AREA;
            return hm_measure(&square.set, &section, 1, &quantity, &value, nullptr, nullptr, e);
        };
    };
    check_texts({
        {HM_BAD_ARGUMENT,
         "section.struct_size is not the size of an hm_section; begin with HM_INIT(section)",
         measure(0, 0, 1)},
        {HM_BAD_ARGUMENT,
         "section.first_curve is 8 and section.n_curves is 2, but the set does not have these "
         "curves",
         measure(sizeof section, 8, 2)},
        {HM_BAD_ARGUMENT,
         "section.first_curve is -1 and section.n_curves is 1, but the set does not have these "
         "curves",
         measure(sizeof section, -1, 1)},
        {HM_BAD_ARGUMENT,
         "section.first_curve is 1 and section.n_curves is 0, but the set does not have these "
         "curves",
         measure(sizeof section, 1, 0)},
        {HM_BAD_ARGUMENT, "section.n_curves is 9, but a section has at most 8 curves",
         measure(sizeof section, 0, 9)},
        {HM_BAD_CURVE, "the chord of the section has no length",
         [&](hm_error* e) {
             section = {sizeof section, 0, 1, 1, 1, 1, 1};
             quantity.kind = HM_CHORD;
             return hm_measure(&square.set, &section, 1, &quantity, &value, nullptr, nullptr, e);
         }},
        {HM_BAD_CURVE, "all points of the section are in the same place",
         call_by(hm_measure, &point.set, nullptr, 1, &quantity, &value, nullptr, nullptr)},
        {HM_BAD_CURVE, "no normal to the chord meets the outline at two points",
         [&](hm_error* e) {
             section = {sizeof section, 0, 1, 20, 20, 21, 20};
             quantity.kind = HM_MAX_THICKNESS;
             return hm_measure(&square.set, &section, 1, &quantity, &value, nullptr, nullptr, e);
         }},
        {HM_BAD_ARGUMENT, "the polygon of quantity 0 is NULL, empty or longer than 2^20 points",
         [&](hm_error* e) {
             quantity.kind = HM_CLEARANCE;
             section = {sizeof section, 0, 1, 0, 0, 1, 0};
             return hm_measure(&square.set, &section, 1, &quantity, &value, nullptr, nullptr, e);
         }},
        {HM_BAD_CURVE, "the section encloses no area: the integral along the outline is 0",
         [&](hm_error* e) {
             quantity.kind = HM_AREA;
             return hm_measure(&flat.set, nullptr, 1, &quantity, &value, nullptr, nullptr, e);
         }},
    });
}

// Rounding gives this segment, there and back, a height above the chord and below at some stations.
TEST_CASE("a section without area has a finite thickness and camber, or is refused") {
    double const control[] = {3.9999063684482712, 1.4999661103392339, 6.1336163906407215,
                              1.5000384142781293};
    double const knots[] = {-0.5, 0, 0.5, 1, 1.5};
    std::int32_t const there_and_back[] = {0, 1, 0};
    hm_curve const curve{sizeof curve, 1, 3, there_and_back, knots};
    hm_curves const set{sizeof set, 0, 2, control, nullptr, 1, &curve};
    hm_section const other_chord{sizeof other_chord, 0, 0, 5.85624, 0, 2.96336, 3.24062};
    for (hm_section const* section : {static_cast<hm_section const*>(nullptr), &other_chord}) {
        for (std::int32_t kind : {HM_MAX_THICKNESS, HM_MAX_CAMBER}) {
            hm_quantity quantity{};
            quantity.struct_size = sizeof quantity;
            quantity.kind = kind;
            double value = 7;
            hm_status const status =
                hm_measure(&set, section, 1, &quantity, &value, nullptr, nullptr, nullptr);
            CHECK(std::isfinite(value));
            if (status < 0) CHECK(value == 7);
            else CHECK(std::fabs(value) < 1e-14);
        }
    }
}

TEST_CASE("a curve that is constant has no curvature there") {
    std::vector<double> const control{1, 0, 0.5, 0.5, 0, 0, 0, 0, 0, 0, 0.5, -0.5, 1, 0};
    double const knots[] = {0, 0, 0, 1, 2, 3, 4, 5, 5, 5};
    auto curve = sized<hm_curve>();
    curve.degree = 2;
    curve.n_indices = 7;
    curve.knots = knots;
    hm_curves const set{sizeof set, 0, 7, control.data(), nullptr, 1, &curve};
    auto quantity = sized<hm_quantity>();
    quantity.kind = HM_MIN_RADIUS;
    double value = 7;
    hm_error error{};
    CHECK(hm_measure(&set, nullptr, 1, &quantity, &value, nullptr, nullptr, &error) ==
          HM_BAD_CURVE);
    std::string const text = error.text;
    INFO(text);
    CHECK(text.find("curve 0 has no curvature at parameter ") == 0);
    CHECK(text.find(", because its derivative is 0 there") != std::string::npos);
    CHECK(value == 7);
}

TEST_CASE("refused design variables have the stated texts") {
    Square square;
    hm_variables v{};
    std::int32_t n = 0;
    std::size_t bytes = 0;
    double const peaks[] = {0.5, 1.5};
    auto const with = [&](std::int32_t kind, void (*change)(hm_variables&)) {
        return [&, kind, change](hm_error* e) {
            v = {};
            v.struct_size = sizeof v;
            v.kind = kind;
            if (kind == HM_CST || kind == HM_HICKS_HENNE) v.n_upper = 1;
            change(v);
            if (v.peaks != nullptr) v.peaks = peaks;
            return hm_variables_size(&square.set, nullptr, &v, &n, &bytes, e);
        };
    };
    static double const some = 0.5;
    check_texts({
        {HM_BAD_ARGUMENT, "variables is NULL",
         call_by(hm_variables_size, &square.set, nullptr, nullptr, &n, &bytes)},
        {HM_BAD_ARGUMENT,
         "variables.struct_size is not the size of an hm_variables; begin with HM_INIT(variables)",
         with(HM_FFD, [](auto& o) { o.struct_size = 0; })},
        {HM_BAD_ARGUMENT,
         "variables.kind is 9, but it must be HM_FFD, HM_CST, HM_HICKS_HENNE or HM_NACA4",
         with(9, [](auto&) {})},
        {HM_BAD_ARGUMENT,
         "variables.kind is -1, but it must be HM_FFD, HM_CST, HM_HICKS_HENNE or HM_NACA4",
         with(-1, [](auto&) {})},
        {HM_BAD_ARGUMENT,
         "degree_x, degree_y and the box of variables must be 0 unless the kind is HM_FFD",
         with(HM_CST, [](auto& o) { o.degree_x = 1; })},
        {HM_BAD_ARGUMENT,
         "degree_x, degree_y and the box of variables must be 0 unless the kind is HM_FFD",
         with(HM_CST, [](auto& o) { o.degree_y = 1; })},
        {HM_BAD_ARGUMENT,
         "degree_x, degree_y and the box of variables must be 0 unless the kind is HM_FFD",
         with(HM_CST, [](auto& o) { o.y_max = 1; })},
        {HM_BAD_ARGUMENT, "variables.n_upper and n_lower must be 0 for HM_FFD",
         with(HM_FFD, [](auto& o) { o.n_upper = 1; })},
        {HM_BAD_ARGUMENT, "variables.n_upper and n_lower must be 0 for HM_FFD",
         with(HM_FFD, [](auto& o) { o.n_lower = 1; })},
        {HM_BAD_ARGUMENT, "variables.n_lower must be 0 for HM_NACA4",
         with(HM_NACA4, [](auto& o) { o.n_lower = 1; })},
        {HM_BAD_ARGUMENT,
         "variables.peaks must be NULL unless the kind is HM_HICKS_HENNE or HM_NACA4",
         with(HM_CST, [](auto& o) { o.peaks = &some; })},
        {HM_BAD_ARGUMENT,
         "variables.peaks must be NULL unless the kind is HM_HICKS_HENNE or HM_NACA4",
         with(HM_FFD, [](auto& o) { o.peaks = &some; })},
        {HM_BAD_ARGUMENT,
         "leading_exponent and trailing_exponent of variables must be 0 unless the kind is HM_CST",
         with(HM_FFD, [](auto& o) { o.leading_exponent = 1; })},
        {HM_BAD_ARGUMENT,
         "leading_exponent and trailing_exponent of variables must be 0 unless the kind is HM_CST",
         with(HM_FFD, [](auto& o) { o.trailing_exponent = 1; })},
        {HM_BAD_ARGUMENT, "variables.width must be 0 unless the kind is HM_HICKS_HENNE",
         with(HM_CST, [](auto& o) { o.width = 2; })},
        {HM_BAD_ARGUMENT,
         "variables.n_upper is 65 and n_lower is 0; each must be between 0 and 64, and their sum "
         "at least 1 (0 for HM_NACA4)",
         with(HM_CST, [](auto& o) { o.n_upper = 65; })},
        {HM_BAD_ARGUMENT,
         "variables.n_upper is 1 and n_lower is 65; each must be between 0 and 64, and their sum "
         "at least 1 (0 for HM_NACA4)",
         with(HM_CST, [](auto& o) { o.n_lower = 65; })},
        {HM_BAD_ARGUMENT,
         "variables.n_upper is 0 and n_lower is 0; each must be between 0 and 64, and their sum at "
         "least 1 (0 for HM_NACA4)",
         with(HM_CST, [](auto& o) { o.n_upper = 0; })},
        {HM_BAD_ARGUMENT,
         "variables.degree_x is 64 and degree_y is 0, but each must be between 0 and 63",
         with(HM_FFD, [](auto& o) { o.degree_x = 64; })},
        {HM_BAD_ARGUMENT,
         "variables.degree_x is 0 and degree_y is -1, but each must be between 0 and 63",
         with(HM_FFD, [](auto& o) { o.degree_y = -1; })},
        {HM_BAD_ARGUMENT, "variables.leading_exponent must be between 0 and 10, not 11",
         with(HM_CST, [](auto& o) { o.leading_exponent = 11; })},
        {HM_BAD_ARGUMENT, "variables.leading_exponent must be between 0 and 10, not -1",
         with(HM_CST, [](auto& o) { o.leading_exponent = -1; })},
        {HM_BAD_ARGUMENT, "variables.trailing_exponent must be between 0 and 10, not 11",
         with(HM_CST, [](auto& o) { o.trailing_exponent = 11; })},
        {HM_BAD_ARGUMENT, "variables.width must be 0 or between 1 and 100, not 101",
         with(HM_HICKS_HENNE, [](auto& o) { o.width = 101; })},
        {HM_BAD_ARGUMENT, "variables.width must be 0 or between 1 and 100, not -1",
         with(HM_HICKS_HENNE, [](auto& o) { o.width = -1; })},
        {HM_BAD_ARGUMENT, "peak 1 of variables.peaks is 1.50000, but it must lie between 0 and 1",
         with(HM_HICKS_HENNE, [](auto& o) { o.n_upper = 2, o.peaks = &some; })},
        {HM_BAD_ARGUMENT,
         "the box of the variables is empty or not finite; x_min must be below x_max, and y_min "
         "below y_max",
         with(HM_FFD, [](auto& o) { o.x_min = 1; })},
    });
}
