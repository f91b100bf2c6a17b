// Points that belong to two moving conditions: both conditions are checked, and movements that tear
// them apart are refused.
#include <fixtures/core.hpp>
#include <fixtures/single.hpp>
#include <fixtures/parts.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

enum Part : std::int32_t { lower_part = 31, upper_part = 32 };

// A square hole of .2; its lower and left sides have one marker, the other two have another one.
// The corners (.4, .6) and (.6, .4) are on both.
Case halves(int n = 10) {
    Case out;
    out.mesh = square(n, Cells::quads, n / 5, n / 5);
    for (std::size_t face = 0; face < out.mesh.face_markers.size(); ++face) {
        if (out.mesh.face_markers[face] != body) continue;
        double sum = 0;
        for (std::size_t end = 2 * face; end < 2 * face + 2; ++end) {
            std::size_t const point = std::size_t(out.mesh.faces[end]);
            sum += 0.5 * (out.mesh.x[point] + out.mesh.y[point]);
        }
        out.mesh.face_markers[face] = sum < 1 ? lower_part : upper_part;
    }
    return out;
}

// Curves with control points of their own; control points 0 to 2 and 3 to 5.
Case on_two_curves(int n = 10) {
    Case out = halves(n);
    out.curves.control = {0.4, 0.6, 0.4, 0.4, 0.6, 0.4, 0.6, 0.4, 0.6, 0.6, 0.4, 0.6};
    out.curves.add_over(1, {0, 1, 2}, {0, 0, 1, 2, 2});
    out.curves.add_over(1, {3, 4, 5}, {0, 0, 1, 2, 2});
    out.put_on_curves(lower_part, 0);
    out.put_on_curves(upper_part, 1);
    return out;
}

// The same curves, the ends of which are common control points.
Case on_joined_curves() {
    Case out = halves();
    out.curves.control = {0.4, 0.6, 0.4, 0.4, 0.6, 0.4, 0.6, 0.6};
    out.curves.add_over(1, {0, 1, 2}, {0, 0, 1, 2, 2});
    out.curves.add_over(1, {2, 3, 0}, {0, 0, 1, 2, 2});
    out.put_on_curves(lower_part, 0);
    out.put_on_curves(upper_part, 1);
    return out;
}

std::vector<double> move_of(std::size_t n, std::vector<std::pair<std::size_t, Point>> const& by) {
    std::vector<double> move(2 * n, 0.0);
    for (auto const& [function, p] : by) {
        move[2 * function] = p.x;
        move[2 * function + 1] = p.y;
    }
    return move;
}

struct Judged {
    hm_status status;
    double boundary_error = 0;
    hm_error error{};
};

Judged judged(const hm_basis* basis, Mesh const& mesh, std::vector<double> const& move) {
    Judged out{};
    Moved const to = morphed(basis, mesh, move);
    out.status = hm_boundary_error(basis, move.data(), points_in(mesh.x, mesh.y),
                                   points_in(to.x, to.y), &out.boundary_error, nullptr, &out.error);
    return out;
}

bool is_at(Mesh const& mesh, std::int32_t point, double x, double y) {
    std::size_t const k = std::size_t(point);
    return std::fabs(mesh.x[k] - x) < 1e-12 && std::fabs(mesh.y[k] - y) < 1e-12;
}

}  // namespace

TEST_CASE("the analysis warns of a point that two conditions move by other functions") {
    for (std::int32_t const base : {0, 1}) {
        Case setup = on_two_curves();
        setup.index_base = base;
        Attempt attempt;
        CHECK(attempt.analyse(setup.problem()));
        CHECK(attempt.status == HM_TORN);
        INFO(attempt.error.text);
        CHECK(says(attempt.error, "also belongs to condition"));
        CHECK(attempt.error.item_kind == HM_ITEM_POINT);
        CHECK(attempt.error.item_base == base);
        std::int32_t const point = attempt.error.item - base;
        CHECK((is_at(setup.mesh, point, 0.4, 0.6) || is_at(setup.mesh, point, 0.6, 0.4)));
        CHECK(attempt.error.other_kind == HM_ITEM_CONDITION);
        CHECK(attempt.error.other - attempt.error.other_base == 1);
    }
}

TEST_CASE("a basis names shared points with both conditions, and so do bases made from it") {
    Case setup = on_two_curves();
    Solved const solved(setup);
    auto const check = [&](const hm_basis* basis) {
        hm_basis_info const info = info_of(basis);
        REQUIRE(info.shared_points == 2);
        for (std::int32_t k = 0; k < 2; ++k) {
            CHECK(info.shared_condition[2 * k] == 0);
            CHECK(info.shared_condition[2 * k + 1] == 1);
            bool is_found = false;
            for (std::int32_t i = 0; i < info.curve_points; ++i)
                is_found = is_found || info.curve_point[i] == info.shared_point[k];
            CHECK(is_found);
        }
        CHECK(info.shared_point[0] != info.shared_point[1]);
    };
    check(solved.basis);
    Single const single(solved.basis);
    check(single.basis);
    std::vector<std::int32_t> all(setup.mesh.x.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = std::int32_t(all.size() - 1 - k);
    Rows const rows(solved.basis, all);
    check(rows.basis);
    Rows const none(solved.basis, {0, 1});
    CHECK(info_of(none.basis).shared_points == 0);
    Rows const one(solved.basis, {solved.info().shared_point[1], 0});
    CHECK(info_of(one.basis).shared_points == 1);
    CHECK(info_of(one.basis).shared_point[0] == 0);
    std::vector<unsigned char> const copy = bytes_of(solved.basis);
    const hm_basis* attached = nullptr;
    REQUIRE(hm_basis_attach(&attached, copy.data(), copy.size(), nullptr, nullptr) == HM_OK);
    check(attached);
}

TEST_CASE("a movement that tears two curves apart is measured against both, and warned of") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
        for (int const n : {10, 20}) {
            Case setup = on_two_curves(n);
            Options const options = options_of(kind);
            Solved const solved(setup, options);
            Judged const together = judged(solved.basis, setup.mesh,
                                           move_of(6, {{0, {0.01, 0.02}}, {5, {0.01, 0.02}}}));
            CHECK(together.status == HM_OK);
            CHECK(together.boundary_error < 1e-15);
            Judged const apart = judged(solved.basis, setup.mesh, move_of(6, {{0, {0.03, 0.04}}}));
            CHECK(apart.status == HM_TORN);
            CHECK(apart.boundary_error == doctest::Approx(0.05));
            CHECK(apart.error.value == doctest::Approx(0.05));
            CHECK(is_at(setup.mesh, apart.error.item, 0.4, 0.6));
            CHECK(apart.error.other == 1);
            // The other curve alone: the point stays behind.
            Judged const other = judged(solved.basis, setup.mesh, move_of(6, {{3, {0, 0.01}}}));
            CHECK(other.status == HM_TORN);
            CHECK(other.boundary_error == doctest::Approx(0.01));
            CHECK(is_at(setup.mesh, other.error.item, 0.6, 0.4));
        }
    }
}

TEST_CASE("only a tear beyond a millionth of the extent counts") {
    Case setup = on_two_curves();
    Solved const solved(setup);
    double const extent = 0.2 * std::sqrt(2);
    CHECK(judged(solved.basis, setup.mesh, move_of(6, {{0, {0.9e-6 * extent, 0}}})).status ==
          HM_OK);
    CHECK(judged(solved.basis, setup.mesh, move_of(6, {{0, {1.1e-6 * extent, 0}}})).status ==
          HM_TORN);
}

TEST_CASE("curves with a common end control point move together exactly") {
    Case setup = on_joined_curves();
    Attempt attempt;
    CHECK(attempt.analyse(setup.problem()));
    CHECK(attempt.status == HM_OK);
    Solved const solved(setup);
    CHECK(solved.info().shared_points == 0);
    Judged const found = judged(solved.basis, setup.mesh, some_move(4, 0.02, 7));
    CHECK(found.status == HM_OK);
    CHECK(found.boundary_error < 1e-16);
}

TEST_CASE("two curves of one condition need a common control point, too") {
    Case setup = halves();
    setup.curves = on_two_curves().curves;
    setup.put_on_curves(lower_part, 0, 2);
    setup.put_on_curves(upper_part, 0, 2);
    Attempt attempt;
    CHECK(attempt.analyse(setup.problem()));
    CHECK(attempt.status == HM_TORN);
    Solved const solved(setup);
    CHECK(solved.info().shared_points == 2);
    CHECK(judged(solved.basis, setup.mesh, move_of(6, {{0, {0.01, 0}}})).status == HM_TORN);
    CHECK(judged(solved.basis, setup.mesh, move_of(6, {{0, {0.01, 0}}, {5, {0.01, 0}}})).status ==
          HM_OK);
}

TEST_CASE("an open curve round a body must keep its ends together") {
    Case setup = halves();
    // The ends are a little apart: at one place they would be refused before.
    setup.curves.control = {0.6, 0.4, 0.6, 0.6, 0.4, 0.6, 0.4, 0.4, 0.6, 0.4 - 1e-5};
    setup.curves.add_over(1, {0, 1, 2, 3, 4}, {0, 0, 1, 2, 3, 4, 4});
    setup.put_on_curves(lower_part);
    setup.put_on_curves(upper_part);
    Solved const solved(setup);
    REQUIRE(solved.info().shared_points == 1);
    CHECK(is_at(setup.mesh, solved.info().shared_point[0], 0.6, 0.4));
    CHECK(judged(solved.basis, setup.mesh, move_of(5, {{4, {0.01, 0}}})).status == HM_TORN);
    CHECK(judged(solved.basis, setup.mesh, move_of(5, {{4, {0.01, 0}}, {0, {0.01, 0}}})).status ==
          HM_OK);
    CHECK(judged(solved.basis, setup.mesh, move_of(5, {{2, {0.01, 0}}})).status == HM_OK);
}

TEST_CASE("a rigid body beside a curve, and two bodies that touch") {
    Case beside = on_two_curves();
    beside.conditions.clear();
    beside.put_on_curves(lower_part, 0);
    beside.set_rigid(upper_part, 0.5, 0.5);
    Solved const one(beside, options_of(HM_CONFORMAL));
    REQUIRE(one.info().shared_points == 2);
    // Function 6 is the translation of the body. The curve's ends are control points 0 and 2.
    CHECK(judged(one.basis, beside.mesh, move_of(8, {{6, {0.01, 0}}})).status == HM_TORN);
    CHECK(judged(one.basis, beside.mesh, move_of(8, {{7, {0, 0.1}}})).status == HM_TORN);
    CHECK(judged(one.basis, beside.mesh, move_of(8, {{1, {0.01, 0}}})).status == HM_OK);
    Judged const together = judged(one.basis, beside.mesh,
                                   move_of(8, {{0, {0.01, 0}}, {2, {0.01, 0}}, {6, {0.01, 0}}}));
    CHECK(together.status == HM_OK);
    CHECK(together.boundary_error < 1e-15);

    Case touching = halves();
    touching.set_rigid(lower_part, 0.4, 0.4, 0);
    touching.set_rigid(upper_part, 0.6, 0.6, 1);
    Solved const two(touching, options_of(HM_CONFORMAL));
    REQUIRE(two.info().shared_points == 2);
    CHECK(judged(two.basis, touching.mesh, move_of(4, {{0, {0.01, 0}}})).status == HM_TORN);
    CHECK(judged(two.basis, touching.mesh, move_of(4, {{0, {0.01, 0}}, {2, {0.01, 0}}})).status ==
          HM_OK);

    Case one_body = halves();
    one_body.set_rigid(lower_part, 0.5, 0.5);
    one_body.set_rigid(upper_part, 0.5, 0.5);
    Solved const whole(one_body, options_of(HM_CONFORMAL));
    CHECK(whole.info().shared_points == 0);
}

TEST_CASE("given points beside a curve are named, but their displacements are not compared") {
    Case setup = on_two_curves();
    setup.conditions.clear();
    setup.put_on_curves(lower_part, 0);
    setup.set_given(upper_part);
    Attempt attempt;
    CHECK(attempt.analyse(setup.problem()));
    CHECK(attempt.status == HM_TORN);
    Solved const solved(setup);
    CHECK(solved.info().shared_points == 2);
    CHECK(judged(solved.basis, setup.mesh, move_of(6, {{0, {0.01, 0}}})).status == HM_OK);
}

TEST_CASE("a given parameter on the other curve exchanges the two places of a shared point") {
    Case setup = on_two_curves();
    std::int32_t corner = 0;
    while (!is_at(setup.mesh, corner, 0.4, 0.6)) ++corner;
    setup.give(corner, 2, 1);
    Solved const solved(setup);
    CHECK(solved.info().shared_points == 2);
    Moved const to = morphed(solved.basis, setup.mesh, move_of(6, {{5, {0.01, 0}}}));
    CHECK(to.x[std::size_t(corner)] == doctest::Approx(0.41));
    CHECK(judged(solved.basis, setup.mesh, move_of(6, {{0, {0.01, 0}}})).status == HM_TORN);
}

TEST_CASE("safe morphs refuse a target that tears two conditions apart, and leave the mesh") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Case setup = on_two_curves();
        Safe safe(setup, options_of(kind));
        CHECK(safe.run(move_of(6, {{0, {0.01, 0.01}}})) == HM_CROSSING);
        INFO(safe.error.text);
        CHECK(says(safe.error, "away from where condition 1 takes it"));
        CHECK(safe.error.other_kind == HM_ITEM_CONDITION);
        CHECK(is_at(setup.mesh, safe.error.item, 0.4, 0.6));
        CHECK(safe.x == setup.mesh.x);
        CHECK(safe.y == setup.mesh.y);
        CHECK(safe.run(move_of(6, {{0, {0.01, 0.01}}, {5, {0.01, 0.01}}})) == HM_OK);
    }
}
