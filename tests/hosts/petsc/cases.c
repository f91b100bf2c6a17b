#include <harmorph_design.h>
#include <harmorph_study.h>
#include "cases.h"

#include "../mpi_case.h"

#include <read_su2.h>
#include <string.h>

static int process(void) {
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

static void make_structured(whole_mesh* mesh, int32_t ni, int32_t nj) {
    int32_t i, j;
    mesh->n_points = ni * nj;
    mesh->n_cells = (ni - 1) * (nj - 1);
    mesh->x = room(sizeof *mesh->x * (size_t)mesh->n_points);
    mesh->y = room(sizeof *mesh->y * (size_t)mesh->n_points);
    mesh->cells = room(sizeof *mesh->cells * 4 * (size_t)mesh->n_cells);
    mesh->faces = room(sizeof *mesh->faces * 8 * (size_t)(ni + nj));
    mesh->markers = room(sizeof *mesh->markers * 4 * (size_t)(ni + nj));
    mesh->n_faces = 0;
    for (j = 0; j + 1 < nj; ++j) {
        for (i = 0; i + 1 < ni; ++i) {
            int32_t *const cell = mesh->cells + 4 * (i + (ni - 1) * j), a = i + ni * j;
            cell[0] = a;
            cell[1] = a + 1;
            cell[2] = a + ni + 1;
            cell[3] = a + ni;
        }
    }
}

static void add_face(whole_mesh* mesh, int32_t a, int32_t b, int32_t marker) {
    mesh->faces[2 * mesh->n_faces] = a;
    mesh->faces[2 * mesh->n_faces + 1] = b;
    mesh->markers[mesh->n_faces++] = marker;
}

static void look_at(reference* serial) {
    hm_mesh view = {sizeof view};
    view.n_points = serial->mesh.n_points;
    view.points.x = serial->mesh.x;
    view.points.y = serial->mesh.y;
    view.cell_layout = HM_CELLS_QUADS;
    view.n_cells = serial->mesh.n_cells;
    view.cell_points = serial->mesh.cells;
    view.n_faces = serial->mesh.n_faces;
    view.face_points = serial->mesh.faces;
    view.face_markers = serial->mesh.markers;
    serial->view = view;
    serial->problem.mesh = &serial->view;
}

static void begin_case(reference* serial, int32_t operator_kind) {
    hm_problem problem = {sizeof problem};
    hm_options options = {sizeof options};
    serial->problem = problem;
    serial->options = options;
    serial->options.operator_kind = operator_kind;
    serial->problem.conditions = serial->conditions;
    look_at(serial);
}

hm_condition* add_condition(reference* serial, int32_t marker, int32_t kind) {
    hm_condition any = {sizeof any};
    hm_condition* const made = &serial->conditions[serial->problem.n_conditions++];
    *made = any;
    made->marker = marker;
    made->kind = kind;
    return made;
}

/* A curve for the wall, whose points are x, y [n] in order. */
static void fit_wall(reference* serial, int32_t marker, const double* x, const double* y, int32_t n,
                     int is_loop, int32_t n_control, int32_t closed) {
    hm_fit_options fit = {sizeof fit};
    hm_error error;
    const hm_curves* curves = NULL;
    hm_memory memory;
    fit.n_control = n_control;
    fit.closed = closed;
    need(hm_fit(NULL, emptied(&memory), NULL, n, 0, &fit, NULL, &error), &error);
    serial->curves_block = memory.block = room(memory.bytes);
    need(hm_fit(&curves, &memory, &(hm_points){x, y, 1}, n, is_loop, &fit, NULL, &error), &error);
    serial->problem.curves = curves;
    add_condition(serial, marker, HM_ON_CURVE)->n_curves = curves->n_curves;
}

void make_o_mesh(reference* serial, int32_t ni, int32_t nj, double first, int32_t operator_kind) {
    whole_mesh* const mesh = &serial->mesh;
    int32_t i, j;
    memset(serial, 0, sizeof *serial);
    make_structured(mesh, ni, nj);
    for (j = 0; j < nj; ++j) {
        const double t = (double)j / (nj - 1),
                     s = first > 0 ? first * expm1(t * log1p(20 / first)) : expm1(3 * t);
        for (i = 0; i < ni; ++i) {
            const double angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1), r = 1 + s;
            mesh->x[i + ni * j] = (r + 0.6 / r) * cos(angle);
            mesh->y[i + ni * j] = (r - 0.6 / r) * sin(angle);
        }
    }
    for (i = 0; i + 1 < ni; ++i) {
        add_face(mesh, i + 1, i, WALL);
        add_face(mesh, i + ni * (nj - 1), i + 1 + ni * (nj - 1), FAR_FIELD);
    }
    begin_case(serial, operator_kind);
    fit_wall(serial, WALL, mesh->x, mesh->y, ni - 1, 1, 4, HM_PERIODIC);
    snprintf(serial->name, sizeof serial->name,
             "O-mesh of %d x %d points, first layer %g, operator %d", (int)ni, (int)nj, first,
             (int)operator_kind);
}

void make_channel(reference* serial, double arch, int32_t operator_kind) {
    enum { ni = 17, nj = 9 };
    whole_mesh* const mesh = &serial->mesh;
    int32_t i, j;
    memset(serial, 0, sizeof *serial);
    make_structured(mesh, ni, nj);
    for (j = 0; j < nj; ++j) {
        for (i = 0; i < ni; ++i) {
            const double x = 2.0 * i / (ni - 1), t = (double)j / (nj - 1);
            const double bow = i == 0 || i == ni - 1 ? 0 : sin(3.141592653589793 * x / 2);
            mesh->x[i + ni * j] = x;
            mesh->y[i + ni * j] = t * (1 + arch * bow) + (1 - t) * 0.1 * bow;
        }
    }
    for (i = 0; i + 1 < ni; ++i) {
        add_face(mesh, i, i + 1, WALL);
        add_face(mesh, i + 1 + ni * (nj - 1), i + ni * (nj - 1), TOP);
    }
    for (j = 0; j + 1 < nj; ++j) {
        add_face(mesh, ni - 1 + ni * j, ni - 1 + ni * (j + 1), RIGHT);
        add_face(mesh, ni * (j + 1), ni * j, LEFT);
    }
    begin_case(serial, operator_kind);
    fit_wall(serial, WALL, mesh->x, mesh->y, ni, 0, 4, HM_OPEN);
    snprintf(serial->name, sizeof serial->name, "channel, operator %d", (int)operator_kind);
}

void make_passage(reference* serial, int32_t operator_kind) {
    enum { NI = 13, NJ = 9, WEST = 4, EAST = 8, SOUTH = 3, NORTH = 5 }; /* the hole */
    whole_mesh* const mesh = &serial->mesh;
    double x[2 * (EAST - WEST + NORTH - SOUTH)], y[2 * (EAST - WEST + NORTH - SOUTH)];
    int32_t i, j, k, n = 0, n_wall = 0;
    memset(serial, 0, sizeof *serial);
    make_structured(mesh, NI, NJ);
    for (k = 0; k < NI * NJ; ++k) {
        mesh->x[k] = 2.0 * (k % NI) / (NI - 1);
        mesh->y[k] = (double)(k / NI) / (NJ - 1);
    }
    for (k = 0; k < mesh->n_cells; ++k) {
        i = k % (NI - 1);
        j = k / (NI - 1);
        if (i >= WEST && i < EAST && j >= SOUTH && j < NORTH) continue;
        memmove(mesh->cells + 4 * n++, mesh->cells + 4 * k, 4 * sizeof *mesh->cells);
    }
    mesh->n_cells = n;
    for (i = 0; i + 1 < NI; ++i) {
        add_face(mesh, i, i + 1, BOTTOM);
        add_face(mesh, i + 1 + NI * (NJ - 1), i + NI * (NJ - 1), TOP);
    }
    for (j = 0; j + 1 < NJ; ++j) {
        add_face(mesh, NI - 1 + NI * j, NI - 1 + NI * (j + 1), RIGHT);
        add_face(mesh, NI * (j + 1), NI * j, LEFT);
    }
    i = WEST; /* once round the hole */
    j = SOUTH;
    do {
        const int32_t from = i + NI * j;
        x[n_wall] = mesh->x[from];
        y[n_wall++] = mesh->y[from];
        if (j == SOUTH && i < EAST) {
            ++i;
        } else if (i == EAST && j < NORTH) {
            ++j;
        } else if (j == NORTH && i > WEST) {
            --i;
        } else {
            --j;
        }
        add_face(mesh, from, i + NI * j, WALL);
    } while (i != WEST || j != SOUTH);
    begin_case(serial, operator_kind);
    fit_wall(serial, WALL, x, y, n_wall, 1, 8, HM_PERIODIC);
    add_condition(serial, BOTTOM, HM_PERIODIC_PAIR)->partner = TOP;
    snprintf(serial->name, sizeof serial->name, "periodic passage, operator %d",
             (int)operator_kind);
}

static void take_file(whole_mesh* mesh, const su2_mesh* from) {
    int32_t k, c;
    mesh->n_points = from->n_points;
    mesh->n_cells = from->n_cells;
    mesh->n_faces = from->n_faces;
    mesh->x = from->x;
    mesh->y = from->y;
    mesh->faces = from->face_points;
    mesh->markers = from->face_markers;
    mesh->cells = room(4 * sizeof *mesh->cells * (size_t)from->n_cells);
    for (k = 0; k < from->n_cells; ++k) {
        const int32_t last = from->cell_start[k + 1] - from->cell_start[k] - 1;
        for (c = 0; c < 4; ++c)
            mesh->cells[4 * k + c] = from->cell_points[from->cell_start[k] + (c < last ? c : last)];
    }
}

void make_from_file(reference* serial, const char* file, int32_t operator_kind) {
    su2_mesh from;
    hm_analysis* analysis;
    hm_error error;
    char message[256];
    hm_memory memory;
    void* block;
    int32_t k, n = 0, is_loop = 0, *points, wall = 0;
    double *x, *y;
    memset(serial, 0, sizeof *serial);
    if (read_su2(file, &from, message) != 0) {
        fprintf(stderr, "%s: %s\n", file, message);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    take_file(&serial->mesh, &from);
    for (k = 0; k < from.n_markers; ++k) {
        if (strncmp(from.names[k], "far", 3) != 0 && strncmp(from.names[k], "FAR", 3) != 0 &&
            strncmp(from.names[k], "Far", 3) != 0)
            wall = k;
    }
    begin_case(serial, operator_kind);
    /* The points of the airfoil in order, by an analysis of the mesh alone. */
    need(hm_analysis_init(NULL, emptied(&memory), &serial->problem, NULL, &error), &error);
    block = memory.block = room(memory.bytes);
    need(hm_analysis_init(&analysis, &memory, &serial->problem, NULL, &error), &error);
    points = room(sizeof *points * (size_t)from.n_faces);
    need(hm_analysis_boundary(analysis, 1, &wall, 0, points, from.n_faces, &n, &is_loop, &error),
         &error);
    free(block);
    x = room(sizeof *x * (size_t)n);
    y = room(sizeof *y * (size_t)n);
    for (k = 0; k < n; ++k) {
        x[k] = from.x[points[k]];
        y[k] = from.y[points[k]];
    }
    fit_wall(serial, wall, x, y, n, is_loop, 12, HM_CLOSED_AUTO);
    snprintf(serial->name, sizeof serial->name, "%s, operator %d",
             strrchr(file, '/') != NULL ? strrchr(file, '/') + 1 : file, (int)operator_kind);
    free(x);
    free(y);
    free(points);
    free(from.cell_start);
    free(from.cell_points);
    free(from.names);
}

void free_case(reference* serial) {
    free(serial->basis_block);
    free(serial->curves_block);
    free(serial->mesh.x);
    free(serial->mesh.y);
    free(serial->mesh.cells);
    free(serial->mesh.faces);
    free(serial->mesh.markers);
}

hm_plan* make_plan(reference* serial, void** blocks, hm_analysis** analysis) {
    hm_error error;
    hm_plan* plan;
    hm_memory memory;
    need(hm_analysis_init(NULL, emptied(&memory), &serial->problem, &serial->options, &error),
         &error);
    blocks[0] = memory.block = room(memory.bytes);
    need(hm_analysis_init(analysis, &memory, &serial->problem, &serial->options, &error), &error);
    need(hm_plan_init(NULL, emptied(&memory), *analysis, &error), &error);
    blocks[1] = memory.block = room(memory.bytes);
    need(hm_plan_init(&plan, &memory, *analysis, &error), &error);
    need(hm_plan_factor(plan, NULL, &error), &error);
    return plan;
}

void solve_whole(reference* serial) {
    hm_error error;
    int32_t counts[3] = {0, 0, 0};
    if (process() == 0) {
        hm_basis_info info = {sizeof info};
        hm_analysis* analysis;
        void* blocks[2];
        hm_memory memory;
        hm_plan* const plan = make_plan(serial, blocks, &analysis);
        need(hm_basis_init(NULL, emptied(&memory), analysis, &error), &error);
        serial->basis_block = memory.block = room(memory.bytes);
        need(hm_basis_init(&serial->basis, &memory, analysis, &error), &error);
        need(hm_plan_solve(plan, serial->basis, NULL, &error), &error);
        free(blocks[0]);
        free(blocks[1]);
        need(hm_basis_info_get(serial->basis, &info, &error), &error);
        counts[0] = info.functions;
        counts[1] = info.control_points;
        counts[2] = info.numbers_per_value;
    }
    MPI_Bcast(counts, 3, MPI_INT32_T, 0, MPI_COMM_WORLD);
    serial->functions = counts[0];
    serial->controls = counts[1];
    serial->numbers = counts[2];
}

void whole_values(const reference* serial, const hm_basis* basis, int32_t function, int32_t number,
                  double* values) {
    hm_error error;
    if (process() == 0) need(hm_basis_values(basis, function, number, values, &error), &error);
    MPI_Bcast(values, serial->mesh.n_points, MPI_DOUBLE, 0, MPI_COMM_WORLD);
}
