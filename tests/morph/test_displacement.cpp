// Displacements given at wall points: what functions of curves give for the same wall, the
// transpose, and all that lists allow.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/o_mesh.hpp>
#include <fixtures/cascade.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/channels.hpp>

using namespace fixtures;

namespace {

struct Setting {
    const char* name;
    Options options;
};

Options with(Options options, void (*change)(Options&)) {
    change(options);
    return options;
}

std::vector<Setting> const settings = {
    {"conformal", options_of(HM_CONFORMAL)},
    {"laplace", options_of(HM_LAPLACE)},
    {"weighted", options_of(HM_WEIGHTED)},
    {"bounded", with(options_of(HM_WEIGHTED), [](Options& o) { o.scheme = HM_BOUNDED; })},
    {"multigrid", with(options_of(HM_LAPLACE),
                       [](Options& o) { o.engine = HM_MULTIGRID, o.tolerance = 1e-12; })},
    {"conformal, multigrid",
     with(options_of(HM_CONFORMAL),
          [](Options& o) { o.engine = HM_MULTIGRID, o.tolerance = 1e-12; })},
    {"fas",
     with(options_of(HM_LAPLACE), [](Options& o) { o.engine = HM_FAS, o.tolerance = 1e-11; })},
};

bool iterates(Options const& options) { return options.engine != HM_DIRECT; }

Case cut_airfoil() {
    CMesh const c = c_mesh(naca4({}, 24), 12, 8, stretched(5e-3, 8, 12));
    Case setup = airfoil_case(24, 12);
    setup.mesh = c.mesh;
    return setup;
}

// Points that slip are not for the bounded scheme and the engines that iterate. The scheme of full
// approximation takes thousands of cycles for the flat cells of the airfoil; the mesh with the cut
// has such cells as well.
enum class Engines { all, all_but_fas, direct };

struct Problem {
    const char* name;
    Case setup;
    Engines engines = Engines::all;
};

std::vector<Problem> problems() {
    Case two = two_body_case(Cells::hybrid, 8, 6), rigid = two_body_case(Cells::hybrid, 8, 6);
    rigid.conditions.clear();
    rigid.put_on_curves(body);
    rigid.set_rigid(second_body, 1.5, 0.5);
    return {{"airfoil", airfoil_case(24, 10), Engines::all_but_fas},
            {"two bodies", two},
            {"curve and rigid body", rigid},
            {"cut", cut_airfoil()},
            {"periodic", cascade(Cells::hybrid)},
            {"slip", half_ring(8, 16, Cells::hybrid, 0.2, 4), Engines::direct}};
}

bool goes_together(Problem const& problem, Options const& options) {
    switch (problem.engines) {
        case Engines::all: return true;
        case Engines::all_but_fas: return options.engine != HM_FAS;
        case Engines::direct: return !iterates(options) && options.scheme == HM_COMPACT;
    }
    return false;
}

}  // namespace

TEST_CASE("displacements given point by point move the mesh as functions do") {
    for (Problem& problem : problems())
        for (Setting const& setting : settings) {
            if (!goes_together(problem, setting.options)) continue;
            INFO(std::string(problem.name) << ", " << std::string(setting.name));
            Solved const solved(problem.setup, &setting.options);
            std::vector<double> const move = some_move(solved.report.functions, 0.1, 7);
            Field const expected = displacement(solved, move);
            Case given = given_instead(problem.setup);
            Displaced displaced(given, &setting.options);
            Field const wall = displaced.on_wall(expected), found = displaced.displace(wall);
            CHECK(largest_difference(found, expected) <
                  (iterates(setting.options) ? 1e-10 : 1e-12));
            CHECK(displaced.on_wall(found) == wall);
            CHECK(displaced.displace_report.functions == 1);
            CHECK(displaced.displace_report.residual < 1e-10);
        }
}

TEST_CASE("displacements of a given marker and of a curve add up without disturbing each other") {
    for (Setting const& setting : settings) {
        Case curves = two_body_case(Cells::hybrid, 8, 6), both = curves;
        both.conditions.clear();
        both.put_on_curves(body, 0);
        both.set_given(second_body);
        Solved const solved(curves, &setting.options);
        std::vector<double> const move = some_move(solved.report.functions, 0.1, 7);
        Field const expected = displacement(solved, move);
        Displaced displaced(both, &setting.options);
        Field found = displaced.displace(displaced.on_wall(expected));
        for (std::int32_t const point : points_on(curves.mesh, body))
            CHECK(found[std::size_t(point)] == 0.0);
        REQUIRE(hm_plan_solve(displaced.plan, displaced.basis, nullptr, nullptr) == HM_OK);
        Field const by_curve = displacement(displaced.basis, move);
        for (std::int32_t const point : displaced.points)
            CHECK(by_curve[std::size_t(point)] == 0.0);
        for (std::size_t k = 0; k < found.size(); ++k) found[k] += by_curve[k];
        INFO(std::string(setting.name));
        CHECK(largest_difference(found, expected) < (iterates(setting.options) ? 1e-10 : 1e-12));
    }
}

TEST_CASE("translations of the boundary are exact, and similarities or linear maps by operator") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (Setting const& setting : settings) {
            Case setup;
            setup.mesh = square(8, kind, 2, 2);
            perturb(setup.mesh, 0.2, 5);
            for (int const marker : {int{body}, int{left}, int{right}, int{bottom}, int{top}})
                setup.set_given(marker);
            std::int32_t const operator_kind = setting.options.operator_kind;
            Complex const similar = operator_kind == HM_WEIGHTED ? 0 : Complex(-0.3, 0.7);
            Complex const conjugate = operator_kind == HM_LAPLACE ? Complex(0.2, 0.1) : 0;
            Field expected;
            for (Complex const z : positions(setup.mesh))
                expected.push_back(similar * z + conjugate * std::conj(z) + Complex(3, 4));
            Displaced displaced(setup, &setting.options);
            INFO(std::string(setting.name));
            CHECK(largest_difference(displaced.displace(displaced.on_wall(expected)), expected) <
                  1e-10);
        }
}

TEST_CASE("the adjoint is the transpose") {
    for (Problem& problem : problems())
        for (Setting const& setting : settings) {
            if (!goes_together(problem, setting.options)) continue;
            INFO(std::string(problem.name) << ", " << std::string(setting.name));
            Case given = given_instead(problem.setup);
            Displaced displaced(given, &setting.options);
            Field const wall = some_field(displaced.points.size(), 3);
            Field const dj = some_field(std::size_t(given.mesh.n_points()), 4);
            Field const moved = displaced.displace(wall), gradient = displaced.adjoint(dj);
            double const size = dot_of_sizes(moved, dj) + dot_of_sizes(wall, gradient);
            bool const exact = !iterates(setting.options);
            CHECK(std::fabs(dot(moved, dj) - dot(wall, gradient)) < (exact ? 1e-14 : 1e-10) * size);
        }
}

TEST_CASE("many fields at once are those of single calls") {
    for (Setting const& setting : settings) {
        Case setup = given_instead(two_body_case(Cells::hybrid, 8, 6));
        Displaced displaced(setup, &setting.options);
        std::vector<Field> walls, gradients;
        for (unsigned k = 0; k < 29; ++k) {
            walls.push_back(some_field(displaced.points.size(), k));
            gradients.push_back(some_field(std::size_t(setup.mesh.n_points()), k));
        }
        std::vector<Field> const moved = displaced.displace(walls),
                                 of_wall = displaced.adjoint(gradients);
        CHECK(displaced.displace_report.functions == 29);
        double const near = iterates(setting.options) ? 1e-9 : 1e-13;
        for (std::size_t k = 0; k < walls.size(); k += 7) {
            INFO(std::string(setting.name) << ", field " << k);
            CHECK(displaced.on_wall(moved[k]) == walls[k]);
            CHECK(largest_difference(displaced.displace(walls[k]), moved[k]) < near);
            CHECK(largest_difference(displaced.adjoint(gradients[k]), of_wall[k]) < near * 100);
        }
    }
}

TEST_CASE("the same bits for any number of threads, in one block and in several") {
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Case setup = given_instead(airfoil_case(40, 10));
        Options options = options_of(operator_kind);
        Displaced serial(setup, &options);
        std::vector<Field> walls, gradients;
        for (unsigned k = 0; k < 15; ++k) {
            walls.push_back(some_field(serial.points.size(), k));
            gradients.push_back(some_field(std::size_t(setup.mesh.n_points()), k));
        }
        for (std::int32_t const n_threads : {2, 7}) {
            Backwards threads;
            hm_executor const executor = threads.executor(n_threads);
            options.executor = &executor;
            Displaced parallel(setup, &options);
            CHECK(parallel.displace(walls) == serial.displace(walls));
            CHECK(parallel.adjoint(gradients) == serial.adjoint(gradients));
        }
        options.executor = nullptr;
    }
}

TEST_CASE("lists of given points may have any order, repetitions and both sides of a cut") {
    Case setup = given_instead(cut_airfoil());
    setup.index_base = 1;
    Displaced displaced(setup);
    Field const wall = some_field(displaced.points.size(), 1);
    Field const expected = displaced.displace(wall);
    Field const dj = some_field(expected.size(), 2), gradient = displaced.adjoint(dj);

    // The trailing edge twice: a cut begins there.
    std::vector<std::int32_t> const body_points = points_on(setup.mesh, body);
    CHECK(body_points.size() == displaced.points.size() + 1);
    std::vector<std::int32_t> list;
    for (std::size_t k = body_points.size(); k-- > 0;) list.push_back(body_points[k] + 1);
    list.push_back(list[5]);
    Field by_list;
    for (std::int32_t const point : list) by_list.push_back(expected[std::size_t(point - 1)]);
    CHECK(displaced.displace(by_list, &list) == expected);
    Field const found = displaced.adjoint(dj, &list);
    CHECK(found.back() == 0.0);
    CHECK(std::fabs(dot(found, by_list) - dot(gradient, wall)) <
          1e-13 * dot_of_sizes(gradient, wall));
    CHECK(std::abs(found[5]) > 0);
}

TEST_CASE("displacements start at any coordinates, and walls that cross are refused") {
    Case setup = given_instead(tiny_case());
    Displaced displaced(setup);
    std::size_t const n = setup.mesh.x.size(), n_wall = displaced.points.size();
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y, to_x(n, 7), to_y(n, 7),
                        wall_x(n_wall, 0), wall_y(n_wall, 0.25);
    Guarded work = displaced.work_for(1);
    auto const displace = [&] {
        return hm_displace(displaced.plan, std::int32_t(n_wall), nullptr, 1,
                           points_in(wall_x, wall_y), points_in(x, y), points_out(to_x, to_y),
                           fixtures::Memory(work.data(), work.size()), nullptr, &displaced.error);
    };
    REQUIRE(displace() == HM_OK);
    CHECK(to_x == x);
    for (std::int32_t const point : displaced.points) {
        std::size_t const k = std::size_t(point);
        CHECK(to_y[k] == y[k] + 0.25);
    }
    std::vector<double> const before = to_y;

    for (std::size_t k = 0; k < n_wall; ++k) {  // the hole's left side passes its right one
        std::size_t const point = std::size_t(displaced.points[k]);
        wall_x[k] = x[point] < 3 ? 2.5 : 0;
        wall_y[k] = 0;
    }
    CHECK(displace() == HM_CROSSING);
    CHECK(displaced.error.item >= 0);
    CHECK(to_y == before);

    // After a step the plan is factored where the mesh is; the coordinates are then those of that
    // mesh.
    std::fill(wall_x.begin(), wall_x.end(), 0.125);
    REQUIRE(hm_plan_factor(displaced.plan, points_in(x, before), &displaced.error) == HM_OK);
    y = before;
    REQUIRE(displace() == HM_OK);
    for (std::int32_t const point : displaced.points)
        CHECK(to_x[std::size_t(point)] == x[std::size_t(point)] + 0.125);
}

TEST_CASE("a basis without functions: for quality, step and assessment") {
    Case setup = given_instead(airfoil_case(24, 10));
    Displaced displaced(setup);
    Field const moved = displaced.displace(Field(displaced.points.size(), Complex(0.01, 0.02)));
    const double* const xy = reinterpret_cast<const double*>(moved.data());
    auto step = sized<hm_step_report>();
    auto quality = sized<hm_quality_report>();
    for (int solved = 0; solved < 2; ++solved) {
        REQUIRE(hm_assess(displaced.basis, &setup.mesh_view(), nullptr, points_in(xy, xy + 1, 2),
                          nullptr, nullptr, &step, &quality, &displaced.error) == HM_OK);
        CHECK(step.admissible > 1);
        CHECK(quality.inverted == 0);
        auto report = sized<hm_solve_report>();
        REQUIRE(hm_plan_solve(displaced.plan, displaced.basis, &report, &displaced.error) == HM_OK);
        CHECK(report.functions == 0);
    }
}

TEST_CASE("the reported residual of a displacement is that of the solution") {
    Case setup = given_instead(airfoil_case());
    Displaced displaced(setup);
    Field const wall = some_field(displaced.points.size(), 3, 0.01),
                j = some_field(setup.mesh.x.size(), 4);
    for (bool const transposed : {false, true}) {
        displaced.displace_report.residual = -1;
        if (transposed) displaced.adjoint(j);
        else displaced.displace(wall);
        CHECK(displaced.displace_report.residual > 0);
        CHECK(displaced.displace_report.residual < 1e-11);
    }
}
