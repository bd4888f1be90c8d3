#include "modules/plan/plan.h"
#include "engine/core/log.h"
#include "modules/plan/plan_internal.h"
#include <assert.h>
#include <stdlib.h>

/* Bodies with the same triangles use one volume: as fine as the finest of them, and where pictures may not change at all, only with
   those that are just as fine. */
void plan_find_twins(const nook_plan_scene *scene, nook_plan *plan)
{
    for (uint32_t i = 0; i < scene->volume_count; i++) {
        uint32_t twin = scene->volumes[i].twin;
        nook_plan_volume_choice *first = &plan->volumes[twin], *own = &plan->volumes[i];
        assert(twin <= i);
        *own = (nook_plan_volume_choice){ .volume = i, .resolution = scene->volumes[i].resolution };
        if (twin == i || (plan->params.mode != NOOK_PLAN_MEASURED && first->resolution != own->resolution))
            continue;
        if (own->resolution > first->resolution)
            first->resolution = own->resolution;
        *own = (nook_plan_volume_choice){ .why = NOOK_PLAN_TWIN, .volume = twin };
    }
}

/* Volumes of which no body is marched. */
static void leave_unused(const nook_plan_scene *scene, nook_plan *plan)
{
    for (uint32_t i = 0; i < scene->volume_count; i++) {
        bool used = false;
        for (uint32_t k = 0; k < scene->occluder_count && !used; k++)
            used = plan->occluders[k].rule == NOOK_PLAN_KEPT && plan->volumes[scene->occluders[k].volume].volume == i;
        if (!used && plan->volumes[i].why != NOOK_PLAN_TWIN)
            plan->volumes[i] = (nook_plan_volume_choice){ .why = NOOK_PLAN_UNUSED, .volume = i };
    }
}

static nook_result make_room(const nook_plan_scene *scene, nook_plan *plan)
{
    plan->occluders = calloc((size_t)scene->occluder_count + 1, sizeof *plan->occluders);
    plan->volumes = calloc((size_t)scene->volume_count + 1, sizeof *plan->volumes);
    plan->group_of_part = calloc((size_t)scene->part_count + 1, sizeof *plan->group_of_part);
    plan->occluder_count = scene->occluder_count;
    plan->volume_count = scene->volume_count;
    return plan->occluders && plan->volumes && plan->group_of_part ? NOOK_OK : NOOK_E_MEMORY;
}

/* With nothing planned. */
static void stay_as_ever(const nook_plan_scene *scene, nook_plan *plan)
{
    for (uint32_t i = 0; i < scene->volume_count; i++) {
        const nook_plan_volume *volume = &scene->volumes[i];
        plan->volumes[i] = (nook_plan_volume_choice){ .volume = i, .resolution = volume->resolution };
        plan->bytes_before += nook_plan_voxel_bytes(volume->sides, volume->resolution);
    }
    for (uint32_t i = 0; i < scene->occluder_count; i++)
        plan->occluders[i] = (nook_plan_occluder_choice){ NOOK_PLAN_KEPT, 1.0 };
}

static nook_result choose(const nook_plan_scene *scene, nook_plan *plan)
{
    nook_result result = plan_leave_out(scene, plan);
    if (result != NOOK_OK)
        return result;
    plan_find_twins(scene, plan);
    leave_unused(scene, plan);
    if (plan->params.mode != NOOK_PLAN_MEASURED)
        return NOOK_OK;
    plan_choose_levels(scene, plan);
    return plan_group_parts(scene, plan);
}

nook_result nook_plan_make(const nook_plan_scene *scene, const nook_plan_params *params, nook_plan *out_plan)
{
    nook_plan plan = { .params = *params };
    *out_plan = (nook_plan){ .params = *params };
    assert(scene->r_max > 0.0);
    nook_result result = make_room(scene, &plan);
    if (result == NOOK_OK) {
        stay_as_ever(scene, &plan);
        if (params->mode != NOOK_PLAN_OFF)
            result = choose(scene, &plan);
    }
    if (result == NOOK_E_MEMORY)
        nook_fail(NOOK_E_MEMORY, "plan: no memory for %u bodies", scene->occluder_count);
    if (result == NOOK_OK)
        result = plan_fit_memory(scene, &plan);
    if (result == NOOK_OK)
        *out_plan = plan;
    else
        nook_plan_free(&plan);
    return result;
}

void nook_plan_free(nook_plan *plan)
{
    free(plan->occluders);
    free(plan->volumes);
    free(plan->group_of_part);
    free(plan->groups);
    *plan = (nook_plan){ 0 };
}
