#include "game/plan/plan_apply.h"
#include "engine/core/log.h"
#include "game/plan/plan_describe.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- What stands still, in several volumes ---------------------------------------------------------------------- */

/* Vertices and indices of a group: how many, then copied. */
static void count_group(const nook_plan *plan, const nook_scene_volumes *volumes, uint32_t group,
                        nook_scene_volume *out)
{
    out->index_count = 0;
    for (uint32_t i = 0; i < volumes->part_count; i++)
        if (plan->group_of_part[i] == group)
            out->index_count += volumes->parts[i].index_count;
}

/* What stands still is split by primitives, and a primitive has one material. */
static void copy_alpha(const nook_scene_volume *whole, const nook_volumes_part *part, size_t first_index,
                       nook_scene_volume *out)
{
    for (uint32_t i = 0; i < whole->part_count; i++)
        if (whole->parts[i].first_index == part->first_index) {
            out->parts[out->part_count] = whole->parts[i];
            out->parts[out->part_count++].first_index = first_index;
        }
}

/* @param new_of_old  UINT32_MAX everywhere */
static void copy_group(const nook_plan *plan, const nook_scene_volumes *volumes, uint32_t group,
                       const nook_scene_volume *whole, uint32_t *new_of_old, nook_scene_volume *out)
{
    size_t count = 0;
    for (uint32_t i = 0; i < volumes->part_count; i++) {
        const nook_volumes_part *part = &volumes->parts[i];
        for (size_t k = 0; k < part->index_count && plan->group_of_part[i] == group; k++) {
            uint32_t old = whole->indices[part->first_index + k];
            if (new_of_old[old] == UINT32_MAX) {
                new_of_old[old] = out->vertex_count;
                memcpy(out->uvs + (size_t)out->vertex_count * 2, whole->uvs + (size_t)old * 2, 2 * sizeof(float));
                memcpy(out->positions + (size_t)out->vertex_count++ * 3, whole->positions + (size_t)old * 3,
                       3 * sizeof(float));
            }
            out->indices[count++] = new_of_old[old];
        }
        if (plan->group_of_part[i] == group)
            copy_alpha(whole, part, count - part->index_count, out);
    }
}

static nook_result make_group(const nook_plan *plan, const nook_scene_volumes *volumes, uint32_t group,
                              const nook_scene_volume *whole, uint32_t *new_of_old, nook_scene_volume *out)
{
    enum { NAME_SIZE = 32 };
    count_group(plan, volumes, group, out);
    out->name = malloc(NAME_SIZE);
    out->positions = malloc((out->index_count + 1) * 3 * sizeof *out->positions);
    out->indices = malloc((out->index_count + 1) * sizeof *out->indices);
    out->uvs = malloc((out->index_count + 1) * 2 * sizeof *out->uvs);
    out->parts = malloc(((size_t)whole->part_count + 1) * sizeof *out->parts);
    if (!out->name || !out->positions || !out->indices || !out->uvs || !out->parts)
        return nook_fail(NOOK_E_MEMORY, "plan: no memory for static volume %u", group);
    snprintf(out->name, NAME_SIZE, "static %u", group);
    for (uint32_t i = 0; i < whole->vertex_count; i++)
        new_of_old[i] = UINT32_MAX;
    copy_group(plan, volumes, group, whole, new_of_old, out);
    const double *min = plan->groups[group].box.min, *max = plan->groups[group].box.max;
    for (int axis = 0; axis < 3; axis++)
        out->longest = max[axis] - min[axis] > out->longest ? max[axis] - min[axis] : out->longest;
    out->resolution = plan->groups[group].resolution;
    out->instances = 1;
    return NOOK_OK;
}

/* The first group takes the place of the static body, the others come last. */
static nook_result add_groups(const nook_plan *plan, uint32_t static_occluder, uint32_t *new_of_old,
                              nook_scene_volumes *volumes)
{
    nook_scene_occluder *occluder = &volumes->occluders[static_occluder];
    const nook_scene_volume whole = volumes->volumes[occluder->volume];
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < plan->group_count && result == NOOK_OK; i++) {
        uint32_t index = volumes->volume_count++;
        volumes->volumes[index] = (nook_scene_volume){ .name = NULL };
        result = make_group(plan, volumes, i, &whole, new_of_old, &volumes->volumes[index]);
        if (i == 0)
            continue;
        nook_scene_occluder *another = &volumes->occluders[volumes->occluder_count++];
        *another = *occluder;
        another->volume = index;
    }
    occluder->volume = volumes->volume_count - plan->group_count;
    return result;
}

static nook_result split_static(const nook_plan *plan, nook_scene_volumes *volumes)
{
    uint32_t at = 0;
    if (plan->group_count == 0)
        return NOOK_OK;
    while (at < volumes->occluder_count && volumes->occluders[at].node != NOOK_NONE)
        at++;
    assert(at < volumes->occluder_count && volumes->part_count > 0);
    nook_result result = nook_volumes_reserve(volumes, plan->group_count);
    if (result != NOOK_OK)
        return result;
    uint32_t whole = volumes->occluders[at].volume;
    uint32_t *new_of_old = malloc(((size_t)volumes->volumes[whole].vertex_count + 1) * sizeof *new_of_old);
    result = new_of_old ? add_groups(plan, at, new_of_old, volumes)
                        : nook_fail(NOOK_E_MEMORY, "plan: no memory for static volumes");
    free(new_of_old);
    volumes->volumes[whole].instances = 0;
    volumes->part_count = 0;
    return result;
}

/* ---- Bodies ----------------------------------------------------------------------------------------------------- */

static void choose(const nook_plan *plan, nook_scene_volumes *volumes)
{
    assert(plan->occluder_count == volumes->occluder_count && plan->volume_count == volumes->volume_count);
    for (uint32_t i = 0; i < volumes->occluder_count; i++) {
        nook_scene_occluder *occluder = &volumes->occluders[i];
        uint32_t twin = plan->volumes[occluder->volume].volume;
        occluder->left_out = plan->occluders[i].rule != NOOK_PLAN_KEPT;
        volumes->volumes[occluder->volume].instances--;
        volumes->volumes[twin].instances++;
        occluder->volume = twin;
    }
    for (uint32_t i = 0; i < volumes->volume_count; i++)
        volumes->volumes[i].resolution = plan->volumes[i].resolution;
}

/* Volumes that no body uses any more go; those that are not marched stay, the reference traces them. */
static void drop_unused(nook_scene_volumes *volumes)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < volumes->volume_count; i++) {
        if (volumes->volumes[i].instances == 0) {
            nook_scene_volume_release(&volumes->volumes[i]);
            free(volumes->volumes[i].name);
            continue;
        }
        for (uint32_t k = 0; k < volumes->occluder_count; k++)
            if (volumes->occluders[k].volume == i)
                volumes->occluders[k].volume = kept;
        if (kept < i)
            volumes->volumes[kept] = volumes->volumes[i];
        kept++;
    }
    volumes->volume_count = kept;
}

nook_result nook_plan_apply(const nook_plan *plan, nook_scene_volumes *volumes)
{
    choose(plan, volumes);
    nook_result result = split_static(plan, volumes);
    if (result == NOOK_OK)
        drop_unused(volumes);
    return result;
}

nook_result nook_plan_apply_to(const nook_scene *scene, nook_scene_volumes *volumes)
{
    nook_plan_description description = { .volumes = NULL };
    nook_plan plan = { .groups = NULL };
    const nook_plan_params *params = &volumes->plan.params;
    const nook_plan_situation situation = { .moves = volumes->plan.moves, .multiplies = volumes->plan.multiplies };
    if (params->mode == NOOK_PLAN_OFF || volumes->volume_count == 0)
        return NOOK_OK;
    nook_result result = nook_plan_describe(scene, volumes, (uint32_t)params->rays, &situation, &description);
    if (result == NOOK_OK)
        result = nook_plan_make(&description.scene, params, &plan);
    if (result == NOOK_OK)
        result = nook_plan_apply(&plan, volumes);
    nook_plan_free(&plan);
    nook_plan_description_free(&description);
    return result;
}
