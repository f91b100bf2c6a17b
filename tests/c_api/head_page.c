/* The lines of the head page of harmorph.h, on an O-mesh: head_page.inc has the shortest use,
 * head_page_before.inc what to ask before the mesh moves (headers.sh). The wall follows the control
 * points exactly, the far field stays, and hm_adjoint is the transpose of hm_morph. */
#include <harmorph.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NI = 97, NJ = 25 };

static double x[NI * NJ], y[NI * NJ], new_x[NI * NJ], new_y[NI * NJ];
static double dx[NI * NJ], dy[NI * NJ], gx[NI * NJ], gy[NI * NJ];

int main(void) {
    const int32_t wall = 5, start[] = {0, NI, 2 * NI}, markers[] = {5, 6};
    int32_t lists[2 * NI];
    double move[2 * 20], gradient[2 * 20], wrong = 0, by_points = 0, by_control = 0;
    hm_points dj = {gx, gy, 1};
    hm_points_out to = {new_x, new_y, 1};
    const hm_curves* curves;
    hm_mesh mesh;
    hm_error error;
    int k;
    for (k = 0; k < NI * NJ; ++k) {
        const double angle = 6.283185307179586 * (k % NI % (NI - 1)) / (NI - 1),
                     r = exp(2.5 * (k / NI) / (NJ - 1));
        x[k] = (r + 0.5 / r) * cos(angle);
        y[k] = (r - 0.5 / r) * sin(angle);
    }
    for (k = 0; k < NI; ++k) {
        lists[k] = k;
        lists[NI + k] = k + NI * (NJ - 1);
    }
    for (k = 0; k < 20; ++k) { /* a translation of all control points: of the wall, too */
        move[2 * k] = 0.01;
        move[2 * k + 1] = -0.02;
    }
    HM_INIT(mesh);
    mesh.n_points = NI * NJ;
    mesh.points.x = x;
    mesh.points.y = y;
    mesh.cell_layout = HM_CELLS_STRUCTURED;
    mesh.ni = NI;
    mesh.nj = NJ;
    mesh.n_lists = 2;
    mesh.list_start = start;
    mesh.list_points = lists;
    mesh.list_markers = markers;
    error.code = HM_OK;

#include "head_page.inc"

    for (k = 0; k < NI; ++k) {
        wrong = fmax(wrong, fabs(new_x[k] - x[k] - 0.01) + fabs(new_y[k] - y[k] + 0.02));
        wrong = fmax(wrong, fabs(new_x[k + NI * (NJ - 1)] - x[k + NI * (NJ - 1)]));
    }
    for (k = 0; k < NI * NJ; ++k) {
        gx[k] = sin(k);
        gy[k] = cos(2 * k);
        new_x[k] = new_y[k] = 0;
    }

#include "head_page_before.inc"

    for (k = 0; k < NI * NJ; ++k) {
        by_points += gx[k] * dx[k] + gy[k] * dy[k];
        wrong = fmax(wrong, fabs(new_x[k] - x[k] - dx[k]) + fabs(new_y[k] - y[k] - dy[k]));
    }
    for (k = 0; k < 2 * 20; ++k) by_control += gradient[k] * move[k];
    wrong = fmax(wrong, 1e-3 * fabs(by_points - by_control));
    if (quality.inverted > 0 || quality.self_crossing) wrong = 1;
    if (error.code < 0) printf("%s\n", error.text);
    return error.code < 0 || !(wrong < 1e-14);
}
