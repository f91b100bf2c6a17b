// Pieces of a marker that has several: each with a condition of its own, chosen by a point near it.
#include <fixtures/operators.hpp>
#include <fixtures/parts.hpp>

using namespace fixtures;

namespace {

void choose_piece(Case& setup, double x, double y) {
    hm_condition& last = setup.conditions.back();
    last.piece = 1;
    last.near_x = x;
    last.near_y = y;
}

// Two bodies under one marker.
Case one_marker() {
    Case setup = two_body_case();
    for (std::int32_t& marker : setup.mesh.face_markers)
        if (marker == second_body) marker = body;
    setup.conditions.clear();
    return setup;
}

std::vector<double> functions(Case& setup) {
    Options const options = laplace();
    Solved const solved(setup, &options);
    return values_in_shares(solved, solved.info().functions);
}

std::string refusal(Case& setup) {
    Attempt attempt;
    Options const options = laplace();
    CHECK(!attempt.analyse(setup.problem(), &options));
    CHECK(attempt.status == HM_BAD_CONDITION);
    return attempt.error.text;
}

}  // namespace

TEST_CASE("two bodies on one marker, chosen by points, have the bits of two markers") {
    Case apart = two_body_case();
    std::vector<double> const expected = functions(apart);
    for (bool const other_order : {false, true}) {
        Case setup = one_marker();
        for (int k = 0; k < 2; ++k) {
            int const number = other_order ? 1 - k : k;
            setup.put_on_curves(body, number);
            choose_piece(setup, 0.6 + number,
                         0.4);  // off the bodies' middles, nearer to one than to the other
        }
        CHECK(same_bits(functions(setup), expected));
    }
    // The one that is not chosen is the rest of the marker.
    Case setup = one_marker();
    setup.put_on_curves(body, 0);
    setup.put_on_curves(body, 1);
    choose_piece(setup, 1.5, 0.5);
    CHECK(same_bits(functions(setup), expected));
}

TEST_CASE("a piece without a condition is fixed, and a piece may be rigid beside one on a curve") {
    Case setup = one_marker(), apart = two_body_case();
    setup.put_on_curves(body, 0);
    choose_piece(setup, 0.5, 0.5);
    apart.conditions.pop_back();  // the second body is a marker without a condition
    CHECK(same_bits(functions(setup), functions(apart)));
    setup.set_rigid(body, 1.5, 0.5);
    choose_piece(setup, 1.5, 0.5);
    apart.set_rigid(second_body, 1.5, 0.5);
    CHECK(same_bits(functions(setup), functions(apart)));
}

TEST_CASE("one side of a square may slide while the other sides of the marker are fixed") {
    Case setup;
    setup.mesh = square(9, Cells::quads, 3, 1);
    for (std::int32_t& marker :
         setup.mesh.face_markers)  // below and above: two runs of faces of one marker
        if (marker == top) marker = bottom;
    setup.curves =
        polyline({{3 / 9., 4 / 9.}, {6 / 9., 4 / 9.}, {6 / 9., 5 / 9.}, {3 / 9., 5 / 9.}});
    setup.put_on_curves(body);
    setup.set_slip(bottom);
    choose_piece(setup, 0.5, 1.2);
    Attempt solved(setup.problem());
    REQUIRE(solved.status == HM_OK);
    std::vector<double> move = {0.02, 0.01, 0.02, 0.01, 0.02, 0.01, 0.02, 0.01};
    Field const by = displacement(solved.basis, move);
    for (std::size_t k = 0; k < by.size(); ++k) {
        bool const inside = setup.mesh.x[k] > 0.01 && setup.mesh.x[k] < 0.99;
        if (setup.mesh.y[k] == 0) CHECK(by[k] == 0.0);
        if (setup.mesh.y[k] != 1) continue;
        CHECK(by[k].imag() == 0);
        if (inside) CHECK(by[k].real() > 0);
    }
}

TEST_CASE("a basis keeps the pieces of markers") {
    Case setup = one_marker();
    setup.put_on_curves(body, 1);
    choose_piece(setup, 1.25, 0.75);
    Options const options = laplace();
    Solved const solved(setup, &options);
    hm_condition out[2] = {};
    out[0].struct_size = sizeof out[0];
    std::int32_t n = 0;
    REQUIRE(hm_basis_conditions(solved.basis, out, 2, &n, nullptr) == HM_OK);
    CHECK(n == 1);
    CHECK(out[0].piece == 1);
    CHECK(out[0].near_x == 1.25);
    CHECK(out[0].near_y == 0.75);
}

TEST_CASE("pieces that contradict each other are refused by name") {
    Case twice = one_marker();
    twice.put_on_curves(body, 0);
    choose_piece(twice, 0.5, 0.5);
    twice.put_on_curves(body, 1);
    choose_piece(twice, 0.4, 0.5);
    CHECK(refusal(twice) ==
          "all faces of marker 1 that condition 1 chooses have another condition");

    Case none_left = one_marker();
    none_left.put_on_curves(body, 0);
    choose_piece(none_left, 0.5, 0.5);
    none_left.put_on_curves(body, 1);
    choose_piece(none_left, 1.5, 0.5);
    none_left.add_condition(body, HM_FIXED);
    CHECK(refusal(none_left) ==
          "all faces of marker 1 that condition 2 chooses have another condition");

    Case wholes = one_marker();
    wholes.put_on_curves(body, 0);
    wholes.put_on_curves(body, 1);
    CHECK(refusal(wholes) == "marker 1 has two conditions");
}
