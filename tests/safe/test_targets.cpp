// Targets of cells: the reference mesh, layers as long as their wall, and the ideal corners of the
// quality that is reported.
#include <fixtures/annulus.hpp>
#include <fixtures/core.hpp>
#include <fixtures/perturb.hpp>
#include <fixtures/quality_energy.hpp>
#include <fixtures/square.hpp>
#include <fixtures/laid_out.hpp>

#include "morph/quality.hpp"
#include "safe/targets.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Triangle;
using harmorph::Vec2;

namespace {

// Targets of a mesh whose points are now elsewhere; walls are the faces of the marker `body`.
struct Found {
    Mesh reference, now;
    harmorph::Mesh view;
    Analysed analysed;
    std::unique_ptr<Guarded> block;
    harmorph::FaceDistance walls;
    harmorph::Targets targets;

    Found(Mesh const& from, Mesh const& to)
        : reference(from), now(to), view(core_mesh(reference)), analysed(reference) {
        auto const lay_out = [&](harmorph::Arena& arena) {
            walls.lay_out(arena, reference.face_markers.size());
            targets.lay_out(arena, view.n_cells);
        };
        block = laid_out(lay_out);
        harmorph::Boundary const& boundary = analysed->boundary();
        walls.choose(boundary, [&](Index face) { return boundary.marker[face] == body; });
        walls.build(view.points);
        targets.find(analysed->topology(), walls, view.points, points(now), {});
    }
    static harmorph::Points points(Mesh const& mesh) { return {mesh.x.data(), mesh.y.data(), 1}; }
    // visit(cell, three points) of all corners.
    template <class Visit>
    void for_corners(Visit visit) const {
        for (Index i = 0; i < view.n_cells; ++i) {
            harmorph::Cell const cell = view.cell(i);
            for (Index k = 0; k < cell.n; ++k) {
                harmorph::CornerPoints const corner{{cell.previous(k), cell.point[k], cell.next(k)},
                                                    {1, 0}};
                visit(i, corner);
            }
        }
    }
    Triangle triangle(Mesh const& mesh, harmorph::CornerPoints const& corner) const {
        harmorph::Points const at = points(mesh);
        return {{at[corner[0]], at[corner[1]], at[corner[2]]}};
    }
};

Mesh scaled(Mesh mesh, double factor) {
    for (double& x : mesh.x) x *= factor;
    for (double& y : mesh.y) y *= factor;
    return mesh;
}

}  // namespace

TEST_CASE("a mesh that has not moved is its own target") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Mesh mesh = annulus(12, 24, 1, 1.5, kind);
        perturb(mesh, 0.2, 1);
        Found const found(mesh, mesh);
        found.for_corners([&](Index cell, harmorph::CornerPoints const& corner) {
            Triangle const now = found.triangle(mesh, corner),
                           target = found.targets.of(cell, corner);
            bool const any_ratio = found.targets.cell[cell].any_ratio;
            CHECK(QualityEnergy{target, 1, 1, any_ratio}.energy(now) ==
                  doctest::Approx(1).epsilon(1e-13));
        });
    }
}

TEST_CASE("quadrilaterals that are not thin keep area and angle, whatever their sides' ratio") {
    Mesh const mesh = square(4);
    Found const found(mesh, mesh);
    harmorph::CornerPoints const corner{
        {found.view.cell(5).point[3], found.view.cell(5).point[0], found.view.cell(5).point[1]},
        {1, 0}};
    double const side = 0.25;
    for (double const ratio : {0.01, 0.5, 3.0}) {
        Triangle const now = {{{0, side / ratio}, {0, 0}, {side * ratio, 0}}};
        CHECK(QualityEnergy{found.targets.of(5, corner), 1, 1, true}.energy(now) ==
              doctest::Approx(1).epsilon(1e-13));
        CHECK(QualityEnergy{found.targets.ideal(5, corner), 1, 1, true}.energy(now) ==
              doctest::Approx(1).epsilon(1e-13));
        Triangle const wide = {
            {{0, side / ratio}, {0, 0}, {2 * side * ratio, 0}}};  // size (2 + 1/2) / 2
        CHECK(QualityEnergy{found.targets.of(5, corner), 1, 1, true}.energy(wide) ==
              doctest::Approx(1.25).epsilon(1e-13));
        Triangle const inclined = {
            {{side / ratio, side / ratio}, {0, 0}, {side * ratio, 0}}};  // by 45 degrees
        CHECK(QualityEnergy{found.targets.of(5, corner), 1, 1, true}.energy(inclined) ==
              doctest::Approx(2).epsilon(1e-13));
    }
}

TEST_CASE("targets of thin cells at a longer wall are as long as the wall and as high as before") {
    double const factor = 1.7;
    Mesh const mesh = annulus(60, 40, 1, 1.2);  // cells of .157 by .0033
    Found const found(mesh, scaled(mesh, factor));
    for (Index i = 0; i < 40; ++i) {  // the first layer
        harmorph::Cell const cell = found.view.cell(i);
        for (Index k = 0; k < 4; ++k) {
            harmorph::CornerPoints const corner{{cell.previous(k), cell.point[k], cell.next(k)},
                                                {1, 0}};
            Triangle const target = found.targets.of(i, corner);
            for (Index side = 0; side < 2; ++side) {
                double const before = length(found.triangle(mesh, corner).at[side + 1] -
                                             found.triangle(mesh, corner).at[side]);
                double const wanted = length(target.at[side + 1] - target.at[side]);
                double const expected = before < 0.01 ? before : factor * before;
                CHECK(wanted == doctest::Approx(expected).epsilon(0.03));
            }
        }
    }
    Found const isotropic(annulus(2, 12, 1, 3.2), scaled(annulus(2, 12, 1, 3.2), factor));
    for (Index i = 0; i < 24; ++i) CHECK(isotropic.targets.cell[i].more == 0);
}

TEST_CASE("the quality of targets is the reported one, or half of a cell's own at least") {
    Mesh mesh = annulus(6, 24, 1, 2, Cells::hybrid), moved = mesh;
    perturb(mesh, 0.3, 2);
    perturb(moved, 0.3, 3);
    Found const found(mesh, moved);
    harmorph::Points const at = Found::points(moved), before = Found::points(mesh);
    harmorph::Quality const whole =
        harmorph::measure_quality(found.analysed->topology(), at, before, {});
    harmorph::Quality const start =
        harmorph::measure_quality(found.analysed->topology(), before, {}, {});
    double sum = 0, least = 1;
    for (Index i = 0; i < found.view.n_cells; ++i) {
        harmorph::CellShape const shape(found.view.cell(i), at, false),
            old(found.view.cell(i), before, false);
        double const quality = found.targets.quality(i, shape),
                     own = harmorph::skew_quality(old.n, harmorph::CellCorners(old));
        sum += quality;
        least = std::fmin(least, quality);
        CHECK(found.targets.cell[i].wanted == std::fmax(start.min_quality, 0.5 * own));
    }
    CHECK(sum == doctest::Approx(whole.quality_sum).epsilon(1e-13));
    CHECK(least == doctest::Approx(whole.min_quality).epsilon(1e-13));
}
