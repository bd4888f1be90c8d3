/* What a character that bends costs before anything is drawn of it: its clips sampled, its vertices posed, its live volume made
   anew, in every frame. */
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "game/commands/bench_stage.h"
#include "game/commands/benches.h"

enum { FRAMES_MAX = 1000, WARM = 2 };

static const double frame_seconds = 1.0 / 30.0;

typedef enum step {
    STEP_SAMPLE,   /**< Systems: clips, transforms of nodes, joint matrices; the processor. */
    STEP_DEFORM,   /**< Vertices and triangle normals of the pose; compute shaders. */
    STEP_VOXELIZE, /**< Slicemaps and their merging. */
    STEP_BEGIN,    /**< The rest until the G-buffer is there: for comparison. */
    STEP_OCCLUDE,
    STEP_COUNT
} step;

static const char *const step_names[STEP_COUNT] = { "sample", "deform", "voxelise", "gbuffer", "occlusion" };

typedef struct character_options {
    nook_bench_stage_options stage;
    int32_t frames;
    bool cpu;
} character_options;

static bool read_options(const nook_app *app, int argc, char **argv, character_options *out, int *out_exit_code)
{
    out->frames = 30;
    out->cpu = false;
    const nook_option options[] = {
        nook_option_row_int("frames", &out->frames, 1, FRAMES_MAX, "timed, after two to warm up; default 30"),
        nook_option_row_cpu(&out->cpu),
    };
    const nook_usage usage = {
        .command = "bench character",
        .summary = "Times what skinned and morphing meshes cost in each frame while their clips play.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "SCENE: one with skins or morph targets and clips, the first of which plays, 1/30 s a frame. Wall time\n"
            "around glFinish, medians; gbuffer and occlusion: the rest of the frame, for comparison.\n"
    };
    return nook_bench_stage_read(app, &usage, argc, argv, &out->stage, out_exit_code);
}

static nook_result run_step(nook_stage *stage, const nook_camera *camera, step which)
{
    uint32_t version;
    const nook_mesh_pose *poses;
    switch (which) {
    case STEP_SAMPLE:
        nook_game_world_advance(stage->world, frame_seconds);
        return nook_game_world_update(stage->world, stage->ao);
    case STEP_DEFORM:
        poses = nook_game_world_poses(stage->world, &version);
        nook_render_scene_pose(stage->render_scene, poses, version);
        return NOOK_OK;
    case STEP_VOXELIZE:
        return nook_game_world_voxelize(stage->world, stage->render_scene, camera,
                                        (double)stage->width / stage->height);
    case STEP_BEGIN:
        return nook_stage_begin(stage, camera);
    case STEP_OCCLUDE:
    case STEP_COUNT:
        break;
    }
    return nook_stage_occlude(stage);
}

/* @param out_made  live volumes that the last frame made anew */
static nook_result time_frames(nook_stage *stage, const nook_camera *camera, const character_options *options,
                               double ms[STEP_COUNT][FRAMES_MAX + WARM], uint32_t *out_made)
{
    double (*clock)(void) = options->cpu ? nook_clock_cpu_ms : nook_clock_ms;
    nook_result result = NOOK_OK;
    for (int32_t i = 0; i < WARM + options->frames; i++) {
        for (step which = 0; which < STEP_COUNT && result == NOOK_OK; which++) {
            nook_gpu_finish(stage->gpu);
            double start = clock();
            result = run_step(stage, camera, which);
            nook_gpu_finish(stage->gpu);
            ms[which][i] = clock() - start;
            if (which == STEP_VOXELIZE)
                *out_made = nook_game_world_live_volumes(stage->world)->voxelized;
        }
    }
    return result;
}

static void print_meshes(const nook_stage *stage)
{
    const nook_live_volumes *live = nook_game_world_live_volumes(stage->world);
    for (uint32_t i = 0; i < live->count; i++) {
        const nook_live_volume *volume = &live->items[i];
        const nook_deformable *d = &stage->scene->deformables[volume->deformable];
        printf("  %s: %u vertices, %u triangles, up to %u x %u x %u voxels of %.3g m in its own space\n",
               stage->scene->meshes[d->mesh].name, d->vertex_count, volume->index_count / 3, volume->size[0],
               volume->size[1], volume->size[2], volume->voxel_size);
    }
}

static nook_result run(void *user, nook_stage *stage, const nook_settings_file *settings)
{
    const character_options *options = user;
    static double ms[STEP_COUNT][FRAMES_MAX + WARM];
    const nook_live_volumes *live = nook_game_world_live_volumes(stage->world);
    nook_camera camera;
    char name[NOOK_BENCH_CAMERA_NAME_SIZE];
    uint32_t made = 0;
    if (live->count == 0)
        return nook_fail(NOOK_E_ARG, "%s: nothing in it bends by a clip; give a scene with skins or morph targets",
                         options->stage.scene);
    nook_result result = nook_bench_stage_camera(stage, 0, &camera, name);
    if (result == NOOK_OK)
        result = time_frames(stage, &camera, options, ms, &made);
    if (result != NOOK_OK)
        return result;
    nook_bench_stage_print(&options->stage, stage, settings);
    print_meshes(stage);
    printf("  %u of %u live volumes made anew in the last frame; milliseconds of %s, %d frames\n\n ", made, live->count,
           options->cpu ? "all threads together" : "wall time", options->frames);
    for (step which = 0; which < STEP_COUNT; which++)
        printf(" %10s", step_names[which]);
    printf("\n ");
    for (step which = 0; which < STEP_COUNT; which++)
        printf(" %10.3f", nook_median(ms[which] + WARM, (size_t)options->frames));
    printf("\n");
    return NOOK_OK;
}

int nook_bench_run_character(const nook_app *app, int argc, char **argv)
{
    character_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    options.stage.plays = true;
    return nook_bench_stage_run(&options.stage, app->root, true, run, &options);
}
