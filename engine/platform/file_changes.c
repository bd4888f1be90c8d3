#include "engine/core/log.h"
#include "engine/platform/file_changes_internal.h"
#include "engine/platform/file_watch.h"
#include <stdlib.h>
#include <string.h>

static bool reserve(file_changes *changes, size_t size)
{
    if (changes->size + size <= changes->capacity)
        return true;
    size_t capacity = 2 * (changes->size + size) + 1024;
    char *text = realloc(changes->text, capacity);
    if (!text)
        return false;
    changes->text = text;
    changes->capacity = capacity;
    return true;
}

bool nook_file_changes_add(file_changes *changes, const char *path, double when_ms)
{
    size_t size = strlen(path) + 1;
    if (changes->count == 0 || when_ms > changes->last_ms)
        changes->last_ms = when_ms;
    /* One write is several events: the same path again is the usual case. */
    if (changes->count > 0 && strcmp(changes->text + changes->last, path) == 0)
        return true;
    if (!reserve(changes, size))
        return false;
    if (changes->count++ == 0 || when_ms < changes->first_ms)
        changes->first_ms = when_ms;
    changes->last = changes->size;
    memcpy(changes->text + changes->size, path, size);
    changes->size += size;
    return true;
}

double nook_file_changes_settling_ms(const file_changes *changes, double now_ms)
{
    double settled = changes->last_ms + NOOK_FILE_WATCH_SETTLE_MS,
           longest = changes->first_ms + NOOK_FILE_WATCH_LONGEST_MS;
    double left = (settled < longest ? settled : longest) - now_ms;
    return changes->count > 0 && left > 0.0 ? left : 0.0;
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Points `sorted` at the paths. @return false without memory */
static bool sort_paths(file_changes *changes)
{
    if (changes->count > changes->sorted_capacity) {
        const char **sorted = realloc(changes->sorted, changes->count * sizeof *sorted);
        if (!sorted)
            return false;
        changes->sorted = sorted;
        changes->sorted_capacity = changes->count;
    }
    const char *path = changes->text;
    for (size_t i = 0; i < changes->count; i++) {
        changes->sorted[i] = path;
        path += strlen(path) + 1;
    }
    qsort(changes->sorted, changes->count, sizeof *changes->sorted, compare_paths);
    return true;
}

size_t nook_file_changes_tell(file_changes *changes, void (*changed)(void *user, const char *path), void *user)
{
    size_t told = 0;
    if (changes->count > 0 && !sort_paths(changes)) {
        nook_log_warning("file watch: out of memory; %zu changes wait", changes->count);
        return 0;
    }
    for (size_t i = 0; i < changes->count; i++) {
        if (i > 0 && strcmp(changes->sorted[i - 1], changes->sorted[i]) == 0)
            continue;
        changed(user, changes->sorted[i]);
        told++;
    }
    changes->count = 0;
    changes->size = 0;
    return told;
}

void nook_file_changes_free(file_changes *changes)
{
    free(changes->text);
    free(changes->sorted);
    *changes = (file_changes){ 0 };
}
