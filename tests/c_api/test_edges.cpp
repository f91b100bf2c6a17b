// Meshes given as edges: the cells that the edges form are those of the mesh.
#include <doctest/doctest.h>
#include <harmorph_space.h>

#include <fixtures/bodies.hpp>
#include <fixtures/memory.hpp>

#include <algorithm>
#include <map>

using namespace fixtures;

namespace {

// The edges of a mesh, as an edge-based code has them.
struct EdgeList {
    std::vector<std::int32_t> points, cells, markers;
    hm_edge_mesh view{};

    explicit EdgeList(hm_mesh const& mesh) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> known;
        for (std::int32_t cell = 0; cell < mesh.n_cells; ++cell) {
            std::int32_t const begin = mesh.cell_start[cell] - mesh.index_base;
            std::int32_t const n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
            for (std::int32_t k = 0; k < n; ++k) {
                add(known, mesh.cell_points[begin + k], mesh.cell_points[begin + (k + 1) % n],
                    cell + mesh.index_base, mesh.index_base);
            }
        }
        for (std::int32_t face = 0; face < mesh.n_faces; ++face) {
            auto const ends =
                std::minmax(mesh.face_points[2 * face], mesh.face_points[2 * face + 1]);
            markers[known.at(ends)] = mesh.face_markers[face];
        }
        HM_INIT(view);
        view.index_base = mesh.index_base;
        view.n_points = mesh.n_points;
        view.points = mesh.points;
        view.n_cells = mesh.n_cells;
        view.n_edges = std::int32_t(markers.size());
        view.edge_points = points.data();
        view.edge_cells = cells.data();
        view.edge_markers = markers.data();
    }

private:
    void add(std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>& known, std::int32_t a,
             std::int32_t b, std::int32_t cell, std::int32_t index_base) {
        auto const [at, is_new] = known.insert({std::minmax(a, b), markers.size()});
        if (is_new) {
            points.insert(points.end(), {a, b});
            cells.insert(cells.end(), {cell, index_base - 1});
            markers.push_back(HM_NO_MARKER);
        } else {
            cells[2 * at->second + 1] = cell;
        }
    }
};

struct Converted {
    std::vector<unsigned char> block;
    hm_mesh mesh{};
    hm_error error{};
    hm_status status;

    explicit Converted(hm_edge_mesh const& edges) {
        std::size_t bytes = 0;
        HM_INIT(mesh);
        status = fixtures::mesh_from_edges_size(&edges, &bytes, &error);
        if (status < 0) return;
        block.resize(bytes);
        status = hm_mesh_from_edges(&mesh, fixtures::Memory(block.data(), bytes), &edges, &error);
    }
};

std::vector<std::int32_t> sorted_cell(hm_mesh const& mesh, std::int32_t cell) {
    std::vector<std::int32_t> points(
        mesh.cell_points + mesh.cell_start[cell] - mesh.index_base,
        mesh.cell_points + mesh.cell_start[cell + 1] - mesh.index_base);
    std::sort(points.begin(), points.end());
    return points;
}

}  // namespace

TEST_CASE("the cells and faces of triangles and quadrilaterals are found again, and solved") {
    for (Cells const kind : {Cells::triangles, Cells::quads}) {
        Case setup = two_body_case(kind, 16, 5);
        hm_mesh const mesh = setup.mesh.view();
        EdgeList const edges(mesh);
        Converted const found(edges.view);
        INFO(found.error.text);
        REQUIRE(found.status == HM_OK);
        REQUIRE(found.mesh.n_cells == mesh.n_cells);
        CHECK(found.mesh.cell_layout == HM_CELLS_ROWS);
        CHECK(found.mesh.n_faces == mesh.n_faces);
        for (std::int32_t cell = 0; cell < mesh.n_cells; ++cell) {
            CHECK(sorted_cell(found.mesh, cell) == sorted_cell(mesh, cell));
        }
        Solved const from_edges(setup.problem(found.mesh)), from_cells(setup.problem(mesh));
        CHECK(from_edges.report.unknowns == from_cells.report.unknowns);
        CHECK(from_edges.report.residual < 1e-10);
    }
}

TEST_CASE("edges that form no cell are refused with the edge or the cell") {
    Case setup = two_body_case(Cells::quads, 16, 5);
    EdgeList const good(setup.mesh.view());
    auto const refused = [&](void (*change)(EdgeList&), const char* words) {
        EdgeList bad = good;
        bad.view.edge_points = bad.points.data();
        bad.view.edge_cells = bad.cells.data();
        bad.view.edge_markers = bad.markers.data();
        change(bad);
        Converted const found(bad.view);
        INFO(found.error.text);
        CHECK(says(found.error, words));
        return found.status;
    };
    CHECK(refused([](EdgeList& e) { e.points[3] = 1000000; }, "does not exist") == HM_BAD_MESH);
    CHECK(refused([](EdgeList& e) { e.cells[4] = 1000000; }, "does not exist") == HM_BAD_MESH);
    CHECK(refused([](EdgeList& e) { e.cells[1] = e.cells[0]; }, "same cell") == HM_BAD_MESH);
    CHECK(refused([](EdgeList& e) { e.points[0] = e.points[5]; }, "do not form one closed loop") ==
          HM_BAD_MESH);
    CHECK(refused([](EdgeList& e) { e.view.n_edges = 2; }, "n_edges must be between") ==
          HM_BAD_MESH);
    CHECK(refused(
              [](EdgeList& e) { e.view.struct_size = 3; },
              "edges.struct_size is not the size of an hm_edge_mesh; begin with HM_INIT(edges)") ==
          HM_BAD_ARGUMENT);
    CHECK(refused([](EdgeList& e) { e.view.n_cells += 1; }, "edges") == HM_BAD_MESH);
    CHECK(refused([](EdgeList& e) { e.view.edge_cells = nullptr; }, "NULL") == HM_BAD_ARGUMENT);
}
