// The boundary comes out as closed loops with the mesh on the left, however it was given.
#include <fixtures/o_mesh.hpp>
#include <fixtures/core.hpp>

#include <set>

using namespace fixtures;

namespace {

using Faces = std::multiset<std::pair<std::int32_t, std::int32_t>>;

Faces faces_of(harmorph::Boundary const& boundary) {
    Faces out;
    for (std::int32_t loop = 0; loop < boundary.n_loops; ++loop)
        for (std::int32_t k = boundary.loop_start[loop]; k < boundary.loop_start[loop + 1]; ++k)
            out.insert({boundary.point[k], boundary.point[boundary.after(k, loop)]});
    return out;
}

// The area that the loops enclose: of the mesh, if it lies on their left.
double enclosed(harmorph::Boundary const& boundary, Mesh const& mesh) {
    double sum = 0;
    for (auto const& [a, b] : faces_of(boundary))
        sum += 0.5 * (mesh.point(a).x * mesh.point(b).y - mesh.point(b).x * mesh.point(a).y);
    return sum;
}

// Boundary lists that say the same as the faces: runs of one marker along the loops.
struct Lists {
    std::vector<std::int32_t> start{0}, points, markers;
    explicit Lists(harmorph::Boundary const& boundary) {
        for (std::int32_t loop = 0; loop < boundary.n_loops; ++loop)
            for (std::int32_t k = boundary.loop_start[loop]; k < boundary.loop_start[loop + 1];
                 ++k) {
                bool const goes_on =
                    k > boundary.loop_start[loop] && boundary.marker[k] == boundary.marker[k - 1];
                if (!goes_on) {
                    if (!points.empty()) start.push_back(std::int32_t(points.size()));
                    points.push_back(boundary.point[k]);
                    markers.push_back(boundary.marker[k]);
                }
                points.push_back(boundary.point[boundary.after(k, loop)]);
            }
        start.push_back(std::int32_t(points.size()));
    }
    void put_into(hm_mesh& mesh) const {
        mesh.n_faces = 0;
        mesh.face_points = mesh.face_markers = nullptr;
        mesh.n_lists = std::int32_t(markers.size());
        mesh.list_start = start.data();
        mesh.list_points = points.data();
        mesh.list_markers = markers.data();
    }
};

}  // namespace

TEST_CASE("loops close, hold every face once, and have the mesh on their left") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Mesh mesh = two_bodies(8, 5, Ellipse{}, Ellipse{0.25, 0.06, 0.4}, kind);
        Faces given;
        for (std::size_t k = 0; k < mesh.faces.size(); k += 2)
            given.insert({mesh.faces[k], mesh.faces[k + 1]});
        double const area = check(mesh).area;
        for (int change = 0; change < 4; ++change) {
            if (change == 1) reverse_all(mesh);
            if (change == 2) reverse_some(mesh, 3);
            if (change == 3) reverse_some_faces(mesh, 4);  // faces need no sense
            Analysed const seen(mesh);
            CHECK(seen->boundary().n_loops == 3);
            CHECK(seen->boundary().count == mesh.n_faces());
            CHECK(faces_of(seen->boundary()) == given);
            CHECK(enclosed(seen->boundary(), mesh) == doctest::Approx(area).epsilon(1e-12));
        }
    }
}

TEST_CASE("markers stay with their faces") {
    Mesh mesh = square(6, Cells::hybrid, 2, 2);
    split_marker(mesh, body, 3, 31);
    Analysed const seen(mesh);
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> marker_of;
    for (std::size_t k = 0; k < mesh.face_markers.size(); ++k)
        marker_of[{mesh.faces[2 * k], mesh.faces[2 * k + 1]}] = mesh.face_markers[k];
    harmorph::Boundary const& b = seen->boundary();
    for (std::int32_t loop = 0; loop < b.n_loops; ++loop)
        for (std::int32_t k = b.loop_start[loop]; k < b.loop_start[loop + 1]; ++k)
            CHECK(marker_of.at({b.point[k], b.point[b.after(k, loop)]}) == b.marker[k]);
}

TEST_CASE("ordered lists of points mean the same as faces, and both may be combined") {
    Mesh const mesh = tiny_case().mesh;
    Analysed const with_faces(mesh);
    Lists const lists(with_faces->boundary());
    hm_mesh view = mesh.view();
    lists.put_into(view);
    Analysed const with_lists(view);
    CHECK(faces_of(with_lists->boundary()) == faces_of(with_faces->boundary()));
    CHECK(with_lists->boundary().n_loops == 2);

    hm_mesh both = mesh.view();
    both.n_lists = view.n_lists;
    both.list_start = lists.start.data();
    both.list_points = lists.points.data();
    both.list_markers = lists.markers.data();
    Analysed const with_both(both);  // a face given twice with one marker is one face
    CHECK(faces_of(with_both->boundary()) == faces_of(with_faces->boundary()));

    Case setup = tiny_case();
    Solved const a(setup), b(setup.problem(view));
    CHECK(largest_difference(a.sum(), b.sum()) < 1e-14);
}

TEST_CASE("the two parts of a bow-tie share one point only") {
    Mesh mesh;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) mesh.add_point({1.0 * i, 1.0 * j});
    mesh.add_cell({0, 1, 4, 3});
    mesh.add_cell({4, 5, 8, 7});
    std::int32_t const edges[][2] = {{0, 1}, {1, 4}, {4, 3}, {3, 0},
                                     {4, 5}, {5, 8}, {8, 7}, {7, 4}};
    for (auto const& edge : edges) mesh.add_face(edge[0], edge[1], body);
    Analysed const seen(mesh);
    Faces expected;
    for (auto const& edge : edges) expected.insert({edge[0], edge[1]});
    CHECK(faces_of(seen->boundary()) == expected);
    CHECK(enclosed(seen->boundary(), mesh) == 2);
    CHECK((seen->boundary().n_loops == 1 || seen->boundary().n_loops == 2));
}

TEST_CASE("pieces are runs of marked faces, across the place where a loop is cut open") {
    Mesh const mesh = square(6);
    Analysed const seen(mesh);
    for (std::int32_t const first : {bottom, right, top, left}) {
        std::int32_t const second =
            first == left ? bottom : first + 1;  // follows it counter-clockwise
        std::vector<std::vector<std::int32_t>> pieces;
        std::vector<bool> closed;
        auto const is_on = [&](std::int32_t face) {
            std::int32_t const marker = seen->boundary().marker[face];
            return marker == first || marker == second;
        };
        std::int32_t const n = seen->boundary().for_each_chain(
            is_on,
            [&](std::int32_t piece, std::int32_t point) {
                pieces.resize(std::size_t(piece) + 1);
                pieces.back().push_back(point);
            },
            [&](std::int32_t, bool is_loop) { closed.push_back(is_loop); });
        CHECK(n == 1);
        REQUIRE(pieces.size() == 1);
        CHECK(pieces[0].size() == 13);
        REQUIRE(closed.size() == 1);
        CHECK(!closed[0]);
        for (std::size_t k = 0; k + 1 < pieces[0].size(); ++k)
            CHECK(distance(mesh.point(pieces[0][k]), mesh.point(pieces[0][k + 1])) ==
                  doctest::Approx(1.0 / 6));
    }
}

TEST_CASE("the cut of a C-mesh is joined, so that both sides of the wake are one") {
    CMesh c = c_mesh(naca4({}, 24), 12, 8, stretched(5e-3, 8, 20));
    Analysed const seen(c.structured_view());
    CHECK(seen->boundary().n_loops == 2);
    CHECK(seen->boundary().count == c.mesh.n_faces());
    std::int32_t joined = 0;
    for (std::int32_t k = 0; k < c.mesh.n_points(); ++k)
        joined += seen->topology().representative[k] != k;
    CHECK(joined == c.n_wake + 1);
    for (std::int32_t k = 0; k <= c.n_wake; ++k)
        CHECK(seen->topology().representative[c.ni - 1 - k] == k);

    Case setup = airfoil_case(24, 12);
    setup.mesh = c.mesh;
    Solved const solved(setup.problem(c.structured_view()));
    CHECK(solved.report.curve_points == 48);
    for (std::int32_t i = 0; i < solved.report.functions; ++i) {
        std::vector<double> const f = solved.values(i);
        for (std::size_t k = 0; k <= std::size_t(c.n_wake); ++k)
            CHECK(f[k] == f[std::size_t(c.ni) - 1 - k]);
    }
    CHECK(solved.values(0)[std::size_t(c.n_wake)] == 1);  // the trailing edge, from below
}

TEST_CASE("the seam of an O-mesh block is joined, and functions are those of the closed mesh") {
    int const n_t = 32, n_r = 9;
    Case closed = ring_case(n_r, n_t, 0.5, 2), open = closed;
    open.mesh = Mesh{};
    for (int j = 0; j <= n_r; ++j)
        for (int i = 0; i <= n_t; ++i) open.mesh.add_point(closed.mesh.point(j * n_t + i % n_t));
    for (int i = 0; i < n_t; ++i) {
        open.mesh.add_face(i + 1, i, body);
        open.mesh.add_face(n_r * (n_t + 1) + i, n_r * (n_t + 1) + i + 1, far_field);
    }
    open.give(n_t, open.known_u[0]);  // the first point's other name
    hm_mesh view = open.mesh.view();
    view.cell_layout = HM_CELLS_STRUCTURED;
    view.n_cells = 0;
    view.ni = n_t + 1;
    view.nj = n_r + 1;
    Solved const a(closed), b(open.problem(view));
    CHECK(b.report.unknowns == a.report.unknowns);
    CHECK(b.report.curve_points == n_t);
    for (std::int32_t i = 0; i < 8; ++i) {
        std::vector<double> const expected = a.values(i), found = b.values(i);
        double worst = 0;
        for (int j = 0; j <= n_r; ++j)
            for (int k = 0; k <= n_t; ++k) {
                std::size_t const here = std::size_t(j * (n_t + 1) + k);
                worst = std::fmax(
                    worst, std::fabs(found[here] - expected[std::size_t(j * n_t + k % n_t)]));
            }
        CHECK(worst < 1e-13);
    }
    // A seam that does not quite coincide is no seam.
    open.mesh.x[std::size_t(2 * (n_t + 1))] *= 1 + 1e-9;
    view = open.mesh.view();
    view.cell_layout = HM_CELLS_STRUCTURED;
    view.n_cells = 0;
    view.ni = n_t + 1;
    view.nj = n_r + 1;
    Attempt const attempt(open.problem(view));
    CHECK(attempt.status == HM_BAD_MESH);
    CHECK(says(attempt.error, "without a marker"));
}
