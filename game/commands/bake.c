#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/commands/commands.h"
#include "game/moment.h"
#include "game/option_rows.h"
#include "game/settings/settings_file.h"
#include "game/volume_levels.h"
#include <stdio.h>
#include <string.h>

/* The texts of --help that hold numbers. */
typedef struct bake_help {
    char resolution[256], expects[160], r_max[128], details[1280];
} bake_help;

static void describe(bake_help *out)
{
    snprintf(out->resolution, sizeof out->resolution,
             "voxels along the longest side of what stands still, and the limit for all; several are levels of\n"
             "                             the largest, halved up to %d times: 512,256,128,64; default %u",
             NOOK_VOXELIZE_LEVELS - 1, NOOK_VOLUMES_RESOLUTION_DEFAULT);
    snprintf(out->expects, sizeof out->expects,
             "a whole number in [1, %u], or several of which each is the largest halved up to %d times, as 512,256,64",
             NOOK_VOXELIZE_RESOLUTION_MAX, NOOK_VOXELIZE_LEVELS - 1);
    snprintf(out->r_max, sizeof out->r_max, "metres that ambient occlusion reaches; default %g of the scene's diagonal",
             NOOK_VOLUMES_R_MAX_DEFAULT);
    snprintf(
        out->details, sizeof out->details,
        "The resolution of a body follows from r_max: its voxels are r_max / %d, but it has at least %u along its\n"
        "longest side and at most half of --resolution. All that stands still shares one volume of --resolution.\n"
        "Several resolutions are as many levels of each volume: a body's are halved as often, but those under %u are\n"
        "left out. Surfels of all levels are made in one pass (docs/surfel_bricks.md), other kinds one by one.\n"
        "Compare, play and the others bake the kinds that they march by themselves, when they do.\n"
        "Instances share a bake. Blended (glass-like) materials are in densities and surfels only. Files are named\n"
        "by content: a second bake finds them; when they cannot be written, bake fails. Format: "
        "docs/volume_format.md.\n",
        NOOK_VOLUMES_VOXELS_PER_R_MAX, NOOK_VOLUMES_BODY_RESOLUTION_MIN, NOOK_VOLUMES_BODY_RESOLUTION_MIN);
}

static void tell_progress(void *user, const nook_scene_volume *done, uint32_t index, uint32_t count)
{
    (void)user;
    double ms = 0.0;
    bool cached = true;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        ms += done->bakes[kind].ms;
        cached = cached && (!done->bakes[kind].bytes || done->bakes[kind].cache_hit);
    }
    nook_log_info("[%u/%u] %s: %u voxels a side, %.1f ms%s", index + 1, count, done->name, done->resolution, ms,
                  cached ? ", from the cache" : "");
}

static void print_row(const nook_scene_volume *v, const nook_bake *bake)
{
    const nook_volume_info *info = &bake->info;
    size_t triangles = nook_scene_volume_indices_of(v, info->kind);
    char size[40], time[32];
    snprintf(size, sizeof size, "%ux%ux%u", info->width, info->height, info->depth);
    snprintf(time, sizeof time, "%.1f", bake->ms);
    printf("%-28.28s %-8s %9zu %6u %13s %10.3g %10llu %10zu %9s\n", v->name, nook_volume_kind_name(info->kind),
           triangles / 3, v->instances, size, info->voxel_size, (unsigned long long)info->occupied, bake->size,
           bake->cache_hit ? "cached" : time);
}

static void print_header(void)
{
    printf("%-28s %-8s %9s %6s %13s %10s %10s %10s %9s\n", "volume", "kind", "triangles", "uses", "voxels", "voxel m",
           "occupied", "bytes", "ms");
}

/* What the rows say together. */
typedef struct bake_sum {
    uint32_t volumes; /* with at least one row */
    size_t bytes;
    double ms;
} bake_sum;

/* @param count  of bakes; those without bytes are left out */
static void print_rows(const nook_scene_volume *v, const nook_bake *bakes, int count, bake_sum *sum)
{
    for (int i = 0; i < count; i++) {
        if (bakes[i].bytes)
            print_row(v, &bakes[i]);
        sum->bytes += bakes[i].size;
        sum->ms += bakes[i].ms;
    }
}

static void print_sum(const nook_scene_volumes *volumes, const bake_sum *sum)
{
    uint32_t occluders = 0; /* densities have a line of their own */
    for (uint32_t i = 0; i < volumes->occluder_count; i++)
        occluders += !volumes->volumes[volumes->occluders[i].volume].medium;
    printf("%u volumes, %u occluders, %zu bytes, %.1f ms, r_max %.4g m\n", sum->volumes, occluders, sum->bytes, sum->ms,
           volumes->r_max);
}

/* One level of each volume. */
static nook_result bake_one_level(const nook_scene *scene, const nook_volumes_desc *desc, bake_sum *sum)
{
    nook_scene_volumes volumes;
    nook_result result = nook_volumes_bake(scene, desc, &volumes);
    if (result != NOOK_OK)
        return result;
    print_header();
    for (uint32_t i = 0; i < volumes.volume_count; i++) {
        sum->volumes += nook_scene_volume_bake(&volumes.volumes[i]) != NULL;
        print_rows(&volumes.volumes[i], volumes.volumes[i].bakes, NOOK_VOLUME_KINDS, sum);
    }
    print_sum(&volumes, sum);
    nook_volumes_free(&volumes);
    return NOOK_OK;
}

/* Bakes all levels of a volume and prints them. */
static nook_result bake_levels_of(const nook_volumes_desc *desc, uint32_t levels, const nook_scene_volume *volume,
                                  uint32_t kinds, bake_sum *sum)
{
    bool any = false;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        nook_bake bakes[NOOK_VOXELIZE_LEVELS];
        if (!(kinds & NOOK_VOLUME_BIT(kind)))
            continue;
        nook_result result = nook_scene_volume_bake_levels(volume, (nook_volume_kind)kind, desc, levels, bakes);
        if (result != NOOK_OK)
            return result;
        print_rows(volume, bakes, NOOK_VOXELIZE_LEVELS, sum);
        for (int level = 0; level < NOOK_VOXELIZE_LEVELS; level++) {
            any = any || bakes[level].bytes;
            nook_bake_free(&bakes[level]);
        }
    }
    sum->volumes += any;
    return NOOK_OK;
}

static nook_result bake_several_levels(const nook_scene *scene, const nook_volumes_desc *desc, uint32_t levels,
                                       bake_sum *sum)
{
    nook_scene_volumes volumes;
    if (nook_directory_make(desc->cache_dir) != NOOK_OK)
        return NOOK_E_IO; /* before the work */
    nook_result result = nook_volumes_collect(scene, desc, &volumes);
    if (result != NOOK_OK)
        return result;
    print_header();
    for (uint32_t i = 0; i < volumes.volume_count && result == NOOK_OK; i++)
        result = bake_levels_of(desc, levels, &volumes.volumes[i], volumes.kinds, sum);
    if (result == NOOK_OK)
        print_sum(&volumes, sum);
    nook_volumes_free(&volumes);
    return result;
}

/* @param levels  bits 1 << level; 1: the volumes themselves */
static int bake_file(const char *path, const nook_volumes_desc *desc, uint32_t levels)
{
    nook_scene *scene;
    bake_sum sum = { .volumes = 0 };
    const nook_scene_options options = { .skip_images = desc->kinds == NOOK_VOLUME_BIT(NOOK_VOLUME_DISTANCE) };
    if (nook_scene_load(path, &options, &scene) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    nook_result result = nook_moment_stand_still(scene, &(nook_moment){ .clip = NULL });
    if (result == NOOK_OK)
        result = levels == 1 ? bake_one_level(scene, desc, &sum) : bake_several_levels(scene, desc, levels, &sum);
    uint32_t densities = scene->density_count;
    bool drawn = scene->triangle_count > 0; /* else the loader has said so */
    nook_scene_destroy(scene);
    if (result != NOOK_OK)
        return NOOK_EXIT_FAILED;
    if (densities > 0)
        printf("densities: %u, baked when the scene is opened, and not kept\n", densities);
    if (drawn && sum.volumes == 0)
        nook_log_warning("%s: all that it draws is blended or without area: there is nothing to bake", path);
    return NOOK_EXIT_OK;
}

/* The command line. */
typedef struct bake_request {
    const char *scene, *cache, *settings;
    int32_t threads;
    uint32_t kinds;
    nook_resolutions levels; /* resolution 0: not given */
    double r_max;
    char default_cache[NOOK_OPTION_PATH_MAX];
} bake_request;

static bool read_levels(void *target, const char *text)
{
    return nook_resolutions_read(text, target);
}

/* "binary,surfel". */
static bool read_kinds(void *target, const char *text)
{
    uint32_t kinds = 0;
    while (*text) {
        size_t length = strcspn(text, ",");
        uint32_t found = 0;
        for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
            const char *name = nook_volume_kind_name((nook_volume_kind)kind);
            if (name && strlen(name) == length && strncmp(name, text, length) == 0)
                found = NOOK_VOLUME_BIT(kind);
        }
        if (!found)
            return false;
        kinds |= found;
        text += length + (text[length] == ',');
    }
    *(uint32_t *)target = kinds;
    return kinds != 0;
}

static bool read_request(const nook_app *app, int argc, char **argv, bake_request *out, int *out_exit_code)
{
    *out = (bake_request){ .scene = NULL };
    out->cache = nook_option_default_cache(app, out->default_cache);
    bake_help help = { .details = "" };
    describe(&help);
    const nook_option options[] = {
        nook_option_row_settings(
            &out->settings,
            "resolution and r_max of a settings file; options given here count more. compare and measure take\n"
            "                             the rest of it; verify, extremes and tune take none"),
        { .name = "resolution",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &out->levels,
          .placeholder = "N[,N...]",
          .help = help.resolution,
          .read = read_levels,
          .expects = help.expects },
        nook_option_row_r_max(&out->r_max, help.r_max),
        nook_option_row_cache(&out->cache, "where volumes are kept; default cache/ beside the sources"),
        { .name = "kinds",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &out->kinds,
          .placeholder = "A,B",
          .help = "of volumes, as of volume.kind; default binary",
          .read = read_kinds,
          .expects = "kinds of volumes: binary, density, surfel, distance" },
        nook_option_row_int("threads", &out->threads, 0, 1024, "default 0: one per processor"),
    };
    const nook_usage usage = { .command = "bake",
                               .summary = "Makes the volumes that ambient occlusion comes from, one per rigid body.",
                               .positionals = "SCENE",
                               .positional_min = 1,
                               .positional_max = 1,
                               .options = options,
                               .option_count = NOOK_COUNT(options),
                               .details = help.details };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    out->scene = arguments.positionals[0];
    return true;
}

/* Takes from the settings file what the command line leaves open. */
static nook_result settle(bake_request *request)
{
    nook_settings_file file;
    nook_result result = request->settings ? nook_settings_file_read(request->settings, &file) : NOOK_OK;
    if (result != NOOK_OK || !request->settings)
        return result;
    if (file.plan.mode != NOOK_PLAN_OFF || file.live)
        nook_log_warning("bake: %s: its plan and live volumes are left out; all volumes of the scene are baked",
                         request->settings);
    if (request->levels.resolution == 0)
        request->levels.resolution = file.setting.resolution;
    if (request->r_max == 0.0)
        request->r_max = file.r_max;
    return NOOK_OK;
}

int nook_command_bake(const nook_app *app, int argc, char **argv)
{
    bake_request request;
    int exit_code;
    if (!read_request(app, argc, argv, &request, &exit_code))
        return exit_code;
    if (settle(&request) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    const nook_volumes_desc desc = { .resolution = request.levels.resolution,
                                     .kinds = request.kinds,
                                     .r_max = request.r_max,
                                     .cache_dir = request.cache,
                                     .must_keep = true,
                                     .threads = (uint32_t)request.threads,
                                     .progress = tell_progress };
    return bake_file(request.scene, &desc, request.levels.levels ? request.levels.levels : 1);
}
