// Rigid bodies: four numbers instead of control points, and points that go exactly where they say.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/operators.hpp>

using namespace fixtures;

namespace {

constexpr std::int32_t operators[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL};

// Two ellipses in a rectangle: the second is rigid, the first on a curve or rigid too.
Case flap(bool both = false, Cells kind = Cells::hybrid) {
    Case out = two_body_case(kind, 6, 5);
    out.conditions.clear();
    if (both) {
        out.curves = CurveSet{};
        out.set_rigid(body, 0.25, 0.5, 1);
    } else {
        CurveSet one;
        one.add(ring(3, 11, 0.2, 0.08, 0.5, 0.5));
        out.curves = one;
        out.put_on_curves(body, 0);
    }
    out.set_rigid(second_body, 1.5, 0.5, 0);
    return out;
}

hm_problem without_curves(Case& setup) {
    hm_problem out = setup.problem();
    out.curves = nullptr;
    out.n_known = 0;
    return out;
}

double worst_on(Case const& setup, std::int32_t marker, Field const& moved, Complex centre,
                Complex s, Complex shift) {
    double worst = 0;
    for (std::int32_t const point : points_on(setup.mesh, marker)) {
        Complex const expected = (s - 1.0) * (to_complex(setup.mesh.point(point)) - centre) + shift;
        worst = std::fmax(worst, std::abs(moved[std::size_t(point)] - expected));
    }
    return worst;
}

hm_status refused(Case& setup, const char* words) {
    Options const options = options_of(HM_CONFORMAL);
    Attempt const attempt(setup.problem(), &options);
    INFO(attempt.error.text);
    CHECK(says(attempt.error, words));
    return attempt.status;
}

}  // namespace

TEST_CASE("points of a body that is translated, turned and scaled are exact to rounding") {
    for (std::int32_t const operator_kind : operators)
        for (Cells const kind : {Cells::quads, Cells::triangles}) {
            Case setup = flap(false, kind);
            Options const options = options_of(operator_kind);
            Solved const solved(setup, &options);
            hm_basis_info const info = solved.info();
            CHECK(info.bodies == 1);
            CHECK(info.functions == 11 + 2);
            CHECK(info.numbers_per_value >= 2);
            Complex const all[] = {1, std::polar(1.0, 0.5), std::polar(1.0, 3.0), 2,
                                   std::polar(0.3, -1.0)};
            for (Complex const s : all) {
                std::vector<double> move(26, 0.0);
                move[22] = 0.3;
                move[23] = -0.1;
                move[24] = s.real() - 1;
                move[25] = s.imag();
                Field const moved = displacement(solved, move);
                CHECK(worst_on(setup, second_body, moved, {1.5, 0.5}, s, {0.3, -0.1}) < 1e-15);
                CHECK(worst_on(setup, body, moved, 0, 1, 0) == 0);  // the other one rests
                CHECK(worst_on(setup, far_field, moved, 0, 1, 0) == 0);
                CHECK(boundary_error(solved.basis, move, setup.mesh,
                                     morphed(solved.basis, setup.mesh, move)) < 1e-14);
            }
            CHECK(solved.report.boundary_error < 1e-15);
        }
}

TEST_CASE("two rigid bodies without a curve have their own numbers and centres") {
    for (std::int32_t const operator_kind : operators) {
        Case setup = flap(true);
        Options const options = options_of(operator_kind);
        Solved const solved(without_curves(setup), &options);
        CHECK(solved.info().functions == 4);
        CHECK(solved.info().curves == 0);
        CHECK(solved.info().bodies == 2);
        Complex const first = std::polar(1.1, 0.2), second = std::polar(0.9, -0.7);
        Field const moved = displacement(solved, {0.01, 0.02, first.real() - 1, first.imag(), -0.03,
                                                  0.01, second.real() - 1, second.imag()});
        CHECK(worst_on(setup, second_body, moved, {1.5, 0.5}, first, {0.01, 0.02}) < 1e-15);
        CHECK(worst_on(setup, body, moved, {0.25, 0.5}, second, {-0.03, 0.01}) < 1e-15);
    }
}

TEST_CASE("a body over several markers is one body; its parts alone would be two") {
    Case setup = flap(), split = setup;
    split_marker(split.mesh, second_body, 3, 31);
    split.conditions.pop_back();
    for (std::int32_t const marker : {31, 32, 33}) split.set_rigid(marker, 1.5, 0.5, 0);
    Options const options = options_of(HM_CONFORMAL);
    Solved const a(setup, &options), b(split, &options);
    std::vector<double> const move = some_move(13, 0.2, 3);
    CHECK(b.info().bodies == 1);
    CHECK(largest_difference(displacement(a, move), displacement(b, move)) < 1e-14);
}

TEST_CASE("another centre of a body needs another translation for the same movement") {
    Case setup = flap(), other = setup;
    other.conditions.back().x = -3;
    other.conditions.back().y = 10;
    Options const options = options_of(HM_CONFORMAL);
    Solved const a(setup, &options), b(other, &options);
    Complex const s = std::polar(1.2, 0.4),
                  shift = (s - 1.0) * (Complex(-3, 10) - Complex(1.5, 0.5));
    std::vector<double> move(26, 0.0), same(26, 0.0);
    move[22] = same[22] = 0.1;
    same[22] += shift.real();
    same[23] += shift.imag();
    move[24] = same[24] = s.real() - 1;
    move[25] = same[25] = s.imag();
    // z -> c + s (z - c) + d: with the centre c', d' = d + (s - 1) (c' - c).
    CHECK(largest_difference(displacement(a, move), displacement(b, same)) < 1e-13);
}

TEST_CASE("a rigid body moves the mesh as a curve does whose control points turn alike") {
    for (std::int32_t const operator_kind : operators) {
        Case rigid = ring_case(8, 32, 0.5, 2), curved = rigid;
        rigid.conditions.clear();
        rigid.set_rigid(body, 0.1, 0.2);
        curved.curves = ring(3, 8, 0.5, 0.5);
        for (std::size_t k = 0; k < 32; ++k) {  // points of the mesh exactly on the curve
            harmorph::Vec2 const p = curve_point(ring(3, 8, 0.5, 0.5).curve(), curved.known_u[k]);
            rigid.mesh.x[k] = curved.mesh.x[k] = p.x;
            rigid.mesh.y[k] = curved.mesh.y[k] = p.y;
        }
        Options const options = options_of(operator_kind);
        Solved const a(without_curves(rigid), &options), b(curved, &options);
        Complex const s = std::polar(1.1, 0.3);
        Field const by_body = displacement(a, {0.05, -0.02, s.real() - 1, s.imag()});
        Field const by_points =
            displacement(b, similarity_move(curved.curves, s, {0.1, 0.2}, {0.05, -0.02}));
        CHECK(largest_difference(by_body, by_points) < 1e-13);
    }
}

TEST_CASE("points shared with a curve's marker belong to the curve, whichever is named first") {
    Case setup = tiny_case();
    for (std::size_t k = 0; k < setup.mesh.face_markers.size(); ++k) {
        bool const low = setup.mesh.y[std::size_t(setup.mesh.faces[2 * k])] == 2 &&
                         setup.mesh.y[std::size_t(setup.mesh.faces[2 * k + 1])] == 2;
        if (setup.mesh.face_markers[k] == body && low) setup.mesh.face_markers[k] = 40;
    }
    setup.conditions.clear();
    setup.set_rigid(40, 3, 3);
    setup.put_on_curves(body);
    for (int order = 0; order < 2; ++order) {
        Options const options = options_of(HM_LAPLACE);
        Solved const solved(setup, &options);
        // The body alone, to the right.
        Field const moved = displacement(solved, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
        CHECK(moved[16] == 0.0);
        CHECK(moved[17] == 1.0);
        CHECK(moved[18] == 0.0);
        std::reverse(setup.conditions.begin(), setup.conditions.end());
    }
}

TEST_CASE("bodies are checked: gaps, centres, numbers out of range, parameters on them") {
    Case const good = flap();
    Case setup = good;
    setup.conditions.back().body = 1;
    CHECK(refused(setup, "must be numbered without gaps") == HM_BAD_CONDITION);
    for (std::int32_t const wrong : {-1, 1 << 20, 2147483647, -2147483647 - 1}) {
        setup.conditions.back().body = wrong;
        CHECK(refused(setup, "rigid body") == HM_BAD_CONDITION);
    }
    for (double const wrong : {std::nan(""), HUGE_VAL}) {
        setup = good;
        setup.conditions.back().y = wrong;
        CHECK(refused(setup, "not finite") == HM_BAD_CONDITION);
    }
    setup = good;
    split_marker(setup.mesh, second_body, 2, 31);
    setup.conditions.pop_back();
    setup.set_rigid(31, 1.5, 0.5);
    setup.set_rigid(32, 1.5, 0.6);
    CHECK(refused(setup, "have different centres") == HM_BAD_CONDITION);
    setup.conditions.back().body = 1;  // two bodies may
    Options const options = options_of(HM_CONFORMAL);
    CHECK(Attempt(setup.problem(), &options).status == HM_OK);
    setup = good;
    setup.set_rigid(second_body, 1.5, 0.5);
    CHECK(refused(setup, "two conditions") == HM_BAD_CONDITION);
    setup = good;
    setup.give(points_on(setup.mesh, second_body)[3], 0.5);
    CHECK(refused(setup, "which is not on a curve") == HM_BAD_CONDITION);
}
