// The functions do not depend on the way in which a mesh is written down: numbering, orientation,
// markers, place, units.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>

using namespace fixtures;

TEST_CASE("neither renumbering nor cell starts nor orientation nor rotation changes a function") {
    Case const origin = airfoil_case();
    Case setup = origin;
    Solved const reference(setup);
    std::vector<double> const expected = reference.all_values();
    std::int32_t const n = origin.mesh.n_points();
    auto const compare = [&](Case& changed, std::vector<std::int32_t> const& new_of) {
        Solved const solved(changed);
        std::vector<double> const values = solved.all_values();
        std::int32_t const n_new = changed.mesh.n_points();
        double worst = 0;
        for (std::int32_t i = 0; i < reference.report.functions; ++i)
            for (std::int32_t k = 0; k < n; ++k) {
                std::int32_t const at = new_of.empty() ? k : new_of[static_cast<std::size_t>(k)];
                double const d = values[static_cast<std::size_t>(i * n_new + at)] -
                                 expected[static_cast<std::size_t>(i * n + k)];
                worst = std::fmax(worst, std::fabs(d));
            }
        CHECK(worst < 1e-11);
    };
    {
        Case changed = origin;
        std::vector<std::int32_t> const new_of = renumber_points(changed.mesh, 3);
        shuffle_cells(changed.mesh, 4);
        compare(changed, new_of);
    }
    {
        Case changed = origin;
        rotate_starts(changed.mesh, 5);
        reverse_some_faces(changed.mesh, 6);
        compare(changed, {});
    }
    {
        Case changed = origin;
        reverse_all(changed.mesh);
        compare(changed, {});
        reverse_some(changed.mesh, 7);
        compare(changed, {});
    }
    {
        Case changed = origin;
        for (int k = 0; k < 7; ++k) changed.mesh.add_point({1e3, 1e3});  // used by no cell
        split_marker(changed.mesh, body, 3, 31);
        changed.conditions.clear();
        for (std::int32_t const marker : {31, 32, 33}) changed.put_on_curves(marker);
        compare(changed, {});
    }
    {
        Case changed = origin;
        double const c = std::cos(0.7), s = std::sin(0.7);
        auto const turn = [&](double& x, double& y) {
            double const old = x;
            x = c * old - s * y + 3;
            y = s * old + c * y - 2;
        };
        for (std::size_t k = 0; k < changed.mesh.x.size(); ++k)
            turn(changed.mesh.x[k], changed.mesh.y[k]);
        for (std::size_t k = 0; k < changed.curves.control.size(); k += 2)
            turn(changed.curves.control[k], changed.curves.control[k + 1]);
        compare(changed, {});
    }
}

TEST_CASE("units that differ by a power of two: the same bits") {
    for (double const unit : {std::ldexp(1.0, -30), std::ldexp(1.0, 20)}) {
        Case setup = airfoil_case(), scaled = setup;
        for (double& x : scaled.mesh.x) x *= unit;
        for (double& y : scaled.mesh.y) y *= unit;
        for (double& c : scaled.curves.control) c *= unit;
        Solved const a(setup), b(scaled);
        CHECK(same_bits(a.all_values(), b.all_values()));
        CHECK(b.report.max_distance == unit * a.report.max_distance);
    }
}

TEST_CASE("units near the limits of doubles do not overflow the order of the unknowns") {
    Case setup = airfoil_case();
    Solved const reference(setup);
    std::vector<double> const expected = reference.all_values();
    for (int const power : {-200, 130, 300}) {
        Case scaled = setup;
        for (double& x : scaled.mesh.x) x = std::ldexp(x, power);
        for (double& y : scaled.mesh.y) y = std::ldexp(y, power);
        for (double& c : scaled.curves.control) c = std::ldexp(c, power);
        Solved const solved(scaled);
        std::vector<double> const values = solved.all_values();
        double worst = 0;
        for (std::size_t k = 0; k < values.size(); ++k)
            worst = std::fmax(worst, std::fabs(values[k] - expected[k]));
        CHECK(worst < 1e-11);
    }
}

TEST_CASE("a plan does not solve the basis of another problem on the same mesh") {
    Case setup = airfoil_case(), other = setup;
    std::vector<std::int32_t> point{setup.mesh.faces[0]},
        curve{0};  // the same counts, one parameter changed
    Solved mine(setup);
    hm_basis_info const info = mine.info();
    std::vector<double> u{info.point_u[0] + 1e-3};
    point[0] = info.curve_point[0];
    hm_problem problem = other.problem();
    problem.n_given = 1;
    problem.given_points = point.data();
    problem.given_curves = curve.data();
    problem.given_u = u.data();
    Solved theirs(problem);
    CHECK(hm_plan_solve(mine.plan, theirs.basis, nullptr, &mine.error) == HM_BAD_BASIS);
    CHECK(std::string(mine.error.text) ==
          "the plan and the basis were made from different analyses");
    CHECK(hm_plan_solve(mine.plan, mine.basis, nullptr, &mine.error) == HM_OK);
}
