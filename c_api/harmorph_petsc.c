#include "harmorph_petsc.h"

#include <limits.h>
#include <math.h>
#include <petscksp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef PETSC_USE_COMPLEX
#error "harmorph_petsc.c needs a PETSc with real scalars"
#endif

struct hm_petsc {
    MPI_Comm comm;
    int rank, size;
    hm_part_mesh part_mesh;
    hm_mesh mesh; /* views of the caller's arrays */
    void *part_block, *equations_block;
    hm_part *part;
    hm_equations *equations;
    hm_equations_info info;
    uint8_t *owned; /* [points] */
    double tolerance;
    int32_t boundary_edges;
    uint64_t bytes;
    PetscInt own_rows; /* of the real system */
    int64_t unknowns; /* of all processes */
    Mat matrix;
    KSP solver;
    Vec local; /* [unknowns * numbers] of this process */
    VecScatter to_local;
};

/* ---- Refusals, the same on all processes --------------------------------------------------------------------------
 */

static hm_status refuse(hm_error *err, hm_status code, int64_t item, const char *sentence) {
    if (err != NULL) {
        memset(err, 0, sizeof *err);
        err->code = code;
        err->item = item >= 0 && item <= INT32_MAX ? (int32_t)item : -1;
        snprintf(err->text, sizeof err->text, "%s", sentence);
    }
    return code;
}

/* The worst status of all processes; where another process has it, the error says so. */
static hm_status agree(hm_status own, MPI_Comm comm, hm_error *err) {
    hm_status of_all = own;
    MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MIN, comm);
    if (of_all >= 0) { /* warnings are positive */
        MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MAX, comm);
        return of_all;
    }
    if (own < 0) return of_all;
    return refuse(err, of_all, -1, "another process refused; its error has the reason");
}

static hm_status no_memory(hm_error *err) { return refuse(err, HM_BAD_ARGUMENT, -1, "there is no memory"); }

/* A failed call of PETSc: what PETSc says. */
static hm_status petsc_status(PetscErrorCode code, hm_error *err) {
    const char *text = NULL;
    char sentence[112];
    if (code == 0) return HM_OK;
    PetscErrorMessage(code, &text, NULL);
    snprintf(sentence, sizeof sentence, "PETSc: %s", text != NULL ? text : "unknown error");
    return refuse(err, HM_UNSUPPORTED, -1, sentence);
}

static void *room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

/* ---- Records that go to the process that compares them -------------------------------------------------------------
 */

typedef struct post {
    MPI_Comm comm;
    int size;
    int *count, *start, *count_in, *start_in; /* [size] records that go to, and come from, each process */
    int64_t n, n_in;
    int32_t *place; /* [n] where in the outgoing order a record stands */
    MPI_Datatype record;
    size_t bytes;
} post;

static uint64_t scrambled(uint64_t k) {
    k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdu;
    k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53u;
    return k ^ (k >> 33);
}

static void end_post(post *its) {
    free(its->count);
    free(its->place);
    if (its->record != MPI_DATATYPE_NULL) MPI_Type_free(&its->record);
}

/* to [n]: the process that each record goes to. */
static hm_status begin_post(post *its, MPI_Comm comm, int64_t n, const int *to, hm_error *err) {
    int64_t k;
    int p;
    hm_status status = HM_OK;
    memset(its, 0, sizeof *its);
    its->comm = comm;
    its->record = MPI_DATATYPE_NULL;
    its->n = n;
    MPI_Comm_size(comm, &its->size);
    its->count = room_for(4 * (size_t)its->size, sizeof *its->count);
    its->place = room_for((size_t)n, sizeof *its->place);
    if (its->count == NULL || its->place == NULL || n > INT_MAX) status = no_memory(err);
    status = agree(status, comm, err);
    if (status < 0) return status;
    its->start = its->count + its->size;
    its->count_in = its->count + 2 * its->size;
    its->start_in = its->count + 3 * its->size;
    for (k = 0; k < n; ++k) ++its->count[to[k]];
    for (p = 1; p < its->size; ++p) its->start[p] = its->start[p - 1] + its->count[p - 1];
    for (k = 0; k < n; ++k) its->place[k] = its->start[to[k]]++;
    for (p = its->size - 1; p > 0; --p) its->start[p] = its->start[p - 1];
    its->start[0] = 0;
    MPI_Alltoall(its->count, 1, MPI_INT, its->count_in, 1, MPI_INT, comm);
    for (p = 0; p < its->size; ++p) {
        its->start_in[p] = its->n_in <= INT_MAX ? (int)its->n_in : 0;
        its->n_in += its->count_in[p];
    }
    return agree(its->n_in > INT_MAX ? no_memory(err) : HM_OK, comm, err);
}

static void set_record(post *its, size_t bytes) {
    if (its->record != MPI_DATATYPE_NULL) MPI_Type_free(&its->record);
    MPI_Type_contiguous((int)bytes, MPI_BYTE, &its->record);
    MPI_Type_commit(&its->record);
    its->bytes = bytes;
}

/* Records [n] of `bytes` bytes, in the order of begin_post; *in [n_in] is to be freed. */
static hm_status deliver(post *its, const void *records, size_t bytes, void **in, hm_error *err) {
    int64_t k;
    char *out = room_for((size_t)its->n, bytes);
    *in = room_for((size_t)its->n_in, bytes);
    hm_status status = agree(out == NULL || *in == NULL ? no_memory(err) : HM_OK, its->comm, err);
    if (status >= 0) {
        set_record(its, bytes);
        for (k = 0; k < its->n; ++k)
            memcpy(out + (size_t)its->place[k] * bytes, (const char *)records + (size_t)k * bytes, bytes);
        MPI_Alltoallv(out, its->count, its->start, its->record, *in, its->count_in, its->start_in, its->record,
                      its->comm);
    }
    free(out);
    return status;
}

/* The way back: one answer [n_in] for each record that came; answers [n] in the order of begin_post. */
static hm_status answer(post *its, const int64_t *given, int64_t *answers, hm_error *err) {
    int64_t k, *in = room_for((size_t)its->n, sizeof *in);
    hm_status status = agree(in == NULL ? no_memory(err) : HM_OK, its->comm, err);
    if (status >= 0) {
        MPI_Alltoallv(given, its->count_in, its->start_in, MPI_INT64_T, in, its->count, its->start, MPI_INT64_T,
                      its->comm);
        for (k = 0; k < its->n; ++k) answers[k] = in[its->place[k]];
    }
    free(in);
    return status;
}

/* ---- Points: one owner each, and one position -----------------------------------------------------------------------
 */

enum { GHOST = 0, ON_BORDER = 1, INSIDE = 2 };

typedef struct named { /* a point or an unknown, as one process has it */
    int64_t name;
    double x, y;
    int32_t role, process;
    int64_t index; /* where it stands among the records that came */
} named;

static int by_name(const void *a, const void *b) {
    const named *const p = a, *const q = b;
    if (p->name != q->name) return p->name < q->name ? -1 : 1;
    return p->process != q->process ? (p->process < q->process ? -1 : 1) : 0;
}

/* Of each group of equal names: the owner is the first process that has more than a ghost. owner [n] by index. */
static hm_status find_owners(named *records, int64_t n, int64_t *owner, hm_error *err) {
    int64_t k, next;
    qsort(records, (size_t)n, sizeof *records, by_name);
    for (k = 0; k < n; k = next) {
        int64_t other, first = -1;
        for (next = k; next < n && records[next].name == records[k].name; ++next) {
            const named *const its = &records[next];
            if (its->x != records[k].x || its->y != records[k].y) {
                return refuse(err, HM_BAD_MESH, its->name,
                              "a point has different coordinates in two parts (item: its global number)");
            }
            if (its->role == GHOST) continue;
            if (first >= 0 && (its->role == INSIDE || records[first].role == INSIDE)) {
                return refuse(err, HM_BAD_MESH, its->name,
                              "a point is inside two parts: global numbers are wrong (item: the number)");
            }
            if (first < 0) first = next;
        }
        if (first < 0) {
            return refuse(err, HM_BAD_MESH, records[k].name,
                          "a ghost point is in no own cell of any part (item: its global number)");
        }
        for (other = k; other < next; ++other) owner[records[other].index] = records[first].process;
    }
    return HM_OK;
}

typedef struct directory { /* who owns which name */
    post mail;
    named *in; /* records that came, sorted by name */
    int64_t *answers; /* [n_in] by index */
} directory;

static void end_directory(directory *its) {
    end_post(&its->mail);
    free(its->in);
    free(its->answers);
}

/* owner [n] of each record. */
static hm_status look_up(directory *its, MPI_Comm comm, int64_t n, const named *records, int64_t *owner,
                         hm_error *err) {
    int *to = room_for((size_t)n, sizeof *to);
    int64_t k;
    int size;
    void *in = NULL;
    hm_status status;
    memset(its, 0, sizeof *its);
    its->mail.record = MPI_DATATYPE_NULL;
    MPI_Comm_size(comm, &size);
    status = agree(to == NULL ? no_memory(err) : HM_OK, comm, err);
    for (k = 0; status >= 0 && k < n; ++k) to[k] = (int)(scrambled((uint64_t)records[k].name) % (uint64_t)size);
    if (status >= 0) status = begin_post(&its->mail, comm, n, to, err);
    if (status >= 0) status = deliver(&its->mail, records, sizeof *records, &in, err);
    its->in = in;
    if (status >= 0) its->answers = room_for((size_t)its->mail.n_in, sizeof *its->answers);
    if (status >= 0) status = agree(its->answers == NULL ? no_memory(err) : HM_OK, comm, err);
    if (status >= 0) {
        for (k = 0; k < its->mail.n_in; ++k) its->in[k].index = k;
        status = agree(find_owners(its->in, its->mail.n_in, its->answers, err), comm, err);
    }
    if (status >= 0) status = answer(&its->mail, its->answers, owner, err);
    free(to);
    return status;
}

/* number [n]: in, of records that this process owns, -1 elsewhere; out, of all. */
static hm_status spread(directory *its, int64_t *number, hm_error *err) {
    int64_t k, next, other, *came = NULL;
    void *in = NULL;
    hm_status status = deliver(&its->mail, number, sizeof *number, &in, err);
    came = in;
    for (k = 0; status >= 0 && k < its->mail.n_in; k = next) {
        int64_t known = -1;
        for (next = k; next < its->mail.n_in && its->in[next].name == its->in[k].name; ++next) {
            if (came[its->in[next].index] >= 0) known = came[its->in[next].index];
        }
        for (other = k; other < next; ++other) its->answers[its->in[other].index] = known;
    }
    if (status >= 0) status = answer(&its->mail, its->answers, number, err);
    free(in);
    return status;
}

/* ---- Part and boundary ------------------------------------------------------------------------------------------ */

static hm_status make_part(hm_petsc *its, hm_error *err) {
    size_t bytes = 0;
    hm_status status = hm_part_size(&its->part_mesh, &bytes, err);
    if (status < 0) return status;
    its->part_block = malloc(bytes);
    if (its->part_block == NULL) return no_memory(err);
    its->bytes += bytes;
    return hm_part_init(&its->part, its->part_block, bytes, &its->part_mesh, err);
}

/* edges [n] of this part; to be freed. */
static hm_status take_edges(const hm_petsc *its, hm_edge **edges, int32_t *n, hm_error *err) {
    hm_part_edges(its->part, NULL, 0, n, NULL);
    *edges = room_for((size_t)*n, sizeof **edges);
    if (*edges == NULL) return no_memory(err);
    return hm_part_edges(its->part, *edges, *n, n, err);
}

static int by_number(const void *a, const void *b) {
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return p < q ? -1 : p > q;
}

/* The points of own and ghost cells, by the part that each plays here. */
static int64_t list_points(const hm_petsc *its, const int64_t *border, size_t n_border, named *records, int32_t *of) {
    const int64_t stride = its->mesh.points.stride == 0 ? 1 : its->mesh.points.stride;
    int64_t k, n = 0;
    for (k = 0; k < its->mesh.n_points; ++k) {
        const int64_t number = its->part_mesh.numbers[k];
        const int inside = bsearch(&number, border, n_border, sizeof *border, by_number) == NULL;
        if (its->owned[k] == 0) continue;
        records[n].name = number;
        records[n].x = its->mesh.points.x[k * stride];
        records[n].y = its->mesh.points.y[k * stride];
        records[n].process = its->rank;
        records[n].role = its->owned[k] == 1 ? GHOST : inside ? INSIDE : ON_BORDER;
        of[n++] = (int32_t)k;
    }
    return n;
}

/* owned [points]: first 1 at points of ghost cells alone, 2 at those of own cells; then 1 at those of this process. */
static hm_status own_points(hm_petsc *its, const hm_edge *edges, int32_t n_edges, hm_error *err) {
    const size_t n = (size_t)its->mesh.n_points;
    named *records = room_for(n, sizeof *records);
    int64_t k, used = 0, *owner = room_for(n, sizeof *owner), *border = room_for(2 * (size_t)n_edges, sizeof *border);
    int32_t *of = room_for(n, sizeof *of);
    directory names;
    hm_status status = HM_OK;
    memset(&names, 0, sizeof names);
    names.mail.record = MPI_DATATYPE_NULL;
    its->owned = room_for(n, 1);
    if (records == NULL || owner == NULL || of == NULL || border == NULL || its->owned == NULL) status = no_memory(err);
    status = agree(status, its->comm, err);
    if (status >= 0) {
        its->bytes += n;
        status = hm_part_points(its->part, its->owned, err);
        for (k = 0; k < n_edges; ++k) {
            border[2 * k] = edges[k].begin;
            border[2 * k + 1] = edges[k].end;
        }
        qsort(border, 2 * (size_t)n_edges, sizeof *border, by_number);
        used = list_points(its, border, 2 * (size_t)n_edges, records, of);
        memset(its->owned, 0, n);
        status = look_up(&names, its->comm, used, records, owner, err);
    }
    for (k = 0; status >= 0 && k < used; ++k) its->owned[of[k]] = owner[k] == its->rank;
    end_directory(&names);
    free(records);
    free(owner);
    free(of);
    free(border);
    return status;
}

/* Edges of all processes are compared, each pair on one of them; *all [*n_all] are those left, on all processes. */
static hm_status gather_boundary(const hm_petsc *its, const hm_edge *edges, int32_t n, hm_edge **all, int32_t *n_all,
                                 hm_error *err) {
    post mail;
    void *in = NULL;
    int *to = room_for((size_t)n, sizeof *to), *counts = room_for(2 * (size_t)its->size, sizeof *counts), own, p;
    int64_t k, left = 0, total = 0;
    hm_status status = agree(to == NULL || counts == NULL ? no_memory(err) : HM_OK, its->comm, err);
    memset(&mail, 0, sizeof mail);
    mail.record = MPI_DATATYPE_NULL;
    for (k = 0; status >= 0 && k < n; ++k) {
        const uint64_t begin = (uint64_t)edges[k].begin, end = (uint64_t)edges[k].end;
        to[k] = (int)(scrambled(begin ^ end) % (uint64_t)its->size);
    }
    if (status >= 0) status = begin_post(&mail, its->comm, n, to, err);
    if (status >= 0) status = deliver(&mail, edges, sizeof *edges, &in, err);
    if (status >= 0) {
        left = mail.n_in;
        status = agree(hm_match_edges(in, &left, err), its->comm, err);
    }
    if (status >= 0) {
        own = (int)left;
        MPI_Allgather(&own, 1, MPI_INT, counts, 1, MPI_INT, its->comm);
        for (p = 0; p < its->size; ++p) {
            counts[its->size + p] = (int)(total <= INT_MAX ? total : 0);
            total += counts[p];
        }
        if (total <= INT_MAX / 4) *all = room_for((size_t)total, sizeof **all);
        status = agree(*all == NULL ? no_memory(err) : HM_OK, its->comm, err);
    }
    if (status >= 0) {
        *n_all = (int32_t)total;
        MPI_Allgatherv(in, own, mail.record, *all, counts, counts + its->size, mail.record, its->comm);
    }
    end_post(&mail);
    free(in);
    free(to);
    free(counts);
    return status;
}

static hm_status make_equations(hm_petsc *its, const hm_edge *edges, int32_t n, const hm_problem *problem,
                                const hm_options *options, hm_error *err) {
    size_t bytes = 0;
    hm_status status = hm_equations_size(its->part, n, problem, options, &bytes, err), known;
    if (status < 0) return status;
    its->equations_block = malloc(bytes);
    if (its->equations_block == NULL) return no_memory(err);
    its->bytes += bytes;
    status =
        hm_equations_init(&its->equations, its->equations_block, bytes, its->part, n, edges, problem, options, err);
    if (status < 0) return status;
    its->info.struct_size = sizeof its->info;
    known = hm_equations_info_get(its->equations, &its->info, err);
    return known < 0 ? known : status;
}

/* ---- Rows of PETSc -------------------------------------------------------------------------------------------------
 */

/* row, owner [unknowns]: the row of each unknown, counted in unknowns, and the process that has it. */
static hm_status number_unknowns(hm_petsc *its, int64_t *row, int64_t *owner, hm_error *err) {
    const int32_t n = its->info.unknowns;
    named *records = room_for((size_t)n, sizeof *records);
    directory names;
    int64_t k, own = 0, first = 0;
    hm_status status = agree(records == NULL ? no_memory(err) : HM_OK, its->comm, err);
    memset(&names, 0, sizeof names);
    names.mail.record = MPI_DATATYPE_NULL;
    for (k = 0; status >= 0 && k < n; ++k) {
        records[k].name = its->info.unknown[k];
        records[k].process = its->rank;
        records[k].role = its->info.own[k] != 0 ? ON_BORDER : GHOST;
    }
    if (status >= 0) status = look_up(&names, its->comm, n, records, owner, err);
    if (status >= 0) {
        for (k = 0; k < n; ++k) own += owner[k] == its->rank;
        MPI_Exscan(&own, &first, 1, MPI_INT64_T, MPI_SUM, its->comm);
        if (its->rank == 0) first = 0;
        its->own_rows = (PetscInt)(own * its->info.numbers);
        MPI_Allreduce(&own, &its->unknowns, 1, MPI_INT64_T, MPI_SUM, its->comm);
        for (k = 0; k < n; ++k) row[k] = owner[k] == its->rank ? first++ : -1;
        if (its->unknowns > (int64_t)PETSC_MAX_INT / its->info.numbers) {
            status = refuse(err, HM_UNSUPPORTED, -1, "more unknowns than PETSc's integers count: use 64-bit integers");
        }
    }
    if (status >= 0) status = spread(&names, row, err);
    end_directory(&names);
    free(records);
    return status;
}

#define TRY(call)                      \
    do {                               \
        PetscErrorCode const e = call; \
        if (e != 0) return e;          \
    } while (0)

static PetscErrorCode make_scatter(hm_petsc *its, const PetscInt *rows) {
    const PetscInt n = its->info.unknowns * its->info.numbers;
    IS to;
    Vec global;
    TRY(VecCreateSeq(PETSC_COMM_SELF, n, &its->local));
    TRY(VecCreateMPI(its->comm, its->own_rows, PETSC_DETERMINE, &global));
    TRY(ISCreateBlock(its->comm, its->info.numbers, its->info.unknowns, rows, PETSC_COPY_VALUES, &to));
    TRY(VecScatterCreate(global, to, its->local, NULL, &its->to_local));
    TRY(ISDestroy(&to));
    return VecDestroy(&global);
}

/* Entries of each row, in columns of the row's owner and of others: at most, as edges between parts count twice. */
static PetscErrorCode preallocate(hm_petsc *its, const int64_t *owner, const int32_t *row, const int32_t *column,
                                  int64_t n_entries) {
    const PetscInt bs = its->info.numbers;
    PetscInt k, n_own, *counts;
    Vec all;
    int kind;
    TRY(VecCreateMPI(its->comm, its->own_rows, PETSC_DETERMINE, &all));
    n_own = its->own_rows;
    TRY(PetscMalloc1((size_t)(2 * n_own) + 1, &counts));
    for (kind = 0; kind < 2; ++kind) { /* 0: columns of the owner; 1: others */
        double *local;
        const double *sums;
        int64_t e;
        TRY(VecZeroEntries(its->local));
        TRY(VecZeroEntries(all));
        TRY(VecGetArray(its->local, &local));
        for (e = 0; e < n_entries; ++e) {
            if ((owner[row[e]] != owner[column[e]]) != kind) continue;
            for (k = 0; k < bs; ++k) {
                local[row[e] * bs + k] += bs;
                if (row[e] != column[e]) local[column[e] * bs + k] += bs;
            }
        }
        TRY(VecRestoreArray(its->local, &local));
        TRY(VecScatterBegin(its->to_local, its->local, all, ADD_VALUES, SCATTER_REVERSE));
        TRY(VecScatterEnd(its->to_local, its->local, all, ADD_VALUES, SCATTER_REVERSE));
        TRY(VecGetArrayRead(all, &sums));
        for (k = 0; k < n_own; ++k) {
            PetscInt const wanted = (PetscInt)sums[k] + (kind == 0 ? bs : 0), most = kind == 0 ? n_own : PETSC_MAX_INT;
            counts[kind * n_own + k] = wanted < most ? wanted : most;
        }
        TRY(VecRestoreArrayRead(all, &sums));
    }
    for (k = 0; k < n_own; ++k) {
        PetscInt const others = (PetscInt)(its->unknowns * bs) - n_own;
        if (counts[n_own + k] > others) counts[n_own + k] = others;
    }
    TRY(MatSeqAIJSetPreallocation(its->matrix, 0, counts));
    TRY(MatMPIAIJSetPreallocation(its->matrix, 0, counts, 0, counts + n_own));
    TRY(PetscFree(counts));
    return VecDestroy(&all);
}

/* The entries of this part, added in blocks, and their transposes. */
static PetscErrorCode add_entries(const hm_petsc *its, const PetscInt *rows, const int32_t *row, const int32_t *column,
                                  const double *values, int64_t n) {
    const int32_t bs = its->info.numbers;
    int64_t e;
    for (e = 0; e < n; ++e, values += bs * bs) {
        const PetscInt i = rows[row[e]], j = rows[column[e]];
        double turned[4];
        TRY(MatSetValuesBlocked(its->matrix, 1, &i, 1, &j, values, ADD_VALUES));
        if (row[e] == column[e]) continue;
        turned[0] = values[0];
        if (bs == 2) {
            turned[1] = values[2];
            turned[2] = values[1];
            turned[3] = values[3];
        }
        TRY(MatSetValuesBlocked(its->matrix, 1, &j, 1, &i, turned, ADD_VALUES));
    }
    return 0;
}

static PetscErrorCode make_matrix(hm_petsc *its, const PetscInt *rows, const int64_t *owner, hm_status *status,
                                  hm_error *err) {
    const int32_t bs = its->info.numbers;
    const size_t n = (size_t)its->info.entries;
    int32_t *row = room_for(n, sizeof *row), *column = room_for(n, sizeof *column);
    double *values = room_for(n * (size_t)(bs * bs), sizeof *values);
    int64_t n_entries = 0;
    PetscErrorCode code = 0;
    *status = agree(row == NULL || column == NULL || values == NULL ? no_memory(err) : HM_OK, its->comm, err);
    if (*status < 0) goto done;
    *status = hm_equations_entries(its->equations, 0, its->info.unknowns, row, column, values, its->info.entries,
                                   &n_entries, err);
    code = MatCreate(its->comm, &its->matrix);
    if (code == 0) code = MatSetSizes(its->matrix, its->own_rows, its->own_rows, PETSC_DETERMINE, PETSC_DETERMINE);
    if (code == 0) code = MatSetBlockSize(its->matrix, bs);
    if (code == 0) code = MatSetType(its->matrix, MATAIJ);
    if (code == 0) code = MatSetOptionsPrefix(its->matrix, "hm_");
    if (code == 0) code = MatSetFromOptions(its->matrix);
    if (code == 0) code = preallocate(its, owner, row, column, n_entries);
    if (code == 0) code = add_entries(its, rows, row, column, values, n_entries);
    if (code == 0) code = MatAssemblyBegin(its->matrix, MAT_FINAL_ASSEMBLY);
    if (code == 0) code = MatAssemblyEnd(its->matrix, MAT_FINAL_ASSEMBLY);
    if (code == 0) code = MatSetOption(its->matrix, MAT_SPD, PETSC_TRUE);
done:
    free(row);
    free(column);
    free(values);
    return code;
}

static PetscErrorCode make_solver(hm_petsc *its) {
    PC pc;
    TRY(KSPCreate(its->comm, &its->solver));
    TRY(KSPSetOptionsPrefix(its->solver, "hm_"));
    TRY(KSPSetOperators(its->solver, its->matrix, its->matrix));
    TRY(KSPSetType(its->solver, KSPCG));
    TRY(KSPSetTolerances(its->solver, 1e-6, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
    TRY(KSPGetPC(its->solver, &pc));
#ifdef PETSC_HAVE_HYPRE
    TRY(PCSetType(pc, PCHYPRE));
    TRY(PCHYPRESetType(pc, "boomeramg"));
#else
    TRY(PCSetType(pc, PCGAMG));
#endif
    return KSPSetFromOptions(its->solver);
}

static hm_status make_system(hm_petsc *its, hm_error *err) {
    const size_t n = (size_t)its->info.unknowns;
    int64_t k, *row = room_for(n, sizeof *row), *owner = room_for(n, sizeof *owner);
    PetscInt *rows = room_for(n, sizeof *rows);
    PetscErrorCode code = 0;
    hm_status status = agree(row == NULL || owner == NULL || rows == NULL ? no_memory(err) : HM_OK, its->comm, err);
    if (status >= 0) status = number_unknowns(its, row, owner, err);
    if (status >= 0) {
        for (k = 0; k < (int64_t)n; ++k) rows[k] = (PetscInt)row[k];
        code = make_scatter(its, rows);
        if (code == 0) code = make_matrix(its, rows, owner, &status, err);
        if (code == 0 && status >= 0) code = make_solver(its);
        if (status >= 0) status = agree(petsc_status(code, err), its->comm, err);
    }
    free(row);
    free(owner);
    free(rows);
    return status;
}

/* ---- Creation ------------------------------------------------------------------------------------------------------
 */

static hm_status look_at(hm_petsc *its, const hm_part_mesh *part, const hm_options *options, hm_error *err) {
    if (part == NULL || part->mesh == NULL || part->struct_size < sizeof *part || part->mesh->struct_size < 8 ||
        part->mesh->struct_size > 4096) {
        return refuse(err, HM_BAD_ARGUMENT, -1, "part or part.mesh is NULL, or a struct_size is not set");
    }
    its->part_mesh = *part;
    memcpy(&its->mesh, part->mesh,
           part->mesh->struct_size < sizeof its->mesh ? part->mesh->struct_size : sizeof its->mesh);
    its->part_mesh.mesh = &its->mesh;
    its->tolerance = options != NULL && options->tolerance > 0 ? options->tolerance : 1e-10;
    return HM_OK;
}

hm_status hm_petsc_create(hm_petsc **system, const hm_part_mesh *part, const hm_problem *problem,
                          const hm_options *options, MPI_Comm comm, hm_error *err) {
    hm_petsc *its = room_for(1, sizeof *its);
    hm_edge *edges = NULL, *all = NULL;
    int32_t n = 0, n_all = 0;
    hm_status status = its == NULL ? no_memory(err) : HM_OK, warning;
    PetscBool running = PETSC_FALSE;
    if (system == NULL) status = refuse(err, HM_BAD_ARGUMENT, -1, "system is NULL");
    PetscInitialized(&running);
    if (!running) status = refuse(err, HM_BAD_ARGUMENT, -1, "PetscInitialize has not been called");
    if (status >= 0) {
        its->comm = comm;
        MPI_Comm_rank(comm, &its->rank);
        MPI_Comm_size(comm, &its->size);
        status = look_at(its, part, options, err);
    }
    if (status >= 0) status = make_part(its, err);
    if (status >= 0) status = take_edges(its, &edges, &n, err);
    status = agree(status, comm, err);
    if (status >= 0) status = own_points(its, edges, n, err);
    if (status >= 0) status = gather_boundary(its, edges, n, &all, &n_all, err);
    warning = status;
    if (status >= 0) status = warning = agree(make_equations(its, all, n_all, problem, options, err), comm, err);
    if (status >= 0) status = make_system(its, err);
    free(edges);
    free(all);
    if (status < 0) {
        hm_petsc_free(&its);
        return status;
    }
    its->boundary_edges = n_all;
    *system = its;
    return warning;
}

hm_status hm_petsc_create_f(hm_petsc **system, const hm_part_mesh *part, const hm_problem *problem,
                            const hm_options *options, MPI_Fint comm, hm_error *err) {
    return hm_petsc_create(system, part, problem, options, MPI_Comm_f2c(comm), err);
}

void hm_petsc_free(hm_petsc **system) {
    hm_petsc *const its = system != NULL ? *system : NULL;
    if (its == NULL) return;
    if (its->solver != NULL) KSPDestroy(&its->solver);
    if (its->matrix != NULL) MatDestroy(&its->matrix);
    if (its->to_local != NULL) VecScatterDestroy(&its->to_local);
    if (its->local != NULL) VecDestroy(&its->local);
    free(its->part_block);
    free(its->equations_block);
    free(its->owned);
    free(its);
    *system = NULL;
}

/* ---- Solution ------------------------------------------------------------------------------------------------------
 */

/* What several right-hand sides are, and what becomes of their values: functions, or one field of displacements. */
typedef struct columns {
    hm_petsc *of;
    hm_basis *rows; /* of functions; NULL: a field */
    double *work, *numbers, *residuals;
} columns;

static hm_status get_column(const columns *its, int32_t column, double *to, hm_error *err) {
    const size_t length = (size_t)its->of->info.unknowns * (size_t)its->of->info.numbers;
    if (its->rows != NULL) return hm_rows_get(its->of->equations, its->rows, column, to, err);
    memcpy(to, its->numbers + (size_t)column * length, length * sizeof *to);
    return HM_OK;
}

/* values: in, of the unknowns; out, the residual. */
static hm_status set_column(const columns *its, int32_t column, double *values, hm_error *err) {
    hm_petsc *const of = its->of;
    const size_t length = (size_t)of->info.unknowns * (size_t)of->info.numbers;
    hm_status status;
    if (its->rows != NULL) {
        status = hm_rows_set(of->equations, its->rows, column, values, err);
        return status < 0 ? status : hm_rows_residual(of->equations, its->rows, column, values, err);
    }
    memcpy(its->numbers + (size_t)column * length, values, length * sizeof *values);
    status = hm_field_residual(of->equations, its->work, its->numbers, its->residuals, err);
    memcpy(values, its->residuals + (size_t)column * length, length * sizeof *values);
    return status;
}

/* The sums over all parts of what each part has in `local`. */
static PetscErrorCode sum_up(hm_petsc *its, Vec sum) {
    TRY(VecZeroEntries(sum));
    TRY(VecScatterBegin(its->to_local, its->local, sum, ADD_VALUES, SCATTER_REVERSE));
    return VecScatterEnd(its->to_local, its->local, sum, ADD_VALUES, SCATTER_REVERSE);
}

typedef struct progress { /* of one column */
    double change, ratio, error;
    int solutions;
    PetscInt iterations;
    int done;
} progress;

enum { MOST_SOLUTIONS = 8, MOST_AT_ONCE = 16 };

/* The error that is left, estimated from the last correction and by how much corrections have shrunk. */
static void judge(progress *its, double change, double tolerance) {
    const double ratio = its->change > 0 ? change / its->change : 1;
    if (its->solutions > 1 && ratio > its->ratio) its->ratio = ratio;
    its->error = its->solutions > 1 && its->ratio < 0.5 ? its->ratio * change : change;
    its->done = its->error <= tolerance || change == 0 || (its->solutions > 2 && ratio > 0.5) ||
                its->solutions == MOST_SOLUTIONS;
    its->change = change;
}

typedef struct solution {
    Mat b, dx, x; /* dense, `width` columns */
    PetscInt width;
    progress at[MOST_AT_ONCE];
    hm_status status;
} solution;

static PetscErrorCode solve_block(hm_petsc *its, solution *now, PetscInt n, int direct) {
    KSPConvergedReason reason;
    PetscInt k, before = 0, after = 0;
    if (direct) {
        TRY(KSPMatSolve(its->solver, now->b, now->dx));
        TRY(KSPGetConvergedReason(its->solver, &reason));
        if (reason < 0) now->status = HM_NOT_POSITIVE;
        for (k = 0; k < n; ++k) now->at[k].iterations += 1;
        return 0;
    }
    for (k = 0; k < n; ++k) {
        Vec b, dx;
        if (now->at[k].done) continue;
        TRY(MatDenseGetColumnVecRead(now->b, k, &b));
        TRY(MatDenseGetColumnVecWrite(now->dx, k, &dx));
        TRY(KSPGetTotalIterations(its->solver, &before));
        TRY(KSPSolve(its->solver, b, dx));
        TRY(KSPGetTotalIterations(its->solver, &after));
        TRY(KSPGetConvergedReason(its->solver, &reason));
        if (reason == KSP_DIVERGED_PC_FAILED || reason == KSP_DIVERGED_INDEFINITE_MAT ||
            reason == KSP_DIVERGED_INDEFINITE_PC || reason == KSP_DIVERGED_NANORINF)
            now->status = HM_NOT_POSITIVE;
        now->at[k].iterations += after - before;
        TRY(MatDenseRestoreColumnVecWrite(now->dx, k, &dx));
        TRY(MatDenseRestoreColumnVecRead(now->b, k, &b));
    }
    return 0;
}

/* One column after a solution: x += dx; the values go to the rows, and b becomes the residual. */
static PetscErrorCode take_over(const columns *of, solution *now, PetscInt k, int32_t column, hm_error *err) {
    hm_petsc *const its = of->of;
    Vec b, dx, x;
    double *local;
    PetscReal change, size;
    progress *const at = &now->at[k];
    hm_status status;
    TRY(MatDenseGetColumnVecRead(now->dx, k, &dx));
    TRY(MatDenseGetColumnVec(now->x, k, &x));
    TRY(VecAXPY(x, 1, dx));
    TRY(VecNorm(dx, NORM_INFINITY, &change));
    TRY(VecNorm(x, NORM_INFINITY, &size));
    TRY(VecScatterBegin(its->to_local, x, its->local, INSERT_VALUES, SCATTER_FORWARD));
    TRY(VecScatterEnd(its->to_local, x, its->local, INSERT_VALUES, SCATTER_FORWARD));
    TRY(MatDenseRestoreColumnVec(now->x, k, &x));
    TRY(MatDenseRestoreColumnVecRead(now->dx, k, &dx));
    TRY(VecGetArray(its->local, &local));
    status = set_column(of, column, local, err);
    TRY(VecRestoreArray(its->local, &local));
    if (status < 0) now->status = status;
    TRY(MatDenseGetColumnVecWrite(now->b, k, &b));
    TRY(sum_up(its, b));
    TRY(MatDenseRestoreColumnVecWrite(now->b, k, &b));
    ++at->solutions;
    judge(at, size > 0 ? change / size : 0, its->tolerance);
    return 0;
}

/* Columns first .. first + n - 1. */
static PetscErrorCode solve_columns(const columns *of, solution *now, int32_t first, PetscInt n, int direct,
                                    hm_error *err) {
    hm_petsc *const its = of->of;
    PetscInt k;
    int going = 1;
    memset(now->at, 0, sizeof now->at);
    TRY(MatZeroEntries(now->x));
    TRY(MatZeroEntries(now->b));
    for (k = 0; k < n; ++k) {
        Vec b;
        double *local;
        hm_status status;
        TRY(VecGetArray(its->local, &local));
        status = get_column(of, first + (int32_t)k, local, err);
        TRY(VecRestoreArray(its->local, &local));
        if (status < 0) now->status = status;
        TRY(MatDenseGetColumnVecWrite(now->b, k, &b));
        TRY(sum_up(its, b));
        TRY(MatDenseRestoreColumnVecWrite(now->b, k, &b));
    }
    while (going && now->status >= 0) {
        TRY(solve_block(its, now, n, direct));
        going = 0;
        for (k = 0; k < n && now->status >= 0; ++k) {
            if (now->at[k].done) continue;
            TRY(take_over(of, now, k, first + (int32_t)k, err));
            going = going || !now->at[k].done;
        }
    }
    return 0;
}

static void include(hm_petsc_report *report, const progress *at, PetscInt n) {
    PetscInt k;
    for (k = 0; k < n; ++k) {
        if (at[k].iterations > report->iterations) report->iterations = (int32_t)at[k].iterations;
        if (at[k].solutions > report->solutions) report->solutions = at[k].solutions;
        if (!(at[k].change <= report->change)) report->change = at[k].change;
        if (!(at[k].error <= report->error)) report->error = at[k].error;
    }
}

static PetscErrorCode solve_all(const columns *of, int32_t n_columns, hm_petsc_report *report, hm_status *status,
                                hm_error *err) {
    hm_petsc *const its = of->of;
    solution now;
    PetscBool direct = PETSC_FALSE;
    int32_t first;
    const PetscInt all = (PetscInt)(its->unknowns * its->info.numbers);
    memset(&now, 0, sizeof now);
    TRY(PetscObjectTypeCompare((PetscObject)its->solver, KSPPREONLY, &direct));
    now.width = direct ? (n_columns < MOST_AT_ONCE ? n_columns : MOST_AT_ONCE) : 1;
    if (n_columns > 0) {
        TRY(MatCreateDense(its->comm, its->own_rows, PETSC_DECIDE, all, now.width, NULL, &now.b));
        TRY(MatDuplicate(now.b, MAT_DO_NOT_COPY_VALUES, &now.dx));
        TRY(MatDuplicate(now.b, MAT_DO_NOT_COPY_VALUES, &now.x));
        TRY(MatZeroEntries(now.dx));
    }
    for (first = 0; first < n_columns && now.status >= 0; first += (int32_t)now.width) {
        PetscInt const n = n_columns - first < now.width ? n_columns - first : now.width;
        TRY(solve_columns(of, &now, first, n, direct, err));
        include(report, now.at, n);
    }
    TRY(MatDestroy(&now.b));
    TRY(MatDestroy(&now.dx));
    TRY(MatDestroy(&now.x));
    *status = now.status;
    if (now.status == HM_NOT_POSITIVE) {
        refuse(err, HM_NOT_POSITIVE, -1, "PETSc could not factor or solve: the matrix is not positive definite");
    }
    return 0;
}

static hm_status finish(const hm_petsc *its, hm_petsc_report *report, hm_petsc_report *given, hm_error *err) {
    const hm_status status = report->error <= its->tolerance ? HM_OK : HM_NOT_CONVERGED;
    report->unknowns = its->unknowns;
    report->functions = its->info.functions;
    report->boundary_edges = its->boundary_edges;
    report->bytes = its->bytes;
    if (status == HM_NOT_CONVERGED && err != NULL) {
        refuse(err, HM_NOT_CONVERGED, -1, "the iteration ended while values may be off by more than the tolerance");
        err->value = report->error;
    }
    if (given != NULL) {
        report->struct_size = given->struct_size;
        memcpy(given, report, given->struct_size < sizeof *report ? given->struct_size : sizeof *report);
    }
    return status;
}

static hm_status run(const columns *of, int32_t n_columns, hm_petsc_report *report, hm_error *err) {
    hm_status status = HM_OK;
    const PetscErrorCode code = solve_all(of, n_columns, report, &status, err);
    if (code != 0) status = petsc_status(code, err);
    return agree(status, of->of->comm, err);
}

static int bad_report(const hm_petsc_report *report) {
    return report != NULL && (report->struct_size < 8 || report->struct_size > 4096);
}

hm_status hm_petsc_rows_size(const hm_petsc *system, size_t *bytes, hm_error *err) {
    if (system == NULL) return refuse(err, HM_BAD_ARGUMENT, -1, "system is NULL");
    return hm_rows_size(system->equations, bytes, err);
}

hm_status hm_petsc_solve(hm_petsc *system, hm_basis **rows, void *block, size_t bytes, hm_petsc_report *report,
                         hm_error *err) {
    hm_petsc_report found = {sizeof found};
    hm_basis *made = NULL;
    columns of;
    hm_status status;
    if (system == NULL) return refuse(err, HM_BAD_ARGUMENT, -1, "system is NULL");
    memset(&of, 0, sizeof of);
    status = rows == NULL || bad_report(report)
                 ? refuse(err, HM_BAD_ARGUMENT, -1, "rows is NULL, or report.struct_size is not set")
                 : hm_rows_init(&made, block, bytes, system->equations, err);
    status = agree(status, system->comm, err);
    if (status < 0) return status;
    of.of = system;
    of.rows = made;
    status = run(&of, system->info.columns, &found, err);
    if (status >= 0) status = agree(hm_rows_finish(system->equations, made, 0, err), system->comm, err);
    if (status < 0) return status;
    *rows = made;
    return finish(system, &found, report, err);
}

hm_status hm_petsc_displace(hm_petsc *system, const hm_points_out *displacement, hm_petsc_report *report,
                            hm_error *err) {
    hm_petsc_report found = {sizeof found};
    columns of;
    hm_points given;
    hm_status status = HM_OK;
    size_t length;
    if (system == NULL) return refuse(err, HM_BAD_ARGUMENT, -1, "system is NULL");
    memset(&of, 0, sizeof of);
    of.of = system;
    length = (size_t)system->info.unknowns * (size_t)(system->info.numbers * system->info.field_columns);
    of.work = room_for(2 * (size_t)system->mesh.n_points, sizeof *of.work);
    of.numbers = room_for(2 * length, sizeof *of.numbers);
    of.residuals = of.numbers != NULL ? of.numbers + length : NULL;
    if (of.work == NULL || of.numbers == NULL) status = no_memory(err);
    if (displacement == NULL || bad_report(report)) {
        status = refuse(err, HM_BAD_ARGUMENT, -1, "displacement is NULL, or report.struct_size is not set");
    }
    if (status >= 0) {
        given.x = displacement->x;
        given.y = displacement->y;
        given.stride = displacement->stride;
        status = hm_field_init(system->equations, &given, of.work, of.numbers, err);
    }
    status = agree(status, system->comm, err);
    if (status >= 0) status = run(&of, system->info.field_columns, &found, err);
    if (status >= 0) {
        status = agree(hm_field_finish(system->equations, of.work, of.numbers, displacement, err), system->comm, err);
    }
    free(of.work);
    free(of.numbers);
    return status < 0 ? status : finish(system, &found, report, err);
}

/* ---- The whole mesh ------------------------------------------------------------------------------------------------
 */

hm_status hm_petsc_owned(const hm_petsc *system, uint8_t *owned, hm_error *err) {
    if (system == NULL || owned == NULL) return refuse(err, HM_BAD_ARGUMENT, -1, "system or owned is NULL");
    memcpy(owned, system->owned, (size_t)system->mesh.n_points);
    return HM_OK;
}

/* The smallest value of all processes, and which process has it. */
static void least(double *value, int *rank, MPI_Comm comm) {
    struct {
        double value;
        int rank;
    } own, of_all;
    MPI_Comm_rank(comm, &own.rank);
    own.value = *value;
    MPI_Allreduce(&own, &of_all, 1, MPI_DOUBLE_INT, MPI_MINLOC, comm);
    *value = of_all.value;
    *rank = of_all.rank;
}

hm_status hm_petsc_assess(const hm_petsc *system, const hm_basis *rows, const hm_points *from,
                          const hm_points *displacement, hm_step_report *step, hm_quality_report *quality, int *rank,
                          hm_error *err) {
    hm_step_report its_step = {sizeof its_step};
    hm_quality_report its = {sizeof its};
    hm_mesh own = {sizeof own};
    const int32_t *cell = NULL;
    int32_t places[3], inverted;
    double sums[2], area;
    int ranks[2], k;
    hm_status status;
    if (system == NULL) return refuse(err, HM_BAD_ARGUMENT, -1, "system is NULL");
    status = hm_part_cells(system->part, &own, &cell, err);
    if (step == NULL || quality == NULL || step->struct_size < sizeof *step || quality->struct_size < sizeof *quality) {
        status = refuse(err, HM_BAD_ARGUMENT, -1, "step or quality is NULL, or its struct_size is not set");
    }
    if (status >= 0) status = hm_assess(rows, &own, from, displacement, NULL, &its_step, &its, err);
    status = agree(status, system->comm, err);
    if (status < 0) return status;
    places[0] = its_step.cell;
    places[1] = its.min_quality_cell;
    for (k = 0; k < 2 && cell != NULL; ++k) {
        if (places[k] >= 0) places[k] = cell[places[k] - own.index_base] + own.index_base;
    }
    places[2] = its_step.point;
    sums[0] = its.mean_quality * own.n_cells;
    sums[1] = own.n_cells;
    inverted = its.inverted;
    area = its.min_area;
    least(&its_step.admissible, &ranks[0], system->comm);
    least(&its.min_quality, &ranks[1], system->comm);
    MPI_Bcast(&places[0], 1, MPI_INT32_T, ranks[0], system->comm);
    MPI_Bcast(&places[2], 1, MPI_INT32_T, ranks[0], system->comm);
    MPI_Bcast(&places[1], 1, MPI_INT32_T, ranks[1], system->comm);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, system->comm);
    MPI_Allreduce(MPI_IN_PLACE, &inverted, 1, MPI_INT32_T, MPI_SUM, system->comm);
    MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_MIN, system->comm);
    its_step.cell = places[0];
    its_step.point = places[2];
    its_step.struct_size = step->struct_size;
    its.min_quality_cell = places[1];
    its.first_inverted = inverted > 0 ? places[1] : -1;
    its.inverted = inverted;
    its.min_area = area;
    its.mean_quality = sums[0] / sums[1];
    its.struct_size = quality->struct_size;
    *step = its_step;
    *quality = its;
    if (rank != NULL) memcpy(rank, ranks, sizeof ranks);
    return HM_OK;
}
