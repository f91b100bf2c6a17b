/* usage: coupling MESH.su2 MARKER <DISPLACEMENTS   Moves the mesh by displacements of wall points,
 * one set for each time step, as a coupling library gives them. Here they are text: see bend.awk.
 */
#include "read_su2.h"
#include <harmorph.h>
#include <stdio.h>
#include <stdlib.h>

static hm_error error;
static void check(hm_status status) {
    if (status < 0) exit((fprintf(stderr, "%s\n", error.text), 1));
}

int main(int argc, char** argv) {
    su2_mesh file;
    char message[256] = "usage: coupling MESH.su2 MARKER <DISPLACEMENTS";
    if (argc != 3 || read_su2(argv[1], &file, message)) exit((fprintf(stderr, "%s\n", message), 2));
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
    hm_condition given;
    HM_INIT(given);
    given.marker = su2_marker(&file, argv[2]);
    given.kind = HM_GIVEN;
    hm_problem problem;
    HM_INIT(problem);
    problem.mesh = &mesh;
    problem.n_conditions = 1;
    problem.conditions = &given;
    hm_memory first = {0}, second = {0}, work = {0};
    hm_setup setup; /* the basis has no functions; hm_assess needs the cells of this basis */
    HM_INIT(setup);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error)); /* how many bytes? */
    first.block = malloc(first.bytes);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error));
    check(hm_setup_solve(&setup, &second, NULL, &error));
    second.block = malloc(second.bytes);
    check(hm_setup_solve(&setup, &second, NULL, &error));
    check(hm_displace(setup.plan, 0, NULL, 1, NULL, NULL, NULL, &work, NULL, &error));
    work.block = malloc(work.bytes);

    int n, k = 0, steps = 0; /* the points of the wall, then dx and dy of each, step by step */
    if (scanf("%d", &n) != 1 || n < 1 || n > mesh.n_points)
        exit((fprintf(stderr, "no number of points\n"), 1));
    int32_t* points = calloc((size_t)n, sizeof *points);
    double *wall = calloc(2 * (size_t)n, sizeof *wall),
           *x = malloc(2 * sizeof *x * (size_t)mesh.n_points), worst = 1;
    for (int i = 0; i < n; ++i)
        if (scanf("%d", &points[i]) != 1) exit((fprintf(stderr, "point %d is missing\n", i), 1));
    for (; scanf("%lf", &wall[k]) == 1; k = (k + 1) % (2 * n)) {
        if (k < 2 * n - 1) continue;
        hm_quality_report quality;
        HM_INIT(quality);
        check(hm_displace(setup.plan, n, points, 1, &(hm_points){wall, wall + 1, 2}, &mesh.points,
                          &(hm_points_out){x, x + mesh.n_points, 1}, &work, NULL, &error));
        check(hm_assess(setup.basis, &mesh, &(hm_points){x, x + mesh.n_points, 1}, NULL,
                        &mesh.points, NULL, NULL, &quality, &error));
        if (quality.min_quality < worst) worst = quality.min_quality;
        if (quality.inverted > 0) break; /* here a code would factor again on the last good mesh */
        ++steps;
    }
    printf("coupling: %d steps, %d points of the wall, quality of at least %.2f\n", steps, n,
           worst);
    return steps == 0 || k > 0; /* k > 0: the input ended within a step */
}
