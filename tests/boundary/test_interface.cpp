// Sliding interfaces: a rotor in a stator, which meet on one circle with different points.
#include <fixtures/mesh.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

constexpr std::int32_t rotor_side = 31, stator_side = 32;

// An annulus with one row of chords on each side of the circle of radius 1. The chords cross.
Case rotor_in_stator(bool is_declared) {
    Case out;
    out.mesh = annulus(5, 24, 0.5, 1.0);
    for (std::int32_t& marker : out.mesh.face_markers)
        if (marker == far_field) marker = rotor_side;
    Mesh stator = annulus(6, 31, 1.0, 2.0);
    for (std::int32_t& marker : stator.face_markers)
        if (marker == body) marker = stator_side;
    out.mesh.append(stator);
    if (is_declared) out.add_condition(rotor_side, HM_INTERFACE).partner = stator_side;
    return out;
}

Case rigid_rotor(bool is_declared) {
    Case out = rotor_in_stator(is_declared);
    out.set_rigid(body, 0, 0);
    out.set_rigid(rotor_side, 0, 0);
    return out;
}

std::vector<double> turn(double angle) { return {0, 0, std::cos(angle) - 1, std::sin(angle)}; }

std::string refusal(Case& setup) {
    Attempt const attempt(setup.problem());
    CHECK(attempt.status == HM_BAD_CONDITION);
    return attempt.error.text;
}

}  // namespace

TEST_CASE("a rotor turns in its stator by any angle") {
    Case setup = rigid_rotor(true);
    Safe safe(setup);
    for (double const angle : {0.03, 0.4, 2.0, 3.1}) {
        INFO("angle " << angle);
        std::vector<double> const move = turn(angle);
        CHECK(safe.run(move) == HM_OK);
        for (std::size_t k = 0; k < 24 * 6; ++k) {  // the rotor turns as a whole
            Complex const start{setup.mesh.x[k], setup.mesh.y[k]};
            CHECK(std::abs(Complex{safe.x[k], safe.y[k]} - std::polar(1.0, angle) * start) < 1e-13);
        }
        for (std::size_t k = 24 * 6; k < setup.mesh.x.size(); ++k) {  // the stator rests
            CHECK(safe.x[k] == setup.mesh.x[k]);
            CHECK(safe.y[k] == setup.mesh.y[k]);
        }
    }
}

TEST_CASE("one step of a rotor touches and crosses nothing") {
    Case setup = rigid_rotor(true);
    Solved const solved(setup);
    std::vector<double> const move = turn(0.4);
    hm_mesh const view = setup.mesh.view();
    auto quality = sized<hm_quality_report>();
    hm_step_report const step =
        step_of(solved.basis, view, displaced(solved.basis, move), &quality);
    CHECK(step.boundary > 1);  // farther on, the rotor grows until it reaches the outer boundary
    CHECK(quality.self_crossing == 0);
    CHECK(quality_of(solved.basis, view, setup.mesh).self_crossing == 0);
}

TEST_CASE("given displacements slide, too, in one step and in safe steps") {
    Case setup = rotor_in_stator(true);
    setup.set_given(body);
    setup.set_given(rotor_side);
    SafeDisplaced given(setup);
    Field const wall = given.similarity(std::polar(1.0, 0.3), 0);
    CHECK(given.run(wall) == HM_OK);
    CHECK(given.is_at(wall));
}

TEST_CASE("without the declaration a rotor may rest but not turn") {
    Case setup = rigid_rotor(false);
    Safe safe(setup);
    CHECK(safe.run(turn(0)) == HM_OK);  // the two sides cross in the given mesh
    CHECK(safe.untouched());
    CHECK(safe.run(turn(0.1)) == HM_CROSSING);
}

TEST_CASE("a body that leaves the rotor is refused with an interface, too") {
    Case setup = rotor_in_stator(true);
    setup.set_rigid(body, 0, 0);
    Safe safe(setup);
    CHECK(safe.run({0.8, 0, 0, 0}) == HM_CROSSING);
    CHECK(safe.run({5, 0, 0, 0}) == HM_CROSSING);
}

TEST_CASE("conditions of interfaces that contradict each other are refused") {
    Case same = rotor_in_stator(false);
    same.set_rigid(body, 0, 0);
    same.add_condition(rotor_side, HM_INTERFACE).partner = rotor_side;
    CHECK(refusal(same) == "marker 31 is named for both sides of an interface");
    Case twice = rotor_in_stator(true);
    twice.set_rigid(body, 0, 0);
    twice.add_condition(far_field, HM_INTERFACE).partner = stator_side;
    CHECK(refusal(twice) == "marker 32 is in two interfaces");
    Case missing = rotor_in_stator(false);
    missing.set_rigid(body, 0, 0);
    missing.add_condition(rotor_side, HM_INTERFACE).partner = 77;
    CHECK(refusal(missing) == "marker 77 of condition 1 is on no boundary face");
}

// Both halves of a channel end on the line x = 1 and slide along it: their walls end there.
TEST_CASE("walls that end on an interface slide along the interface") {
    Case setup;
    Mesh moving = square(6), resting = moving;
    for (std::int32_t& marker : moving.face_markers)
        marker = marker == right ? rotor_side : std::int32_t(body);
    for (std::int32_t& marker : resting.face_markers)
        marker = marker == left ? stator_side : std::int32_t(far_field);
    setup.mesh = moving;
    setup.mesh.append(resting, 1);
    setup.add_condition(stator_side, HM_INTERFACE).partner = rotor_side;
    setup.set_rigid(body, 0.5, 0.5);
    setup.set_rigid(rotor_side, 0.5, 0.5);
    Safe safe(setup);
    for (double const up : {0.01, 0.07, 1.0 / 6, 0.3, -0.5}) {
        INFO("up " << up);
        CHECK(safe.run({0, up, 0, 0}) == HM_OK);
        CHECK(safe.y[0] == doctest::Approx(up));
    }
}
