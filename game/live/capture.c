#include "game/live/capture.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "modules/measure/picture.h"
#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

static const double usual_rate = 30.0;

extern char **environ;

struct nook_capture {
    char path[1024];
    uint32_t width, height;
    uint64_t count; /**< Pictures so far. */
    bool failed;
    int pipe; /**< To ffmpeg; -1: pictures go into a folder. A socket, so that its end raises no signal. */
    pid_t encoder;
};

bool nook_capture_is_video(const char *path)
{
    static const char *const endings[] = { ".mp4", ".mkv", ".webm", ".gif" };
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        if (strcasecmp(nook_path_extension(path), endings[i]) == 0)
            return true;
    }
    return false;
}

/* ---- Video -------------------------------------------------------------------------------------------------------- */

static nook_result refuse_without_encoder(const char *path)
{
    return nook_fail(NOOK_E_NOT_FOUND,
                     "%s: videos are made by ffmpeg, which is not installed; install the package ffmpeg, or give a "
                     "folder for PNG files",
                     path);
}

/* As the shell would find it. */
static bool has_encoder(void)
{
    const char *folders = getenv("PATH");
    for (const char *at = folders ? folders : ""; *at; at += strspn(at, ":")) {
        char program[1024];
        size_t length = strcspn(at, ":");
        snprintf(program, sizeof program, "%.*s/ffmpeg", (int)length, at);
        if (access(program, X_OK) == 0)
            return true;
        at += length;
    }
    return false;
}

/* In a process group of its own, so that Ctrl-C at a terminal is ours alone: the film ends when we close it, and is whole. */
static int spawn(nook_capture *capture, char *const *arguments, int input)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    int error = posix_spawnp(&capture->encoder, arguments[0], &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/* Sides of most video formats are even. A name may begin with a dash or hold a colon: "file:" says that it is one. */
static nook_result spawn_encoder(nook_capture *capture, double rate, int input)
{
    char size[32], frames[32], file[sizeof capture->path + 8];
    snprintf(file, sizeof file, "file:%s", capture->path);
    snprintf(size, sizeof size, "%ux%u", capture->width, capture->height);
    snprintf(frames, sizeof frames, "%g", rate);
    char *const arguments[] = {
        "ffmpeg",   "-loglevel", "error",    "-xerror", /* or it ends with 0 on a full disk */
        "-y",       "-f",        "rawvideo", "-pix_fmt", "rgb24", "-s",  size,
        "-r",       frames,      "-i",       "-",        "-an",   "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
        "-pix_fmt", "yuv420p",   file,       NULL
    };
    int error = spawn(capture, arguments, input);
    if (error == 0)
        return NOOK_OK;
    if (error == ENOENT)
        return refuse_without_encoder(capture->path);
    return nook_fail(NOOK_E_DEVICE, "%s: ffmpeg cannot be started (%s)", capture->path, strerror(error));
}

static nook_result open_video(nook_capture *capture, double rate)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return nook_fail(NOOK_E_DEVICE, "%s: no way to ffmpeg (%s)", capture->path, strerror(errno));
    nook_result result = spawn_encoder(capture, rate, ends[1]);
    close(ends[1]);
    if (result != NOOK_OK)
        close(ends[0]);
    else
        capture->pipe = ends[0];
    return result;
}

static bool send_all(int pipe, const uint8_t *bytes, size_t size)
{
    while (size > 0) {
        ssize_t sent = send(pipe, bytes, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return false;
        bytes += sent;
        size -= (size_t)sent;
    }
    return true;
}

static bool encoder_succeeded(pid_t encoder)
{
    int status = 0;
    while (waitpid(encoder, &status, 0) < 0) {
        if (errno != EINTR)
            return false;
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* ---- Folder ------------------------------------------------------------------------------------------------------- */

static nook_result open_folder(const char *path)
{
    nook_result result = nook_directory_make(path);
    if (result == NOOK_OK && access(path, W_OK) != 0)
        result = nook_fail(NOOK_E_IO, "%s: pictures cannot be written there (%s)", path, strerror(errno));
    return result;
}

static nook_result write_frame(nook_capture *capture, const uint8_t *rgb)
{
    char name[32], path[sizeof capture->path + sizeof name];
    const nook_picture picture = { (nook_rgb *)rgb, capture->width, capture->height }; /* only read */
    snprintf(name, sizeof name, "frame_%06llu.png", (unsigned long long)capture->count + 1);
    nook_path_join(path, sizeof path, capture->path, name);
    return nook_picture_write_png(&picture, path);
}

nook_result nook_capture_check(const char *path)
{
    if (!nook_capture_is_video(path))
        return open_folder(path);
    return has_encoder() ? nook_file_probe(path) : refuse_without_encoder(path);
}

/* ---- Both --------------------------------------------------------------------------------------------------------- */

nook_result nook_capture_open(const nook_capture_desc *desc, nook_capture **out_capture)
{
    *out_capture = NULL;
    nook_capture *capture = calloc(1, sizeof *capture);
    if (!capture)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory", desc->path);
    snprintf(capture->path, sizeof capture->path, "%s", desc->path);
    capture->width = desc->width, capture->height = desc->height;
    capture->pipe = -1;
    nook_result result = nook_capture_is_video(desc->path)
                             ? open_video(capture, desc->rate > 0.0 ? desc->rate : usual_rate)
                             : open_folder(capture->path);
    if (result != NOOK_OK) {
        free(capture);
        return result;
    }
    *out_capture = capture;
    return NOOK_OK;
}

nook_result nook_capture_add(nook_capture *capture, const uint8_t *rgb)
{
    nook_result result = NOOK_OK;
    if (capture->failed)
        return NOOK_E_IO;
    if (capture->pipe < 0)
        result = write_frame(capture, rgb);
    else if (!send_all(capture->pipe, rgb, (size_t)capture->width * capture->height * 3))
        result = nook_fail(NOOK_E_IO, "%s: ffmpeg has ended after %llu pictures; its own message says why",
                           capture->path, (unsigned long long)capture->count);
    capture->failed = result != NOOK_OK;
    capture->count += result == NOOK_OK;
    return result;
}

nook_result nook_capture_close(nook_capture *capture)
{
    if (!capture)
        return NOOK_OK;
    nook_result result = capture->failed ? NOOK_E_IO : NOOK_OK;
    if (capture->pipe >= 0) {
        close(capture->pipe);
        if (!encoder_succeeded(capture->encoder) && result == NOOK_OK)
            result = nook_fail(NOOK_E_IO, "%s: ffmpeg has failed; its own message says why", capture->path);
    }
    free(capture);
    return result;
}
