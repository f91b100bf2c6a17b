// Morph, adjoint, step and quality of parts of meshes: those of the whole mesh, also for polygons.

#include <fixtures/parted.hpp>
#include <fixtures/polygons.hpp>

using namespace fixtures;

TEST_CASE("morph, adjoint, step and quality of parts are those of the whole mesh") {
    Case setup = two_airfoils();
    check_judgement(setup, options_of(HM_CONFORMAL), 0.02);
    check_judgement(setup, options_of(HM_CONFORMAL), 2);  // inverts cells
}

TEST_CASE("polygons in parts are divided and judged as in the whole mesh") {
    Case honeycombs, hanging;
    honeycombs.mesh = honeycomb(6, 24, 0.5, 4);
    honeycombs.curves = ring(3, 8, 0.5, 0.5);
    honeycombs.put_on_curves(body);
    hanging.mesh = refined(square(12, Cells::quads, 4, 4), [](Point p) {
        return std::fabs(p.x - 0.5) < 0.3 && std::fabs(p.y - 0.5) < 0.3;
    });
    hanging.curves =
        polyline({{1.0 / 3, 1.0 / 3}, {2.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3}, {1.0 / 3, 2.0 / 3}});
    hanging.put_on_curves(body);
    for (Case* const setup : {&honeycombs, &hanging}) {
        setup->mesh.cell_layout = HM_CELLS_POLYGONS;
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
            CAPTURE(operator_kind);
            check_agreement(*setup, options_of(operator_kind), stripes(setup->mesh, 1), false);
            check_agreement(*setup, options_of(operator_kind), at_random(setup->mesh, 3), false);
            check_agreement(*setup, options_of(operator_kind), stripes(setup->mesh, 3), true);
        }
        check_judgement(*setup, options_of(HM_CONFORMAL), 0.02);
        check_judgement(*setup, options_of(HM_CONFORMAL), 0.4);  // inverts cells
    }
}
