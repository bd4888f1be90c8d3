#include "game/extremes/peak_memory.h"
#include "engine/core/log.h"
#include <errno.h>
#include <malloc.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* AddressSanitizer keeps a byte about every eight that are touched, and half a MB for each of 4 threads; nobody asked for them. */
#if defined(__SANITIZE_ADDRESS__)
enum { OURS = 8, KEPT = 9, THREADS = 2 << 20 };
#else
enum { OURS = 1, KEPT = 1, THREADS = 0 };
#endif

/* A line's number. */
static void take_line(const char *line, const char *name, uint64_t *out_bytes)
{
    unsigned long long kilobytes;
    const size_t length = strlen(name);
    if (strncmp(line, name, length) == 0 && sscanf(line + length, "%llu", &kilobytes) == 1)
        *out_bytes = (uint64_t)kilobytes * 1024;
}

nook_result nook_memory_read(nook_memory *out_memory)
{
    FILE *file = fopen("/proc/self/status", "r");
    char line[256];
    nook_memory memory = { 0 };
    while (file && fgets(line, sizeof line, file)) {
        take_line(line, "VmRSS:", &memory.resident);
        take_line(line, "VmHWM:", &memory.peak);
    }
    if (file)
        fclose(file);
    if (memory.resident == 0 || memory.peak == 0)
        return nook_fail(NOOK_E_IO, "/proc/self/status: no VmRSS and VmHWM, so memory cannot be measured here");
    *out_memory = memory;
    return NOOK_OK;
}

uint64_t nook_peak_memory_ours(uint64_t growth)
{
    return growth > THREADS ? (growth - THREADS) / KEPT * OURS : 0;
}

/* ---- A process of its own ---- */

/** The child's whole life: the result, and after it the answer. */
static void answer(int pipe_end, nook_child_work work, const void *user, size_t out_size)
{
    mallopt(M_MMAP_THRESHOLD, 128 << 10); /* as at a program's start: what the parent freed has raised it, and then */
    mallopt(M_TRIM_THRESHOLD, 128 << 10); /* large blocks that are freed stay resident */
    void *out = calloc(1, out_size);
    nook_result result = out ? work(user, out) : NOOK_E_MEMORY;
    bool told = write(pipe_end, &result, sizeof result) == (ssize_t)sizeof result &&
                (!out || write(pipe_end, out, out_size) == (ssize_t)out_size); /* less than a pipe holds at once */
    _exit(told ? 0 : 1); /* not exit: what the parent would do at its end is the parent's */
}

static bool read_all(int file, void *out, size_t size)
{
    for (size_t used = 0; used < size;) {
        ssize_t got = read(file, (char *)out + used, size - used);
        if (got <= 0 && !(got < 0 && errno == EINTR))
            return false;
        used += got > 0 ? (size_t)got : 0;
    }
    return true;
}

static nook_result receive(int pipe_end, pid_t child, void *out, size_t out_size)
{
    nook_result result = NOOK_OK;
    void *answered = malloc(out_size);
    bool whole = answered && read_all(pipe_end, &result, sizeof result) && read_all(pipe_end, answered, out_size);
    int status = 0;
    close(pipe_end);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    if (!whole)
        result =
            nook_fail(NOOK_E_MEMORY, "extremes: the process that measures ended without an answer, status %d", status);
    if (result == NOOK_OK)
        memcpy(out, answered, out_size);
    free(answered);
    return result;
}

nook_result nook_run_in_child(nook_child_work work, const void *user, void *out, size_t out_size)
{
    int ends[2];
    if (pipe(ends) != 0)
        return nook_fail(NOOK_E_IO, "extremes: no pipe to a process that measures: %s", strerror(errno));
    fflush(NULL); /* or the child would write it too */
    malloc_trim(0);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        answer(ends[1], work, user, out_size);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return nook_fail(NOOK_E_IO, "extremes: no process to measure in: %s", strerror(errno));
    }
    return receive(ends[0], child, out, out_size);
}
