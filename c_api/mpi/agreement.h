/* Agreement of the processes on a status and on its reason. */
#ifndef HARMORPH_MPI_AGREEMENT_H
#define HARMORPH_MPI_AGREEMENT_H

#include <harmorph.h>
#include <mpi.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static hm_status refuse(hm_error* err, hm_status code, const char* sentence) {
    memset(err, 0, sizeof *err);
    err->code = code;
    err->item = err->other = -1;
    snprintf(err->text, sizeof err->text, "%s", sentence);
    return code;
}

static hm_status refuse_argument(hm_error* err, const char* sentence) {
    return refuse(err, HM_BAD_ARGUMENT, sentence);
}

/* The private calls have no promise from version to version: the module and the library must be of
 * one version. */
static hm_status refuse_other_version(hm_error* err) {
    char sentence[sizeof err->text];
    if (strcmp(hm_version(), HM_VERSION) == 0) return HM_OK;
    snprintf(sentence, sizeof sentence,
             "this module was compiled with harmorph " HM_VERSION
             ", but the library has version %s; compile the module with the headers of the library",
             hm_version());
    return refuse(err, HM_UNSUPPORTED, sentence);
}

/* Puts "before RANK: " in front of the reason. */
static void name_rank(hm_error* err, const char* before, int rank) {
    char text[2 * sizeof err->text];
    snprintf(text, sizeof text, "%s %d: %s", before, rank, err->text);
    memcpy(err->text, text, sizeof err->text - 1);
    err->text[sizeof err->text - 1] = 0;
}

/* The worst status of all processes: the lowest refusal, or else the highest warning. Where it is
 * not HM_OK, all processes receive the error of the first process that has this status, with the
 * rank of that process in front of the text. err is not NULL. */
static hm_status agree(hm_status own, MPI_Comm comm, hm_error* err) {
    int mine[2], worst[2], size; /* the order of a status, and the rank, for MPI_MINLOC */
    hm_status agreed;
    mine[0] = own < 0 ? own : INT_MAX - own;
    MPI_Comm_rank(comm, &mine[1]);
    MPI_Comm_size(comm, &size);
    MPI_Allreduce(mine, worst, 1, MPI_2INT, MPI_MINLOC, comm);
    agreed = worst[0] < 0 ? worst[0] : INT_MAX - worst[0];
    if (agreed == HM_OK || size == 1) return agreed;
    if (mine[1] == worst[1]) name_rank(err, "rank", mine[1]);
    MPI_Bcast(err, sizeof *err, MPI_BYTE, worst[1], comm);
    return agreed;
}

/* True on processes whose numbers [n], n <= 4, are not those of rank 0. Collective. */
static int differs_from_first(const int64_t* numbers, int n, MPI_Comm comm) {
    int64_t first[4];
    memcpy(first, numbers, (size_t)n * sizeof *first);
    MPI_Bcast(first, n, MPI_INT64_T, 0, comm);
    return memcmp(first, numbers, (size_t)n * sizeof *first) != 0;
}

/* A size query, see hm_memory. */
static int asks(const hm_memory* memory) {
    return memory != NULL && memory->block == NULL && memory->bytes == 0;
}

/* Refuses a call that is a size query on some processes only. Collective. */
static hm_status agree_on_query(const hm_memory* memory, MPI_Comm comm, hm_error* err) {
    const int64_t is_query = asks(memory);
    hm_status status = HM_OK;
    if (differs_from_first(&is_query, 1, comm))
        status = refuse_argument(err, is_query ? "memory asks for the size, but not on rank 0"
                                               : "memory has a block, but asks for the size on "
                                                 "rank 0");
    return agree(status, comm, err);
}

/* Begins each call: the reason has a place also where the caller wants none, since other processes
 * may want the reason. */
#define BEGIN_CALL(comm, err)           \
    hm_error unread;                    \
    if ((err) == NULL) (err) = &unread; \
    if ((comm) == MPI_COMM_NULL) return refuse_argument(err, "the communicator is MPI_COMM_NULL")

/* Memory filled with zeros: at least one byte, so that NULL always means that there is no memory.
 */
static void* room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

#endif
