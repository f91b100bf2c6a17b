// A basis is one block that may be copied and attached again, and gives back what it was solved
// with.
#include <harmorph_design.h>

#include <fixtures/solved.hpp>
#include <fixtures/bodies.hpp>

using namespace fixtures;

TEST_CASE("a copy at another address is the same basis") {
    Case setup = two_body_case();
    std::vector<double> expected;
    Moved expected_to;
    std::vector<double> const move = some_move(20, 0.1, 1);
    std::unique_ptr<BasisCopy> copy;
    {
        Solved const solved(setup);
        expected = solved.all_values();
        expected_to = morphed(solved.basis, setup.mesh, move);
        copy = std::make_unique<BasisCopy>(solved);
    }  // the original, its plan and its analysis are gone
    hm_mesh const mesh = setup.mesh.view();
    REQUIRE(copy->attach(&mesh) == HM_OK);
    CHECK(same_bits(all_numbers(copy->basis), expected));
    Moved const to = morphed(copy->basis, setup.mesh, move);
    CHECK(same_bits(to.x, expected_to.x));
    CHECK(same_bits(to.y, expected_to.y));
    CHECK(boundary_error(copy->basis, move, setup.mesh, to) < 1e-14);
}

TEST_CASE("a basis gives back the curves, the points and the parameters of the solved problem") {
    Case setup = two_body_case();
    setup.curves.index_base = 1;
    for (CurveSet::Shape& shape : setup.curves.shapes)
        for (std::int32_t& index : shape.indices) ++index;
    for (int k = 0; k < 20; ++k) setup.curves.weights.push_back(1 + 0.01 * k);
    Solved const solved(setup);
    auto set = sized<hm_curves>();
    hm_curve shape[2];
    CHECK(hm_basis_curves(solved.basis, nullptr, nullptr, &set, shape, 1, nullptr) ==
          HM_BAD_ARGUMENT);
    REQUIRE(hm_basis_curves(solved.basis, nullptr, nullptr, &set, shape, 2, nullptr) == HM_OK);
    CHECK(hm_curves_check(&set, nullptr) == HM_OK);
    CHECK(set.n_curves == 2);
    CHECK(set.n_control == 20);
    CHECK(set.index_base == 0);
    CHECK(set.curve == shape);
    CHECK(same_bits({set.control, set.control + 40}, setup.curves.control));
    CHECK(same_bits({set.weights, set.weights + 20}, setup.curves.weights));
    for (std::size_t c = 0; c < 2; ++c) {
        CurveSet::Shape const& own = setup.curves.shapes[c];
        CHECK(shape[c].degree == own.degree);
        CHECK(same_bits({shape[c].knots, shape[c].knots + own.knots.size()}, own.knots));
        for (std::size_t k = 0; k < own.indices.size(); ++k)
            CHECK(shape[c].indices[k] == own.indices[k] - 1);
    }
    hm_basis_info const info = solved.info();
    CHECK(info.solved == 1);
    CHECK(info.points == setup.mesh.n_points());
    CHECK(info.cells == setup.mesh.n_cells());
    CHECK(info.functions == 20);
    CHECK(info.curves == 2);
    CHECK(info.curve_points == 96);
    CHECK(info.numbers_per_value == 1);
    CHECK(info.operator_kind == HM_LAPLACE);
    CHECK(info.scheme == HM_COMPACT);
    CHECK(info.engine == HM_DIRECT);
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        double xy[2];
        REQUIRE(hm_curve_point(&set, info.point_curve[k], info.point_u[k], 0, xy, nullptr) ==
                HM_OK);
        Point const p = setup.mesh.point(info.curve_point[k]);
        CHECK(distance(p, {xy[0], xy[1]}) < 0.05);
    }
}

TEST_CASE("a moved curve has the control points plus their movement and is unchanged otherwise") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    auto const n = std::size_t(solved.info().functions);
    std::vector<double> move = some_move(std::int32_t(n), 0.1, 5), control(2 * n, 7);
    hm_curves before{}, after{};
    before.struct_size = after.struct_size = sizeof before;
    hm_curve shape[2], moved[2];
    REQUIRE(hm_basis_curves(solved.basis, nullptr, nullptr, &before, shape, 2, nullptr) == HM_OK);
    REQUIRE(hm_basis_curves(solved.basis, move.data(), control.data(), &after, moved, 2, nullptr) ==
            HM_OK);
    CHECK(hm_curves_check(&after, nullptr) == HM_OK);
    CHECK(after.control == control.data());
    CHECK(after.weights == before.weights);
    CHECK(after.n_curves == before.n_curves);
    for (std::size_t k = 0; k < 2 * n; ++k) CHECK(control[k] == before.control[k] + move[k]);
    for (std::int32_t c = 0; c < after.n_curves; ++c) CHECK(moved[c].knots == shape[c].knots);
    // The wall is where it was, plus what hm_morph moves it by.
    Moved const to_places = morphed(solved.basis, setup.mesh, move);
    hm_basis_info const info = solved.info();
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        double from[2], to[2];
        REQUIRE(hm_curve_point(&before, info.point_curve[k], info.point_u[k], 0, from, nullptr) ==
                HM_OK);
        REQUIRE(hm_curve_point(&after, info.point_curve[k], info.point_u[k], 0, to, nullptr) ==
                HM_OK);
        auto const point = std::size_t(info.curve_point[k]);
        CHECK(std::abs(to_places.x[point] - setup.mesh.x[point] - (to[0] - from[0])) < 1e-13);
        CHECK(std::abs(to_places.y[point] - setup.mesh.y[point] - (to[1] - from[1])) < 1e-13);
    }
    // Refused, with outputs as they were.
    std::vector<double> const kept = control;
    move[3] = std::nan("");
    CHECK(hm_basis_curves(solved.basis, move.data(), control.data(), &after, moved, 2, nullptr) ==
          HM_BAD_ARGUMENT);
    move[3] = 0;
    CHECK(hm_basis_curves(solved.basis, move.data(), control.data(), &after, moved, 0, nullptr) ==
          HM_BAD_ARGUMENT);
    CHECK(same_bits(control, kept));
}
