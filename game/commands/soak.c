#include "engine/core/mebibyte.h"
#include "game/commands/commands.h"
#include "game/option_rows.h"
#include "game/play/soak_run.h"
#include <stdio.h>

typedef struct soak_request {
    nook_soak_desc desc;
    int32_t frames, seed;
    nook_option_size size;
    char default_cache[NOOK_OPTION_PATH_MAX];
} soak_request;

static bool read_request(const nook_app *app, int argc, char **argv, soak_request *out, int *out_exit_code)
{
    *out = (soak_request){ .frames = 100000, .seed = 1, .size = { 64, 36 } };
    nook_play_window_desc *window = &out->desc.window;
    window->play.root = app->root;
    window->backend = NOOK_BACKEND_OSMESA;
    window->cache = nook_option_default_cache(app, out->default_cache);
    const nook_option options[] = {
        nook_option_row_int("frames", &out->frames, NOOK_SOAK_FRAMES_MIN, 100000000, "default 100000"),
        nook_option_row_int("seed", &out->seed, 0, INT32_MAX, "of what is thrown, and of the physics; default 1"),
        nook_option_row_size(&out->size, "of the pictures in pixels; default 64x36"),
        nook_option_row_settings(&window->settings, "technique and parameters; default: the level's"),
        nook_option_row_backend(&window->backend),
        nook_option_row_cache(&window->cache, "where baked volumes are kept; default: cache/ of Nook"),
    };
    const nook_usage usage = {
        .command = "soak",
        .summary = "Plays a level for very long, with bodies thrown about, shaders and code reloaded, sizes changed "
                   "and tries\n"
                   "begun anew, and looks whether anything wears out.",
        .positionals = "[LEVEL]",
        .positional_max = 1,
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "Holds when no visibility was NaN or outside of [0, 1], no body went through what stands still and out of\n"
            "the world, no file stayed open, and memory did not grow: the least of the last tenth of the frames is at\n"
            "most 1 MiB more than that of the second, of what was allocated and not freed, and 2 % and 4 MiB more, of\n"
            "what the process occupies. Bodies that fall over an edge of an open level are counted, and are no fault.\n"
    };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    window->play.level = arguments.positionals[0];
    window->play.seed = (uint32_t)out->seed;
    window->play.seed_given = true;
    window->width = (uint32_t)out->size.width;
    window->height = (uint32_t)out->size.height;
    out->desc.frames = (uint32_t)out->frames;
    out->desc.seed = (uint32_t)out->seed;
    return true;
}

static void print_bodies(const nook_soak_bodies *bodies)
{
    printf("bodies     %u went through what stands still and out of the world, %u fell over an edge", bodies->through,
           bodies->over_an_edge);
    if (*bodies->last)
        printf("; the last: %s at %.1f %.1f %.1f", bodies->last, bodies->last_at[0], bodies->last_at[1],
               bodies->last_at[2]);
    printf("\n");
}

static double mebibytes(uint64_t bytes)
{
    return (double)bytes / NOOK_MIB;
}

static void print_memory(const char *name, const nook_soak_memory *memory, uint64_t allowed)
{
    printf("%-10s grew by %.2f MiB, %.2f are allowed; at most %.1f; least of each tenth", name,
           mebibytes(nook_soak_memory_growth(memory)), mebibytes(allowed), mebibytes(memory->most));
    for (int i = 0; i < NOOK_SOAK_PARTS && memory->least[i] > 0; i++)
        printf(" %.2f", mebibytes(memory->least[i]));
    printf("\n");
}

static void print_report(const nook_soak_report *r)
{
    printf("frames     %u in %.0f s, %u throws, %u shader reloads, %u exchanges of code, %u resizes, %u restarts\n",
           r->frames, r->seconds, r->throws, r->reloads, r->exchanges, r->resizes, r->restarts);
    printf("pixels     %llu looked at, %llu not in [0, 1]\n", (unsigned long long)r->pixels,
           (unsigned long long)r->wrong);
    print_bodies(&r->bodies);
    if (r->heap.most > 0)
        print_memory("allocated", &r->heap, NOOK_SOAK_HEAP_ALLOWED);
    print_memory("occupied", &r->resident, nook_soak_resident_allowed(&r->resident));
    printf("files      %u open after a tenth, %u at the end\n", r->files[0], r->files[1]);
}

int nook_command_soak(const nook_app *app, int argc, char **argv)
{
    soak_request request;
    nook_soak_report report;
    int exit_code;
    if (!read_request(app, argc, argv, &request, &exit_code))
        return exit_code;
    if (nook_soak_run(app->root, &request.desc, &report) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    bool whole = report.frames == request.desc.frames, holds = nook_soak_holds(&report);
    print_report(&report);
    printf("%s after %u frames\n", !whole ? "stopped" : holds ? "holds" : "does not hold", report.frames);
    return whole && holds ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
