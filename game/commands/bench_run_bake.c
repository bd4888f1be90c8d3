/* What baking surfels costs at each resolution: processor time, memory beyond the triangles, and again after one vertex was moved. */
#include "engine/core/angle.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "engine/core/process.h"
#include "game/commands/benches.h"
#include "game/option_rows.h"
#include "game/volumes.h"
#include "modules/bake/brick_grid.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { LEVELS = NOOK_VOXELIZE_LEVELS };
static const uint32_t levels[LEVELS] = { 64, 128, 256, 512 };

typedef struct bake_options {
    const char *scene; /* NULL: a ball made by code */
    int32_t triangles, threads, memory;
} bake_options;

/* A mesh, and one vertex of it that is no end of its box. */
typedef struct bake_mesh {
    float *positions;
    uint32_t *indices;
    uint32_t vertex_count, moved;
    size_t index_count;
} bake_mesh;

/* ---- meshes ------------------------------------------------------------------------------------------------------- */

static void free_mesh(bake_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->indices);
}

/* A ball of 1 m with waves on it, of meridians and half as many parallels. */
static nook_result make_ball(int32_t triangles, bake_mesh *out)
{
    uint32_t rings = (uint32_t)fmax(sqrt(triangles / 4.0), 2.0), sides = 2 * rings, row = sides + 1;
    bake_mesh mesh = { .vertex_count = (rings + 1) * row, .index_count = (size_t)rings * sides * 6 };
    mesh.positions = malloc((size_t)mesh.vertex_count * 3 * sizeof *mesh.positions);
    mesh.indices = malloc(mesh.index_count * sizeof *mesh.indices);
    if (!mesh.positions || !mesh.indices) {
        free_mesh(&mesh);
        return nook_fail(NOOK_E_MEMORY, "bench: no memory for %d triangles", triangles);
    }
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        double down = NOOK_PI * (i / row) / rings, around = 2.0 * NOOK_PI * (i % row % sides) / sides;
        double radius = 1.0 + 0.03 * sin(23.0 * down) * cos(17.0 * around) * sin(down);
        mesh.positions[3 * (size_t)i] = (float)(radius * sin(down) * cos(around));
        mesh.positions[3 * (size_t)i + 1] = (float)(radius * sin(down) * sin(around));
        mesh.positions[3 * (size_t)i + 2] = (float)(radius * cos(down));
    }
    for (size_t i = 0; i < (size_t)rings * sides; i++) {
        uint32_t low = (uint32_t)(i / sides) * row + (uint32_t)(i % sides), high = low + row;
        const uint32_t cell[] = { low, high, low + 1, low + 1, high, high + 1 };
        memcpy(mesh.indices + 6 * i, cell, sizeof cell);
    }
    *out = mesh;
    return NOOK_OK;
}

/* Of a scene the volume with the most triangles. */
static nook_result read_mesh(const char *path, bake_mesh *out)
{
    nook_scene *scene;
    nook_scene_volumes volumes;
    const nook_scene_options options = { .skip_images = true };
    nook_result result = nook_scene_load(path, &options, &scene);
    if (result != NOOK_OK)
        return result;
    result = nook_volumes_collect(scene, &(nook_volumes_desc){ .resolution = 0 }, &volumes);
    nook_scene_destroy(scene);
    if (result != NOOK_OK)
        return result;
    nook_scene_volume *most = NULL;
    for (uint32_t i = 0; i < volumes.volume_count; i++)
        if (!most || volumes.volumes[i].index_count > most->index_count)
            most = &volumes.volumes[i];
    if (most && most->index_count > 0) {
        *out = (bake_mesh){ .positions = most->positions,
                            .indices = most->indices,
                            .vertex_count = most->vertex_count,
                            .index_count = most->index_count };
        most->positions = NULL;
        most->indices = NULL;
    } else {
        result = nook_fail(NOOK_E_NOT_FOUND, "%s: there is nothing to bake", path);
    }
    nook_volumes_free(&volumes);
    return result;
}

/* A corner of the middle triangle: it should be no end of the box. */
static void choose_vertex(bake_mesh *mesh)
{
    mesh->moved = mesh->indices[mesh->index_count / 6 * 3];
}

/* ---- measuring ---------------------------------------------------------------------------------------------------- */

/* The most memory that this process has had so far. */
static double peak_mib(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (double)usage.ru_maxrss * 1024.0 / NOOK_MIB : NAN;
}

/* What it has now. */
static double resident_mib(void)
{
    nook_process process;
    return nook_process_read(&process) == NOOK_OK ? (double)process.resident / NOOK_MIB : NAN;
}

static bool same_surfels(const nook_volume *a, const nook_volume *b)
{
    return a->info.content_hash == b->info.content_hash && a->info.occupied == b->info.occupied &&
           memcmp(a->bricks, b->bricks, nook_brick_total(&a->info) * sizeof *a->bricks) == 0 &&
           memcmp(a->surfels, b->surfels, (size_t)a->info.occupied * sizeof *a->surfels) == 0;
}

typedef struct bake_row {
    nook_volume volume;
    double ms, mib, again_ms;
    size_t bricks;
} bake_row;

static nook_voxelize_desc describe(const bake_options *options, uint32_t resolution)
{
    return (nook_voxelize_desc){ .resolution = resolution,
                                 .threads = (uint32_t)options->threads,
                                 .kind = NOOK_VOLUME_SURFEL,
                                 .memory = (size_t)(options->memory * NOOK_MIB) };
}

/* The mesh with its vertex moved by a voxel towards the middle of the volume. @return its positions, release with free(); NULL: no memory */
static float *move_vertex(const bake_mesh *mesh, const nook_volume_info *info)
{
    const size_t size = (size_t)mesh->vertex_count * 3 * sizeof *mesh->positions;
    float *positions = malloc(size);
    if (!positions) {
        nook_fail(NOOK_E_MEMORY, "bench: no memory for %u vertices", mesh->vertex_count);
        return NULL;
    }
    memcpy(positions, mesh->positions, size);
    const uint32_t sides[3] = { info->width, info->height, info->depth };
    for (int axis = 0; axis < 3; axis++) {
        float *at = &positions[3 * (size_t)mesh->moved + (size_t)axis];
        double middle = info->origin[axis] + 0.5 * sides[axis] * info->voxel_size;
        *at += (float)copysign(fmin(info->voxel_size, fabs(middle - (double)*at)), middle - (double)*at);
    }
    return positions;
}

/* Bakes again after the vertex was moved, in part and whole. */
static nook_result bake_again(const bake_mesh *mesh, const nook_voxelize_desc *desc, bake_row *row)
{
    nook_volume again, whole = { .bricks = NULL };
    float *positions = move_vertex(mesh, &row->volume.info);
    if (!positions)
        return NOOK_E_MEMORY;
    const nook_triangles was = { mesh->positions, 0, mesh->vertex_count, mesh->indices, mesh->index_count };
    const nook_triangles is = { positions, 0, mesh->vertex_count, mesh->indices, mesh->index_count };
    const nook_voxelize_before older = { &was, NULL, &row->volume };
    double start = nook_clock_cpu_ms();
    nook_result result = nook_voxelize_again(&is, desc, &older, &again, &row->bricks);
    row->again_ms = nook_clock_cpu_ms() - start;
    if (result == NOOK_OK) {
        result = nook_voxelize(&is, desc, &whole);
        if (result == NOOK_OK && !same_surfels(&again, &whole))
            result = nook_fail(NOOK_E_FORMAT, "bench: a part baked again differs from the whole");
        nook_volume_free(&whole);
        nook_volume_free(&again);
    }
    free(positions);
    return result;
}

/* The same of all levels of a pass. @param before  LEVELS of them */
static nook_result bake_levels_again(const bake_mesh *mesh, const nook_voxelize_desc *desc, const nook_volume *before)
{
    const uint32_t all = (1u << LEVELS) - 1;
    nook_volume again[NOOK_VOXELIZE_LEVELS] = { { .bricks = NULL } },
                whole[NOOK_VOXELIZE_LEVELS] = { { .bricks = NULL } };
    size_t bricks[NOOK_VOXELIZE_LEVELS];
    float *positions = move_vertex(mesh, &before->info);
    if (!positions)
        return NOOK_E_MEMORY;
    const nook_triangles was = { mesh->positions, 0, mesh->vertex_count, mesh->indices, mesh->index_count };
    const nook_triangles is = { positions, 0, mesh->vertex_count, mesh->indices, mesh->index_count };
    const nook_voxelize_before older = { &was, NULL, before };
    double start = nook_clock_cpu_ms();
    nook_result result = nook_voxelize_levels_again(&is, desc, all, &older, again, bricks);
    const double again_ms = nook_clock_cpu_ms() - start;
    start = nook_clock_cpu_ms();
    if (result == NOOK_OK)
        result = nook_voxelize_levels(&is, desc, all, whole);
    const double ms = nook_clock_cpu_ms() - start;
    for (int i = 0; i < LEVELS; i++) {
        if (result == NOOK_OK && !same_surfels(&again[i], &whole[i]))
            result = nook_fail(NOOK_E_FORMAT, "bench: a part of level %d baked again differs from the whole", i);
        nook_volume_free(&again[i]);
        nook_volume_free(&whole[i]);
    }
    if (result == NOOK_OK)
        printf("  all %d again: %.0f ms, whole %.0f ms; bricks %zu %zu %zu %zu\n", LEVELS, again_ms, ms, bricks[3],
               bricks[2], bricks[1], bricks[0]);
    free(positions);
    return result;
}

/* From coarse to fine, all of them kept: the most memory so far is that of the last one. */
static nook_result time_level(const bake_options *options, const bake_mesh *mesh, uint32_t resolution, bake_row *row)
{
    const nook_triangles triangles = { mesh->positions, 0, mesh->vertex_count, mesh->indices, mesh->index_count };
    const nook_voxelize_desc desc = describe(options, resolution);
    double resident = resident_mib(), start = nook_clock_cpu_ms();
    nook_result result = nook_voxelize(&triangles, &desc, &row->volume);
    row->ms = nook_clock_cpu_ms() - start;
    row->mib = peak_mib() - resident;
    return result;
}

/* All of them from one pass, those beside the finest from its sums; the finest is held against the one baked alone. */
static nook_result time_pass(const bake_options *options, const bake_mesh *mesh, const bake_row *rows)
{
    const nook_triangles triangles = { mesh->positions, 0, mesh->vertex_count, mesh->indices, mesh->index_count };
    const nook_voxelize_desc desc = describe(options, levels[LEVELS - 1]);
    nook_volume volumes[NOOK_VOXELIZE_LEVELS];
    double alone = 0.0, resident = resident_mib(), peak = peak_mib(), start = nook_clock_cpu_ms();
    nook_result result = nook_voxelize_levels(&triangles, &desc, (1u << LEVELS) - 1, volumes);
    double ms = nook_clock_cpu_ms() - start;
    if (result != NOOK_OK)
        return result;
    for (int i = 0; i < LEVELS; i++)
        alone += rows[i].ms;
    printf("  all %d from one pass: %.0f ms, %.2f of the sum of each alone; surfels", LEVELS, ms, ms / alone);
    for (int i = LEVELS - 1; i >= 0; i--)
        printf(" %llu", (unsigned long long)volumes[i].info.occupied);
    if (peak_mib() > peak)
        printf("; %.0f MiB", peak_mib() - resident);
    printf("\n");
    if (!same_surfels(&volumes[0], &rows[LEVELS - 1].volume))
        result = nook_fail(NOOK_E_FORMAT, "bench: the finest of several levels differs from itself alone");
    if (result == NOOK_OK)
        result = bake_levels_again(mesh, &desc, volumes);
    for (int i = 0; i < LEVELS; i++)
        nook_volume_free(&volumes[i]);
    return result;
}

static nook_result time_levels(const bake_options *options, const bake_mesh *mesh, bake_row *rows)
{
    nook_result result = NOOK_OK;
    for (int i = 0; i < LEVELS && result == NOOK_OK; i++)
        result = time_level(options, mesh, levels[i], &rows[i]);
    for (int i = 0; i < LEVELS && result == NOOK_OK; i++) {
        const nook_voxelize_desc desc = describe(options, levels[i]);
        result = bake_again(mesh, &desc, &rows[i]);
    }
    for (int i = 0; i < LEVELS && result == NOOK_OK; i++)
        printf("  %10u %10llu %10.0f %10.0f %10.0f %10zu\n", levels[i],
               (unsigned long long)rows[i].volume.info.occupied, rows[i].ms, rows[i].mib, rows[i].again_ms,
               rows[i].bricks);
    return result == NOOK_OK ? time_pass(options, mesh, rows) : result;
}

static nook_result run(const bake_options *options)
{
    bake_mesh mesh;
    nook_result result = options->scene ? read_mesh(options->scene, &mesh) : make_ball(options->triangles, &mesh);
    if (result != NOOK_OK)
        return result;
    choose_vertex(&mesh);
    printf("surfels of %s, %zu triangles, %u vertices; milliseconds computed, MiB beyond what was there, which held "
           "the triangles;\n"
           "again: after one vertex moved by a voxel\n"
           "  %10s %10s %10s %10s %10s %10s\n",
           options->scene ? options->scene : "a ball", mesh.index_count / 3, mesh.vertex_count, "resolution", "surfels",
           "ms", "MiB", "again, ms", "bricks");
    bake_row rows[LEVELS] = { { .ms = 0.0 } };
    result = time_levels(options, &mesh, rows);
    for (int i = 0; i < LEVELS; i++)
        nook_volume_free(&rows[i].volume);
    free_mesh(&mesh);
    return result;
}

int nook_bench_run_bake(const nook_app *app, int argc, char **argv)
{
    bake_options options = { .triangles = 1000000 };
    int exit_code;
    (void)app;
    const nook_option rows[] = {
        nook_option_row_int("triangles", &options.triangles, 16, 100000000, "of the ball, about; default 1000000"),
        nook_option_row_int("threads", &options.threads, 0, 256, "default 0: one per processor"),
        nook_option_row_int("memory", &options.memory, 0, 65536, "MiB for each thread's sums; default 0: 64"),
    };
    const nook_usage usage = { .command = "bench bake",
                               .summary =
                                   "Times baking surfels of a scene's largest mesh, default a ball made by code.",
                               .positionals = "[SCENE]",
                               .positional_max = 1,
                               .options = rows,
                               .option_count = NOOK_COUNT(rows) };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, &exit_code))
        return exit_code;
    if (arguments.positional_count > 0)
        options.scene = arguments.positionals[0];
    return run(&options) == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
