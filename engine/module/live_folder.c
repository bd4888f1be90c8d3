#include "engine/core/file.h"
#include "engine/module/live_folder_internal.h"
#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

nook_file_mark nook_file_mark_of(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode))
        return (nook_file_mark){ 0 };
    return (nook_file_mark){ .device = info.st_dev,
                             .node = info.st_ino,
                             .size = (uint64_t)info.st_size,
                             .seconds = info.st_mtim.tv_sec,
                             .nanoseconds = info.st_mtim.tv_nsec };
}

bool nook_file_mark_same(nook_file_mark a, nook_file_mark b)
{
    return a.device == b.device && a.node == b.node && a.size == b.size && a.seconds == b.seconds &&
           a.nanoseconds == b.nanoseconds;
}

static void build_path(const nook_live_folder *folder, char *out)
{
    nook_path_join(out, NOOK_LIVE_PATH_MAX, folder->path, "build");
}

/* "game.1234.7.so" is a copy of process 1234. */
static bool is_left_behind(const char *name)
{
    char module[256], end[4];
    long process;
    unsigned number;
    if (sscanf(name, "%255[^.].%ld.%u.%3s", module, &process, &number, end) != 4 || strcmp(end, "so") != 0)
        return false;
    return kill((pid_t)process, 0) != 0 && errno == ESRCH;
}

static void remove_left_behind(const char *path)
{
    DIR *directory = opendir(path);
    if (!directory)
        return;
    for (const struct dirent *entry = readdir(directory); entry; entry = readdir(directory)) {
        if (is_left_behind(entry->d_name))
            unlinkat(dirfd(directory), entry->d_name, 0);
    }
    closedir(directory);
}

void nook_live_folder_open(nook_live_folder *folder, const char *path)
{
    char build[NOOK_LIVE_PATH_MAX];
    *folder = (nook_live_folder){ .copies = 0 };
    snprintf(folder->path, sizeof folder->path, "%s", path);
    remove_left_behind(path);
    build_path(folder, build);
    folder->build = nook_file_mark_of(build);
}

/* The end of what the compiler said is the least of it: it is cut there. */
static void read_build(const char *path, nook_live_build *out)
{
    nook_file file;
    *out = (nook_live_build){ .failed = false };
    if (nook_file_read(path, &file) != NOOK_OK)
        return;
    const char *text = (const char *)file.bytes, *line_end = strchr(text, '\n');
    size_t first_line = line_end ? (size_t)(line_end - text) : strlen(text);
    out->failed = first_line >= 6 && strncmp(text + first_line - 6, "failed", 6) == 0;
    if (out->failed && line_end)
        snprintf(out->text, sizeof out->text, "%s", line_end + 1);
    nook_file_free(&file);
}

bool nook_live_folder_poll(nook_live_folder *folder, nook_live_build *out_build)
{
    char path[NOOK_LIVE_PATH_MAX];
    build_path(folder, path);
    nook_file_mark mark = nook_file_mark_of(path);
    if (mark.node == 0 || nook_file_mark_same(mark, folder->build))
        return false;
    folder->build = mark;
    read_build(path, out_build);
    return true;
}

char *nook_live_folder_library(const nook_live_folder *folder, const char *name, char *out)
{
    int length = snprintf(out, NOOK_LIVE_PATH_MAX, "%s/%s.so", folder->path, name);
    if (length < 0 || length >= NOOK_LIVE_PATH_MAX)
        out[0] = '\0'; /* no such file */
    return out;
}

nook_result nook_live_folder_copy(nook_live_folder *folder, const char *name, char *out_path)
{
    char source[NOOK_LIVE_PATH_MAX], copy[512];
    do { /* a path that is loaded already would give the code that is loaded */
        snprintf(copy, sizeof copy, "%s.%ld.%u.so", name, (long)getpid(), ++folder->copies);
        nook_path_join(out_path, NOOK_LIVE_PATH_MAX, folder->path, copy);
    } while (nook_file_exists(out_path));
    return nook_file_copy(nook_live_folder_library(folder, name, source), out_path);
}
