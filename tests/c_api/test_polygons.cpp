// Meshes of polygons with hanging nodes through the whole interface: linear fields exact, validity and quality as the
// header defines them, cells in the caller's numbering.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

struct Named {
    const char* name;
    Case its;
};

Case honeycomb_case(int n_r = 8, int n_t = 24, double pull = 0.2) {
    Case out;
    out.mesh = honeycomb(n_r, n_t, 0.5, 4, pull);
    out.curves = ring(3, 8, 0.5, 0.5);
    out.put_on_curves(body);
    return out;
}

// Quads round a square hole, finer near the hole, twice.
Case hanging_case() {
    Case out;
    auto const near = [](double size) {
        return [size](Point p) { return std::fabs(p.x - 0.5) < size && std::fabs(p.y - 0.5) < size; };
    };
    out.mesh = refined(refined(square(12, Cells::quads, 4, 4), near(0.34)), near(0.24));
    out.curves = polyline({{1.0 / 3, 1.0 / 3}, {2.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3}, {1.0 / 3, 2.0 / 3}});
    out.put_on_curves(body);
    return out;
}

std::vector<Named> cases() {
    std::vector<Named> out;
    out.push_back({"honeycomb", honeycomb_case()});
    out.push_back({"bricks", honeycomb_case(8, 24, 0)});
    out.push_back({"hanging nodes", hanging_case()});
    out.push_back({"clockwise", honeycomb_case()});
    Mesh& mesh = out.back().its.mesh;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        std::reverse(mesh.cells.begin() + mesh.cell_start[static_cast<std::size_t>(cell)],
                     mesh.cells.begin() + mesh.cell_start[static_cast<std::size_t>(cell) + 1]);
    }
    return out;
}

hm_quality_report quality_of(Solved const& solved, hm_mesh const& mesh, std::vector<double> const& x,
                             std::vector<double> const& y, const hm_points* reference = nullptr) {
    hm_quality_report out{};
    out.struct_size = sizeof out;
    REQUIRE(hm_quality(solved.basis, &mesh, points_in(x, y), reference, nullptr, &out, nullptr) == HM_OK);
    return out;
}

std::vector<double> turned_by(double angle, CurveSet const& curves, Complex centre) {
    std::vector<double> out;
    for (std::size_t k = 0; k < curves.control.size(); k += 2) {
        Complex const by = (std::polar(1.0, angle) - 1.0) * (Complex(curves.control[k], curves.control[k + 1]) - centre);
        out.insert(out.end(), {by.real(), by.imag()});
    }
    return out;
}

Mesh counter_clockwise(Mesh mesh) {
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        if (shoelace(outline(mesh, cell, mesh.x, mesh.y)) > 0) continue;
        std::reverse(mesh.cells.begin() + mesh.cell_start[static_cast<std::size_t>(cell)],
                     mesh.cells.begin() + mesh.cell_start[static_cast<std::size_t>(cell) + 1]);
    }
    return mesh;
}

}  // namespace

TEST_CASE("polygons: the report counts cells, sides and kinds as they are in the mesh") {
    for (Named& named : cases()) {
        CAPTURE(named.name);
        Mesh const mesh = counter_clockwise(named.its.mesh);
        hm_mesh const view = in_polygons(named.its.mesh_view());
        hm_problem problem = named.its.problem(view);
        problem.curves = nullptr;
        problem.n_conditions = 0;
        Attempt attempt;
        REQUIRE(attempt.analyse(problem));
        hm_mesh_report report{};
        report.struct_size = sizeof report;
        REQUIRE(hm_analysis_report(attempt.analysis, &report, nullptr) == HM_OK);
        std::int32_t triangles = 0, quads = 0;
        double smallest = 1, sum = 0;
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
            std::vector<Point> const p = outline(mesh, cell, mesh.x, mesh.y);
            triangles += p.size() == 3 ? 1 : 0;
            quads += p.size() == 4 ? 1 : 0;
            double const its = polygon_quality(p);
            smallest = std::min(smallest, its);
            sum += its;
        }
        CHECK(report.cells == mesh.n_cells());
        CHECK(report.triangles == triangles);
        CHECK(report.quads == quads);
        CHECK(report.polygons == mesh.n_cells() - triangles - quads);
        CHECK(report.polygons > 20);
        CHECK(report.edges == check(mesh).edges);
        CHECK(report.inverted == 0);
        CHECK(report.min_quality == doctest::Approx(smallest).epsilon(1e-12));
        CHECK(report.mean_quality == doctest::Approx(sum / mesh.n_cells()).epsilon(1e-12));
    }
}

TEST_CASE("polygons: linear fields are exact") {
    for (Named const& named : cases()) {
        for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
            CAPTURE(named.name);
            CAPTURE(kind);
            Case its = given_instead(named.its);
            std::vector<std::int32_t> markers = its.mesh.face_markers;
            std::sort(markers.begin(), markers.end());
            markers.erase(std::unique(markers.begin(), markers.end()), markers.end());
            for (std::int32_t const marker : markers) {
                if (marker != body) its.set_given(marker);
            }
            hm_options options = laplace();
            options.operator_kind = kind;
            if (kind == HM_WEIGHTED) options.exponent_quarters = HM_NO_WEIGHT;
            hm_mesh const view = in_polygons(its.mesh_view());
            Displaced displaced(its.problem(view), &options);
            Field field;   // of conformal functions z -> a z + b, of others any linear one
            for (std::size_t k = 0; k < its.mesh.x.size(); ++k) {
                double const x = its.mesh.x[k], y = its.mesh.y[k];
                field.push_back(kind == HM_CONFORMAL ? Complex(0.3, 0.4) * Complex(x, y) + Complex(1, -2)
                                                     : Complex(2 * x - 3 * y + 1, x + 0.5 * y - 4));
            }
            Field const found = displaced.displace(displaced.on_wall(field));
            double worst = 0;
            for (std::size_t k = 0; k < field.size(); ++k) worst = std::max(worst, std::abs(found[k] - field[k]));
            CHECK(worst < 1e-11);
        }
    }
}

TEST_CASE("polygons: a mesh of triangles and quadrilaterals has the functions of the other layouts, bit by bit") {
    Case its;
    its.mesh = annulus(6, 24, 0.5, 3, Cells::hybrid, true);
    its.curves = ring(3, 8, 0.5, 0.5);
    its.put_on_curves(body);
    hm_mesh const rows = its.mesh_view(), polygons = in_polygons(rows);
    Solved const a(its.problem(rows)), b(its.problem(polygons));
    CHECK(same_bits(a.all_values(), b.all_values()));
    // Either basis goes with the mesh as polygons or rows; cells are the same.
    const hm_basis* attached = nullptr;
    CHECK(hm_basis_attach(&attached, b.basis, static_cast<std::size_t>(b.info().bytes), &rows, nullptr) == HM_OK);
    hm_quality_report const one = quality_of(a, rows, its.mesh.x, its.mesh.y);
    hm_quality_report const other = quality_of(b, polygons, its.mesh.x, its.mesh.y);
    CHECK(one.min_quality == other.min_quality);
    CHECK(one.mean_quality == doctest::Approx(other.mean_quality).epsilon(1e-14));
    hm_quality_report report{};
    report.struct_size = sizeof report;
    CHECK(hm_quality(a.basis, &polygons, nullptr, nullptr, nullptr, &report, nullptr) == HM_BAD_BASIS);
}

TEST_CASE("polygons: the admissible step ends where a cell is no longer sound; quality and assessment agree") {
    for (Named& named : cases()) {
        for (std::int32_t const base : {0, 1}) {
            CAPTURE(named.name);
            Case& its = named.its;
            its.index_base = base;
            Mesh const mesh = counter_clockwise(its.mesh);
            hm_mesh const view = in_polygons(its.mesh_view());
            hm_options options = laplace();
            options.operator_kind = HM_CONFORMAL;
            Solved const solved(its.problem(view), &options);
            CHECK(is_sound(mesh, mesh.x, mesh.y));
            int stopped = 0;
            for (unsigned seed = 1; seed <= 6; ++seed) {
                std::vector<double> const move = some_move(solved.info().functions, 0.3, seed);
                std::vector<double> dx(mesh.x.size()), dy(dx);
                REQUIRE(hm_morph(solved.basis, move.data(), nullptr, points_out(dx, dy), nullptr, nullptr) == HM_OK);
                hm_step_report step{}, also_step{};
                step.struct_size = also_step.struct_size = sizeof step;
                REQUIRE(hm_admissible_step(solved.basis, &view, nullptr, points_in(dx, dy), nullptr, &step, nullptr) ==
                        HM_OK);
                hm_quality_report assessed{};
                assessed.struct_size = sizeof assessed;
                REQUIRE(hm_assess(solved.basis, &view, nullptr, points_in(dx, dy), nullptr, &also_step, &assessed,
                                  nullptr) == HM_OK);
                CHECK(also_step.admissible == step.admissible);
                CHECK(also_step.cell == step.cell);
                if (!(step.admissible < 1e6)) continue;
                ++stopped;
                auto const at = [&](double s, std::vector<double>& x, std::vector<double>& y) {
                    x = mesh.x;
                    y = mesh.y;
                    for (std::size_t k = 0; k < x.size(); ++k) {
                        x[k] += s * dx[k];
                        y[k] += s * dy[k];
                    }
                };
                std::vector<double> x, y;
                at((1 - 1e-6) * step.admissible, x, y);
                CHECK(is_sound(mesh, x, y));
                CHECK(quality_of(solved, view, x, y).inverted == 0);
                at((1 + 1e-6) * step.admissible, x, y);
                hm_quality_report const beyond = quality_of(solved, view, x, y);
                CHECK(beyond.inverted >= 1);
                CHECK(beyond.first_inverted == step.cell);
                std::vector<std::int32_t> const corners = corners_of(mesh, step.cell - base);
                CHECK(std::count(corners.begin(), corners.end(), step.point - base) == 1);
                at(1, x, y);
                hm_quality_report const measured = quality_of(solved, view, x, y, points_in(mesh.x, mesh.y));
                CHECK(measured.inverted == assessed.inverted);
                CHECK(measured.min_quality == doctest::Approx(assessed.min_quality).epsilon(1e-9));
                CHECK(measured.mean_quality == doctest::Approx(assessed.mean_quality).epsilon(1e-9));
            }
            CHECK(stopped >= 3);
        }
    }
}

TEST_CASE("polygons: a convex corner may not become reflex though all triangles stay positive, a flat one may bend") {
    // A regular hexagon inside a ring of quadrilaterals; one corner is pushed inwards.
    double const pi = std::acos(-1.0);
    Case its;
    for (int ring_number = 0; ring_number < 3; ++ring_number) {
        for (int k = 0; k < 12; ++k) {   // corners and middles of the sides
            double const flat = k % 2 == 0 ? 1 : std::cos(pi / 6), r = (1 + ring_number) * flat, angle = pi * k / 6;
            its.mesh.add_point({r * std::cos(angle), r * std::sin(angle)});
        }
    }
    std::vector<std::int32_t>& cells = its.mesh.cells;
    for (std::int32_t k = 0; k < 12; ++k) cells.push_back(k);
    its.mesh.cell_start.push_back(12);
    for (std::int32_t j = 0; j < 2; ++j) {
        for (std::int32_t k = 0; k < 12; ++k) {
            std::int32_t const a = 12 * j + k, b = 12 * j + (k + 1) % 12;
            its.mesh.add_cell({a, a + 12, b + 12, b});
        }
    }
    for (std::int32_t k = 0; k < 12; ++k) its.mesh.add_face(24 + k, 24 + (k + 1) % 12, far_field);
    its.curves = ring(2, 12, 3, 3);
    its.put_on_curves(far_field);
    its.conditions.clear();
    its.set_rigid(far_field, 0, 0);
    its.curves = {};
    hm_mesh const view = in_polygons(its.mesh_view());
    Solved const solved(its.problem(view));
    std::vector<double> x = its.mesh.x, y = its.mesh.y;
    CHECK(quality_of(solved, view, x, y).min_quality > 0.5);
    auto const quality_with = [&](std::size_t point, double part) {
        x = its.mesh.x;
        y = its.mesh.y;
        x[point] *= part;
        y[point] *= part;
        return quality_of(solved, view, x, y);
    };
    // The corner 0 is flat when it lies between its neighbours, at a distance of cos^2(pi / 6) from the centre.
    double const straight = std::pow(std::cos(pi / 6), 2);
    CHECK(quality_with(0, straight + 1e-9).inverted == 0);
    hm_quality_report const reflex = quality_with(0, straight - 1e-9);
    CHECK(reflex.inverted == 1);
    CHECK(reflex.first_inverted == 0);
    CHECK(quality_with(1, 0.9).inverted == 0);    // the middle of a side
    // Bent by 45 degrees towards the inside: the neighbours, at a distance of 1, are half a side away on the side.
    double const bent = (std::cos(pi / 6) - 0.5 * std::tan(pi / 8)) / std::cos(pi / 6);
    CHECK(quality_with(1, bent + 1e-9).inverted == 0);
    CHECK(quality_with(1, bent - 1e-9).inverted == 1);

    // The same as a movement, also where all points go far along: those differences are without rounding.
    double const tick = std::ldexp(1, -20), inwards_x = 0.75, inwards_y = tick * std::round(std::sqrt(0.1875) / tick);
    auto const step_with = [&](double together) {
        std::vector<double> dx(its.mesh.x.size(), together), dy(dx);
        dx[1] -= inwards_x;
        dy[1] -= inwards_y;
        hm_step_report step{};
        step.struct_size = sizeof step;
        REQUIRE(hm_admissible_step(solved.basis, &view, nullptr, points_in(dx, dy), nullptr, &step, nullptr) == HM_OK);
        CHECK(step.cell == 0);
        return step.admissible;
    };
    CHECK(step_with(0) == doctest::Approx(1 - bent).epsilon(1e-5));
    CHECK(step_with(std::ldexp(1, 30)) == doctest::Approx(step_with(0)).epsilon(1e-14));
}

TEST_CASE("polygons: the safe morph and the improvement leave sound cells and say so") {
    for (Named& named : cases()) {
        if (std::string(named.name) == "clockwise") continue;
        CAPTURE(named.name);
        Case& its = named.its;
        hm_mesh const view = in_polygons(its.mesh_view());
        hm_options options = options_of(HM_CONFORMAL);
        Solved const solved(its.problem(view), &options);
        std::size_t bytes = 0;
        REQUIRE(hm_morph_safe_size(solved.plan, solved.basis, &bytes, nullptr) == HM_OK);
        Guarded work(bytes);
        std::int32_t const n = solved.info().functions;
        std::vector<std::vector<double>> moves = {some_move(n, 0.12, 5), std::vector<double>()};
        moves[1] = turned_by(1.2, its.curves, std::string(named.name) == "hanging nodes" ? Complex(0.5, 0.5) : 0);
        for (std::vector<double> const& move : moves) {
            for (std::int32_t const skipped : {0, without({HM_STRATEGY_LINEAR, HM_STRATEGY_SUBSTEPS})}) {
                CAPTURE(skipped);
                std::vector<double> x = its.mesh.x, y = its.mesh.y;
                hm_safe_options safe{};
                safe.struct_size = sizeof safe;
                safe.skipped_strategies = skipped;
                hm_safe_report report{};
                report.struct_size = sizeof report;
                hm_error error{};
                REQUIRE(hm_plan_factor(solved.plan, nullptr, nullptr) == HM_OK);
                hm_status const status = hm_morph_safe(solved.plan, solved.basis, move.data(), points_out(x, y), nullptr,
                                                       work.data(), work.size(), &safe, &report, &error);
                INFO(error.text);
                REQUIRE(status >= HM_OK);
                CHECK(work.guards_intact());
                CHECK(report.inverted == 0);
                CHECK(is_sound(its.mesh, x, y));
                if (skipped == 0) CHECK(report.step_fraction == 1);
                hm_quality_report const measured = quality_of(solved, view, x, y, points_in(its.mesh.x, its.mesh.y));
                CHECK(measured.min_quality == report.min_quality);
                CHECK(measured.min_quality_cell == report.min_quality_cell);
                CHECK(report.worst[0].cell == report.min_quality_cell);
                CHECK(report.worst[0].quality == report.min_quality);
                CHECK(report.worst[0].cell < its.mesh.n_cells());

                REQUIRE(hm_improve_size(solved.plan, &bytes, nullptr) == HM_OK);
                Guarded improve_work(bytes);
                hm_improve_report improved{};
                improved.struct_size = sizeof improved;
                std::vector<double> better_x(x.size()), better_y(x.size());
                REQUIRE(hm_improve(solved.plan, points_in(x, y), points_out(better_x, better_y), improve_work.data(), bytes,
                                   nullptr, &improved, &error) == HM_OK);
                CHECK(improve_work.guards_intact());
                CHECK(is_sound(its.mesh, better_x, better_y));
                CHECK(improved.min_quality_before == measured.min_quality);
                CHECK(improved.mean_quality > 0.97 * improved.mean_quality_before);
            }
        }
        // The mesh itself is as good as it can be: it is its own target.
        std::vector<double> same_x(its.mesh.x.size()), same_y(same_x);
        hm_improve_report report{};
        report.struct_size = sizeof report;
        Guarded improve_work(bytes);
        REQUIRE(hm_improve(solved.plan, points_in(its.mesh.x, its.mesh.y), points_out(same_x, same_y), improve_work.data(),
                           bytes, nullptr, &report, nullptr) == HM_OK);
        CHECK(largest_difference(same_x, its.mesh.x) < 1e-12);
        CHECK(largest_difference(same_y, its.mesh.y) < 1e-12);
    }
}

TEST_CASE("polygons: the last rung untangles what one step inverts") {
    Case its = honeycomb_case();
    hm_mesh const view = in_polygons(its.mesh_view());
    hm_options options = laplace();
    Solved const solved(its.problem(view), &options);
    std::vector<double> move, x(its.mesh.x.size()), y(x);
    hm_quality_report morphed{};
    for (double angle = 0.1; morphed.inverted == 0; angle *= 1.1) {   // the smallest of these turns that inverts a cell
        REQUIRE(angle < 3);
        move = turned_by(angle, its.curves, 0);
        REQUIRE(hm_morph(solved.basis, move.data(), points_in(its.mesh.x, its.mesh.y), points_out(x, y), nullptr,
                         nullptr) == HM_OK);
        morphed = quality_of(solved, view, x, y);
    }
    REQUIRE(morphed.self_crossing == 0);
    REQUIRE(!is_sound(its.mesh, x, y));
    std::size_t bytes = 0;
    REQUIRE(hm_morph_safe_size(solved.plan, solved.basis, &bytes, nullptr) == HM_OK);
    Guarded work(bytes);
    hm_safe_options safe{};
    safe.struct_size = sizeof safe;
    safe.max_resolves = -1;
    safe.skipped_strategies = without({HM_STRATEGY_SUBSTEPS});
    hm_safe_report report{};
    report.struct_size = sizeof report;
    REQUIRE(hm_morph_safe(solved.plan, solved.basis, move.data(), points_out(x, y), nullptr, work.data(), work.size(), &safe,
                          &report, nullptr) >= HM_OK);
    CHECK(report.untangled > 0);
    CHECK(is_sound(its.mesh, x, y));
}

TEST_CASE("polygons: every engine, scheme and kind of derived basis takes them") {
    Case its = honeycomb_case(6, 24);
    hm_mesh const view = in_polygons(its.mesh_view());
    struct Way {
        std::int32_t operator_kind, scheme, engine;
    };
    for (Way const way : {Way{HM_LAPLACE, HM_BOUNDED, HM_DIRECT}, Way{HM_LAPLACE, HM_NODAL_GRADIENT, HM_DIRECT},
                          Way{HM_WEIGHTED, HM_COMPACT, HM_MULTIGRID}, Way{HM_LAPLACE, HM_COMPACT, HM_FAS}}) {
        hm_options options = laplace();
        options.operator_kind = way.operator_kind;
        options.scheme = way.scheme;
        options.engine = way.engine;
        CAPTURE(way.scheme);
        CAPTURE(way.engine);
        Solved const solved(its.problem(view), &options);
        std::vector<double> const sum = solved.sum();   // harmonic measure of the circle: the Laplace ones ln(r) / ln(..)
        if (way.operator_kind != HM_LAPLACE) continue;
        double worst = 0;
        for (std::size_t k = 0; k < sum.size(); ++k) {
            double const r = std::hypot(its.mesh.x[k], its.mesh.y[k]);
            worst = std::max(worst, std::fabs(sum[k] - std::log(4 / r) / std::log(8.0)));
        }
        CHECK(worst < 0.06);
    }
    hm_options options = options_of(HM_CONFORMAL);
    Solved const solved(its.problem(view), &options);
    std::size_t bytes = 0;
    hm_error error{};
    REQUIRE(hm_single_size(solved.basis, &bytes, &error) == HM_OK);
    Guarded single_block(bytes);
    hm_basis* single = nullptr;
    REQUIRE(hm_single_init(&single, single_block.data(), bytes, solved.basis, &error) == HM_OK);
    CHECK(single_block.guards_intact());
    hm_quality_report a{}, b{};
    a.struct_size = b.struct_size = sizeof a;
    CHECK(hm_quality(single, &view, nullptr, nullptr, nullptr, &a, &error) == HM_OK);
    CHECK(hm_quality(solved.basis, &view, nullptr, nullptr, nullptr, &b, &error) == HM_OK);
    CHECK(a.mean_quality == b.mean_quality);
    CHECK(a.mean_quality > 0.5);
}

TEST_CASE("polygons: functions are transferred between meshes of polygons") {
    Case coarse = honeycomb_case(6, 24), fine = honeycomb_case(12, 48);
    fine.curves = coarse.curves;
    hm_mesh const coarse_view = in_polygons(coarse.mesh_view()), fine_view = in_polygons(fine.mesh_view());
    Solved const source(coarse.problem(coarse_view));
    Attempt target;
    REQUIRE(target.analyse(fine.problem(fine_view)));
    REQUIRE(target.prepare());
    std::size_t bytes = 0;
    hm_error error{};
    REQUIRE(hm_transfer_size(target.analysis, &coarse_view, &bytes, &error) == HM_OK);
    Guarded work(bytes);
    hm_transfer_report report{};
    report.struct_size = sizeof report;
    REQUIRE(hm_transfer(target.basis, work.data(), bytes, target.analysis, source.basis, &coarse_view, &report, &error) >=
            HM_OK);
    CHECK(work.guards_intact());
    Solved const exact(fine.problem(fine_view));
    std::vector<double> interpolated(fine.mesh.x.size());
    REQUIRE(hm_basis_values(target.basis, 2, 0, interpolated.data(), nullptr) == HM_OK);
    CHECK(largest_difference(interpolated, exact.values(2)) < 0.05);
}

TEST_CASE("polygons: bases are damaged, and what is no mesh of polygons is refused by name") {
    Case its = honeycomb_case(4, 12);
    hm_mesh const view = in_polygons(its.mesh_view());
    Solved const solved(its.problem(view));
    std::size_t const bytes = static_cast<std::size_t>(solved.info().bytes);
    const hm_basis* attached = nullptr;
    hm_error error{};
    CHECK(hm_basis_attach(&attached, solved.basis, bytes, &view, &error) == HM_OK);
    std::vector<std::int32_t> cells = its.mesh.cells;
    std::swap(cells[0], cells[1]);
    hm_mesh other = view;
    other.cell_points = cells.data();
    CHECK(hm_basis_attach(&attached, solved.basis, bytes, &other, &error) == HM_BAD_BASIS);
    other = view;
    std::vector<std::int32_t> start = its.mesh.cell_start;
    other.cell_start = start.data();
    hm_problem problem = its.problem(other);
    std::size_t needed = 0;
    auto const refused = [&](hm_status status, const char* words) {
        CHECK(hm_analysis_size(&problem, nullptr, &needed, &error) == status);
        INFO(error.text);
        CHECK(std::string(error.text).find(words) != std::string::npos);
    };
    start[3] = start[2] + 2;
    refused(HM_BAD_MESH, "polygon 2 has 2 points; 3 to 1024");
    start = its.mesh.cell_start;
    start[0] = 1;
    refused(HM_BAD_MESH, "must begin with index_base");
    other.cell_start = nullptr;
    refused(HM_BAD_ARGUMENT, "cell_start is NULL");
    other = view;
    cells = its.mesh.cells;
    other.cell_points = cells.data();
    auto const not_analysed = [&](const char* words) {
        Attempt attempt;
        CHECK(!attempt.analyse(its.problem(other)));
        INFO(attempt.error.text);
        CHECK(attempt.status == HM_BAD_MESH);
        CHECK(std::string(attempt.error.text).find(words) != std::string::npos);
    };
    cells[7] = 1000;
    not_analysed("cell 1 names point 1000");
    cells = its.mesh.cells;
    cells[8] = cells[6];
    not_analysed("cell 1 has point");
    cells = its.mesh.cells;
    std::swap(cells[7], cells[9]);   // its sides cross
    not_analysed("");
}

TEST_CASE("polygons: same bits on any number of threads") {
    Case its = hanging_case();
    hm_mesh const view = in_polygons(its.mesh_view());
    hm_options options = options_of(HM_CONFORMAL);
    Solved const one(its.problem(view), &options);
    Backwards backwards;
    hm_executor const executor = backwards.executor(3);
    options.executor = &executor;
    Solved const several(its.problem(view), &options);
    CHECK(same_bits(one.all_values(), several.all_values()));
}
