#include "modules/ao/direction_texture.h"
#include "engine/core/log.h"
#include "modules/ao/sampling.h"
#include <stdlib.h>

void nook_direction_texture_release(nook_direction_texture *directions, nook_gpu *gpu)
{
    nook_texture_destroy(gpu, &directions->texture);
    free(directions->values);
    *directions = (nook_direction_texture){ 0 };
}

/** Views of several ray counts take turns in every frame: room is made once. */
static nook_result make_room(nook_direction_texture *directions, nook_gpu *gpu, uint32_t rays)
{
    if (directions->texture.id && directions->texture.width >= rays)
        return NOOK_OK;
    nook_direction_texture_release(directions, gpu);
    directions->values = malloc((size_t)rays * NOOK_DIRECTION_BLOCKS * 4 * sizeof *directions->values);
    if (!directions->values)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u ray directions", rays);
    return nook_texture_create_2d(gpu, GL_RGBA32F, rays, NOOK_DIRECTION_BLOCKS, GL_NEAREST, &directions->texture);
}

nook_result nook_direction_texture_fit(nook_direction_texture *directions, nook_gpu *gpu, uint32_t rays, uint32_t seed)
{
    if (directions->texture.id && directions->rays == rays && directions->seed == seed)
        return NOOK_OK;
    nook_result result = make_room(directions, gpu, rays);
    if (result != NOOK_OK)
        return result;
    nook_fill_directions(rays, seed, directions->values);
    gpu->gl->TextureSubImage2D(directions->texture.id, 0, 0, 0, (GLsizei)rays, NOOK_DIRECTION_BLOCKS, GL_RGBA, GL_FLOAT,
                               directions->values);
    directions->rays = rays;
    directions->seed = seed;
    return NOOK_OK;
}
