/**
 * stream_shape_internal.h - which shape of room holds how much: of voxels three sides, of surfels rows of two buffers. What others have added
 * to stay has its places first. Looks only; who makes rooms is stream_room.c.
 */
#pragma once
#include "modules/stream/stream_internal.h"

/** What of a kind others have added: it stays, and comes first. */
typedef struct stream_kept {
    nook_volume_info *infos; /**< Owned: free() them. */
    uint32_t count;
    uint64_t bytes;
} stream_kept;

/** @return false: no memory, out->infos is NULL then */
bool stream_kept_list(const nook_stream *stream, int kind, stream_kept *out);
/** Room for a pointer to each of them, and behind these for one to each body. @return free() it; NULL: no memory */
const nook_volume_info **stream_kept_make_list(const nook_stream *stream, const stream_kept *kept);

/** Bytes of everything at its finest. @return UINT64_MAX without memory to tell */
uint64_t stream_bytes_of_all(const nook_stream *stream);

/**
 * A column, a plate or a block: whichever holds most of the bodies at their finest, beside all that stays. A cube may be as wide as a body
 * and a half.
 * @param out_least  sides that the coarsest level of each body needs, and finer ones as far as that goes
 * @return false: none holds what stays, or there is no memory
 */
bool stream_choose_sides(const nook_stream *stream, int kind, uint64_t bytes, const stream_kept *kept,
                         uint32_t out_least[3], uint32_t out_sides[3]);
/** Whether a volume finds a place beside what stays. @param list  of stream_kept_make_list */
bool stream_fits_beside(const uint32_t sides[3], const nook_volume_info **list, const stream_kept *kept,
                        const nook_volume_info *info);
/** The least bytes that a room of voxels may have for what stays, and for one volume more. @param beside  NULL: for none */
uint64_t stream_least_room(const nook_stream *stream, int kind, const stream_kept *kept,
                           const nook_volume_info *beside);

uint64_t stream_bricks_of(const nook_volume_info *info);
/** Of the bytes that all volumes of surfels have; the rest is bricks. */
double stream_surfel_share(const nook_stream *stream);
/** Rows for what stays. */
nook_ao_room stream_pool_room_of(const stream_kept *kept);
