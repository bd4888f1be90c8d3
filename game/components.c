#include "game/components.h"

nook_result nook_components_register(nook_world *world, nook_components *out_components)
{
    nook_components ids = { { 0 }, { 0 }, { 0 }, { 0 } };
    nook_result result = nook_world_component(world, NOOK_TYPE_OF(nook_transform), &ids.transform);
    if (result == NOOK_OK)
        result = nook_world_component(world, NOOK_TYPE_OF(nook_rigid_body), &ids.rigid_body);
    if (result == NOOK_OK)
        result = nook_world_component(world, NOOK_TYPE_OF(nook_renderable), &ids.renderable);
    if (result == NOOK_OK)
        result = nook_world_component(world, NOOK_TYPE_OF(nook_volume_occluder), &ids.volume_occluder);
    if (result == NOOK_OK)
        *out_components = ids;
    return result;
}
