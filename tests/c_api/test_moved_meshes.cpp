// Calls that begin at the mesh's own coordinates, after the caller has moved the mesh in place.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/refused.hpp>

using namespace fixtures;

namespace {

// The arrays of the mesh are the caller's, and change.
struct Objects {
    Case setup = airfoil_case();
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    hm_points own{x.data(), y.data(), 1};
    hm_points_out in_place{x.data(), y.data(), 1};
    hm_mesh mesh = setup.mesh_view();
    Options options = options_of(HM_CONFORMAL);
    std::unique_ptr<Solved> solved;
    std::vector<double> move, work;

    Objects() {
        mesh.points = own;
        solved = std::make_unique<Solved>(setup.problem(mesh), &options);
        move.assign(setup.curves.control.size(), 0);
        for (std::size_t k = 0; k < move.size(); k += 2)
            move[k + 1] = 0.1 * setup.curves.control[k];
        std::size_t safe = 0, improve = 0;
        REQUIRE(safe_move_size(solved->plan, solved->basis, &safe, nullptr) == HM_OK);
        REQUIRE(fixtures::improve_size(solved->plan, &improve, nullptr) == HM_OK);
        work.resize((safe > improve ? safe : improve) / 8 + 1);
    }
    hm_status go() {
        return hm_morph(solved->basis, move.data(), &own, &in_place, nullptr, nullptr);
    }
    hm_status safe(hm_points_out const& to, hm_error* error) {
        return safe_move(solved->plan, solved->basis, move.data(), &to, nullptr, work.data(),
                         work.size() * 8, nullptr, nullptr, error);
    }
    hm_status improve(hm_points_out const& to, hm_improve_options const* asked,
                      hm_improve_report* report, hm_error* error) {
        return hm_improve(solved->plan, &own, &to, fixtures::Memory(work.data(), work.size() * 8),
                          asked, report, error);
    }
};

}  // namespace

TEST_CASE("a safe morph from a mesh that was moved in place needs a new solution there") {
    Objects o;
    std::vector<double> x(o.x.size()), y(o.x.size());
    hm_points_out const to{x.data(), y.data(), 1};
    CHECK(o.safe(to, nullptr) == HM_OK);
    REQUIRE(o.go() == HM_OK);
    check_texts({{HM_BAD_MESH,
                  "the mesh has moved since the basis was solved; solve the basis again, or "
                  "restore the coordinates",
                  [&](hm_error* e) { return o.safe(to, e); }}});
    REQUIRE(hm_plan_factor(o.solved->plan, nullptr, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(o.solved->plan, o.solved->basis, nullptr, nullptr) == HM_OK);
    CHECK(o.safe(to, nullptr) == HM_OK);
    o.x = o.setup.mesh.x;  // the functions are those of the moved mesh now
    o.y = o.setup.mesh.y;
    CHECK(o.safe(to, nullptr) == HM_BAD_MESH);
}

TEST_CASE("a mesh that was moved in place is improved only with the reference from before") {
    Objects o;
    REQUIRE(o.go() == HM_OK);
    std::vector<double> x(o.x.size()), y(o.x.size());
    hm_points_out const to{x.data(), y.data(), 1};
    check_texts({{HM_BAD_MESH,
                  "the mesh has moved since the analysis; give the coordinates before the movement "
                  "as options.reference",
                  [&](hm_error* e) { return o.improve(to, nullptr, nullptr, e); }}});
    hm_points const before{o.setup.mesh.x.data(), o.setup.mesh.y.data(), 1};
    auto asked = sized<hm_improve_options>();
    asked.reference = &before;
    auto report = sized<hm_improve_report>();
    CHECK(o.improve(to, &asked, &report, nullptr) == HM_OK);
    CHECK(report.min_quality * report.mean_quality >
          report.min_quality_before * report.mean_quality_before);
}

TEST_CASE("a mesh of other cells is refused, also with as many points and cells as the basis has") {
    Objects o;
    std::vector<double> const still(o.x.size());
    hm_points const none{still.data(), still.data(), 1};
    auto quality = sized<hm_quality_report>();
    auto step = sized<hm_step_report>();
    std::vector<std::int32_t> turned(
        o.setup.mesh.cells);  // each point has the number of the next one
    for (std::int32_t& point : turned) point = (point + 1) % o.mesh.n_points;
    hm_mesh renumbered = o.mesh, other_cell = o.mesh;
    renumbered.cell_points = turned.data();
    std::vector<std::int32_t> changed(
        o.setup.mesh.cells);  // the last of the 64 cells that are compared
    std::int32_t const first = o.setup.mesh.cell_start[std::size_t(63LL * o.mesh.n_cells / 64)];
    std::swap(changed[std::size_t(first)], changed[std::size_t(first) + 1]);
    other_cell.cell_points = changed.data();
    const char* const text = "the basis belongs to another mesh, because the cells differ";
    hm_basis* const basis = o.solved->basis;
    auto const measure = [&](hm_mesh const& mesh, hm_error* e) {
        return hm_assess(basis, &mesh, nullptr, nullptr, nullptr, nullptr, nullptr, &quality, e);
    };
    check_texts({
        {HM_BAD_BASIS, text, [&](hm_error* e) { return measure(renumbered, e); }},
        {HM_BAD_BASIS, text, [&](hm_error* e) { return measure(other_cell, e); }},
        {HM_BAD_BASIS, text,
         call_by(hm_assess, basis, &renumbered, nullptr, &none, nullptr, nullptr, &step, nullptr)},
        {HM_BAD_BASIS, text,
         call_by(hm_assess, basis, &renumbered, nullptr, &none, nullptr, nullptr, &step, &quality)},
    });
    CHECK(measure(o.mesh, nullptr) == HM_OK);
}

TEST_CASE("a morph into arrays that share numbers of other points is refused and changes nothing") {
    Objects o;
    std::int32_t const n = o.mesh.n_points;
    std::vector<double> pairs(2 * o.x.size() + 4);
    for (std::size_t k = 0; k < o.x.size(); ++k) {
        pairs[2 * k] = o.x[k];
        pairs[2 * k + 1] = o.y[k];
    }
    std::vector<double> const as_given = pairs;
    double* const xy = pairs.data();
    auto const morph = [&](hm_points from, hm_points_out to) {
        return [&o, from, to](hm_error* e) {
            return hm_morph(o.solved->basis, o.move.data(), &from, &to, nullptr, e);
        };
    };
    check_texts({
        {HM_BAD_ARGUMENT, "to.x and to.y have numbers in common; set the stride to 2 for x,y pairs",
         morph({xy, xy + 1, 2}, {xy, xy + 1, 1})},
        {HM_BAD_ARGUMENT,
         "from.x and from.y have numbers in common; set the stride to 2 for x,y pairs",
         morph({xy + 1, xy, 0}, {xy, xy + 1, 2})},
        {HM_BAD_ARGUMENT,
         "to and from have numbers in common, but at other points; give the same arrays or "
         "separate ones",
         morph({xy, xy + 1, 2}, {xy + 2, xy + 3, 2})},
        {HM_BAD_ARGUMENT,
         "to and from have numbers in common, but at other points; give the same arrays or "
         "separate ones",
         morph({xy, xy + n, 1}, {xy + n, xy, 1})},
    });
    CHECK(pairs == as_given);
    CHECK(morph({xy, xy + 1, 2}, {xy, xy + 1, 2})(nullptr) == HM_OK);
}
