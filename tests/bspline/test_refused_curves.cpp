// Calls with curves and sections that are refused, with the whole sentence of each refusal.
#include <harmorph_design.h>

#include <fixtures/curves.hpp>
#include <fixtures/refused.hpp>
#include <fixtures/guarded.hpp>
#include <fixtures/memory.hpp>

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
            return u[0] = knot, fixtures::refine_size(&square.set, 0, 0, 1, u, &bytes, e);
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
    quantity.struct_size = sizeof quantity;
    auto const measure = [&](hm_section const& of_section, std::int32_t kind) {
        return [&, of_section, kind](hm_error* e) {
            section = of_section;
            quantity.kind = kind;
            return hm_measure(&square.set, &section, 1, &quantity, &value, nullptr, nullptr, e);
        };
    };
    check_texts({
        {HM_BAD_ARGUMENT, "section.n_curves is 9, but a section has at most 8 curves",
         measure({sizeof section, 0, 9, 0, 0, 1, 0}, HM_AREA)},
        {HM_BAD_CURVE, "the chord of the section has no length",
         measure({sizeof section, 0, 1, 1, 1, 1, 1}, HM_CHORD)},
        {HM_BAD_CURVE, "all points of the section are in the same place",
         call_by(hm_measure, &point.set, nullptr, 1, &quantity, &value, nullptr, nullptr)},
        {HM_BAD_CURVE, "no normal to the chord meets the outline at two points",
         measure({sizeof section, 0, 1, 20, 20, 21, 20}, HM_MAX_THICKNESS)},
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
