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
    for (uint32_t i = 0; i < atlas->seen.count; i++)
        free(atlas->seen.items[i].pending);
    free(atlas->seen.items);
    free(atlas->incoming.items);
    free(atlas->changes.boxes);
    free(atlas->next.boxes);
    box_tree_release(&atlas->tree);
    if (atlas->gpu)
        nook_texture_destroy(atlas->gpu, &atlas->texture);
    *atlas = (volume_atlas){ 0 };
}

/* ---- Entries ----------------------------------------------------------------------------------------------------- */

bool atlas_entries_reserve(atlas_entries *entries, uint32_t count)
{
    uint32_t capacity = entries->capacity ? entries->capacity : 16;
    while (capacity < count)
        capacity *= 2;
    if (capacity == entries->capacity)
        return true;
    atlas_entry *grown = realloc(entries->items, capacity * sizeof *grown);
    if (!grown)
        return false;
    entries->items = grown;
    entries->capacity = capacity;
    return true;
}

static bool reserve_changes(atlas_changes *changes, uint32_t capacity)
{
    if (changes->capacity >= capacity)
        return true;
    nook_ao_box *grown = realloc(changes->boxes, capacity * sizeof *grown);
    if (!grown)
        return false;
    changes->boxes = grown;
    changes->capacity = capacity;
    return true;
}

bool volume_atlas_reserve(volume_atlas *atlas)
{
    uint32_t more = atlas->incoming.count + 1;
    if (!atlas_entries_reserve(&atlas->incoming, more) ||
        !atlas_entries_reserve(&atlas->seen, atlas->seen.count + more))
        return false;
    uint32_t boxes =
        atlas->incoming.capacity + atlas->seen.capacity; /* each once; a frame in which all come also renews */
    return reserve_changes(&atlas->changes, 2 * boxes) && reserve_changes(&atlas->next, 2 * boxes);
}

/** Once nothing is left (a level is over), all of it goes, and its memory with it. */
void volume_atlas_release_when_empty(volume_atlas *atlas)
{
    const uint32_t nothing[3] = { 0, 0, 0 };
    if (atlas->seen.count > 0 || atlas->incoming.count > 0 || atlas->has_room)
        return;
    box_tree_reset(&atlas->tree, nothing);
    nook_texture_destroy(atlas->gpu, &atlas->texture);
}

/** The place of an id, or where it belongs. */
static uint32_t entry_place(const volume_atlas *atlas, uint32_t id)
{
    uint32_t first = 0, end = atlas->seen.count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (atlas->seen.items[middle].id < id)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

static uint32_t entry_index(const volume_atlas *atlas, uint32_t id)
{
    uint32_t first = entry_place(atlas, id);
    return first < atlas->seen.count && atlas->seen.items[first].id == id ? first : UINT32_MAX;
}

void volume_atlas_put(volume_atlas *atlas, const atlas_entry *entry)
{
    uint32_t place = entry_place(atlas, entry->id);
    if (place < atlas->seen.count && atlas->seen.items[place].id == entry->id) {
        box_tree_give(&atlas->tree, atlas->seen.items[place].place);
        free(atlas->seen.items[place].pending);
    } else {
        assert(atlas->seen.count < atlas->seen.capacity);
        memmove(atlas->seen.items + place + 1, atlas->seen.items + place,
                (atlas->seen.count++ - place) * sizeof *atlas->seen.items);
    }
    atlas->seen.items[place] = *entry;
}

nook_result volume_atlas_add(volume_atlas *atlas, uint32_t id, nook_volume *volume)
{
    const uint32_t size[3] = { volume->info.width, volume->info.height, volume->info.depth };
    assert(!volume_atlas_find(atlas, id));
    if (!volume_atlas_reserve(atlas))
        return nook_fail(NOOK_E_MEMORY, "no memory for another volume");
    atlas_entry entry = { .id = id, .info = volume->info, .pending = volume->voxels };
    if (!box_tree_take(&atlas->tree, size, &entry.box, &entry.place) &&
        !(box_tree_grow(&atlas->tree, size, atlas->gpu->max_texture_3d_size) &&
          box_tree_take(&atlas->tree, size, &entry.box, &entry.place)))
        return nook_fail(NOOK_E_MEMORY, "a volume of %ux%ux%u voxels does not fit any more: bake at a lower resolution",
                         size[0], size[1], size[2]);
    volume_atlas_put(atlas, &entry);
    *volume = (nook_volume){ 0 };
    return NOOK_OK;
}

void volume_atlas_remove(volume_atlas *atlas, uint32_t id)
{
    uint32_t i = entry_index(atlas, id);
    if (i == UINT32_MAX)
        return;
    box_tree_give(&atlas->tree, atlas->seen.items[i].place);
    free(atlas->seen.items[i].pending);
    memmove(atlas->seen.items + i, atlas->seen.items + i + 1, (--atlas->seen.count - i) * sizeof *atlas->seen.items);
    volume_atlas_release_when_empty(atlas);
}

const atlas_entry *volume_atlas_find(const volume_atlas *atlas, uint32_t id)
{
    uint32_t i = entry_index(atlas, id);
    return i == UINT32_MAX ? NULL : &atlas->seen.items[i];
}

void volume_atlas_set_info(volume_atlas *atlas, uint32_t id, const nook_volume_info *info)
{
    uint32_t i = entry_index(atlas, id);
    if (i == UINT32_MAX)
        return;
    atlas->seen.items[i].info = *info;
    atlas->seen.items[i].version++;
}

void volume_atlas_set_live(volume_atlas *atlas, uint32_t id)
{
    uint32_t i = entry_index(atlas, id);
    assert(i != UINT32_MAX);
    atlas->seen.items[i].live = true;
}

/* ---- The texture --------------------------------------------------------------------------------------------------- */

void volume_atlas_note(volume_atlas *atlas, const atlas_box *box)
{
    atlas_changes *next = &atlas->next;
    if (next->count >= next->capacity) {
        next->count = NOOK_AO_CHANGED_ALL;
        return;
    }
    next->boxes[next->count++] = *box;
}

void volume_atlas_note_renewed(volume_atlas *atlas)
{
    atlas->next.count = 0;
    atlas->next.renewed = true;
    for (uint32_t i = 0; i < atlas->seen.count; i++)
        if (!atlas->seen.items[i].pending) /* else it is noted when it is written */
            volume_atlas_note(atlas, &atlas->seen.items[i].box);
    for (uint32_t i = 0; i < atlas->incoming.count; i++) {
        atlas_box part = atlas->incoming.items[i].box;
        part.size[2] = atlas->incoming.items[i].written;
        if (part.size[2] > 0)
            volume_atlas_note(atlas, &part);
    }
}

/* What has changed makes a version. */
static void publish(volume_atlas *atlas)
{
    atlas_changes last = atlas->changes;
    if (atlas->next.count == 0 && !atlas->next.renewed)
        return;
    atlas->changes = atlas->next;
    atlas->next = last;
    atlas->next.count = 0;
    atlas->next.renewed = false;
    atlas->version++;
}

nook_result volume_atlas_grow(volume_atlas *atlas)
{
    nook_texture old = atlas->texture, grown;
    const uint32_t *size = atlas->tree.size;
    if (old.id && old.width == size[0] && old.height == size[1] && old.depth == size[2])
        return NOOK_OK;
    nook_gpu *gpu = atlas->gpu;
    nook_result result = nook_texture_create_3d(gpu, GL_R8, size[0], size[1], size[2], GL_LINEAR, &grown);
    if (result != NOOK_OK)
        return result;
    if (old.id) {
        gpu->gl->CopyImageSubData(old.id, GL_TEXTURE_3D, 0, 0, 0, 0, grown.id, GL_TEXTURE_3D, 0, 0, 0, 0,
                                  (GLsizei)old.width, (GLsizei)old.height, (GLsizei)old.depth);
        nook_texture_destroy(gpu, &old);
    }
    atlas->texture = grown;
    volume_atlas_note_renewed(atlas);
    return NOOK_OK;
}

nook_result volume_atlas_flush(volume_atlas *atlas)
{
    if (atlas->seen.count == 0 && atlas->incoming.count == 0 && !atlas->has_room)
        return NOOK_OK;
    nook_result result = volume_atlas_grow(atlas);
    if (result != NOOK_OK)
        return result;
    for (uint32_t i = 0; i < atlas->seen.count; i++) {
        atlas_entry *entry = &atlas->seen.items[i];
        if (!entry->pending)
            continue;
        nook_texture_write_box(atlas->gpu, atlas->texture, entry->box.origin, entry->box.size, GL_RED, GL_UNSIGNED_BYTE,
                               entry->pending, (size_t)box_voxels(entry->box.size));
        free(entry->pending);
        entry->pending = NULL;
        volume_atlas_note(atlas, &entry->box);
    }
    publish(atlas);
    return NOOK_OK;
}

uint64_t volume_atlas_bytes(const volume_atlas *atlas)
{
    return box_voxels(atlas->tree.size);
}
