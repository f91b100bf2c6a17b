// Meshes of polygons with hanging nodes through the whole interface: linear fields are exact, every
// engine and derived basis takes these meshes, and meshes that are none are refused.
#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/displaced.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/polygons.hpp>

using namespace fixtures;

TEST_CASE("polygons: the report counts cells, sides and kinds as they are in the mesh") {
    for (NamedCase& named : polygon_cases()) {
        CAPTURE(named.name);
        Mesh const mesh = counter_clockwise(named.setup.mesh);
        hm_mesh const view = in_polygons(named.setup.mesh_view());
        hm_problem problem = named.setup.problem(view);
        problem.curves = nullptr;
        problem.n_conditions = 0;
        Attempt attempt;
        REQUIRE(attempt.analyse(problem));
        auto report = sized<hm_mesh_report>();
        REQUIRE(hm_analysis_report(attempt.analysis, &report, nullptr) == HM_OK);
        std::int32_t triangles = 0, quads = 0;
        double smallest = 1, sum = 0;
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
            std::vector<Point> const p = outline(mesh, cell, mesh.x, mesh.y);
            triangles += p.size() == 3 ? 1 : 0;
            quads += p.size() == 4 ? 1 : 0;
            double const quality = polygon_quality(p);
            smallest = std::min(smallest, quality);
            sum += quality;
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
    for (NamedCase const& named : polygon_cases()) {
        for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
            CAPTURE(named.name);
            CAPTURE(kind);
            Case setup = given_instead(named.setup);
            std::vector<std::int32_t> markers = setup.mesh.face_markers;
            std::sort(markers.begin(), markers.end());
            markers.erase(std::unique(markers.begin(), markers.end()), markers.end());
            for (std::int32_t const marker : markers) {
                if (marker != body) setup.set_given(marker);
            }
            Options options = laplace();
            options.operator_kind = kind;
            if (kind == HM_WEIGHTED) options.exponent = -1;
            hm_mesh const view = in_polygons(setup.mesh_view());
            Displaced displaced(setup.problem(view), &options);
            Field field;  // of conformal functions z -> a z + b, of others any linear one
            for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
                double const x = setup.mesh.x[k], y = setup.mesh.y[k];
                field.push_back(kind == HM_CONFORMAL
                                    ? Complex(0.3, 0.4) * Complex(x, y) + Complex(1, -2)
                                    : Complex(2 * x - 3 * y + 1, x + 0.5 * y - 4));
            }
            Field const found = displaced.displace(displaced.on_wall(field));
            double worst = 0;
            for (std::size_t k = 0; k < field.size(); ++k)
                worst = std::max(worst, std::abs(found[k] - field[k]));
            CHECK(worst < 1e-11);
        }
    }
}

TEST_CASE("triangles and quadrilaterals given as polygons have the same functions bit by bit") {
    Case setup;
    setup.mesh = annulus(6, 24, 0.5, 3, Cells::hybrid, true);
    setup.curves = ring(3, 8, 0.5, 0.5);
    setup.put_on_curves(body);
    hm_mesh const rows = setup.mesh_view(), polygons = in_polygons(rows);
    Solved const a(setup.problem(rows)), b(setup.problem(polygons));
    CHECK(same_bits(a.all_values(), b.all_values()));
    // Either basis goes with the mesh as polygons or rows; cells are the same.
    const hm_basis* attached = nullptr;
    CHECK(hm_basis_attach(&attached, b.basis, std::size_t(b.info().bytes), &rows, nullptr) ==
          HM_OK);
    CHECK(quality_of(b.basis, rows, setup.mesh).inverted == 0);
    hm_quality_report const one = quality_of(a.basis, rows, setup.mesh);
    hm_quality_report const other = quality_of(b.basis, polygons, setup.mesh);
    CHECK(one.min_quality == other.min_quality);
    CHECK(one.mean_quality == doctest::Approx(other.mean_quality).epsilon(1e-14));
    auto report = sized<hm_quality_report>();
    CHECK(hm_assess(a.basis, &polygons, nullptr, nullptr, nullptr, nullptr, nullptr, &report,
                    nullptr) == HM_BAD_BASIS);
}

TEST_CASE("polygons: every engine, scheme and kind of derived basis takes meshes of polygons") {
    Case setup = honeycomb_case(6, 24);
    hm_mesh const view = in_polygons(setup.mesh_view());
    struct Way {
        std::int32_t operator_kind, scheme, engine;
    };
    for (Way const way :
         {Way{HM_LAPLACE, HM_BOUNDED, HM_DIRECT}, Way{HM_LAPLACE, HM_NODAL_GRADIENT, HM_DIRECT},
          Way{HM_WEIGHTED, HM_COMPACT, HM_MULTIGRID}, Way{HM_LAPLACE, HM_COMPACT, HM_FAS}}) {
        Options options = laplace();
        options.operator_kind = way.operator_kind;
        options.scheme = way.scheme;
        options.engine = way.engine;
        CAPTURE(way.scheme);
        CAPTURE(way.engine);
        Solved const solved(setup.problem(view), &options);
        // Harmonic measure of the circle: the Laplace ones ln(r) / ln(..).
        std::vector<double> const sum = solved.sum();
        if (way.operator_kind != HM_LAPLACE) continue;
        double worst = 0;
        for (std::size_t k = 0; k < sum.size(); ++k) {
            double const r = std::hypot(setup.mesh.x[k], setup.mesh.y[k]);
            worst = std::max(worst, std::fabs(sum[k] - std::log(4 / r) / std::log(8.0)));
        }
        CHECK(worst < 0.06);
    }
    Options options = options_of(HM_CONFORMAL);
    Solved const solved(setup.problem(view), &options);
    hm_error error{};
    Guarded single_block = block_of(fixtures::single_size, solved.basis);
    hm_basis* single = nullptr;
    REQUIRE(hm_single_init(&single, fixtures::Memory(single_block.data(), single_block.size()),
                           solved.basis, &error) == HM_OK);
    CHECK(single_block.guards_intact());
    hm_quality_report const a = quality_of(single, view, setup.mesh),
                            b = quality_of(solved.basis, view, setup.mesh);
    CHECK(a.mean_quality == b.mean_quality);
    CHECK(a.mean_quality > 0.5);
}

TEST_CASE("polygons: functions are transferred between meshes of polygons") {
    Case coarse = honeycomb_case(6, 24), fine = honeycomb_case(12, 48);
    fine.curves = coarse.curves;
    hm_mesh const coarse_view = in_polygons(coarse.mesh_view()),
                  fine_view = in_polygons(fine.mesh_view());
    Solved const source(coarse.problem(coarse_view));
    TransferAttempt target;
    REQUIRE(target.open(fine.problem(fine_view)));
    REQUIRE(target.fill_from(source.basis, coarse_view));
    Solved const exact(fine.problem(fine_view));
    CHECK(largest_difference(values_of(target.basis, 2), exact.values(2)) < 0.05);
}

TEST_CASE("damaged bases of polygons and wrong polygons are refused with the reason") {
    Case setup = honeycomb_case(4, 12);
    hm_mesh const view = in_polygons(setup.mesh_view());
    Solved const solved(setup.problem(view));
    std::size_t const bytes = std::size_t(solved.info().bytes);
    const hm_basis* attached = nullptr;
    hm_error error{};
    CHECK(hm_basis_attach(&attached, solved.basis, bytes, &view, &error) == HM_OK);
    std::vector<std::int32_t> cells = setup.mesh.cells;
    std::swap(cells[0], cells[1]);
    hm_mesh other = view;
    other.cell_points = cells.data();
    CHECK(hm_basis_attach(&attached, solved.basis, bytes, &other, &error) == HM_BAD_BASIS);
    other = view;
    std::vector<std::int32_t> start = setup.mesh.cell_start;
    other.cell_start = start.data();
    hm_problem problem = setup.problem(other);
    std::size_t needed = 0;
    auto const refused = [&](hm_status status, const char* words) {
        CHECK(fixtures::analysis_size(&problem, nullptr, &needed, &error) == status);
        INFO(error.text);
        CHECK(says(error, words));
    };
    start[3] = start[2] + 2;
    refused(HM_BAD_MESH, "polygon 2 has 2 points, but must have 3 to 1024");
    start = setup.mesh.cell_start;
    start[0] = 1;
    refused(HM_BAD_MESH, "must begin with index_base");
    other.cell_start = nullptr;
    refused(HM_BAD_ARGUMENT, "cell_start is NULL");
    other = view;
    cells = setup.mesh.cells;
    other.cell_points = cells.data();
    auto const not_analysed = [&](const char* words) {
        Attempt attempt;
        CHECK(!attempt.analyse(setup.problem(other)));
        INFO(attempt.error.text);
        CHECK(attempt.status == HM_BAD_MESH);
        CHECK(says(attempt.error, words));
    };
    cells[7] = 1000;
    not_analysed("cell 1 names point 1000");
    cells = setup.mesh.cells;
    cells[8] = cells[6];
    not_analysed("cell 1 contains point");
    cells = setup.mesh.cells;
    std::swap(cells[7], cells[9]);  // its sides cross
    not_analysed("");
}

TEST_CASE("polygons: same bits on any number of threads") {
    Case setup = hanging_case();
    hm_mesh const view = in_polygons(setup.mesh_view());
    Options options = options_of(HM_CONFORMAL);
    Solved const one(setup.problem(view), &options);
    Backwards backwards;
    hm_executor const executor = backwards.executor(3);
    options.executor = &executor;
    Solved const several(setup.problem(view), &options);
    CHECK(same_bits(one.all_values(), several.all_values()));
}
