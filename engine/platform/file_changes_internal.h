/**
 * file_changes_internal.h - paths that have changed and wait until they may be told.
 */
#pragma once
#include <stdbool.h>
#include <stddef.h>

/** Zeroed is empty. Release with nook_file_changes_free. */
typedef struct file_changes {
    char *text; /**< Owned: paths, each with its zero byte. */
    size_t size, capacity;
    const char **sorted; /**< Owned: scratch for telling. */
    size_t sorted_capacity;
    size_t count; /**< Paths in text, some of them more than once. */
    size_t last;  /**< Where the last path starts. */
    double first_ms, last_ms;
} file_changes;

/** Remembers a path that changed at that time, by nook_clock_ms. @return false without memory; it is not remembered then */
bool nook_file_changes_add(file_changes *changes, const char *path, double when_ms);

/** Until it is time to tell them; 0: it is, or there are none. */
double nook_file_changes_settling_ms(const file_changes *changes, double now_ms);

/** Calls `changed` for each path once, sorted, and forgets them all. @return how many */
size_t nook_file_changes_tell(file_changes *changes, void (*changed)(void *user, const char *path), void *user);

void nook_file_changes_free(file_changes *changes);
