/* Threads for harmorph by OpenMP. Compile files that include this header with -fopenmp. Two lines
 * turn threads on:
 *
 *     hm_executor executor = hm_openmp_executor(4);
 *     options.executor = &executor; */
#ifndef HARMORPH_OPENMP_H
#define HARMORPH_OPENMP_H

#include "harmorph.h"

static inline void hm_openmp_run(void* user, int32_t n_tasks,
                                 void (*task)(void* context, int32_t index), void* context) {
    const int n_threads = (int)(intptr_t)user;
    int32_t i;
    (void)n_threads; /* used by the pragma only */
#pragma omp parallel for schedule(dynamic, 1) num_threads(n_threads)
    for (i = 0; i < n_tasks; ++i) task(context, i);
}

static inline hm_executor hm_openmp_executor(int32_t n_threads) {
    hm_executor executor;
    executor.struct_size = sizeof executor;
    executor.run = hm_openmp_run;
    if (n_threads < 1) n_threads = 1;
    if (n_threads > 256) n_threads = 256;
    executor.user = (void*)(intptr_t)n_threads;
    executor.n_threads = n_threads;
    executor.kernel = hm_best_kernel();
    return executor;
}

#endif
