// Bounds of the fields that belong to curves, sections and design variables: the last value inside
// is accepted, the first one outside is refused by the field's name.
#include <harmorph_design.h>
#include <doctest/doctest.h>

#include <fixtures/spoiled_arguments.hpp>
#include <fixtures/parted.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

double const square_of_points[] = {3, 3, 4, 3, 4, 4, 3, 4};
double const bad_polygon[] = {3, 3, not_a_number, 3}, far_polygon[] = {3, 3, 4, beyond_range};

}  // namespace

TEST_CASE("quantities of a section") {
    CurveSet set = airfoil_case().curves;
    hm_quantity area = sized<hm_quantity>();
    area.kind = HM_AREA;
    hm_quantity thickness = area, clearance = area;
    thickness.kind = HM_THICKNESS;
    thickness.station = 0.5;
    clearance.kind = HM_CLEARANCE;
    clearance.n_polygon = 4;
    clearance.polygon = square_of_points;
    auto const measure = [&](hm_quantity const& asked, hm_error* e) {
        double value = 0;
        return hm_measure(&set.view(), nullptr, 1, &asked, &value, nullptr, nullptr, e);
    };
    using Q = hm_quantity;
    check_changes<Q>(
        area,
        {{nullptr, [](Q&) {}},
         {"struct_size of quantity 0", [](Q& q) { q.struct_size = 0; }},
         {"the kind of quantity 0 is -1, but", [](Q& q) { q.kind = -1; }},
         {"the kind of quantity 0 is 20, but", [](Q& q) { q.kind = HM_DISTANCE + 1; }},
         {"has a station, but only HM_THICKNESS, HM_CAMBER and HM_MIN_THICKNESS use one",
          [](Q& q) { q.station = 0.5; }},
         {"has a last station, but only HM_MIN_THICKNESS uses one",
          [](Q& q) { q.last_station = 0.5; }},
         {"has the sharpness 1, but only HM_CLEARANCE, HM_MIN_THICKNESS and HM_DISTANCE use one",
          [](Q& q) { q.sharpness = 1; }},
         {"names another body, but only HM_DISTANCE uses one", [](Q& q) { q.n_other = 1; }},
         {"has a polygon, but only HM_CLEARANCE uses one", [](Q& q) { q.n_polygon = 1; }}},
        HM_BAD_ARGUMENT, measure);
    check_changes<Q>(thickness,
                     {{nullptr, [](Q&) {}},
                      {nullptr, [](Q& q) { q.station = 0.01; }},
                      {nullptr, [](Q& q) { q.station = 0.99; }},
                      {"the station of quantity 0 is 0", [](Q& q) { q.station = 0; }},
                      {"the station of quantity 0 is 1", [](Q& q) { q.station = 1; }},
                      {"the station of quantity 0 is NaN", [](Q& q) { q.station = not_a_number; }}},
                     HM_BAD_ARGUMENT, measure);
    hm_quantity thinnest = thickness;
    thinnest.kind = HM_MIN_THICKNESS;
    thinnest.last_station = 0.6;
    check_changes<Q>(
        thinnest,
        {{nullptr, [](Q&) {}},
         {nullptr, [](Q& q) { q.last_station = q.station; }},
         {"the last station of quantity 0 is 0", [](Q& q) { q.last_station = 0; }},
         {"the last station of quantity 0 is 1", [](Q& q) { q.last_station = 1; }},
         {"the last station of quantity 0 is NaN", [](Q& q) { q.last_station = not_a_number; }},
         {"the sharpness of quantity 0 is -1, but it must be 0 or between 1e-100 and 1e100",
          [](Q& q) { q.sharpness = -1; }},
         {"the sharpness of quantity 0 is NaN", [](Q& q) { q.sharpness = not_a_number; }}},
        HM_BAD_ARGUMENT, measure);
    hm_quantity distance = area;
    distance.kind = HM_DISTANCE;
    check_changes<Q>(
        distance,
        {{"the other body of quantity 0 has no curves, or curves of the section", [](Q&) {}},
         {"has no curves, or curves of the section", [](Q& q) { q.n_other = 1; }},
         {"does not have these curves", [](Q& q) { q.other_curve = 7, q.n_other = 1; }}},
        HM_BAD_ARGUMENT, measure);
    check_changes<Q>(
        clearance,
        {{nullptr, [](Q&) {}},
         {"longer than 2^20 points", [](Q& q) { q.n_polygon = 0; }},
         {"longer than 2^20 points", [](Q& q) { q.n_polygon = (1 << 20) + 1; }},
         {"the polygon of quantity 0 is NULL", [](Q& q) { q.polygon = nullptr; }},
         {"point 1 of the polygon of quantity 0", [](Q& q) { q.polygon = bad_polygon; }},
         {"point 1 of the polygon of quantity 0",
          [](Q& q) { q.polygon = far_polygon, q.n_polygon = 2; }}},
        HM_BAD_ARGUMENT, measure);
    hm_quantity two[] = {area, area};
    two[1].struct_size = 0;
    double values[2];
    hm_error error{};
    CHECK(hm_measure(&set.view(), nullptr, 0, two, values, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n must be at least 1, not 0");
    CHECK(hm_measure(&set.view(), nullptr, 2, two, values, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "struct_size of quantity 1 is not the size of an hm_quantity; begin with HM_INIT");
}

TEST_CASE("sections") {
    CurveSet set = ring(3, 8, 1, 1);
    hm_quantity area = sized<hm_quantity>();
    area.kind = HM_AREA;
    auto const measure = [&](hm_section const& section, hm_error* e) {
        double value = 0;
        return hm_measure(&set.view(), &section, 1, &area, &value, nullptr, nullptr, e);
    };
    using S = hm_section;
    check_changes<S>(sized<S>(),
                     {{nullptr, [](S&) {}},
                      {nullptr, [](S& s) { s.n_curves = 1; }},
                      {"section.struct_size", [](S& s) { s.struct_size = 0; }},
                      {"section.first_curve is -1 and section.n_curves is 0, but the set does not "
                       "have these curves",
                       [](S& s) { s.first_curve = -1; }},
                      {"the set does not have these curves", [](S& s) { s.first_curve = 1; }},
                      {"the set does not have these curves", [](S& s) { s.n_curves = 2; }},
                      {"the set does not have these curves", [](S& s) { s.n_curves = -1; }},
                      {"an end of the chord line", [](S& s) { s.leading_x = beyond_range; }},
                      {"an end of the chord line", [](S& s) { s.leading_y = not_a_number; }},
                      {"an end of the chord line", [](S& s) { s.trailing_x = not_a_number; }},
                      {"an end of the chord line", [](S& s) { s.trailing_y = -beyond_range; }}},
                     HM_BAD_ARGUMENT, measure);
    for (std::size_t const number : {2u, 5u}) {  // an x, a y
        CurveSet far = set;
        far.control[number] = 2e50;
        hm_error error{};
        double value = 0;
        CHECK(hm_measure(&far.view(), nullptr, 1, &area, &value, nullptr, nullptr, &error) ==
              HM_BAD_CURVE);
        CHECK(says(error, "beyond 1e50"));
        CHECK(error.item == std::int32_t(number / 2));
    }
}

TEST_CASE("design variables") {
    CurveSet set = airfoil_case().curves;
    static double const peaks[] = {0.3, 0.6}, low[] = {0.3, 0}, high[] = {1, 0.6},
                        none_at_all[] = {not_a_number, 0.6};
    hm_variables box = sized<hm_variables>();
    box.kind = HM_FFD;
    box.degree_x = box.degree_y = 1;
    hm_variables cst = sized<hm_variables>(), bumps = cst, naca = cst;
    cst.kind = HM_CST;
    cst.n_upper = 2;
    bumps.kind = HM_HICKS_HENNE;
    bumps.n_upper = bumps.n_lower = 1;
    naca.kind = HM_NACA4;
    auto const size = [&](hm_variables const& variables, hm_error* e) {
        std::int32_t n = 0;
        std::size_t bytes = 0;
        return fixtures::variables_size(&set.view(), nullptr, &variables, &n, &bytes, e);
    };
    using V = hm_variables;
    check_changes<V>(
        box,
        {{nullptr, [](V&) {}},
         {"variables.struct_size", [](V& v) { v.struct_size = 0; }},
         {"variables.kind is -1, but it must be HM_FFD, HM_CST, HM_HICKS_HENNE or HM_NACA4",
          [](V& v) { v.kind = -1; }},
         {"HM_HICKS_HENNE or HM_NACA4", [](V& v) { v.kind = HM_NACA4 + 1; }},
         {nullptr, [](V& v) { v.degree_x = 63, v.degree_y = 0; }},
         {nullptr, [](V& v) { v.degree_x = 0, v.degree_y = 63; }},
         {"variables.degree_x is -1 and degree_y is 1, but each must be between 0 and 63",
          [](V& v) { v.degree_x = -1; }},
         {"degree_x is 64 and degree_y is 1", [](V& v) { v.degree_x = 64; }},
         {"degree_x is 1 and degree_y is -1", [](V& v) { v.degree_y = -1; }},
         {"degree_x is 1 and degree_y is 64", [](V& v) { v.degree_y = 64; }},
         {"variables.n_upper and n_lower must be 0 for HM_FFD", [](V& v) { v.n_upper = 1; }},
         {"n_upper and n_lower", [](V& v) { v.n_lower = 1; }},
         {"variables.peaks must be NULL unless the kind is HM_HICKS_HENNE or HM_NACA4",
          [](V& v) { v.peaks = peaks; }},
         {"leading_exponent and trailing_exponent of variables must be 0 unless the kind is HM_CST",
          [](V& v) { v.leading_exponent = 1; }},
         {"leading_exponent and trailing_exponent", [](V& v) { v.trailing_exponent = 1; }},
         {"variables.width must be 0 unless the kind is HM_HICKS_HENNE", [](V& v) { v.width = 2; }},
         {nullptr, [](V& v) { v.x_min = -1, v.x_max = 1, v.y_max = 1; }},
         {"the box of the variables is empty or not finite; x_min must be below x_max, and y_min "
          "below y_max",
          [](V& v) { v.x_min = 1; }},
         {"the box of the variables is empty", [](V& v) { v.y_min = 1; }},
         {"the box of the variables is empty", [](V& v) { v.x_max = 1; }},
         {"the box of the variables is empty", [](V& v) { v.y_max = 1; }},
         {"not finite", [](V& v) { v.x_max = beyond_range, v.y_max = 1; }},
         {"not finite", [](V& v) { v.x_min = -beyond_range, v.x_max = 1, v.y_max = 1; }},
         {"not finite", [](V& v) { v.x_max = 1, v.y_max = not_a_number; }}},
        HM_BAD_ARGUMENT, size);
    check_changes<V>(
        cst,
        {{nullptr, [](V&) {}},
         {nullptr, [](V& v) { v.n_upper = 64, v.n_lower = 64; }},
         {"variables.n_upper is 0 and n_lower is 0; each must be between 0 and 64, and their sum "
          "at least 1 (0 for HM_NACA4)",
          [](V& v) { v.n_upper = 0; }},
         {"n_upper is 65 and n_lower is 0", [](V& v) { v.n_upper = 65; }},
         {"n_upper is -1 and n_lower is 2", [](V& v) { v.n_upper = -1, v.n_lower = 2; }},
         {"n_upper is 2 and n_lower is 65", [](V& v) { v.n_lower = 65; }},
         {"n_upper is 2 and n_lower is -1", [](V& v) { v.n_lower = -1; }},
         {"degree_x, degree_y and the box of variables must be 0 unless the kind is HM_FFD",
          [](V& v) { v.degree_x = 1; }},
         {"degree_x, degree_y and the box", [](V& v) { v.degree_y = 1; }},
         {"degree_x, degree_y and the box", [](V& v) { v.x_min = 1; }},
         {"degree_x, degree_y and the box", [](V& v) { v.y_min = 1; }},
         {"degree_x, degree_y and the box", [](V& v) { v.x_max = 1; }},
         {"degree_x, degree_y and the box", [](V& v) { v.y_max = 1; }},
         {"peaks", [](V& v) { v.peaks = peaks; }},
         {nullptr, [](V& v) { v.leading_exponent = 10, v.trailing_exponent = 10; }},
         {nullptr, [](V& v) { v.trailing_exponent = 1; }},
         {"variables.leading_exponent must be between 0 and 10, not 11",
          [](V& v) { v.leading_exponent = 11; }},
         {"variables.leading_exponent must be between 0 and 10, not -1",
          [](V& v) { v.leading_exponent = -1; }},
         {"variables.trailing_exponent must be between 0 and 10, not 11",
          [](V& v) { v.trailing_exponent = 11; }},
         {"variables.trailing_exponent must be between 0 and 10, not NaN",
          [](V& v) { v.trailing_exponent = not_a_number; }}},
        HM_BAD_ARGUMENT, size);
    check_changes<V>(
        bumps,
        {{nullptr, [](V& v) { v.width = 1; }},
         {nullptr, [](V& v) { v.width = 100; }},
         {"variables.width must be 0 or between 1 and 100, not 101", [](V& v) { v.width = 101; }},
         {"1 and 100, not 5.00000e-1", [](V& v) { v.width = 0.5; }},
         {nullptr, [](V& v) { v.peaks = peaks; }},
         {"peak 1 of variables.peaks is 0, but it must lie between 0 and 1",
          [](V& v) { v.peaks = low; }},
         {"peak 0 of variables.peaks is 1", [](V& v) { v.peaks = high; }},
         {"peak 0 of variables.peaks is NaN", [](V& v) { v.peaks = none_at_all; }}},
        HM_BAD_ARGUMENT, size);
    check_changes<V>(naca,
                     {{nullptr, [](V&) {}},
                      {nullptr, [](V& v) { v.n_upper = 2, v.peaks = peaks; }},
                      {"variables.n_lower must be 0 for HM_NACA4", [](V& v) { v.n_lower = 1; }}},
                     HM_BAD_ARGUMENT, size);
}

TEST_CASE("curves: each field of the set and of a curve") {
    CurveSet set = ring(3, 8, 1, 1);
    hm_curves const& curves = set.view();
    auto const check = [](hm_curves const& all, hm_error* e) { return hm_curves_check(&all, e); };
    using C = hm_curves;
    check_changes<C>(
        curves,
        {{"n_control must be between 2 and 2^24, not 1", [](C& c) { c.n_control = 1; }},
         {"n_control must be between 2 and 2^24", [](C& c) { c.n_control = (1 << 24) + 1; }},
         {"n_curves must be between 1 and 2^24, not 0", [](C& c) { c.n_curves = 0; }},
         {"n_curves must be between 1 and 2^24", [](C& c) { c.n_curves = (1 << 24) + 1; }}},
        HM_BAD_CURVE, check);
    check_changes<C>(curves,
                     {{"curves.control or curves.curve is NULL", [](C& c) { c.control = nullptr; }},
                      {"curves.control or curves.curve is NULL", [](C& c) { c.curve = nullptr; }},
                      {"index_base", [](C& c) { c.index_base = 2; }},
                      {"index_base", [](C& c) { c.index_base = -1; }}},
                     HM_BAD_ARGUMENT, check);
    // Wherever curves are read.
    Case setup = tiny_case();
    setup.curves.add(ring(3, 8, 1, 1));
    hm_problem problem = setup.problem();
    hm_curves two = *problem.curves;
    std::vector<hm_curve> both_curves(two.curve, two.curve + 2);
    two.curve = both_curves.data();
    problem.curves = &two;
    for (bool const has_size : {false, true}) {
        if (has_size) both_curves[1].struct_size = sizeof(hm_curve), both_curves[1].knots = nullptr;
        else both_curves[1].struct_size = 0;
        std::string const text =
            has_size ? "the array of knots of curve 1 is NULL"
                     : "struct_size of curve 1 is not the size of an hm_curve; begin with HM_INIT";
        std::size_t bytes = 0;
        double at[2];
        Guarded block = block_of(fixtures::analysis_size, &problem, nullptr);
        hm_analysis* analysis = nullptr;
        hm_error error{};
        CHECK(hm_analysis_init(&analysis, fixtures::Memory(block.data(), block.size()), &problem,
                               nullptr, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        CHECK(hm_curves_check(&two, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        CHECK(hm_curve_point(&two, 1, 0.5, 0, at, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        CHECK(fixtures::refine_size(&two, 0, 0, 0, nullptr, &bytes, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        hm_quantity area = sized<hm_quantity>();
        area.kind = HM_AREA;
        CHECK(hm_measure(&two, nullptr, 1, &area, at, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
    }
}

TEST_CASE("fits and finer curves") {
    auto const size = [](hm_fit_options const& options, hm_error* e) {
        std::size_t bytes = 0;
        return fixtures::fit_size(40, &options, &bytes, e);
    };
    hm_fit_options sound = sized<hm_fit_options>();
    sound.n_control = 8;
    using F = hm_fit_options;
    check_changes<F>(sound,
                     {{nullptr, [](F&) {}},
                      {nullptr, [](F& f) { f.closed = HM_PERIODIC; }},
                      {"closed is -1", [](F& f) { f.closed = -1; }},
                      {"closed is", [](F& f) { f.closed = HM_PERIODIC + 1; }},
                      {nullptr, [](F& f) { f.index_base = 1; }},
                      {"index_base must be 0 or 1, not -1", [](F& f) { f.index_base = -1; }},
                      {"index_base must be 0 or 1, not 2", [](F& f) { f.index_base = 2; }}},
                     HM_BAD_ARGUMENT, size);
    CurveSet set = ring(3, 8, 1, 1);
    double const u = 0.3;
    std::size_t bytes = 0;
    auto const refine = [&](std::int32_t curve, std::int32_t n, const double* knots) {
        hm_error error{};
        CHECK(fixtures::refine_size(&set.view(), curve, 0, n, knots, &bytes, &error) ==
              (curve == 0 && n == 0 ? HM_OK : HM_BAD_ARGUMENT));
        return std::string(error.text);
    };
    hm_error error{};
    for (std::int32_t const degree : {3, 5}) {
        CHECK(fixtures::refine_size(&set.view(), 0, degree, 0, nullptr, &bytes, &error) ==
              HM_BAD_ARGUMENT);
        CHECK(std::string(error.text) ==
              "degree is " + std::to_string(degree) +
                  ", but a curve of degree 3 can only be raised by one degree");
    }
    CHECK(refine(0, 0, nullptr) == "");
    CHECK(refine(0, -1, &u) == "n must be between 0 and 2^24, not -1");
    CHECK(refine(0, (1 << 24) + 1, &u) == "n must be between 0 and 2^24, not 16777217");
    CHECK(refine(-1, 1, &u) == "curve -1 does not exist; curves.n_curves is 1");
    CHECK(refine(1, 1, &u) == "curve 1 does not exist; curves.n_curves is 1");
}

TEST_CASE("an edge angle where the curve stands still") {
    double const control[] = {1, 0, 1, 0, 0.5, 0.2, 0, 0, 0.5, -0.2, 1, 0};
    double const knots[] = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3};
    hm_curve const curve{sizeof curve, 3, 6, nullptr, knots};
    hm_curves curves = sized<hm_curves>();
    curves.n_control = 6;
    curves.control = control;
    curves.n_curves = 1;
    curves.curve = &curve;
    hm_quantity angle = sized<hm_quantity>();
    angle.kind = HM_TRAILING_EDGE_ANGLE;
    double value = 7;
    hm_error error{};
    CHECK(hm_measure(&curves, nullptr, 1, &angle, &value, nullptr, nullptr, &error) ==
          HM_BAD_CURVE);
    CHECK(std::string(error.text) ==
          "the angle of the trailing edge is not defined, because the derivative of the curve is 0 "
          "there");
    CHECK(value == 7);
}
