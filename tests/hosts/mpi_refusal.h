/* Judges collective calls in which one process is wrong: a refusal is the same on all processes,
 * and none waits for ever. */
#ifndef MPI_REFUSAL_H
#define MPI_REFUSAL_H

#include <harmorph_mpi.h>

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static char now_tried[256]; /* the call, with a line for the end of the wait */
static int length_of_call;

static void end_of_wait(int signal) {
    (void)signal;
    if (write(2, now_tried, strlen(now_tried)) < 0) _exit(3);
    _exit(2); /* mpirun then ends the other processes */
}

/* The processes have two minutes for the next call, which takes milliseconds. */
static void expect_end_of(const char* what, int guilty) {
    length_of_call = snprintf(now_tried, sizeof now_tried, "%s on rank %d", what, guilty);
    snprintf(now_tried + length_of_call, sizeof now_tried - (size_t)length_of_call,
             ": a process waits for ever\n");
    signal(SIGALRM, end_of_wait);
    alarm(120);
}

/* True if all processes have the status `wanted` and the same error, whose text contains `reason`
 * and, if there are several processes, begins with the rank `guilty` (-1: with any rank). */
static int refused_by_all(hm_status own, const hm_error* error, hm_status wanted, int guilty,
                          const char* reason) {
    hm_error first = *error;
    char rank[16] = "";
    int size, is_right, all;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (size > 1) snprintf(rank, sizeof rank, guilty < 0 ? "rank " : "rank %d: ", guilty);
    MPI_Bcast(&first, sizeof first, MPI_BYTE, 0, MPI_COMM_WORLD);
    is_right = own == wanted && error->code == wanted && memcmp(error, &first, sizeof first) == 0 &&
               strncmp(error->text, rank, strlen(rank)) == 0 && strstr(error->text, reason) != NULL;
    if (!is_right)
        printf("    %.*s: status %d instead of %d: %s\n", length_of_call, now_tried, (int)own,
               (int)wanted, error->text);
    MPI_Allreduce(&is_right, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    alarm(0);
    return all;
}

#endif
