// Every layout gives the same cells; wrong input is refused, and the first offender is named.
#include <fixtures/core.hpp>
#include <fixtures/mesh.hpp>
#include <fixtures/wrong.hpp>

#include <limits>

using namespace fixtures;
using harmorph::Index;
using harmorph::Status;

namespace {

bool same_cell(harmorph::Cell const& a, harmorph::Cell const& b) {
    return a.n == b.n && std::equal(a.point, a.point + a.n, b.point);
}

void check_same(hm_mesh const& first, hm_mesh const& second) {
    harmorph::Mesh const a = core_mesh(first), b = core_mesh(second);
    harmorph::Fault fault;
    CHECK(check_mesh(a, fault) == Status::ok);
    CHECK(check_mesh(b, fault) == Status::ok);
    REQUIRE(a.n_cells == b.n_cells);
    Wrong different;
    for (Index i = 0; i < a.n_cells; ++i)
        different.add(!same_cell(a.cell(i), b.cell(i)), i, a.cell(i).n);
    Index next = 0;
    a.for_each_cell([&](Index i, harmorph::Cell const& cell) {
        different.compare(next, i, next);
        different.add(!same_cell(cell, b.cell(i)), i, cell.n);
        ++next;
    });
    CHECK(next == a.n_cells);
    CHECK(different == 0);
    CHECK(a.find_cell([&](Index i, harmorph::Cell const&) { return i == a.n_cells - 1; }) ==
          a.n_cells - 1);
    CHECK(a.find_cell([](Index, harmorph::Cell const&) { return false; }) == harmorph::none);
    CHECK(fingerprint_of(a) == fingerprint_of(b));
    CHECK(sample_of(a) == sample_of(b));
}

harmorph::Fault refusal(harmorph::Mesh const& mesh) {
    harmorph::Fault fault;
    CHECK(failed(check_mesh(mesh, fault)));
    return fault;
}

}  // namespace

TEST_CASE("rows, triangles, quads and blocks describe the same cells") {
    for (std::int32_t const base : {0, 1}) {
        Case triangles, quads, hybrid;
        triangles.mesh = square(6, Cells::triangles);
        quads.mesh = square(6, Cells::quads);
        hybrid.mesh = square(6, Cells::hybrid, 2, 2);
        for (Case* setup : {&triangles, &quads, &hybrid}) setup->index_base = base;

        hm_mesh fixed = triangles.mesh_view();
        fixed.cell_layout = HM_CELLS_TRIANGLES;
        fixed.cell_start = nullptr;
        check_same(fixed, triangles.mesh.view());
        fixed = quads.mesh_view();
        fixed.cell_layout = HM_CELLS_QUADS;
        fixed.cell_start = nullptr;
        check_same(fixed, quads.mesh.view());

        for (Case* setup :
             {&triangles, &hybrid}) {  // width 4, the last point of a triangle repeated
            std::vector<std::int32_t> wide = quads_of(setup->mesh);
            for (std::int32_t& point : wide) point += base;
            hm_mesh view = setup->mesh_view();
            view.cell_layout = HM_CELLS_QUADS;
            view.cell_start = nullptr;
            view.cell_points = wide.data();
            check_same(view, setup->mesh.view());
            // Rows may hold such triangles, too.
            std::vector<std::int32_t> starts;
            for (std::int32_t k = 0; k <= setup->mesh.n_cells(); ++k)
                starts.push_back(4 * k + base);
            view.cell_layout = HM_CELLS_ROWS;
            view.cell_start = starts.data();
            check_same(view, setup->mesh.view());
        }

        hm_mesh block = quads.mesh_view();
        block.cell_layout = HM_CELLS_STRUCTURED;
        block.cell_start = block.cell_points = nullptr;
        block.ni = block.nj = 7;
        check_same(block, quads.mesh.view());
        block.n_cells = 0;  // may be left out
        check_same(block, quads.mesh.view());
    }
}

TEST_CASE("triangles and quads in two arrays describe the same cells, triangles first") {
    for (std::int32_t const base : {0, 1}) {
        Case setup;
        setup.index_base = base;
        for (Cells const kind : {Cells::triangles, Cells::quads, Cells::hybrid}) {
            Mixed const mixed(square(6, kind, 2, 2), base);
            setup.mesh = mixed.rows;
            hm_mesh view = mixed.put_into(setup.mesh_view());
            if (kind == Cells::triangles) view.quad_points = nullptr;
            if (kind == Cells::quads) view.cell_points = nullptr;
            check_same(view, setup.mesh.view());
        }
        // All cells as quads, the last point of a triangle repeated.
        setup.mesh = square(6, Cells::hybrid, 2, 2);
        std::vector<std::int32_t> wide = quads_of(setup.mesh);
        for (std::int32_t& point : wide) point += base;
        hm_mesh view = setup.mesh_view();
        view.cell_layout = HM_CELLS_MIXED;
        view.cell_start = view.cell_points = nullptr;
        view.n_quads = setup.mesh.n_cells();
        view.quad_points = wide.data();
        check_same(view, setup.mesh.view());
    }
}

TEST_CASE("blocks that are not square have i as the fastest index") {
    hm_mesh view{};
    std::vector<double> const zero(15, 0.0);
    view.struct_size = sizeof view;
    view.cell_layout = HM_CELLS_STRUCTURED;
    view.n_points = 15;
    view.ni = 5;
    view.nj = 3;
    view.points = {zero.data(), zero.data(), 1};
    harmorph::Mesh const mesh = core_mesh(view);
    CHECK(mesh.n_cells == 8);
    for (Index j = 0; j < 2; ++j)
        for (Index i = 0; i < 4; ++i) {
            Index const a = i + 5 * j;
            CHECK(same_cell(mesh.cell(i + 4 * j), {4, {a, a + 1, a + 6, a + 5}}));
        }
}

TEST_CASE("coordinates may have any stride, and a stride of 0 means 1") {
    Mesh const mesh = square(6, Cells::hybrid, 2, 2);
    std::vector<double> structs;
    for (std::size_t k = 0; k < mesh.x.size(); ++k)
        structs.insert(structs.end(), {-1, mesh.y[k], -2, mesh.x[k]});
    hm_mesh view = mesh.view();
    view.points = {structs.data() + 3, structs.data() + 1, 4};
    harmorph::Mesh const strided = core_mesh(view);
    for (Index k = 0; k < mesh.n_points(); ++k) {
        CHECK(strided.points[k].x == mesh.point(k).x);
        CHECK(strided.points[k].y == mesh.point(k).y);
    }
    CHECK(coordinates_fingerprint(strided.points, mesh.n_points()) ==
          coordinates_fingerprint(core_mesh(mesh).points, mesh.n_points()));
    view = mesh.view();
    view.points.stride = 0;
    CHECK(core_mesh(view).points.stride == 1);
}

TEST_CASE("the first of several offenders is named") {
    Mesh mesh = square(6, Cells::hybrid, 2, 2);
    Mesh const good = mesh;
    mesh.cells[5] = 99;
    mesh.cells[11] = -3;
    harmorph::Fault fault = refusal(core_mesh(mesh));
    CHECK(fault.status == Status::bad_mesh);
    CHECK(fault.item.number == 1);
    CHECK(fault.other.number == 99);
    CHECK(fault.item.kind == harmorph::ItemKind::cell);
    mesh = good;
    mesh.cells[13] = mesh.cells[12];
    mesh.cells[30] = mesh.cells[28];
    fault = refusal(core_mesh(mesh));
    CHECK(fault.item.number == 3);
    CHECK(fault.other.number == mesh.cells[12]);
    mesh = good;
    mesh.y[40] = mesh.x[22] = std::numeric_limits<double>::infinity();
    fault = refusal(core_mesh(mesh));
    CHECK(fault.item.number == 22);
    mesh = good;
    mesh.faces[9] = 48;
    mesh.faces[20] = 48;
    fault = refusal(core_mesh(mesh));
    CHECK(fault.item.number == 4);
    CHECK(fault.other.number == 48);
    mesh = good;
    mesh.cell_start[4] = 18;  // cell 3 has 6 points
    fault = refusal(core_mesh(mesh));
    CHECK(fault.item.number == 3);
    CHECK(fault.value == 6);
    mesh.cell_start[4] = mesh.cell_start[3];
    fault = refusal(core_mesh(mesh));
    CHECK(fault.item.number == 3);
    CHECK(fault.value == 0);
}

TEST_CASE("areas of cells are right in both senses") {
    double const xy[] = {0, 0, 2, 0, 3, 2, 0, 1};
    harmorph::Points const points{xy, xy + 1, 2};
    harmorph::Cell const quad{4, {0, 1, 2, 3}}, triangle{3, {0, 1, 2}}, backwards{4, {3, 2, 1, 0}};
    CHECK(cell_area(triangle, points) == 2);
    CHECK(cell_area(quad, points) == 3.5);  // shoelace
    CHECK(cell_area(backwards, points) == -3.5);
}
