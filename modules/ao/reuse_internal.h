/**
 * reuse_internal.h - values of the last trace that are taken over into the next one; inside modules/ao only. docs/techniques.md, Reuse.
 */
#pragma once
#include "engine/core/matrix.h"
#include "engine/gpu/gpu.h"
#include "modules/ao/nook_ao.h"
#include "modules/bake/volume_file.h"
#include <stdbool.h>

struct ao_gpu_occluder;
struct ao_slot;
struct nook_ao_pass;

/** An occluder as a record has marched it. */
typedef struct ao_marched {
    uint32_t volume, version; /**< Its id, and which contents it had. */
    nook_volume_info info;
    nook_matrix world_from_mesh;
} ao_marched;

enum { AO_REUSE_MOST = 9 }; /**< One more than the largest ao.reuse: no value is as many frames old. */

/** What a record has marched. */
typedef struct ao_marched_list {
    ao_marched *items; /**< Room for nook_ao.occluder_max. Owned. */
    uint32_t count;
} ao_marched_list;

/** Corners of a box, voxels. */
typedef struct ao_box {
    double low[3], high[3];
} ao_box;

/** The same for shaders/ao/reuse.comp.glsl: two rows of moved_texture. */
typedef struct ao_moved_box {
    float low[4]; /**< w: 1 when something has moved in it, else 0. */
    float high[4];
} ao_moved_box;

/** All zero before the first record that reuses. */
typedef struct ao_reuse {
    bool holds;                             /**< Of the last record, whose values may be taken over: */
    nook_texture depth, normal, visibility; /**< Of the trace's size. */
    nook_texture ages[2];                   /**< R16UI: shaders/ao/ages.glsl; [0] */
    nook_texture carried;                   /**< With ao.accumulate: what this record's trace becomes part of. */
    nook_matrix view_from_world, clip_from_view;
    ao_marched_list marched[AO_REUSE_MOST]; /**< By the last records: record n in n % AO_REUSE_MOST. */
    uint32_t run;                           /**< Records before the last one that took over from each other. */
    uint8_t *still; /**< Of each place in the lists: records since something else stood there. occluder_max. Owned. */
    void *settings; /**< The technique's descriptor, programs replaced, shared and own parameters, as bytes. Owned. */
    size_t settings_size;
    uint32_t number; /**< Of records that reuse. */
    uint32_t traces; /**< Records since nothing was taken over: which part of the rays' sequence is next. */

    struct ao_gpu_occluder *moved; /**< Scratch of twice occluder_max: as they are, as they were. Owned. */
    uint32_t moved_count;
    ao_moved_box *boxes; /**< Scratch, with ao.reuse_error: of each of `moved` for each age. Owned. */
    nook_buffer moved_buffer, block, tiles; /**< `tiles`: shaders/ao/tiles.glsl. */
    nook_texture moved_texture;             /**< Shows moved_buffer. */
} ao_reuse;

/** Records that a value may have been traced or made a mean in, the one at hand too. */
uint32_t ao_reuse_window(const nook_ao *ao);
/** Whether a record of this technique takes over, and is taken over from. */
bool ao_reuse_is_wanted(const nook_ao *ao, const struct ao_slot *slot);
/**
 * Before a trace: takes over what it can, and lists what is left. Binds over what a pass has bound.
 * @param pass  its `tiles` and its `part` are set @return NOOK_E_MEMORY, NOOK_E_DEVICE: nothing is taken over by the next one either
 */
nook_result ao_reuse_choose(nook_ao *ao, const nook_ao_frame *frame, const struct ao_slot *slot,
                            struct nook_ao_pass *pass);
/** After it: makes means of what was traced, and keeps what the next one may take over. Binds over what a pass has bound. */
nook_result ao_reuse_keep(nook_ao *ao, const nook_ao_frame *frame, const struct nook_ao_pass *pass);
/** Pixels that the last record has listed; UINT32_MAX when it took no part. Waits for the GPU. */
uint32_t ao_reuse_count_traced(const nook_ao *ao);
uint64_t ao_reuse_bytes(const ao_reuse *reuse); /**< Of the textures that the last record took part in with; else 0. */
void ao_reuse_release(nook_ao *ao);
/**
 * Composes into ao->reuse.moved those of the marched occluders that are not as the last record has marched them, as they are and as
 * they were; with ao.reuse_error those that have changed within ao_reuse_window records, once each, and their boxes. Then remembers them all.
 * @param compare  false: only remembers, and nothing of before counts any more
 */
void ao_collect_moved(nook_ao *ao, const nook_matrix *view_from_world, bool compare);
