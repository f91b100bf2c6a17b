/* Mesh files for the Python package: the readers of the program harmorph behind a C interface. A
 * call that fails returns NULL and writes one sentence to text [capacity]. Nothing prints, and no
 * call writes a file. */
#ifndef HARMORPH_PYTHON_MESH_FILES_H
#define HARMORPH_PYTHON_MESH_FILES_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hmpy_file hmpy_file; /* a mesh with the text of its file */
typedef struct hmpy_text hmpy_text; /* the bytes of a file to write */

/* Reads a mesh file. format and zone: as --format and --zone of the program; "" leaves the choice
 * to the content. */
hmpy_file* hmpy_read(const char* path, const char* format, const char* zone, char* text,
                     int32_t capacity);
void hmpy_file_free(hmpy_file* file);
/* A view of the mesh: points, cells as rows or polygons, faces with the markers 0, 1, .... */
void hmpy_file_mesh(const hmpy_file* file, hm_mesh* mesh);
int32_t hmpy_file_markers(const hmpy_file* file);
const char* hmpy_file_marker(const hmpy_file* file, int32_t marker, size_t* length);
int32_t hmpy_file_remarks(const hmpy_file* file);
const char* hmpy_file_remark(const hmpy_file* file, int32_t remark);

/* The same file with other coordinates x, y [n_points]; path: the name that the file will have. */
hmpy_text* hmpy_moved(const hmpy_file* file, const char* path, const double* x, const double* y,
                      char* text, int32_t capacity);
/* A new file of the mesh; the extension of `path`, or the format if the name is not "", chooses the
 * format. Names of markers [n_markers] are NUL-terminated. */
hmpy_text* hmpy_created(const hm_mesh* mesh, int32_t n_markers, const char* const* names,
                        const char* path, const char* format, char* text, int32_t capacity);
const char* hmpy_text_bytes(const hmpy_text* written, size_t* length);
void hmpy_text_free(hmpy_text* written);
/* The file that a mesh with this path is read from and written to: for OpenFOAM the file of the
 * points. Writes the path to text [capacity] and returns 1, or returns 0 if there is no room. */
int32_t hmpy_place(const char* path, char* text, int32_t capacity);
/* The file with names of markers beside a file of this mesh with this path, in the same way; "":
 * the names are in the mesh. */
int32_t hmpy_names_place(const hmpy_file* file, const char* path, char* text, int32_t capacity);

typedef struct hmpy_section hmpy_section; /* the outline of an airfoil file */
/* Reads an airfoil file as the program does; element: from 1, or 0 for the only one. */
hmpy_section* hmpy_read_section(const char* path, int32_t element, char* text, int32_t capacity);
void hmpy_section_free(hmpy_section* section);
int32_t hmpy_section_points(const hmpy_section* section);
const double* hmpy_section_x(const hmpy_section* section);
const double* hmpy_section_y(const hmpy_section* section);
const char* hmpy_section_layout(const hmpy_section* section);
/* Warning k, from 0, or NULL behind the last one. */
const char* hmpy_section_warning(const hmpy_section* section, int32_t k);

#ifdef __cplusplus
}
#endif
#endif
