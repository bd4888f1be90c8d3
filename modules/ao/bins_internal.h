/**
 * bins_internal.h - which occluders may reach which part of the picture; inside modules/ao only.
 *
 * occluders of a record, in view space -> the rectangle of bins that each may reach -> for each bin the list of its occluders, ascending ->
 * a buffer, of which a tile reads its bin's list (shaders/ao/tile_list.glsl) instead of testing every occluder there is.
 *
 * Balls are projected: no depth is known here, and none is needed but by the tiles. Bins only leave out what cannot change a pixel, so
 * that a picture has the same bits with them and without. Nothing grows from frame to frame: the room for lists follows from how many
 * occluders there may be, and a bin that finds none, or that would hold most of the occluders, has no list: its tiles test all.
 *
 * A ball around the eye or beside it may be seen in every bin, so that entries are occluders times bins at the worst. They are counted by the
 * rectangles' areas before any is made: where over half of them would find no room, most of the picture would test all anyway, and the
 * record has no bins. So the time that lists take is bounded by their room, that of a record by it and the occluders.
 */
#pragma once
#include "engine/gpu/gpu.h"

struct ao_gpu_occluder;

enum {
    AO_BIN_SIZE = 32,     /**< Trace pixels: BIN_SIZE of shaders/ao/tile_list.glsl. */
    AO_BIN_ITEMS = 16,    /**< Room for this many entries of lists for each occluder that there may be. */
    AO_BINS_OVERFLOW = 2, /**< No bins when lists would hold more than so many times what there is room for. */
    AO_BINS_LEAST = 65    /**< A tile tests 64 at once, one an invocation: no list can make that fewer. */
};
#define AO_BIN_OF_ALL UINT32_MAX /**< Instead of a bin's count: it has no list. */

/** A trace's picture. Projection as in shaders/ao/frame.glsl. */
typedef struct ao_bin_view {
    uint32_t size[2], full_size[2]; /**< Of the trace, of the host's buffers, pixels. */
    uint32_t scale;                 /**< Full pixels per trace pixel. */
    double ray_scale[2], ray_offset[2];
    double r_max; /**< Metres. */
} ao_bin_view;

/** First and last of the bins that an occluder may reach, x and y. */
typedef struct ao_bin_rectangle {
    uint16_t first[2], last[2];
} ao_bin_rectangle;

typedef struct ao_bins {
    nook_buffer buffer; /**< Of each bin where its list begins, and its length or AO_BIN_OF_ALL; then the lists. */
    uint32_t *words;    /**< What it holds. Owned. */
    ao_bin_rectangle *rectangles; /**< Scratch, of each occluder. Owned. */
    uint32_t bin_max, item_max;   /**< There is room for: bins, entries of all lists together. */
    uint32_t least;               /**< From this many occluders on there are bins: AO_BINS_LEAST; tests set it. */
    uint32_t longest;             /**< The most occluders that a tile of this record tests: of a bin's list, or all. */
    uint64_t entries;             /**< Of this record's lists, had all of them room; 0: too few occluders to look. */
    uint32_t across, down;        /**< Bins of this record's picture; 0: it has none, all tiles test all occluders. */
} ao_bins;

/** Room for AO_BIN_ITEMS entries for each of that many occluders. @return NOOK_E_MEMORY, NOOK_E_DEVICE */
nook_result ao_bins_create(nook_gpu *gpu, uint32_t occluder_max, ao_bins *out);
void ao_bins_release(nook_gpu *gpu, ao_bins *bins); /**< Zero is allowed. */
void ao_bins_clear(ao_bins *bins, uint32_t count);  /**< None for this record, of that many occluders. */
/**
 * Makes the lists and uploads them. Room for bins grows with the picture and stays.
 * @param count  at most as many as there is room for @return NOOK_E_MEMORY, NOOK_E_DEVICE
 */
nook_result ao_bins_fill(nook_gpu *gpu, ao_bins *bins, const ao_bin_view *view, const struct ao_gpu_occluder *occluders,
                         uint32_t count);
