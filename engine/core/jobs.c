#define _GNU_SOURCE /* sched_getaffinity: respects taskset and container cpusets, sysconf does not */
#include "engine/core/jobs.h"
#include <assert.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

enum {
    THREADS_MAX = 256,    /* bounds the arrays on the stack */
    PIECES_PER_WORKER = 4 /* of what is left; more pieces even out better, fewer cost less */
};

typedef struct shared_work {
    atomic_size_t next; /* the first item nobody has taken */
    size_t count;
    unsigned workers;
    nook_job job;
    void *user;
} shared_work;

typedef struct worker_start {
    shared_work *work;
    unsigned worker;
} worker_start;

static _Thread_local int all_inline;

void nook_parallel_inline(int inlined)
{
    all_inline = inlined;
}

unsigned nook_core_count(void)
{
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0 && CPU_COUNT(&allowed) > 0)
        return (unsigned)CPU_COUNT(&allowed);
    long online = sysconf(_SC_NPROCESSORS_ONLN); /* more than 1024 processors: the set above is too small */
    return online > 0 ? (unsigned)online : 1;
}

unsigned nook_parallel_workers(size_t count, unsigned threads)
{
    unsigned workers = threads ? threads : nook_core_count();
    if (workers > THREADS_MAX)
        workers = THREADS_MAX;
    if (count < workers)
        workers = count ? (unsigned)count : 1;
    return workers;
}

/* Guided self-scheduling (Polychronopoulos and Kuck 1987): each piece is a share of what is left. */
static size_t take_piece(shared_work *work, size_t *out_first)
{
    /* Relaxed: the counter only hands out numbers; creating and joining the threads orders all other memory. */
    size_t first = atomic_load_explicit(&work->next, memory_order_relaxed);
    while (first < work->count) {
        size_t size = (work->count - first) / ((size_t)work->workers * PIECES_PER_WORKER);
        if (size == 0)
            size = 1;
        if (atomic_compare_exchange_weak_explicit(&work->next, &first, first + size, memory_order_relaxed,
                                                  memory_order_relaxed)) {
            *out_first = first;
            return size;
        }
    }
    return 0;
}

static void work_until_done(shared_work *work, unsigned worker)
{
    size_t first = 0;
    for (size_t size = take_piece(work, &first); size > 0; size = take_piece(work, &first))
        work->job(work->user, first, first + size, worker);
}

static void *run_worker(void *argument)
{
    const worker_start *start = argument;
    work_until_done(start->work, start->worker);
    return NULL;
}

void nook_parallel_for(size_t count, unsigned threads, nook_job job, void *user)
{
    assert(job);
    if (count == 0)
        return;
    unsigned workers = all_inline ? 1 : nook_parallel_workers(count, threads);
    if (workers == 1) {
        job(user, 0, count, 0);
        return;
    }
    shared_work work = { .count = count, .workers = workers, .job = job, .user = user };
    atomic_init(&work.next, 0);
    pthread_t handles[THREADS_MAX];
    worker_start starts[THREADS_MAX];
    unsigned started = 1; /* this thread is worker 0 */
    for (; started < workers; started++) {
        starts[started] = (worker_start){ &work, started };
        if (pthread_create(&handles[started], NULL, run_worker, &starts[started]) != 0)
            break;
    }
    work_until_done(&work, 0);
    for (unsigned i = 1; i < started; i++)
        pthread_join(handles[i], NULL);
}
