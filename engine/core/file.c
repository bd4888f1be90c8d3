#include "engine/core/file.h"
#include "engine/core/log.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_CAPACITY = 4096 };
static const size_t file_size_max = (size_t)4 << 30;

static nook_result check_readable(const char *path, const struct stat *info, char *out_why, size_t capacity)
{
    if (S_ISDIR(info->st_mode))
        return nook_refuse(out_why, capacity, NOOK_E_IO, "%s: is a directory; name a file", path);
    if (!S_ISREG(info->st_mode))
        return nook_refuse(out_why, capacity, NOOK_E_IO,
                           "%s: not a regular file; name one that holds the bytes themselves", path);
    if ((size_t)info->st_size > file_size_max)
        return nook_refuse(out_why, capacity, NOOK_E_MEMORY, "%s: %lld bytes; files over 4 GiB are not read", path,
                           (long long)info->st_size);
    return NOOK_OK;
}

static nook_result read_open_file(const char *path, int descriptor, nook_file *out_file, char *out_why, size_t capacity)
{
    struct stat info;
    if (fstat(descriptor, &info) != 0)
        return nook_refuse(out_why, capacity, NOOK_E_IO, "%s: %s", path, strerror(errno));
    nook_result result = check_readable(path, &info, out_why, capacity);
    if (result != NOOK_OK)
        return result;
    size_t size = (size_t)info.st_size;
    uint8_t *bytes = malloc(size + 1);
    if (!bytes)
        return nook_refuse(out_why, capacity, NOOK_E_MEMORY, "%s: no memory for %zu bytes", path, size);
    size_t done = 0;
    while (done < size) {
        ssize_t got = read(descriptor, bytes + done, size - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0) {
            const char *reason = got < 0 ? strerror(errno) : "became shorter while it was read";
            free(bytes);
            return nook_refuse(out_why, capacity, NOOK_E_IO, "%s: %s", path, reason);
        }
        done += (size_t)got;
    }
    bytes[size] = 0;
    *out_file = (nook_file){ bytes, size };
    return NOOK_OK;
}

nook_result nook_file_try_read(const char *path, nook_file *out_file, char *out_why, size_t capacity)
{
    /* O_NONBLOCK: opening a pipe that nobody writes to must not hang. */
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR))
        return nook_refuse(out_why, capacity, NOOK_E_NOT_FOUND, "%s: no such file; check the path", path);
    if (descriptor < 0)
        return nook_refuse(out_why, capacity, NOOK_E_IO, "%s: %s", path, strerror(errno));
    nook_result result = read_open_file(path, descriptor, out_file, out_why, capacity);
    close(descriptor);
    return result;
}

nook_result nook_file_read(const char *path, nook_file *out_file)
{
    char text[PATH_CAPACITY + 128];
    nook_result result = nook_file_try_read(path, out_file, text, sizeof text);
    return result == NOOK_OK ? NOOK_OK : nook_fail(result, "%s", text);
}

void nook_file_free(nook_file *file)
{
    if (!file)
        return;
    free(file->bytes);
    *file = (nook_file){ 0 };
}

static bool write_all(int descriptor, const uint8_t *bytes, size_t size)
{
    while (size > 0) {
        ssize_t put = write(descriptor, bytes, size);
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0) {
            errno = put < 0 ? errno : ENOSPC;
            return false;
        }
        bytes += put;
        size -= (size_t)put;
    }
    return true;
}

/* A symbolic link stays one: what it leads to is written. @return false: the name is too long */
static bool follow_links(const char *path, char out[PATH_CAPACITY])
{
    char *followed = realpath(path, NULL);
    int length = snprintf(out, PATH_CAPACITY, "%s", followed ? followed : path);
    free(followed);
    return length >= 0 && length < PATH_CAPACITY;
}

/* What is renamed over a device or a pipe takes its place, for everyone. @return 0, or the errno that says why not */
static int check_replaceable(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0 || S_ISREG(info.st_mode))
        return 0;
    return S_ISDIR(info.st_mode) ? EISDIR : ENOTSUP;
}

/* What is written beside a file, to take its place. */
typedef struct replacement {
    char target[PATH_CAPACITY], temporary[PATH_CAPACITY];
    int descriptor;
} replacement;

/* @return 0, or the errno that says why not */
static int begin_replacement(const char *path, replacement *out)
{
    int refused = check_replaceable(path);
    if (refused != 0)
        return refused;
    if (!follow_links(path, out->target))
        return ENAMETOOLONG;
    int length = snprintf(out->temporary, sizeof out->temporary, "%s.%ld.tmp", out->target, (long)getpid());
    if (length < 0 || (size_t)length >= sizeof out->temporary)
        return ENAMETOOLONG;
    out->descriptor = open(out->temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    return out->descriptor < 0 ? errno : 0;
}

/* Once it is closed. @param reason  0: it is whole @return 0, or the errno that says why there is none */
static int end_replacement(const replacement *r, int reason)
{
    if (reason == 0 && rename(r->temporary, r->target) != 0)
        reason = errno;
    if (reason != 0)
        unlink(r->temporary);
    return reason;
}

int nook_file_try_write(const char *path, const void *bytes, size_t size)
{
    replacement r;
    int reason = begin_replacement(path, &r);
    if (reason != 0)
        return reason;
    if (!write_all(r.descriptor, bytes, size))
        reason = errno;
    if (close(r.descriptor) != 0 && reason == 0)
        reason = errno;
    return end_replacement(&r, reason);
}

static nook_result tell_written(const char *path, int reason)
{
    return reason == 0 ? NOOK_OK : nook_fail(NOOK_E_IO, "%s: cannot write: %s", path, strerror(reason));
}

nook_result nook_file_write(const char *path, const void *bytes, size_t size)
{
    return tell_written(path, nook_file_try_write(path, bytes, size));
}

/* @return 0, or the errno that says why not all of it is there */
static int close_text(FILE *stream)
{
    errno = 0;
    bool whole = fflush(stream) == 0 && !ferror(stream);
    int reason = whole ? 0 : errno ? errno : EIO;
    if (fclose(stream) != 0 && whole)
        reason = errno;
    return reason;
}

nook_result nook_file_write_text(const char *path, nook_file_print print, const void *user)
{
    replacement r;
    int reason = begin_replacement(path, &r);
    if (reason != 0)
        return tell_written(path, reason);
    FILE *stream = fdopen(r.descriptor, "w");
    if (!stream) {
        reason = errno;
        close(r.descriptor);
        return tell_written(path, end_replacement(&r, reason));
    }
    nook_result result = print(user, stream);
    reason = close_text(stream);
    if (result == NOOK_OK)
        return tell_written(path, end_replacement(&r, reason));
    end_replacement(&r, ECANCELED);
    return result;
}

nook_result nook_file_copy(const char *from, const char *to)
{
    nook_file file = { 0 };
    nook_result result = nook_file_read(from, &file);
    if (result != NOOK_OK)
        return result;
    result = nook_file_write(to, file.bytes, file.size);
    nook_file_free(&file);
    return result;
}

nook_result nook_file_probe(const char *path)
{
    char probe[PATH_CAPACITY];
    if (nook_directory_exists(path))
        return nook_fail(NOOK_E_IO, "%s: a directory; give the name of a file", path);
    if (check_replaceable(path) != 0)
        return nook_fail(NOOK_E_IO, "%s: not a regular file; give the name of one", path);
    int length = snprintf(probe, sizeof probe, "%s.probe", path);
    bool fits = length >= 0 && (size_t)length < sizeof probe;
    int reason = fits ? nook_file_try_write(probe, "", 0) : ENAMETOOLONG;
    if (reason != 0)
        return nook_fail(NOOK_E_IO, "%s: cannot write: %s", path, strerror(reason));
    unlink(probe);
    return NOOK_OK;
}

bool nook_file_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

bool nook_directory_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

int nook_directory_try_make(const char *path)
{
    char partial[PATH_CAPACITY];
    size_t length = strlen(path);
    if (length == 0)
        return ENOENT;
    if (length >= sizeof partial)
        return ENAMETOOLONG;
    for (size_t i = 1; i <= length; i++) {
        if (path[i] != '/' && path[i] != '\0')
            continue;
        memcpy(partial, path, i);
        partial[i] = '\0';
        if (mkdir(partial, 0755) != 0 && errno != EEXIST)
            return errno;
    }
    return nook_directory_exists(path) ? 0 : ENOTDIR;
}

nook_result nook_directory_make(const char *path)
{
    int reason = nook_directory_try_make(path);
    if (reason == 0)
        return NOOK_OK;
    return nook_fail(NOOK_E_IO, "'%s': cannot make the directory: %s", path, strerror(reason));
}

char *nook_path_join(char *out, size_t capacity, const char *folder, const char *name)
{
    size_t length = strlen(folder);
    const char *separator = length == 0 || folder[length - 1] == '/' ? "" : "/";
    snprintf(out, capacity, "%s%s%s", folder, separator, name);
    return out;
}

const char *nook_path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const char *nook_path_extension(const char *path)
{
    const char *name = nook_path_name(path);
    const char *dot = strrchr(name, '.');
    return dot && dot != name ? dot : name + strlen(name);
}
