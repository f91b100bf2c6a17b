/* usage: read_su2 FILE   What the C reader finds in an SU2 file, in the words of read_su2.f90,
 * which must find the same. */
#include "read_su2.h"
#include <stdio.h>

int main(int argc, char** argv) {
    su2_mesh mesh;
    char message[256];
    double sum = 0;
    long cells = 0, faces = 0;
    if (argc < 2) return 2;
    if (read_su2(argv[1], &mesh, message)) {
        printf("refused: %s\n", message);
        return mesh.x != NULL;
    }
    for (int32_t k = 0; k < mesh.n_points; ++k) sum += mesh.x[k] - 3 * mesh.y[k];
    for (int32_t k = 0; k < mesh.n_cells; ++k)
        for (int32_t i = mesh.cell_start[k]; i < mesh.cell_start[k + 1]; ++i)
            cells += (long)(k + 1) % 1000 * (mesh.cell_points[i] + 1);
    for (int32_t k = 0; k < mesh.n_faces; ++k)
        faces += (long)(mesh.face_markers[k] + 1) *
                 (mesh.face_points[2 * k] + 1 + 7 * (mesh.face_points[2 * k + 1] + 1));
    printf("points %d cells %d faces %d\n", (int)mesh.n_points, (int)mesh.n_cells,
           (int)mesh.n_faces);
    printf("sums %.5f %ld %ld\n", sum, cells, faces);
    for (int32_t k = 0; k < mesh.n_markers; ++k) printf("marker %s\n", mesh.names[k]);
    printf("airfoil is %d\n", (int)su2_marker(&mesh, "airfoil") + 1);
    free_su2(&mesh);
    return mesh.x != NULL;
}
