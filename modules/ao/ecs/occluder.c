#include "modules/ao/ecs/occluder.h"
#include <string.h>

nook_result nook_occluders_set_up(nook_world *world, nook_ao_occluder *items, uint32_t capacity)
{
    const nook_occluder_list list = { .items = items, .capacity = capacity };
    nook_result result = nook_world_set_resource(world, NOOK_TYPE_OF(nook_occluder_list), &list);
    if (result == NOOK_OK)
        result = nook_world_add_system(world, &nook_clear_occluders);
    if (result == NOOK_OK)
        result = nook_world_add_system(world, &nook_collect_occluders);
    return result;
}

nook_result nook_occluders_renew(nook_world *world)
{
    nook_result result = nook_world_replace_system(world, &nook_clear_occluders);
    return result == NOOK_OK ? nook_world_replace_system(world, &nook_collect_occluders) : result;
}

static void clear_occluders(const nook_rows *rows)
{
    nook_occluder_list *list = rows->resources[0];
    list->count = 0;
    list->dropped = 0;
}

static void collect_occluders(const nook_rows *rows)
{
    const nook_transform *transform = rows->columns[0];
    const nook_volume_occluder *occluder = rows->columns[1];
    nook_occluder_list *list = rows->resources[0];

    for (uint32_t i = 0; i < rows->count; i++) {
        if (occluder[i].volume.id == 0 && occluder[i].mesh.id == 0)
            continue;
        if (list->count == list->capacity) {
            list->dropped++;
            continue;
        }
        nook_ao_occluder *item = &list->items[list->count++];
        item->volume = occluder[i].volume;
        item->mesh = occluder[i].mesh;
        memcpy(item->world_from_mesh, transform[i].world_from_local, sizeof item->world_from_mesh);
    }
}

const nook_system nook_clear_occluders = {
    .name = "ao.clear_occluders",
    .phase = NOOK_PHASE_PRE_RENDER,
    .resources = { NOOK_TYPE(nook_occluder_list) },
    .run = clear_occluders,
};

const nook_system nook_collect_occluders = {
    .name = "ao.collect_occluders",
    .phase = NOOK_PHASE_PRE_RENDER,
    .reads = { NOOK_TYPE(nook_transform), NOOK_TYPE(nook_volume_occluder) },
    .resources = { NOOK_TYPE(nook_occluder_list) },
    .run = collect_occluders,
};
