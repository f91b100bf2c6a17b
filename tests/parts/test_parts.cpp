// Parts of meshes, divided in any way, together have the equations of the whole mesh and its
// functions.

#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <fixtures/parted.hpp>

using namespace fixtures;

TEST_CASE("functions of parts are those of the whole mesh, for each operator and any partition") {
    Case setup = two_airfoils();
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
        Options const options = options_of(operator_kind);
        CAPTURE(operator_kind);
        check_agreement(setup, options, stripes(setup.mesh, 1), false);
        check_agreement(setup, options, stripes(setup.mesh, 3), false);
        check_agreement(setup, options, at_random(setup.mesh, 4), false);
        check_agreement(setup, options, stripes(setup.mesh, 2), true);
    }
}

TEST_CASE("rigid bodies, sliding and free boundaries, offset correction in parts") {
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Options options = options_of(operator_kind);
        CAPTURE(operator_kind);
        Case rigid = two_airfoils();
        rigid.conditions.clear();
        rigid.put_on_curves(body, 0);
        rigid.set_rigid(second_body, 0.4, 0.6);
        check_agreement(rigid, options, stripes(rigid.mesh, 3), true);
        Case slip = two_airfoils();
        slip.set_slip(far_field);
        check_agreement(slip, options, at_random(slip.mesh, 3), false);
        check_agreement(slip, options, stripes(slip.mesh, 2), true);
        if (operator_kind == HM_CONFORMAL) {
            options.offset_correction = 1;
            Case setup = two_airfoils();
            check_agreement(setup, options, stripes(setup.mesh, 2), false);
        } else {
            Case free = two_airfoils();
            free.set_free(far_field);
            check_agreement(free, options, at_random(free.mesh, 3), false);
        }
    }
}

TEST_CASE("periodic pairs whose sides lie in different parts") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
            Case setup = cascade(kind);
            check_agreement(setup, options_of(operator_kind), at_random(setup.mesh, 3), false);
            check_agreement(setup, options_of(operator_kind), stripes(setup.mesh, 4), true);
        }
    }
}

TEST_CASE("cuts between and inside parts") {
    Case setup = ring_case(6, 24, 1, 3);
    setup.known_points.clear();
    setup.known_curves.clear();
    setup.known_u.clear();
    // The points at angle 0 a second time, for the cells behind them: a seam.
    Mesh& mesh = setup.mesh;
    std::vector<std::int32_t> twin(mesh.x.size(), -1);
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        double y = 0;
        for (std::int32_t k = mesh.cell_start[cell]; k < mesh.cell_start[cell + 1]; ++k)
            y += mesh.y[std::size_t(mesh.cells[std::size_t(k)])];
        for (std::int32_t k = mesh.cell_start[cell]; y < 0 && k < mesh.cell_start[cell + 1]; ++k) {
            std::int32_t& point = mesh.cells[std::size_t(k)];
            std::size_t const at = std::size_t(point);
            if (mesh.x[at] < 0 || std::fabs(mesh.y[at]) > 1e-9) continue;
            if (twin[at] < 0) {
                twin[at] = mesh.add_point(mesh.point(point));
                twin.resize(mesh.x.size(), -1);
            }
            point = twin[at];
        }
    }
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        std::size_t const a = std::size_t(mesh.faces[2 * face]),
                          b = std::size_t(mesh.faces[2 * face + 1]);
        if (mesh.y[a] + mesh.y[b] >= 0) continue;
        for (std::size_t const k : {2 * face, 2 * face + 1})
            if (twin[std::size_t(mesh.faces[k])] >= 0)
                mesh.faces[k] = twin[std::size_t(mesh.faces[k])];
    }
    REQUIRE(mesh.n_points() == ring_case(6, 24, 1, 3).mesh.n_points() + 7);
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        check_agreement(setup, options_of(operator_kind), stripes(mesh, 1), false);
        check_agreement(setup, options_of(operator_kind), stripes(mesh, 3), true);
        check_agreement(setup, options_of(operator_kind), at_random(mesh, 4), false);
    }
}

TEST_CASE("given displacements in parts") {
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        for (bool const slides : {false, true}) {
            Case setup = given_instead(two_airfoils());
            if (slides) setup.set_slip(far_field);
            Options const options = options_of(operator_kind);
            Displaced whole(setup, &options);
            Field wanted(setup.mesh.x.size());
            for (std::int32_t const point : whole.points)
                wanted[std::size_t(point)] = {0.01 * std::sin(3.0 * point),
                                              0.02 * std::cos(5.0 * point)};
            Field const expected = whole.displace(whole.on_wall(wanted));
            Parted parted(cut(setup.mesh, at_random(setup.mesh, 3), true));
            REQUIRE(parted.match());
            REQUIRE(parted.equate(setup.problem(), options));
            std::vector<Field> const found = parted.displace(wanted);
            double worst = 0;
            for (std::size_t p = 0; p < found.size(); ++p)
                for (std::size_t k = 0; k < found[p].size(); ++k)
                    worst = std::max(
                        worst, std::abs(found[p][k] -
                                        expected[std::size_t(parted.parts[p].global_point[k])]));
            CHECK(worst < 1e-12);
        }
    }
}

TEST_CASE("rows of a part are combined like any basis") {
    Case setup = two_airfoils();
    Options const options = options_of(HM_CONFORMAL);
    Solved const whole(setup, &options);
    Parted parted(cut(setup.mesh, stripes(setup.mesh, 2), false));
    REQUIRE(parted.match());
    REQUIRE(parted.equate(setup.problem(), options));
    parted.solve();
    std::vector<double> matrix;
    for (std::int32_t k = 0; k < 2 * whole.info().control_points; ++k)
        matrix.push_back(std::cos(3.0 * k));
    auto const combined = [&](const hm_basis* from, std::unique_ptr<Guarded>& block) {
        std::size_t bytes = 0;
        hm_basis* out = nullptr;
        REQUIRE(fixtures::combine_size(from, 2, 1, &bytes, nullptr) == HM_OK);
        block = std::make_unique<Guarded>(bytes);
        REQUIRE(hm_combine(&out, fixtures::Memory(block->data(), bytes), from, 2, 1, matrix.data(),
                           nullptr) == HM_OK);
        return out;
    };
    std::unique_ptr<Guarded> whole_block, part_block;
    const hm_basis* const all = combined(whole.basis, whole_block);
    for (PartOfMesh& part : parted.parts) {
        const hm_basis* const own = combined(part.rows, part_block);
        for (std::int32_t number = 0; number < 2; ++number) {
            std::vector<double> const all_values = values_of(all, 1, number),
                                      values = values_of(own, 1, number);
            double worst = 0;
            for (std::size_t k = 0; k < values.size(); ++k) {
                std::size_t const at = std::size_t(part.global_point[k]);
                worst = std::max(worst, std::fabs(values[k] - all_values[at]));
            }
            CHECK(worst < 1e-11);
        }
    }
}
