// The kind of every point is the strongest condition of its markers, or inside.
#include <fixtures/o_mesh.hpp>
#include <fixtures/core.hpp>

using namespace fixtures;
using harmorph::Index;
using harmorph::PointKind;

namespace {

int count(Analysed const& seen, PointKind kind) {
    return int(std::count(seen->kinds().begin(), seen->kinds().end(), kind));
}

}  // namespace

TEST_CASE("markers without a condition are fixed, and all other points are inside") {
    Case setup = tiny_case();
    setup.mesh.add_point({3, 3});  // used by no cell
    Analysed const seen(setup);
    CHECK(count(seen, PointKind::on_wall) == 8);
    CHECK(count(seen, PointKind::fixed) == 24);
    CHECK(count(seen, PointKind::inside) == 16);
    CHECK(count(seen, PointKind::free) == 0);
    CHECK(seen->kinds()[48] == PointKind::unused);
    CHECK(seen->graph().n == 16);
}

TEST_CASE("a point on several markers is on a curve first, then fixed, then free") {
    Case setup;
    setup.mesh = square(6);
    setup.curves = polyline({{0, 0}, {1, 0}, {1, -1}, {0, -1}});
    setup.put_on_curves(bottom);
    setup.set_free(right);
    setup.set_free(top);
    for (int order = 0; order < 2; ++order) {  // whichever is named first
        Analysed const seen(setup);
        CHECK(seen->kinds()[0] == PointKind::on_wall);  // bottom and left, which is fixed
        CHECK(seen->kinds()[6] == PointKind::on_wall);  // bottom and right, which is free
        CHECK(seen->kinds()[42] == PointKind::fixed);   // left and top
        CHECK(seen->kinds()[48] == PointKind::free);    // right and top
        CHECK(seen->kinds()[7] == PointKind::fixed);
        CHECK(seen->kinds()[13] == PointKind::free);
        CHECK(count(seen, PointKind::on_wall) == 7);
        CHECK(count(seen, PointKind::fixed) == 6);
        CHECK(count(seen, PointKind::free) == 11);
        CHECK(seen->graph().n == 25 + 11);
        std::reverse(setup.conditions.begin(), setup.conditions.end());
    }
}

TEST_CASE("joined points are one unknown, and their other names count as unused") {
    CMesh const c = c_mesh(naca4({}, 24), 12, 8, stretched(5e-3, 8, 12));
    Case setup = airfoil_case(24, 12);
    setup.mesh = c.mesh;
    Analysed const seen(setup);
    CHECK(count(seen, PointKind::unused) == c.n_wake + 1);
    CHECK(count(seen, PointKind::on_wall) == 48);
    CHECK(seen->kinds()[c.n_wake] == PointKind::on_wall);  // the trailing edge
    CHECK(seen->kinds()[1] == PointKind::inside);          // on the wake
    CHECK(seen->kinds()[0] == PointKind::fixed);           // where the wake meets the far field
}

TEST_CASE("the graph couples every pair of unknowns that share a cell, and no others") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = two_body_case(kind, 6, 4);
        setup.set_free(far_field);
        renumber_points(setup.mesh, 3);
        Analysed const seen(setup);
        harmorph::Graph const& graph = seen->graph();
        std::vector<std::pair<int, int>> expected, found;
        std::vector<char> near_wall(std::size_t(graph.n), 0);
        harmorph::Mesh const mesh = core_mesh(setup.mesh);
        for (harmorph::Index i = 0; i < mesh.n_cells; ++i) {
            harmorph::Cell const cell = mesh.cell(i);
            for (int a = 0; a < cell.n; ++a)
                for (int b = 0; b < cell.n; ++b) {
                    harmorph::Index const u = graph.unknown[cell.point[a]],
                                          v = graph.unknown[cell.point[b]];
                    if (u != harmorph::none && v != harmorph::none && u != v)
                        expected.push_back({u, v});
                    if (u != harmorph::none && seen->kinds()[cell.point[b]] == PointKind::on_wall)
                        near_wall[std::size_t(u)] = 1;
                }
        }
        std::sort(expected.begin(), expected.end());
        expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
        for (harmorph::Index u = 0; u < graph.n; ++u) {
            for (harmorph::Index const v : graph.neighbours(u)) found.push_back({u, v});
            CHECK(graph.unknown[graph.line[u]] == u);
            if (u > 0) CHECK(graph.point(u) > graph.point(u - 1));
            CHECK(graph.beside_curve[u] == near_wall[std::size_t(u)]);
        }
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
    }
}

TEST_CASE("given displacements rank after curves and bodies and before fixed markers") {
    Case setup;
    setup.mesh = square(6);
    setup.set_given(bottom);
    setup.set_free(right);
    setup.set_free(top);
    Analysed const alone(setup);
    CHECK(alone->kinds()[0] == PointKind::on_wall);  // bottom and left, which is fixed
    CHECK(alone->kinds()[6] == PointKind::on_wall);  // bottom and right, which is free
    CHECK(alone->wall().count == 7);
    CHECK(alone->count_wall_faces() == 6);
    CHECK(alone->basis_counts().functions() == 0);

    setup.set_rigid(left, 0, 0.5);
    Analysed const beside_body(setup);
    REQUIRE(beside_body->wall().count == 13);
    for (Index slot = 0; slot < 13; ++slot)
        CHECK(beside_body->wall().curve[slot] ==
              (beside_body->wall().point[slot] % 7 == 0 ? 0 : 1));
}
