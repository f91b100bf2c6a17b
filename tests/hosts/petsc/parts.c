#include "parts.h"

#include "../mpi_case.h"

#include <petscmat.h>
#include <string.h>

const char* const partition_names[N_PARTITIONS] = {"stripes in x",        "stripes in y",
                                                   "recursive bisection", "random cells",
                                                   "partitioner",         "ghost cells"};

static uint32_t mixed(uint32_t k) {
    k = (k ^ (k >> 16)) * 0x45d9f3bu;
    k = (k ^ (k >> 16)) * 0x45d9f3bu;
    return k ^ (k >> 16);
}

int64_t number_of(int32_t point) { return 2 * (int64_t)(point ^ 5) + 11; }

static const double* sorted_by;
static int by_value(const void* a, const void* b) {
    const int32_t k = *(const int32_t*)a, l = *(const int32_t*)b;
    const double p = sorted_by[k], q = sorted_by[l];
    return p != q ? (p < q ? -1 : 1) : k < l ? -1 : k > l;
}

/* Halves along x and y in turn, or with ways 1 along one of them only. centre [2]: x and y of the
 * cells. */
static void bisect(const double* const* centre, int ways, int32_t* cells, int32_t n, int first,
                   int parts, int level, int* part_of) {
    int32_t k, half;
    if (parts == 1) {
        for (k = 0; k < n; ++k) part_of[cells[k]] = first;
        return;
    }
    sorted_by = centre[level % ways];
    qsort(cells, (size_t)n, sizeof *cells, by_value);
    half = (int32_t)((int64_t)n * (parts / 2) / parts);
    bisect(centre, ways, cells, half, first, parts / 2, level + 1, part_of);
    bisect(centre, ways, cells + half, n - half, first + parts / 2, parts - parts / 2, level + 1,
           part_of);
}

static void cut(const whole_mesh* whole, int kind, int size, int* part_of) {
    double *cx = room(sizeof *cx * (size_t)whole->n_cells),
           *cy = room(sizeof *cy * (size_t)whole->n_cells);
    const double* centre[2];
    int32_t *order = room(sizeof *order * (size_t)whole->n_cells), k;
    centre[0] = kind == STRIPES_Y ? cy : cx;
    centre[1] = cy;
    for (k = 0; k < whole->n_cells; ++k) {
        const int32_t a = whole->cells[4 * k], c = whole->cells[4 * k + 2];
        cx[k] = whole->x[a] + whole->x[c];
        cy[k] = whole->y[a] + whole->y[c];
        order[k] = k;
    }
    bisect(centre, kind == STRIPES_X || kind == STRIPES_Y ? 1 : 2, order, whole->n_cells, 0, size,
           0, part_of);
    free(cx);
    free(cy);
    free(order);
}

/* first [n_points + 1], cells [4 * n_cells]: the cells of each point; both to be freed. */
static void cells_of_points(const whole_mesh* whole, int32_t** first, int32_t** cells) {
    const size_t n = (size_t)whole->n_points;
    int32_t k;
    *first = calloc(n + 2, sizeof **first);
    *cells = room(sizeof **cells * 4 * (size_t)whole->n_cells);
    for (k = 0; k < 4 * whole->n_cells; ++k) ++(*first)[whole->cells[k] + 2];
    for (k = 0; k < whole->n_points; ++k) (*first)[k + 2] += (*first)[k + 1];
    for (k = 0; k < 4 * whole->n_cells; ++k) (*cells)[(*first)[whole->cells[k] + 1]++] = k / 4;
}

#if defined(PETSC_HAVE_PTSCOTCH) || defined(PETSC_HAVE_PARMETIS)
static int has_side(const int32_t* cell, int32_t a, int32_t b) {
    int c, found = 0;
    for (c = 0; c < 4; ++c) found = found || (cell[c] == b && cell[(c + 1) % 4] == a);
    return found;
}

/* Cells begin .. end - 1 and their neighbours as PETSc's graph. */
static Mat make_graph(const whole_mesh* whole, int32_t begin, int32_t end) {
    int32_t *first, *cells, k, c, m;
    PetscInt *start, *neighbour, n = 0;
    Mat graph;
    cells_of_points(whole, &first, &cells);
    PetscMalloc1((size_t)(end - begin) + 1, &start);
    PetscMalloc1((size_t)(4 * (end - begin)) + 1, &neighbour);
    start[0] = 0;
    for (k = begin; k < end; ++k) {
        for (c = 0; c < 4; ++c) {
            const int32_t a = whole->cells[4 * k + c], b = whole->cells[4 * k + (c + 1) % 4];
            if (a == b) continue;
            for (m = first[a]; m < first[a + 1]; ++m) {
                if (!has_side(whole->cells + 4 * cells[m], a, b)) continue;
                neighbour[n++] = cells[m];
                break;
            }
        }
        start[k - begin + 1] = n;
    }
    MatCreateMPIAdj(MPI_COMM_WORLD, end - begin, whole->n_cells, start, neighbour, NULL, &graph);
    free(first);
    free(cells);
    return graph;
}

static void use_partitioner(const whole_mesh* whole, int size, int* part_of) {
    int rank, processes;
    int32_t k;
    const PetscInt* found;
    MatPartitioning way;
    IS own, all;
    Mat graph;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &processes);
    graph = make_graph(whole, (int32_t)((int64_t)whole->n_cells * rank / processes),
                       (int32_t)((int64_t)whole->n_cells * (rank + 1) / processes));
    MatPartitioningCreate(MPI_COMM_WORLD, &way);
    MatPartitioningSetAdjacency(way, graph);
#ifdef PETSC_HAVE_PTSCOTCH
    MatPartitioningSetType(way, MATPARTITIONINGPTSCOTCH);
#else
    MatPartitioningSetType(way, MATPARTITIONINGPARMETIS);
#endif
    MatPartitioningSetNParts(way, size);
    MatPartitioningApply(way, &own);
    ISAllGather(own, &all);
    ISGetIndices(all, &found);
    for (k = 0; k < whole->n_cells; ++k) part_of[k] = (int)found[k];
    ISRestoreIndices(all, &found);
    ISDestroy(&own);
    ISDestroy(&all);
    MatPartitioningDestroy(&way);
    MatDestroy(&graph);
}
#else
static void use_partitioner(const whole_mesh* whole, int size, int* part_of) {
    cut(whole, BISECTION, size, part_of);
}
#endif

int* partition(const whole_mesh* whole, int kind, int size) {
    int* part_of = room(sizeof *part_of * (size_t)whole->n_cells);
    int32_t k;
    if (kind == RANDOM) {
        for (k = 0; k < whole->n_cells; ++k)
            part_of[k] = (int)(mixed((uint32_t)k) % (uint32_t)size);
    } else if (kind == PARTITIONER && size > 1) {
        use_partitioner(whole, size, part_of);
    } else {
        cut(whole, kind, size, part_of);
    }
    return part_of;
}

void refer(own_part* part) {
    hm_mesh mesh = {sizeof mesh};
    hm_part_mesh view = {sizeof view};
    mesh.n_points = part->n_points;
    mesh.points.x = part->x;
    mesh.points.y = part->y;
    mesh.cell_layout = HM_CELLS_QUADS;
    mesh.n_cells = part->n_cells;
    mesh.cell_points = part->cells;
    mesh.n_faces = part->n_faces;
    mesh.face_points = part->faces;
    mesh.face_markers = part->markers;
    part->mesh = mesh;
    view.mesh = &part->mesh;
    view.numbers = part->numbers;
    view.ghosts = part->ghosts;
    part->part = view;
}

/* local [n_points of the mesh]: the number of a point in the part, or -1. */
static void take_cell(own_part* part, const whole_mesh* whole, int32_t cell, int32_t* local) {
    int c;
    for (c = 0; c < 4; ++c) {
        const int32_t point = whole->cells[4 * cell + c];
        if (local[point] < 0) {
            local[point] = part->n_points++;
            part->global[local[point]] = point;
            part->x[local[point]] = whole->x[point];
            part->y[local[point]] = whole->y[point];
            part->numbers[local[point]] = number_of(point);
        }
        part->cells[4 * part->n_cells + c] = local[point];
    }
    ++part->n_cells;
}

/* A face belongs to the part whose own cell has both ends side by side. */
static void take_faces(own_part* part, const whole_mesh* whole, const int* part_of, int rank,
                       const int32_t* local) {
    int32_t *first, *cells, f, m;
    cells_of_points(whole, &first, &cells);
    for (f = 0; f < whole->n_faces; ++f) {
        const int32_t a = whole->faces[2 * f], b = whole->faces[2 * f + 1];
        for (m = first[a]; m < first[a + 1]; ++m) {
            const int32_t* const cell = whole->cells + 4 * cells[m];
            int c, is_side = 0;
            for (c = 0; c < 4; ++c) {
                const int32_t p = cell[c], q = cell[(c + 1) % 4];
                is_side = is_side || (p == a && q == b) || (p == b && q == a);
            }
            if (!is_side || part_of[cells[m]] != rank) continue;
            part->faces[2 * part->n_faces] = local[a];
            part->faces[2 * part->n_faces + 1] = local[b];
            part->markers[part->n_faces++] = whole->markers[f];
            break;
        }
    }
    free(first);
    free(cells);
}

void take_part(own_part* part, const whole_mesh* whole, const int* part_of, int rank,
               int with_ghosts) {
    const size_t n = (size_t)whole->n_points;
    int32_t *local = room(sizeof *local * n), k, c;
    uint8_t* touched = calloc(n, 1);
    memset(part, 0, sizeof *part);
    part->global = room(sizeof *part->global * n);
    part->x = room(sizeof *part->x * n);
    part->y = room(sizeof *part->y * n);
    part->numbers = room(sizeof *part->numbers * n);
    part->cells = room(sizeof *part->cells * 4 * (size_t)whole->n_cells);
    part->faces = room(sizeof *part->faces * 2 * (size_t)(whole->n_faces + 1));
    part->markers = room(sizeof *part->markers * (size_t)(whole->n_faces + 1));
    part->ghosts = with_ghosts ? calloc((size_t)whole->n_cells, 1) : NULL;
    memset(local, -1, sizeof *local * n);
    for (k = 0; k < 4 * whole->n_cells; ++k) {
        if (part_of[k / 4] == rank) touched[whole->cells[k]] = 1;
    }
    for (k = 0; k < whole->n_cells; ++k) {
        int wanted = part_of[k] == rank;
        for (c = 0; c < 4; ++c)
            wanted = wanted || (with_ghosts && touched[whole->cells[4 * k + c]]);
        if (!wanted) continue;
        if (with_ghosts) part->ghosts[part->n_cells] = part_of[k] != rank;
        take_cell(part, whole, k, local);
    }
    take_faces(part, whole, part_of, rank, local);
    free(local);
    free(touched);
    refer(part);
}

void free_part(own_part* part) {
    free(part->global);
    free(part->x);
    free(part->y);
    free(part->numbers);
    free(part->cells);
    free(part->faces);
    free(part->markers);
    free(part->ghosts);
}
