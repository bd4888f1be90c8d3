#include "engine/animation/scene_stand.h"
#include "engine/animation/deform.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Vertices as the file has them, once. */
static nook_result keep_rest(nook_scene *scene)
{
    size_t count = 0;
    if (scene->rest_vertices || scene->deformable_count == 0)
        return NOOK_OK;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        scene->deformables[i].first_rest = (uint32_t)count; /* fewer than scene->vertices */
        count += scene->deformables[i].vertex_count;
    }
    scene->rest_vertices = malloc((count + 1) * sizeof *scene->rest_vertices);
    if (!scene->rest_vertices)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu vertices at rest", scene->path, count);
    scene->rest_vertex_count = count;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_deformable *d = &scene->deformables[i];
        memcpy(scene->rest_vertices + d->first_rest, scene->vertices + d->first_vertex,
               d->vertex_count * sizeof *scene->vertices);
    }
    return NOOK_OK;
}

static nook_result place_nodes(nook_scene *scene, const nook_scene_pose *pose)
{
    for (uint32_t n = 0; n < scene->node_count; n++) {
        nook_node *node = &scene->nodes[n];
        for (int i = 0; i < 16; i++)
            if (!isfinite(pose->world_from_local[n].m[i]))
                return nook_fail(NOOK_E_FORMAT, "%s: at this time the transform of node '%s' is not finite",
                                 scene->path, node->name);
        if (!node->animated)
            continue; /* stays as it is: who loaded it may have put it elsewhere */
        node->world_from_local = pose->world_from_local[n];
        nook_matrix seen = nook_scene_without_scale(&node->world_from_local);
        if (node->camera != NOOK_NONE)
            scene->cameras[node->camera].world_from_view = seen;
        if (node->light != NOOK_NONE)
            scene->lights[node->light].world_from_light = seen;
    }
    return NOOK_OK;
}

static nook_result stand(nook_scene *scene, uint32_t clip, double seconds)
{
    nook_scene_pose *pose;
    nook_result result = keep_rest(scene);
    if (result == NOOK_OK)
        result = nook_scene_pose_create(scene, &pose);
    if (result != NOOK_OK)
        return result;
    if (clip != NOOK_NONE) {
        nook_scene_pose_apply(pose, clip, nook_clip_time(scene->clips[clip].duration, seconds, false));
        nook_scene_pose_finish(pose);
    }
    result = place_nodes(scene, pose);
    for (uint32_t i = 0; i < scene->deformable_count && result == NOOK_OK; i++) {
        const nook_deformable *d = &scene->deformables[i];
        nook_deform(pose, i, scene->rest_vertices + d->first_rest, scene->vertices + d->first_vertex);
    }
    nook_scene_pose_destroy(pose);
    return result == NOOK_OK ? nook_scene_finish(scene) : result;
}

nook_result nook_scene_stand(nook_scene *scene, uint32_t clip, double seconds)
{
    bool moves = scene->rest && (scene->clip_count > 0 || scene->deformable_count > 0);
    return moves ? stand(scene, clip, seconds) : NOOK_OK;
}

nook_result nook_scene_stand_still(nook_scene *scene, uint32_t clip, double seconds)
{
    nook_result result = nook_scene_stand(scene, clip, seconds);
    if (result == NOOK_OK)
        nook_scene_forget_motion(scene);
    return result;
}
