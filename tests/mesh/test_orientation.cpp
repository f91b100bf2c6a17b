// Cells are turned as their neighbours ask for, and the larger area is right.
#include <fixtures/core.hpp>
#include <fixtures/perturb.hpp>
#include <fixtures/mesh.hpp>

#include "mesh/cell_shape.hpp"

using namespace fixtures;
using harmorph::Index;

namespace {

std::vector<std::uint8_t> reversed_of(Analysed const& seen) {
    return {seen->topology().reversed.begin(), seen->topology().reversed.end()};
}
std::vector<std::uint8_t> all(Mesh const& mesh, int value) {
    return std::vector<std::uint8_t>(std::size_t(mesh.n_cells()), std::uint8_t(value));
}

// A strip of quads between two rings of points, closed with or without a twist. Its place in the
// plane is of no matter.
Mesh strip(int n, bool twisted) {
    Mesh mesh;
    for (int k = 0; k < 2 * n; ++k) {
        double const angle = 2 * pi * (k / 2) / n, r = k % 2 == 0 ? 1 : 2;
        mesh.add_point({r * std::cos(angle), r * std::sin(angle)});
    }
    for (int k = 0; k < n; ++k) {
        bool const cross = twisted && k == n - 1;
        std::int32_t const a = 2 * k, b = a + 1, c = k + 1 < n ? a + 2 : (cross ? 1 : 0),
                           d = k + 1 < n ? a + 3 : (cross ? 0 : 1);
        mesh.add_cell({a, b, d, c});
        mesh.add_face(a, c, body);
        mesh.add_face(b, d, body);
    }
    return mesh;
}

}  // namespace

TEST_CASE("counter-clockwise, clockwise and mixed meshes are oriented") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Mesh const right_way = two_bodies(8, 5, Ellipse{}, Ellipse{0.25, 0.06, 0.4}, kind);
        CHECK(reversed_of(Analysed(right_way)) == all(right_way, 0));
        Mesh mesh = right_way;
        reverse_all(mesh);
        CHECK(reversed_of(Analysed(mesh)) == all(mesh, 1));
        mesh = right_way;
        reverse_some(mesh, 5);
        std::vector<std::uint8_t> const found = reversed_of(Analysed(mesh));
        harmorph::Mesh const view = core_mesh(mesh);
        int turned = 0;
        for (Index i = 0; i < view.n_cells; ++i) {
            CHECK((cell_area(view.cell(i), view.points) < 0) == (found[std::size_t(i)] != 0));
            turned += found[std::size_t(i)];
        }
        CHECK(turned > mesh.n_cells() / 4);
        CHECK(turned < 3 * mesh.n_cells() / 4);
    }
}

TEST_CASE("the least height is the smallest corner area over the longest side of a cell") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        for (bool const clockwise : {false, true}) {
            Mesh mesh = square(9, kind);
            perturb(mesh, 0.2, 3);
            if (clockwise) reverse_all(mesh);
            harmorph::Mesh const view = core_mesh(mesh);
            double lowest = 1e300, bound = 1e300, found = -1;
            view.for_each_cell([&](Index, harmorph::Cell const& cell) {
                harmorph::CellShape const shape(cell, view.points, clockwise);
                harmorph::CellCorners const corners(shape);
                double longest = 0;
                for (Index k = 0; k < cell.n; ++k)
                    longest = std::fmax(longest, length(corners.side[k]));
                lowest = std::fmin(lowest, corners.smallest_height(cell.n));
                bound = std::fmin(bound, corners.smallest() / longest);
            });
            harmorph::Sense const sense = common_orientation(view, found);
            CHECK(sense ==
                  (clockwise ? harmorph::Sense::clockwise : harmorph::Sense::counter_clockwise));
            CHECK(found <= lowest);
            CHECK(found <= bound);
            CHECK(found > (1 - 1e-8) * bound);
            reverse_some(mesh, 4);
            CHECK(common_orientation(core_mesh(mesh), found) == harmorph::Sense::mixed);
            CHECK(found == 0);
        }
    }
}

TEST_CASE("inverted cells follow the sense of their neighbours, not that of their own area") {
    for (bool const clockwise : {false, true}) {
        Mesh mesh = square(6, Cells::triangles);
        mesh.x[8] = 10;  // point (1, 1) far out: cells round it fold over
        if (clockwise) reverse_all(mesh);
        Analysed const seen(mesh);
        CHECK(reversed_of(seen) == all(mesh, clockwise ? 1 : 0));
        auto report = sized<hm_mesh_report>();
        REQUIRE(hm_analysis_report(seen.analysis, &report, nullptr) == HM_OK);
        CHECK(report.inverted > 0);
        CHECK(report.inverted < 7);
        CHECK(report.min_area < 0);
    }
}

TEST_CASE("parts that are not joined are oriented separately") {
    Mesh mesh = square(3);
    Mesh other = square(4, Cells::triangles);
    reverse_all(other);
    std::int32_t const n_cells = mesh.n_cells();
    mesh.append(other, 5);
    Analysed const seen(mesh);
    std::vector<std::uint8_t> const found = reversed_of(seen);
    for (std::size_t k = 0; k < found.size(); ++k)
        CHECK(found[k] == (k < std::size_t(n_cells) ? 0 : 1));
    CHECK(seen->boundary().n_loops == 2);
}

TEST_CASE("a Moebius strip is refused, and the same strip without the twist is not") {
    for (int const n : {5, 8, 40}) {
        Analysed const plain(strip(n, false));
        CHECK(plain->boundary().n_loops == 2);
        Mesh const moebius = strip(n, true);
        hm_mesh const view = moebius.view();
        auto problem = sized<hm_problem>();
        problem.mesh = &view;
        Attempt attempt;
        CHECK(!attempt.analyse(problem));
        CHECK(attempt.status == HM_BAD_MESH);
        CHECK(says(attempt.error, "one-sided"));
        CHECK(attempt.error.item >= 0);
    }
}
