#include "modules/ao_hao/hao.h"
#include "modules/ao/direction_texture.h"
#include "modules/ao_hao/voxels_internal.h"
#include <math.h>

#define NOOK_PARAM_STRUCT hao_params
#define NOOK_PARAM_FILE "modules/ao_hao/params.def"
#include "engine/core/param_block.inl"

enum { BINDING_GRID = 2, BINDING_ALONG_Z = 2, BINDING_ALONG_X = 3, BINDING_DIRECTIONS = 4, BINDING_ALONG_Y = 5 };
enum { SLICEMAPS_ONE, SLICEMAPS_THREE };

/** Uniform block Grid of shaders/ao/hao.glsl, std140. */
typedef struct grid_block {
    float voxel_from_view[3][4]; /**< Rows. */
    int32_t size[4];             /**< Voxels; w unused. */
    float tile[4];               /**< Of the noise: where its tile has the grid's voxel (0, 0, 0); w: metres a voxel. */
} grid_block;

_Static_assert(sizeof(grid_block) == 80, "std140 places size at 48 and tile at 64");

typedef struct hao_state {
    nook_direction_texture directions;
    hao_meshes meshes;
    hao_voxels voxels;
    nook_buffer grid;
} hao_state;

static const double NOISE_TILE = 256.0; /* voxels after which the noise repeats, as the paper's texture does */

static nook_result create(void *state, nook_gpu *gpu)
{
    hao_state *s = state;
    return nook_buffer_create(gpu, NULL, sizeof(grid_block), &s->grid);
}

static void destroy(void *state, nook_gpu *gpu)
{
    hao_state *s = state;
    nook_direction_texture_release(&s->directions, gpu);
    hao_meshes_release(&s->meshes, gpu);
    hao_voxels_release(&s->voxels, gpu);
    nook_buffer_destroy(gpu, &s->grid);
}

static grid_block block_of(const hao_grid *grid)
{
    grid_block block = { .tile = { 0.0f, 0.0f, 0.0f, (float)grid->voxel_size } };
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            block.voxel_from_view[row][column] = (float)grid->voxel_from_view.m[column * 4 + row];
        block.size[row] = (int32_t)grid->size[row];
        block.tile[row] = (float)(grid->first[row] - floor(grid->first[row] / NOISE_TILE) * NOISE_TILE);
    }
    return block;
}

/** Everything that the trace reads. */
static nook_result prepare(hao_state *s, const hao_params *p, const nook_ao_pass *pass)
{
    nook_result result = nook_direction_texture_fit(&s->directions, pass->gpu, (uint32_t)p->rays, pass->seed, 0);
    if (result == NOOK_OK)
        result = hao_meshes_update(&s->meshes, pass);
    if (result == NOOK_OK)
        result = hao_voxels_update(&s->voxels, pass, &s->meshes, (uint32_t)p->voxels,
                                   p->slicemaps == SLICEMAPS_THREE ? 3 : 1, (double)p->far * pass->r_max);
    return result;
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    hao_state *s = state;
    const hao_params *p = params;
    const nook_slicemap *maps = s->voxels.maps;
    nook_result result = prepare(s, p, pass);
    if (result != NOOK_OK)
        return result;
    const grid_block block = block_of(&s->voxels.grid);
    nook_buffer_update(pass->gpu, s->grid, 0, &block, sizeof block);
    nook_bind_uniform(pass->gpu, BINDING_GRID, s->grid);
    nook_bind_texture(pass->gpu, BINDING_ALONG_Z, maps[2].bits);
    nook_bind_texture(pass->gpu, BINDING_DIRECTIONS, s->directions.texture);
    const char *shader = "shaders/ao/hao.comp.glsl";
    if (p->slicemaps == SLICEMAPS_THREE) {
        shader = "shaders/ao/hao_three.comp.glsl";
        nook_bind_texture(pass->gpu, BINDING_ALONG_X, maps[0].bits);
        nook_bind_texture(pass->gpu, BINDING_ALONG_Y, maps[1].bits);
    }
    return nook_ao_pass_dispatch_parts(pass, shader, 16, 8, p->rays, 1 + p->tests);
}

const nook_ao_technique nook_ao_hao_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "hao",
    .summary =
        "Rays through voxels of the whole scene that are made anew in every frame; sees what the camera does not",
    .inputs = NOOK_AO_IN_MESHES,
    .params = param_table,
    .param_count = NOOK_COUNT(param_table),
    .params_size = sizeof(hao_params),
    .state_size = sizeof(hao_state),
    .state_version = 3,
    .create = create,
    .destroy = destroy,
    .record = record,
};
