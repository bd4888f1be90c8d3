#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include "modules/ao/frame_block_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void no_progress(void *user, double fraction)
{
    (void)user, (void)fraction;
}

static nook_result check_size(uint32_t width, uint32_t height, uint32_t limit)
{
    if (width == 0 || height == 0 || width > limit || height > limit)
        return nook_fail(NOOK_E_ARG, "ambient occlusion at %ux%u pixels: give 1 to %u", width, height, limit);
    return NOOK_OK;
}

/* The list of occluders is a texture buffer. */
static nook_result check_occluder_max(const nook_gpu *gpu, uint32_t occluder_max)
{
    const uint32_t most = gpu->max_texture_buffer_size / (sizeof(ao_gpu_occluder) / (4 * sizeof(float)));
    if (occluder_max <= most)
        return NOOK_OK;
    return nook_fail(NOOK_E_ARG, "nook_ao: %u occluders (nook_ao_desc.max_occluders); this device takes %u",
                     occluder_max, most);
}

static int allocate_lists(nook_ao *ao)
{
    ao->occluders = calloc(ao->occluder_max, sizeof *ao->occluders);
    ao->gpu_occluders = calloc(ao->occluder_max, sizeof *ao->gpu_occluders);
    ao->instances = calloc(ao->occluder_max, sizeof *ao->instances);
    ao->instance_occluders = calloc(ao->occluder_max, sizeof *ao->instance_occluders);
    return ao->occluders && ao->gpu_occluders && ao->instances && ao->instance_occluders;
}

static nook_result create_buffers(nook_ao *ao, size_t frame_size)
{
    nook_result result = nook_buffer_create(ao->gpu, NULL, frame_size, &ao->frame);
    if (result == NOOK_OK)
        result = nook_buffer_create(ao->gpu, NULL, ao->occluder_max * sizeof(ao_gpu_occluder), &ao->occluder_buffer);
    if (result == NOOK_OK)
        result = nook_texture_create_buffer(ao->gpu, GL_RGBA32F, ao->occluder_buffer, &ao->occluder_texture);
    if (result == NOOK_OK)
        result = ao_bins_create(ao->gpu, ao->occluder_max, &ao->bins);
    if (result == NOOK_OK)
        result = nook_buffer_create(ao->gpu, NULL, sizeof(ao_counts), &ao->counter);
    return result;
}

static void create_sampler(nook_ao *ao)
{
    const nook_gl *gl = ao->gpu->gl;
    gl->CreateSamplers(1, &ao->nearest_sampler);
    gl->SamplerParameteri(ao->nearest_sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->SamplerParameteri(ao->nearest_sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->SamplerParameteri(ao->nearest_sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->SamplerParameteri(ao->nearest_sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    /* As our textures have it: llvmpipe compiles a program again when it is run after another sampler, even if it reads nothing of it. */
    gl->SamplerParameteri(ao->nearest_sampler, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

nook_result nook_ao_create(const nook_ao_desc *desc, nook_ao **out_ao)
{
    *out_ao = NULL;
    if (desc->version != NOOK_AO_VERSION)
        return nook_fail(NOOK_E_VERSION, "nook_ao: made for version %d, the host asks for %u", NOOK_AO_VERSION,
                         desc->version);
    if (!desc->gpu)
        return nook_fail(NOOK_E_ARG, "nook_ao: desc.gpu is missing");
    nook_result result = check_size(desc->width, desc->height, desc->gpu->max_texture_size);
    if (result == NOOK_OK)
        result = check_occluder_max(desc->gpu, desc->max_occluders);
    if (result != NOOK_OK)
        return result;
    nook_ao *ao = calloc(1, sizeof *ao);
    if (!ao)
        return nook_fail(NOOK_E_MEMORY, "nook_ao: no memory");
    ao->gpu = desc->gpu;
    ao->width = desc->width, ao->height = desc->height;
    nook_ao_set_progress(ao, desc->progress, desc->progress_user);
    ao->occluder_max = desc->max_occluders ? desc->max_occluders : AO_OCCLUDER_DEFAULT;
    ao->next_mesh_id = 1;
    nook_param_reset(ao_shared_table, NOOK_COUNT(ao_shared_table), &ao->shared);
    ao->next_volume_id = 1;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        volume_atlas_init(&ao->atlases[kind], ao->gpu);
    brick_pool_init(&ao->pool, ao->gpu);
    create_sampler(ao);
    result =
        allocate_lists(ao) ? create_buffers(ao, sizeof(frame_block)) : nook_fail(NOOK_E_MEMORY, "nook_ao: no memory");
    if (result != NOOK_OK) {
        nook_ao_destroy(ao);
        return result;
    }
    *out_ao = ao;
    return NOOK_OK;
}

void nook_ao_destroy(nook_ao *ao)
{
    if (!ao)
        return;
    for (uint32_t i = 0; i < ao->slot_count; i++)
        ao_slot_release(ao, &ao->slots[i]);
    ao_targets_release(ao->gpu, &ao->targets);
    ao_refine_release(ao->gpu, &ao->refine);
    ao_reuse_release(ao);
    ao_bins_release(ao->gpu, &ao->bins);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        volume_atlas_release(&ao->atlases[kind]);
    brick_pool_release(&ao->pool);
    ao_meshes_release(ao);
    ao_voxelizer_release(ao);
    nook_buffer_destroy(ao->gpu, &ao->frame);
    ao->gpu->gl->DeleteSamplers(1, &ao->nearest_sampler);
    nook_texture_destroy(ao->gpu, &ao->occluder_texture);
    nook_buffer_destroy(ao->gpu, &ao->occluder_buffer);
    nook_buffer_destroy(ao->gpu, &ao->counter);
    free(ao->volume_ids);
    free(ao->occluders);
    free(ao->gpu_occluders);
    free(ao->instances);
    free(ao->instance_occluders);
    free(ao);
}

nook_result nook_ao_set_size(nook_ao *ao, uint32_t width, uint32_t height)
{
    nook_result result = check_size(width, height, ao->gpu->max_texture_size);
    if (result == NOOK_OK)
        ao->width = width, ao->height = height;
    return result;
}

void nook_ao_set_progress(nook_ao *ao, void (*progress)(void *user, double fraction), void *user)
{
    ao->progress = progress ? progress : no_progress;
    ao->progress_user = user;
}

static const double AFFINE_TOLERANCE = 1e-5; /* as a camera's: what a product of a few matrices in float leaves */

/* Where a matrix of rows has its translation; zeros are a singular one, which is left out. */
static bool is_affine(const double m[16])
{
    return !(fabs(m[3]) > AFFINE_TOLERANCE || fabs(m[7]) > AFFINE_TOLERANCE || fabs(m[11]) > AFFINE_TOLERANCE);
}

nook_result nook_ao_submit_occluders(nook_ao *ao, const nook_ao_occluder *occluders, uint32_t count)
{
    if (count > ao->occluder_max)
        return nook_fail(NOOK_E_ARG, "%u occluders: the context was made for %u (nook_ao_desc.max_occluders)", count,
                         ao->occluder_max);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t volume = occluders[i].volume.id, mesh = occluders[i].mesh.id;
        if ((volume && !ao_volume_id_is_known(ao, volume)) || (mesh && ao_mesh_index(ao, mesh) == UINT32_MAX))
            return nook_fail(NOOK_E_ARG, "occluder %u of %u: its volume %u or mesh %u has been removed", i, count,
                             volume, mesh);
        if (!is_affine(occluders[i].world_from_mesh))
            return nook_fail(NOOK_E_ARG,
                             "occluder %u of %u: world_from_mesh is not affine, its last row begins with %g, %g, %g; "
                             "matrices are column-major",
                             i, count, occluders[i].world_from_mesh[3], occluders[i].world_from_mesh[7],
                             occluders[i].world_from_mesh[11]);
    }
    if (count)
        memcpy(ao->occluders, occluders, count * sizeof *occluders);
    ao->occluder_count = count;
    return NOOK_OK;
}

nook_ao_texture nook_ao_visibility(const nook_ao *ao)
{
    const nook_texture *texture = &ao->targets.visibility;
    return (nook_ao_texture){ texture->id, texture->width, texture->height };
}
