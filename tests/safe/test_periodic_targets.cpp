// Walls that would cross their own periodic image are refused before anything is solved.
#include <fixtures/channels.hpp>
#include <fixtures/cascade.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

// Control points to middle + (stretch_x, stretch_y) times their distance from there.
std::vector<double> stretched_by(Case const& setup, Point middle, double by_x, double by_y) {
    std::vector<double> move = setup.curves.control;
    for (std::size_t k = 0; k < move.size(); k += 2) {
        move[k] = (by_x - 1) * (move[k] - middle.x);
        move[k + 1] = (by_y - 1) * (move[k + 1] - middle.y);
    }
    return move;
}

void refused(Safe& safe, std::vector<double> const& move) {
    CHECK(safe.run(move) == HM_CROSSING);
    CHECK(safe.untouched());
    CHECK(safe.report.resolves == 0);
    CHECK(safe.report.crossing_points[0] >= 0);
    std::string const text = safe.error.text;
    INFO(text);
    CHECK(text.find("the moved wall crosses its periodic image") != std::string::npos);
    CHECK(text.find('(') != std::string::npos);
}

}  // namespace

TEST_CASE("a plate of a cascade becomes thicker than the pitch and is refused") {
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Case setup = plate_cascade(8, Cells::quads);
        Safe safe(setup, options_of(operator_kind));
        // The plate is 1 / 12 thick in a pitch of 1. It shears, so that sides cross in points.
        auto const thicker = [&](double thickness) {
            std::vector<double> move = stretched_by(setup, {0.5, 0.5}, 1, 12 * thickness);
            for (std::size_t k = 0; k < move.size(); k += 2) move[k] += 0.1 * move[k + 1];
            return move;
        };
        refused(safe, thicker(1.1));
        refused(safe, thicker(3));
        CHECK(safe.run(thicker(0.5)) >= HM_OK);
        CHECK(safe.report.step_fraction == 1);
    }
}

TEST_CASE("a plate turns against its neighbour, and one passes between its neighbours") {
    Case setup = plate_cascade(8, Cells::triangles);
    Safe safe(setup);
    // Long plates, of length 1.3, upright: each would reach into the next one, 1 above.
    std::vector<double> const longer = stretched_by(setup, {0.5, 0.5}, 4, 1);
    std::vector<double> move(longer.size());
    for (std::size_t k = 0; k < move.size(); k += 2) {
        Complex const start{setup.curves.control[k] - 0.5, setup.curves.control[k + 1] - 0.5},
            target = std::polar(1.0, 1.5) * Complex{start.real() * 4, start.imag()};
        move[k] = (target - start).real();
        move[k + 1] = (target - start).imag();
    }
    refused(safe, move);
}

TEST_CASE("a body of a passage that becomes wider than the passage is refused") {
    Case setup = bent(plate_cascade(8, Cells::quads), 6, 0);
    setup.conditions.clear();
    setup.put_on_curves(body);
    setup.set_rotation(left, right);
    Safe safe(setup);
    Complex middle = 0;
    std::vector<Point> const outline = outline_of_body(setup.mesh);
    for (Point const p : outline) middle += to_complex(p) / double(outline.size());
    // Along the circle through the middle, far beyond both sides.
    std::vector<double> move(setup.curves.control.size());
    for (std::size_t k = 0; k < move.size(); k += 2) {
        Complex const z{setup.curves.control[k], setup.curves.control[k + 1]};
        double const angle = std::arg(z / middle);
        Complex const by = z * (std::polar(1.0, 4 * angle) - 1.0);
        move[k] = by.real() + 0.01 * by.imag();
        move[k + 1] = by.imag();
    }
    refused(safe, move);
}
