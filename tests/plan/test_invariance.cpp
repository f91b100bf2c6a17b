// The functions do not depend on the way in which a mesh is written down: numbering, orientation,
// markers, place, size.
#include <doctest/doctest.h>

#include <fixtures/operators.hpp>

using namespace fixtures;

TEST_CASE("numbering, orientation, markers, place and size of the mesh do not matter") {
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE, HM_WEIGHTED}) {
        Case const origin = airfoil_case(30, 10);
        Options const options = options_of(operator_kind);
        Case setup = origin;
        Solved const reference(setup, &options);
        auto const compare = [&](Case& changed, std::vector<std::int32_t> const& new_of,
                                 bool mirrored) {
            Solved const solved(changed, &options);
            double worst = 0;
            for (std::int32_t i = 0; i < 10; ++i) {
                Field const expected = complex_values(reference, i),
                            found = complex_values(solved, i);
                for (std::size_t k = 0; k < expected.size(); ++k) {
                    Complex const f = found[new_of.empty() ? k : std::size_t(new_of[k])];
                    worst = std::fmax(worst, std::abs((mirrored ? std::conj(f) : f) - expected[k]));
                }
            }
            CHECK(worst < 1e-10);
        };
        Case changed = origin;
        std::vector<std::int32_t> const new_of = renumber_points(changed.mesh, 3);
        shuffle_cells(changed.mesh, 4);
        compare(changed, new_of, false);
        changed = origin;
        reverse_all(changed.mesh);
        compare(changed, {}, false);
        reverse_some(changed.mesh, 5);
        rotate_starts(changed.mesh, 6);
        reverse_some_faces(changed.mesh, 7);
        split_marker(changed.mesh, body, 3, 31);
        changed.conditions.clear();
        for (std::int32_t const marker : {31, 32, 33}) changed.put_on_curves(marker);
        compare(changed, {}, false);
        changed = origin;
        for (int k = 0; k < 7; ++k) changed.mesh.add_point({1e3, 1e3});  // used by no cell
        compare(changed, {}, false);
        changed = similar(origin, std::polar(3.0, 0.7), {2, -5});
        compare(changed, {}, false);
        changed = origin;  // the mirror image has the conjugate functions
        for (double& y : changed.mesh.y) y = -y;
        for (std::size_t k = 1; k < changed.curves.control.size(); k += 2)
            changed.curves.control[k] *= -1;
        compare(changed, {}, true);
        reverse_all(changed.mesh);
        compare(changed, {}, true);
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
    problem.n_known = 1;
    problem.known_points = point.data();
    problem.known_curves = curve.data();
    problem.known_u = u.data();
    Solved theirs(problem);
    CHECK(hm_plan_solve(mine.plan, theirs.basis, nullptr, &mine.error) == HM_BAD_BASIS);
    CHECK(std::string(mine.error.text) ==
          "the plan and the basis were made from different analyses: of another mesh, "
          "or with other curves, conditions, fluxes or options");
    CHECK(hm_plan_solve(mine.plan, mine.basis, nullptr, &mine.error) == HM_OK);
}
