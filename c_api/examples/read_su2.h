/* Reads two-dimensional meshes in the format of SU2. This is source to compile with your code, not
 * a part of the library; MIT licence.
 *
 * The reader takes NDIME= 2, NELEM with triangles (5) and quads (9), NPOIN, NMARK, MARKER_TAG,
 * MARKER_ELEMS with lines (3), in any order, comments (%), and further numbers at the ends of
 * lines. It skips markers of single points (1), such as those of SEND_RECEIVE, and other keywords.
 * It refuses three dimensions, several zones, files that are cut off, and points that do not exist.
 */
#ifndef READ_SU2_H
#define READ_SU2_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct su2_mesh { /* arrays by malloc; points count from 0 */
    int32_t n_points, n_cells, n_faces, n_markers;
    double *x, *y;       /* [n_points] */
    int32_t* cell_start; /* [n_cells+1] the points of cell k are those of cell_points from
                            cell_start[k] to cell_start[k+1]-1 */
    int32_t* cell_points;
    int32_t* face_points;  /* [2*n_faces] */
    int32_t* face_markers; /* [n_faces] numbers of names, from 0 */
    char (*names)[64];     /* [n_markers] in the order of the file */
} su2_mesh;

/* Returns 0; or 1, with the reason in message [256] and an empty mesh. */
int read_su2(const char* file, su2_mesh* mesh, char* message);
/* Returns the number of a marker; -1: there is none of this name. */
int32_t su2_marker(const su2_mesh* mesh, const char* name);
void free_su2(su2_mesh* mesh);

#ifdef __cplusplus
}
#endif

#endif
