#include "modules/ao/inspect.h"
#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <stdlib.h>
#include <string.h>

enum { TILE_SIZE = 8, LOCATION_COUNT = 0 };

nook_result nook_ao_inspect_volume(nook_ao *ao, nook_ao_volume volume, nook_ao_volume_place *out_place)
{
    volume_atlas *atlas = &ao->atlases[NOOK_VOLUME_BINARY];
    nook_result result = ao_ask_for_volumes(ao, NOOK_VOLUME_BIT(NOOK_VOLUME_BINARY));
    if (!volume_atlas_find(atlas, volume.id))
        atlas = &ao->atlases[NOOK_VOLUME_DENSITY];
    if (result == NOOK_OK)
        result = volume_atlas_flush(atlas);
    if (result != NOOK_OK)
        return result;
    if (!ao_volume_id_is_known(ao, volume.id))
        return nook_fail(NOOK_E_NOT_FOUND, "volume %u has been removed", volume.id);
    const atlas_entry *entry = volume_atlas_find(atlas, volume.id);
    if (!entry) {
        *out_place = (nook_ao_volume_place){ .voxel_size = 0.0 };
        return NOOK_OK;
    }
    nook_ao_volume_place place = { .atlas = atlas->texture, .voxel_size = entry->info.voxel_size };
    for (int axis = 0; axis < 3; axis++) {
        place.origin[axis] = entry->box.origin[axis];
        place.size[axis] = entry->box.size[axis];
        place.corner[axis] = entry->info.origin[axis];
    }
    *out_place = place;
    return NOOK_OK;
}

static void dispatch_count(nook_ao *ao, const nook_ao_pass *pass, nook_program program, nook_texture counts)
{
    uint32_t groups[2];
    nook_bind_uniform(ao->gpu, 0, pass->frame);
    nook_bind_texture(ao->gpu, 0, pass->depth);
    nook_bind_texture(ao->gpu, 3, pass->occluder_texture);
    nook_bind_image(ao->gpu, 0, counts, GL_WRITE_ONLY);
    nook_program_use(ao->gpu, program);
    nook_uniform_int(ao->gpu, LOCATION_COUNT, &(const int32_t){ (int32_t)pass->occluder_count }, 1);
    nook_ao_pass_groups(pass, TILE_SIZE, TILE_SIZE, groups);
    nook_dispatch(ao->gpu, program, groups[0], groups[1], 1);
}

nook_result nook_ao_count_occluders(nook_ao *ao, const nook_ao_frame *frame, nook_ao_texture out_counts)
{
    const ao_work work = { .inputs = NOOK_AO_IN_VOLUMES, .kinds = AO_EVERY_KIND };
    nook_ao_pass pass;
    nook_program program;
    if (out_counts.native == 0 || out_counts.width != ao->width || out_counts.height != ao->height)
        return nook_fail(NOOK_E_ARG, "nook_ao_count_occluders: the texture is %ux%u, the context %ux%u",
                         out_counts.width, out_counts.height, ao->width, ao->height);
    nook_result result = ao_begin(ao, frame, &work, &pass);
    if (result == NOOK_OK)
        result = nook_program_compute(ao->gpu, "shaders/ao/occluder_count.comp.glsl", "", &program);
    if (result != NOOK_OK)
        return result;
    nook_texture counts = ao_host_texture(out_counts);
    counts.format = GL_R32UI;
    dispatch_count(ao, &pass, program, counts);
    return nook_gpu_check(ao->gpu, "nook_ao_count_occluders") ? NOOK_E_DEVICE : NOOK_OK;
}

/* ---- Snapshots -------------------------------------------------------------------------------------------------- */

/** Never NULL for nothing. */
static void *copy_of(const void *items, size_t count, size_t size)
{
    void *copy = calloc(count + 1, size);
    if (copy && count)
        memcpy(copy, items, count * size);
    return copy;
}

nook_result nook_ao_snapshot_take(nook_ao *ao, const nook_ao_frame *frame, nook_ao_snapshot *out_snapshot)
{
    const ao_work work = { .inputs = NOOK_AO_IN_MESHES };
    nook_ao_snapshot s = { 0 };
    *out_snapshot = s;
    nook_result result = ao_begin(ao, frame, &work, &s.pass);
    if (result != NOOK_OK)
        return result;
    size_t pixels = (size_t)s.pass.width * s.pass.height;
    s.depth = malloc(pixels * sizeof *s.depth);
    s.normal = malloc(2 * pixels * sizeof *s.normal);
    s.meshes = copy_of(s.pass.meshes, s.pass.mesh_count, sizeof *s.meshes);
    s.instances = copy_of(s.pass.instances, s.pass.instance_count, sizeof *s.instances);
    s.occluders = copy_of(ao->instance_occluders, s.pass.instance_count, sizeof *s.occluders);
    if (!s.depth || !s.normal || !s.meshes || !s.instances || !s.occluders) {
        nook_ao_snapshot_free(&s);
        return nook_fail(NOOK_E_MEMORY, "no memory for a snapshot of %zu pixels", pixels);
    }
    nook_texture_read(ao->gpu, s.pass.depth, GL_RED, GL_FLOAT, s.depth, pixels * sizeof *s.depth);
    nook_texture_read(ao->gpu, s.pass.normal, GL_RG, GL_UNSIGNED_SHORT, s.normal, 2 * pixels * sizeof *s.normal);
    const nook_texture none = { 0 };
    s.pass.gpu = NULL;
    s.pass.depth = s.pass.normal = s.pass.visibility = none;
    s.pass.volume_atlas = s.pass.bricks = s.pass.surfels = s.pass.occluder_texture = none;
    s.pass.frame = s.pass.params = s.pass.counter = s.pass.occluders = (nook_buffer){ 0 };
    s.pass.progress = NULL;
    s.pass.progress_user = NULL;
    s.pass.meshes = s.meshes;
    s.pass.instances = s.instances;
    *out_snapshot = s;
    return NOOK_OK;
}

void nook_ao_snapshot_free(nook_ao_snapshot *snapshot)
{
    free(snapshot->depth);
    free(snapshot->normal);
    free(snapshot->meshes);
    free(snapshot->instances);
    free(snapshot->occluders);
    *snapshot = (nook_ao_snapshot){ 0 };
}
