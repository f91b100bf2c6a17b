// Meshes of several structured blocks: O-, C- and H-topologies against the same meshes with one
// point for each place.
#include <harmorph_space.h>

#include <fixtures/blocks.hpp>
#include <fixtures/bodies.hpp>
#include <fixtures/solved.hpp>

#include <limits>

using namespace fixtures;

namespace {

struct Topology {
    const char* name;
    Blocks blocks;
    CurveSet curves;
    std::int32_t loops;
};

std::vector<Topology> topologies() {
    std::vector<Topology> out;
    out.push_back({"O, 6 blocks", o_blocks(3, 8, 5, 0.5, 3), {}, 2});
    out.back().curves = ring(3, 8, 0.5, 0.5);
    out.push_back({"O, 4 blocks", o_blocks(2, 12, 5, 0.5, 3), {}, 2});
    out.back().curves = ring(2, 9, 0.5, 0.5);
    Case airfoil = airfoil_case(12, 8, Cells::quads);
    Naca4 naca;
    naca.camber = 0.02;
    out.push_back({"C, 8 blocks", c_blocks(c_mesh(naca4(naca, 12), 6, 4, stretched(1e-2, 4, 9))),
                   airfoil.curves, 2});
    out.push_back({"H, 8 blocks", h_blocks(6), polyline({{1, 1}, {2, 1}, {2, 2}, {1, 2}}), 2});
    return out;
}

hm_mesh_report report_of(hm_mesh const& mesh) {
    auto problem = sized<hm_problem>();
    problem.mesh = &mesh;
    Attempt attempt;
    INFO(attempt.error.text);
    REQUIRE(attempt.analyse(problem));
    auto out = sized<hm_mesh_report>();
    REQUIRE(hm_analysis_report(attempt.analysis, &out, nullptr) == HM_OK);
    return out;
}

}  // namespace

TEST_CASE("interfaces of blocks close, and functions are those of the mesh with joined points") {
    for (Topology& topology : topologies()) {
        CAPTURE(topology.name);
        std::vector<std::int32_t> number;
        Case joined;
        joined.mesh = topology.blocks.joined(number);
        joined.curves = topology.curves;
        joined.put_on_curves(body);
        hm_mesh const blocks = topology.blocks.view();
        hm_mesh_report const in_blocks = report_of(blocks), in_one = report_of(joined.mesh_view());
        CHECK(in_blocks.cells == in_one.cells);
        CHECK(in_blocks.boundary_edges == in_one.boundary_edges);
        CHECK(in_blocks.boundary_loops == topology.loops);
        CHECK(in_blocks.edges == in_one.edges);
        CHECK(in_blocks.inverted == 0);
        for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
            Options options = laplace();
            options.operator_kind = kind;
            Solved const one(joined, &options), several(joined.problem(blocks), &options);
            std::int32_t const numbers = several.info().numbers_per_value;
            double worst = 0;
            for (std::int32_t i = 0; i < several.info().functions; ++i) {
                for (std::int32_t n = 0; n < numbers; ++n) {
                    std::vector<double> const a = values_of(several.basis, i, n),
                                              b = values_of(one.basis, i, n);
                    for (std::size_t k = 0; k < a.size(); ++k) {
                        worst = std::max(worst, std::fabs(a[k] - b[std::size_t(number[k])]));
                    }
                }
            }
            CHECK(worst < 1e-11);
            // Points at one place stay at one place, bit by bit.
            std::vector<double> const move = some_move(several.info().functions, 0.02, 4);
            std::vector<double> x = topology.blocks.x, y = topology.blocks.y;
            REQUIRE(hm_morph(several.basis, move.data(), &blocks.points, points_out(x, y), nullptr,
                             nullptr) == HM_OK);
            bool together = true;
            std::vector<std::size_t> first(joined.mesh.x.size(), x.size());
            for (std::size_t k = 0; k < x.size(); ++k) {
                std::size_t& other = first[std::size_t(number[k])];
                if (other == x.size()) other = k;
                together = together && x[k] == x[other] && y[k] == y[other];
            }
            CHECK(together);
            CHECK(x != topology.blocks.x);
        }
    }
}

TEST_CASE("blocks have the right numbers in reports, for both index bases, and when saved") {
    Blocks const blocks = h_blocks(4);
    Case setup;
    setup.curves = polyline({{1, 1}, {2, 1}, {2, 2}, {1, 2}});
    setup.put_on_curves(body);
    for (std::int32_t const base : {0, 1}) {
        hm_mesh mesh = blocks.view();
        mesh.index_base = base;
        std::vector<double> x = blocks.x, y = blocks.y;
        Solved const solved(setup.problem(mesh));
        // The point (1, 1) of the last block goes to where its cell is turned over.
        std::int32_t const first = 7 * 25, point = first + 1 + 5;
        x[std::size_t(point)] += 10;
        hm_quality_report const quality = quality_of(solved.basis, mesh, Moved{x, y});
        CHECK(quality.inverted >= 2);
        CHECK(quality.first_inverted == 7 * 16 + base);
        const hm_basis* attached = nullptr;
        hm_basis_info const info = solved.info();
        std::size_t const bytes = std::size_t(info.bytes);
        CHECK(hm_basis_attach(&attached, solved.basis, bytes, &mesh, nullptr) == HM_OK);
        std::vector<std::int32_t> sizes = blocks.sizes, markers = blocks.markers;
        markers[0] = 77;
        mesh.block_markers = markers.data();
        CHECK(hm_basis_attach(&attached, solved.basis, bytes, &mesh, nullptr) == HM_BAD_BASIS);
    }
}

TEST_CASE("a side that is partly a cut has lists, and a marker on a side means the same as faces") {
    Naca4 const naca;
    CMesh const c = c_mesh(naca4(naca, 12), 6, 4, stretched(1e-2, 4, 9));
    Blocks one;
    one.add(c.ni, c.nj, [&](std::int32_t i, std::int32_t j) { return c.mesh.point(i + c.ni * j); },
            {far_field, far_field, HM_NO_MARKER, far_field});
    hm_mesh mesh = one.view();
    std::vector<std::int32_t> list;
    for (std::int32_t i = c.n_wake; i < c.ni - c.n_wake; ++i) list.push_back(i);
    std::int32_t const start[] = {0, std::int32_t(list.size())}, marker = body;
    mesh.n_lists = 1;
    mesh.list_start = start;
    mesh.list_points = list.data();
    mesh.list_markers = &marker;
    hm_mesh_report const from_blocks = report_of(mesh), from_faces = report_of(c.structured_view());
    CHECK(from_blocks.boundary_edges == from_faces.boundary_edges);
    CHECK(from_blocks.boundary_loops == from_faces.boundary_loops);
    CHECK(from_blocks.edges == from_faces.edges);
}

TEST_CASE("blocks that are wrong are refused") {
    Blocks const good = o_blocks(2, 8, 3, 0.5, 2);
    auto refused = [&](hm_status status, const char* words, auto change) {
        Blocks blocks = good;
        hm_mesh mesh = blocks.view();
        change(blocks, mesh);
        auto problem = sized<hm_problem>();
        problem.mesh = &mesh;
        Attempt attempt;
        attempt.analyse(problem);
        INFO(attempt.error.text);
        CHECK(attempt.status == status);
        CHECK(says(attempt.error, words));
    };
    REQUIRE(report_of(good.view()).inverted == 0);
    refused(HM_BAD_MESH, "block 1 has ni or nj below 2", [](Blocks& b, hm_mesh& m) {
        b.sizes[2] = 1;
        m.n_cells = 80;
    });
    refused(HM_BAD_MESH, "points, but mesh.n_points is",
            [](Blocks& b, hm_mesh&) { b.sizes[0] += 1; });
    refused(HM_BAD_MESH, "cells, but mesh.n_cells is", [](Blocks&, hm_mesh& m) { m.n_cells = 5; });
    refused(HM_BAD_MESH, "has a cell on one side only and no marker",
            [](Blocks& b, hm_mesh&) { b.markers[2] = HM_NO_MARKER; });
    refused(HM_BAD_MESH, "of edges without a marker are",
            [](Blocks& b, hm_mesh&) { b.x[0] *= 1 + 1e-9; });
    refused(HM_BAD_MESH, "more than two cells", [](Blocks& b, hm_mesh& m) {  // a block twice
        b.sizes.insert(b.sizes.end(), {b.sizes[0], b.sizes[1]});
        std::size_t const n = std::size_t(b.sizes[0] * b.sizes[1]);
        for (std::vector<double>* values : {&b.x, &b.y}) {
            std::vector<double> const first(values->begin(),
                                            values->begin() + static_cast<std::ptrdiff_t>(n));
            values->insert(values->end(), first.begin(), first.end());
        }
        b.markers.insert(b.markers.end(), 4, HM_NO_MARKER);
        m = b.view();
    });
}

TEST_CASE("blocks with ghost points or j as the faster index are gathered and scattered") {
    Blocks const blocks = o_blocks(3, 8, 5, 0.5, 3);
    hm_mesh const mesh = blocks.view();
    std::size_t const n = blocks.x.size();
    std::int32_t const count = mesh.n_blocks;
    struct Array {
        std::vector<double> x, y;
        std::int64_t stride, row, begin;
    };
    std::vector<Array> arrays;
    std::vector<hm_block_points> in;
    std::vector<hm_block_points_out> out;
    for (std::int32_t b = 0; b < count; ++b) {
        std::int64_t const ni = mesh.block_sizes[2 * b], nj = mesh.block_sizes[2 * b + 1];
        Array a;
        if (b % 2 == 0) a = {{}, {}, 1, ni + 2, ni + 3};  // one layer of ghost points
        else a = {{}, {}, nj, 1, 0};
        a.x.assign(std::size_t((ni + 2) * (nj + 2)), -7);
        a.y = a.x;
        arrays.push_back(a);
    }
    for (Array& a : arrays) {
        in.push_back({a.x.data() + a.begin, a.y.data() + a.begin, a.stride, a.row});
        out.push_back({a.x.data() + a.begin, a.y.data() + a.begin, a.stride, a.row});
    }
    REQUIRE(hm_blocks_scatter(&mesh, 0, count, points_in(blocks.x, blocks.y), out.data(),
                              nullptr) == HM_OK);
    std::size_t point = 0, wrong = 0;
    for (std::int32_t b = 0; b < count; ++b) {
        std::size_t touched = 0;
        for (std::int64_t j = 0; j < mesh.block_sizes[2 * b + 1]; ++j) {
            for (std::int64_t i = 0; i < mesh.block_sizes[2 * b]; ++i, ++point, ++touched) {
                hm_block_points const& points = in[std::size_t(b)];
                wrong += points.x[i * points.stride + j * points.row] != blocks.x[point];
                wrong += points.y[i * points.stride + j * points.row] != blocks.y[point];
            }
        }
        std::vector<double> const& all = arrays[std::size_t(b)].x;
        CHECK(std::size_t(std::count(all.begin(), all.end(), -7)) == all.size() - touched);
    }
    CHECK(point == n);
    CHECK(wrong == 0);
    std::vector<double> x(n), y(n);
    REQUIRE(hm_blocks_gather(&mesh, 0, count, in.data(), points_out(x, y), nullptr) == HM_OK);
    CHECK(x == blocks.x);
    CHECK(y == blocks.y);
    // One block alone: the others stay.
    x.assign(n, 0);
    REQUIRE(hm_blocks_gather(&mesh, 1, 1, &in[1], points_out(x, y), nullptr) == HM_OK);
    std::size_t const first = std::size_t(mesh.block_sizes[0] * mesh.block_sizes[1]);
    std::size_t const last = first + std::size_t(mesh.block_sizes[2] * mesh.block_sizes[3]);
    for (std::size_t k = 0; k < n; ++k) {
        if (x[k] != (k >= first && k < last ? blocks.x[k] : 0)) ++wrong;
    }
    CHECK(wrong == 0);

    // Refused, and nothing is written.
    std::vector<double> const before = x;
    hm_error error{};
    hm_block_points bad = in[0];
    // Distances that no array has, also those whose products do not fit into 64 bits.
    std::int64_t const least = std::numeric_limits<std::int64_t>::min(),
                       most = std::numeric_limits<std::int64_t>::max(),
                       limit = std::int64_t{1} << 40;
    struct Distances {
        std::int64_t stride, row;
    };
    for (Distances const distances : {Distances{-1, 0},
                                      {least, 0},
                                      {least, least},
                                      {most, 0},
                                      {most, most},
                                      {1, most},
                                      {1, least},
                                      {1, -1},
                                      {limit + 1, 1},
                                      {1, limit + 1},
                                      {limit, 0},
                                      {most / 2, 3}}) {
        bad = in[0];
        bad.stride = distances.stride;
        bad.row = distances.row;
        hm_block_points_out bad_out = out[0];
        bad_out.stride = distances.stride;
        bad_out.row = distances.row;
        INFO(distances.stride << ", " << distances.row);
        CHECK(hm_blocks_gather(&mesh, 0, 1, &bad, points_out(x, y), &error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text) ==
              "stride or row of block 0 is negative, beyond 2^40, or puts two points at one place");
        CHECK(hm_blocks_scatter(&mesh, 0, 1, points_in(blocks.x, blocks.y), &bad_out, &error) ==
              HM_BAD_ARGUMENT);
    }
    hm_mesh none = mesh;
    none.n_points += 1;
    CHECK(hm_blocks_gather(&none, 0, 1, in.data(), points_out(x, y), &error) == HM_BAD_MESH);
    none = mesh;
    none.cell_layout = HM_CELLS_QUADS;
    none.n_blocks = 0;
    none.n_cells = 1;
    CHECK(hm_blocks_gather(&none, 0, 1, in.data(), points_out(x, y), &error) == HM_BAD_ARGUMENT);
    CHECK(x == before);
}
