/* A mesh and the use of a saved basis that give the same bits on every processor: coordinates come
 * from + - * / alone, and checksums are of the numbers, whatever the order of their bytes. No C
 * library: bare machines use this, too. */
#ifndef CASE_H
#define CASE_H

#include <harmorph.h>

enum { NI = 65, NJ = 21, POINTS = NI * NJ, CONTROL = 10, WALL = 1, FAR_FIELD = 2 };

/* The mesh, what moves, and what comes out: all memory of a program that uses a basis, but the
 * basis itself. */
typedef struct case_memory {
    double x[POINTS], y[POINTS], dx[POINTS], dy[POINTS];
    int32_t lists[2 * NI], start[3], markers[2];
    double move[2 * CONTROL], gradient[2 * CONTROL];
} case_memory;

/* FNV-1a of the bits of each number, lowest byte first. */
static uint64_t add_numbers(uint64_t sum, const double* numbers, int32_t n) {
    int32_t i, shift;
    for (i = 0; i < n; ++i) {
        union {
            double number;
            uint64_t bits;
        } one;
        one.number = numbers[i];
        for (shift = 0; shift < 64; shift += 8)
            sum = (sum ^ (one.bits >> shift & 255)) * UINT64_C(1099511628211);
    }
    return sum;
}
static const uint64_t empty_sum = UINT64_C(14695981039346656037);

/* Rings round an ellipse; the first point of a ring is repeated at its end. */
static hm_mesh make_mesh(case_memory* to) {
    /* cos and sin of 2 pi / (NI - 1), by which the unit vector turns from point to point */
    const double turn_x = 0.99518472667219693, turn_y = 0.098017140329560604;
    double unit_x = 1, unit_y = 0;
    hm_mesh mesh;
    int i, j;
    HM_INIT(mesh);
    for (i = 0; i < NI; ++i) {
        const double next_x = unit_x * turn_x - unit_y * turn_y;
        double r = 1;
        if (i == NI - 1)
            unit_x = 1, unit_y = 0; /* where the ring began, not where rounding has led */
        for (j = 0; j < NJ; ++j, r *= 1.15) {
            to->x[i + NI * j] = (r + 0.5 / r) * unit_x;
            to->y[i + NI * j] = (r - 0.5 / r) * unit_y;
        }
        unit_y = unit_x * turn_y + unit_y * turn_x;
        unit_x = next_x;
        to->lists[i] = i;
        to->lists[NI + i] = i + NI * (NJ - 1);
    }
    to->start[0] = 0, to->start[1] = NI, to->start[2] = 2 * NI;
    to->markers[0] = WALL, to->markers[1] = FAR_FIELD;
    mesh.n_points = POINTS;
    mesh.points.x = to->x, mesh.points.y = to->y, mesh.points.stride = 1;
    mesh.cell_layout = HM_CELLS_STRUCTURED;
    mesh.ni = NI, mesh.nj = NJ;
    mesh.n_lists = 2;
    mesh.list_start = to->start, mesh.list_points = to->lists, mesh.list_markers = to->markers;
    return mesh;
}

/* A bulge: every control point moves, neighbours by nearly the same. */
static void make_move(double size, double* move) {
    int i;
    for (i = 0; i < CONTROL; ++i) {
        move[2 * i] = size * (i < CONTROL / 2 ? 0.5 - 0.1 * i : 0.1 * i - 0.5);
        move[2 * i + 1] = size * 0.04 * i * (CONTROL - i);
    }
}

/* Attaches the basis, takes the displacement, the admissible step, the adjoint, and moves the mesh
 * by half the step that is admissible, or by the whole movement. *sum: of all results. The mesh's
 * points are those of `with`. */
static hm_status use_basis(const void* block, size_t bytes, const hm_mesh* mesh, case_memory* with,
                           uint64_t* sum, hm_error* error) {
    hm_points displacement;
    hm_points_out to_displacement, to_mesh;
    hm_step_report step;
    const hm_basis* basis = NULL;
    hm_status status = hm_basis_attach(&basis, block, bytes, mesh, error);
    int i;
    if (status != HM_OK) return status;
    HM_INIT(step);
    make_move(0.2, with->move);
    displacement.x = to_displacement.x = with->dx, displacement.y = to_displacement.y = with->dy;
    displacement.stride = to_displacement.stride = to_mesh.stride = 1;
    to_mesh.x = with->x, to_mesh.y = with->y;
    *sum = empty_sum;
    if ((status = hm_morph(basis, with->move, NULL, &to_displacement, NULL, error)) != HM_OK)
        return status;
    *sum = add_numbers(add_numbers(*sum, with->dx, POINTS), with->dy, POINTS);
    status = hm_assess(basis, mesh, NULL, &displacement, NULL, NULL, &step, NULL, error);
    if (status != HM_OK) return status;
    *sum = add_numbers(*sum, &step.admissible, 1);
    if ((status = hm_adjoint(basis, &displacement, with->gradient, NULL, error)) != HM_OK)
        return status;
    *sum = add_numbers(*sum, with->gradient, 2 * CONTROL);
    for (i = 0; i < 2 * CONTROL; ++i)
        with->move[i] *= step.admissible < 2 ? 0.5 * step.admissible : 1;
    if ((status = hm_morph(basis, with->move, &mesh->points, &to_mesh, NULL, error)) != HM_OK)
        return status;
    *sum = add_numbers(add_numbers(*sum, with->x, POINTS), with->y, POINTS);
    return HM_OK;
}

#endif
