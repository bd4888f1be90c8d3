#include "modules/stream/stream_shape_internal.h"
#include <stdlib.h>
#include <string.h>

enum { SIDE_STEP = 8, SIDE_MAX = 2048 /* of a 3D texture: every device takes it */ };

/* Boxes leave gaps, so a room is more than what it holds: up to so many times that is tried, a sixteenth more each time. */
enum { LOOSEST = 8, FINENESS = 16 };

/* ---- Lists ---------------------------------------------------------------------------------------------------------- */

bool stream_kept_list(const nook_stream *stream, int kind, stream_kept *out)
{
    uint32_t count = nook_ao_list_kept(stream->ao, (nook_volume_kind)kind, NULL, 0);
    out->infos = malloc((count + (size_t)1) * sizeof *out->infos);
    out->count = out->infos ? nook_ao_list_kept(stream->ao, (nook_volume_kind)kind, out->infos, count) : 0;
    out->bytes = nook_ao_kept_bytes(stream->ao, (nook_volume_kind)kind);
    return out->infos != NULL;
}

const nook_volume_info **stream_kept_make_list(const nook_stream *stream, const stream_kept *kept)
{
    size_t capacity = kept->count + (size_t)stream->count + 1;
    const nook_volume_info **list = malloc(capacity * sizeof(const nook_volume_info *));
    for (uint32_t i = 0; list && i < kept->count; i++)
        list[i] = &kept->infos[i];
    return list;
}

static uint64_t bytes_of_kind(const nook_stream *stream, int kind)
{
    stream_kept kept;
    uint64_t bytes = UINT64_MAX;
    const nook_volume_info **list = stream_kept_list(stream, kind, &kept) ? stream_kept_make_list(stream, &kept) : NULL;
    if (list) {
        uint32_t count = kept.count;
        for (uint32_t i = 0; i < stream->count; i++) {
            const stream_item *item = stream->volumes[i].items[kind];
            if (item && stream_finest(item) != LEVEL_NONE)
                list[count++] = &item->levels[stream_finest(item)].info;
        }
        bytes = nook_ao_packed_bytes((nook_volume_kind)kind, list, count);
    }
    free(list);
    free(kept.infos);
    return bytes;
}

uint64_t stream_bytes_of_all(const nook_stream *stream)
{
    uint64_t bytes = 0;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        uint64_t own = bytes_of_kind(stream, kind);
        bytes = own > UINT64_MAX - bytes ? UINT64_MAX : bytes + own;
    }
    return bytes;
}

/* ---- Of voxels ------------------------------------------------------------------------------------------------------ */

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

/* Wide enough for each that stays, for the coarsest level of each body that does anything, one at a time, then for finer ones as far as
   it goes. */
static void choose_least(const nook_stream *stream, int kind, uint64_t bytes, const stream_kept *kept,
                         uint32_t out_least[3])
{
    for (int axis = 0; axis < 3; axis++)
        out_least[axis] = 1;
    for (uint32_t i = 0; i < kept->count; i++)
        widen(out_least, &kept->infos[i], UINT64_MAX);
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

bool stream_choose_sides(const nook_stream *stream, int kind, uint64_t bytes, const stream_kept *kept,
                         uint32_t out_least[3], uint32_t out_sides[3])
{
    const nook_volume_info **list = stream_kept_make_list(stream, kept);
    uint64_t best = 0;
    bool any = false;
    choose_least(stream, kind, bytes, kept, out_least);
    uint32_t count = list ? kept->count + list_finest(stream, kind, out_least, list + kept->count) : 0;
    for (unsigned axes = 7; axes >= 1 && list; axes--) {
        uint32_t sides[3] = { out_least[0], out_least[1], out_least[2] };
        while (grow_shortest(sides, axes, bytes))
            ;
        if ((uint64_t)sides[0] * sides[1] * sides[2] > bytes ||
            nook_ao_fitting_bytes(sides, list, kept->count) < kept->bytes)
            continue;
        uint64_t held = nook_ao_fitting_bytes(sides, list, count);
        if (!any || held > best) {
            any = true;
            best = held;
            memcpy(out_sides, sides, sizeof sides);
        }
    }
    free(list);
    return any;
}

bool stream_fits_beside(const uint32_t sides[3], const nook_volume_info **list, const stream_kept *kept,
                        const nook_volume_info *info)
{
    list[kept->count] = info;
    return nook_ao_fitting_bytes(sides, list, kept->count + 1) == kept->bytes + nook_volume_gpu_bytes(info);
}

uint64_t stream_least_room(const nook_stream *stream, int kind, const stream_kept *kept, const nook_volume_info *beside)
{
    uint64_t bytes = kept->bytes + (beside ? nook_volume_gpu_bytes(beside) : 0), most = LOOSEST * bytes;
    uint32_t least[3], sides[3];
    if (kept->count == 0)
        return bytes;
    const nook_volume_info **list = stream_kept_make_list(stream, kept);
    while (list && bytes < most &&
           !(stream_choose_sides(stream, kind, bytes, kept, least, sides) &&
             (!beside || stream_fits_beside(sides, list, kept, beside))))
        bytes += bytes / FINENESS + 1;
    free(list);
    return bytes;
}

/* ---- Of surfels ----------------------------------------------------------------------------------------------------- */

uint64_t stream_bricks_of(const nook_volume_info *info)
{
    return (nook_volume_gpu_bytes(info) - info->occupied * sizeof(nook_surfel)) / sizeof(nook_brick);
}

double stream_surfel_share(const nook_stream *stream)
{
    double surfels = 0.0, all = 0.0;
    for (uint32_t i = 0; i < stream->count; i++) {
        const stream_item *item = stream->volumes[i].items[NOOK_VOLUME_SURFEL];
        if (!item)
            continue;
        surfels += (double)item->levels[0].info.occupied * sizeof(nook_surfel);
        all += (double)item->levels[0].bytes;
    }
    return all > 0.0 ? surfels / all : 0.5;
}

nook_ao_room stream_pool_room_of(const stream_kept *kept)
{
    nook_ao_room room = { .bricks = 0 };
    for (uint32_t i = 0; i < kept->count; i++) {
        room.bricks += (uint32_t)stream_bricks_of(&kept->infos[i]);
        room.surfels += (uint32_t)kept->infos[i].occupied;
    }
    return room;
}
