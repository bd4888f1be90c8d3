#include "modules/stream/stream.h"
#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "modules/stream/stream_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* ---- Items --------------------------------------------------------------------------------------------------------- */

uint64_t stream_budget_bytes(const nook_stream *stream)
{
    double budget = (double)stream->params.budget * NOOK_MIB;
    return budget > 0.0 ? (uint64_t)budget : UINT64_MAX;
}

void stream_cancel(nook_stream *stream, stream_item *item)
{
    if (item->coming == LEVEL_NONE)
        return;
    nook_ao_unplace_volume(stream->ao, item->volume, item->levels[0].info.kind);
    if (item->job != LOADER_NONE) {
        stream->of_job[item->job] = NULL;
        if (stream->writing == item->job)
            stream->writing = LOADER_NONE;
        stream_loader_free(stream->loader, item->job);
    }
    item->coming = LEVEL_NONE;
    item->job = LOADER_NONE;
}

void stream_drop(nook_stream *stream, stream_item *item)
{
    nook_ao_drop_volume(stream->ao, item->volume, item->levels[0].info.kind);
    item->resident = LEVEL_NONE;
}

int stream_finest(const stream_item *item)
{
    for (int level = 0; level < item->level_count; level++)
        if (!item->levels[level].refused)
            return level;
    return LEVEL_NONE;
}

int stream_finer(const stream_item *item, int level)
{
    for (int finer = (level == LEVEL_NONE ? item->level_count : level) - 1; finer >= 0; finer--)
        if (!item->levels[finer].refused)
            return finer;
    return LEVEL_NONE;
}

static void free_item(stream_item *item)
{
    if (!item)
        return;
    for (int i = 0; i < item->level_count; i++)
        free(item->levels[i].path);
    free(item);
}

static nook_result make_item(const char *name, const nook_stream_level *levels, uint32_t count, stream_item **out_item)
{
    assert(count >= 1 && count <= NOOK_STREAM_LEVELS_MAX);
    stream_item *item = calloc(1, sizeof *item);
    if (!item)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to stream it", name);
    item->resident = item->coming = item->target = LEVEL_NONE;
    item->job = LOADER_NONE;
    for (uint32_t i = 0; i < count; i++) {
        assert(levels[i].info.kind == levels[0].info.kind);
        size_t size = strlen(levels[i].path) + 1;
        char *path = size <= NOOK_STREAM_PATH_MAX ? malloc(size) : NULL;
        if (!path) {
            free_item(item);
            return size > NOOK_STREAM_PATH_MAX ? nook_fail(NOOK_E_RANGE, "%s: a path of %zu bytes; %d are the most",
                                                           name, size, NOOK_STREAM_PATH_MAX)
                                               : nook_fail(NOOK_E_MEMORY, "%s: no memory to stream it", name);
        }
        memcpy(path, levels[i].path, size);
        item->levels[i] = (stream_level){ .path = path,
                                          .info = levels[i].info,
                                          .bytes = nook_volume_gpu_bytes(&levels[i].info),
                                          .error = levels[i].error };
        item->level_count++;
    }
    *out_item = item;
    return NOOK_OK;
}

static bool has_files(const stream_item *item, const nook_stream_level *levels, uint32_t count)
{
    bool same = item && (uint32_t)item->level_count == count;
    for (uint32_t i = 0; i < count && same; i++)
        same = item->levels[i].info.content_hash == levels[i].info.content_hash && !item->levels[i].refused &&
               strcmp(item->levels[i].path, levels[i].path) == 0;
    return same;
}

/* ---- Volumes ------------------------------------------------------------------------------------------------------- */

stream_volume *stream_find(const nook_stream *stream, nook_ao_volume volume)
{
    uint32_t first = 0, end = stream->count;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (stream->volumes[middle].volume.id < volume.id)
            first = middle + 1;
        else
            end = middle;
    }
    return first < stream->count && stream->volumes[first].volume.id == volume.id ? &stream->volumes[first] : NULL;
}

static bool reserve(nook_stream *stream)
{
    uint32_t items = stream->item_count + 1;
    if (items > stream->heap_capacity) {
        stream_item **heap = realloc(stream->heap, 2 * (size_t)items * sizeof(stream_item *));
        if (!heap)
            return false;
        stream->heap = heap;
        stream->heap_capacity = 2 * items;
    }
    if (stream->count < stream->capacity)
        return true;
    uint32_t capacity = stream->capacity ? 2 * stream->capacity : 32;
    stream_volume *volumes = realloc(stream->volumes, capacity * sizeof *volumes);
    if (!volumes)
        return false;
    stream->volumes = volumes;
    stream->capacity = capacity;
    return true;
}

/* There is room for it. */
static void take_item(nook_stream *stream, stream_volume *volume, stream_item *item)
{
    const nook_volume_info *info = &item->levels[0].info;
    const double sides[3] = { info->width, info->height, info->depth };
    item->volume = volume->volume;
    for (int axis = 0; axis < 3; axis++) {
        volume->half[axis] = 0.5 * sides[axis] * info->voxel_size;
        volume->centre[axis] = info->origin[axis] + volume->half[axis];
    }
    volume->items[info->kind] = item;
    stream->item_count++;
    stream->failed = false;
    stream->settled = false;
    stream_settle_in(stream, item);
}

nook_result nook_stream_add(nook_stream *stream, const char *name, const nook_stream_level *levels, uint32_t count,
                            nook_ao_volume *out_volume)
{
    for (uint32_t i = 0; i < stream->count; i++) {
        if (!has_files(stream->volumes[i].items[levels[0].info.kind], levels, count))
            continue;
        stream->volumes[i].users++;
        *out_volume = stream->volumes[i].volume;
        return NOOK_OK;
    }
    stream_item *item;
    nook_result result = make_item(name, levels, count, &item);
    if (result != NOOK_OK)
        return result;
    nook_ao_volume made;
    result = reserve(stream) ? nook_ao_reserve_volume(stream->ao, &made)
                             : nook_fail(NOOK_E_MEMORY, "%s: no memory to stream it", name);
    if (result != NOOK_OK) {
        free_item(item);
        return result;
    }
    stream_volume *volume = &stream->volumes[stream->count++];
    *volume = (stream_volume){ .volume = made, .users = 1 };
    take_item(stream, volume, item);
    *out_volume = made;
    return NOOK_OK;
}

nook_result nook_stream_extend(nook_stream *stream, nook_ao_volume volume, const nook_stream_level *levels,
                               uint32_t count)
{
    nook_volume_kind kind = levels[0].info.kind;
    stream_volume *found = stream_find(stream, volume);
    stream_item *item;
    if (!found)
        return nook_fail(NOOK_E_NOT_FOUND, "stream: the volume %u has been removed", volume.id);
    if (has_files(found->items[kind], levels, count))
        return NOOK_OK; /* for another of its users */
    if (found->items[kind])
        return nook_fail(NOOK_E_ARG, "stream: the volume %u is there as %s already", volume.id,
                         nook_volume_kind_name(kind));
    nook_result result = make_item(levels[0].path, levels, count, &item);
    if (result != NOOK_OK)
        return result;
    if (!reserve(stream)) {
        free_item(item);
        return nook_fail(NOOK_E_MEMORY, "stream: no memory for another volume");
    }
    take_item(stream, stream_find(stream, volume), item);
    return NOOK_OK;
}

static void clear_volume(nook_stream *stream, stream_volume *volume)
{
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        if (!volume->items[kind])
            continue;
        stream_cancel(stream, volume->items[kind]);
        free_item(volume->items[kind]);
        stream->item_count--;
    }
    nook_ao_remove_volume(stream->ao, volume->volume);
}

void nook_stream_remove(nook_stream *stream, nook_ao_volume volume)
{
    stream_volume *found = stream_find(stream, volume);
    if (!found || --found->users > 0)
        return;
    clear_volume(stream, found);
    stream->count--;
    memmove(found, found + 1, (size_t)(stream->volumes + stream->count - found) * sizeof *found);
    stream->stale = stream->stale || stream->tight; /* the rest may fit */
    stream->failed = false;
}

/* ---- Life ---------------------------------------------------------------------------------------------------------- */

nook_result nook_stream_create(nook_ao *ao, const nook_stream_params *params, nook_stream **out_stream)
{
    *out_stream = NULL;
    nook_result result = nook_stream_params_check(params);
    if (result != NOOK_OK)
        return result;
    nook_stream *stream = calloc(1, sizeof *stream);
    if (!stream)
        return nook_fail(NOOK_E_MEMORY, "stream: no memory");
    result = stream_loader_create(&stream->loader);
    if (result != NOOK_OK) {
        free(stream);
        return result;
    }
    stream->ao = ao;
    stream->params = *params;
    stream->writing = LOADER_NONE;
    *out_stream = stream;
    return NOOK_OK;
}

void nook_stream_destroy(nook_stream *stream)
{
    const nook_ao_room none = { .bricks = 0 };
    if (!stream)
        return;
    for (uint32_t i = 0; i < stream->count; i++)
        clear_volume(stream, &stream->volumes[i]);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS && stream->tight; kind++)
        nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &none); /* cannot fail */
    stream_loader_destroy(stream->loader);
    free(stream->volumes);
    free(stream->heap);
    free(stream);
}

void nook_stream_suspend(nook_stream *stream)
{
    stream_loader_rest(stream->loader);
}

nook_result nook_stream_set_params(nook_stream *stream, const nook_stream_params *params)
{
    nook_result result = nook_stream_params_check(params);
    if (result != NOOK_OK)
        return result;
    stream->stale = stream->stale || stream->params.budget != params->budget;
    stream->failed = false;
    stream->settled = false;
    stream->params = *params;
    return NOOK_OK;
}

const nook_stream_params *nook_stream_params_of(const nook_stream *stream)
{
    return &stream->params;
}

/* ---- Status -------------------------------------------------------------------------------------------------------- */

void nook_stream_get_status(const nook_stream *stream, nook_stream_status *out_status)
{
    nook_stream_status status = { .budget = stream_budget_bytes(stream),
                                  .all_fit = !stream->tight,
                                  .failed = stream->failed,
                                  .loads = stream->loads,
                                  .evictions = stream->evictions,
                                  .frame_upload = stream->frame_upload,
                                  .largest_upload = stream->largest_upload };
    status.budget = status.budget == UINT64_MAX ? 0 : status.budget;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        status.memory += nook_ao_kind_bytes(stream->ao, (nook_volume_kind)kind);
    STREAM_EACH(stream, item)
    {
        status.volumes++;
        status.resident += item->resident != LEVEL_NONE;
        status.resident_bytes += item->resident != LEVEL_NONE ? item->levels[item->resident].bytes : 0;
        status.wanted += item->target != LEVEL_NONE;
        status.wanted_bytes += item->target != LEVEL_NONE ? item->levels[item->target].bytes : 0;
        bool waits = item->target != LEVEL_NONE && (item->resident == LEVEL_NONE || item->resident > item->target);
        status.waiting += waits;
        status.waiting_bytes += waits ? item->levels[item->target].bytes : 0;
        status.reading += item->job != LOADER_NONE;
        for (int level = 0; level < item->level_count; level++)
            status.refused += item->levels[level].refused;
    }
    *out_status = status;
}

bool nook_stream_is_settled(const nook_stream *stream)
{
    return stream->failed || (stream->settled && !stream->stale);
}
