#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include "modules/ao/frame_block_internal.h"
#include <math.h>
#include <stdio.h>
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
        result = nook_buffer_create(ao->gpu, NULL, sizeof(ao_counts), &ao->counter);
    return result;
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
    if (result != NOOK_OK)
        return result;
    nook_ao *ao = calloc(1, sizeof *ao);
    if (!ao)
        return nook_fail(NOOK_E_MEMORY, "nook_ao: no memory");
    ao->gpu = desc->gpu;
    ao->width = desc->width, ao->height = desc->height;
    ao->progress = desc->progress ? desc->progress : no_progress;
    ao->progress_user = desc->progress_user;
    ao->occluder_max = desc->max_occluders ? desc->max_occluders : AO_OCCLUDER_DEFAULT;
    ao->next_mesh_id = 1;
    nook_param_reset(ao_shared_table, NOOK_COUNT(ao_shared_table), &ao->shared);
    volume_atlas_init(&ao->atlas, ao->gpu);
    result =
        allocate_lists(ao) ? create_buffers(ao, sizeof(frame_block)) : nook_fail(NOOK_E_MEMORY, "nook_ao: no memory");
    if (result != NOOK_OK) {
        nook_ao_destroy(ao);
        return result;
    }
    *out_ao = ao;
    return NOOK_OK;
}

static void release_slot(nook_ao *ao, ao_slot *slot)
{
    if (slot->technique->destroy)
        slot->technique->destroy(slot->state, ao->gpu);
    nook_buffer_destroy(ao->gpu, &slot->buffer);
    free(slot->state);
    free(slot->params);
}

void nook_ao_destroy(nook_ao *ao)
{
    if (!ao)
        return;
    for (uint32_t i = 0; i < ao->slot_count; i++)
        release_slot(ao, &ao->slots[i]);
    ao_targets_release(ao->gpu, &ao->targets);
    volume_atlas_release(&ao->atlas);
    ao_meshes_release(ao);
    nook_buffer_destroy(ao->gpu, &ao->frame);
    nook_buffer_destroy(ao->gpu, &ao->occluder_buffer);
    nook_buffer_destroy(ao->gpu, &ao->counter);
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

/** A std140 block's size is a multiple of 16, and a buffer must cover the whole block. */
static size_t block_size(size_t size)
{
    return size ? (size + 15) / 16 * 16 : 16;
}

/** Its name is the first part of its parameters' names: it must be told from the others and from "ao". */
static nook_result check_name(const nook_ao *ao, const char *name)
{
    int taken = strcmp(name, "ao") == 0;
    for (uint32_t i = 0; i < ao->slot_count; i++)
        taken = taken || strcmp(ao->slots[i].technique->name, name) == 0;
    if (taken || !*name || name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_")])
        return nook_fail(NOOK_E_ARG, "technique \"%s\": the name is taken, or not of a-z, 0-9 and _", name);
    return NOOK_OK;
}

/** A shader that was read after its params.def has changed must not meet the struct of before. */
static nook_result expect_params(nook_ao *ao, const nook_ao_technique *technique)
{
    char path[128];
    snprintf(path, sizeof path, "modules/ao_%s/params.def", technique->name);
    return nook_gpu_expect_params(ao->gpu, path, technique->params, technique->param_count);
}

nook_result nook_ao_add_technique(nook_ao *ao, const struct nook_ao_technique *technique)
{
    if (technique->version != NOOK_AO_TECHNIQUE_VERSION)
        return nook_fail(NOOK_E_VERSION, "technique %s: made for version %u, this build takes %d", technique->name,
                         technique->version, NOOK_AO_TECHNIQUE_VERSION);
    if (ao->slot_count == AO_TECHNIQUE_MAX)
        return nook_fail(NOOK_E_MEMORY, "technique %s: %d techniques are the most", technique->name, AO_TECHNIQUE_MAX);
    nook_result result = check_name(ao, technique->name);
    if (result != NOOK_OK)
        return result;
    ao_slot slot = { .technique = technique };
    slot.state = calloc(1, technique->state_size ? technique->state_size : 1);
    slot.params = calloc(1, block_size(technique->params_size));
    result = slot.state && slot.params ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "technique %s: no memory", technique->name);
    if (result == NOOK_OK) {
        nook_param_reset(technique->params, technique->param_count, slot.params);
        result = nook_buffer_create(ao->gpu, slot.params, block_size(technique->params_size), &slot.buffer);
    }
    if (result == NOOK_OK)
        result = expect_params(ao, technique);
    if (result == NOOK_OK && technique->create)
        result = technique->create(slot.state, ao->gpu);
    if (result != NOOK_OK) {
        nook_buffer_destroy(ao->gpu, &slot.buffer);
        free(slot.state);
        free(slot.params);
        return result;
    }
    ao->slots[ao->slot_count++] = slot;
    return NOOK_OK;
}

nook_result nook_ao_add_volume(nook_ao *ao, const char *name, const void *bytes, size_t size,
                               nook_ao_volume *out_volume)
{
    nook_volume volume;
    uint32_t id = 0;
    nook_result result = nook_volume_decode(name, bytes, size, &volume);
    if (result != NOOK_OK)
        return result;
    result = volume_atlas_add(&ao->atlas, &volume, &id);
    if (result != NOOK_OK) {
        nook_volume_free(&volume);
        return result;
    }
    out_volume->id = id;
    return NOOK_OK;
}

void nook_ao_remove_volume(nook_ao *ao, nook_ao_volume volume)
{
    volume_atlas_remove(&ao->atlas, volume.id);
}

nook_result nook_ao_submit_occluders(nook_ao *ao, const nook_ao_occluder *occluders, uint32_t count)
{
    if (count > ao->occluder_max)
        return nook_fail(NOOK_E_ARG, "%u occluders: the context was made for %u (nook_ao_desc.max_occluders)", count,
                         ao->occluder_max);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t volume = occluders[i].volume.id, mesh = occluders[i].mesh.id;
        if ((volume && !volume_atlas_find(&ao->atlas, volume)) || (mesh && ao_mesh_index(ao, mesh) == UINT32_MAX))
            return nook_fail(NOOK_E_ARG, "occluder %u of %u: its volume %u or mesh %u has been removed", i, count,
                             volume, mesh);
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
