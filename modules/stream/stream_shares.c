#include "engine/core/log.h"
#include "engine/core/mebibyte.h"
#include "modules/stream/stream_shares_internal.h"
#include <math.h>
#include <stdlib.h>

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

/* For what stays. */
static uint64_t bytes_for_kept(const nook_stream *stream, int kind, const stream_kept *kept)
{
    return kind == NOOK_VOLUME_SURFEL ? kept->bytes : stream_least_room(stream, kind, kept, NULL);
}

nook_result stream_shares_find(const nook_stream *stream, stream_shares *out)
{
    double weights = 0.0;
    bool listed = true;
    *out = (stream_shares){ .taken = 0 };
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++) {
        weights += kind_weight(stream, kind);
        listed = listed && stream_kept_list(stream, kind, &out->kept[kind]);
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

void stream_shares_release(stream_shares *shares)
{
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        free(shares->kept[kind].infos);
}

/* ---- Too little ----------------------------------------------------------------------------------------------------- */

/* Of a kind's room, for what stays and one volume more. Of a room of theirs surfels have their share, bricks the rest; a row of each is rounded
   off. */
static double bytes_with(const nook_stream *stream, const stream_kept *kept, const nook_volume_info *info)
{
    if (info->kind != NOOK_VOLUME_SURFEL)
        return (double)stream_least_room(stream, (int)info->kind, kept, info);
    double share = stream_surfel_share(stream);
    return (double)kept->bytes + fmax((double)(info->occupied + 1) * sizeof(nook_surfel) / share,
                                      (double)(stream_bricks_of(info) + 1) * sizeof(nook_brick) / (1.0 - share));
}

/* Of a body the coarsest level that does anything. @return LEVEL_NONE: none does */
static int coarsest(const stream_item *item)
{
    int level = stream_finer(item, LEVEL_NONE);
    while (level != LEVEL_NONE && item->levels[level].error >= 1.0)
        level = stream_finer(item, level);
    return level;
}

/* Of each kind the smallest volume is looked at. */
double stream_least_budget(const nook_stream *stream, const stream_shares *s)
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
static bool anything_has_room(const nook_stream *stream, const stream_shares *s)
{
    bool any = false;
    STREAM_EACH(stream, item)
    {
        int level = coarsest(item);
        if (any || level == LEVEL_NONE || !stream_room_holds(stream, item, level))
            continue;
        const nook_volume_info *info = &item->levels[level].info;
        const stream_kept *kept = &s->kept[info->kind];
        const nook_volume_info **list = stream_kept_make_list(stream, kept);
        any = list &&
              (info->kind == NOOK_VOLUME_SURFEL || stream_fits_beside(stream->sides[info->kind], list, kept, info));
        free(list);
    }
    return any;
}

double stream_mib_up(double bytes)
{
    return ceil(bytes / NOOK_MIB * 1e4) / 1e4;
}

void stream_tell_if_too_small(nook_stream *stream, const stream_shares *s)
{
    float budget = stream->params.budget;
    bool small = stream->item_count > 0 && !anything_has_room(stream, s);
    double least = small && stream->told_budget != budget ? stream_least_budget(stream, s) : INFINITY;
    if (isfinite(least))
        nook_log_warning("volumes.budget = %g MiB holds none of the %u volumes that come and go: the first needs %.4f, "
                         "all at their finest %.4f",
                         (double)budget, stream->item_count, stream_mib_up(least),
                         stream_mib_up((double)stream_bytes_of_all(stream)));
    stream->told_budget = small ? budget : 0.0f;
}
