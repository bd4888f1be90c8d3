#include "game/draw_list.h"
#include "engine/ecs/transform.h"
#include "game/components.h"
#include <assert.h>
#include <string.h>

static void clear_draws(const nook_rows *rows)
{
    nook_draw_list *list = rows->resources[0];
    list->count = 0;
}

static void collect_draws(const nook_rows *rows)
{
    const nook_transform *transforms = rows->columns[0];
    const nook_renderable *renderables = rows->columns[1];
    const nook_rigid_body *bodies = rows->columns[2];
    nook_draw_list *list = rows->resources[0];
    assert(rows->count <= list->capacity - list->count);
    for (uint32_t i = 0; i < rows->count; i++) {
        nook_draw *draw = &list->items[list->count++];
        draw->mesh = renderables[i].mesh;
        draw->moves = bodies[i].motion == NOOK_MOTION_DYNAMIC;
        draw->pose_version = 0;
        draw->box = (nook_box){ { 0 }, { 0 } };
        memcpy(draw->world_from_local.m, transforms[i].world_from_local, sizeof draw->world_from_local.m);
    }
}

static const nook_system clear_draws_system = {
    .name = "render.clear_draws",
    .phase = NOOK_PHASE_PRE_RENDER,
    .resources = { NOOK_TYPE(nook_draw_list) },
    .run = clear_draws,
};

static const nook_system collect_draws_system = {
    .name = "render.collect_draws",
    .phase = NOOK_PHASE_PRE_RENDER,
    .reads = { NOOK_TYPE(nook_transform), NOOK_TYPE(nook_renderable), NOOK_TYPE(nook_rigid_body) },
    .resources = { NOOK_TYPE(nook_draw_list) },
    .run = collect_draws,
};

nook_result nook_draw_list_set_up(nook_world *world, nook_draw *items, uint32_t capacity)
{
    const nook_draw_list list = { items, 0, capacity };
    const nook_type type = NOOK_TYPE(nook_draw_list);
    nook_result result = nook_world_set_resource(world, &type, &list);
    if (result == NOOK_OK)
        result = nook_world_add_system(world, &clear_draws_system);
    if (result == NOOK_OK)
        result = nook_world_add_system(world, &collect_draws_system);
    return result;
}

nook_result nook_draw_list_renew(nook_world *world)
{
    nook_result result = nook_world_replace_system(world, &clear_draws_system);
    return result == NOOK_OK ? nook_world_replace_system(world, &collect_draws_system) : result;
}
