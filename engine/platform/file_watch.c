#include "engine/platform/file_watch.h"
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/platform/file_changes_internal.h"
#include <assert.h>
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <uv.h>

enum { PATH_CAPACITY = 4096 };

/* A handle may not move while libuv knows it, and is freed only when libuv says so: each folder has memory of its own. */
typedef struct folder {
    uv_fs_event_t handle;
    nook_file_watch *watch;
    dev_t device; /**< With inode: which folder that path was when it was watched. */
    ino_t inode;
    bool
        ended; /**< It may be deleted or moved: if that path is a folder, then perhaps another one with the same inode. */
    char path[]; /**< Relative to root; "" is root. */
} folder;

struct nook_file_watch {
    uv_loop_t loop;
    char *root;
    char **bases; /**< Owned: folders of the description. */
    size_t base_count;
    folder **folders;
    size_t folder_count, folder_capacity;
    bool flat;
    bool complained; /**< That something could not be watched: said once. */
    double changed_ms;
    file_changes changes;
};

/* Without slashes at its end: libuv finds no name behind them. Owned by the caller. */
static char *copy_path(const char *path)
{
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, path, length);
        copy[length] = '\0';
    }
    return copy;
}

/* root/path, or root for "". @return false when it is too long */
static bool full_path(const nook_file_watch *watch, const char *path, char out[PATH_CAPACITY])
{
    if (path[0] == '\0')
        return snprintf(out, PATH_CAPACITY, "%s", watch->root) < PATH_CAPACITY;
    return snprintf(out, PATH_CAPACITY, "%s/%s", watch->root, path) < PATH_CAPACITY;
}

/* folder/name as it is told. @return false when it is too long */
static bool join(const char *folder_path, const char *name, char out[PATH_CAPACITY])
{
    return snprintf(out, PATH_CAPACITY, "%s%s%s", folder_path, folder_path[0] ? "/" : "", name) < PATH_CAPACITY;
}

static void note(nook_file_watch *watch, const char *path, double when_ms)
{
    if (!nook_file_changes_add(&watch->changes, path, when_ms))
        nook_log_warning("file watch: out of memory; that %s has changed is lost", path);
}

/* When a file was changed, by nook_clock_ms: a frame may be long over when it is heard of. What cannot be true is now. */
static double changed_at(const struct stat *info)
{
    static const double longest_ms = 10000.0;
    struct timespec today;
    double now = nook_clock_ms();
    clock_gettime(CLOCK_REALTIME, &today);
    double age_ms =
        (double)(today.tv_sec - info->st_ctim.tv_sec) * 1e3 + (double)(today.tv_nsec - info->st_ctim.tv_nsec) * 1e-6;
    return age_ms > 0.0 && age_ms < longest_ms ? now - age_ms : now;
}

/* ---- folders ------------------------------------------------------------------------------------------------------- */

static void free_folder(uv_handle_t *handle)
{
    free(handle->data);
}

static void unwatch(nook_file_watch *watch, size_t index)
{
    folder *gone = watch->folders[index];
    watch->folders[index] = watch->folders[--watch->folder_count];
    uv_close((uv_handle_t *)&gone->handle, free_folder);
}

/* Whether path is folder_path or lies in it. */
static bool lies_in(const char *path, const char *folder_path)
{
    size_t length = strlen(folder_path);
    return length == 0 || (strncmp(path, folder_path, length) == 0 && (path[length] == '/' || path[length] == '\0'));
}

/* @return how many folders are not watched any more */
static size_t unwatch_all_in(nook_file_watch *watch, const char *path)
{
    size_t before = watch->folder_count;
    for (size_t i = watch->folder_count; i-- > 0;)
        if (lies_in(watch->folders[i]->path, path))
            unwatch(watch, i);
    return before - watch->folder_count;
}

static nook_result refuse(const char *path, int code)
{
    switch (code) {
    case UV_ENOENT:
    case UV_ENOTDIR:
        return nook_fail(NOOK_E_NOT_FOUND, "%s: no such folder to watch; check the path", path);
    case UV_ENOSPC:
        return nook_fail(NOOK_E_MEMORY,
                         "%s: cannot be watched, the system's limit is reached; raise fs.inotify.max_user_watches",
                         path);
    case UV_EMFILE:
    case UV_ENFILE:
        return nook_fail(NOOK_E_MEMORY,
                         "%s: cannot be watched, too many files are open or watched; raise `ulimit -n` or "
                         "fs.inotify.max_user_instances",
                         path);
    case UV_ENOMEM:
        return nook_fail(NOOK_E_MEMORY, "%s: cannot be watched: out of memory", path);
    default:
        return nook_fail(NOOK_E_IO, "%s: cannot be watched: %s", path, uv_strerror(code));
    }
}

/* Folders may come and go while they are looked at; that is no failure. */
static bool is_gone(int code)
{
    return code == UV_ENOENT || code == UV_ENOTDIR;
}

static bool reserve_folder(nook_file_watch *watch)
{
    if (watch->folder_count < watch->folder_capacity)
        return true;
    size_t capacity = watch->folder_capacity ? watch->folder_capacity * 2 : 16;
    folder **folders = realloc(watch->folders, capacity * sizeof(folder *));
    if (!folders)
        return false;
    watch->folders = folders;
    watch->folder_capacity = capacity;
    return true;
}

static void on_event(uv_fs_event_t *handle, const char *name, int events, int status);

/* Watches one folder, without those in it. @return 0 or libuv's error */
static int watch_one(nook_file_watch *watch, const char *path, const char *full, const struct stat *info)
{
    size_t size = strlen(path) + 1;
    folder *made = reserve_folder(watch) ? malloc(sizeof *made + size) : NULL;
    if (!made)
        return UV_ENOMEM;
    *made = (folder){ .watch = watch, .device = info->st_dev, .inode = info->st_ino };
    memcpy(made->path, path, size);
    int code = uv_fs_event_init(&watch->loop, &made->handle);
    if (code != 0) {
        free(made);
        return code;
    }
    made->handle.data = made;
    code = uv_fs_event_start(&made->handle, on_event, full, 0);
    if (code != 0) {
        uv_close((uv_handle_t *)&made->handle, free_folder);
        return code;
    }
    watch->folders[watch->folder_count++] = made;
    return 0;
}

static nook_result watch_all_in(nook_file_watch *watch, const char *path, const struct stat *info, bool is_new);

/* Watches the folders in a folder. Its files are told when it is new: they may be older than its watch. */
static nook_result watch_contents(nook_file_watch *watch, const char *path, const char *full, bool is_new)
{
    char inner[PATH_CAPACITY], inner_full[PATH_CAPACITY];
    const struct dirent *entry;
    struct stat info;
    nook_result result = NOOK_OK;
    DIR *directory = opendir(full);
    if (!directory)
        return is_gone(-errno) ? NOOK_OK : refuse(full, -errno);
    while (result == NOOK_OK && (entry = readdir(directory)) != NULL) {
        bool hidden = entry->d_name[0] == '.';
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0 || !join(path, entry->d_name, inner) ||
            !full_path(watch, inner, inner_full) || lstat(inner_full, &info) != 0)
            continue;
        if (!S_ISDIR(info.st_mode) && is_new)
            note(watch, inner, nook_clock_ms());
        else if (S_ISDIR(info.st_mode) && !hidden && !watch->flat)
            result = watch_all_in(watch, inner, &info, is_new);
    }
    closedir(directory);
    return result;
}

/* The watch comes first: what happens in between is told twice and not never. */
static nook_result watch_all_in(nook_file_watch *watch, const char *path, const struct stat *info, bool is_new)
{
    char full[PATH_CAPACITY];
    if (!full_path(watch, path, full))
        return nook_fail(NOOK_E_IO, "%s: the path is too long to be watched", path);
    int code = watch_one(watch, path, full, info);
    if (is_gone(code))
        return NOOK_OK;
    return code == 0 ? watch_contents(watch, path, full, is_new) : refuse(full, code);
}

/* ---- changes ------------------------------------------------------------------------------------------------------- */

static const folder *find_folder(const nook_file_watch *watch, const char *path)
{
    for (size_t i = 0; i < watch->folder_count; i++)
        if (strcmp(watch->folders[i]->path, path) == 0)
            return watch->folders[i];
    return NULL;
}

static bool is_same(const folder *watched, const struct stat *info)
{
    return !watched->ended && info->st_ino == watched->inode && info->st_dev == watched->device;
}

/* Something was made, moved or deleted there: folders in it are watched anew. The frame goes on without those that cannot be. */
static void look_again(nook_file_watch *watch, const char *path)
{
    char full[PATH_CAPACITY];
    struct stat info;
    if (watch->flat || !full_path(watch, path, full))
        return;
    bool is_folder = lstat(full, &info) == 0 && S_ISDIR(info.st_mode) && nook_path_name(path)[0] != '.';
    const folder *watched = find_folder(watch, path);
    if (is_folder && watched && is_same(watched, &info))
        return;
    size_t gone = unwatch_all_in(watch, path);
    if (gone > 0 && !is_folder)
        note(watch, path, nook_clock_ms());
    if (is_folder && !watch->complained)
        watch->complained = watch_all_in(watch, path, &info, true) != NOOK_OK;
}

/* libuv gives what happens to a folder itself as if it happened to something in it of the same name, and says of whatever happens to
   a folder that it was renamed; only when it was not written or given other rights, it does not say "changed" besides. */
static bool is_about_itself(folder *self, const char *name, const char *full, int events)
{
    struct stat info;
    char own[PATH_CAPACITY];
    const char *path = self->path[0] ? self->path : self->watch->root;
    if (strcmp(name, nook_path_name(path)) != 0 || lstat(full, &info) == 0)
        return false;
    if (events & UV_CHANGE)
        return true;
    bool stands = full_path(self->watch, self->path, own) && stat(own, &info) == 0 && is_same(self, &info);
    self->ended = true;
    return !stands;
}

static void on_event(uv_fs_event_t *handle, const char *name, int events, int status)
{
    folder *self = handle->data;
    nook_file_watch *watch = self->watch;
    char path[PATH_CAPACITY], full[PATH_CAPACITY];
    struct stat info;
    if (status != 0 || !name || !join(self->path, name, path) || !full_path(watch, path, full) ||
        is_about_itself(self, name, full, events))
        return;
    bool exists = lstat(full, &info) == 0;
    if (!exists || !S_ISDIR(info.st_mode))
        note(watch, path, exists ? changed_at(&info) : nook_clock_ms());
    if (events & UV_RENAME)
        look_again(watch, path);
}

/* A folder of the description lies in none that is watched, so nobody tells that it went or came back. */
static void look_at_base(nook_file_watch *watch, const char *base)
{
    char full[PATH_CAPACITY];
    struct stat info;
    const folder *watched = find_folder(watch, base);
    bool exists = full_path(watch, base, full) && stat(full, &info) == 0 && S_ISDIR(info.st_mode);
    if (watched && (!exists || !is_same(watched, &info))) {
        unwatch_all_in(watch, base);
        if (!exists)
            note(watch, base, nook_clock_ms());
        watched = NULL;
    }
    if (!watched && exists && !watch->complained)
        watch->complained = watch_all_in(watch, base, &info, true) != NOOK_OK;
}

size_t nook_file_watch_poll(nook_file_watch *watch, nook_file_changed *changed, void *user)
{
    uv_run(&watch->loop, UV_RUN_NOWAIT);
    for (size_t i = 0; i < watch->base_count; i++)
        look_at_base(watch, watch->bases[i]);
    if (watch->changes.count == 0 || nook_file_watch_settling_ms(watch) > 0.0)
        return 0;
    watch->changed_ms = watch->changes.first_ms;
    return nook_file_changes_tell(&watch->changes, changed, user);
}

double nook_file_watch_settling_ms(const nook_file_watch *watch)
{
    return nook_file_changes_settling_ms(&watch->changes, nook_clock_ms());
}

double nook_file_watch_changed_ms(const nook_file_watch *watch)
{
    return watch->changed_ms;
}

size_t nook_file_watch_folder_count(const nook_file_watch *watch)
{
    return watch->folder_count;
}

/* ---- life ---------------------------------------------------------------------------------------------------------- */

/* One folder of the description. */
static nook_result add_base(nook_file_watch *watch, const char *path)
{
    char full[PATH_CAPACITY];
    struct stat info;
    char *base = copy_path(path);
    if (!base)
        return refuse(path, UV_ENOMEM);
    watch->bases[watch->base_count++] = base;
    if (!full_path(watch, base, full))
        return nook_fail(NOOK_E_IO, "%s: the path is too long to be watched", base);
    if (stat(full, &info) != 0)
        return refuse(full, -errno);
    if (!S_ISDIR(info.st_mode))
        return refuse(full, UV_ENOTDIR);
    return watch_all_in(watch, base, &info, false);
}

static nook_result add_bases(nook_file_watch *watch, const nook_file_watch_desc *desc)
{
    static const char *const root_itself[] = { "" };
    const char *const *folders = desc->folders ? desc->folders : root_itself;
    size_t count = desc->folders ? desc->folder_count : NOOK_COUNT(root_itself);
    nook_result result = NOOK_OK;
    watch->root = copy_path(desc->root);
    watch->bases = calloc(count + 1, sizeof(char *));
    if (!watch->root || !watch->bases)
        return refuse(desc->root, UV_ENOMEM);
    for (size_t i = 0; i < count && result == NOOK_OK; i++)
        result = add_base(watch, folders[i]);
    return result;
}

nook_result nook_file_watch_create(const nook_file_watch_desc *desc, nook_file_watch **out_watch)
{
    *out_watch = NULL;
    nook_file_watch *watch = calloc(1, sizeof *watch);
    if (!watch)
        return nook_fail(NOOK_E_MEMORY, "file watch: out of memory");
    int code = uv_loop_init(&watch->loop);
    if (code != 0) {
        free(watch);
        return refuse(desc->root, code);
    }
    watch->flat = desc->flat;
    nook_result result = add_bases(watch, desc);
    if (result != NOOK_OK) {
        nook_file_watch_destroy(watch);
        return result;
    }
    *out_watch = watch;
    return NOOK_OK;
}

void nook_file_watch_destroy(nook_file_watch *watch)
{
    if (!watch)
        return;
    while (watch->folder_count > 0)
        unwatch(watch, watch->folder_count - 1);
    uv_run(&watch->loop, UV_RUN_DEFAULT); /* until the handles are freed */
    int code = uv_loop_close(&watch->loop);
    assert(code == 0);
    (void)code;
    for (size_t i = 0; i < watch->base_count; i++)
        free(watch->bases[i]);
    free(watch->bases);
    free(watch->folders);
    free(watch->root);
    nook_file_changes_free(&watch->changes);
    free(watch);
}
