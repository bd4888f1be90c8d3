#include "modules/ao/residency.h"
#include "modules/ao/ao_internal.h"
#include "modules/bake/brick_grid.h"
#include <assert.h>

uint64_t nook_volume_gpu_bytes(const nook_volume_info *info)
{
    if (info->kind == NOOK_VOLUME_SURFEL)
        return nook_brick_total(info) * sizeof(nook_brick) + info->occupied * sizeof(nook_surfel);
    return (uint64_t)info->width * info->height * info->depth;
}

/* UINT64_MAX without memory: more than anyone allows. */
static uint64_t packed_voxels(const nook_volume_info *const *infos, uint32_t count)
{
    box_tree tree = { .count = 0 };
    uint64_t voxels = UINT64_MAX;
    uint32_t i = 0;
    for (; i < count; i++) {
        const uint32_t size[3] = { infos[i]->width, infos[i]->height, infos[i]->depth };
        atlas_box box;
        uint32_t place;
        if (!box_tree_take(&tree, size, &box, &place) &&
            !(box_tree_grow(&tree, size, UINT32_MAX) && box_tree_take(&tree, size, &box, &place)))
            break;
    }
    if (i == count)
        voxels = box_voxels(tree.size);
    box_tree_release(&tree);
    return voxels;
}

uint64_t nook_ao_packed_bytes(nook_volume_kind kind, const nook_volume_info *const *infos, uint32_t count)
{
    uint64_t bytes = 0;
    if (kind != NOOK_VOLUME_SURFEL)
        return packed_voxels(infos, count);
    for (uint32_t i = 0; i < count; i++)
        bytes += nook_volume_gpu_bytes(infos[i]);
    return bytes + bytes / 4; /* as brick_pool.c makes them larger */
}

uint64_t nook_ao_fitting_bytes(const uint32_t sides[3], const nook_volume_info *const *infos, uint32_t count)
{
    box_tree tree = { .count = 0 };
    uint64_t bytes = 0;
    if (!box_tree_reset(&tree, sides))
        return 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t size[3] = { infos[i]->width, infos[i]->height, infos[i]->depth };
        atlas_box box;
        uint32_t place;
        if (box_tree_take(&tree, size, &box, &place))
            bytes += box_voxels(size);
    }
    box_tree_release(&tree);
    return bytes;
}

nook_result nook_ao_set_room(nook_ao *ao, nook_volume_kind kind, const nook_ao_room *room)
{
    return kind == NOOK_VOLUME_SURFEL ? brick_pool_set_room(&ao->pool, room->bricks, room->surfels)
                                      : volume_atlas_set_room(&ao->atlases[kind], room->sides);
}

bool nook_ao_place_volume(nook_ao *ao, nook_ao_volume volume, const nook_volume_info *info)
{
    assert(ao_volume_id_is_known(ao, volume.id));
    return info->kind == NOOK_VOLUME_SURFEL ? brick_pool_place(&ao->pool, volume.id, info)
                                            : volume_atlas_place(&ao->atlases[info->kind], volume.id, info);
}

nook_result nook_ao_write_volume(nook_ao *ao, nook_ao_volume volume, nook_volume *contents, size_t most,
                                 nook_ao_written *out_written)
{
    nook_volume_kind kind = contents->info.kind;
    bool whole;
    if (kind == NOOK_VOLUME_SURFEL) {
        nook_result result = brick_pool_flush(&ao->pool);
        if (result != NOOK_OK)
            return result;
        out_written->bytes = brick_pool_write(&ao->pool, volume.id, contents, most, &whole);
    } else {
        nook_result result = volume_atlas_grow(&ao->atlases[kind]);
        if (result != NOOK_OK)
            return result;
        out_written->bytes = volume_atlas_write(&ao->atlases[kind], volume.id, contents->voxels, most, &whole);
    }
    out_written->whole = whole;
    return NOOK_OK;
}

void nook_ao_unplace_volume(nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind)
{
    if (kind == NOOK_VOLUME_SURFEL)
        brick_pool_unplace(&ao->pool, volume.id);
    else
        volume_atlas_unplace(&ao->atlases[kind], volume.id);
}

bool nook_ao_is_placed(const nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind)
{
    return kind == NOOK_VOLUME_SURFEL ? brick_pool_is_placed(&ao->pool, volume.id)
                                      : volume_atlas_is_placed(&ao->atlases[kind], volume.id);
}

void nook_ao_drop_volume(nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind)
{
    if (kind == NOOK_VOLUME_SURFEL)
        brick_pool_remove(&ao->pool, volume.id);
    else
        volume_atlas_remove(&ao->atlases[kind], volume.id);
}

bool nook_ao_has_volume(const nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind)
{
    return ao_volume_info(ao, volume.id, NOOK_VOLUME_BIT(kind)) != NULL;
}

uint64_t nook_ao_kept_bytes(const nook_ao *ao, nook_volume_kind kind)
{
    return kind == NOOK_VOLUME_SURFEL ? brick_pool_kept_bytes(&ao->pool) : volume_atlas_kept_bytes(&ao->atlases[kind]);
}

uint32_t nook_ao_list_kept(const nook_ao *ao, nook_volume_kind kind, nook_volume_info *out, uint32_t capacity)
{
    return kind == NOOK_VOLUME_SURFEL ? brick_pool_list_kept(&ao->pool, out, capacity)
                                      : volume_atlas_list_kept(&ao->atlases[kind], out, capacity);
}

static uint64_t larger(uint64_t a, uint64_t b)
{
    return a > b ? a : b;
}

uint64_t nook_ao_kind_bytes(const nook_ao *ao, nook_volume_kind kind)
{
    const nook_texture *texture = &ao->atlases[kind].texture;
    if (kind == NOOK_VOLUME_SURFEL)
        return larger(brick_pool_bytes(&ao->pool), ao->pool.bricks.buffer.size + ao->pool.surfels.buffer.size);
    return larger(volume_atlas_bytes(&ao->atlases[kind]),
                  texture->id ? (uint64_t)texture->width * texture->height * texture->depth : 0);
}
