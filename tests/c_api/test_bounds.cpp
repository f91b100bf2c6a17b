// Bounds of the fields of options and of small structs: the last value inside is accepted, the first one outside is
// refused by the field's name.
#include <doctest/doctest.h>

#include <fixtures/blocks.hpp>
#include <fixtures/bodies.hpp>
#include <fixtures/parted.hpp>
#include <fixtures/spoiled_arguments.hpp>

#include <functional>
#include <limits>

using namespace fixtures;

namespace {

double const not_a_number = std::numeric_limits<double>::quiet_NaN(), beyond = 2e100;

// What one call says of a struct after a change to it. word NULL: nothing.
template <class T>
struct Change {
    const char* word;
    void (*set)(T&);
};
template <class T, class Call>
void check_changes(T const& sound, std::initializer_list<Change<T>> all, hm_status refused, Call const& call) {
    for (Change<T> const& change : all) {
        T its = sound;
        change.set(its);
        hm_error error{};
        hm_status const status = call(its, &error);
        INFO("change " << (&change - all.begin()) << ": " << error.text);
        CHECK(status == (change.word == nullptr ? HM_OK : refused));
        if (change.word != nullptr) CHECK(std::string(error.text).find(change.word) != std::string::npos);
    }
}

double const square_of_points[] = {3, 3, 4, 3, 4, 4, 3, 4};
double const bad_polygon[] = {3, 3, not_a_number, 3}, far_polygon[] = {3, 3, 4, beyond};

}  // namespace

TEST_CASE("quantities of a section") {
    CurveSet set = airfoil_case().curves;
    hm_quantity area = with_size<hm_quantity>();
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
    check_changes<Q>(area,
                     {{nullptr, [](Q&) {}},
                      {"struct_size of quantity 0", [](Q& q) { q.struct_size = 0; }},
                      {"the unknown kind -1", [](Q& q) { q.kind = -1; }},
                      {"unknown kind", [](Q& q) { q.kind = HM_CLEARANCE + 1; }},
                      {"has a station", [](Q& q) { q.station = 0.5; }},
                      {"has a polygon", [](Q& q) { q.n_polygon = 1; }}},
                     HM_BAD_ARGUMENT, measure);
    check_changes<Q>(thickness,
                     {{nullptr, [](Q&) {}},
                      {nullptr, [](Q& q) { q.station = 0.01; }},
                      {nullptr, [](Q& q) { q.station = 0.99; }},
                      {"the station is 0", [](Q& q) { q.station = 0; }},
                      {"the station is 1", [](Q& q) { q.station = 1; }},
                      {"the station is NaN", [](Q& q) { q.station = not_a_number; }}},
                     HM_BAD_ARGUMENT, measure);
    check_changes<Q>(clearance,
                     {{nullptr, [](Q&) {}},
                      {"longer than 2^20", [](Q& q) { q.n_polygon = 0; }},
                      {"longer than 2^20", [](Q& q) { q.n_polygon = (1 << 20) + 1; }},
                      {"the polygon is NULL", [](Q& q) { q.polygon = nullptr; }},
                      {"point 1 (from 0) of the polygon", [](Q& q) { q.polygon = bad_polygon; }},
                      {"point 1 (from 0) of the polygon", [](Q& q) { q.polygon = far_polygon, q.n_polygon = 2; }}},
                     HM_BAD_ARGUMENT, measure);
    hm_quantity two[] = {area, area};
    two[1].struct_size = 0;
    double values[2];
    hm_error error{};
    CHECK(hm_measure(&set.view(), nullptr, 0, two, values, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n is 0: at least one quantity is measured");
    CHECK(hm_measure(&set.view(), nullptr, 2, two, values, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "struct_size of quantity 1 (from 0) is not set");
}

TEST_CASE("sections") {
    CurveSet set = ring(3, 8, 1, 1);
    hm_quantity area = with_size<hm_quantity>();
    area.kind = HM_AREA;
    auto const measure = [&](hm_section const& section, hm_error* e) {
        double value = 0;
        return hm_measure(&set.view(), &section, 1, &area, &value, nullptr, nullptr, e);
    };
    using S = hm_section;
    check_changes<S>(with_size<S>(),
                     {{nullptr, [](S&) {}},
                      {nullptr, [](S& s) { s.n_curves = 1; }},
                      {"section.struct_size", [](S& s) { s.struct_size = 0; }},
                      {"exceed the curves of the set", [](S& s) { s.first_curve = -1; }},
                      {"exceed the curves of the set", [](S& s) { s.first_curve = 1; }},
                      {"exceed the curves of the set", [](S& s) { s.n_curves = 2; }},
                      {"exceed the curves of the set", [](S& s) { s.n_curves = -1; }},
                      {"an end of the chord line", [](S& s) { s.nose_x = beyond; }},
                      {"an end of the chord line", [](S& s) { s.nose_y = not_a_number; }},
                      {"an end of the chord line", [](S& s) { s.edge_x = not_a_number; }},
                      {"an end of the chord line", [](S& s) { s.edge_y = -beyond; }}},
                     HM_BAD_ARGUMENT, measure);
    for (std::size_t const number : {2u, 5u}) {   // an x, a y
        CurveSet far = set;
        far.control[number] = 2e50;
        hm_error error{};
        double value = 0;
        CHECK(hm_measure(&far.view(), nullptr, 1, &area, &value, nullptr, nullptr, &error) == HM_BAD_CURVE);
        CHECK(std::string(error.text).find("beyond 1e50") != std::string::npos);
        CHECK(error.item == static_cast<std::int32_t>(number / 2));
    }
}

TEST_CASE("design variables") {
    CurveSet set = airfoil_case().curves;
    static double const peaks[] = {0.3, 0.6}, low[] = {0.3, 0}, high[] = {1, 0.6}, none_at_all[] = {not_a_number, 0.6};
    hm_variables box = with_size<hm_variables>();
    box.kind = HM_FFD;
    box.degree_x = box.degree_y = 1;
    hm_variables cst = with_size<hm_variables>(), bumps = cst, naca = cst;
    cst.kind = HM_CST;
    cst.n_upper = 2;
    bumps.kind = HM_HICKS_HENNE;
    bumps.n_upper = bumps.n_lower = 1;
    naca.kind = HM_NACA4;
    auto const size = [&](hm_variables const& variables, hm_error* e) {
        std::int32_t n = 0;
        std::size_t bytes = 0;
        return hm_variables_size(&set.view(), nullptr, &variables, &n, &bytes, e);
    };
    using V = hm_variables;
    check_changes<V>(box,
                     {{nullptr, [](V&) {}},
                      {"variables.struct_size", [](V& v) { v.struct_size = 0; }},
                      {"unknown", [](V& v) { v.kind = -1; }},
                      {"unknown", [](V& v) { v.kind = HM_NACA4 + 1; }},
                      {nullptr, [](V& v) { v.degree_x = 63, v.degree_y = 0; }},
                      {nullptr, [](V& v) { v.degree_x = 0, v.degree_y = 63; }},
                      {"degree_x and degree_y are -1 and 1", [](V& v) { v.degree_x = -1; }},
                      {"degree_x and degree_y are 64 and 1", [](V& v) { v.degree_x = 64; }},
                      {"degree_x and degree_y are 1 and -1", [](V& v) { v.degree_y = -1; }},
                      {"degree_x and degree_y are 1 and 64", [](V& v) { v.degree_y = 64; }},
                      {"n_upper and n_lower", [](V& v) { v.n_upper = 1; }},
                      {"n_upper and n_lower", [](V& v) { v.n_lower = 1; }},
                      {"peaks", [](V& v) { v.peaks = peaks; }},
                      {"the exponents", [](V& v) { v.nose_exponent = 1; }},
                      {"the exponents", [](V& v) { v.edge_exponent = 1; }},
                      {"the width", [](V& v) { v.width = 2; }},
                      {nullptr, [](V& v) { v.x_min = -1, v.x_max = 1, v.y_max = 1; }},
                      {"the box is empty", [](V& v) { v.x_min = 1; }},
                      {"the box is empty", [](V& v) { v.y_min = 1; }},
                      {"the box is empty", [](V& v) { v.x_max = 1; }},
                      {"the box is empty", [](V& v) { v.y_max = 1; }},
                      {"not finite", [](V& v) { v.x_max = beyond, v.y_max = 1; }},
                      {"not finite", [](V& v) { v.x_min = -beyond, v.x_max = 1, v.y_max = 1; }},
                      {"not finite", [](V& v) { v.x_max = 1, v.y_max = not_a_number; }}},
                     HM_BAD_ARGUMENT, size);
    check_changes<V>(cst,
                     {{nullptr, [](V&) {}},
                      {nullptr, [](V& v) { v.n_upper = 64, v.n_lower = 64; }},
                      {"n_upper and n_lower are 0 and 0", [](V& v) { v.n_upper = 0; }},
                      {"n_upper and n_lower are 65 and 0", [](V& v) { v.n_upper = 65; }},
                      {"n_upper and n_lower are -1 and 2", [](V& v) { v.n_upper = -1, v.n_lower = 2; }},
                      {"n_upper and n_lower are 2 and 65", [](V& v) { v.n_lower = 65; }},
                      {"n_upper and n_lower are 2 and -1", [](V& v) { v.n_lower = -1; }},
                      {"degrees and box", [](V& v) { v.degree_x = 1; }},
                      {"degrees and box", [](V& v) { v.degree_y = 1; }},
                      {"degrees and box", [](V& v) { v.x_min = 1; }},
                      {"degrees and box", [](V& v) { v.y_min = 1; }},
                      {"degrees and box", [](V& v) { v.x_max = 1; }},
                      {"degrees and box", [](V& v) { v.y_max = 1; }},
                      {"peaks", [](V& v) { v.peaks = peaks; }},
                      {nullptr, [](V& v) { v.nose_exponent = 10, v.edge_exponent = 10; }},
                      {nullptr, [](V& v) { v.edge_exponent = 1; }},
                      {"nose_exponent is 11", [](V& v) { v.nose_exponent = 11; }},
                      {"nose_exponent is -1", [](V& v) { v.nose_exponent = -1; }},
                      {"edge_exponent is 11", [](V& v) { v.edge_exponent = 11; }},
                      {"edge_exponent is NaN", [](V& v) { v.edge_exponent = not_a_number; }}},
                     HM_BAD_ARGUMENT, size);
    check_changes<V>(bumps,
                     {{nullptr, [](V& v) { v.width = 1; }},
                      {nullptr, [](V& v) { v.width = 100; }},
                      {"the width is 101", [](V& v) { v.width = 101; }},
                      {"the width is 5.00000e-1", [](V& v) { v.width = 0.5; }},
                      {nullptr, [](V& v) { v.peaks = peaks; }},
                      {"peak 1 (from 0) is 0", [](V& v) { v.peaks = low; }},
                      {"peak 0 (from 0) is 1", [](V& v) { v.peaks = high; }},
                      {"peak 0 (from 0) is NaN", [](V& v) { v.peaks = none_at_all; }}},
                     HM_BAD_ARGUMENT, size);
    check_changes<V>(naca,
                     {{nullptr, [](V&) {}},
                      {nullptr, [](V& v) { v.n_upper = 2, v.peaks = peaks; }},
                      {"n_lower is not of HM_NACA4", [](V& v) { v.n_lower = 1; }}},
                     HM_BAD_ARGUMENT, size);
}

TEST_CASE("curves: each field of the set and of a curve") {
    CurveSet set = ring(3, 8, 1, 1);
    hm_curves const& curves = set.view();
    auto const check = [](hm_curves const& its, hm_error* e) { return hm_curves_check(&its, e); };
    using C = hm_curves;
    check_changes<C>(curves,
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
    Case its = tiny_case();
    its.curves.add(ring(3, 8, 1, 1));
    hm_problem problem = its.problem();
    hm_curves two = *problem.curves;
    std::vector<hm_curve> its_curves(two.curve, two.curve + 2);
    two.curve = its_curves.data();
    problem.curves = &two;
    for (bool const has_size : {false, true}) {
        if (has_size) its_curves[1].struct_size = sizeof(hm_curve), its_curves[1].knots = nullptr;
        else its_curves[1].struct_size = 0;
        std::string const text = has_size ? "knots of curve 1 (from 0) is NULL" : "struct_size of curve 1 (from 0) is not set";
        std::size_t bytes = 0;
        double at[2];
        REQUIRE(hm_analysis_size(&problem, nullptr, &bytes, nullptr) == HM_OK);
        Guarded block(bytes);
        hm_analysis* analysis = nullptr;
        hm_error error{};
        CHECK(hm_analysis_init(&analysis, block.data(), bytes, &problem, nullptr, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        CHECK(hm_curves_check(&two, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        CHECK(hm_curve_point(&two, 1, 0.5, 0, at, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        CHECK(hm_elevate_size(&two, 0, &bytes, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
        hm_quantity area = with_size<hm_quantity>();
        area.kind = HM_AREA;
        CHECK(hm_measure(&two, nullptr, 1, &area, at, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
        CHECK(error.text == text);
    }
}

TEST_CASE("conditions and given parameters") {
    Case its = tiny_case();
    auto const size = [&](hm_condition const& condition, hm_error* e) {
        hm_problem problem = its.problem();
        problem.conditions = &condition;
        std::size_t bytes = 0;
        return hm_analysis_size(&problem, nullptr, &bytes, e);
    };
    using C = hm_condition;
    check_changes<C>(its.conditions[0],
                     {{nullptr, [](C&) {}},
                      {nullptr, [](C& c) { c.piece = 1; }},
                      {nullptr, [](C& c) { c.piece = 1, c.near_x = 3; }},
                      {"a piece that is neither 0 nor 1", [](C& c) { c.piece = -1; }},
                      {"a piece that is neither 0 nor 1", [](C& c) { c.piece = 2; }},
                      {"reserved is not 0", [](C& c) { c.reserved = 1; }},
                      {"chooses no piece", [](C& c) { c.near_x = 1; }},
                      {"chooses no piece", [](C& c) { c.near_y = 1; }},
                      {"has body", [](C& c) { c.body = 1; }},
                      {"has x or y", [](C& c) { c.x = 1; }},
                      {"has x or y", [](C& c) { c.y = 1; }},
                      {"has partner", [](C& c) { c.partner = 1; }},
                      {"first_curve or n_curves", [](C& c) { c.kind = HM_SLIP, c.n_curves = 0, c.first_curve = 1; }},
                      {"a periodic pair cannot", [](C& c) { c.kind = HM_PERIODIC_PAIR, c.n_curves = 0, c.piece = 1; }},
                      {"rigid body -1", [](C& c) { c.kind = HM_RIGID, c.n_curves = 0, c.body = -1; }},
                      {"rigid body 1048576", [](C& c) { c.kind = HM_RIGID, c.n_curves = 0, c.body = 1 << 20; }},
                      {"near_x or near_y", [](C& c) { c.piece = 1, c.near_y = beyond; }}},
                     HM_BAD_CONDITION, size);
    check_changes<C>(its.conditions[0],
                     {{"struct_size of condition 0", [](C& c) { c.struct_size = 0; }},
                      {"the unknown kind -1", [](C& c) { c.kind = -1; }},
                      {"the unknown kind", [](C& c) { c.kind = HM_ROTATION_PAIR + 1; }}},
                     HM_BAD_ARGUMENT, size);
    its.give(16, 0.5);
    auto const size_of = [](hm_problem const& problem, hm_error* e) {
        std::size_t bytes = 0;
        return hm_analysis_size(&problem, nullptr, &bytes, e);
    };
    using P = hm_problem;
    check_changes<P>(its.problem(),
                     {{nullptr, [](P&) {}},
                      {"problem.struct_size", [](P& p) { p.struct_size = 0; }},
                      {"given parameters", [](P& p) { p.n_given = -1; }},
                      {"given parameters", [](P& p) { p.given_points = nullptr; }},
                      {"given parameters", [](P& p) { p.given_curves = nullptr; }},
                      {"given parameters", [](P& p) { p.given_u = nullptr; }},
                      {"n_conditions is negative, or conditions is NULL", [](P& p) { p.n_conditions = -1; }},
                      {"n_conditions is negative, or conditions is NULL", [](P& p) { p.conditions = nullptr; }}},
                     HM_BAD_ARGUMENT, size_of);
}

TEST_CASE("fits and finer curves") {
    auto const size = [](hm_fit_options const& options, hm_error* e) {
        std::size_t bytes = 0;
        return hm_fit_size(40, &options, &bytes, e);
    };
    hm_fit_options sound = with_size<hm_fit_options>();
    sound.n_control = 8;
    using F = hm_fit_options;
    check_changes<F>(sound,
                     {{nullptr, [](F&) {}},
                      {nullptr, [](F& f) { f.closed = HM_PERIODIC; }},
                      {"closed is -1", [](F& f) { f.closed = -1; }},
                      {"closed is", [](F& f) { f.closed = HM_PERIODIC + 1; }},
                      {"reserved must be 0", [](F& f) { f.reserved = 1; }}},
                     HM_BAD_ARGUMENT, size);
    CurveSet set = ring(3, 8, 1, 1);
    double const u = 0.3;
    std::size_t bytes = 0;
    auto const refine = [&](std::int32_t curve, std::int32_t n, const double* knots) {
        hm_error error{};
        CHECK(hm_refine_size(&set.view(), curve, n, knots, &bytes, &error) == (curve == 0 && n == 0 ? HM_OK : HM_BAD_ARGUMENT));
        return std::string(error.text);
    };
    CHECK(refine(0, 0, nullptr) == "");
    CHECK(refine(0, -1, &u) == "n must be between 0 and 2^24, not -1");
    CHECK(refine(0, (1 << 24) + 1, &u) == "n must be between 0 and 2^24, not 16777217");
    CHECK(refine(-1, 1, &u) == "there is no curve -1 (from 0); the set has 1");
    CHECK(refine(1, 1, &u) == "there is no curve 1 (from 0); the set has 1");
}

TEST_CASE("blocks, and the distances between their points") {
    Blocks const blocks = o_blocks(3, 4, 2, 1, 3);   // 5 x 3 points each, every second one turned
    hm_mesh const mesh = blocks.view();
    std::vector<double> x(blocks.x.size()), y = x;
    hm_points const from{blocks.x.data(), blocks.y.data(), 1};
    auto const scatter = [&](hm_block_points_out const& block, hm_error* e) {
        return hm_blocks_scatter(&mesh, 0, 1, &from, &block, e);
    };
    hm_block_points_out const sound{x.data(), y.data(), 1, 0};
    using B = hm_block_points_out;
    check_changes<B>(sound,
                     {{nullptr, [](B&) {}},
                      {nullptr, [](B& b) { b.row = 5; }},
                      {nullptr, [](B& b) { b.stride = 3, b.row = 1; }},
                      {"stride or row of block 0", [](B& b) { b.row = 4; }},
                      {"stride or row of block 0", [](B& b) { b.stride = 2, b.row = 1; }},
                      {"stride or row of block 0", [](B& b) { b.stride = -1; }},
                      {"stride or row of block 0", [](B& b) { b.row = -1; }},
                      {"stride or row of block 0", [](B& b) { b.stride = (std::int64_t{1} << 40) + 1; }},
                      {"stride or row of block 0", [](B& b) { b.row = (std::int64_t{1} << 40) + 1; }},
                      {"x or y of block 0", [](B& b) { b.x = nullptr; }},
                      {"x or y of block 0", [](B& b) { b.y = nullptr; }}},
                     HM_BAD_ARGUMENT, scatter);
    hm_block_points_out all[6] = {sound, sound, sound, sound, sound, sound};
    struct {
        std::int32_t first, n;
        bool exists;
    } const ranges[] = {{0, 6, true}, {5, 1, true}, {0, 0, false}, {0, 7, false}, {6, 1, false}, {-1, 1, false}};
    for (auto const& range : ranges) {
        hm_error error{};
        hm_status const status = hm_blocks_scatter(&mesh, range.first, range.n, &from, all, &error);
        INFO(range.first << " " << range.n << ": " << error.text);
        CHECK(status == (range.exists ? HM_OK : HM_BAD_ARGUMENT));
    }
    std::vector<std::int32_t> sizes = blocks.sizes;
    hm_mesh flat = mesh;
    flat.block_sizes = sizes.data();
    hm_problem problem = with_size<hm_problem>();
    problem.mesh = &flat;
    std::size_t bytes = 0;
    for (std::int32_t const size : {1, 1 << 30}) {   // no cells, too many
        sizes[2] = sizes[3] = size;
        CHECK(hm_analysis_size(&problem, nullptr, &bytes, nullptr) == HM_BAD_MESH);
    }
}

TEST_CASE("safe morphs and better cells") {
    Case its = tiny_case();
    Solved const solved(its);
    std::vector<double> x = its.mesh.x, y = its.mesh.y, move(8, 0.0);
    hm_points_out const to{x.data(), y.data(), 1};
    std::size_t bytes = 0;
    REQUIRE(hm_morph_safe_size(solved.plan, solved.basis, &bytes, nullptr) == HM_OK);
    Guarded work(bytes);
    auto const morph = [&](hm_safe_options const& options, hm_error* e) {
        return hm_morph_safe(solved.plan, solved.basis, move.data(), &to, nullptr, work.data(), bytes, &options, nullptr, e);
    };
    using S = hm_safe_options;
    check_changes<S>(with_size<S>(),
                     {{nullptr, [](S&) {}},
                      {nullptr, [](S& s) { s.skipped_strategies = (2 << HM_STRATEGY_IMPROVED) - 1 - 1; }},
                      {nullptr, [](S& s) { s.max_resolves = -1; }},
                      {nullptr, [](S& s) { s.heights = 1, s.min_quality = 1; }},
                      {nullptr, [](S& s) { s.min_quality = -1; }},
                      {nullptr, [](S& s) { s.max_height_change = 1.001; }},
                      {"skipped_strategies is -1", [](S& s) { s.skipped_strategies = -1; }},
                      {"skipped_strategies is", [](S& s) { s.skipped_strategies = 2 << HM_STRATEGY_IMPROVED; }},
                      {"reserved is not 0", [](S& s) { s.reserved = 1; }},
                      {"max_height_change", [](S& s) { s.max_height_change = -1; }}},
                     HM_BAD_ARGUMENT, morph);
    hm_error error{};
    CHECK(hm_morph_safe(solved.plan, solved.basis, move.data(), &to, solved.basis, work.data(), bytes, nullptr, nullptr,
                        &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "derivative is the basis itself");

    // Some of the functions cannot move the mesh, nor be the derivative of its movement.
    hm_basis *share = nullptr, *rest = nullptr;
    REQUIRE(hm_share_size(solved.analysis, 0, 2, &bytes, nullptr) == HM_OK);
    Guarded block(bytes), other(bytes);
    REQUIRE(hm_share_init(&share, block.data(), bytes, solved.analysis, 0, 2, nullptr) == HM_OK);
    REQUIRE(hm_share_init(&rest, other.data(), bytes, solved.analysis, 2, 2, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(solved.plan, share, nullptr, nullptr) == HM_OK);
    struct {
        hm_basis *basis, *derivative;
    } const pairs[] = {{share, nullptr}, {solved.basis, rest}};
    for (auto const& pair : pairs) {
        CHECK(hm_morph_safe(solved.plan, pair.basis, move.data(), &to, pair.derivative, work.data(), work.size(), nullptr,
                            nullptr, &error) == HM_BAD_BASIS);
        CHECK(std::string(error.text) == "a share of the functions cannot move the mesh: all of them are needed");
    }
    CHECK(x == its.mesh.x);
}

TEST_CASE("two cells of a part on one side of an edge") {
    Mesh mesh;
    for (Point const p : {Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 2}}) mesh.add_point(p);
    mesh.add_cell({0, 1, 2});
    mesh.add_cell({0, 1, 3});
    std::vector<std::int64_t> const numbers = {10, 11, 12, 13};
    hm_mesh const view = mesh.view();
    hm_part_mesh part = with_size<hm_part_mesh>();
    part.mesh = &view;
    part.numbers = numbers.data();
    std::size_t bytes = 0;
    REQUIRE(hm_part_size(&part, &bytes, nullptr) == HM_OK);
    Guarded block(bytes);
    hm_part* made = nullptr;
    hm_error error{};
    CHECK(hm_part_init(&made, block.data(), bytes, &part, &error) == HM_BAD_MESH);
    CHECK(std::string(error.text) == "the cells on both sides of the edge between points 0 and 1 overlap");
}

TEST_CASE("an edge angle where the curve stands still") {
    double const control[] = {1, 0, 1, 0, 0.5, 0.2, 0, 0, 0.5, -0.2, 1, 0};
    double const knots[] = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3};
    hm_curve const curve{sizeof curve, 3, 6, nullptr, knots};
    hm_curves curves = with_size<hm_curves>();
    curves.n_control = 6;
    curves.control = control;
    curves.n_curves = 1;
    curves.curve = &curve;
    hm_quantity angle = with_size<hm_quantity>();
    angle.kind = HM_EDGE_ANGLE;
    double value = 7;
    hm_error error{};
    CHECK(hm_measure(&curves, nullptr, 1, &angle, &value, nullptr, nullptr, &error) == HM_BAD_CURVE);
    CHECK(std::string(error.text) == "the trailing edge has no directions: the curve stands still at its ends");
    CHECK(value == 7);
}

TEST_CASE("columns and unknowns of a part's equations") {
    Case its = tiny_case();
    hm_options const options = laplace();
    Parted parted(cut(its.mesh, stripes(its.mesh, 1), false));
    REQUIRE(parted.match());
    REQUIRE(parted.equate(its.problem(), options));
    hm_equations* const equations = parted.parts[0].equations;
    hm_equations_info const& info = parted.parts[0].info();
    hm_part* const part = parted.parts[0].part;
    std::int32_t const n_edges = static_cast<std::int32_t>(parted.edges.size());
    std::size_t bytes = 0;
    REQUIRE(hm_rows_size(equations, &bytes, nullptr) == HM_OK);
    Guarded block(bytes);
    hm_basis* rows = nullptr;
    REQUIRE(hm_rows_init(&rows, block.data(), bytes, equations, nullptr) == HM_OK);
    std::vector<double> numbers(1000, 0.0);
    std::int64_t n = 0;
    hm_error error{};
    auto const says = [&](hm_status status, std::string const& text) {
        CHECK(status < 0);
        CHECK(error.text == text);
    };
    for (std::int32_t const column : {-1, info.columns})
        says(hm_rows_get(equations, rows, column, numbers.data(), &error),
             "there is no column " + std::to_string(column) + " (from 0) of " + std::to_string(info.columns));
    CHECK(hm_rows_get(equations, rows, info.columns - 1, numbers.data(), &error) == HM_OK);
    for (double const largest : {-1.0, not_a_number, HUGE_VAL}) {
        CHECK(hm_rows_finish(equations, rows, largest, &error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text).find("largest must be finite and not negative") == 0);
    }
    struct {
        std::int32_t first, n;
    } const outside[] = {{-1, 1}, {0, -1}, {0, info.unknowns + 1}, {info.unknowns, 1}};
    for (auto const& range : outside) {
        says(hm_equations_entries(equations, range.first, range.n, nullptr, nullptr, nullptr, 0, &n, &error),
             "from unknown " + std::to_string(range.first) + " (from 0) on there are no " + std::to_string(range.n) +
                 " unknowns");
    }
    CHECK(hm_equations_entries(equations, info.unknowns, 0, nullptr, nullptr, nullptr, 0, &n, &error) == HM_OK);
    CHECK(n == 0);

    Case other = tiny_case();
    other.conditions[0] = hm_condition{};
    other.conditions[0].struct_size = sizeof(hm_condition);
    other.conditions[0].marker = body;
    other.conditions[0].kind = HM_FIXED;
    other.curves = {};
    hm_problem problem = other.problem();
    problem.mesh = nullptr;
    says(hm_equations_size(part, n_edges, &problem, &options, &bytes, &error),
         "there are no curves, no rigid bodies and no given displacements");
    problem = its.problem();
    problem.mesh = nullptr;
    for (std::int32_t const count : {-1, (1 << 29) + 1})
        says(hm_equations_size(part, count, &problem, &options, &bytes, &error),
             "n_edges must be between 0 and 2^29, not " + std::to_string(count));
    REQUIRE(hm_rows_finish(equations, rows, 1, &error) == HM_OK);
    says(hm_rows_get(equations, rows, 0, numbers.data(), &error), "the rows are finished: make new ones by hm_rows_init");
    Solved const whole(its, &options);
    says(hm_rows_get(equations, whole.basis, 0, numbers.data(), &error), "the rows are finished: make new ones by hm_rows_init");
    Case two = two_body_case(Cells::hybrid, 4, 3);
    Solved const elsewhere(two, &options);
    says(hm_rows_get(equations, elsewhere.basis, 0, numbers.data(), &error), "the rows were made of other equations");

    hm_part_mesh nobody = with_size<hm_part_mesh>();
    hm_mesh const mesh = parted.parts[0].mesh.view();
    nobody.mesh = &mesh;
    says(hm_part_size(&nobody, &bytes, &error), "part.numbers is NULL");
    nobody.numbers = parted.parts[0].numbers.data();
    nobody.mesh = nullptr;
    says(hm_part_size(&nobody, &bytes, &error), "mesh is NULL");
    n = -1;
    hm_edge edge{};
    says(hm_match_edges(&edge, &n, &error), "the number of edges is negative");
    n = 0;
    CHECK(hm_match_edges(nullptr, &n, &error) == HM_OK);
}

TEST_CASE("levels of a plan") {
    Case its = two_body_case(Cells::quads, 8, 6);
    hm_options options = laplace();
    options.engine = HM_MULTIGRID;
    Solved const solved(its, &options);
    std::vector<std::int32_t> cells(its.mesh.x.size());
    std::int32_t n = 0;
    std::int32_t const levels = solved.report.levels;
    REQUIRE(levels > 0);
    for (std::int32_t const level : {-1, levels + 1}) {
        hm_error error{};
        CHECK(hm_plan_level(solved.plan, level, cells.data(), &n, &error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text).find("there is no level " + std::to_string(level) + " (from 0): the plan has ") == 0);
    }
    check_arguments("plan, -, cells, n_cells", hm_plan_level, solved.plan, 0, cells.data(), &n);
}

TEST_CASE("what else a call finds wrong in its numbers") {
    Case its = tiny_case();
    Solved const solved(its);
    CurveSet set = airfoil_case().curves;
    std::size_t bytes = 0;
    std::vector<double> values(1000, 0.0), x(48, 0.0), y = x;
    std::vector<std::int32_t> control(8);
    hm_error error{};
    hm_points const points{x.data(), y.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    auto const says = [&](hm_status status, hm_status expected, const char* text) {
        INFO(error.text);
        CHECK(status == expected);
        CHECK(std::string(error.text).find(text) != std::string::npos);
    };
    for (double const u : {not_a_number, HUGE_VAL})
        says(hm_curve_basis(&set.view(), 0, u, 0, control.data(), values.data(), &error), HM_BAD_ARGUMENT, "u");
    says(hm_curve_basis(&set.view(), 0, 0.5, -1, control.data(), values.data(), &error), HM_BAD_ARGUMENT, "derivatives");
    hm_fit_options few = with_size<hm_fit_options>();
    few.n_control = 1;
    const hm_curves* fitted = nullptr;
    says(hm_fit(&fitted, values.data(), 8000, &points, 40, 0, &few, nullptr, &error), HM_BAD_CURVE, "are not enough");

    // Reports and arrays that are not wanted.
    REQUIRE(hm_elevate_size(&set.view(), 0, &bytes, nullptr) == HM_OK);
    Guarded elevated(bytes);
    CHECK(hm_elevate(&fitted, nullptr, elevated.data(), bytes, &set.view(), 0, &error) == HM_OK);
    hm_variables naca = with_size<hm_variables>();
    naca.kind = HM_NACA4;
    std::int32_t n = 0;
    REQUIRE(hm_variables_size(&set.view(), nullptr, &naca, &n, &bytes, nullptr) == HM_OK);
    Guarded work(bytes);
    CHECK(hm_variables_map(&set.view(), nullptr, &naca, work.data(), bytes, values.data(), nullptr, &error) == HM_OK);
    // A chord that ends at the origin is a chord.
    hm_section chord = with_size<hm_section>();
    chord.edge_y = -1;
    CHECK(hm_variables_map(&set.view(), &chord, &naca, work.data(), bytes, values.data(), nullptr, &error) == HM_OK);
    chord.edge_y = 0, chord.nose_y = -1;
    CHECK(hm_variables_map(&set.view(), &chord, &naca, work.data(), bytes, values.data(), nullptr, &error) == HM_OK);

    std::int32_t const point = 0;
    says(hm_extract_size(solved.basis, -1, &bytes, &error), HM_BAD_ARGUMENT, "-1");
    hm_basis* rows = nullptr;
    says(hm_extract_init(&rows, values.data(), 8000, solved.basis, -1, &point, &error), HM_BAD_ARGUMENT, "-1");
    says(hm_parcel_pack(solved.basis, -1, &point, values.data(), &error), HM_BAD_ARGUMENT, "-1");

    hm_mesh broken = its.mesh_view();
    broken.cell_points = nullptr;
    hm_quality_report quality = with_size<hm_quality_report>();
    says(hm_quality(solved.basis, &broken, nullptr, nullptr, nullptr, &quality, &error), HM_BAD_ARGUMENT, "cell_points");

    hm_improve_options improve = with_size<hm_improve_options>();
    hm_points const no_y{x.data(), nullptr, 1};
    improve.reference = &no_y;
    REQUIRE(hm_improve_size(solved.plan, &bytes, nullptr) == HM_OK);
    Guarded room(bytes);
    says(hm_improve(solved.plan, &points, &to, room.data(), bytes, &improve, nullptr, &error), HM_BAD_ARGUMENT,
         "reference.x or reference.y is NULL");
}

TEST_CASE("a given displacement whose target is out of range") {
    Case its = given_instead(tiny_case());
    Displaced displaced(its);
    std::int32_t const n = static_cast<std::int32_t>(displaced.points.size());
    std::vector<double> far(its.mesh.x.size(), 6e99), x = its.mesh.x, y = its.mesh.y;
    hm_points const all{far.data(), far.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    Guarded work = displaced.work_for(1);
    hm_error error{};
    CHECK(hm_displace(displaced.plan, n, nullptr, 1, &all, &all, &to, work.data(), work.size(), nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text).find("the target of point ") == 0);
    CHECK(std::string(error.text).find("in field 0 (from 0) is beyond 1e100") != std::string::npos);
    CHECK(x == its.mesh.x);
}

TEST_CASE("rigid bodies are numbered without a gap") {
    for (std::int32_t const second : {1, 2}) {
        Case its = two_body_case(Cells::hybrid, 4, 3);
        its.conditions.clear();
        its.curves = {};
        its.set_rigid(body, 0.5, 0.5, 0);
        its.set_rigid(second_body, 1.5, 0.5, second);
        Attempt const attempt(its.problem());
        CHECK(attempt.status == (second == 1 ? HM_OK : HM_BAD_CONDITION));
        if (second == 1) continue;
        CHECK(std::string(attempt.error.text) ==
              "condition 1 (from 0) names rigid body 2 (from 0), but not all before it are there");
    }
}

TEST_CASE("numbers in sentences: integers below 1e15 with all their digits, others with six") {
    Case its = tiny_case();
    struct {
        double value;
        const char* words;
    } const all[] = {{1, "not 1"}, {999999999999999, "not 999999999999999"}, {1e15, "not 1.00000e15"},
                     {-999999999999999, "not -999999999999999"}, {-1e15, "not -1.00000e15"}, {1.5, "not 1.50000"}};
    for (auto const& one : all) {
        hm_options options = laplace();
        options.tolerance = one.value;
        Attempt const attempt(its.problem(), &options);
        INFO(attempt.error.text);
        CHECK(attempt.status == HM_BAD_ARGUMENT);
        CHECK(std::string(attempt.error.text).find(one.words) != std::string::npos);
    }
}

TEST_CASE("curvature of a curve with a cusp inside a span") {
    double const control[] = {0, 0, 1, 1, 0, 1, 1, 0}, knots[] = {0, 0, 0, 0, 1, 1, 1, 1};   // C'(1/2) = 0
    hm_curve const curve{sizeof curve, 3, 4, nullptr, knots};
    hm_curves curves = with_size<hm_curves>();
    curves.n_control = 4;
    curves.control = control;
    curves.n_curves = 1;
    curves.curve = &curve;
    hm_quantity least = with_size<hm_quantity>();
    least.kind = HM_MIN_RADIUS;
    double value = 7;
    hm_error error{};
    CHECK(hm_measure(&curves, nullptr, 1, &least, &value, nullptr, nullptr, &error) == HM_BAD_CURVE);
    CHECK(std::string(error.text).find("stands still at parameter 5.00000e-1") != std::string::npos);
}
