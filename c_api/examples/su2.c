/* usage: su2 MESH.su2 MARKER   Reads an SU2 mesh, fits a B-spline to a marker, and turns it by one
 * degree. */
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

/* The points of a marker in order along the boundary, and a curve of 20 control points through
 * them. */
static const hm_curves* fit_marker(const hm_mesh* mesh, int32_t marker) {
    hm_problem mesh_alone = {.struct_size = sizeof mesh_alone, .mesh = mesh};
    hm_analysis* analysis;
    const hm_curves* curves;
    hm_error error;
    size_t bytes;
    int32_t n = 0, is_loop = 0, *points = malloc((size_t)mesh->n_points * sizeof *points);
    double* xy = malloc(2 * (size_t)mesh->n_points * sizeof *xy);
    check(hm_analysis_size(&mesh_alone, NULL, &bytes, &error), &error);
    void* block = malloc(bytes);
    check(hm_analysis_init(&analysis, block, bytes, &mesh_alone, NULL, &error), &error);
    check(
        hm_analysis_boundary(analysis, 1, &marker, 0, points, mesh->n_points, &n, &is_loop, &error),
        &error);
    for (int32_t k = 0; k < n; ++k) {
        xy[2 * k] = mesh->points.x[points[k]];
        xy[2 * k + 1] = mesh->points.y[points[k]];
    }
    hm_points wall = {xy, xy + 1, 2};
    check(hm_fit_size(n, NULL, &bytes, &error), &error);
    check(hm_fit(&curves, malloc(bytes), bytes, &wall, n, is_loop, NULL, NULL, &error), &error);
    free(block);
    free(points);
    free(xy);
    return curves; /* in a block that stays */
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
    hm_mesh mesh = {.struct_size = sizeof mesh,
                    .n_points = file.n_points,
                    .points = {file.x, file.y, 1},
                    .cell_layout = HM_CELLS_ROWS,
                    .n_cells = file.n_cells,
                    .cell_start = file.cell_start,
                    .cell_points = file.cell_points,
                    .n_faces = file.n_faces,
                    .face_points = file.face_points,
                    .face_markers = file.face_markers};
    const hm_curves* curves = fit_marker(&mesh, marker);
    hm_condition on_curves = {.struct_size = sizeof on_curves,
                              .marker = marker,
                              .kind = HM_ON_CURVE,
                              .n_curves = curves->n_curves};
    hm_problem problem = {.struct_size = sizeof problem,
                          .mesh = &mesh,
                          .curves = curves,
                          .n_conditions = 1,
                          .conditions = &on_curves};
    hm_analysis* analysis;
    hm_plan* plan;
    hm_basis* basis;
    hm_error error;
    size_t bytes;
    check(hm_analysis_size(&problem, NULL, &bytes, &error), &error);
    check(hm_analysis_init(&analysis, malloc(bytes), bytes, &problem, NULL, &error), &error);
    check(hm_plan_size(analysis, &bytes, &error), &error);
    check(hm_plan_init(&plan, malloc(bytes), bytes, analysis, &error), &error);
    check(hm_basis_size(analysis, &bytes, &error), &error);
    check(hm_basis_init(&basis, malloc(bytes), bytes, analysis, &error), &error);
    check(hm_plan_factor(plan, NULL, &error), &error);
    check(hm_plan_solve(plan, basis, NULL, &error), &error);

    double* move = malloc(2 * (size_t)curves->n_control * sizeof *move);
    double const s = sin(0.017453292519943295), c = cos(0.017453292519943295);
    for (int32_t i = 0; i < curves->n_control; ++i) {
        double const* p = curves->control + 2 * i;
        move[2 * i] = (c - 1) * p[0] - s * p[1];
        move[2 * i + 1] = s * p[0] + (c - 1) * p[1];
    }
    hm_points_out moved = {file.x, file.y, 1};
    hm_quality_report quality = {.struct_size = sizeof quality};
    check(hm_morph(basis, move, &mesh.points, &moved, NULL, &error), &error);
    check(hm_assess(basis, &mesh, NULL, NULL, NULL, NULL, NULL, &quality, &error), &error);
    printf("%s: %d points, %d functions, %d inverted cells\n", argv[2], (int)file.n_points,
           (int)curves->n_control, (int)quality.inverted);
    free_su2(&file);
    return quality.inverted > 0;
}
