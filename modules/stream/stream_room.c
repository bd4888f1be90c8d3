/* How much memory each kind has, and in which shape. */
#include "engine/core/log.h"
#include "modules/stream/stream_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_STEP = 8, SIDE_MAX = 2048 /* of a 3D texture: every device takes it */ };

/* A room that is a little smaller than it could be stays: another one costs copying. */
static const double kept_part = 0.8;

static uint64_t memory_of(const nook_stream *stream)
{
    uint64_t bytes = 0;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        bytes += nook_ao_kind_bytes(stream->ao, (nook_volume_kind)kind);
    return bytes;
}

/* ---- Where everything fits ----------------------------------------------------------------------------------------- */

/* A place for its finest level. */
static bool place_finest(nook_stream *stream, stream_item *item)
{
    int finest = stream_finest(item);
    if (finest == LEVEL_NONE || item->resident == finest || item->coming == finest)
        return true;
    stream_cancel(stream, item);
    if (!nook_ao_place_volume(stream->ao, item->volume, &item->levels[finest].info))
        return false;
    item->coming = finest;
    return true;
}

void stream_settle_in(nook_stream *stream, stream_item *item)
{
    if (stream->tight || stream->stale || !place_finest(stream, item) ||
        memory_of(stream) > stream_budget_bytes(stream))
        stream->stale = true;
}

/* Bytes of everything at its finest. UINT64_MAX without memory to tell. */
static uint64_t bytes_of_all(const nook_stream *stream)
{
    const nook_volume_info **infos = malloc((stream->item_count + (size_t)1) * sizeof(const nook_volume_info *));
    uint64_t bytes = 0;
    if (!infos)
        return UINT64_MAX;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < stream->count; i++) {
            const stream_item *item = stream->volumes[i].items[kind];
            if (item && stream_finest(item) != LEVEL_NONE)
                infos[count++] = &item->levels[stream_finest(item)].info;
        }
        bytes += nook_ao_packed_bytes((nook_volume_kind)kind, infos, count);
    }
    free(infos);
    return bytes;
}

static bool place_all(nook_stream *stream)
{
    bool placed = true;
    STREAM_EACH(stream, item)
    placed = placed && place_finest(stream, item);
    return placed && memory_of(stream) <= stream_budget_bytes(stream);
}

/* ---- Where it does not --------------------------------------------------------------------------------------------- */

/* Along one of the axes that are bits of `axes`. @return false: the room has all the bytes that there are */
static bool grow_shortest(uint32_t sides[3], unsigned axes, uint64_t bytes)
{
    int best = -1;
    for (int axis = 0; axis < 3; axis++) {
        uint64_t voxels = (uint64_t)sides[0] * sides[1] * sides[2] / sides[axis] * (sides[axis] + SIDE_STEP);
        if (axes >> axis & 1 && voxels <= bytes && sides[axis] + SIDE_STEP <= SIDE_MAX &&
            (best < 0 || sides[axis] < sides[best]))
            best = axis;
    }
    if (best >= 0)
        sides[best] += SIDE_STEP;
    return best >= 0;
}

/* Makes a box hold one more, unless it would have more than `bytes` then. */
static void widen(uint32_t sides[3], const nook_volume_info *info, uint64_t bytes)
{
    const uint32_t added[3] = { info->width, info->height, info->depth };
    uint32_t wider[3];
    for (int axis = 0; axis < 3; axis++)
        wider[axis] = added[axis] > sides[axis] ? added[axis] : sides[axis];
    if ((uint64_t)wider[0] * wider[1] * wider[2] <= bytes)
        memcpy(sides, wider, sizeof wider);
}

/* Wide enough for the coarsest level of each body that does anything, one at a time, then for finer ones as far as it goes. */
static void choose_least(const nook_stream *stream, int kind, uint64_t bytes, uint32_t out_least[3])
{
    for (int axis = 0; axis < 3; axis++)
        out_least[axis] = 1;
    for (int step = 1; step <= NOOK_STREAM_LEVELS_MAX; step++) {
        for (uint32_t i = 0; i < stream->count; i++) {
            const stream_item *item = stream->volumes[i].items[kind];
            if (item && item->level_count >= step && item->levels[item->level_count - step].error < 1.0)
                widen(out_least, &item->levels[item->level_count - step].info, bytes);
        }
    }
}

/* Of each body the finest level that the least room holds. @return how many */
static uint32_t list_finest(const nook_stream *stream, int kind, const uint32_t least[3], const nook_volume_info **out)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < stream->count; i++) {
        const stream_item *item = stream->volumes[i].items[kind];
        for (int level = 0; item && level < item->level_count; level++) {
            const nook_volume_info *info = &item->levels[level].info;
            if (info->width > least[0] || info->height > least[1] || info->depth > least[2])
                continue;
            out[count++] = info;
            break;
        }
    }
    return count;
}

/* A column, a plate or a block: whichever holds most of the bodies at their finest. A cube may be as wide as a body and a half. */
static void choose_sides(const nook_stream *stream, int kind, uint64_t bytes, uint32_t out_least[3],
                         uint32_t out_sides[3])
{
    const nook_volume_info **infos = malloc((stream->count + (size_t)1) * sizeof(const nook_volume_info *));
    uint64_t best = 0;
    choose_least(stream, kind, bytes, out_least);
    uint32_t count = infos ? list_finest(stream, kind, out_least, infos) : 0;
    for (unsigned axes = 7; axes >= 1; axes--) {
        uint32_t sides[3] = { out_least[0], out_least[1], out_least[2] };
        while (grow_shortest(sides, axes, bytes))
            ;
        uint64_t held = nook_ao_fitting_bytes(sides, infos, count);
        if (axes == 7 || held > best) {
            best = held;
            memcpy(out_sides, sides, sizeof sides);
        }
    }
    free(infos);
}

static bool is_kept(const nook_stream *stream, int kind, uint64_t bytes, const uint32_t least[3])
{
    const uint32_t *sides = stream->sides[kind];
    bool kept =
        stream->tight && stream->rooms[kind] <= bytes && (double)stream->rooms[kind] >= kept_part * (double)bytes;
    for (int axis = 0; axis < 3; axis++)
        kept = kept && sides[axis] >= least[axis];
    return kept;
}

static nook_result make_atlas_room(nook_stream *stream, int kind, uint64_t bytes, bool *out_made)
{
    nook_ao_room room = { .bricks = 0 };
    uint32_t least[3];
    choose_sides(stream, kind, bytes, least, room.sides);
    *out_made = false;
    if (is_kept(stream, kind, bytes, least))
        return NOOK_OK;
    nook_result result = nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &room);
    if (result != NOOK_OK)
        return result;
    memcpy(stream->sides[kind], room.sides, sizeof room.sides);
    stream->rooms[kind] = (uint64_t)room.sides[0] * room.sides[1] * room.sides[2];
    *out_made = true;
    return NOOK_OK;
}

bool stream_room_holds(const nook_stream *stream, const stream_item *item, int level)
{
    const nook_volume_info *info = &item->levels[level].info;
    const uint32_t *sides = stream->sides[info->kind];
    return !stream->tight || info->kind == NOOK_VOLUME_SURFEL ||
           (info->width <= sides[0] && info->height <= sides[1] && info->depth <= sides[2]);
}

/* At least one, as none would be no room at all. */
static uint32_t rows_of(double rows)
{
    return (uint32_t)fmin(fmax(rows, 1.0), UINT32_MAX);
}

/* In the proportion that all of them have. */
static nook_result make_pool_room(nook_stream *stream, uint64_t bytes, bool *out_made)
{
    static const uint32_t least[3] = { 0, 0, 0 };
    double surfels = 0.0, all = 0.0;
    *out_made = false;
    if (is_kept(stream, NOOK_VOLUME_SURFEL, bytes, least))
        return NOOK_OK;
    for (uint32_t i = 0; i < stream->count; i++) {
        const stream_item *item = stream->volumes[i].items[NOOK_VOLUME_SURFEL];
        if (!item)
            continue;
        surfels += (double)item->levels[0].info.occupied * sizeof(nook_surfel);
        all += (double)item->levels[0].bytes;
    }
    double share = all > 0.0 ? surfels / all : 0.5;
    nook_ao_room room = { .surfels = rows_of((double)bytes * share / sizeof(nook_surfel)),
                          .bricks = rows_of((double)bytes * (1.0 - share) / sizeof(nook_brick)) };
    nook_result result = nook_ao_set_room(stream->ao, NOOK_VOLUME_SURFEL, &room);
    if (result != NOOK_OK)
        return result;
    stream->rooms[NOOK_VOLUME_SURFEL] = room.bricks * sizeof(nook_brick) + room.surfels * sizeof(nook_surfel);
    *out_made = true;
    return NOOK_OK;
}

/* What a kind takes at its finest. */
static double kind_weight(const nook_stream *stream, int kind)
{
    double bytes = 0.0;
    for (uint32_t i = 0; i < stream->count; i++) {
        const stream_item *item = stream->volumes[i].items[kind];
        bytes += item ? (double)item->levels[0].bytes : 0.0;
    }
    return bytes;
}

/* Of another room its owner knows what is still there. */
static void look_again(nook_stream *stream, int kind)
{
    for (uint32_t i = 0; i < stream->count; i++) {
        stream_item *item = stream->volumes[i].items[kind];
        if (!item)
            continue;
        stream_cancel(stream, item);
        if (!nook_ao_has_volume(stream->ao, item->volume, (nook_volume_kind)kind))
            item->resident = LEVEL_NONE;
    }
}

static nook_result make_rooms(nook_stream *stream)
{
    const nook_ao_room none = { .bricks = 0 };
    double weights = 0.0;
    nook_result result = NOOK_OK;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        weights += kind_weight(stream, kind);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS && result == NOOK_OK; kind++) {
        double share = weights > 0.0 ? kind_weight(stream, kind) / weights : 0.0;
        uint64_t bytes = (uint64_t)((double)stream_budget_bytes(stream) * share);
        bool made;
        if (share == 0.0 && stream->rooms[kind] > 0) {
            stream->rooms[kind] = 0;
            nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &none); /* cannot fail */
        }
        if (share == 0.0)
            continue;
        result = kind == NOOK_VOLUME_SURFEL ? make_pool_room(stream, bytes, &made)
                                            : make_atlas_room(stream, kind, bytes, &made);
        if (result == NOOK_OK && made)
            look_again(stream, kind);
    }
    stream->tight = true;
    return result;
}

nook_result stream_fit(nook_stream *stream)
{
    const nook_ao_room none = { .bricks = 0 };
    uint64_t budget = stream_budget_bytes(stream);
    if (budget == UINT64_MAX || bytes_of_all(stream) <= budget) {
        for (int kind = 0; kind < NOOK_VOLUME_KINDS && stream->tight; kind++) {
            nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &none); /* cannot fail */
            stream->rooms[kind] = 0;
        }
        stream->tight = false;
        if (place_all(stream) || budget == UINT64_MAX)
            return NOOK_OK;
    }
    return make_rooms(stream);
}
