// Every point of a curve's marker gets the right curve and parameter.
#include <fixtures/core.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

// Inner points of an annulus put onto a curve at given parameters.
Case on_curve(Spline const& spline, int n_t) {
    Case out = ring_case(6, n_t, 0.5, 2, Cells::quads, spline.degree);
    out.curves = spline;
    out.known_points.clear();
    out.known_curves.clear();
    out.known_u.clear();
    return out;
}

std::map<std::int32_t, std::pair<std::int32_t, double>> parameters(Solved const& solved) {
    std::map<std::int32_t, std::pair<std::int32_t, double>> out;
    hm_basis_info const info = solved.info();
    for (std::int32_t k = 0; k < info.curve_points; ++k)
        out[info.curve_point[k]] = {info.point_curve[k], info.point_u[k]};
    CHECK(out.size() == std::size_t(info.curve_points));  // every point once
    return out;
}

}  // namespace

TEST_CASE("parameters are found where points lie on the curve, from any start") {
    for (int const degree : {2, 3, 5})
        for (bool const against : {false, true}) {
            Spline spline = ring(degree, 9, 0.55, 0.5, 0, 0, 0.3);
            if (against)  // the curve runs against the boundary
                for (std::size_t k = 1; k < spline.control.size(); k += 2) spline.control[k] *= -1;
            int const n_t = 40;
            Case setup = on_curve(spline, n_t);
            std::vector<double> expected;
            for (int k = 0; k < n_t; ++k) {
                double const u = std::fmod(9.0 * ((against ? n_t - k : k) + 0.3) / n_t, 9.0);
                harmorph::Vec2 const p = curve_point(spline.curve(), u);
                setup.mesh.x[std::size_t(k)] = p.x;
                setup.mesh.y[std::size_t(k)] = p.y;
                expected.push_back(u);
            }
            // Turn the rings behind it so that cells stay valid.
            double const turn = std::atan2(setup.mesh.y[0], setup.mesh.x[0]);
            for (std::size_t k = std::size_t(n_t); k < setup.mesh.x.size(); ++k) {
                double const x = setup.mesh.x[k], y = setup.mesh.y[k];
                setup.mesh.x[k] = 1.3 * (x * std::cos(turn) - y * std::sin(turn));
                setup.mesh.y[k] = 1.3 * (x * std::sin(turn) + y * std::cos(turn));
            }
            Solved const solved(setup);
            CHECK(solved.report.max_distance < 1e-13);
            auto const found = parameters(solved);
            REQUIRE(found.size() == 40);
            for (int k = 0; k < n_t; ++k)
                CHECK(std::fabs(found.at(k).second - expected[std::size_t(k)]) < 1e-10);
        }
}

TEST_CASE("given parameters are taken unchanged, and the others are found") {
    Case setup = tiny_case();
    setup.give(16, 0.125);  // wrong on purpose
    setup.give(24, 1.75);
    Solved const solved(setup);
    auto const found = parameters(solved);
    CHECK(found.at(16).second == 0.125);
    CHECK(found.at(24).second == 1.75);
    CHECK(found.at(17).second == doctest::Approx(0.5));
    CHECK(found.at(18).second == doctest::Approx(1));
    CHECK(solved.values(0)[16] == 0.875);
    CHECK(solved.report.max_distance == doctest::Approx(0.5));  // (4, 3) is said to be (4, 3.5)
    CHECK(solved.report.max_distance_point == 24);
}

TEST_CASE("the point at the corner of a tied curve has exactly the corner's function") {
    for (std::int32_t const start : {0, 1, 2, 3}) {  // the curve may begin at any corner
        Case setup = tiny_case();
        std::vector<Point> const corners = {{2, 2}, {4, 2}, {4, 4}, {2, 4}};
        std::vector<Point> turned;
        for (std::int32_t k = 0; k < 4; ++k)
            turned.push_back(corners[std::size_t((k + start) % 4)]);
        setup.curves = polyline(turned);
        Solved const solved(setup);
        std::size_t const ids[] = {16, 18, 31, 29};
        for (std::int32_t k = 0; k < 4; ++k) {
            std::vector<double> const f = solved.values(k);
            for (std::int32_t j = 0; j < 4; ++j) CHECK(f[ids[j]] == (j == (k + start) % 4 ? 1 : 0));
        }
        CHECK(solved.report.max_distance < 1e-15);
    }
}

TEST_CASE("points of a blunt base are on the second curve, and the ends belong to both curves") {
    Naca4 naca;
    naca.blunt = true;
    Outline const outline = naca4(naca, 40);  // four edges on the base
    auto options = sized<hm_fit_options>();
    auto report = sized<hm_fit_report>();
    std::int32_t const n = std::int32_t(outline.points.size());
    Guarded block = block_of(fixtures::fit_size, n, &options);
    const hm_curves* curves = nullptr;
    REQUIRE(hm_fit(&curves, fixtures::Memory(block.data(), block.size()),
                   points_in(&outline.points[0].x, &outline.points[0].y, 2), n, 1, &options,
                   &report, nullptr) == HM_OK);
    REQUIRE(curves->n_curves == 2);
    REQUIRE(report.base_points == 5);

    Case setup;
    setup.mesh = o_mesh(outline, stretched(2e-3, 10, 25));
    setup.put_on_curves(body, 0, 2);
    hm_mesh const mesh = setup.mesh.view();
    hm_problem problem = setup.problem(mesh);
    problem.curves = curves;
    Solved const solved(problem);
    auto const found = parameters(solved);
    for (std::int32_t k = 0; k < n; ++k) {
        bool const inside_base = k >= 1 && k <= 3, corner = k == 0 || k == 4;
        INFO("point " << k);
        if (!corner) CHECK(found.at(k).first == (inside_base ? 1 : 0));
    }
    CHECK(solved.report.max_distance == doctest::Approx(report.max_error).epsilon(0.05));
    CHECK(solved.report.partition_defect < 1e-14);
    // Each corner has the function of one control point alone, and the base is linear between the
    // two.
    std::vector<double> move(2 * std::size_t(curves->n_control), 0.0);
    for (std::int32_t i = 0; i < curves->n_control; ++i) {
        std::vector<double> const f = solved.values(i);
        CHECK((f[0] == 0 || f[0] == 1));
        CHECK((f[4] == 0 || f[4] == 1));
        for (std::size_t k = 1; k <= 3; ++k)
            CHECK(f[k] == doctest::Approx(f[0] + (f[4] - f[0]) * double(k) / 4).epsilon(1e-9));
    }
}

TEST_CASE("several bodies on one marker find one curve each") {
    Case two = two_body_case(), one = two;
    for (std::int32_t& marker : one.mesh.face_markers)
        marker = marker == second_body ? body : marker;
    one.conditions.clear();
    one.put_on_curves(body, 0, 2);
    Solved const a(two), b(one);
    CHECK(parameters(a) == parameters(b));
    CHECK(same_bits(a.all_values(), b.all_values()));
}

TEST_CASE("one body on several markers with one curve is solved as on one marker") {
    Case whole = airfoil_case(), split = whole;
    split_marker(split.mesh, body, 4, 31);
    split.conditions.clear();
    for (std::int32_t const marker : {33, 31, 34, 32}) split.put_on_curves(marker);
    Solved const a(whole), b(split);
    auto const expected = parameters(a), found = parameters(b);
    REQUIRE(found.size() == expected.size());
    for (auto const& [point, parameter] : expected)
        CHECK(std::fabs(found.at(point).second - parameter.second) < 1e-12);
}

TEST_CASE("points that two markers share belong to the control point that their curves share") {
    // The hole's lower side on one curve, the other three on another; the ends are common control
    // points.
    Case setup = tiny_case();
    for (std::size_t k = 0; k < setup.mesh.face_markers.size(); ++k) {
        bool const low = setup.mesh.y[std::size_t(setup.mesh.faces[2 * k])] == 2 &&
                         setup.mesh.y[std::size_t(setup.mesh.faces[2 * k + 1])] == 2;
        if (setup.mesh.face_markers[k] == body && low) setup.mesh.face_markers[k] = 40;
    }
    for (bool const first_low : {false, true}) {
        setup.curves = CurveSet{};
        setup.curves.control = {2, 2, 4, 2, 4, 4, 2, 4};
        setup.curves.add_over(1, {0, 1}, {0, 0, 1, 1});
        setup.curves.add_over(1, {1, 2, 3, 0}, {0, 0, 1, 2, 3, 3});
        setup.conditions.clear();
        if (first_low) setup.put_on_curves(40, 0);
        setup.put_on_curves(body, 1);
        if (!first_low) setup.put_on_curves(40, 0);
        Solved const solved(setup);
        CHECK(solved.report.curve_points == 8);
        auto const found = parameters(solved);
        CHECK(found.at(17).first == 0);
        CHECK(found.at(17).second == doctest::Approx(0.5));
        CHECK(found.at(30).first == 1);
        CHECK(found.at(30).second == doctest::Approx(1.5));
        CHECK(solved.values(0)[16] == 1);
        CHECK(solved.values(1)[18] == 1);
        CHECK(solved.values(2)[31] == 1);
        CHECK(solved.report.partition_defect < 1e-15);
    }
}

TEST_CASE("points farther from their curve than its extent are refused with point and distance") {
    for (double const size : {1.0, 1e-6, 1e6}) {
        Case setup = airfoil_case();
        for (std::vector<double>* const numbers :
             {&setup.mesh.x, &setup.mesh.y, &setup.curves.control})
            for (double& number : *numbers) number *= size;
        Attempt right;
        CHECK(right.analyse(setup.problem()));
        setup.conditions.clear();
        setup.put_on_curves(far_field);  // on the airfoil's curve
        Attempt wrong;
        CHECK(!wrong.analyse(setup.problem()));
        CHECK(wrong.status == HM_BAD_CONDITION);
        CHECK(wrong.error.value > 6 * size);  // a circle of radius 8 round the chord
        CHECK(wrong.error.value < 9 * size);
        std::vector<std::int32_t> farthest;
        for (std::size_t face = 0; face < setup.mesh.face_markers.size(); ++face)
            if (setup.mesh.face_markers[face] == far_field)
                farthest.push_back(setup.mesh.faces[2 * face]);
        CHECK(std::find(farthest.begin(), farthest.end(), wrong.error.item) != farthest.end());
    }
}

TEST_CASE("points that are a thousandth of the curve's diagonal from their curve give a warning") {
    for (double const size : {1.0, 1e-6, 1e6}) {
        for (double const part : {0.00098, 0.00102, 0.0098, 0.0102}) {
            for (double const limit : {0.0, 0.01, 0.02, 1e100}) {
                CAPTURE(size);
                CAPTURE(part);
                CAPTURE(limit);
                Case setup;
                setup.mesh = square(10, Cells::quads, 2, 2);
                double const gap = part * 0.2 * std::sqrt(2);  // of the diagonal, nearly
                setup.curves =
                    polyline({{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6 - gap}, {0.4, 0.6 - gap}});
                setup.put_on_curves(body);
                for (std::vector<double>* const numbers :
                     {&setup.mesh.x, &setup.mesh.y, &setup.curves.control})
                    for (double& number : *numbers) number *= size;
                hm_problem problem = setup.problem();
                problem.max_curve_distance = limit;
                Attempt attempt;
                bool const is_refused = limit > 0 && part > limit;
                CHECK(attempt.analyse(problem) == !is_refused);
                CHECK(attempt.error.code == attempt.status);
                CHECK(attempt.status == (is_refused     ? HM_BAD_CONDITION
                                         : part < 0.001 ? HM_OK
                                                        : HM_FAR_FROM_CURVE));
                if (part < 0.001) continue;
                INFO(attempt.error.text);
                CHECK(says(attempt.error, is_refused ? "too far for a curve of this wall"
                                                     : "at least 0.001 of the diagonal"));
                CHECK(attempt.error.value == doctest::Approx(gap * size));
                CHECK(setup.mesh.y[std::size_t(attempt.error.item)] == 0.6 * size);
                if (is_refused) continue;
                CHECK(attempt.prepare());
                CHECK(attempt.solve());  // the result can be used
                CHECK(attempt.status == HM_OK);
            }
        }
    }
    for (double const limit : {-1.0, 2e100, double(NAN)}) {
        Case setup = tiny_case();
        hm_problem problem = setup.problem();
        problem.max_curve_distance = limit;
        Attempt attempt;
        CHECK(!attempt.analyse(problem));
        CHECK(attempt.status == HM_BAD_ARGUMENT);
    }
}

TEST_CASE("the curve of a closed wall is refused if control points at one place would tear it") {
    struct Row {
        int degree, n;
        bool clamped;
    };
    for (Row const& row : {Row{2, 9, false}, Row{3, 14, false}, Row{5, 11, false}, Row{3, 12, true},
                           Row{1, 8, true}}) {
        CAPTURE(row.degree);
        Case setup = ring_case(4, 24, 1, 3);
        setup.known_points.clear();
        setup.known_curves.clear();
        setup.known_u.clear();
        Spline curve = ring(row.degree, row.n, 1, 1);
        if (row.clamped) {
            curve.indices.resize(std::size_t(row.n));
            curve.indices.push_back(0);
            curve.knots = clamped_knots(row.degree, row.n + 1);
        }
        Spline written = curve;  // the repeated points are written once more
        for (std::size_t k = std::size_t(row.n); k < curve.indices.size(); ++k) {
            auto const from = 2 * std::size_t(curve.indices[k]);
            written.control.push_back(curve.control[from]);
            written.control.push_back(curve.control[from + 1]);
        }
        written.indices.clear();
        setup.curves = written;
        Attempt const torn(setup.problem(), nullptr);
        CHECK(torn.status == HM_BAD_CURVE);
        CHECK(says(torn.error, "name one of them twice in indices"));
        CHECK(torn.error.item_kind == HM_ITEM_CONTROL_POINT);
        CHECK(torn.error.item == 0);
        CHECK(torn.error.other == row.n);
        setup.curves = curve;
        Attempt const closed(setup.problem(), nullptr);
        INFO(closed.error.text);
        CHECK(closed.status >= 0);
    }
}
