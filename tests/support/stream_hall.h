/**
 * stream_hall.h - a hall of pillars whose volumes are streamed (modules/stream), for tests: their files, a camera that goes through it, and
 * the pictures. All of it fails the test when something cannot be done.
 */
#pragma once
#include "modules/ao/residency.h"
#include "modules/stream/stream.h"
#include "tests/support/ao_view.h"

enum {
    STREAM_HALL_WIDTH = 48,
    STREAM_HALL_HEIGHT = 32,
    STREAM_HALL_PIXELS = STREAM_HALL_WIDTH * STREAM_HALL_HEIGHT,
    STREAM_HALL_BODIES = 20,
    STREAM_HALL_LEVELS = 3
};

typedef struct stream_hall {
    nook_fixture_view *view;
    nook_stream *stream; /**< NULL: all volumes are resident. */
    nook_volume_kind kind;
    char paths[STREAM_HALL_BODIES][STREAM_HALL_LEVELS][256]; /**< Of the files, the finest first. */
    nook_volume_info infos[STREAM_HALL_BODIES][STREAM_HALL_LEVELS];
    nook_ao_volume volumes[STREAM_HALL_BODIES];
    nook_fixture_mesh bodies[STREAM_HALL_BODIES], ground; /**< World. */
} stream_hall;

/** Bakes the files anew, and opens a view without volumes. Voxels are sampled so that a picture does not depend on where they lie. */
void stream_hall_open(stream_hall *hall, nook_volume_kind kind);
void stream_hall_close(stream_hall *hall);
/** Gives every body its finest volume for good. */
void stream_hall_add_all(stream_hall *hall);
/** Starts a stream with every body. @param levels  of each, from the finest on @param mib  of budget; 0: as much as they take */
void stream_hall_start(stream_hall *hall, uint32_t levels, double mib);
/** Adds or removes one body of the stream. */
void stream_hall_add(stream_hall *hall, uint32_t body, uint32_t levels);
void stream_hall_remove(stream_hall *hall, uint32_t body);
/** Bytes of all bodies at their finest. */
uint64_t stream_hall_bytes(const stream_hall *hall);
/** Puts the camera so far into the hall, looking along it, turned left. */
void stream_hall_look(stream_hall *hall, double metres, double degrees);
/** One update of the stream from there. */
void stream_hall_update(stream_hall *hall);
/** Updates until nothing comes any more; fails the test after a minute. */
void stream_hall_settle(stream_hall *hall);
/** Draws what is seen, and records it. @param out  visibility of STREAM_HALL_PIXELS */
void stream_hall_record(stream_hall *hall, float *out);
nook_stream_status stream_hall_status(const stream_hall *hall);
