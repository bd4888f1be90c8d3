#include "modules/stream/loader.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <inttypes.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { PRIORITY = 10 /* "nice": a frame that wants all cores has nine parts of ten */ };

typedef enum job_state { JOB_FREE, JOB_WAITS, JOB_RUNS, JOB_DONE } job_state;

typedef struct loader_job {
    job_state state;
    bool abandoned; /* while it ran */
    uint64_t order; /* those that were asked for first are read first */
    char path[NOOK_STREAM_PATH_MAX];
    nook_volume_info expected;
    nook_volume contents;
    nook_result result;
} loader_job;

/* The mutex guards all of it but what a job that runs reads: path and expected stay as they are then. It is held for a few
   instructions only. */
struct stream_loader {
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t work;
    bool ends;
    bool runs; /* there is a thread; its owner's alone */
    uint64_t orders;
    loader_job jobs[LOADER_JOBS];
};

/* ---- The thread ---------------------------------------------------------------------------------------------------- */

static bool is_as_expected(const nook_volume_info *a, const nook_volume_info *b)
{
    return a->kind == b->kind && a->width == b->width && a->height == b->height && a->depth == b->depth &&
           a->occupied == b->occupied && a->content_hash == b->content_hash;
}

static nook_result load(const loader_job *job, nook_volume *out_contents)
{
    nook_file file;
    nook_result result = nook_file_read(job->path, &file);
    if (result != NOOK_OK)
        return result;
    nook_volume volume;
    result = nook_volume_decode(job->path, file.bytes, file.size, &volume);
    nook_file_free(&file);
    if (result != NOOK_OK)
        return result;
    if (!is_as_expected(&volume.info, &job->expected)) {
        result = nook_fail(NOOK_E_FORMAT, "%s: holds another volume (%016" PRIx64 ") than the one that was added",
                           job->path, volume.info.content_hash);
        nook_volume_free(&volume);
        return result;
    }
    *out_contents = volume;
    return NOOK_OK;
}

static loader_job *first_that_waits(stream_loader *loader)
{
    loader_job *first = NULL;
    for (int i = 0; i < LOADER_JOBS; i++) {
        loader_job *job = &loader->jobs[i];
        if (job->state == JOB_WAITS && (!first || job->order < first->order))
            first = job;
    }
    return first;
}

/* With the mutex held, but while the file is read. */
static void run_job(stream_loader *loader, loader_job *job)
{
    nook_volume contents = { .voxels = NULL };
    job->state = JOB_RUNS;
    pthread_mutex_unlock(&loader->mutex);
    nook_result result = load(job, &contents);
    pthread_mutex_lock(&loader->mutex);
    if (job->abandoned) { /* it takes a while to give back many bytes: nobody is to wait for that */
        pthread_mutex_unlock(&loader->mutex);
        nook_volume_free(&contents);
        pthread_mutex_lock(&loader->mutex);
        job->state = JOB_FREE;
        return;
    }
    job->contents = contents;
    job->result = result;
    job->state = JOB_DONE;
}

static void *run(void *user)
{
    stream_loader *loader = user;
    setpriority(PRIO_PROCESS, 0, PRIORITY); /* on Linux: of this thread alone */
    pthread_mutex_lock(&loader->mutex);
    while (!loader->ends) {
        loader_job *job = first_that_waits(loader);
        if (job)
            run_job(loader, job);
        else
            pthread_cond_wait(&loader->work, &loader->mutex);
    }
    pthread_mutex_unlock(&loader->mutex);
    return NULL;
}

/* ---- Its owner ----------------------------------------------------------------------------------------------------- */

nook_result stream_loader_wake(stream_loader *loader)
{
    if (loader->runs)
        return NOOK_OK;
    loader->ends = false;
    if (pthread_create(&loader->thread, NULL, run, loader) != 0)
        return nook_fail(NOOK_E_MEMORY, "stream: no thread to read volumes");
    loader->runs = true;
    return NOOK_OK;
}

void stream_loader_rest(stream_loader *loader)
{
    if (!loader->runs)
        return;
    pthread_mutex_lock(&loader->mutex);
    loader->ends = true;
    pthread_cond_signal(&loader->work);
    pthread_mutex_unlock(&loader->mutex);
    pthread_join(loader->thread, NULL);
    loader->runs = false;
}

nook_result stream_loader_create(stream_loader **out_loader)
{
    *out_loader = NULL;
    stream_loader *loader = calloc(1, sizeof *loader);
    if (!loader)
        return nook_fail(NOOK_E_MEMORY, "stream: no memory to read volumes");
    pthread_mutex_init(&loader->mutex, NULL);
    pthread_cond_init(&loader->work, NULL);
    nook_result result = stream_loader_wake(loader);
    if (result != NOOK_OK) {
        stream_loader_destroy(loader);
        return result;
    }
    *out_loader = loader;
    return NOOK_OK;
}

void stream_loader_destroy(stream_loader *loader)
{
    if (!loader)
        return;
    stream_loader_rest(loader);
    for (int i = 0; i < LOADER_JOBS; i++)
        nook_volume_free(&loader->jobs[i].contents);
    pthread_cond_destroy(&loader->work);
    pthread_mutex_destroy(&loader->mutex);
    free(loader);
}

static int free_job(const stream_loader *loader)
{
    for (int i = 0; i < LOADER_JOBS; i++)
        if (loader->jobs[i].state == JOB_FREE)
            return i;
    return LOADER_NONE;
}

bool stream_loader_has_room(stream_loader *loader)
{
    pthread_mutex_lock(&loader->mutex);
    bool has_room = free_job(loader) != LOADER_NONE;
    pthread_mutex_unlock(&loader->mutex);
    return has_room;
}

int stream_loader_start(stream_loader *loader, const char *path, const nook_volume_info *expected)
{
    pthread_mutex_lock(&loader->mutex);
    int number = free_job(loader);
    if (number != LOADER_NONE) {
        loader_job *job = &loader->jobs[number];
        memcpy(job->path, path, strlen(path) + 1); /* no longer than a path may be */
        job->expected = *expected;
        job->contents = (nook_volume){ .voxels = NULL };
        job->abandoned = false;
        job->order = loader->orders++;
        job->state = JOB_WAITS;
        pthread_cond_signal(&loader->work);
    }
    pthread_mutex_unlock(&loader->mutex);
    return number;
}

bool stream_loader_is_done(stream_loader *loader, int number, nook_result *out_result, nook_volume **out_contents)
{
    pthread_mutex_lock(&loader->mutex);
    loader_job *job = &loader->jobs[number];
    bool done = job->state == JOB_DONE;
    if (done) {
        *out_result = job->result;
        *out_contents = &job->contents;
    }
    pthread_mutex_unlock(&loader->mutex);
    return done;
}

void stream_loader_free(stream_loader *loader, int number)
{
    nook_volume contents = { .voxels = NULL };
    pthread_mutex_lock(&loader->mutex);
    loader_job *job = &loader->jobs[number];
    if (job->state == JOB_RUNS) {
        job->abandoned = true;
    } else {
        contents = job->contents;
        job->contents = (nook_volume){ .voxels = NULL };
        job->state = JOB_FREE;
    }
    pthread_mutex_unlock(&loader->mutex);
    nook_volume_free(&contents);
}
