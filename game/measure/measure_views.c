#include "game/measure/measure_views.h"
#include "engine/core/log.h"
#include "game/cameras/sample.h"
#include "game/compare/camera.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Cameras of one name, or without one, are called by their number. */
static void name_camera(const nook_scene_camera *camera, uint32_t index, const nook_measure_view *before,
                        nook_measure_view *view)
{
    bool taken = camera->name[0] == '\0';
    for (uint32_t i = 0; i < index; i++)
        taken = taken || strcmp(before[i].name, camera->name) == 0;
    if (taken)
        snprintf(view->name, sizeof view->name, "camera %u", index + 1);
    else
        snprintf(view->name, sizeof view->name, "%s", camera->name);
}

static void add_view(const nook_scene *scene, const nook_sweep *sweep, uint32_t index, nook_measure_view *items)
{
    nook_measure_view *view = &items[index];
    const nook_scene_camera *camera = sweep->cameras_sampled ? NULL : nook_camera_at(scene, index);
    view->sampled = !camera;
    if (camera) {
        name_camera(camera, index, items, view);
        view->camera = nook_camera_from_scene(camera);
        return;
    }
    uint32_t own = 0; /* of the scene's, which stand before all sampled ones */
    while (own < index && !items[own].sampled)
        own++;
    snprintf(view->name, sizeof view->name, "sample %u", index - own + 1);
}

nook_result nook_measure_views_create(const nook_scene *scene, const nook_sweep *sweep, nook_measure_views *out_views)
{
    nook_measure_view *items = calloc(sweep->camera_count, sizeof *items);
    if (!items)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u cameras", sweep->camera_count);
    for (uint32_t i = 0; i < sweep->camera_count; i++)
        add_view(scene, sweep, i, items);
    *out_views = (nook_measure_views){ items, sweep->camera_count, false };
    return NOOK_OK;
}

void nook_measure_views_free(nook_measure_views *views)
{
    free(views->items);
    *views = (nook_measure_views){ 0 };
}

nook_result nook_measure_views_find(const nook_scene *scene, double aspect, nook_measure_views *views)
{
    uint32_t first = 0, sampled;
    while (first < views->count && !views->items[first].sampled)
        first++;
    sampled = views->count - first;
    if (sampled == 0 || views->found)
        return NOOK_OK;
    nook_camera *cameras = calloc(sampled, sizeof *cameras);
    if (!cameras)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u cameras", sampled);
    nook_result result = nook_cameras_sample(scene, aspect, 0, sampled, cameras);
    for (uint32_t i = 0; i < sampled && result == NOOK_OK; i++)
        views->items[first + i].camera = cameras[i];
    views->found = result == NOOK_OK;
    free(cameras);
    return result;
}
