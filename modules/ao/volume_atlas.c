#include "engine/core/log.h"
#include "modules/ao/volume_atlas_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

void volume_atlas_init(volume_atlas *atlas, nook_gpu *gpu)
{
    *atlas = (volume_atlas){ .gpu = gpu };
}

void volume_atlas_release(volume_atlas *atlas)
{
    for (uint32_t i = 0; i < atlas->entry_count; i++)
        free(atlas->entries[i].pending);
    free(atlas->entries);
    free(atlas->free_boxes);
    if (atlas->gpu)
        nook_texture_destroy(atlas->gpu, &atlas->texture);
    *atlas = (volume_atlas){ 0 };
}

static uint64_t box_voxels(const uint32_t size[3])
{
    return (uint64_t)size[0] * size[1] * size[2];
}

static int box_holds(const atlas_box *box, const uint32_t size[3])
{
    return box->size[0] >= size[0] && box->size[1] >= size[1] && box->size[2] >= size[2];
}

/** Grows an array of `item_size` so that one more fits. @return 0 when there is no memory */
static int reserve_one(void **items, uint32_t count, uint32_t *capacity, size_t item_size)
{
    if (count < *capacity)
        return 1;
    uint32_t wanted = *capacity ? *capacity * 2 : 16;
    void *grown = realloc(*items, wanted * item_size);
    if (!grown)
        return 0;
    *items = grown;
    *capacity = wanted;
    return 1;
}

/** Empty boxes are dropped; without memory the space is lost until the atlas is released, nothing else. */
static void add_free_box(volume_atlas *atlas, const atlas_box *box)
{
    if (box_voxels(box->size) == 0)
        return;
    if (reserve_one((void **)&atlas->free_boxes, atlas->free_count, &atlas->free_capacity, sizeof *box))
        atlas->free_boxes[atlas->free_count++] = *box;
}

/** Takes `size` from the corner of the smallest free box that holds it; the rest is cut into three free boxes. */
static int take_free_box(volume_atlas *atlas, const uint32_t size[3], atlas_box *out)
{
    uint32_t best = UINT32_MAX;
    for (uint32_t i = 0; i < atlas->free_count; i++) {
        const atlas_box *box = &atlas->free_boxes[i];
        if (box_holds(box, size) &&
            (best == UINT32_MAX || box_voxels(box->size) < box_voxels(atlas->free_boxes[best].size)))
            best = i;
    }
    if (best == UINT32_MAX)
        return 0;
    atlas_box box = atlas->free_boxes[best];
    atlas->free_boxes[best] = atlas->free_boxes[--atlas->free_count];
    *out = (atlas_box){ { box.origin[0], box.origin[1], box.origin[2] }, { size[0], size[1], size[2] } };
    atlas_box rest = box;
    for (int axis = 0; axis < 3; axis++) {
        atlas_box cut = rest;
        cut.origin[axis] += size[axis];
        cut.size[axis] -= size[axis];
        add_free_box(atlas, &cut);
        rest.size[axis] = size[axis];
    }
    return 1;
}

static void extend(volume_atlas *atlas, int axis, uint32_t by)
{
    atlas_box slab = { { 0, 0, 0 }, { atlas->size[0], atlas->size[1], atlas->size[2] } };
    slab.origin[axis] = atlas->size[axis];
    slab.size[axis] = by;
    atlas->size[axis] += by;
    add_free_box(atlas, &slab);
}

/** Extends the atlas along the axis that costs least, so that a box of `size` fits. @return 0: the device's limit */
static int grow_for(volume_atlas *atlas, const uint32_t size[3])
{
    int best = -1;
    uint64_t best_voxels = UINT64_MAX;
    for (int axis = 0; axis < 3; axis++) {
        uint32_t grown[3];
        int allowed = 1;
        for (int k = 0; k < 3; k++) {
            grown[k] = atlas->size[k] > size[k] ? atlas->size[k] : size[k];
            if (k == axis)
                grown[k] = atlas->size[k] + size[k];
            allowed = allowed && grown[k] <= atlas->gpu->max_texture_3d_size;
        }
        if (allowed && box_voxels(grown) < best_voxels) {
            best = axis;
            best_voxels = box_voxels(grown);
        }
    }
    if (best < 0)
        return 0;
    for (int k = 0; k < 3; k++) {
        if (k != best && atlas->size[k] < size[k])
            extend(atlas, k, size[k] - atlas->size[k]);
    }
    extend(atlas, best, size[best]);
    return 1;
}

/** Free boxes are never joined; but once nothing is left (a level is over), all of it goes, and its memory with it. */
static void release_when_empty(volume_atlas *atlas)
{
    if (atlas->entry_count > 0)
        return;
    atlas->free_count = 0;
    memset(atlas->size, 0, sizeof atlas->size);
    nook_texture_destroy(atlas->gpu, &atlas->texture);
}

/** The place of an id, or where it belongs. */
static uint32_t entry_place(const volume_atlas *atlas, uint32_t id)
{
    uint32_t first = 0, end = atlas->entry_count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (atlas->entries[middle].id < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

static uint32_t entry_index(const volume_atlas *atlas, uint32_t id)
{
    uint32_t first = entry_place(atlas, id);
    return first < atlas->entry_count && atlas->entries[first].id == id ? first : UINT32_MAX;
}

nook_result volume_atlas_add(volume_atlas *atlas, uint32_t id, nook_volume *volume)
{
    const uint32_t size[3] = { volume->info.width, volume->info.height, volume->info.depth };
    uint32_t place = entry_place(atlas, id);
    assert(place == atlas->entry_count || atlas->entries[place].id != id);
    if (!reserve_one((void **)&atlas->entries, atlas->entry_count, &atlas->entry_capacity, sizeof *atlas->entries))
        return nook_fail(NOOK_E_MEMORY, "no memory for another volume");
    atlas_entry entry = { .id = id, .info = volume->info, .pending = volume->voxels };
    if (!take_free_box(atlas, size, &entry.box) && !(grow_for(atlas, size) && take_free_box(atlas, size, &entry.box)))
        return nook_fail(NOOK_E_MEMORY, "a volume of %ux%ux%u voxels does not fit any more: bake at a lower resolution",
                         size[0], size[1], size[2]);
    memmove(atlas->entries + place + 1, atlas->entries + place,
            (atlas->entry_count++ - place) * sizeof *atlas->entries);
    atlas->entries[place] = entry;
    *volume = (nook_volume){ 0 };
    return NOOK_OK;
}

void volume_atlas_remove(volume_atlas *atlas, uint32_t id)
{
    uint32_t i = entry_index(atlas, id);
    if (i == UINT32_MAX)
        return;
    add_free_box(atlas, &atlas->entries[i].box);
    free(atlas->entries[i].pending);
    memmove(atlas->entries + i, atlas->entries + i + 1, (--atlas->entry_count - i) * sizeof *atlas->entries);
    release_when_empty(atlas);
}

const atlas_entry *volume_atlas_find(const volume_atlas *atlas, uint32_t id)
{
    uint32_t i = entry_index(atlas, id);
    return i == UINT32_MAX ? NULL : &atlas->entries[i];
}

void volume_atlas_set_info(volume_atlas *atlas, uint32_t id, const nook_volume_info *info)
{
    uint32_t i = entry_index(atlas, id);
    if (i != UINT32_MAX)
        atlas->entries[i].info = *info;
}

/** Replaces the texture by a larger one and copies what was there. */
static nook_result grow_texture(volume_atlas *atlas)
{
    nook_texture old = atlas->texture, grown;
    if (old.id && old.width == atlas->size[0] && old.height == atlas->size[1] && old.depth == atlas->size[2])
        return NOOK_OK;
    nook_gpu *gpu = atlas->gpu;
    nook_result result =
        nook_texture_create_3d(gpu, GL_R8, atlas->size[0], atlas->size[1], atlas->size[2], GL_LINEAR, &grown);
    if (result != NOOK_OK)
        return result;
    if (old.id) {
        gpu->gl->CopyImageSubData(old.id, GL_TEXTURE_3D, 0, 0, 0, 0, grown.id, GL_TEXTURE_3D, 0, 0, 0, 0,
                                  (GLsizei)old.width, (GLsizei)old.height, (GLsizei)old.depth);
        nook_texture_destroy(gpu, &old);
    }
    atlas->texture = grown;
    atlas->version++;
    return NOOK_OK;
}

nook_result volume_atlas_flush(volume_atlas *atlas)
{
    if (atlas->entry_count == 0)
        return NOOK_OK;
    nook_result result = grow_texture(atlas);
    if (result != NOOK_OK)
        return result;
    for (uint32_t i = 0; i < atlas->entry_count; i++) {
        atlas_entry *entry = &atlas->entries[i];
        if (!entry->pending)
            continue;
        nook_texture_write_box(atlas->gpu, atlas->texture, entry->box.origin, entry->box.size, GL_RED, GL_UNSIGNED_BYTE,
                               entry->pending, (size_t)box_voxels(entry->box.size));
        free(entry->pending);
        entry->pending = NULL;
        atlas->version++;
    }
    return NOOK_OK;
}

uint64_t volume_atlas_bytes(const volume_atlas *atlas)
{
    return box_voxels(atlas->size);
}
