/* What is wanted: bodies weighed by what is seen, and the levels that do most with the memory that there is. */
#include "engine/core/matrix.h"
#include "engine/core/vector.h"
#include "modules/stream/stream_internal.h"
#include <math.h>
#include <string.h>

/* ---- Weighing ------------------------------------------------------------------------------------------------------ */

/* A view's pyramid, in view space: inside where dot(plane, point) >= 0. */
typedef struct pyramid {
    nook_matrix view_from_world;
    double planes[5][3]; /* unit; the last is that through the eye */
} pyramid;

static pyramid make_pyramid(const nook_stream_view *view)
{
    const double *p = view->clip_from_view;
    pyramid made = { .planes = { { -p[0], 0.0, -p[8] - 1.0 },
                                 { p[0], 0.0, p[8] - 1.0 },
                                 { 0.0, -p[5], -p[9] - 1.0 },
                                 { 0.0, p[5], p[9] - 1.0 },
                                 { 0.0, 0.0, -1.0 } } };
    memcpy(made.view_from_world.m, view->view_from_world, sizeof made.view_from_world.m);
    for (int i = 0; i < 5; i++) {
        double length = nook_vector_length(made.planes[i]);
        for (int axis = 0; axis < 3; axis++)
            made.planes[i][axis] /= length;
    }
    return made;
}

/* How much of the picture a ball can reach, [0, 1]; less when it lies outside, and the less the farther. */
static double ball_importance(const pyramid *view, const double centre_world[3], double radius, double r_max,
                              double unseen)
{
    double centre[3], outside = 0.0;
    nook_matrix_apply_point(&view->view_from_world, centre_world, centre);
    for (int i = 0; i < 5; i++) {
        const double *plane = view->planes[i];
        double inside = plane[0] * centre[0] + plane[1] * centre[1] + plane[2] * centre[2];
        outside = fmax(outside, -inside - radius);
    }
    double distance = nook_vector_length(centre);
    double size = distance > radius ? radius / distance : 1.0;
    double importance = size * size;
    if (outside > 0.0)
        importance *= unseen * (r_max / (r_max + outside)) * (r_max / (r_max + outside));
    return importance;
}

/* No corner is farther from the middle than the half axes together; it darkens what is within r_max of it. */
static double reach_of(const stream_volume *volume, const double world_from_mesh[16], double r_max)
{
    double radius = r_max;
    for (int axis = 0; axis < 3; axis++)
        radius += volume->half[axis] * nook_vector_length(world_from_mesh + 4 * axis);
    return radius;
}

static void weigh_view(nook_stream *stream, const nook_stream_view *view, const nook_ao_occluder *occluders,
                       uint32_t count, double r_max)
{
    const pyramid seen = make_pyramid(view);
    for (uint32_t i = 0; i < count; i++) {
        stream_volume *volume = stream_find(stream, occluders[i].volume);
        nook_matrix world_from_mesh;
        double centre[3];
        if (!volume)
            continue;
        memcpy(world_from_mesh.m, occluders[i].world_from_mesh, sizeof world_from_mesh.m);
        nook_matrix_apply_point(&world_from_mesh, volume->centre, centre);
        double importance = ball_importance(&seen, centre, reach_of(volume, world_from_mesh.m, r_max), r_max,
                                            (double)stream->params.unseen);
        if (importance > volume->importance) /* no number is not */
            volume->importance = importance;
    }
}

void stream_weigh(nook_stream *stream, const nook_stream_view *views, uint32_t view_count,
                  const nook_ao_occluder *occluders, uint32_t occluder_count)
{
    double r_max = 0.0;
    nook_ao_get_param(stream->ao, "ao.r_max", &r_max); /* there is one */
    for (uint32_t i = 0; i < stream->count; i++)
        stream->volumes[i].importance = 0.0;
    for (uint32_t i = 0; i < view_count; i++)
        weigh_view(stream, &views[i], occluders, occluder_count, r_max);
    for (uint32_t i = 0; i < stream->count; i++)
        for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
            if (stream->volumes[i].items[kind])
                stream->volumes[i].items[kind]->importance = stream->volumes[i].importance;
}

/* ---- Choosing ------------------------------------------------------------------------------------------------------ */

double stream_error(const stream_item *item, int level)
{
    return level == LEVEL_NONE ? 1.0 : item->levels[level].error;
}

uint64_t stream_bytes(const stream_item *item, int level)
{
    return level == LEVEL_NONE ? 0 : item->levels[level].bytes;
}

/* Error that a step takes from the picture, for a byte. What is there, or comes, is worth more than what would have to come. */
static double step_score(const nook_stream *stream, const stream_item *item, int from, int to)
{
    double gain = stream_error(item, from) - stream_error(item, to);
    double bytes = (double)stream_bytes(item, to) - (double)stream_bytes(item, from);
    double score = item->importance * fmax(gain, 0.0) / fmax(bytes, 1.0);
    bool held =
        (item->resident != LEVEL_NONE && item->resident <= to) || (item->coming != LEVEL_NONE && item->coming <= to);
    return held ? score * (1.0 + (double)stream->params.hysteresis) : score;
}

/* Of two equal ones the one that was added first. */
static bool is_above(const stream_item *a, const stream_item *b)
{
    return a->score != b->score ? a->score > b->score : a->volume.id < b->volume.id;
}

static void sift_down(stream_item **heap, uint32_t count, uint32_t i)
{
    for (;;) {
        uint32_t above = i, left = 2 * i + 1;
        for (uint32_t child = left; child <= left + 1 && child < count; child++)
            above = is_above(heap[child], heap[above]) ? child : above;
        if (above == i)
            return;
        stream_item *moved = heap[i];
        heap[i] = heap[above];
        heap[above] = moved;
        i = above;
    }
}

/* Of all finer levels the one that does most for a byte: one that does nothing is stepped over. @return false: none does anything */
static bool next_step(const nook_stream *stream, stream_item *item)
{
    item->step = LEVEL_NONE;
    item->score = 0.0;
    for (int level = stream_finer(item, item->target); level != LEVEL_NONE; level = stream_finer(item, level)) {
        double score = stream_room_holds(stream, item, level) ? step_score(stream, item, item->target, level) : 0.0;
        if (score > item->score) {
            item->score = score;
            item->step = level;
        }
    }
    return item->step != LEVEL_NONE;
}

static void choose_of_kind(nook_stream *stream, int kind)
{
    const uint64_t room = stream->rooms[kind], kept = stream->kept[kind];
    const double whole = room > kept ? (double)(room - kept) : 0.0;
    double left = (double)stream->params.fill * whole;
    uint32_t count = 0;
    bool any = false;
    for (uint32_t i = 0; i < stream->count; i++) {
        stream_item *item = stream->volumes[i].items[kind];
        if (!item)
            continue;
        item->target = LEVEL_NONE;
        if (next_step(stream, item))
            stream->heap[count++] = item;
    }
    for (uint32_t i = count / 2; i-- > 0;)
        sift_down(stream->heap, count, i);
    while (count > 0) {
        stream_item *item = stream->heap[0];
        double bytes = (double)stream_bytes(item, item->step) - (double)stream_bytes(item, item->target);
        bool fits = bytes <= left || (!any && bytes <= whole); /* where there is no room for two, for one */
        if (fits) {
            any = true;
            left -= bytes;
            item->target = item->step;
        }
        if (!fits || !next_step(stream, item))
            stream->heap[0] = stream->heap[--count];
        sift_down(stream->heap, count, 0);
    }
}

void stream_choose(nook_stream *stream)
{
    if (!stream->tight) {
        STREAM_EACH(stream, item)
        item->target = stream_finest(item);
        return;
    }
    for (int kind = 0; kind < NOOK_VOLUME_KINDS; kind++)
        choose_of_kind(stream, kind);
}
