#include "modules/ao_volume/volume.h"
#include "modules/ao/direction_texture.h"

#define NOOK_PARAM_STRUCT volume_params
#define NOOK_PARAM_FILE "modules/ao_volume/params.def"
#include "engine/core/param_block.inl"

enum { COMBINE_MULTIPLY = 0 };
enum { TILE_SIZE = 8, BINDING_DIRECTIONS = 4, BINDING_VISIBILITY = 0, BINDING_SUM = 1, LOCATION_PART = 0 };

/**
 * llvmpipe ends all loops of an invocation without a word after 65535 turns in sum, and a GPU that works for seconds on one
 * dispatch is reset: the work is cut into dispatches. A ray at an occluder takes up to TURNS_PER_MISS when it misses the box, and
 * one more per sample when it meets it; one ray meets no more than BOXES_PER_RAY.
 */
enum { TURNS_PER_DISPATCH = 60000, TURNS_PER_MISS = 3, BOXES_PER_RAY = 16, RAYS_PER_DISPATCH = 64 };

typedef struct volume_state {
    nook_direction_texture directions;
    nook_texture sum; /**< R32F of the trace's size; id 0 until an occluder's rays take several dispatches. */
} volume_state;

static void destroy(void *state, nook_gpu *gpu)
{
    volume_state *s = state;
    nook_direction_texture_release(&s->directions, gpu);
    nook_texture_destroy(gpu, &s->sum);
}

static uint32_t at_least(uint32_t lowest, uint32_t value)
{
    return value > lowest ? value : lowest;
}

static uint32_t at_most(uint32_t highest, uint32_t value)
{
    return value < highest ? value : highest;
}

/** How the work is cut: rays and occluders of one dispatch. */
typedef struct volume_cut {
    uint32_t rays, occluders;
} volume_cut;

/**
 * Union needs all occluders of a ray at once, so it is cut into groups of rays. The product needs all rays of an occluder, so it
 * is cut into groups of occluders; rays are cut only when those of a single occluder are too many (fit_sum).
 */
static volume_cut choose_cut(const volume_params *params, uint32_t occluders)
{
    uint32_t rays = (uint32_t)params->rays, steps = (uint32_t)params->steps;
    if (params->combine != COMBINE_MULTIPLY) {
        uint32_t turns = occluders * TURNS_PER_MISS + at_most(BOXES_PER_RAY, occluders) * steps;
        return (volume_cut){ at_most(RAYS_PER_DISPATCH, at_least(1, TURNS_PER_DISPATCH / turns)), occluders };
    }
    uint32_t turns_per_occluder = TURNS_PER_MISS + steps, occluder_turns = TURNS_PER_DISPATCH / rays;
    if (occluder_turns < turns_per_occluder)
        return (volume_cut){ TURNS_PER_DISPATCH / turns_per_occluder, 1 };
    uint32_t all_met = occluder_turns / turns_per_occluder;
    if (all_met < BOXES_PER_RAY)
        return (volume_cut){ rays, all_met };
    return (volume_cut){ rays, (occluder_turns - BOXES_PER_RAY * steps) / TURNS_PER_MISS };
}

static void dispatch_parts(const nook_ao_pass *pass, uint32_t rays, volume_cut cut, nook_program program)
{
    uint32_t occluders = pass->occluder_count;
    for (uint32_t first = 0; first < occluders; first += cut.occluders) {
        for (uint32_t ray = 0; ray < rays; ray += cut.rays) {
            const GLint part[4] = { (GLint)ray, (GLint)at_most(rays, ray + cut.rays), (GLint)first,
                                    (GLint)at_most(occluders, first + cut.occluders) };
            pass->gpu->gl->ProgramUniform4iv(program.id, LOCATION_PART, 1, part);
            nook_dispatch(pass->gpu, program, nook_groups(pass->width, TILE_SIZE), nook_groups(pass->height, TILE_SIZE),
                          1);
        }
    }
}

/** Where the sum over an occluder's rays is kept from one dispatch to the next. */
static nook_result fit_sum(volume_state *s, const nook_ao_pass *pass)
{
    if (s->sum.id && s->sum.width == pass->width && s->sum.height == pass->height)
        return NOOK_OK;
    nook_texture_destroy(pass->gpu, &s->sum);
    return nook_texture_create_2d(pass->gpu, GL_R32F, pass->width, pass->height, GL_NEAREST, &s->sum);
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
    volume_cut cut = choose_cut(p, pass->occluder_count);
    if (p->combine == COMBINE_MULTIPLY && cut.rays < (uint32_t)p->rays) {
        result = fit_sum(s, pass);
        if (result != NOOK_OK)
            return result;
        nook_bind_image(pass->gpu, BINDING_SUM, s->sum, GL_READ_WRITE);
    }
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    nook_bind_image(pass->gpu, BINDING_VISIBILITY, pass->visibility, GL_READ_WRITE);
    dispatch_parts(pass, (uint32_t)p->rays, cut, program);
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
    .state_version = 2,
    .destroy = destroy,
    .record = record,
};
