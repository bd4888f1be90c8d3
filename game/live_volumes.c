#include "game/live_volumes.h"
#include "engine/animation/deform.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/material_alpha.h"
#include "game/volumes.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES_PER_CLIP = 16 };

/* ---- Which size -------------------------------------------------------------------------------------------------- */

static double longest_side(const nook_box *box)
{
    double longest = 0.0;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, (double)box->max[k] - (double)box->min[k]);
    return longest;
}

/* Grows `sides` and `longest` to those of the present pose, of every deformable. */
static void measure(const nook_scene_pose *pose, nook_live_volumes *volumes, double (*sides)[3])
{
    for (uint32_t i = 0; i < volumes->count; i++) {
        const nook_box *box = &pose->meshes[volumes->items[i].deformable].box;
        for (int k = 0; k < 3; k++)
            sides[i][k] = fmax(sides[i][k], (double)box->max[k] - (double)box->min[k]);
    }
}

static void measure_clips(nook_scene_pose *pose, nook_live_volumes *volumes, double (*sides)[3])
{
    for (uint32_t clip = 0; clip < pose->scene->clip_count; clip++)
        for (int i = 0; i < SAMPLES_PER_CLIP; i++) {
            nook_scene_pose_rest(pose);
            nook_scene_pose_apply(pose, clip, pose->scene->clips[clip].duration * i / SAMPLES_PER_CLIP);
            nook_scene_pose_finish(pose);
            measure(pose, volumes, sides);
        }
}

/* @param sides  the most that any pose takes, metres, mesh space */
static void choose_size(const nook_scene_pose *pose, double r_max, const double sides[3], nook_live_volume *volume)
{
    const nook_deformable *d = &pose->scene->deformables[volume->deformable];
    const nook_box *rest = &pose->meshes[volume->deformable].box;
    double longest = longest_side(rest), largest = fmax(sides[0], fmax(sides[1], sides[2]));
    uint32_t resolution = nook_volumes_body_resolution(
        longest * nook_matrix_longest_axis(&pose->world_from_local[d->node]), r_max, NOOK_VOLUMES_RESOLUTION_DEFAULT);
    volume->voxel_size = fmax(longest / resolution, largest / (NOOK_LIVE_VOLUME_SIDE_MAX - 4));
    for (int k = 0; k < 3; k++) {
        double wanted = ceil(sides[k] / volume->voxel_size) + 4.0; /* borders, and where the grid begins */
        volume->size[k] = (uint32_t)fmin(wanted, NOOK_LIVE_VOLUME_SIDE_MAX);
    }
}

static nook_result choose_sizes(nook_scene_pose *pose, double r_max, nook_live_volumes *volumes)
{
    double(*sides)[3] = calloc(volumes->count + 1u, sizeof *sides);
    if (!sides)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its live volumes", pose->scene->path);
    measure_clips(pose, volumes, sides);
    nook_scene_pose_rest(pose);
    nook_scene_pose_finish(pose);
    measure(pose, volumes, sides);
    for (uint32_t i = 0; i < volumes->count; i++)
        choose_size(pose, r_max, sides[i], &volumes->items[i]);
    free(sides);
    return NOOK_OK;
}

/* ---- Life -------------------------------------------------------------------------------------------------------- */

/* Triangles of one deformable, for both. */
static void add_triangles(const nook_scene *scene, nook_live_volumes *volumes, nook_live_volume *volume)
{
    const nook_deformable *d = &scene->deformables[volume->deformable];
    const nook_mesh *mesh = &scene->meshes[d->mesh];
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        nook_alpha_part *part = &volumes->parts[volume->first_part + volume->part_count];
        if (!nook_primitive_live_range(scene, primitive, &volumes->ranges[volume->first_range + volume->range_count]))
            continue;
        volume->range_count++;
        if (nook_material_alpha(scene, &scene->materials[primitive->material], part)) {
            part->first_index = volume->index_count;
            part->index_count = primitive->index_count;
            volume->part_count++;
        }
        uint32_t by = primitive->first_vertex - d->first_vertex;
        for (uint32_t i = 0; i < primitive->index_count; i++)
            volumes->indices[volume->first_index + volume->index_count++] =
                scene->indices[primitive->first_index + i] + by;
    }
}

static nook_result allocate(const nook_scene *scene, nook_live_volumes *out)
{
    size_t primitives = 0, indices = 0, vertices = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_deformable *d = &scene->deformables[i];
        const nook_mesh *mesh = &scene->meshes[d->mesh];
        vertices = d->vertex_count > vertices ? d->vertex_count : vertices;
        primitives += mesh->primitive_count;
        for (uint32_t p = 0; p < mesh->primitive_count; p++)
            indices += scene->primitives[mesh->first_primitive + p].index_count;
    }
    out->items = calloc(scene->deformable_count + 1u, sizeof *out->items);
    out->ranges = calloc(primitives + 1, sizeof *out->ranges);
    out->indices = calloc(indices + 1, sizeof *out->indices);
    out->parts = calloc(primitives + 1, sizeof *out->parts);
    out->masks = nook_scene_live_masks(scene);
    out->uvs = calloc(vertices + 1, 2 * sizeof *out->uvs);
    out->vertices = calloc(vertices + 1, sizeof *out->vertices);
    out->positions = calloc(vertices + 1, 3 * sizeof *out->positions);
    bool made = out->items && out->ranges && out->indices && out->vertices && out->positions;
    return made && out->parts && out->masks && out->uvs
               ? NOOK_OK
               : nook_fail(NOOK_E_MEMORY, "%s: no memory for its live volumes", scene->path);
}

static void find_volumes(const nook_scene *scene, nook_live_volumes *out)
{
    uint32_t range = 0, index = 0, part = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        nook_live_volume *volume = &out->items[out->count];
        *volume = (nook_live_volume){ .deformable = i, .first_range = range, .first_index = index, .first_part = part };
        add_triangles(scene, out, volume);
        range += volume->range_count;
        index += volume->index_count;
        part += volume->part_count;
        out->count += volume->index_count > 0;
    }
}

nook_result nook_live_volumes_create(nook_ao *ao, nook_scene_pose *pose, double r_max, nook_live_volumes *out)
{
    const nook_scene *scene = pose->scene;
    nook_live_volumes made = { 0 };
    *out = made;
    nook_result result = allocate(scene, &made);
    if (result == NOOK_OK) {
        find_volumes(scene, &made);
        result = choose_sizes(pose, r_max, &made);
    }
    for (uint32_t i = 0; i < made.count && result == NOOK_OK; i++)
        result = nook_ao_add_live_volume(ao, scene->meshes[scene->deformables[made.items[i].deformable].mesh].name,
                                         made.items[i].size, &made.items[i].occluder.volume);
    if (result != NOOK_OK) {
        nook_live_volumes_destroy(ao, &made);
        return result;
    }
    *out = made;
    return NOOK_OK;
}

void nook_live_volumes_destroy(nook_ao *ao, nook_live_volumes *volumes)
{
    for (uint32_t i = 0; i < volumes->count; i++) { /* those that were not reached have no ids */
        nook_ao_remove_volume(ao, volumes->items[i].occluder.volume);
        nook_ao_remove_mesh(ao, volumes->items[i].occluder.mesh);
    }
    free(volumes->items);
    free(volumes->ranges);
    free(volumes->indices);
    free(volumes->vertices);
    free(volumes->positions);
    free(volumes->masks);
    free(volumes->parts);
    free(volumes->uvs);
    *volumes = (nook_live_volumes){ 0 };
}

/* ---- The reference ----------------------------------------------------------------------------------------------- */

static nook_result trace(nook_live_volumes *volumes, nook_live_volume *volume, nook_ao *ao, const nook_scene_pose *pose)
{
    const nook_scene *scene = pose->scene;
    const nook_deformable *d = &scene->deformables[volume->deformable];
    const nook_vertex *rest =
        scene->rest_vertices ? scene->rest_vertices + d->first_rest : scene->vertices + d->first_vertex;
    nook_deform(pose, volume->deformable, rest, volumes->vertices);
    for (uint32_t v = 0; v < d->vertex_count; v++) {
        memcpy(volumes->positions + (size_t)v * 3, volumes->vertices[v].position, 3 * sizeof(float));
        memcpy(volumes->uvs + (size_t)v * 2, volumes->vertices[v].uv, 2 * sizeof(float));
    }
    nook_ao_remove_mesh(ao, volume->occluder.mesh);
    volume->occluder.mesh = (nook_ao_mesh){ 0 };
    const nook_alphas alphas = { volumes->parts + volume->first_part, volume->part_count, volumes->uvs };
    return nook_ao_add_mesh_with_alphas(ao, volumes->positions, d->vertex_count, volumes->indices + volume->first_index,
                                        volume->index_count, &alphas, &volume->occluder.mesh);
}

nook_result nook_live_volumes_trace(nook_live_volumes *volumes, nook_ao *ao, const nook_scene_pose *pose,
                                    uint32_t version)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < volumes->count && result == NOOK_OK; i++) {
        nook_live_volume *volume = &volumes->items[i];
        if (volume->mesh_version == version)
            continue;
        result = trace(volumes, volume, ao, pose);
        volume->mesh_version = result == NOOK_OK ? version : 0;
    }
    return result;
}

/* ---- Every frame ------------------------------------------------------------------------------------------------- */

/* Whether a ball reaches into the pyramid that a camera sees. */
static bool ball_in_view(const nook_camera *camera, double aspect, const double centre[3], double radius)
{
    double p[3], up = tan(0.5 * camera->fov_y_radians), right = up * aspect;
    nook_matrix_apply_point(&camera->view_from_world, centre, p);
    return -p[2] > -radius && fabs(p[0]) + p[2] * right < radius * sqrt(1.0 + right * right) &&
           fabs(p[1]) + p[2] * up < radius * sqrt(1.0 + up * up);
}

static bool matters(const nook_live_volume *volume, const nook_scene_pose *pose, const nook_camera *camera,
                    double aspect, double r_max)
{
    const nook_box *box = &pose->meshes[volume->deformable].box;
    const nook_matrix *world_from_mesh = &pose->world_from_local[pose->scene->deformables[volume->deformable].node];
    double centre[3], half[3];
    for (int k = 0; k < 3; k++) {
        centre[k] = 0.5 * ((double)box->min[k] + (double)box->max[k]);
        half[k] = 0.5 * ((double)box->max[k] - (double)box->min[k]);
    }
    nook_matrix_apply_point(world_from_mesh, centre, centre);
    /* No corner is farther than the half axes together. */
    double radius = r_max;
    for (int k = 0; k < 3; k++)
        radius += half[k] * nook_vector_length(world_from_mesh->m + k * 4);
    return ball_in_view(camera, aspect, centre, radius);
}

nook_result nook_live_volumes_voxelize(nook_live_volumes *volumes, nook_ao *ao, const nook_scene_pose *pose,
                                       uint32_t version, const nook_render_scene *scene, const nook_camera *camera,
                                       double aspect)
{
    double r_max = 0.0;
    nook_result result = volumes->count > 0 ? nook_ao_get_param(ao, "ao.r_max", &r_max) : NOOK_OK;
    volumes->voxelized = 0;
    nook_scene_live_masks_find(pose->scene, scene, volumes->masks);
    for (uint32_t i = 0; i < volumes->count && result == NOOK_OK; i++) {
        nook_live_volume *volume = &volumes->items[i];
        if (volume->voxel_version == version || !matters(volume, pose, camera, aspect, r_max))
            continue;
        nook_ao_live_part part = { .ranges = volumes->ranges + volume->first_range,
                                   .range_count = volume->range_count };
        nook_ao_live_mesh mesh = { .vertex_buffer = nook_render_scene_vertices(scene).id,
                                   .vertex_stride = sizeof(nook_vertex),
                                   .index_buffer = nook_render_scene_indices(scene).id,
                                   .parts = &part,
                                   .part_count = 1,
                                   .masks = volumes->masks,
                                   .uv_offset = offsetof(nook_vertex, uv),
                                   .voxel_size = volume->voxel_size };
        memcpy(part.volume_from_part, nook_matrix_identity().m, sizeof part.volume_from_part);
        memcpy(mesh.box_min, pose->meshes[volume->deformable].box.min, sizeof mesh.box_min);
        memcpy(mesh.box_max, pose->meshes[volume->deformable].box.max, sizeof mesh.box_max);
        result = nook_ao_voxelize(ao, volume->occluder.volume, &mesh);
        volume->voxel_version = result == NOOK_OK ? version : 0;
        volumes->voxelized++;
    }
    return result;
}
