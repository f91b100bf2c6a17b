/* usage: su2 MESH.su2 MARKER   Reads an SU2 mesh, fits a B-spline to a marker, and rotates it by
 * one degree. */
#include "read_su2.h"
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

int main(int argc, char** argv) {
    su2_mesh file;
    char message[256];
    if (argc != 3) {
        fprintf(stderr, "usage: su2 MESH.su2 MARKER\n");
        return 2;
    }
    if (read_su2(argv[1], &file, message)) {
        fprintf(stderr, "%s: %s\n", argv[1], message);
        return 1;
    }
    int32_t const marker = su2_marker(&file, argv[2]);
    if (marker < 0) {
        fprintf(stderr, "%s has no marker %s\n", argv[1], argv[2]);
        return 1;
    }
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.n_points = file.n_points;
    mesh.points = (hm_points){file.x, file.y, 1};
    mesh.cell_layout = HM_CELLS_ROWS;
    mesh.n_cells = file.n_cells;
    mesh.cell_start = file.cell_start;
    mesh.cell_points = file.cell_points;
    mesh.n_faces = file.n_faces;
    mesh.face_points = file.face_points;
    mesh.face_markers = file.face_markers;
    const hm_curves* curves; /* of 20 control points; two curves if the trailing edge is blunt */
    hm_error error;
    hm_memory of_curve = {0}, first = {0}, second = {0};
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &marker, NULL, NULL, &error), &error);
    of_curve.block = malloc(of_curve.bytes);
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &marker, NULL, NULL, &error), &error);

    hm_condition on_curves;
    HM_INIT(on_curves);
    on_curves.marker = marker;
    on_curves.kind = HM_ON_CURVE;
    on_curves.n_curves = curves->n_curves;
    hm_problem problem;
    HM_INIT(problem);
    problem.mesh = &mesh;
    problem.curves = curves;
    problem.n_conditions = 1;
    problem.conditions = &on_curves;
    hm_setup setup;
    HM_INIT(setup);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error), &error);
    first.block = malloc(first.bytes);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error), &error);
    check(hm_setup_solve(&setup, &second, NULL, &error), &error);
    second.block = malloc(second.bytes);
    check(hm_setup_solve(&setup, &second, NULL, &error), &error);
    const hm_basis* const basis = setup.basis;

    double* move = malloc(2 * (size_t)curves->n_control * sizeof *move);
    double const s = sin(0.017453292519943295), c = cos(0.017453292519943295);
    for (int32_t i = 0; i < curves->n_control; ++i) {
        double const* p = curves->control + 2 * i;
        move[2 * i] = (c - 1) * p[0] - s * p[1];
        move[2 * i + 1] = s * p[0] + (c - 1) * p[1];
    }
    hm_points_out moved = {file.x, file.y, 1};
    hm_quality_report quality;
    HM_INIT(quality);
    check(hm_morph(basis, move, &mesh.points, &moved, NULL, &error), &error);
    check(hm_assess(basis, &mesh, NULL, NULL, NULL, NULL, NULL, &quality, &error), &error);
    printf("%s: %d points, %d functions, %d inverted cells\n", argv[2], (int)file.n_points,
           (int)curves->n_control, (int)quality.inverted);
    free_su2(&file);
    return quality.inverted > 0;
}
