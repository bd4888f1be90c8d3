/**
 * stream.h - volumes that come and go under a budget of GPU memory, while pictures are made: docs/streaming.md.
 *
 *   create -> add bodies' files -> every frame: submit the occluders, update, record -> remove, destroy
 *
 * The stream knows the AO core and .nkv files, and neither an ECS nor a scene. It decides which bodies may matter to what is seen, reads
 * and decodes on threads of its own, and uploads no more than so many bytes a frame. What is not there does not occlude.
 *
 * Threads  one stream is used by the thread of its AO. Its own threads never touch GL, nor anything but the file that they read.
 * Memory   nothing is allocated in a frame, but by those threads for what they read, and when bodies were added since the last one.
 */
#pragma once
#include "modules/ao/nook_ao.h"
#include "modules/bake/volume_file.h"
#include "modules/stream/stream_params.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_stream nook_stream;

enum {
    NOOK_STREAM_LEVELS_MAX = 4,
    NOOK_STREAM_PATH_MAX = 1024 /**< Bytes of a path, its end included. */
};

/** One file of a body: it in one kind, so fine. */
typedef struct nook_stream_level {
    const char *path;      /**< A .nkv file; read when it is wanted. Copied. */
    nook_volume_info info; /**< What it holds: nook_bake.info, or nook_volume_decode_info. */
    /** RMS error of visibility with it, [0, 1], against 1 without it: finer ones have less. A body of one level may have any below 1. */
    double error;
} nook_stream_level;

/** @return NOOK_E_MEMORY no memory or no thread; NOOK_E_RANGE a parameter outside of its range; *out_stream is NULL then. @param ao  outlives the stream */
nook_result nook_stream_create(nook_ao *ao, const nook_stream_params *params, nook_stream **out_stream);
/** Waits for what is being decoded; the volumes are removed from the AO. NULL is allowed. */
void nook_stream_destroy(nook_stream *stream);

/** Ends its thread until the next update: before its code is exchanged for another build of it. Waits for what is being decoded. */
void nook_stream_suspend(nook_stream *stream);

/**
 * Adds a body, or counts one more user of the same files: then its volume is the one that is there. Nothing is read yet.
 * @param name    used in messages; copied
 * @param levels  count of them, 1 to NOOK_STREAM_LEVELS_MAX, of one kind, the finest first
 * @param out_volume  for nook_ao_occluder; ends with nook_stream_remove, not with nook_ao_remove_volume
 * @return NOOK_E_MEMORY; NOOK_E_RANGE a path is too long
 */
nook_result nook_stream_add(nook_stream *stream, const char *name, const nook_stream_level *levels, uint32_t count,
                            nook_ao_volume *out_volume);
/** Gives a body one more kind. @return as nook_stream_add; NOOK_E_NOT_FOUND it has been removed; NOOK_E_ARG it is there in this kind */
nook_result nook_stream_extend(nook_stream *stream, nook_ao_volume volume, const nook_stream_level *levels,
                               uint32_t count);
/** One user less; the last takes it away, also while it is being read. Never waits. Stale ids are allowed. */
void nook_stream_remove(nook_stream *stream, nook_ao_volume volume);

/**
 * Other numbers from the next update on. A smaller budget is given back by then: what does not fit goes.
 * Where the room changes its size, contents are copied within the GPU once, and both are there for that moment.
 * @return NOOK_E_RANGE one is outside of its range: all stay as they were
 */
nook_result nook_stream_set_params(nook_stream *stream, const nook_stream_params *params);
const nook_stream_params *nook_stream_params_of(const nook_stream *stream);

/** From where the next record looks. */
typedef struct nook_stream_view {
    double view_from_world[16], clip_from_view[16]; /**< As of nook_ao_frame. */
} nook_stream_view;

/**
 * A frame's work: takes what was read, decides, asks for more, uploads. Before a record; several views of one frame need one update,
 * each counting.
 * @param views      view_count of them, at least 1
 * @param occluders  as submitted; those of other volumes are passed over
 * @return NOOK_E_MEMORY, NOOK_E_RANGE, NOOK_E_DEVICE from the AO: then what was to come stays out
 */
nook_result nook_stream_update(nook_stream *stream, const nook_stream_view *views, uint32_t view_count,
                               const nook_ao_occluder *occluders, uint32_t occluder_count);

/** Where it stands. Bytes are the GPU's. */
typedef struct nook_stream_status {
    uint64_t budget;         /**< 0: none. */
    uint64_t memory;         /**< That volumes have, all kinds, those that are not streamed too. */
    uint64_t resident_bytes; /**< That whole, streamed volumes take of it. */
    uint64_t wanted_bytes;   /**< That they would take if all that is wanted were there. */
    uint64_t waiting_bytes;  /**< Of that, what those that are waiting would take. */
    uint32_t volumes;        /**< Bodies' files, each kind counted, but not each level. */
    uint32_t resident;       /**< Of them, there in some level. */
    uint32_t wanted;         /**< Of them, wanted in some level. */
    uint32_t waiting;        /**< Of those, not there yet in the level that is wanted, or a finer one. */
    uint32_t refused;        /**< Levels whose files cannot be used, now or at all. */
    uint32_t reading;        /**< Files that are read, decoded, or uploaded now. */
    bool
        failed; /**< The budget does not hold what always stays, or the device refused: nothing comes until it is another. */
    bool all_fit;              /**< Everything at its finest is within the budget: each has its place for good. */
    uint64_t loads, evictions; /**< Since the start: volumes that came, and that went for others. */
    uint64_t frame_upload;     /**< Bytes of the last update. */
    uint64_t largest_upload;   /**< Of any update. */
} nook_stream_status;
void nook_stream_get_status(const nook_stream *stream, nook_stream_status *out_status);
/** Nothing comes any more as long as the views stay: all that is wanted and can be had is there, or it has failed. Of the last update. */
bool nook_stream_is_settled(const nook_stream *stream);

#ifdef __cplusplus
}
#endif
