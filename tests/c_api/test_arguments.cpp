// Every argument of every call is looked at: NULL is refused by the argument's name, a struct
// without its size, coordinates without an array or with a negative stride, and a block that is one
// byte too short are refused, too.
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_fields.h>
#include <harmorph_space.h>
#include "private.h"
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/blocks.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/extruded.hpp>
#include <fixtures/parted.hpp>
#include <fixtures/spoiled_arguments.hpp>

#include <algorithm>
#include <limits>

using namespace fixtures;

namespace {

struct Given {  // a mesh with a solved basis, and points to read and to write
    Case setup = tiny_case();
    hm_mesh mesh = setup.mesh_view();
    Solved solved{setup.problem(mesh)};
    hm_analysis* analysis = solved.analysis;
    hm_plan* plan = solved.plan;
    hm_basis* basis = solved.basis;
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y, to_x = x, to_y = y,
                        zero = std::vector<double>(x.size(), 0.0);
    std::vector<double> move = std::vector<double>(8, 0.0),
                        numbers = std::vector<double>(1000, 0.0);
    hm_points at{x.data(), y.data(), 1}, still{zero.data(), zero.data(), 1};
    hm_points_out to{to_x.data(), to_y.data(), 1};
    hm_executor executor = sized<hm_executor>();
    std::size_t bytes = 0;
    std::int32_t n = 0, other = 0, list[100] = {};
};

}  // namespace

TEST_CASE("curves and fits") {
    CurveSet set = ring(3, 8, 1, 1);
    hm_curves const& curves = set.view();
    double values[16] = {}, u = 0, distance = 0;
    std::int32_t control[8] = {};
    check_arguments("curves", hm_curves_check, &curves);
    check_arguments("curves, -, -, -, control, values", hm_curve_basis, &curves, 0, 0.25, 1,
                    control, values);
    check_arguments("curves, -, -, -, xy", hm_curve_point, &curves, 0, 0.25, 1, values);
    check_arguments("curves, -, -, -, u, distance", hm_curve_project, &curves, 0, 2.0, 0.0, &u,
                    &distance);

    hm_fit_options options = sized<hm_fit_options>();
    options.n_control = 8;
    hm_fit_report report = sized<hm_fit_report>();
    std::size_t bytes = 0;
    std::vector<double> x, y;
    for (int k = 0; k < 40; ++k) {
        x.push_back(std::cos(0.157 * k));
        y.push_back(std::sin(0.157 * k));
    }
    hm_points const points{x.data(), y.data(), 1};
    const hm_curves* fitted = nullptr;
    check_arguments("-, ?options, ?bytes", fixtures::fit_size, 40, &options, &bytes);
    Guarded block(bytes);
    check_arguments("curves, memory, points, -, -, ?options, ?report", hm_fit, &fitted,
                    fixtures::Memory(block.data(), bytes), &points, 40, 1, &options, &report);

    double const at[] = {0.3};
    const double* matrix = nullptr;
    check_arguments("curves, -, -, -, u, ?bytes", fixtures::refine_size, &curves, 0, 0, 1, at,
                    &bytes);
    Guarded refined(bytes);
    check_arguments("finer, ?matrix, memory, curves, -, -, -, u", hm_refine, &fitted, &matrix,
                    fixtures::Memory(refined.data(), bytes), &curves, 0, 0, 1, at);
    hm_section section = sized<hm_section>();
    hm_quantity quantity = sized<hm_quantity>();
    quantity.kind = HM_AREA;
    std::vector<double> gradient(16), map(2 * 8 * 8);
    check_arguments("curves, ?section, -, quantities, values, ?at, ?gradients", hm_measure, &curves,
                    &section, 1, &quantity, values, values + 2, gradient.data());
    hm_variables variables = sized<hm_variables>();
    variables.kind = HM_FFD;
    variables.degree_x = variables.degree_y = 1;
    std::int32_t n = 0;
    check_arguments("curves, ?section, variables of movement 0, ?n, ?bytes",
                    fixtures::variables_size, &curves, &section, &variables, &n, &bytes);
    Guarded work(bytes);
    check_arguments("curves, ?section, variables of movement 0, ?n, memory, ?matrix, ?error",
                    fixtures::variables_map, &curves, &section, &variables, &n,
                    fixtures::Memory(work.data(), bytes), map.data(), values);
    hm_movement turn = sized<hm_movement>();
    check_arguments("curves, ?section, -, movements, ?n, ?bytes", fixtures::move_section_size,
                    &curves, &section, 1, &turn, &n, &bytes);
    Guarded moved(bytes);
    hm_section_move result = sized<hm_section_move>();
    result.move = map.data();
    result.n_values = 1;
    check_arguments("curves, ?section, -, movements, ?values, result, memory", hm_move_section,
                    &curves, &section, 1, &turn, values, &result,
                    fixtures::Memory(moved.data(), bytes));
    check_arguments(
        "curves, ?section, -, movements, ?n, ?values, ?move, ?derivatives, ?start, ?error, memory",
        fixtures::move_section, &curves, &section, 1, &turn, &n, values, map.data(),
        map.data() + 32, values, values, fixtures::Memory(moved.data(), bytes));
    check_arguments("curves, -, ?bytes", fixtures::family_modes_size, &curves, 1, &bytes);
    Guarded modes(bytes);
    map.assign(map.size(), 1);
    check_arguments("curves, -, members of movement 0, ?singular, memory", fixtures::family_modes,
                    &curves, 1, map.data(), values, fixtures::Memory(modes.data(), bytes));
}

TEST_CASE("from the problem to the basis") {
    Given g;
    hm_problem const problem = g.setup.problem(g.mesh);
    Options const options = laplace();
    hm_analysis* analysis = nullptr;
    hm_plan* plan = nullptr;
    hm_basis* basis = nullptr;
    hm_mesh_report of_mesh = sized<hm_mesh_report>();
    hm_solve_report solved = sized<hm_solve_report>();
    std::int32_t const marker = body;
    check_arguments("problem, ?options, ?bytes", fixtures::analysis_size, &problem, &options,
                    &g.bytes);
    Guarded analysed(g.bytes);
    check_arguments("analysis, memory, problem, ?options", hm_analysis_init, &analysis,
                    fixtures::Memory(analysed.data(), g.bytes), &problem, &options);
    check_arguments("analysis, report", hm_analysis_report, analysis, &of_mesh);
    check_arguments("analysis, -, markers, -, points, -, n, is_loop", hm_analysis_boundary,
                    analysis, 1, &marker, 0, g.list, 100, &g.n, &g.other);
    check_arguments("analysis, ?bytes", fixtures::plan_size, analysis, &g.bytes);
    Guarded planned(g.bytes);
    check_arguments("plan, memory, analysis", hm_plan_init, &plan,
                    fixtures::Memory(planned.data(), g.bytes), analysis);
    check_arguments("analysis, ?bytes", fixtures::basis_size, analysis, &g.bytes);
    Guarded of_basis(g.bytes);
    check_arguments("basis, memory, analysis", hm_basis_init, &basis,
                    fixtures::Memory(of_basis.data(), g.bytes), analysis);
    check_arguments("plan, ?at", hm_plan_factor, plan, &g.at);
    check_arguments("plan, basis, ?report", hm_plan_solve, plan, basis, &solved);
    check_arguments("plan, n_points, index_base", hm_plan_points, plan, &g.n, &g.other);

    std::int32_t first = 0;
    check_arguments("analysis, -, -, first, n", hm_private_share_of, analysis, 0, 2, &first, &g.n);
    check_arguments("analysis, -, -, ?bytes", hm_private_share_size, analysis, 0, 2, &g.bytes);
    Guarded shared(g.bytes);
    check_arguments("share, block, bytes, analysis, -, -", hm_private_share_init, &basis,
                    shared.data(), g.bytes, analysis, 0, 2);
}

TEST_CASE("what a basis is asked for") {
    Given g;
    hm_basis_info info = sized<hm_basis_info>();
    REQUIRE(hm_basis_info_get(g.basis, &info, nullptr) == HM_OK);
    const hm_basis* attached = nullptr;
    hm_basis* made = nullptr;
    hm_curves curves = sized<hm_curves>();
    hm_curve curve[2] = {sized<hm_curve>(), sized<hm_curve>()};
    hm_condition conditions[4] = {sized<hm_condition>()};
    check_arguments("basis, block, -, ?mesh", hm_basis_attach, &attached,
                    static_cast<void*>(g.basis), std::size_t(info.bytes), &g.mesh);
    check_arguments("basis, info", hm_basis_info_get, g.basis, &info);
    check_arguments("basis, ?move, control, out, !curve, -", hm_basis_curves, g.basis,
                    g.move.data(), g.numbers.data(), &curves, curve, 2);
    check_arguments("basis, ?out, -, n", hm_basis_conditions, g.basis, conditions, 4, &g.n);
    check_arguments("basis, -, -, values", hm_basis_values, g.basis, 0, 0, g.numbers.data());
    std::vector<double> dense(2 * g.numbers.size() * 100);
    check_arguments("basis, matrix", hm_basis_matrix, g.basis, dense.data());
    check_arguments("basis, ?bytes", fixtures::single_size, g.basis, &g.bytes);
    Guarded single(g.bytes);
    check_arguments("single, memory, basis", hm_single_init, &made,
                    fixtures::Memory(single.data(), g.bytes), g.basis);
    double const matrix[] = {1, 0, 0, 1, 0, 0, 0, 0};
    check_arguments("basis, -, -, ?bytes", fixtures::combine_size, g.basis, 2, 1, &g.bytes);
    Guarded combined(g.bytes);
    check_arguments("combined, memory, basis, -, -, matrix", hm_combine, &made,
                    fixtures::Memory(combined.data(), g.bytes), g.basis, 2, 1, matrix);
    hm_transfer_report report = sized<hm_transfer_report>();
    check_arguments("analysis, mesh, ?bytes", fixtures::transfer_size, g.analysis, &g.mesh,
                    &g.bytes);
    Guarded room(g.bytes);
    Attempt fine;
    REQUIRE(fine.analyse(g.setup.problem()));
    REQUIRE(fine.prepare());
    check_arguments("basis, memory, analysis, coarse, mesh, ?report", hm_transfer, fine.basis,
                    fixtures::Memory(room.data(), g.bytes), fine.analysis, g.basis, &g.mesh,
                    &report);
}

TEST_CASE("movements, gradients, quality") {
    Given g;
    double error = 0;
    std::int64_t sums[64] = {}, doubles = 0;
    hm_step_report step = sized<hm_step_report>();
    hm_quality_report quality = sized<hm_quality_report>();
    check_arguments("basis, move, ?from, to, ?executor", hm_morph, g.basis, g.move.data(), &g.at,
                    &g.to, &g.executor);
    check_arguments("basis, dj, gradient, ?executor", hm_adjoint, g.basis, &g.at, g.numbers.data(),
                    &g.executor);
    check_arguments("basis, move, from, to, error, ?point", hm_boundary_error, g.basis,
                    g.move.data(), &g.at, &g.at, &error, &g.n);
    std::size_t bytes = 0;
    check_arguments("basis, ?bytes", fixtures::recover_movement_size, g.basis, &bytes);
    Guarded room(bytes);
    hm_recover_report recovered = sized<hm_recover_report>();
    check_arguments("basis, at, -, move, ?report, memory", hm_recover_movement, g.basis, &g.at, 0.0,
                    g.numbers.data(), &recovered, fixtures::Memory(room.data(), bytes));
    check_arguments("analysis, from, to", hm_slip, g.analysis, &g.at, &g.to);
    check_arguments("analysis, from, dj, dj_from", hm_slip_adjoint, g.analysis, &g.at, &g.at,
                    &g.to);
    check_arguments("analysis, from, d_from, d_to", hm_slip_derivative, g.analysis, &g.at, &g.at,
                    &g.to);
    check_arguments("basis, mesh, ?from, displacement, ?reference, ?executor, ?step, ?quality",
                    hm_assess, g.basis, &g.mesh, &g.at, &g.still, &g.at, &g.executor, &step,
                    &quality);

    check_arguments("basis, dj, scale, ?executor", hm_private_adjoint_scale, g.basis, &g.at, &g.n,
                    &g.executor);
    check_arguments("basis, dj, -, sums, ?executor", hm_private_adjoint_sums, g.basis, &g.at, g.n,
                    sums, &g.executor);
    check_arguments("basis, -, sums, gradient", hm_private_adjoint_finish, g.basis, g.n, sums,
                    g.numbers.data());
    std::int32_t const points[] = {20, 30};
    hm_basis* rows = nullptr;
    check_arguments("basis, -, ?bytes", hm_private_extract_size, g.basis, 2, &g.bytes);
    Guarded extract(g.bytes);
    check_arguments("rows, block, -, basis, -, points", hm_private_extract_init, &rows,
                    extract.data(), g.bytes, g.basis, 2, points);

    hm_basis* share = nullptr;  // of all functions
    REQUIRE(hm_private_share_size(g.analysis, 0, 4, &g.bytes, nullptr) == HM_OK);
    Guarded shared(g.bytes);
    REQUIRE(hm_private_share_init(&share, shared.data(), g.bytes, g.analysis, 0, 3, nullptr) ==
            HM_OK);
    REQUIRE(hm_plan_solve(g.plan, share, nullptr, nullptr) == HM_OK);
    REQUIRE(hm_private_extract_init(&rows, extract.data(), extract.size(), share, 2, points,
                                    nullptr) == HM_OK);
    check_arguments("basis, -, doubles", hm_private_parcel_size, share, 2, &doubles);
    std::vector<double> parcel(static_cast<std::size_t>(doubles));
    check_arguments("basis, -, points, parcel", hm_private_parcel_pack, share, 2, points,
                    parcel.data());
    check_arguments("basis, parcel, -", hm_private_parcel_unpack, rows, parcel.data(), doubles);
}

TEST_CASE("large movements and better cells") {
    Given g;
    hm_safe_options safe = sized<hm_safe_options>();
    hm_safe_report report = sized<hm_safe_report>();
    hm_improve_options better = sized<hm_improve_options>();
    hm_improve_report improved = sized<hm_improve_report>();
    auto target = sized<hm_safe_target>();
    target.move = g.move.data();
    check_arguments("plan, ?basis, ?target, ?bytes", fixtures::move_safe_size, g.plan, g.basis,
                    &target, &g.bytes);
    Guarded work(g.bytes);
    check_arguments("plan, basis, target, to, memory, ?options, ?report", hm_move_safe, g.plan,
                    g.basis, &target, &g.to, fixtures::Memory(work.data(), g.bytes), &safe,
                    &report);
    check_arguments("plan, ?bytes", fixtures::improve_size, g.plan, &g.bytes);
    Guarded room(g.bytes);
    check_arguments("plan, ?from, to, memory, ?options, ?report", hm_improve, g.plan, &g.at, &g.to,
                    fixtures::Memory(room.data(), g.bytes), &better, &improved);
}

TEST_CASE("given displacements") {
    Case setup = given_instead(tiny_case());
    Displaced d(setup);
    std::int32_t const n = std::int32_t(d.points.size());
    std::vector<double> zero(100, 0.0), x = setup.mesh.x, y = setup.mesh.y, modes(200, 1.0);
    hm_points const wall{zero.data(), zero.data(), 1},
        from{setup.mesh.x.data(), setup.mesh.y.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    hm_solve_report report = sized<hm_solve_report>();
    hm_safe_options safe = sized<hm_safe_options>();
    hm_safe_report of_safe = sized<hm_safe_report>();
    std::int32_t list[100] = {}, n_given = 0;
    std::size_t bytes = 0;
    check_arguments("plan, points, -, n", hm_given_points, d.plan, list, 100, &n_given);
    check_arguments("plan, -, ?bytes", fixtures::displace_size, d.plan, 1, &bytes);
    Guarded work(bytes);
    check_arguments("plan, -, ?points, -, wall, ?from, to, memory, ?report", hm_displace, d.plan, n,
                    d.points.data(), 1, &wall, &from, &to, fixtures::Memory(work.data(), bytes),
                    &report);
    check_arguments("plan, -, ?points, -, dj, gradient, memory, ?report", hm_displace_adjoint,
                    d.plan, n, d.points.data(), 1, &from, &to, fixtures::Memory(work.data(), bytes),
                    &report);
    auto table = sized<hm_modes>();
    table.n_modes = 1;
    table.n = n;
    table.values = modes.data();
    check_arguments("plan, basis, modes, ?bytes", fixtures::tabulate_size, d.plan, d.basis, &table,
                    &bytes);
    Guarded block(bytes);
    hm_basis* tabulated = nullptr;
    check_arguments("tabulated, memory, plan, basis, modes, ?report", hm_tabulate, &tabulated,
                    fixtures::Memory(block.data(), bytes), d.plan, d.basis, &table, &report);
    auto target = sized<hm_safe_target>();
    target.n = n;
    target.wall = &wall;
    check_arguments("plan, basis, ?target, ?bytes", fixtures::move_safe_size, d.plan, d.basis,
                    &target, &bytes);
    Guarded safe_work(bytes);
    check_arguments("plan, ?basis, target, to, memory, ?options, ?report", hm_move_safe, d.plan,
                    d.basis, &target, &to, fixtures::Memory(safe_work.data(), bytes), &safe,
                    &of_safe);
}

TEST_CASE("a mesh one cell thick") {
    Given g;
    Extruded const space(g.setup.mesh, along_axis(2));
    hm_space_mesh const mesh = space.view();
    hm_plane* plane = nullptr;
    hm_plane_info info = sized<hm_plane_info>();
    hm_mesh of_plane = sized<hm_mesh>();
    std::vector<double> x = space.x, y = space.y, z = space.z;
    hm_space_points const at = space.points();
    hm_space_points_out const to{x.data(), y.data(), z.data(), 1};
    check_arguments("space, ?bytes", fixtures::plane_size, &mesh, &g.bytes);
    Guarded block(g.bytes);
    check_arguments("plane, memory, space", hm_plane_init, &plane,
                    fixtures::Memory(block.data(), g.bytes), &mesh);
    check_arguments("plane, info", hm_plane_info_get, plane, &info);
    check_arguments("plane, mesh", hm_plane_mesh, plane, &of_plane);
    check_arguments("plane, basis, move, ?from, to, ?executor", hm_plane_morph, plane, g.basis,
                    g.move.data(), &at, &to, &g.executor);
    check_arguments("plane, basis, dj, gradient, ?executor", hm_plane_adjoint, plane, g.basis, &at,
                    g.numbers.data(), &g.executor);
    check_arguments("plane, displacement, ?from, to, ?executor", hm_plane_spread, plane, &g.still,
                    &at, &to, &g.executor);
    check_arguments("plane, dj, plane_dj, ?executor", hm_plane_gather, plane, &at, &g.to,
                    &g.executor);
}

TEST_CASE("fields of moving meshes") {
    Given g;
    std::int64_t entries = 0;
    check_arguments("mesh, n", hm_swept_count, &g.mesh, &entries);
    std::vector<double> sides(static_cast<std::size_t>(entries)), duals(sides),
        halves(2 * sides.size());
    check_arguments("mesh, ?from, to, ?sides, ?duals, ?halves, ?executor", hm_swept_areas, &g.mesh,
                    &g.at, &g.at, sides.data(), duals.data(), halves.data(), &g.executor);

    std::int32_t const marker = g.setup.conditions[0].marker;
    check_arguments("analysis, -, markers, ?bytes", fixtures::walls_size, g.analysis, 1, &marker,
                    &g.bytes);
    Guarded block(g.bytes);
    hm_walls* walls = nullptr;
    hm_walls_info info = sized<hm_walls_info>();
    check_arguments("walls, memory, analysis, -, markers, ?at", hm_walls_init, &walls,
                    fixtures::Memory(block.data(), g.bytes), g.analysis, 1, &marker, &g.at);
    check_arguments("walls, at", hm_walls_move, walls, &g.at);
    check_arguments("walls, info", hm_walls_info_get, walls, &info);
    std::int32_t const n = g.setup.mesh.n_points();
    std::vector<std::int32_t> face(static_cast<std::size_t>(n));
    check_arguments("walls, -, points, ?hint, distance, ?face, ?parameter, ?executor",
                    hm_wall_distance, walls, n, &g.at, face.data(), g.numbers.data(), face.data(),
                    g.numbers.data() + n, &g.executor);
    check_arguments("walls, -, points, face, ?point_change, ?mesh_change, change",
                    hm_wall_distance_change, walls, n, &g.at, face.data(), &g.still, &g.still,
                    g.numbers.data());
    check_arguments("walls, -, points, face, dj, ?point_dj, ?mesh_dj", hm_wall_distance_adjoint,
                    walls, n, &g.at, face.data(), g.numbers.data(), &g.to, &g.to);
    check_arguments("walls, before, at, ?heights, ?ratios, ?angles", hm_first_layer, walls, &g.at,
                    &g.at, g.numbers.data(), g.numbers.data() + n, g.numbers.data() + 2 * n);

    check_arguments("analysis, -, ?bytes", fixtures::interpolation_size, g.analysis, n, &g.bytes);
    Guarded interpolation_block(g.bytes);
    hm_interpolation* interpolation = nullptr;
    hm_interpolation_report report = sized<hm_interpolation_report>();
    check_arguments("interpolation, memory, analysis, ?at, -, to, ?distance, ?executor, ?report",
                    hm_interpolation_init, &interpolation,
                    fixtures::Memory(interpolation_block.data(), g.bytes), g.analysis, &g.at, n,
                    &g.at, g.numbers.data(), &g.executor, &report);
    check_arguments("interpolation, -, from, to, ?executor", hm_interpolate, interpolation, 1,
                    g.x.data(), g.numbers.data(), &g.executor);
    check_arguments("interpolation, -, to_dj, from_dj", hm_interpolate_adjoint, interpolation, 1,
                    g.x.data(), g.numbers.data());
}

TEST_CASE("structured blocks in arrays of their own") {
    Blocks const blocks = o_blocks(3, 4, 2, 1, 3);
    hm_mesh const mesh = blocks.view();
    std::vector<double> x = blocks.x, y = blocks.y;
    hm_block_points const from{x.data(), y.data(), 1, 0};
    hm_block_points_out const to{x.data(), y.data(), 1, 0};
    hm_points const all{blocks.x.data(), blocks.y.data(), 1};
    std::vector<double> all_x = x, all_y = y;
    hm_points_out const all_out{all_x.data(), all_y.data(), 1};
    check_arguments("mesh, -, -, -, to", hm_blocks_gather, &mesh, 0, 1, &from, &all_out);
    check_arguments("mesh, -, -, from, -", hm_blocks_scatter, &mesh, 0, 1, &all, &to);
    CHECK(hm_blocks_gather(&mesh, 0, 1, nullptr, &all_out, nullptr) == HM_BAD_ARGUMENT);
    CHECK(hm_blocks_scatter(&mesh, 0, 1, &all, nullptr, nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("a part of a mesh, and its equations") {
    for (bool const given : {false, true}) {
        Case setup = given ? given_instead(tiny_case()) : tiny_case();
        std::vector<PartOfMesh> parts = cut(setup.mesh, stripes(setup.mesh, 1), false);
        PartOfMesh& whole = parts[0];
        Options const options = laplace();
        hm_problem problem = setup.problem();
        problem.mesh = nullptr;
        hm_mesh const mesh = whole.mesh.view();
        hm_private_part_mesh of_part = sized<hm_private_part_mesh>();
        of_part.mesh = &mesh;
        of_part.numbers = whole.numbers.data();
        hm_private_part* part = nullptr;
        std::size_t bytes = 0;
        check_arguments("mesh, ?bytes", hm_private_part_size, &of_part, &bytes);
        Guarded block(bytes);
        check_arguments("part, block, bytes, mesh", hm_private_part_init, &part, block.data(),
                        bytes, &of_part);
        hm_mesh own = sized<hm_mesh>();
        const std::int32_t* cell = nullptr;
        std::vector<std::uint8_t> role(whole.numbers.size());
        check_arguments("part, own, cell", hm_private_part_cells, part, &own, &cell);
        check_arguments("part, role", hm_private_part_points, part, role.data());
        std::vector<hm_private_edge> edges(200);
        std::int32_t n_edges = 0;
        check_arguments("part, edges, -, n", hm_private_part_edges, part, edges.data(), 200,
                        &n_edges);
        std::int64_t n_open = n_edges;
        check_arguments("edges, n", hm_private_match_edges, edges.data(), &n_open);
        hm_private_equations* equations = nullptr;
        hm_private_equations_info info = sized<hm_private_equations_info>();
        check_arguments("part, -, problem, ?options, ?bytes", hm_private_equations_size, part,
                        n_edges, &problem, &options, &bytes);
        Guarded of_equations(bytes);
        check_arguments("equations, block, bytes, part, -, edges, problem, ?options",
                        hm_private_equations_init, &equations, of_equations.data(), bytes, part,
                        n_edges, edges.data(), &problem, &options);
        check_arguments("equations, info", hm_private_equations_info_get, equations, &info);
        std::vector<std::int32_t> row(2000), column(2000);
        std::vector<double> values(2000), numbers(2000), work(2000), residual(2000);
        std::int64_t n = 0;
        check_arguments("equations, -, -, row, column, values, -, n_entries",
                        hm_private_equations_entries, equations, 0, info.unknowns, row.data(),
                        column.data(), values.data(), std::int64_t{2000}, &n);
        if (given) {
            std::vector<double> x = whole.mesh.x, y = whole.mesh.y;
            hm_points const wall{x.data(), y.data(), 1};
            std::vector<double> to_x(x.size() + 1, -7), to_y = to_x;
            hm_points_out const to{to_x.data(), to_y.data(), 1};
            check_arguments("equations, displacement, work, right_hand_sides",
                            hm_private_field_init, equations, &wall, work.data(), numbers.data());
            for (double const bad : {std::numeric_limits<double>::quiet_NaN(), 2e100}) {
                std::vector<double> wrong = whole.mesh.x;
                std::size_t const at = std::size_t(
                    std::find(whole.global_point.begin(), whole.global_point.end(), 16) -
                    whole.global_point.begin());
                wrong[at] = bad;  // on the body; elsewhere nothing is read
                hm_points const spoiled{wrong.data(), y.data(), 1};
                hm_error error{};
                CHECK(hm_private_field_init(equations, &spoiled, work.data(), numbers.data(),
                                            &error) == HM_BAD_ARGUMENT);
                CHECK(std::string(error.text) == "the displacement of point " + std::to_string(at) +
                                                     " is not finite or beyond 1e100");
            }
            check_arguments("equations, work, values, residuals", hm_private_field_residual,
                            equations, work.data(), values.data(), residual.data());
            check_arguments("equations, work, values, displacement", hm_private_field_finish,
                            equations, work.data(), values.data(), &to);
            CHECK(to_x.back() == -7);  // not one number more than there are points
            CHECK(to_y.back() == -7);
            continue;
        }
        hm_basis* rows = nullptr;
        check_arguments("equations, ?bytes", hm_private_rows_size, equations, &bytes);
        Guarded of_rows(bytes);
        check_arguments("rows, block, bytes, equations", hm_private_rows_init, &rows,
                        of_rows.data(), bytes, equations);
        check_arguments("equations, basis, -, numbers", hm_private_rows_get, equations, rows, 0,
                        numbers.data());
        check_arguments("equations, basis, -, numbers", hm_private_rows_set, equations, rows, 0,
                        numbers.data());
        check_arguments("equations, basis, -, residual", hm_private_rows_residual, equations, rows,
                        0, residual.data());
        check_arguments("equations, basis, -", hm_private_rows_finish, equations, rows, 1.0);
    }
}
