/* Writes a ring as a CGNS file with libcgns, independently of the program.
 *
 *   make_cgns FILE KIND REAL
 *   make_cgns claim FILE NODE NUMBER...   writes other whole numbers into a node of the file
 *   make_cgns remove FILE PARENT NODE     removes a node
 *   make_cgns fields FILE WHAT   adds vectors to all zones, and prints them in the order of the
 * points; WHAT: double; single; nan: one is not finite; cells: at cells; pressure: at cells, and
 * another array at points; short: five numbers; other: zones have other names; twice: in two
 * solutions
 *     KIND   plane: structured, 2D; planes: two structured zones; block: structured, one cell
 * thick; cells: QUAD_4 and TRI_3 in one section of MIXED elements, BAR_2 at the boundary; polygons:
 * NGON_n; solid: HEXA_8 between two planes; cube: three cells thick; and what is wrong: nan: plane
 * with a coordinate that is not finite; skew: block with a point that is opposite none; outside:
 * cells with a point that does not exist; bare: plane without boundary conditions; whole: plane
 * with a condition on all points; old: plane of an older version of the library make_cgns version
 * FILE   prints the version of the library in the file REAL   double or single */
#include <cgns_io.h>
#include <cgnslib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { around = 24, outwards = 6 };
static int file, base, zone, number, is_single;
static int is_bare, has_nan, is_skew, is_outside;
static const double pi = 3.14159265358979323846;

static void call(int status) {
    if (status == CG_OK) return;
    cg_error_print();
    exit(1);
}

static double radius(int j) { return pow(4.0, (double)j / outwards); }
static double angle(int i) { return 2 * pi * (i % around + .25) / around; }

/* Points i0 .. i0+ni-1 round, all rings, nk layers. */
static void write_coordinates(int i0, int ni, int nk, int dimensions) {
    static const char* const names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
    int d, i, j, k, c;
    for (d = 0; d < dimensions; ++d) {
        double* values = malloc(sizeof(double) * (size_t)(ni * (outwards + 1) * nk));
        float* singles = malloc(sizeof(float) * (size_t)(ni * (outwards + 1) * nk));
        int n = 0;
        for (k = 0; k < nk; ++k)
            for (j = 0; j <= outwards; ++j)
                for (i = i0; i < i0 + ni; ++i, ++n) {
                    values[n] = d == 0   ? radius(j) * cos(angle(i))
                                : d == 1 ? radius(j) * sin(angle(i))
                                         : .5 * k;
                    if (has_nan && d == 1 && n == 30) values[n] = strtod("nan", NULL);
                    if (is_skew && d == 0 && k == 1 && i == 3 && j == 2) values[n] += .3;
                    singles[n] = (float)values[n];
                }
        call(cg_coord_write(file, base, zone, is_single ? RealSingle : RealDouble, names[d],
                            is_single ? (void*)singles : (void*)values, &c));
        /* What stands beside the numbers must survive. */
        call(cg_goto(file, base, "Zone_t", zone, "GridCoordinates_t", 1, names[d], 0, "end"));
        call(cg_descriptor_write("Comment", "a ring"));
        free(values);
        free(singles);
    }
}

static void open_zone(const char* name, int cell_dimensions, cgsize_t* size, ZoneType_t type) {
    if (base == 0) call(cg_base_write(file, "Base", cell_dimensions, cell_dimensions, &base));
    call(cg_zone_write(file, base, name, size, type, &zone));
}

static void condition(const char* name, BCType_t type, PointSetType_t set, cgsize_t n,
                      const cgsize_t* items, int elements) {
    int c;
    if (is_bare) return;
    call(cg_boco_write(file, base, zone, name, type, set, n, items, &c));
    if (elements != 0)
        call(cg_boco_gridlocation_write(file, base, zone, c,
                                        elements == 1 ? EdgeCenter : FaceCenter));
}

static void structured(int parts, int nk) {
    int part, dimensions = nk > 1 ? 3 : 2;
    for (part = 0; part < parts; ++part) {
        int ni = around / parts + 1;
        cgsize_t size3[9] = {0}, size2[6] = {0}, wall[6], far[6];
        char name[16];
        size3[0] = size2[0] = ni;
        size3[1] = size2[1] = outwards + 1;
        size3[2] = nk;
        size3[3] = ni - 1;
        size3[4] = outwards;
        size3[5] = nk - 1;
        size2[2] = ni - 1;
        size2[3] = outwards;
        sprintf(name, "Zone%d", part + 1);
        open_zone(name, dimensions, nk > 1 ? size3 : size2, Structured);
        write_coordinates(part * (ni - 1), ni, nk, dimensions);
        if (nk > 1) {
            cgsize_t w[6] = {1, 1, 1, 0, 1, 0}, f[6] = {1, 0, 1, 0, 0, 0},
                     s[6] = {1, 1, 1, 0, 0, 1};
            w[3] = f[3] = s[3] = ni;
            w[5] = f[5] = nk;
            f[1] = f[4] = s[4] = outwards + 1;
            memcpy(wall, w, sizeof w);
            memcpy(far, f, sizeof f);
            condition("symmetry", BCSymmetryPlane, PointRange, 2, s, 0);
        } else {
            cgsize_t w[4] = {1, 1, 0, 1}, f[4] = {1, 0, 0, 0};
            w[2] = f[2] = ni;
            f[1] = f[3] = outwards + 1;
            memcpy(wall, w, sizeof w);
            memcpy(far, f, sizeof f);
        }
        condition("body", BCWallViscous, PointRange, 2, wall, 0);
        condition("far", BCFarfield, PointRange, 2, far, 0);
    }
}

static void section(const char* name, ElementType_t type, int n, int width,
                    const cgsize_t* elements) {
    int s;
    (void)width;
    call(cg_section_write(file, base, zone, name, type, number + 1, number + n, 0, elements, &s));
    number += n;
}

/* nk 1: cells of two dimensions; 2: hexahedra. */
static void unstructured(const char* kind, int nk) {
    enum { n_cells = around * outwards, layer = around * (outwards + 1) };
    static cgsize_t data[10 * n_cells], start[2 * n_cells + 1], bars[4 * around], wall[2], far[2];
    cgsize_t size[3];
    int i, j, n = 0, cells = 0, s, k, is_mixed = strcmp(kind, "cells") == 0 || is_outside;
    size[0] = layer * nk;
    size[2] = 0;
    for (j = 0; j < outwards; ++j)
        for (i = 0; i < around; ++i) {
            int a = j * around + i + 1, b = j * around + (i + 1) % around + 1, c = b + around,
                d = a + around;
            if (is_mixed && j == outwards - 1) { /* the outermost ring in triangles */
                start[cells++] = n;
                data[n++] = TRI_3, data[n++] = a, data[n++] = b, data[n++] = c;
                start[cells++] = n;
                data[n++] = TRI_3, data[n++] = a, data[n++] = c, data[n++] = d;
                continue;
            }
            if (strcmp(kind, "polygons") == 0 && j == 0) { /* the innermost ring in pairs */
                int e = (i + 2) % around + 1;
                if (i % 2 != 0) continue;
                start[cells++] = n;
                data[n++] = a, data[n++] = b, data[n++] = e, data[n++] = e + around, data[n++] = c,
                data[n++] = d;
                continue;
            }
            start[cells++] = n;
            if (is_mixed) data[n++] = QUAD_4;
            data[n++] = a, data[n++] = b, data[n++] = c, data[n++] = d;
            for (k = 0; nk == 2 && k < 4; ++k, ++n) data[n] = data[n - 4] + layer;
        }
    start[cells] = n;
    if (is_outside) data[n - 1] = 1000;
    size[1] = cells;
    open_zone("Ring", nk == 1 ? 2 : 3, size, Unstructured);
    write_coordinates(0, around, nk, nk == 1 ? 2 : 3);
    if (is_mixed || strcmp(kind, "polygons") == 0) {
        call(cg_poly_section_write(file, base, zone, "Cells", is_mixed ? MIXED : NGON_n, 1, cells,
                                   0, data, start, &s));
        number = cells;
    } else {
        section("Cells", nk == 1 ? QUAD_4 : HEXA_8, cells, 0, data);
    }
    for (k = 0; k < 2; ++k) {
        int ring = k == 0 ? 0 : outwards * around;
        n = 0;
        for (i = 0; i < around; ++i) {
            int a = ring + i + 1, b = ring + (i + 1) % around + 1;
            bars[n++] = a, bars[n++] = b;
            if (nk == 2) bars[n++] = b + layer, bars[n++] = a + layer;
        }
        (k == 0 ? wall : far)[0] = number + 1;
        (k == 0 ? wall : far)[1] = number + around;
        section(k == 0 ? "Wall" : "Far", nk == 1 ? BAR_2 : QUAD_4, around, 0, bars);
    }
    condition("body", BCWallViscous, PointRange, 2, wall, nk);
    condition("far", BCFarfield, PointRange, 2, far, nk);
}

static void claim(int n, char** words) {
    int number, k;
    static int numbers[1024]; /* as long as the largest node; other numbers of the node become 0 */
    static cglong_t longs[1024];
    double root, node;
    char type[CGIO_MAX_DATATYPE_LENGTH + 1];
    call(cgio_open_file(words[0], CGIO_MODE_MODIFY, CGIO_FILE_NONE, &number));
    call(cgio_get_root_id(number, &root));
    call(cgio_get_node_id(number, root, words[1], &node));
    call(cgio_get_data_type(number, node, type));
    for (k = 0; k < n - 2 && k < 16; ++k) {
        longs[k] = strtol(words[k + 2], NULL, 10);
        numbers[k] = (int)longs[k];
    }
    call(cgio_write_all_data(number, node, strcmp(type, "I8") == 0 ? (void*)longs : numbers));
    call(cgio_close_file(number));
}

static void remove_node(char** words) {
    int number;
    double root, parent, node;
    call(cgio_open_file(words[0], CGIO_MODE_MODIFY, CGIO_FILE_NONE, &number));
    call(cgio_get_root_id(number, &root));
    call(cgio_get_node_id(number, root, words[1], &parent));
    call(cgio_get_node_id(number, parent, words[2], &node));
    call(cgio_delete_node(number, parent, node));
    call(cgio_close_file(number));
}

/* Sums of two of these numbers are exact, also in single precision. */
static double derivative(int point, int d) { return ((point * 37 + d * 11) % 101 - 50) / 64.0; }

static void add_fields(const char* path, const char* what) {
    int zones, z, first = 0, single = strcmp(what, "single") == 0;
    GridLocation_t location =
        strcmp(what, "cells") == 0 || strcmp(what, "pressure") == 0 ? CellCenter : Vertex;
    call(cg_open(path, CG_MODE_MODIFY, &file));
    call(cg_nzones(file, 1, &zones));
    for (z = 1; z <= zones; ++z) {
        char name[33];
        cgsize_t size[9], five = 5;
        int dimensions, d, k, n = 1, s, f, pass;
        double* values[2];
        float* singles;
        call(cg_zone_read(file, 1, z, name, size));
        call(cg_index_dim(file, 1, z, &dimensions));
        for (d = 0; d < dimensions; ++d) n *= (int)size[d];
        singles = malloc(sizeof(float) * (size_t)n);
        for (pass = 0; pass < (strcmp(what, "twice") == 0 ? 2 : 1); ++pass) {
            call(cg_sol_write(file, 1, z, pass == 0 ? "Adjoint" : "Again", location, &s));
            for (d = 0; d < 2; ++d) {
                values[d] = malloc(sizeof(double) * (size_t)n);
                for (k = 0; k < n; ++k) {
                    values[d][k] = derivative(first + k, d);
                    if (strcmp(what, "nan") == 0 && d == 1 && k == 30)
                        values[d][k] = strtod("nan", NULL);
                    singles[k] = (float)values[d][k];
                }
                sprintf(name, "%s%c",
                        strcmp(what, "other") == 0 && z == 2 ? "Other" : "Sensitivity", "XY"[d]);
                if (strcmp(what, "short") == 0) {
                    call(cg_goto(file, 1, "Zone_t", z, "FlowSolution_t", s, "end"));
                    call(cg_array_write(name, RealDouble, 1, &five, values[d]));
                } else {
                    call(cg_field_write(file, 1, z, s, single ? RealSingle : RealDouble, name,
                                        single ? (void*)singles : (void*)values[d], &f));
                }
            }
            for (k = 0; pass == 0 && k < n; ++k)
                printf("%d %.17g %.17g\n", first + k, values[0][k], values[1][k]);
            if (strcmp(what, "pressure") == 0) {
                call(cg_sol_write(file, 1, z, "Flow", Vertex, &s));
                call(cg_field_write(file, 1, z, s, RealDouble, "Pressure", values[0], &f));
            }
            free(values[0]);
            free(values[1]);
        }
        free(singles);
        first += n;
    }
    call(cg_close(file));
}

int main(int argc, char** argv) {
    const char* kind;
    if (argc == 4 && strcmp(argv[1], "fields") == 0) {
        add_fields(argv[2], argv[3]);
        return 0;
    }
    if (argc == 5 && strcmp(argv[1], "remove") == 0) {
        remove_node(argv + 2);
        return 0;
    }
    if (argc > 4 && strcmp(argv[1], "claim") == 0) {
        claim(argc - 2, argv + 2);
        return 0;
    }
    if (argc == 3 && strcmp(argv[1], "version") == 0) {
        float version = 0;
        call(cg_open(argv[2], CG_MODE_READ, &file));
        call(cg_version(file, &version));
        printf("%.2f\n", version);
        return 0;
    }
    if (argc != 4) return 2;
    kind = argv[2];
    is_single = strcmp(argv[3], "single") == 0;
    call(cg_open(argv[1], CG_MODE_WRITE, &file));
    has_nan = strcmp(kind, "nan") == 0;
    is_skew = strcmp(kind, "skew") == 0;
    is_outside = strcmp(kind, "outside") == 0;
    is_bare = strcmp(kind, "bare") == 0;
    if (strcmp(kind, "whole") == 0) {
        const cgsize_t whole[4] = {1, 1, around + 1, outwards + 1};
        structured(1, 1);
        condition("whole", BCInflow, PointRange, 2, whole, 0);
    } else if (strcmp(kind, "plane") == 0 || strcmp(kind, "old") == 0 || has_nan || is_bare)
        structured(1, 1);
    else if (strcmp(kind, "planes") == 0) structured(2, 1);
    else if (strcmp(kind, "block") == 0 || is_skew) structured(1, 2);
    else if (strcmp(kind, "cube") == 0) structured(1, 4);
    else unstructured(kind, strcmp(kind, "solid") == 0 ? 2 : 1);
    call(cg_close(file));
    if (strcmp(kind, "old") == 0) {
        int number;
        double root, node;
        const float version = 3.1f;
        call(cgio_open_file(argv[1], CGIO_MODE_MODIFY, CGIO_FILE_NONE, &number));
        call(cgio_get_root_id(number, &root));
        call(cgio_get_node_id(number, root, "CGNSLibraryVersion", &node));
        call(cgio_write_all_data(number, node, &version));
        call(cgio_close_file(number));
    }
    return 0;
}
