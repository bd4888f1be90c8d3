/* Volumes of the atlas that come and go (residency.h), and the room that they share. */
#include "engine/core/log.h"
#include "modules/ao/residency.h"
#include "modules/ao/volume_atlas_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* ---- Volumes that come ------------------------------------------------------------------------------------------- */

static atlas_entry *find_incoming(const volume_atlas *atlas, uint32_t id)
{
    for (uint32_t i = 0; i < atlas->incoming.count; i++)
        if (atlas->incoming.items[i].id == id)
            return &atlas->incoming.items[i];
    return NULL;
}

bool volume_atlas_is_placed(const volume_atlas *atlas, uint32_t id)
{
    return find_incoming(atlas, id) != NULL;
}

static bool take(volume_atlas *atlas, const uint32_t size[3], atlas_entry *entry)
{
    if (box_tree_take(&atlas->tree, size, &entry->box, &entry->place))
        return true;
    return !atlas->has_room && box_tree_grow(&atlas->tree, size, atlas->gpu->max_texture_3d_size) &&
           box_tree_take(&atlas->tree, size, &entry->box, &entry->place);
}

bool volume_atlas_place(volume_atlas *atlas, uint32_t id, const nook_volume_info *info)
{
    const uint32_t size[3] = { info->width, info->height, info->depth };
    assert(!find_incoming(atlas, id));
    atlas_entry entry = { .id = id, .info = *info, .streamed = true };
    if (!volume_atlas_reserve(atlas) || !take(atlas, size, &entry))
        return false;
    atlas->incoming.items[atlas->incoming.count++] = entry;
    return true;
}

static void drop_incoming(volume_atlas *atlas, atlas_entry *entry)
{
    *entry = atlas->incoming.items[--atlas->incoming.count];
}

void volume_atlas_unplace(volume_atlas *atlas, uint32_t id)
{
    atlas_entry *entry = find_incoming(atlas, id);
    if (!entry)
        return;
    box_tree_give(&atlas->tree, entry->place);
    drop_incoming(atlas, entry);
    volume_atlas_release_when_empty(atlas);
}

size_t volume_atlas_write(volume_atlas *atlas, uint32_t id, const uint8_t *voxels, size_t most, bool *out_whole)
{
    atlas_entry *entry = find_incoming(atlas, id);
    assert(entry);
    const uint32_t *size = entry->box.size;
    size_t slice = (size_t)size[0] * size[1], left = size[2] - entry->written;
    size_t slices = most / slice < left ? most / slice : left;
    if (slices > 0) {
        atlas_box part = entry->box;
        part.origin[2] += entry->written;
        part.size[2] = (uint32_t)slices;
        nook_texture_write_box(atlas->gpu, atlas->texture, part.origin, part.size, GL_RED, GL_UNSIGNED_BYTE,
                               voxels + entry->written * slice, slices * slice);
        volume_atlas_note(atlas, &part);
        entry->written += (uint32_t)slices;
    }
    *out_whole = entry->written == size[2];
    if (*out_whole) {
        volume_atlas_put(atlas, entry); /* seen from now on, instead of what the volume was before */
        drop_incoming(atlas, entry);
    }
    return slices * slice;
}

/* ---- Volumes that stay ------------------------------------------------------------------------------------------- */

uint64_t volume_atlas_kept_bytes(const volume_atlas *atlas)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < atlas->seen.count; i++)
        bytes += atlas->seen.items[i].streamed ? 0 : box_voxels(atlas->seen.items[i].box.size);
    return bytes;
}

/* Largest first; of equal ones the first. As compare_entries has it. */
static void put_by_size(nook_volume_info *infos, uint32_t count, const nook_volume_info *added)
{
    uint32_t place = count;
    for (; place > 0 && nook_volume_gpu_bytes(&infos[place - 1]) < nook_volume_gpu_bytes(added); place--)
        infos[place] = infos[place - 1];
    infos[place] = *added;
}

uint32_t volume_atlas_list_kept(const volume_atlas *atlas, nook_volume_info *out, uint32_t capacity)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < atlas->seen.count; i++) {
        const atlas_entry *entry = &atlas->seen.items[i];
        nook_volume_info info = entry->info;
        if (entry->streamed)
            continue;
        info.width = entry->box.size[0]; /* a live volume may fill less of it now */
        info.height = entry->box.size[1];
        info.depth = entry->box.size[2];
        if (count < capacity)
            put_by_size(out, count, &info);
        count++;
    }
    return count;
}

/* ---- Another room -------------------------------------------------------------------------------------------------- */

/* Largest first, but what is not streamed before all that is. */
static int compare_entries(const void *a, const void *b)
{
    const atlas_entry *first = a, *second = b;
    if (first->streamed != second->streamed)
        return first->streamed ? 1 : -1;
    uint64_t first_size = box_voxels(first->box.size), second_size = box_voxels(second->box.size);
    if (first_size != second_size)
        return first_size > second_size ? -1 : 1;
    return first->id < second->id ? -1 : first->id > second->id;
}

static int compare_ids(const void *a, const void *b)
{
    const atlas_entry *first = a, *second = b;
    return first->id < second->id ? -1 : first->id > second->id;
}

static void order(volume_atlas *atlas, int (*compare)(const void *, const void *))
{
    if (atlas->seen.count > 1) /* there may be no array yet */
        qsort(atlas->seen.items, atlas->seen.count, sizeof *atlas->seen.items, compare);
}

/* A volume's voxels from its box in one texture to that in another. */
static void move(volume_atlas *atlas, const atlas_box *from, const atlas_box *to, uint32_t to_texture)
{
    atlas->gpu->gl->CopyImageSubData(atlas->texture.id, GL_TEXTURE_3D, 0, (GLint)from->origin[0],
                                     (GLint)from->origin[1], (GLint)from->origin[2], to_texture, GL_TEXTURE_3D, 0,
                                     (GLint)to->origin[0], (GLint)to->origin[1], (GLint)to->origin[2],
                                     (GLsizei)from->size[0], (GLsizei)from->size[1], (GLsizei)from->size[2]);
}

/* Gives the entries their places in a tree, in the order that they have. @return how many: those without one stand behind, and the first
   that must have one and does not is one of them */
static uint32_t settle(box_tree *tree, atlas_entry *entries, uint32_t count, atlas_box *out_boxes, uint32_t *out_places)
{
    uint32_t settled = 0;
    for (uint32_t i = 0; i < count; i++) {
        const atlas_entry entry = entries[i];
        if (!box_tree_take(tree, entry.box.size, &out_boxes[settled], &out_places[settled])) {
            if (!entry.streamed)
                return settled;
            continue;
        }
        memmove(entries + settled + 1, entries + settled, (i - settled) * sizeof *entries);
        entries[settled++] = entry;
    }
    return settled;
}

/* What settle left over is gone. */
static void take_over(volume_atlas *atlas, const box_tree *tree, const nook_texture *texture, uint32_t settled,
                      const atlas_box *boxes, const uint32_t *places)
{
    for (uint32_t i = 0; i < settled; i++) {
        atlas_entry *entry = &atlas->seen.items[i];
        if (atlas->texture.id && !entry->pending)
            move(atlas, &entry->box, &boxes[i], texture->id);
        entry->box = boxes[i];
        entry->place = places[i];
    }
    nook_texture_destroy(atlas->gpu, &atlas->texture);
    box_tree_release(&atlas->tree);
    atlas->texture = *texture;
    atlas->tree = *tree;
    atlas->seen.count = settled;
    atlas->incoming.count = 0;
    atlas->has_room = true;
    volume_atlas_note_renewed(atlas);
}

static nook_result move_to(volume_atlas *atlas, const uint32_t sides[3], atlas_box *boxes, uint32_t *places)
{
    box_tree tree = { .count = 0 };
    nook_texture texture;
    uint32_t pinned = 0;
    for (uint32_t i = 0; i < atlas->seen.count; i++)
        pinned += !atlas->seen.items[i].streamed;
    if (!box_tree_reset(&tree, sides))
        return nook_fail(NOOK_E_MEMORY, "no memory for room for volumes");
    order(atlas, compare_entries);
    uint32_t settled = settle(&tree, atlas->seen.items, atlas->seen.count, boxes, places);
    nook_result result =
        settled < pinned ? nook_fail(NOOK_E_RANGE, "room of %ux%ux%u voxels does not hold what stays: give more",
                                     sides[0], sides[1], sides[2])
                         : nook_texture_create_3d(atlas->gpu, GL_R8, sides[0], sides[1], sides[2], GL_LINEAR, &texture);
    if (result == NOOK_OK)
        take_over(atlas, &tree, &texture, settled, boxes, places);
    else
        box_tree_release(&tree);
    order(atlas, compare_ids);
    return result;
}

nook_result volume_atlas_set_room(volume_atlas *atlas, const uint32_t sides[3])
{
    if (box_voxels(sides) == 0) {
        atlas->has_room = false;
        volume_atlas_release_when_empty(atlas);
        return NOOK_OK;
    }
    atlas_box *boxes = malloc((atlas->seen.count + 1) * sizeof *boxes);
    uint32_t *places = malloc((atlas->seen.count + 1) * sizeof *places);
    nook_result result = boxes && places ? move_to(atlas, sides, boxes, places)
                                         : nook_fail(NOOK_E_MEMORY, "no memory for room for volumes");
    free(boxes);
    free(places);
    return result;
}
