/* Threads for harmorph by POSIX threads: a pool of threads that wait between calls. Compile and
 * link with -pthread.
 *
 *     hm_pthreads pool;
 *     hm_executor executor = hm_pthreads_start(&pool, 4);
 *     options.executor = &executor;
 *     ...
 *     hm_pthreads_stop(&pool);
 *
 * The address of the pool must not change until hm_pthreads_stop. The pool serves one call of the
 * library at a time. */
#ifndef HARMORPH_PTHREADS_H
#define HARMORPH_PTHREADS_H

#include <pthread.h>
#include <sched.h>

#include "harmorph.h"

/* A call of the library gives out tasks many times, a fraction of a millisecond apart, and waking a
 * sleeping thread takes as long as a small task. So a thread without a task asks this many times
 * for a new one, and lets other programs run in between, before it sleeps: a few tenths of a
 * millisecond in all. */
enum { HM_PTHREADS_TURNS = 1000 };

typedef struct hm_pthreads {
    pthread_mutex_t mutex;
    pthread_cond_t work, done;
    pthread_t thread[255]; /* in addition to the calling thread */
    int32_t n_started;
    int32_t next, n_tasks; /* the next task and the number of tasks of the current call */
    int32_t running;       /* tasks taken and not yet done */
    int32_t stop;
    /* counts the events that threads wait for: new tasks, the end of the last task, stop */
    uint32_t changes;
    void (*task)(void* context, int32_t index);
    void* context;
} hm_pthreads;

static inline void hm_pthreads_change(hm_pthreads* pool) {
#if defined(__GNUC__)
    __atomic_store_n(&pool->changes, pool->changes + 1, __ATOMIC_RELAXED);
#endif
}

/* Waits for the next change; it may return earlier. The mutex is locked on entry and on return. */
static inline void hm_pthreads_wait(hm_pthreads* pool, pthread_cond_t* condition) {
#if defined(__GNUC__)
    const uint32_t seen = pool->changes;
    int32_t turn;
    pthread_mutex_unlock(&pool->mutex);
    for (turn = 0; turn < HM_PTHREADS_TURNS; ++turn) {
        if (__atomic_load_n(&pool->changes, __ATOMIC_RELAXED) != seen) break;
        sched_yield();
    }
    pthread_mutex_lock(&pool->mutex);
    if (pool->changes != seen) return;
#endif
    pthread_cond_wait(condition, &pool->mutex);
}

/* Runs tasks until none is left. The mutex is locked on entry and on return. */
static inline void hm_pthreads_work(hm_pthreads* pool) {
    while (pool->next < pool->n_tasks) {
        const int32_t index = pool->next++;
        ++pool->running;
        pthread_mutex_unlock(&pool->mutex);
        pool->task(pool->context, index);
        pthread_mutex_lock(&pool->mutex);
        --pool->running;
        if (pool->running == 0 && pool->next >= pool->n_tasks) {
            hm_pthreads_change(pool);
            pthread_cond_signal(&pool->done);
        }
    }
}

static inline void* hm_pthreads_main(void* argument) {
    hm_pthreads* pool = (hm_pthreads*)argument;
    pthread_mutex_lock(&pool->mutex);
    while (!pool->stop) {
        hm_pthreads_work(pool);
        if (!pool->stop) hm_pthreads_wait(pool, &pool->work);
    }
    pthread_mutex_unlock(&pool->mutex);
    return NULL;
}

static inline void hm_pthreads_run(void* user, int32_t n_tasks,
                                   void (*task)(void* context, int32_t index), void* context) {
    hm_pthreads* pool = (hm_pthreads*)user;
    pthread_mutex_lock(&pool->mutex);
    pool->task = task;
    pool->context = context;
    pool->next = 0;
    pool->n_tasks = n_tasks;
    hm_pthreads_change(pool);
    pthread_cond_broadcast(&pool->work);
    hm_pthreads_work(pool);
    while (pool->running > 0) hm_pthreads_wait(pool, &pool->done);
    pool->n_tasks = 0;
    pthread_mutex_unlock(&pool->mutex);
}

static inline hm_executor hm_pthreads_start(hm_pthreads* pool, int32_t n_threads) {
    hm_executor executor;
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->work, NULL);
    pthread_cond_init(&pool->done, NULL);
    pool->n_started = pool->next = pool->n_tasks = pool->running = pool->stop = 0;
    pool->changes = 0;
    while (pool->n_started + 1 < n_threads && pool->n_started < 255) {
        if (pthread_create(&pool->thread[pool->n_started], NULL, hm_pthreads_main, pool) != 0)
            break;
        ++pool->n_started;
    }
    executor.struct_size = sizeof executor;
    executor.run = hm_pthreads_run;
    executor.user = pool;
    executor.n_threads = pool->n_started + 1;
    executor.kernel = hm_best_kernel();
    return executor;
}

static inline void hm_pthreads_stop(hm_pthreads* pool) {
    int32_t i;
    pthread_mutex_lock(&pool->mutex);
    pool->stop = 1;
    hm_pthreads_change(pool);
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->mutex);
    for (i = 0; i < pool->n_started; ++i) pthread_join(pool->thread[i], NULL);
    pthread_cond_destroy(&pool->done);
    pthread_cond_destroy(&pool->work);
    pthread_mutex_destroy(&pool->mutex);
}

#endif
