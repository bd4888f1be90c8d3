#include "modules/ao/direction_texture.h"
#include "engine/core/log.h"
#include "modules/ao/sampling.h"
#include <stdlib.h>

void nook_direction_texture_release(nook_direction_texture *directions, nook_gpu *gpu)
{
    nook_texture_destroy(gpu, &directions->texture);
    *directions = (nook_direction_texture){ 0 };
}

nook_result nook_direction_texture_fit(nook_direction_texture *directions, nook_gpu *gpu, uint32_t rays, uint32_t seed)
{
    if (directions->texture.id && directions->rays == rays && directions->seed == seed)
        return NOOK_OK;
    float *values = malloc((size_t)rays * NOOK_DIRECTION_BLOCKS * 4 * sizeof *values);
    if (!values)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u ray directions", rays);
    nook_result result = NOOK_OK;
    if (!directions->texture.id || directions->rays != rays) {
        nook_direction_texture_release(directions, gpu);
        result = nook_texture_create_2d(gpu, GL_RGBA32F, rays, NOOK_DIRECTION_BLOCKS, GL_NEAREST, &directions->texture);
    }
    if (result == NOOK_OK) {
        nook_fill_directions(rays, seed, values);
        gpu->gl->TextureSubImage2D(directions->texture.id, 0, 0, 0, (GLsizei)rays, NOOK_DIRECTION_BLOCKS, GL_RGBA,
                                   GL_FLOAT, values);
        directions->rays = rays;
        directions->seed = seed;
    }
    free(values);
    return result;
}
