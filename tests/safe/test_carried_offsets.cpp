// Wall points beside their curve: a body that turns takes them along, and the mesh near them.
#include <fixtures/core.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/guarded.hpp>

#include "plan/plan.hpp"
#include "safe/moving_mesh.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::Vec2;

namespace {

Complex number(Vec2 z) { return {z.x, z.y}; }

// A ring whose wall points are up to .01 beside the curve.
Case rough_ring() {
    Case setup = ring_case(8, 32, 0.5, 2);
    // The curve is a circle through the points, nearly.
    for (double& coordinate : setup.curves.control) coordinate *= 0.5 / 0.445;
    for (std::size_t k = 0; k < 32; ++k) {
        double const factor = 1 + 0.02 * std::sin(7.0 * double(k));
        setup.mesh.x[k] *= factor;
        setup.mesh.y[k] *= factor;
    }
    return setup;
}

struct Carried {
    Carried(Case& setup, std::vector<double> const& move, std::int32_t operator_kind = HM_CONFORMAL)
        : options(options_of(operator_kind)),
          solved(setup, &options),
          plan(*reinterpret_cast<harmorph::Plan*>(solved.plan)),
          basis(harmorph::Basis::view(static_cast<void*>(solved.basis))) {
        auto const lay_out = [&](harmorph::Arena& arena) {
            path.lay_out(arena, basis.header->counts);
            carried.lay_out(arena, basis.header->counts);
        };
        block = laid_out(lay_out);
        path.init(basis, move.data());
        carried.init(basis, path);
        CHECK(block->guards_intact());
    }
    Complex start(Index slot) const { return number(plan.mesh().points[basis.wall_point[slot]]); }
    Complex on_curve(Index slot) const {
        return number(curve_point(basis.curve(basis.wall_curve[slot]), basis.wall_u[slot]));
    }

    Options options;
    Solved solved;
    harmorph::Plan& plan;
    harmorph::Basis basis;
    harmorph::MovementPath path;
    harmorph::CarriedOffsets carried;
    std::unique_ptr<Guarded> block;
};

}  // namespace

TEST_CASE("offsets are those of the points from their curve, and turn with the body") {
    Case setup = rough_ring();
    Complex const turn = std::polar(1.2, 0.7);
    Carried carried(setup, similarity_move(setup.curves, turn, 0, {0.1, 0.2}));
    double largest = 0;
    for (Index slot = 0; slot < carried.carried.wall.count(); ++slot) {
        Complex const e = carried.start(slot) - carried.on_curve(slot);
        CHECK(std::abs(number(carried.carried.wall[slot]) - e) < 1e-15);
        for (double const t : {0.0, 0.3, 1.0}) {
            harmorph::RotationAt rotated(carried.path, t);
            Complex const by =
                number(carried.carried.of_wall(carried.basis, carried.path, slot, rotated));
            CHECK(std::abs(by - (std::pow(turn, t) - 1.0) * e) < 1e-14);
        }
        largest = std::fmax(largest, std::abs((turn - 1.0) * e));
    }
    CHECK(largest > 1e-3);
    CHECK(carried.carried.largest(carried.basis, carried.path, 1) ==
          doctest::Approx(largest).epsilon(1e-12));
    CHECK(carried.carried.reach > 0);
}

TEST_CASE("offsets are zero without rotation, with real functions, and on the curve") {
    Case setup = rough_ring();
    std::vector<double> const turn = similarity_move(setup.curves, std::polar(1.0, 0.7), 0, 0);
    std::vector<double> const shift = similarity_move(setup.curves, 1, 0, {0.1, 0.2});
    Carried const shifted(setup, shift), real(setup, turn, HM_LAPLACE);
    CHECK(shifted.carried.largest(shifted.basis, shifted.path, 1) < 1e-15);
    CHECK(real.carried.reach == 0);
    CHECK(real.carried.largest(real.basis, real.path, 1) == 0);
    for (Index slot = 0; slot < 32; ++slot) {  // on the curve
        auto const k = std::size_t(real.basis.wall_point[slot]);
        setup.mesh.x[k] = real.on_curve(slot).real();
        setup.mesh.y[k] = real.on_curve(slot).imag();
    }
    Carried const smooth(setup, turn);
    CHECK(smooth.carried.reach == 0);
}

TEST_CASE("the similarity is carried near the wall and fades inside with the distance") {
    Case setup = rough_ring();
    Complex const turn = std::polar(1.0, 0.5);
    Carried move(setup, similarity_move(setup.curves, turn, 0, 0));
    std::size_t const n = setup.mesh.x.size();
    std::vector<double> reached(2 * 8, 0.0), dx(n, 0.0), dy(n, 0.0);
    std::vector<Index> representative(n);
    std::vector<std::uint8_t> held(n, 0);
    for (std::size_t k = 0; k < n; ++k) representative[k] = Index(k);
    for (std::int32_t const marker : {std::int32_t{body}, std::int32_t{far_field}})
        for (std::int32_t const k : points_on(setup.mesh, marker)) held[std::size_t(k)] = 1;
    harmorph::Points const start = move.plan.mesh().points;
    move.carried.find_groups(move.basis, move.path, start, move.plan.equations().walls(),
                             span(representative), span(held), {});
    move.carried.find(move.basis, span(reached), start, span(representative), {});
    move.carried.add(move.path, 0, 1, {dx.data(), dy.data(), 1}, {});
    Field const of_control = displacement(move.solved, setup.curves.control);  // sum of F_i P_i
    int carried = 0;
    for (std::size_t k = 0; k < n; ++k) {
        Complex const by(dx[k], dy[k]);
        if (held[k] != 0) {
            CHECK(by == 0.0);
            continue;
        }
        Complex const z(setup.mesh.x[k], setup.mesh.y[k]);
        double distance = 1e9;
        for (std::size_t face = 0; face < 32; ++face) {
            std::size_t const next = (face + 1) % 32;
            Complex const a(setup.mesh.x[face], setup.mesh.y[face]),
                b(setup.mesh.x[next], setup.mesh.y[next]);
            double const s = std::fmin(
                std::fmax(((z - a) * std::conj(b - a)).real() / std::norm(b - a), 0.0), 1.0);
            distance = std::fmin(distance, std::abs(z - a - s * (b - a)));
        }
        double const r = distance / move.carried.reach,
                     fade = r < 1 ? (1 - r) * (1 - r) * (1 + 2 * r) : 0;
        CHECK(std::abs(by - (turn - 1.0) * fade * (z - of_control[k])) < 1e-12);
        carried += fade > 0 ? 1 : 0;
    }
    CHECK(carried > 32);
}
