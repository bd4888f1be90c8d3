/* Makes the rooms: how much memory each kind has. Their shapes are chosen in stream_shape.c, what each may have in stream_shares.c. */
#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "modules/stream/stream_shares_internal.h"
#include <math.h>
#include <string.h>

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

static bool place_all(nook_stream *stream)
{
    bool placed = true;
    STREAM_EACH(stream, item)
    placed = placed && place_finest(stream, item);
    return placed && stream_memory(stream) <= stream_budget_bytes(stream);
}

/* ---- Where it does not --------------------------------------------------------------------------------------------- */

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

static nook_result make_atlas_room(nook_stream *stream, int kind, uint64_t bytes, const stream_kept *kept,
                                   bool *out_made)
{
    nook_ao_room room = { .bricks = 0 };
    uint32_t least[3];
    *out_made = false;
    if (!stream_choose_sides(stream, kind, bytes, kept, least, room.sides))
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

static nook_result make_pool_room(nook_stream *stream, uint64_t bytes, const stream_kept *kept, bool *out_made)
{
    static const uint32_t least[3] = { 0, 0, 0 };
    *out_made = false;
    if (is_room_good(stream, NOOK_VOLUME_SURFEL, bytes, least))
        return NOOK_OK;
    double share = stream_surfel_share(stream), left = bytes > kept->bytes ? (double)(bytes - kept->bytes) : 0.0;
    nook_ao_room room = stream_pool_room_of(kept);
    room.surfels += rows_of(left * share / sizeof(nook_surfel));
    room.bricks += rows_of(left * (1.0 - share) / sizeof(nook_brick));
    nook_result result = nook_ao_set_room(stream->ao, NOOK_VOLUME_SURFEL, &room);
    if (result != NOOK_OK)
        return result;
    stream->rooms[NOOK_VOLUME_SURFEL] = room.bricks * sizeof(nook_brick) + room.surfels * sizeof(nook_surfel);
    *out_made = true;
    return NOOK_OK;
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
static void end_room(nook_stream *stream, int kind, const stream_kept *kept)
{
    const nook_ao_room none = { .bricks = 0 };
    nook_ao_room room = stream_pool_room_of(kept);
    uint32_t least[3];
    bool held = kept->count > 0 && (kind == NOOK_VOLUME_SURFEL ||
                                    stream_choose_sides(stream, kind, stream_least_room(stream, kind, kept, NULL), kept,
                                                        least, room.sides));
    if (held)
        (void)nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &room); /* else the one that is there stays */
    nook_ao_set_room(stream->ao, (nook_volume_kind)kind, &none);           /* cannot fail */
    stream->rooms[kind] = 0;
}

/* All that comes and goes is gone, as there is no room for it beside what stays. */
static nook_result give_up(nook_stream *stream, const stream_shares *s)
{
    double least = stream_least_budget(stream, s);
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
                     (double)stream->params.budget, stream_mib_up((double)s->taken),
                     stream_mib_up(isfinite(least) ? least : (double)s->taken));
}

static nook_result make_rooms_of(nook_stream *stream, const stream_shares *s)
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
        stream_tell_if_too_small(stream, s);
    return result;
}

static nook_result make_rooms(nook_stream *stream)
{
    stream_shares s;
    nook_result result = stream_shares_find(stream, &s);
    if (result == NOOK_OK)
        result = make_rooms_of(stream, &s);
    stream_shares_release(&s);
    stream->tight = true;
    return result;
}

static nook_result fit(nook_stream *stream)
{
    const nook_ao_room none = { .bricks = 0 };
    uint64_t budget = stream_budget_bytes(stream);
    if (budget == UINT64_MAX || stream_bytes_of_all(stream) <= budget) {
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
