#include "modules/ao_volume/volume.h"
#include "modules/ao/direction_texture.h"

#define NOOK_PARAM_STRUCT volume_params
#define NOOK_PARAM_FILE "modules/ao_volume/params.def"
#include "engine/core/param_block.inl"

enum { TILE_SIZE = 8, BINDING_DIRECTIONS = 4, BINDING_VISIBILITY = 0, LOCATION_PART = 0, COMBINE_MULTIPLY = 0 };

/**
 * llvmpipe ends all loops of an invocation without a word after 65535 turns in sum, and a GPU that works for seconds on one
 * dispatch is reset: the work is cut into dispatches. A ray at an occluder takes a few turns when it misses the box, and one per
 * sample when it meets it; few boxes are met by one ray.
 */
enum { TURNS_PER_DISPATCH = 60000, TURNS_PER_RAY = 24, RAYS_PER_DISPATCH = 64 };

typedef struct volume_state {
    nook_direction_texture directions;
} volume_state;

static void destroy(void *state, nook_gpu *gpu)
{
    volume_state *s = state;
    nook_direction_texture_release(&s->directions, gpu);
}

static uint32_t at_least(uint32_t lowest, uint32_t value)
{
    return value > lowest ? value : lowest;
}

static uint32_t at_most(uint32_t highest, uint32_t value)
{
    return value < highest ? value : highest;
}

/** Union needs all occluders of a ray at once, so it is cut into groups of rays; the product is cut into groups of occluders. */
static void dispatch_parts(const nook_ao_pass *pass, const volume_params *params, nook_program program)
{
    uint32_t rays = (uint32_t)params->rays, occluders = pass->occluder_count;
    uint32_t ray_step = rays, occluder_step = occluders;
    if (params->combine == COMBINE_MULTIPLY)
        occluder_step = at_least(1, TURNS_PER_DISPATCH / (rays * TURNS_PER_RAY));
    else
        ray_step = at_most(RAYS_PER_DISPATCH, at_least(1, TURNS_PER_DISPATCH / (occluders * TURNS_PER_RAY)));
    for (uint32_t ray = 0; ray < rays; ray += ray_step) {
        for (uint32_t first = 0; first < occluders; first += occluder_step) {
            const GLint part[4] = { (GLint)ray, (GLint)at_most(rays, ray + ray_step), (GLint)first,
                                    (GLint)at_most(occluders, first + occluder_step) };
            pass->gpu->gl->ProgramUniform4iv(program.id, LOCATION_PART, 1, part);
            nook_dispatch(pass->gpu, program, nook_groups(pass->width, TILE_SIZE), nook_groups(pass->height, TILE_SIZE),
                          1);
        }
    }
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    volume_state *s = state;
    const volume_params *p = params;
    if (pass->occluder_count == 0 || pass->volume_atlas.id == 0) {
        const float open[4] = { 1.0f, 1.0f, 1.0f, 1.0f };
        pass->gpu->gl->ClearTexImage(pass->visibility.id, 0, GL_RGBA, GL_FLOAT, open);
        return NOOK_OK;
    }
    nook_result result = nook_direction_texture_fit(&s->directions, pass->gpu, (uint32_t)p->rays, pass->seed);
    if (result != NOOK_OK)
        return result;
    nook_program program;
    result = nook_program_compute(pass->gpu, "shaders/ao/volume.comp.glsl", "", &program);
    if (result != NOOK_OK)
        return result;
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    nook_bind_image(pass->gpu, BINDING_VISIBILITY, pass->visibility, GL_READ_WRITE);
    dispatch_parts(pass, p, program);
    return NOOK_OK;
}

const nook_ao_technique nook_ao_volume_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "volume",
    .summary = "Rays marched through precomputed voxel volumes; sees what the camera does not",
    .inputs = NOOK_AO_IN_VOLUMES,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(volume_params),
    .state_size = sizeof(volume_state),
    .state_version = 1,
    .destroy = destroy,
    .record = record,
};
