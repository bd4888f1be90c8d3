#include "modules/ao/direction_texture.h"
#include "engine/core/log.h"
#include "modules/ao/sampling.h"
#include <stdlib.h>

void nook_direction_texture_release(nook_direction_texture *directions, nook_gpu *gpu)
{
    nook_texture_destroy(gpu, &directions->texture);
    nook_buffer_destroy(gpu, &directions->buffer);
    free(directions->values);
    *directions = (nook_direction_texture){ 0 };
}

static size_t bytes_of(uint32_t rays)
{
    return (size_t)rays * NOOK_DIRECTION_BLOCKS * 4 * sizeof(float);
}

/** Views of several ray counts take turns in every frame: room is made once. */
static nook_result make_room(nook_direction_texture *directions, nook_gpu *gpu, uint32_t rays)
{
    if (directions->room >= rays)
        return NOOK_OK;
    nook_direction_texture_release(directions, gpu);
    directions->values = malloc(bytes_of(rays));
    if (!directions->values)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u ray directions", rays);
    nook_result result = nook_buffer_create(gpu, NULL, bytes_of(rays), &directions->buffer);
    if (result == NOOK_OK)
        result = nook_texture_create_buffer(gpu, GL_RGBA32F, directions->buffer, &directions->texture);
    if (result == NOOK_OK)
        directions->room = rays;
    return result;
}

nook_result nook_direction_texture_fit(nook_direction_texture *directions, nook_gpu *gpu, uint32_t rays, uint32_t seed,
                                       uint32_t part)
{
    if (directions->room && directions->rays == rays && directions->seed == seed && directions->part == part)
        return NOOK_OK;
    nook_result result = make_room(directions, gpu, rays);
    if (result != NOOK_OK)
        return result;
    nook_fill_directions(rays, seed, part, directions->values);
    nook_buffer_update(gpu, directions->buffer, 0, directions->values, bytes_of(rays));
    directions->rays = rays;
    directions->seed = seed;
    directions->part = part;
    return NOOK_OK;
}
