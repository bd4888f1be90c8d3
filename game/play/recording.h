/**
 * recording.h - the inputs of a session as a file: text, run-length coded, so that a play-through can be kept, read and compared.
 *
 *   nook recording 1
 *   level content/engine_house/engine_house.level
 *   seed 1
 *   origin 0123456789abcdef  nook_session_origin of what it was played in; may be left out
 *   12 0 127 0x2 0 -35     ticks, right, forward, buttons, yaw, pitch of each of them
 */
#pragma once
#include "engine/core/result.h"
#include "game/play/play_input.h"
#include <stddef.h>

/** Zeroed is empty. */
typedef struct nook_recording {
    char level[1024]; /**< As it was given to ./nook play. */
    uint32_t seed;
    uint64_t origin;         /**< nook_session_origin; 0: not known. */
    nook_play_input *inputs; /**< Owned, one for each tick. */
    size_t tick_count, capacity;
} nook_recording;

/** @return NOOK_E_MEMORY */
nook_result nook_recording_append(nook_recording *recording, const nook_play_input *input);
/** Whole or not at all. @return NOOK_E_IO */
nook_result nook_recording_write(const char *path, const nook_recording *recording);
/** @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (file:line), NOOK_E_VERSION, NOOK_E_MEMORY; *out untouched then */
nook_result nook_recording_read(const char *path, nook_recording *out);
void nook_recording_free(nook_recording *recording); /**< Becomes empty. */
