#include "game/measure/measure_run.h"
#include "engine/core/file.h"
#include "game/compare/camera.h"
#include "game/interrupt.h"
#include "game/measure/measure_origin.h"
#include "game/measure/measure_reach.h"
#include "game/measure/scene_hash.h"
#include "game/stage.h"
#include "game/techniques.h"
#include <inttypes.h>
#include <stdio.h>

size_t nook_sweep_row_count(const nook_sweep *sweep)
{
    return (size_t)sweep->r_max_count * sweep->falloff_count * sweep->camera_count * sweep->setting_count;
}

/* @param scene  the row with what names scene, size and machine */
static nook_result measure_reaches(nook_measure_run *run, nook_stage *stage, nook_measure_views *views,
                                   const nook_result_row *scene)
{
    const nook_sweep *sweep = run->sweep;
    double diagonal = nook_scene_diagonal(stage->scene);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < sweep->falloff_count * sweep->r_max_count; i++) {
        char falloff[64];
        nook_result_row names = *scene;
        const nook_sweep_r_max *reach = &sweep->r_max[i % sweep->r_max_count];
        if (result != NOOK_OK || nook_interrupt_asked())
            break;
        nook_param_print_value(nook_shared_param("falloff"), sweep->falloffs[i / sweep->r_max_count], falloff,
                               sizeof falloff);
        names.falloff = falloff;
        names.r_max = reach->metres ? reach->value : reach->value * diagonal;
        names.r_max_part = reach->metres ? 0.0 : reach->value;
        result = nook_measure_reach(run, stage, views, &names);
    }
    return result;
}

nook_result nook_measure_run_scene(nook_measure_run *run, const char *path)
{
    const nook_stage_desc desc = { .root = run->root,
                                   .scene_path = path,
                                   .backend = run->backend,
                                   .width = run->sweep->width,
                                   .height = run->sweep->height };
    nook_stage stage;
    char hash[17], machine[NOOK_ORIGIN_MACHINE_SIZE], scene[256];
    nook_result result = nook_stage_open(&desc, &stage);
    if (result != NOOK_OK)
        return result;
    snprintf(hash, sizeof hash, "%016" PRIx64, nook_scene_hash(stage.scene));
    snprintf(scene, sizeof scene, "%s", nook_path_name(path));
    nook_result_row names = { .scene = scene,
                              .scene_hash = hash,
                              .width = stage.width,
                              .height = stage.height,
                              .build = (char *)run->build,
                              .machine = (char *)nook_origin_machine(stage.gpu, machine) };
    nook_measure_views views = { 0 };
    result = nook_measure_views_create(stage.scene, run->sweep, &views);
    if (result == NOOK_OK)
        result = measure_reaches(run, &stage, &views, &names);
    nook_measure_views_free(&views);
    nook_stage_close(&stage);
    return result;
}

void nook_measure_run_scenes(nook_measure_run *run, const nook_scene_list *scenes)
{
    size_t rows = nook_sweep_row_count(run->sweep);
    run->progress = nook_measure_progress_begin(scenes->count * rows);
    for (size_t i = 0; i < scenes->count && !nook_interrupt_asked(); i++) {
        size_t before = run->progress.handled;
        if (nook_measure_run_scene(run, scenes->paths[i]) == NOOK_OK)
            continue;
        run->failures++;
        if (run->journal->file < 0) /* what is measured could not be kept */
            break;
        run->progress.total -= rows - (run->progress.handled - before); /* what it would have had */
    }
    nook_measure_progress_end(&run->progress);
}
