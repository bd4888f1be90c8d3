/* How much memory each kind has, and in which shape. */
#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "modules/stream/stream_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_STEP = 8, SIDE_MAX = 2048 /* of a 3D texture: every device takes it */ };

static double mib_of(uint64_t bytes)
{
    return (double)bytes / NOOK_MIB;
}

/* A room that is a little smaller than it could be stays: another one costs copying. */
static const double kept_part = 0.8;

uint64_t stream_memory(const nook_stream *stream)
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
        stream_memory(stream) > stream_budget_bytes(stream))
        stream->stale = true;
}

/* What others have added stays, and comes first. */
typedef struct kept_volumes {
    nook_volume_info *infos; /* owned */
    uint32_t count;
    uint64_t bytes;
} kept_volumes;

static bool list_kept(const nook_stream *stream, int kind, kept_volumes *out)
{
    uint32_t count = nook_ao_list_kept(stream->ao, (nook_volume_kind)kind, NULL, 0);
    out->infos = malloc((count + (size_t)1) * sizeof *out->infos);
    out->count = out->infos ? nook_ao_list_kept(stream->ao, (nook_volume_kind)kind, out->infos, count) : 0;
    out->bytes = nook_ao_kept_bytes(stream->ao, (nook_volume_kind)kind);
    return out->infos != NULL;
}

/* Room for a pointer to each of them, and behind these for one to each body. @return NULL: no memory */
static const nook_volume_info **make_list(const nook_stream *stream, const kept_volumes *kept)
{
    size_t capacity = kept->count + (size_t)stream->count + 1;
    const nook_volume_info **list = malloc(capacity * sizeof(const nook_volume_info *));
    for (uint32_t i = 0; list && i < kept->count; i++)
        list[i] = &kept->infos[i];
    return list;
}

static uint64_t bytes_of_kind(const nook_stream *stream, int kind)
{
    kept_volumes kept;
    uint64_t bytes = UINT64_MAX;
    const nook_volume_info **list = list_kept(stream, kind, &kept) ? make_list(stream, &kept) : NULL;
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

/* Bytes of everything at its finest. UINT64_MAX without memory to tell. */
static uint64_t bytes_of_all(const nook_stream *stream)
{
    uint64_t bytes = 0;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        uint64_t own = bytes_of_kind(stream, kind);
        bytes = own > UINT64_MAX - bytes ? UINT64_MAX : bytes + own;
    }
    return bytes;
}

static bool place_all(nook_stream *stream)
{
    bool placed = true;
    STREAM_EACH(stream, item)
    placed = placed && place_finest(stream, item);
    return placed && stream_memory(stream) <= stream_budget_bytes(stream);
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

/* Wide enough for each that stays, for the coarsest level of each body that does anything, one at a time, then for finer ones as far as
   it goes. */
static void choose_least(const nook_stream *stream, int kind, uint64_t bytes, const kept_volumes *kept,
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

/* A column, a plate or a block: whichever holds most of the bodies at their finest, beside all that stays. A cube may be as wide as a body
   and a half. @return false: none holds what stays, or there is no memory */
static bool choose_sides(const nook_stream *stream, int kind, uint64_t bytes, const kept_volumes *kept,
                         uint32_t out_least[3], uint32_t out_sides[3])
{
    const nook_volume_info **list = make_list(stream, kept);
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

/* The least that a room may have for what stays in it. */
static uint64_t bytes_for_kept(const nook_stream *stream, int kind, const kept_volumes *kept)
{
    uint64_t bytes = kept->bytes;
    uint32_t least[3], sides[3];
    if (kind == NOOK_VOLUME_SURFEL || kept->count == 0)
        return bytes;
    while (bytes < 8 * kept->bytes && !choose_sides(stream, kind, bytes, kept, least, sides))
        bytes += bytes / 16 + 1;
    return bytes;
}

/* Unless others have made it grow. */
static bool is_room_good(const nook_stream *stream, int kind, uint64_t bytes, const uint32_t least[3])
{
    const uint32_t *sides = stream->sides[kind];
    uint64_t room = stream->rooms[kind];
    bool good = stream->tight && room <= bytes && (double)room >= kept_part * (double)bytes &&
                nook_ao_kind_bytes(stream->ao, (nook_volume_kind)kind) <= room;
    for (int axis = 0; axis < 3; axis++)
        good = good && sides[axis] >= least[axis];
    return good;
}

static nook_result make_atlas_room(nook_stream *stream, int kind, uint64_t bytes, const kept_volumes *kept,
                                   bool *out_made)
{
    nook_ao_room room = { .bricks = 0 };
    uint32_t least[3];
    *out_made = false;
    if (!choose_sides(stream, kind, bytes, kept, least, room.sides))
        return nook_fail(NOOK_E_RANGE, "%.4f MiB of room for volumes do not hold what stays, %.4f: give more",
                         mib_of(bytes), mib_of(kept->bytes));
    if (is_room_good(stream, kind, bytes, least))
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
    if (!stream->tight)
        return true;
    return item->levels[level].bytes + stream->kept[info->kind] <= stream->rooms[info->kind] &&
           (info->kind == NOOK_VOLUME_SURFEL ||
            (info->width <= sides[0] && info->height <= sides[1] && info->depth <= sides[2]));
}

/* At least one, as none would be no room at all. */
static uint32_t rows_of(double rows)
{
    return (uint32_t)fmin(fmax(rows, 1.0), UINT32_MAX);
}

static uint64_t bricks_of(const nook_volume_info *info)
{
    return (nook_volume_gpu_bytes(info) - info->occupied * sizeof(nook_surfel)) / sizeof(nook_brick);
}

/* Of the bytes that all of them have. */
static double surfel_share(const nook_stream *stream)
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

static nook_ao_room pool_room_of(const kept_volumes *kept)
{
    nook_ao_room room = { .bricks = 0 };
    for (uint32_t i = 0; i < kept->count; i++) {
        room.bricks += (uint32_t)bricks_of(&kept->infos[i]);
        room.surfels += (uint32_t)kept->infos[i].occupied;
    }
    return room;
}

static nook_result make_pool_room(nook_stream *stream, uint64_t bytes, const kept_volumes *kept, bool *out_made)
{
    static const uint32_t least[3] = { 0, 0, 0 };
    *out_made = false;
    if (is_room_good(stream, NOOK_VOLUME_SURFEL, bytes, least))
        return NOOK_OK;
    double share = surfel_share(stream), left = bytes > kept->bytes ? (double)(bytes - kept->bytes) : 0.0;
    nook_ao_room room = pool_room_of(kept);
    room.surfels += rows_of(left * share / sizeof(nook_surfel));
    room.bricks += rows_of(left * (1.0 - share) / sizeof(nook_brick));
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

/* Of a kind in which nothing comes any more only what stays keeps memory. */
static void end_room(nook_stream *stream, int kind, const kept_volumes *kept)
{
    const nook_ao_room none = { .bricks = 0 };
    nook_ao_room room = pool_room_of(kept);
    uint32_t least[3];
    bool held =
        kept->count > 0 && (kind == NOOK_VOLUME_SURFEL ||
                            choose_sides(stream, kind, bytes_for_kept(stream, kind, kept), kept, least, room.sides));
    if (held)
        (void)nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &room); /* else the one that is there stays */
    nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &none);           /* cannot fail */
    stream->rooms[kind] = 0;
}

/* What the kinds share. */
typedef struct shares {
    kept_volumes kept[NOOK_VOLUME_KINDS];
    uint64_t least[NOOK_VOLUME_KINDS]; /* bytes that what stays takes of it */
    double share[NOOK_VOLUME_KINDS];   /* of what is left, [0, 1] */
    uint64_t taken;                    /* by all that stays */
} shares;

static nook_result find_shares(const nook_stream *stream, shares *out)
{
    double weights = 0.0;
    bool listed = true;
    *out = (shares){ .taken = 0 };
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        weights += kind_weight(stream, kind);
        listed = listed && list_kept(stream, kind, &out->kept[kind]);
    }
    for (int kind = 0; kind < NOOK_VOLUME_KINDS && listed; kind++) {
        double weight = kind_weight(stream, kind);
        out->share[kind] = weights > 0.0 ? weight / weights : 0.0;
        out->least[kind] = bytes_for_kept(stream, kind, &out->kept[kind]);
        if (weight == 0.0 && stream->rooms[kind] == 0) /* it is as others have made it */
            out->least[kind] = nook_ao_kind_bytes(stream->ao, (nook_volume_kind)kind);
        out->taken += out->least[kind];
    }
    return listed ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "stream: no memory to share room");
}

/* Whether a volume finds a place beside what stays. */
static bool fits_beside(const uint32_t sides[3], const nook_volume_info **list, const kept_volumes *kept,
                        const nook_volume_info *info)
{
    list[kept->count] = info;
    return nook_ao_fitting_bytes(sides, list, kept->count + 1) == kept->bytes + nook_volume_gpu_bytes(info);
}

/* Of a kind's room, for what stays and one volume more. */
static double bytes_with(const nook_stream *stream, const kept_volumes *kept, const nook_volume_info *info)
{
    double own = (double)nook_volume_gpu_bytes(info);
    if (info->kind == NOOK_VOLUME_SURFEL) {
        double share = surfel_share(
            stream); /* of a room of theirs surfels have so much, bricks the rest; a row of each is rounded off */
        own = fmax((double)(info->occupied + 1) * sizeof(nook_surfel) / share,
                   (double)(bricks_of(info) + 1) * sizeof(nook_brick) / (1.0 - share));
    } else if (kept->count > 0) {
        const nook_volume_info **list = make_list(stream, kept);
        uint64_t bytes = kept->bytes + (uint64_t)own, most = 8 * bytes;
        uint32_t least[3], sides[3];
        while (
            list && bytes < most &&
            !(choose_sides(stream, (int)info->kind, bytes, kept, least, sides) && fits_beside(sides, list, kept, info)))
            bytes += bytes / 16 + 1;
        free(list);
        return (double)bytes;
    }
    return (double)kept->bytes + own;
}

/* Of a body the coarsest level that does anything. @return LEVEL_NONE: none does */
static int coarsest(const stream_item *item)
{
    int level = stream_finer(item, LEVEL_NONE);
    while (level != LEVEL_NONE && item->levels[level].error >= 1.0)
        level = stream_finer(item, level);
    return level;
}

/* The least budget with which anything comes: of each kind the smallest volume is looked at. */
static double least_budget(const nook_stream *stream, const shares *s)
{
    double least = INFINITY;
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        const nook_volume_info *smallest = NULL;
        for (uint32_t i = 0; i < stream->count; i++) {
            const stream_item *item = stream->volumes[i].items[kind];
            int level = item ? coarsest(item) : LEVEL_NONE;
            const nook_volume_info *info = level == LEVEL_NONE ? NULL : &item->levels[level].info;
            if (info && (!smallest || nook_volume_gpu_bytes(info) < nook_volume_gpu_bytes(smallest)))
                smallest = info;
        }
        if (smallest)
            least =
                fmin(least, (double)s->taken + (bytes_with(stream, &s->kept[kind], smallest) - (double)s->least[kind]) /
                                                   s->share[kind]);
    }
    return least;
}

/* Whether there is a volume that has a place in its room, if it is alone there beside what stays. */
static bool anything_has_room(const nook_stream *stream, const shares *s)
{
    bool any = false;
    STREAM_EACH(stream, item)
    {
        int level = coarsest(item);
        if (any || level == LEVEL_NONE || !stream_room_holds(stream, item, level))
            continue;
        const nook_volume_info *info = &item->levels[level].info;
        const kept_volumes *kept = &s->kept[info->kind];
        const nook_volume_info **list = make_list(stream, kept);
        any = list && (info->kind == NOOK_VOLUME_SURFEL || fits_beside(stream->sides[info->kind], list, kept, info));
        free(list);
    }
    return any;
}

/* Of what is asked for, never less than enough. */
static double mib_up(double bytes)
{
    return ceil(bytes / NOOK_MIB * 1e4) / 1e4;
}

/* Once for a budget. */
static void tell_if_too_small(nook_stream *stream, const shares *s)
{
    float budget = stream->params.budget;
    bool small = stream->item_count > 0 && !anything_has_room(stream, s);
    double least = small && stream->told_budget != budget ? least_budget(stream, s) : INFINITY;
    if (isfinite(least))
        nook_log_warning("volumes.budget = %g MiB holds none of the %u volumes that come and go: the first needs %.4f, "
                         "all at their finest %.4f",
                         (double)budget, stream->item_count, mib_up(least), mib_up((double)bytes_of_all(stream)));
    stream->told_budget = small ? budget : 0.0f;
}

/* All that comes and goes is gone, as there is no room for it beside what stays. */
static nook_result give_up(nook_stream *stream, const shares *s)
{
    double least = least_budget(stream, s);
    STREAM_EACH(stream, item)
    {
        stream_cancel(stream, item);
        stream_drop(stream, item);
    }
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        end_room(stream, kind, &s->kept[kind]);
    return nook_fail(NOOK_E_RANGE,
                     "volumes.budget = %g MiB does not hold the volumes that always stay, %.4f: nothing else comes; "
                     "with %.4f something does",
                     (double)stream->params.budget, mib_up((double)s->taken),
                     mib_up(isfinite(least) ? least : (double)s->taken));
}

static nook_result make_rooms_of(nook_stream *stream, const shares *s)
{
    nook_result result = NOOK_OK;
    uint64_t budget = stream_budget_bytes(stream);
    if (s->taken > budget)
        return give_up(stream, s);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS && result == NOOK_OK; kind++) {
        uint64_t bytes = s->least[kind] + (uint64_t)((double)(budget - s->taken) * s->share[kind]);
        bool made;
        if (s->share[kind] == 0.0 && stream->rooms[kind] > 0)
            end_room(stream, kind, &s->kept[kind]);
        if (s->share[kind] == 0.0)
            continue;
        result = kind == NOOK_VOLUME_SURFEL ? make_pool_room(stream, bytes, &s->kept[kind], &made)
                                            : make_atlas_room(stream, kind, bytes, &s->kept[kind], &made);
        if (result == NOOK_OK && made)
            look_again(stream, kind);
    }
    if (result == NOOK_OK)
        tell_if_too_small(stream, s);
    return result;
}

static nook_result make_rooms(nook_stream *stream)
{
    shares s;
    nook_result result = find_shares(stream, &s);
    if (result == NOOK_OK)
        result = make_rooms_of(stream, &s);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        free(s.kept[kind].infos);
    stream->tight = true;
    return result;
}

static nook_result fit(nook_stream *stream)
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

nook_result stream_fit(nook_stream *stream)
{
    nook_result result = fit(stream);
    stream->fitted = stream_memory(stream);
    return result;
}
