#include "modules/ao_volume/volume.h"
#include "modules/ao/direction_texture.h"

#define NOOK_PARAM_STRUCT volume_params
#define NOOK_PARAM_FILE "modules/ao_volume/params.def"
#include "engine/core/param_block.inl"

enum { TILE_SIZE = 8, BINDING_DIRECTIONS = 4 };

typedef struct volume_state {
    nook_direction_texture directions;
} volume_state;

static void destroy(void *state, nook_gpu *gpu)
{
    volume_state *s = state;
    nook_direction_texture_release(&s->directions, gpu);
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
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    return nook_ao_pass_dispatch(pass, "shaders/ao/volume.comp.glsl", TILE_SIZE, TILE_SIZE);
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
