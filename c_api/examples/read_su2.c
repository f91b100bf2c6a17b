/* See read_su2.h. */
#include "read_su2.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    FILE* file;
    int line_number;
    int32_t markers, markers_said;
    char line[512];
    char* message; /* [256] the first error */
} reader;

static int refuse(reader* from, const char* reason, const char* name) {
    if (from->message[0] != '\0') return 1;
    if (from->line_number > 0)
        snprintf(from->message, 256, "line %d: %.80s%.136s", from->line_number, reason, name);
    else snprintf(from->message, 256, "%.80s%.136s", reason, name);
    return 1;
}

/* Reads the next line that is neither empty nor a comment. Returns 0 at the end of the file. */
static int next_line(reader* from) {
    while (fgets(from->line, sizeof from->line, from->file) != NULL) {
        ++from->line_number;
        from->line[strcspn(from->line, "%\r\n")] = '\0';
        if (from->line[strspn(from->line, " \t")] != '\0') return 1;
    }
    return 0;
}

static int need_line(reader* from, const char* what, int32_t k, int32_t n) {
    char text[136];
    if (next_line(from)) return 0;
    if (n > 0) snprintf(text, sizeof text, "%s: %ld of %ld", what, (long)k + 1, (long)n);
    else snprintf(text, sizeof text, "%s", what);
    return refuse(from, "the file ends among the ", text);
}

/* Returns the text behind "key =", or NULL if the line has another key. */
static const char* value_of(const char* line, const char* key) {
    size_t length = strlen(key);
    line += strspn(line, " \t");
    if (strncmp(line, key, length) != 0) return NULL;
    line += length + strspn(line + length, " \t");
    return *line == '=' ? line + 1 : NULL;
}

static int read_count(reader* from, const char* value, int32_t* n) {
    long found;
    if (sscanf(value, "%ld", &found) != 1 || found < 0 || found > 1 << 30)
        return refuse(from, "expected a number behind =", "");
    *n = (int32_t)found;
    return 0;
}

/* Makes room for `more` numbers, of so many bytes each, behind the first n. Returns NULL only if
 * there is no memory. */
static void* grown(void* array, size_t n, size_t more, size_t bytes) {
    return realloc(array, (n + more + 1) * bytes);
}

static int read_cells(reader* from, int32_t n, su2_mesh* mesh) {
    free(mesh->cell_start);
    free(mesh->cell_points);
    mesh->n_cells = n;
    mesh->cell_start = malloc(((size_t)n + 1) * sizeof *mesh->cell_start);
    mesh->cell_points = malloc((4 * (size_t)n + 1) * sizeof *mesh->cell_points);
    if (mesh->cell_start == NULL || mesh->cell_points == NULL)
        return refuse(from, "no memory for so many cells", "");
    int32_t used = 0;
    for (int32_t k = 0; k < n; ++k) {
        int kind, found, p[4];
        if (need_line(from, "cells", k, n)) return 1;
        found = sscanf(from->line, "%d %d %d %d %d", &kind, &p[0], &p[1], &p[2], &p[3]) - 1;
        if (found < 0 || (kind != 5 && kind != 9))
            return refuse(from, "expected a triangle (5 and 3 points) or a quad (9 and 4 points)",
                          "");
        int const m = kind == 5 ? 3 : 4;
        if (found < m) return refuse(from, "a cell has too few points", "");
        mesh->cell_start[k] = used;
        for (int i = 0; i < m; ++i) mesh->cell_points[used++] = p[i];
    }
    mesh->cell_start[n] = used;
    return 0;
}

static int read_points(reader* from, int32_t n, su2_mesh* mesh) {
    free(mesh->x);
    free(mesh->y);
    mesh->n_points = n;
    mesh->x = malloc(((size_t)n + 1) * sizeof *mesh->x);
    mesh->y = malloc(((size_t)n + 1) * sizeof *mesh->y);
    if (mesh->x == NULL || mesh->y == NULL) return refuse(from, "no memory for so many points", "");
    for (int32_t k = 0; k < n; ++k) {
        if (need_line(from, "points", k, n)) return 1;
        if (sscanf(from->line, "%lf %lf", &mesh->x[k], &mesh->y[k]) != 2)
            return refuse(from, "expected the two coordinates of a point", "");
    }
    return 0;
}

/* Reads the rest of a marker, whose tag has been read: MARKER_ELEMS, perhaps SEND_TO, the faces. */
static int read_marker(reader* from, const char* tag, su2_mesh* mesh) {
    char name[64] = "";
    const char* value = NULL;
    char what[88];
    int32_t n = 0, kept = 0;
    sscanf(tag, "%63s", name);
    ++from->markers;
    while (value == NULL) {
        if (need_line(from, "markers", 0, 0)) return 1;
        value = value_of(from->line, "MARKER_ELEMS");
        if (value == NULL && value_of(from->line, "SEND_TO") == NULL)
            return refuse(from, "expected MARKER_ELEMS= of marker ", name);
    }
    if (read_count(from, value, &n)) return 1;
    snprintf(what, sizeof what, "faces of marker %s", name);
    void* points = grown(mesh->face_points, 2 * (size_t)mesh->n_faces, 2 * (size_t)n,
                         sizeof *mesh->face_points);
    if (points != NULL) mesh->face_points = points;
    void* markers =
        grown(mesh->face_markers, (size_t)mesh->n_faces, (size_t)n, sizeof *mesh->face_markers);
    if (markers != NULL) mesh->face_markers = markers;
    void* names = grown(mesh->names, (size_t)mesh->n_markers, 1, sizeof *mesh->names);
    if (names != NULL) mesh->names = names;
    if (points == NULL || markers == NULL || names == NULL)
        return refuse(from, "no memory for the faces of marker ", name);
    for (int32_t k = 0; k < n; ++k) {
        int kind, found, p[2];
        if (need_line(from, what, k, n)) return 1;
        if (value_of(from->line, "SEND_TO") != NULL) {
            --k;
            continue;
        }
        found = sscanf(from->line, "%d %d %d", &kind, &p[0], &p[1]) - 1;
        if (found >= 0 && kind == 1) continue;
        if (found < 0 || kind != 3)
            return refuse(from, "expected a line (3 and 2 points) of marker ", name);
        if (found < 2) return refuse(from, "a face has too few points", "");
        mesh->face_points[2 * (mesh->n_faces + kept)] = p[0];
        mesh->face_points[2 * (mesh->n_faces + kept) + 1] = p[1];
        mesh->face_markers[mesh->n_faces + kept++] = mesh->n_markers;
    }
    if (kept == 0) return 0;
    mesh->n_faces += kept;
    memcpy(mesh->names[mesh->n_markers++], name, sizeof name);
    return 0;
}

static int read_sections(reader* from, su2_mesh* mesh) {
    while (next_line(from)) {
        const char* value;
        int32_t n;
        if ((value = value_of(from->line, "NDIME")) != NULL) {
            if (read_count(from, value, &n)) return 1;
            if (n != 2) return refuse(from, "only two dimensions are read", "");
        } else if ((value = value_of(from->line, "NZONE")) != NULL) {
            if (read_count(from, value, &n)) return 1;
            if (n != 1) return refuse(from, "only files of one zone are read", "");
        } else if ((value = value_of(from->line, "NELEM")) != NULL) {
            if (read_count(from, value, &n) || read_cells(from, n, mesh)) return 1;
        } else if ((value = value_of(from->line, "NPOIN")) != NULL) {
            if (read_count(from, value, &n) || read_points(from, n, mesh)) return 1;
        } else if ((value = value_of(from->line, "NMARK")) != NULL) {
            if (read_count(from, value, &from->markers_said)) return 1;
        } else if ((value = value_of(from->line, "MARKER_TAG")) != NULL) {
            if (read_marker(from, value, mesh)) return 1;
        }
    }
    return 0;
}

static int check_points(reader* from, const su2_mesh* mesh) {
    from->line_number = 0;
    if (mesh->n_points == 0) return refuse(from, "the file has no points (NPOIN)", "");
    if (mesh->n_cells == 0) return refuse(from, "the file has no cells (NELEM)", "");
    if (from->markers < from->markers_said)
        return refuse(from, "the file has fewer markers than NMARK says", "");
    for (int32_t k = 0; k < mesh->cell_start[mesh->n_cells]; ++k)
        if (mesh->cell_points[k] < 0 || mesh->cell_points[k] >= mesh->n_points)
            return refuse(from, "a cell names a point that the file has not", "");
    for (int32_t k = 0; k < 2 * mesh->n_faces; ++k)
        if (mesh->face_points[k] < 0 || mesh->face_points[k] >= mesh->n_points)
            return refuse(from, "a face names a point that the file has not", "");
    return 0;
}

int read_su2(const char* file, su2_mesh* mesh, char* message) {
    reader from;
    memset(mesh, 0, sizeof *mesh);
    memset(&from, 0, sizeof from);
    message[0] = '\0';
    from.file = fopen(file, "r");
    from.message = message;
    if (from.file == NULL) return refuse(&from, "cannot open ", file);
    int const failed = read_sections(&from, mesh) || check_points(&from, mesh);
    fclose(from.file);
    if (failed) free_su2(mesh);
    return failed;
}

int32_t su2_marker(const su2_mesh* mesh, const char* name) {
    for (int32_t k = 0; k < mesh->n_markers; ++k)
        if (strcmp(mesh->names[k], name) == 0) return k;
    return -1;
}

void free_su2(su2_mesh* mesh) {
    free(mesh->x);
    free(mesh->y);
    free(mesh->cell_start);
    free(mesh->cell_points);
    free(mesh->face_points);
    free(mesh->face_markers);
    free(mesh->names);
    memset(mesh, 0, sizeof *mesh);
}
