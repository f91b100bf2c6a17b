/* Sends records of a fixed size to the processes that compare them, and receives answers. */
#ifndef HARMORPH_PETSC_MAIL_H
#define HARMORPH_PETSC_MAIL_H

#include "agreement.h"

typedef struct mail {
    MPI_Comm comm;
    int size;
    int *count, *start, *count_in,
        *start_in; /* [size] records sent to, and received from, each process */
    int64_t n, n_in;
    int32_t* place; /* [n] the place of each record in the outgoing order */
    MPI_Datatype record;
} mail;

static void clear_mail(mail* post) {
    memset(post, 0, sizeof *post);
    post->record = MPI_DATATYPE_NULL;
}

static void end_mail(mail* post) {
    free(post->count);
    free(post->place);
    if (post->record != MPI_DATATYPE_NULL) MPI_Type_free(&post->record);
}

/* The process that compares all records with this key. This needs no table and distributes numbers
 * of any order evenly. */
static int process_of(uint64_t key, int size) {
    key = (key ^ (key >> 33)) * 0xff51afd7ed558ccdu;
    key = (key ^ (key >> 33)) * 0xc4ceb9fe1a85ec53u;
    return (int)((key ^ (key >> 33)) % (uint64_t)size);
}

/* to [n]: the process to which each record is sent. */
static hm_status begin_mail(mail* post, MPI_Comm comm, int64_t n, const int* to, hm_error* err) {
    int64_t k;
    int p;
    hm_status status = HM_OK;
    clear_mail(post);
    post->comm = comm;
    post->n = n;
    MPI_Comm_size(comm, &post->size);
    post->count = room_for(4 * (size_t)post->size, sizeof *post->count);
    post->place = room_for((size_t)n, sizeof *post->place);
    if (post->count == NULL || post->place == NULL || n > INT_MAX) status = no_memory(err);
    status = agree(status, comm, err);
    if (status < 0) return status;
    post->start = post->count + post->size;
    post->count_in = post->count + 2 * post->size;
    post->start_in = post->count + 3 * post->size;
    for (k = 0; k < n; ++k) ++post->count[to[k]];
    for (p = 1; p < post->size; ++p) post->start[p] = post->start[p - 1] + post->count[p - 1];
    for (k = 0; k < n; ++k) post->place[k] = post->start[to[k]]++;
    for (p = 0; p < post->size; ++p) post->start[p] -= post->count[p];
    MPI_Alltoall(post->count, 1, MPI_INT, post->count_in, 1, MPI_INT, comm);
    for (p = 0; p < post->size; ++p) {
        post->start_in[p] = post->n_in <= INT_MAX ? (int)post->n_in : 0;
        post->n_in += post->count_in[p];
    }
    return agree(post->n_in > INT_MAX ? no_memory(err) : HM_OK, comm, err);
}

/* Sends records [n] of `bytes` bytes, in the order of begin_mail. The caller frees *in [n_in]. */
static hm_status deliver(mail* post, const void* records, size_t bytes, void** in, hm_error* err) {
    int64_t k;
    char* const out = room_for((size_t)post->n, bytes);
    hm_status status;
    *in = room_for((size_t)post->n_in, bytes);
    status = agree(out == NULL || *in == NULL ? no_memory(err) : HM_OK, post->comm, err);
    if (status >= 0) {
        if (post->record != MPI_DATATYPE_NULL) MPI_Type_free(&post->record);
        MPI_Type_contiguous((int)bytes, MPI_BYTE, &post->record);
        MPI_Type_commit(&post->record);
        for (k = 0; k < post->n; ++k)
            memcpy(out + (size_t)post->place[k] * bytes, (const char*)records + (size_t)k * bytes,
                   bytes);
        MPI_Alltoallv(out, post->count, post->start, post->record, *in, post->count_in,
                      post->start_in, post->record, post->comm);
    }
    free(out);
    return status;
}

/* Sends back given [n_in], one answer for each received record; answers [n] has the order of
 * begin_mail. */
static hm_status answer(mail* post, const int64_t* given, int64_t* answers, hm_error* err) {
    int64_t k, *in = room_for((size_t)post->n, sizeof *in);
    const hm_status status = agree(in == NULL ? no_memory(err) : HM_OK, post->comm, err);
    if (status >= 0) {
        MPI_Alltoallv(given, post->count_in, post->start_in, MPI_INT64_T, in, post->count,
                      post->start, MPI_INT64_T, post->comm);
        for (k = 0; k < post->n; ++k) answers[k] = in[post->place[k]];
    }
    free(in);
    return status;
}

#endif
