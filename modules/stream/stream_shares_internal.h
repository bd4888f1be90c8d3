/** stream_shares_internal.h - how the kinds share a budget, and what is said where it is too small. */
#pragma once
#include "modules/stream/stream_shape_internal.h"

typedef struct stream_shares {
    stream_kept kept[NOOK_VOLUME_KINDS];
    uint64_t least[NOOK_VOLUME_KINDS]; /**< Bytes that what stays takes of it. */
    double share[NOOK_VOLUME_KINDS];   /**< Of what is left, [0, 1]. */
    uint64_t taken;                    /**< By all that stays. */
} stream_shares;

/** @return NOOK_E_MEMORY; release it in any case */
nook_result stream_shares_find(const nook_stream *stream, stream_shares *out);
void stream_shares_release(stream_shares *shares);

/** The least budget with which anything comes, bytes. @return INFINITY: nothing ever does */
double stream_least_budget(const nook_stream *stream, const stream_shares *shares);
/** A warning, once for a budget, where none of the volumes that come and go has room. After rooms were made. */
void stream_tell_if_too_small(nook_stream *stream, const stream_shares *shares);
/** Of what is asked for, never less than enough: to the digits that are printed. */
double stream_mib_up(double bytes);
