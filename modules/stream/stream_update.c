/* A frame's work. */
#include "engine/core/mebibyte.h"
#include "modules/stream/stream_internal.h"

enum { TRIES = 8 /* of a frame, to find places */ };
enum { PAUSE_FIRST = 60, PAUSE_DOUBLINGS = 8 /* updates: a second or so at first, minutes at last */ };

/* ---- Asking -------------------------------------------------------------------------------------------------------- */

/* The level to ask for next. What is not there at all begins with the coarsest that does anything: that is there soonest. */
static int next_level(const nook_stream *stream, const stream_item *item)
{
    int level = LEVEL_NONE;
    if (!stream->tight || item->resident != LEVEL_NONE)
        return item->target;
    do
        level = stream_finer(item, level);
    while (level != item->target && stream_error(item, level) >= 1.0);
    return level;
}

static bool is_finer(int a, int b)
{
    return a != LEVEL_NONE && (b == LEVEL_NONE || a < b);
}

/* Whether it has a place and is not asked for, or has none and wants one. */
static bool waits(const stream_item *item)
{
    return item->coming != LEVEL_NONE ? item->job == LOADER_NONE : is_finer(item->target, item->resident);
}

/* What reading it does for the picture, for a byte. */
static double urgency(const nook_stream *stream, const stream_item *item)
{
    int level = item->coming != LEVEL_NONE ? item->coming : next_level(stream, item);
    double gain = stream_error(item, item->resident) - stream_error(item, level);
    return item->importance * gain / (double)(stream_bytes(item, level) + 1);
}

static stream_item *most_urgent(nook_stream *stream)
{
    stream_item *best = NULL;
    double best_urgency = 0.0;
    STREAM_EACH(stream, item)
    {
        double own = waits(item) && !item->passed_over ? urgency(stream, item) : -1.0;
        if (own >= 0.0 && (!best || own > best_urgency)) {
            best = item;
            best_urgency = own;
        }
    }
    return best;
}

/* There, not wanted at all (or, with `coarser`, not as fine as it is), and for the least. */
static stream_item *least_wanted(nook_stream *stream, nook_volume_kind kind, bool coarser)
{
    stream_item *least = NULL;
    for (uint32_t i = 0; i < stream->count; i++) {
        stream_item *item = stream->volumes[i].items[kind];
        if (!item || item->resident == LEVEL_NONE || item->coming != LEVEL_NONE)
            continue;
        bool fits = coarser ? item->target > item->resident : item->target == LEVEL_NONE;
        if (fits && (!least || item->importance < least->importance))
            least = item;
    }
    return least;
}

static void evict(nook_stream *stream, stream_item *item)
{
    stream_drop(stream, item);
    stream->evictions++;
    stream->settled = false;
}

/* A place for a level; what is not wanted any more goes for it, the least wanted first. */
static bool find_place(nook_stream *stream, stream_item *item, int level)
{
    const nook_volume_info *info = &item->levels[level].info;
    while (!nook_ao_place_volume(stream->ao, item->volume, info)) {
        stream_item *victim = least_wanted(stream, info->kind, false);
        if (!victim)
            return false;
        evict(stream, victim);
    }
    item->coming = level;
    return true;
}

static void start(nook_stream *stream, stream_item *item)
{
    const stream_level *level = &item->levels[item->coming];
    item->job = stream_loader_start(stream->loader, level->path, &level->info);
    if (item->job != LOADER_NONE)
        stream->of_job[item->job] = item;
    stream->settled = false;
}

/* Where nothing unwanted is left, what is finer than it is wanted becomes coarser; without a place even for that it goes at once. */
static void coarsen(nook_stream *stream, nook_volume_kind kind)
{
    stream_item *item = least_wanted(stream, kind, true);
    if (!item)
        return;
    if (find_place(stream, item, item->target))
        start(stream, item);
    else
        evict(stream, item);
}

static void ask(nook_stream *stream)
{
    uint32_t pressed = 0; /* kinds */
    STREAM_EACH(stream, item)
    item->passed_over = false;
    for (int i = 0; i < TRIES && stream_loader_has_room(stream->loader); i++) {
        stream_item *item = most_urgent(stream);
        if (!item)
            break;
        if (item->coming != LEVEL_NONE || find_place(stream, item, next_level(stream, item))) {
            start(stream, item);
            continue;
        }
        item->passed_over = true;
        pressed |= NOOK_VOLUME_BIT(item->levels[0].info.kind);
    }
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        if (pressed & NOOK_VOLUME_BIT(kind) && stream_loader_has_room(stream->loader))
            coarsen(stream, (nook_volume_kind)kind);
}

/* ---- Taking -------------------------------------------------------------------------------------------------------- */

/* What has no memory or too many files open now may have them later; what is damaged, another volume's or gone stays so. */
static bool may_pass(nook_result result)
{
    return result == NOOK_E_MEMORY || result == NOOK_E_IO;
}

/* Its file cannot be used, as the log says: its body does without, or with a coarser one. */
static void refuse(nook_stream *stream, stream_item *item, nook_result why)
{
    stream_level *level = &item->levels[item->coming];
    level->refused = true;
    if (may_pass(why)) {
        uint32_t doublings = level->failed < PAUSE_DOUBLINGS ? level->failed++ : PAUSE_DOUBLINGS;
        level->pause = (uint32_t)PAUSE_FIRST << doublings;
        stream->pauses++;
    }
    item->target = item->resident; /* until the next update */
    stream_cancel(stream, item);
    stream->settled = false;
}

/* The job that is written on, else one that has been read. */
static int next_to_write(nook_stream *stream, nook_volume **out_contents)
{
    nook_result result;
    if (stream->writing != LOADER_NONE) {
        stream_loader_is_done(stream->loader, stream->writing, &result, out_contents);
        return stream->writing;
    }
    for (int job = 0; job < LOADER_JOBS; job++) {
        if (!stream->of_job[job] || !stream_loader_is_done(stream->loader, job, &result, out_contents))
            continue;
        if (result == NOOK_OK)
            return job;
        refuse(stream, stream->of_job[job], result);
    }
    return LOADER_NONE;
}

static void arrive(nook_stream *stream, stream_item *item)
{
    stream->of_job[item->job] = NULL;
    stream_loader_free(stream->loader, item->job);
    item->levels[item->coming].failed = 0;
    item->resident = item->coming;
    item->coming = LEVEL_NONE;
    item->job = LOADER_NONE;
    stream->writing = LOADER_NONE;
    stream->loads++;
}

static nook_result upload(nook_stream *stream)
{
    size_t left = (size_t)((double)stream->params.upload * NOOK_MIB);
    stream->frame_upload = 0;
    for (;;) {
        nook_volume *contents = NULL;
        nook_ao_written written;
        int job = next_to_write(stream, &contents);
        if (job == LOADER_NONE)
            break;
        stream_item *item = stream->of_job[job];
        nook_result result = nook_ao_write_volume(stream->ao, item->volume, contents, left, &written);
        if (result != NOOK_OK) {
            stream_cancel(stream, item);
            return result;
        }
        left -= written.bytes;
        stream->frame_upload += written.bytes;
        if (!written.whole) {
            stream->writing = job;
            break;
        }
        arrive(stream, item);
    }
    if (stream->frame_upload > stream->largest_upload)
        stream->largest_upload = stream->frame_upload;
    return NOOK_OK;
}

/* ---- The frame ----------------------------------------------------------------------------------------------------- */

static bool anything_comes(const nook_stream *stream)
{
    STREAM_EACH(stream, item)
    if (item->coming != LEVEL_NONE)
        return true;
    return false;
}

/* Pauses of what was refused go on; what they are over for is asked for again. */
static void count_pauses(nook_stream *stream)
{
    if (stream->pauses == 0)
        return;
    stream->pauses = 0;
    STREAM_EACH(stream, item)
    {
        for (int level = 0; level < item->level_count; level++) {
            stream_level *own = &item->levels[level];
            if (own->pause == 0)
                continue;
            own->refused = --own->pause > 0;
            stream->pauses += own->refused;
        }
    }
}

/* Others may have added what stays since the last update, and have made a room grow for it. */
static void look_at_kept(nook_stream *stream)
{
    uint64_t memory = stream_memory(stream);
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        stream->kept[kind] = nook_ao_kept_bytes(stream->ao, (nook_volume_kind)kind);
    stream->stale = stream->stale || (memory > stream_budget_bytes(stream) && memory > stream->fitted);
}

nook_result nook_stream_update(nook_stream *stream, const nook_stream_view *views, uint32_t view_count,
                               const nook_ao_occluder *occluders, uint32_t occluder_count)
{
    nook_result result = NOOK_OK;
    if (stream->failed)
        return NOOK_OK;
    stream->settled = true;
    count_pauses(stream);
    look_at_kept(stream);
    result = stream_loader_wake(stream->loader);
    if (result == NOOK_OK && stream->stale) {
        stream->settled = false;
        stream->stale = false;
        result = stream_fit(stream);
    }
    if (result == NOOK_OK) {
        stream_weigh(stream, views, view_count, occluders, occluder_count);
        stream_choose(stream);
        result = upload(stream);
    }
    if (result == NOOK_OK)
        ask(stream);
    stream->failed = result != NOOK_OK;
    stream->settled = stream->settled && !anything_comes(stream);
    return result;
}
