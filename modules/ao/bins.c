#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include "modules/ao/bins_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HEAD = 2, NOWHERE = UINT16_MAX }; /* words of a bin; first[0] of what no pixel sees */

/**
 * A ray starts up to a slab of voxels over its surface, C7 of docs/techniques.md: sqrt(3)/2 + 1 - threshold, and a little that filtering
 * blurs. As much farther does a volume reach.
 */
static const double LIFT = 2.0;
/** Trace pixels: the last one of a picture stands for a full pixel up to half a trace pixel nearer, and floats round. */
static const double BESIDE = 1.0;

void ao_bins_release(nook_gpu *gpu, ao_bins *bins)
{
    nook_buffer_destroy(gpu, &bins->buffer);
    free(bins->words);
    free(bins->rectangles);
    *bins = (ao_bins){ 0 };
}

static size_t words_of(uint32_t bins, uint32_t items)
{
    return (size_t)bins * HEAD + items;
}

/** Exchanges the room for another one; what it held is lost. */
static nook_result make_room(nook_gpu *gpu, ao_bins *bins, uint32_t bin_max)
{
    nook_buffer_destroy(gpu, &bins->buffer);
    free(bins->words);
    bins->bin_max = 0;
    const size_t size = words_of(bin_max, bins->item_max) * sizeof *bins->words;
    bins->words = malloc(size);
    if (!bins->words)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u bins of occluders", bin_max);
    nook_result result = nook_buffer_create(gpu, NULL, size, &bins->buffer);
    if (result == NOOK_OK)
        bins->bin_max = bin_max;
    return result;
}

nook_result ao_bins_create(nook_gpu *gpu, uint32_t occluder_max, ao_bins *out)
{
    *out = (ao_bins){ .item_max = occluder_max * AO_BIN_ITEMS, .least = AO_BINS_LEAST };
    out->rectangles = malloc(occluder_max * sizeof *out->rectangles);
    if (!out->rectangles)
        return nook_fail(NOOK_E_MEMORY, "no memory for the bins of %u occluders", occluder_max);
    return make_room(gpu, out, 1);
}

/** Its voxels' sides are the rows that normals are transformed by; nothing as long as one voxel unit gets longer than their norm. */
static double reach_of(const ao_gpu_occluder *o, double r_max)
{
    double squares = 0.0;
    for (int row = 0; row < 3; row++)
        for (int axis = 0; axis < 3; axis++)
            squares += (double)o->normal_from_view[row][axis] * (double)o->normal_from_view[row][axis];
    return (double)o->centre[3] + LIFT * sqrt(squares) + r_max;
}

/**
 * Bins along an axis that the ball is seen in: between the two rays from the eye that touch it, if the eye is outside and the ball all in
 * front of it; a ball around the eye, or beside it, may be seen anywhere.
 * @param across, ahead  of the ball's centre @return false: nowhere in the picture
 */
static bool find_bins(const ao_bin_view *view, int axis, double across, double ahead, double radius,
                      ao_bin_rectangle *out)
{
    double last = (view->size[axis] - 1) / AO_BIN_SIZE, low = 0.0, high = last;
    if (ahead > radius) {
        const double d = ahead * ahead - radius * radius, root = radius * sqrt(across * across + d);
        const double scale = view->scale, to_ndc = 1.0 / view->ray_scale[axis];
        double side[2];
        for (int i = 0; i < 2; i++) {
            double ndc = ((across * ahead + (i ? root : -root)) / d - view->ray_offset[axis]) * to_ndc;
            double full = (ndc * 0.5 + 0.5) * view->full_size[axis] - 0.5;
            side[i] = (full - view->scale / 2) / scale;
        }
        low = floor((fmin(side[0], side[1]) - BESIDE) / AO_BIN_SIZE);
        high = floor((fmax(side[0], side[1]) + BESIDE) / AO_BIN_SIZE);
    }
    if (!(low <= last) || !(high >= 0.0))
        return false;
    out->first[axis] = (uint16_t)fmax(low, 0.0);
    out->last[axis] = (uint16_t)fmin(high, last);
    return true;
}

static ao_bin_rectangle rectangle_of(const ao_bin_view *view, const ao_gpu_occluder *o)
{
    const double radius = reach_of(o, view->r_max), ahead = -(double)o->centre[2];
    ao_bin_rectangle r = { 0 };
    if (ahead <= -radius || !find_bins(view, 0, (double)o->centre[0], ahead, radius, &r) ||
        !find_bins(view, 1, (double)o->centre[1], ahead, radius, &r))
        r.first[0] = NOWHERE;
    return r;
}

/** @return entries of all lists together, had they room */
static uint64_t find_rectangles(ao_bins *bins, const ao_bin_view *view, const ao_gpu_occluder *occluders,
                                uint32_t count)
{
    uint64_t entries = 0;
    for (uint32_t i = 0; i < count; i++) {
        const ao_bin_rectangle r = bins->rectangles[i] = rectangle_of(view, &occluders[i]);
        if (r.first[0] != NOWHERE)
            entries += (uint64_t)(r.last[0] - r.first[0] + 1) * (uint64_t)(r.last[1] - r.first[1] + 1);
    }
    return entries;
}

/** Into the heads: how many occluders may reach each bin. */
static void count_items(ao_bins *bins, uint32_t count)
{
    memset(bins->words, 0, (size_t)bins->across * bins->down * HEAD * sizeof *bins->words);
    for (uint32_t i = 0; i < count; i++) {
        const ao_bin_rectangle r = bins->rectangles[i];
        for (uint32_t y = r.first[1]; r.first[0] != NOWHERE && y <= r.last[1]; y++) {
            for (uint32_t x = r.first[0]; x <= r.last[0]; x++)
                bins->words[(y * bins->across + x) * HEAD + 1]++;
        }
    }
}

/**
 * Gives each bin its place, and the count 0 to be filled up to. A list of more than half of all occluders would cost a read more an entry
 * to leave out fewer. @return words in use
 */
static uint32_t place_lists(ao_bins *bins, uint32_t count)
{
    const uint32_t bin_count = bins->across * bins->down;
    const size_t room = words_of(bin_count, bins->item_max);
    uint32_t used = bin_count * HEAD;
    bins->longest = 0;
    for (uint32_t bin = 0; bin < bin_count; bin++) {
        uint32_t *head = &bins->words[bin * HEAD], items = head[1];
        bool listed = items <= count / 2 && used + items <= room;
        head[0] = used;
        head[1] = listed ? 0 : AO_BIN_OF_ALL;
        used += listed ? items : 0;
        bins->longest = !listed ? count : items > bins->longest ? items : bins->longest;
    }
    return used;
}

/** In the order of the occluders: each list is ascending. */
static void fill_lists(ao_bins *bins, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const ao_bin_rectangle r = bins->rectangles[i];
        for (uint32_t y = r.first[1]; r.first[0] != NOWHERE && y <= r.last[1]; y++) {
            for (uint32_t x = r.first[0]; x <= r.last[0]; x++) {
                uint32_t *head = &bins->words[(y * bins->across + x) * HEAD];
                if (head[1] != AO_BIN_OF_ALL)
                    bins->words[head[0] + head[1]++] = i;
            }
        }
    }
}

void ao_bins_clear(ao_bins *bins, uint32_t count)
{
    bins->across = bins->down = 0;
    bins->longest = count;
    bins->entries = 0;
}

nook_result ao_bins_fill(nook_gpu *gpu, ao_bins *bins, const ao_bin_view *view, const ao_gpu_occluder *occluders,
                         uint32_t count)
{
    ao_bins_clear(bins, count);
    if (count < bins->least)
        return NOOK_OK;
    bins->entries = find_rectangles(bins, view, occluders, count);
    if (bins->entries > (uint64_t)AO_BINS_OVERFLOW * bins->item_max)
        return NOOK_OK;
    const uint32_t across = nook_groups(view->size[0], AO_BIN_SIZE), down = nook_groups(view->size[1], AO_BIN_SIZE);
    nook_result result = across * down > bins->bin_max ? make_room(gpu, bins, across * down) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    bins->across = across, bins->down = down;
    count_items(bins, count);
    uint32_t used = place_lists(bins, count);
    fill_lists(bins, count);
    nook_buffer_update(gpu, bins->buffer, 0, bins->words, used * sizeof *bins->words);
    return NOOK_OK;
}
