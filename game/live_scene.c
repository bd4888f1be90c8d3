#include "game/live_scene.h"
#include "engine/core/log.h"
#include "game/material_alpha.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static void find_ranges(const nook_scene *scene, nook_live_scene *out)
{
    uint32_t count = 0;
    for (uint32_t m = 0; m < scene->mesh_count; m++) {
        const nook_mesh *mesh = &scene->meshes[m];
        out->first_range[m] = count;
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
            count += nook_primitive_live_range(scene, primitive, &out->ranges[count]);
        }
    }
    out->first_range[scene->mesh_count] = count;
}

static void choose_box(const nook_scene *scene, uint32_t resolution, nook_live_scene *out)
{
    double longest = 0.0, centre[3];
    uint32_t most = NOOK_AO_LIVE_SIDE_MAX - 4; /* borders, and where the grid begins */
    for (int k = 0; k < 3; k++) {
        double half = 0.5 * scene->bounds_max[k] - 0.5 * scene->bounds_min[k];
        centre[k] = 0.5 * scene->bounds_max[k] + 0.5 * scene->bounds_min[k];
        out->box_min[k] = (float)-half;
        out->box_max[k] = (float)half;
        longest = fmax(longest, 2.0 * half);
    }
    out->world_from_volume = nook_matrix_translation(centre[0], centre[1], centre[2]);
    out->voxel_size = longest / (resolution < most ? resolution : most);
    for (int k = 0; k < 3; k++) { /* floats of the box may be a last digit longer than its side */
        double wanted = ceil(2.0 * (double)out->box_max[k] / out->voxel_size) + 4.0;
        out->size[k] = (uint32_t)fmin(wanted, NOOK_AO_LIVE_SIDE_MAX);
    }
}

static nook_result allocate(const nook_scene *scene, nook_live_scene *out)
{
    out->ranges = calloc(scene->primitive_count + (size_t)1, sizeof *out->ranges);
    out->first_range = calloc(scene->mesh_count + (size_t)1, sizeof *out->first_range);
    out->parts = calloc(scene->node_count + (size_t)1, sizeof *out->parts);
    out->drawn = calloc(scene->node_count + (size_t)1, sizeof *out->drawn);
    out->masks = nook_scene_live_masks(scene);
    return out->ranges && out->first_range && out->parts && out->drawn && out->masks
               ? NOOK_OK
               : nook_fail(NOOK_E_MEMORY, "%s: no memory for its live volume", scene->path);
}

nook_result nook_live_scene_create(nook_ao *ao, const nook_scene *scene, uint32_t resolution, nook_live_scene *out)
{
    nook_live_scene made = { .scene = scene };
    *out = (nook_live_scene){ 0 };
    if (!(scene->bounds_max[0] > scene->bounds_min[0]) && !(scene->bounds_max[1] > scene->bounds_min[1]) &&
        !(scene->bounds_max[2] > scene->bounds_min[2]))
        return nook_fail(NOOK_E_FORMAT, "%s: what it draws has no size, so there is nothing to voxelise", scene->path);
    nook_result result = allocate(scene, &made);
    if (result == NOOK_OK) {
        find_ranges(scene, &made);
        choose_box(scene, resolution, &made);
        result = nook_ao_add_live_volume(ao, scene->path, made.size, &made.volume);
    }
    if (result != NOOK_OK)
        nook_live_scene_destroy(ao, &made);
    *out = made;
    return result;
}

void nook_live_scene_destroy(nook_ao *ao, nook_live_scene *live)
{
    if (live->volume.id)
        nook_ao_remove_volume(ao, live->volume);
    free(live->ranges);
    free(live->first_range);
    free(live->parts);
    free(live->drawn);
    free(live->masks);
    *live = (nook_live_scene){ 0 };
}

/* Whether every draw stands where it stood; remembers where they stand now. */
static bool stands_still(nook_live_scene *live, const nook_draw *draws, size_t count)
{
    bool still = live->drawn_count == count;
    for (size_t i = 0; i < count; i++) {
        still =
            still && live->drawn[i].mesh == draws[i].mesh &&
            memcmp(&live->drawn[i].world_from_local, &draws[i].world_from_local, sizeof draws[i].world_from_local) == 0;
        live->drawn[i] = draws[i];
    }
    live->drawn_count = (uint32_t)count;
    return still;
}

static uint32_t place_parts(nook_live_scene *live, const nook_draw *draws, size_t draw_count)
{
    uint32_t count = 0;
    for (size_t i = 0; i < draw_count; i++) {
        uint32_t first = live->first_range[draws[i].mesh], end = live->first_range[draws[i].mesh + 1];
        if (first == end || draws[i].pose_version)
            continue;
        nook_ao_live_part *part = &live->parts[count++];
        nook_matrix volume_from_mesh = draws[i].world_from_local;
        for (int k = 0; k < 3; k++)
            volume_from_mesh.m[12 + k] -= live->world_from_volume.m[12 + k];
        part->ranges = live->ranges + first;
        part->range_count = end - first;
        memcpy(part->volume_from_part, volume_from_mesh.m, sizeof part->volume_from_part);
    }
    return count;
}

nook_result nook_live_scene_voxelize(nook_live_scene *live, nook_ao *ao, const nook_render_scene *scene,
                                     const nook_draw *draws, size_t draw_count)
{
    live->voxelized = !stands_still(live, draws, draw_count);
    if (!live->voxelized)
        return NOOK_OK;
    nook_ao_live_mesh mesh = { .vertex_buffer = nook_render_scene_vertices(scene).id,
                               .vertex_stride = sizeof(nook_vertex),
                               .index_buffer = nook_render_scene_indices(scene).id,
                               .parts = live->parts,
                               .part_count = place_parts(live, draws, draw_count),
                               .masks = live->masks,
                               .uv_offset = offsetof(nook_vertex, uv),
                               .voxel_size = live->voxel_size };
    nook_scene_live_masks_find(live->scene, scene, live->masks);
    memcpy(mesh.box_min, live->box_min, sizeof mesh.box_min);
    memcpy(mesh.box_max, live->box_max, sizeof mesh.box_max);
    nook_result result = nook_ao_voxelize(ao, live->volume, &mesh);
    if (result != NOOK_OK)
        live->drawn_count = UINT32_MAX; /* made anew with the next */
    return result;
}
