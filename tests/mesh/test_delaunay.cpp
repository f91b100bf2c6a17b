// Flipped triangulations: of the same points and the same domain, and Delaunay.
#include <fixtures/core.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/wrong.hpp>
#include <fixtures/guarded.hpp>

#include "mesh/delaunay.hpp"
#include "base/predicates.hpp"

#include <set>

using namespace fixtures;
using harmorph::DelaunayEdge;
using harmorph::Index;
using harmorph::none;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// Triangulates with the results of an analysis of the mesh alone.
struct Flipped {
    Analysed seen;
    harmorph::Triangulation triangulation;
    harmorph::Status status;
    harmorph::Fault fault;

    explicit Flipped(hm_mesh const& mesh) : seen(mesh) {
        harmorph::Mesh const view = core_mesh(mesh);
        block_ = laid_out_part(triangulation, view);
        status = triangulation.build(seen->topology(), fault);
        CHECK(block_->guards_intact());
    }
    explicit Flipped(Mesh const& mesh) : Flipped(mesh.view()) {}

    harmorph::Vec2 at(Index point) const { return triangulation.mesh.points[point]; }
    // Inner edges that would have to be flipped.
    int not_delaunay() const {
        int out = 0;
        triangulation.for_each_edge([&](DelaunayEdge const& edge) {
            if (edge.right == none) return;
            out += in_circle_sign(at(edge.begin), at(edge.end), at(edge.left), at(edge.right)) > 0;
        });
        return out;
    }
    std::vector<std::int32_t> triangles() const {
        const Index* const first = triangulation.mesh.cell_points;
        return {first, first + 3 * triangulation.mesh.n_cells};
    }
    // The triangles as a mesh, with the faces of another one.
    Mesh mesh_with_faces_of(Mesh const& other) const {
        Mesh out = other;
        out.cells = triangles();
        out.cell_start.clear();
        for (Index k = 0; k <= triangulation.mesh.n_cells; ++k) out.cell_start.push_back(3 * k);
        return out;
    }

private:
    std::unique_ptr<Guarded> block_;
};

// All that must hold for any mesh. Returns the number of flips.
Index check_flipped(Mesh const& mesh) {
    Flipped const found(mesh);
    INFO(found.fault.sentence);
    REQUIRE(found.status == harmorph::Status::ok);
    MeshCheck const before = check(mesh), after = check(found.mesh_with_faces_of(mesh));
    CHECK(after.min_corner > 0);
    CHECK(after.bad_edges == 0);  // the boundary is where it was
    CHECK(after.unmarked == 0);
    CHECK(after.stray == 0);
    CHECK(after.quads == 0);
    CHECK(after.triangles == before.triangles + 2 * before.quads);
    CHECK(after.used_points == before.used_points);
    CHECK(after.euler() == before.euler());
    CHECK(after.loops == before.loops);
    CHECK(std::fabs(after.area - before.area) <= 1e-12 * before.area);
    CHECK(found.not_delaunay() == 0);
    Wrong clockwise;  // the sign of the triangle opposite of a point
    auto const add = [&](Index begin, Index end, Index opposite) {
        int const sign = orientation_sign(found.at(begin), found.at(end), found.at(opposite));
        clockwise.add(sign <= 0, opposite, sign);
    };
    found.triangulation.for_each_edge([&](DelaunayEdge const& edge) {
        add(edge.begin, edge.end, edge.left);
        if (edge.right != none) add(edge.end, edge.begin, edge.right);
    });
    CHECK(clockwise == 0);
    return found.triangulation.flips;
}

// Triangles of a fan from one corner of a convex polygon: as far from Delaunay as can be.
Mesh fan(int n, double thin) {
    Mesh mesh;
    for (int k = 0; k < n; ++k)
        mesh.add_point({std::cos(2 * pi * k / n), thin * std::sin(2 * pi * k / n)});
    for (int k = 1; k + 1 < n; ++k) mesh.add_cell({0, k, k + 1});
    for (int k = 0; k < n; ++k) mesh.add_face(k, (k + 1) % n, body);
    return mesh;
}

}  // namespace

TEST_CASE("in a convex domain no point is inside the circle of any triangle") {
    for (Cells const kind : kinds)
        for (double const thin : {1.0, 0.1, 1e-3}) {
            Mesh mesh = square(8, kind);
            perturb(mesh, 0.4, 3);
            for (double& y : mesh.y) y *= thin;
            Index const flips = check_flipped(mesh);
            CHECK((thin == 1 || flips > 0));
            Flipped const found(mesh);
            std::vector<std::int32_t> const corner = found.triangles();
            Wrong inside;  // points in the circle of a triangle
            for (std::size_t k = 0; k < corner.size(); k += 3)
                for (Index point = 0; point < mesh.n_points(); ++point) {
                    harmorph::Vec2 const a = found.at(corner[k]), b = found.at(corner[k + 1]),
                                         c = found.at(corner[k + 2]);
                    inside.add(in_circle_sign(a, b, c, found.at(point)) > 0, point, double(k / 3));
                }
            CHECK(inside == 0);
        }
}

TEST_CASE("many flips are right for fans of ellipses, also with points on one circle") {
    for (int const n : {4, 5, 40, 200})
        for (double const thin : {1.0, 0.5, 1e-2, 1e-9}) {
            Index const flips = check_flipped(fan(n, thin));
            if (thin == 0.5 && n == 200) CHECK(flips > 200);
        }
}

TEST_CASE("with points on common circles nothing is left to flip, and nothing is flipped twice") {
    for (Cells const kind : kinds) {
        Mesh mesh = square(12, kind);
        CHECK(check_flipped(mesh) == 0);
        for (double& x : mesh.x) x = 1e5 + x / 3;  // rounded: no longer on circles exactly
        check_flipped(mesh);
        for (double& y : mesh.y) y *= 1e-5;
        check_flipped(mesh);
        check_flipped(annulus(6, 24, 0.5, 2, kind, true));
    }
}

TEST_CASE("airfoils with thin layers, two bodies and holes are triangulated") {
    Naca4 const naca;
    for (Cells const kind : kinds) {
        check_flipped(o_mesh(naca4(naca, 30), stretched(1e-6, 5, 40), kind, 3));
        check_flipped(two_bodies(8, 6, Ellipse{}, Ellipse{0.25, 0.02, 0.4}, kind));
        check_flipped(square(9, kind, 3, 5));
    }
    CHECK(check_flipped(hybrid_mesh(naca4(naca, 40))) > 0);
}

TEST_CASE("coordinates of any size that is supported are triangulated") {
    for (double const scale : {0x1p-300, 0x1p300, 1e-60, 1e39}) {
        Mesh mesh = square(7, Cells::hybrid);
        perturb(mesh, 0.4, 5);
        Mesh scaled = mesh;
        for (double& x : scaled.x) x *= scale;
        for (double& y : scaled.y) y *= 1e-3 * scale;
        Flipped const found(scaled);
        REQUIRE(found.status == harmorph::Status::ok);
        CHECK(found.not_delaunay() == 0);
        CHECK(found.triangulation.flips > 0);
    }
}

TEST_CASE("numbering, order and sense of cells do not matter without points on common circles") {
    auto const edges_of = [](Mesh const& mesh, std::vector<std::int32_t> const& old_of) {
        std::set<Edge> out;
        Flipped const found(mesh);
        found.triangulation.for_each_edge([&](DelaunayEdge const& edge) {
            std::int32_t const a = old_of[std::size_t(edge.begin)];
            std::int32_t const b = old_of[std::size_t(edge.end)];
            out.insert({std::min(a, b), std::max(a, b)});
        });
        return out;
    };
    Mesh mesh = two_bodies(6, 5, Ellipse{}, Ellipse{0.2, 0.05, 0.3}, Cells::hybrid);
    perturb(mesh, 0.3, 6);
    for (double& y : mesh.y) y *= 0.2;
    std::vector<std::int32_t> same(mesh.x.size());
    std::iota(same.begin(), same.end(), 0);
    std::set<Edge> const expected = edges_of(mesh, same);
    Mesh other = mesh;
    shuffle_cells(other, 2);
    rotate_starts(other, 3);
    reverse_some(other, 4);
    CHECK(edges_of(other, same) == expected);
    std::vector<std::int32_t> const new_of = renumber_points(other, 5);
    std::vector<std::int32_t> old_of(new_of.size());
    for (std::int32_t k = 0; k < mesh.n_points(); ++k) {
        old_of[std::size_t(new_of[std::size_t(k)])] = k;
    }
    CHECK(edges_of(other, old_of) == expected);
}

TEST_CASE("the cut of a C-mesh is no boundary: its points are joined, its edges may be flipped") {
    CMesh const c = c_mesh(naca4({}, 24), 12, 6, stretched(1e-2, 6, 12));
    Flipped const rows(c.mesh), structured(c.structured_view());
    REQUIRE(rows.status == harmorph::Status::ok);
    CHECK(rows.not_delaunay() == 0);
    CHECK(rows.triangulation.flips > 0);
    CHECK(structured.triangles() == rows.triangles());
    int boundary = 0;
    rows.triangulation.for_each_edge(
        [&](DelaunayEdge const& edge) { boundary += edge.right == none; });
    CHECK(boundary == c.mesh.n_faces());
    for (std::int32_t const point : rows.triangles())
        CHECK(rows.seen->topology().representative[point] == point);
}

TEST_CASE("a cell without area is refused and named") {
    Mesh mesh = square(4, Cells::hybrid);
    mesh.x[12] = mesh.x[7];  // an inner point on another one
    mesh.y[12] = mesh.y[7];
    Flipped const found(mesh);
    CHECK(found.status == harmorph::Status::bad_mesh);
    CHECK(found.fault.item.number == 5);
}

TEST_CASE("more cells than can be split are refused before anything is read") {
    harmorph::Topology topology;
    topology.mesh.n_points = 4;
    topology.mesh.layout = harmorph::CellLayout::quads;
    topology.mesh.n_cells = harmorph::Mesh::max_cells;
    harmorph::Triangulation triangulation;
    harmorph::Fault fault;
    CHECK(triangulation.build(topology, fault) == harmorph::Status::unsupported);
    CHECK(
        std::string(fault.sentence) ==
        "the bounded scheme can split at most 2^28 cells into triangles, but the mesh has # cells");
    CHECK(fault.item.number == topology.mesh.n_cells);
}
