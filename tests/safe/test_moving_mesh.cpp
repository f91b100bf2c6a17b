// A mesh on the way of a large movement: one step ahead, and back to the start.
#include <fixtures/core.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/guarded.hpp>

#include "safe/moving_mesh.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::KnownEnd;

namespace {

struct Moving {
    Moving(Case& setup, std::vector<double> const& move, std::int32_t operator_kind = HM_LAPLACE)
        : options(options_of(operator_kind)),
          solved(setup, &options),
          plan(*reinterpret_cast<harmorph::Plan*>(solved.plan)),
          basis(harmorph::Basis::view(static_cast<void*>(solved.basis))) {
        block = laid_out_part(mesh, plan, basis.header->counts);
        plan.equations().walls_at(plan.mesh().points);
        mesh.init(plan, basis, move.data());
        CHECK(block->guards_intact());
    }
    harmorph::AdmissibleStep look(double to) { return mesh.look_ahead(plan, basis, basis, to); }

    Options options;
    Solved solved;
    harmorph::Plan& plan;
    harmorph::Basis basis;
    harmorph::MovingMesh mesh;
    std::unique_ptr<Guarded> block;
};

}  // namespace

TEST_CASE("one step to the target is the morph, with the admissible step of the displacement") {
    Case setup = airfoil_case();
    std::vector<double> const move = some_move(12, 0.02, 3);
    Moving moving(setup, move);
    double const admissible = moving.look(1).step;
    const hm_basis* const basis = moving.solved.basis;
    Moved const expected = morphed(basis, setup.mesh, move);
    double off = 0;
    for (std::size_t k = 0; k < expected.x.size(); ++k) {
        harmorph::Vec2 const at = moving.mesh.ahead()[Index(k)];
        off = std::fmax(off, std::hypot(at.x - expected.x[k], at.y - expected.y[k]));
    }
    CHECK(off < 1e-15);
    double const step = step_of(basis, setup.mesh.view(), displaced(basis, move)).admissible;
    CHECK(admissible == doctest::Approx(step).epsilon(1e-12));
}

TEST_CASE("a trial moves nothing, a step does, and begin() restores the start bit by bit") {
    Case setup = airfoil_case();
    Moving moving(setup, some_move(12, 0.02, 4));
    auto const is_start = [&] {
        for (std::size_t k = 0; k < setup.mesh.x.size(); ++k) {
            harmorph::Vec2 const at = moving.mesh.now()[Index(k)];
            if (at.x != setup.mesh.x[k] || at.y != setup.mesh.y[k]) return false;
        }
        return true;
    };
    CHECK(is_start());
    moving.look(0.4);
    CHECK(is_start());
    CHECK(moving.mesh.time == 0);
    moving.mesh.advance();
    CHECK(!is_start());
    CHECK(moving.mesh.time == 0.4);
    moving.mesh.begin(moving.plan);
    CHECK(is_start());
    CHECK(moving.mesh.time == 0);
}

TEST_CASE("after a hundred steps the wall is on the B-spline without accumulated rounding") {
    Case setup = airfoil_case();
    std::vector<double> const move = some_move(12, 0.02, 5);
    Moving moving(setup, move);
    for (int step = 1; step <= 100; ++step) {
        moving.look(step / 100.0);
        moving.mesh.advance();
    }
    double off = 0;
    for (Index slot = 0; slot < moving.basis.wall_point.count(); ++slot) {
        Index const point = moving.basis.wall_point[slot];
        harmorph::Vec2 const by = moving.basis.wall_move(slot, move.data()),
                             at = moving.mesh.now()[point];
        auto const k = std::size_t(point);
        off = std::fmax(off, std::fabs(at.x - (setup.mesh.x[k] + by.x)));
        off = std::fmax(off, std::fabs(at.y - (setup.mesh.y[k] + by.y)));
    }
    CHECK(off == 0);
}

TEST_CASE("the known displacements are those of walls, fixed points and lines") {
    Case setup = tiny_case();
    setup.set_slip(bottom);
    Moving moving(setup, some_move(4, 0.1, 6));
    CHECK(moving.mesh.ends[0] == KnownEnd::prescribed);  // a corner with a fixed side
    CHECK(moving.mesh.ends[3] == KnownEnd::on_line);
    CHECK(moving.mesh.ends[8] == KnownEnd::unknown);
    CHECK(moving.mesh.ends[16] == KnownEnd::prescribed);  // on the wall
    CHECK(moving.mesh.held[3] == 1);
    CHECK(moving.mesh.held[8] == 0);
}
