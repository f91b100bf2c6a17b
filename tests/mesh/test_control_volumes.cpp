// Areas of the median dual and shortest edges, where they are known.
#include <fixtures/agglomerated.hpp>

#include "mesh/median_dual.hpp"

using namespace fixtures;
using harmorph::Index;

namespace {

struct Measured {
    Analysed seen;
    std::vector<Index> place;
    std::vector<double> area, shortest;

    explicit Measured(Case& setup) : seen(setup) {
        std::size_t const n = setup.mesh.x.size();  // of all points, not of unknowns alone
        place.resize(n);
        std::iota(place.begin(), place.end(), 0);
        area.resize(n);
        shortest.resize(n);
        harmorph::Mesh const& mesh = seen->problem().mesh;
        harmorph::ControlVolumes volumes{span(area), span(shortest)};
        volumes.measure(seen->topology(), mesh.points, span(place));
    }
};

}  // namespace

TEST_CASE("control volumes fill the mesh without gaps, whatever the sense of its cells") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = square_on_curve(9, kind, 0.4, 3);
        Measured const one(setup);
        reverse_some(setup.mesh, 5);
        Measured const other(setup);
        double sum = 0, worst = 0;
        for (std::size_t k = 0; k < one.area.size(); ++k) {
            CHECK(one.area[k] > 0);
            sum += one.area[k];
            worst = std::max(worst, std::fabs(one.area[k] - other.area[k]));
        }
        CHECK(sum == doctest::Approx(1).epsilon(1e-13));
        CHECK(worst < 1e-16);
    }
}

TEST_CASE("on a grid of rectangles volumes, sides and shorter sides are known") {
    Case setup = square_on_curve(8, Cells::quads, 0, 0);
    for (double& y : setup.mesh.y) y *= 0.25;
    for (std::size_t k = 1; k < setup.curves.control.size(); k += 2)
        setup.curves.control[k] *= 0.25;
    Measured const found(setup);
    for (std::size_t k = 0; k < found.area.size(); ++k) {
        Point const p = setup.mesh.point(Index(k));
        double expected = 1.0 / 64 * 0.25;
        if (p.x < 1e-9 || p.x > 1 - 1e-9) expected /= 2;
        if (p.y < 1e-9 || p.y > 0.25 - 1e-9) expected /= 2;
        CHECK(found.area[k] == doctest::Approx(expected).epsilon(1e-12));
        CHECK(found.shortest[k] == doctest::Approx(0.25 / 8).epsilon(1e-12));
    }
}

TEST_CASE("a point without an unknown is left out") {
    Case setup = square_on_curve(4, Cells::triangles, 0, 0);
    Analysed const seen(setup);
    FrontMatrix const front(*seen.operator->());
    std::vector<double> area(std::size_t(front.rows.n)), shortest(area.size());
    harmorph::ControlVolumes volumes{span(area), span(shortest)};
    harmorph::Mesh const& mesh = seen->problem().mesh;
    volumes.measure(seen->topology(), mesh.points, front.matrix.rows_of_dofs());
    // Hexagons of six halves of squares.
    for (double const volume : area) CHECK(volume == doctest::Approx(1.0 / 16));
    CHECK(area.size() == 9);
}
