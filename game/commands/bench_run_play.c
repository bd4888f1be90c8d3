/* What a player gets: a recorded game drawn as ./nook play draws it, frame by frame, each whole: ticks, G-buffer, occlusion,
   light. A frame lasts 1/20 s in the game however long it takes, so that every run draws the same pictures. */
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "engine/core/order.h"
#include "game/commands/benches.h"
#include "game/interrupt.h"
#include "game/option_rows.h"
#include "game/play/play_window.h"
#include "game/stream_volumes.h"
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

static const double frame_seconds = 1.0 / 20.0; /* the least that the game is to reach: 20 pictures a second */

enum { WARM = 2, PARTS = 10 };

typedef struct play_options {
    const char *level, *replay, *settings, *cache;
    nook_option_size size;
    nook_backend backend;
    double from;
    int32_t frames, frame_rate;
    bool cpu;
    char default_replay[NOOK_OPTION_PATH_MAX], default_cache[NOOK_OPTION_PATH_MAX];
} play_options;

/* How long the frames took, in their order. */
typedef struct frame_times {
    double *ms;
    size_t count, most;
    size_t sized[NOOK_PICTURE_FIT_STEPS]; /* of the count, in each size of the picture */
    uint32_t changed;                     /* of size, before the first of them */
    double used;                          /* sum over them: of what volumes may take, the part that held some */
    double waiting;                       /* the same: of the bytes that were wanted, the part that was not there */
} frame_times;

static bool read_options(const nook_app *app, int argc, char **argv, play_options *out, int *out_exit_code)
{
    *out = (play_options){ .size = { 640, 360 }, .backend = NOOK_BACKEND_AUTO };
    nook_path_join(out->default_replay, sizeof out->default_replay, app->root,
                   "content/engine_house/engine_house.replay");
    out->replay = out->default_replay;
    out->cache = nook_option_default_cache(app, out->default_cache);
    const nook_option options[] = {
        nook_option_row_text("replay", &out->replay, "FILE",
                             "the game; default: the one that comes with the engine house"),
        nook_option_row_settings(&out->settings, "technique and parameters; default: the level's"),
        nook_option_row_size(&out->size, "of the pictures in pixels; default 640x360"),
        nook_option_row_from(&out->from, "let so much of the replay pass before the first picture"),
        nook_option_row_int("frames", &out->frames, 1, INT32_MAX, "timed; default: to the end of the replay"),
        nook_option_row_int("frame-rate", &out->frame_rate, 1, 1000,
                            "the picture gets smaller for so many frames a second, and is stretched to --size"),
        nook_option_row_cpu(&out->cpu),
        nook_option_row_backend(&out->backend),
        nook_option_row_cache(&out->cache, "where baked volumes are kept; default: cache/ of Nook"),
    };
    const nook_usage usage = { .command = "bench play",
                               .summary = "Times every frame of a recorded game, drawn as ./nook play draws it.",
                               .positionals = "[LEVEL]",
                               .positional_max = 1,
                               .options = options,
                               .option_count = NOOK_COUNT(options),
                               .details =
                                   "LEVEL: default, the replay's. Three ticks a frame, as at 20 frames a second. "
                                   "A frame ends\nwith glFinish; panels and the way to a window are not in it.\n" };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    out->level = arguments.positionals[0];
    return true;
}

/* Room for all that the replay has: each frame takes a tick of it at least. */
static nook_result make_room(const nook_recording *replay, const play_options *options, frame_times *out)
{
    *out = (frame_times){ .most = replay->tick_count };
    if (options->frames > 0 && (size_t)options->frames < out->most)
        out->most = (size_t)options->frames;
    out->ms = malloc((out->most + 1) * sizeof *out->ms);
    return out->ms ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "bench play: no memory for the times of %zu frames", out->most);
}

static void count_stream(const nook_stream *stream, frame_times *times)
{
    nook_stream_status status;
    nook_stream_get_status(stream, &status);
    if (status.memory > 0)
        times->used += (double)status.resident_bytes / (double)status.memory;
    if (status.wanted_bytes > 0)
        times->waiting += (double)status.waiting_bytes / (double)status.wanted_bytes;
}

static nook_result time_frames(nook_play_window *window, const play_options *options, frame_times *out)
{
    double (*clock)(void) = options->cpu ? nook_clock_cpu_ms : nook_clock_ms;
    nook_result result = NOOK_OK;
    bool goes_on = true;
    for (int64_t i = -WARM; result == NOOK_OK && goes_on && out->count < out->most && !nook_interrupt_asked(); i++) {
        double start = clock();
        result = nook_play_window_frame(window, &goes_on);
        nook_gpu_finish(window->stage.gpu);
        if (i < 0)
            out->changed = window->picture_fit.changes;
        if (result != NOOK_OK || i < 0)
            continue;
        out->ms[out->count++] = clock() - start;
        out->sized[window->picture_fit.step]++;
        if (window->stage.stream)
            count_stream(window->stage.stream, out);
    }
    return result;
}

/* Orders them. Of processor time it says nothing how many came in time. */
static void print_row(const char *name, double *ms, size_t count, bool cpu)
{
    size_t in_time = 0;
    double sum = 0.0;
    nook_order_numbers(ms, count);
    for (size_t i = 0; i < count; i++) {
        sum += ms[i];
        in_time += ms[i] <= 1000.0 * frame_seconds;
    }
    printf("  %-14s %8zu %9.2f %9.2f %9.2f %9.2f %9.2f", name, count, sum / (double)count,
           nook_quantile(ms, count, 0.5), nook_quantile(ms, count, 0.95), nook_quantile(ms, count, 0.99),
           ms[count - 1]);
    if (!cpu)
        printf(" %9.1f %%", 100.0 * (double)in_time / (double)count);
    printf("\n");
}

/* Parts of the game in their order, then all of it. */
static void print_times(frame_times *times, double from, bool cpu)
{
    printf("  %-14s %8s %9s %9s %9s %9s %9s %s\n", "seconds", "frames", "mean", "median", "95 %", "99 %", "highest",
           cpu ? "" : "  in 50 ms");
    size_t parts = times->count < 10 * PARTS ? 1 : PARTS;
    for (size_t i = 0; parts > 1 && i < parts; i++) {
        size_t begin = times->count * i / parts, end = times->count * (i + 1) / parts;
        char name[64];
        snprintf(name, sizeof name, "%.1f to %.1f", from + frame_seconds * (double)begin,
                 from + frame_seconds * (double)end);
        print_row(name, times->ms + begin, end - begin, cpu);
    }
    print_row("all", times->ms, times->count, cpu);
}

static void print_sizes(const nook_play_window *window, const frame_times *times)
{
    const nook_picture_fit *fit = &window->picture_fit;
    printf("\nsize of the picture for %.0f frames a second, along each side:", window->frame_rate);
    for (uint32_t i = 0; i < NOOK_PICTURE_FIT_STEPS; i++)
        printf(" %.1f %.1f %%%s", nook_picture_fit_scale(&(nook_picture_fit){ .step = i }),
               100.0 * (double)times->sized[i] / (double)times->count, i + 1 < NOOK_PICTURE_FIT_STEPS ? "," : "");
    printf("; %u changes\n", fit->changes - times->changed);
}

static void print_stream(const nook_stream *stream, const frame_times *times)
{
    char line[160];
    nook_stream_status status;
    nook_stream_get_status(stream, &status);
    printf("\n%s\n%" PRIu64 " came, %" PRIu64 " went, at most %.3f MiB uploaded in a frame\n",
           nook_stream_print(stream, line, sizeof line), status.loads, status.evictions,
           (double)status.largest_upload / NOOK_MIB);
    printf("in the mean of the frames %.1f %% of the room held volumes, %.1f %% of the bytes wanted were not there\n",
           100.0 * times->used / (double)times->count, 100.0 * times->waiting / (double)times->count);
}

static nook_result run(nook_play_window *window, const play_options *options)
{
    char setting[NOOK_SETTING_TEXT_MAX];
    frame_times times;
    nook_result result = make_room(&window->play.replay, options, &times);
    if (result != NOOK_OK)
        return result;
    printf("%s, %u x %u, %s, r_max %.3g m, %s\nmilliseconds of %s a frame\n\n", options->replay, window->stage.width,
           window->stage.height, window->stage.gpu->renderer, window->stage.volumes.r_max,
           nook_setting_print(&window->settings.setting, setting), options->cpu ? "all threads together" : "wall time");
    fflush(stdout);
    nook_interrupt_hold();
    result = time_frames(window, options, &times);
    nook_interrupt_release();
    if (result == NOOK_OK && times.count == 0)
        result = nook_fail(NOOK_E_ARG, "bench play: %s is over before the first frame that would be timed; --from less",
                           options->replay);
    if (result == NOOK_OK)
        print_times(&times, options->from, options->cpu);
    if (result == NOOK_OK && options->frame_rate > 0)
        print_sizes(window, &times);
    if (result == NOOK_OK && window->stage.stream)
        print_stream(window->stage.stream, &times);
    free(times.ms);
    return result;
}

int nook_bench_run_play(const nook_app *app, int argc, char **argv)
{
    play_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    nook_play_window *window = calloc(1, sizeof *window);
    if (!window) {
        (void)nook_fail(NOOK_E_MEMORY, "bench: no memory for %zu bytes", sizeof *window);
        return NOOK_EXIT_FAILED;
    }
    const nook_play_window_desc desc = {
        .play = { .root = app->root, .level = options.level, .replay = options.replay },
        .backend = options.backend,
        .no_window = true,
        .width = (uint32_t)options.size.width,
        .height = (uint32_t)options.size.height,
        .settings = options.settings,
        .cache = options.cache,
        .pictures = ".",
        .from_seconds = options.from,
        .frame_seconds = frame_seconds,
        .frame_rate = options.frame_rate
    };
    nook_result result = nook_play_window_open(app->root, &desc, window);
    if (result == NOOK_OK) {
        result = run(window, &options);
        nook_result closed = nook_play_window_close(window);
        result = result == NOOK_OK ? closed : result;
    }
    free(window);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
