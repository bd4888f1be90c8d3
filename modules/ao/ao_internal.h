/**
 * ao_internal.h - the inside of nook_ao, shared by the files of modules/ao only.
 */
#pragma once
#include "modules/ao/bins_internal.h"
#include "modules/ao/brick_pool_internal.h"
#include "modules/ao/mesh_alphas_internal.h"
#include "modules/ao/nook_ao.h"
#include "modules/ao/refine_internal.h"
#include "modules/ao/reuse_internal.h"
#include "modules/ao/slicemap.h"
#include "modules/ao/technique.h"
#include "modules/ao/volume_atlas_internal.h"
#include <stdbool.h>

#define NOOK_PARAM_STRUCT ao_shared
#define NOOK_PARAM_FILE "modules/ao/params.def"
#define NOOK_PARAM_TABLE ao_shared_table
#include "engine/core/param_block.inl"

enum { AO_TECHNIQUE_MAX = 16, AO_OCCLUDER_DEFAULT = 4096 };

typedef struct ao_slot {
    const nook_ao_technique *technique;
    void *state;        /**< technique->state_size bytes. Owned. */
    void *params;       /**< technique->params_size bytes, rounded up to 16. Owned. */
    nook_buffer buffer; /**< The params on the GPU. */
} ao_slot;

typedef struct ao_mesh {
    nook_ao_mesh_view view; /**< Its arrays are owned here. */
    float *positions;
    uint32_t *indices;
    ao_mesh_alphas *alphas; /**< NULL: all is opaque. */
    nook_medium *medium;    /**< NULL: triangles. With its cells in one block. */
} ao_mesh;

/** Row of the GPU's occluder list: struct Occluder of shaders/ao/occluders.glsl. */
typedef struct ao_gpu_occluder {
    float voxel_from_view[3][4];  /**< Rows: voxel coordinates of the volume, (0, 0, 0) at its outer corner. */
    float normal_from_view[3][4]; /**< Rows of the inverse transpose of the 3x3 part; w unused. */
    float size[4];                /**< Voxels; w unused. */
    /** Voxel in its kind's atlas that is the volume's (0, 0, 0). Surfel: number of its first brick, x + 65536 y; a float alone
        does not hold all of them. Density, w: nook_volume_info.depth_of_255. */
    float place[4];
    float centre[4]; /**< View space, metres; w: the box's bounding radius. */
} ao_gpu_occluder;

/** Block Counter of shaders/ao/counter.glsl. */
typedef struct ao_counts {
    uint32_t fetches_low, fetches_high, outside;
    uint32_t seen; /**< Full-size pixels with geometry that stepped upscaling has met. */
} ao_counts;

/** Textures at the trace's size. */
typedef struct ao_trace {
    nook_texture visibility; /**< id 0 before the scale was used. */
    nook_texture filtered;   /**< RGBA32F: normal times depth, visibility; id 0 until a stepped upscaling needs it. */
    nook_texture depth, normal; /**< id 0 at scale 1, where the full ones are taken. */
    int holds_view;             /**< Depth and normal are those of the last record's frame, */
    int downsample;             /**< by this ao.downsample. */
} ao_trace;

enum { AO_SCALES = 3 /* 1, 2, 4 */ };

/** Textures at the host's size and at the traces'. Those of a scale stay: views of several scales take turns in every frame. */
typedef struct ao_targets {
    nook_texture depth, normal, visibility; /**< Full size. */
    ao_trace traces[AO_SCALES];             /**< Of scale 1 << index. */
    uint32_t width, height;                 /**< Of the full-size ones; 0 before there are any. */
    int holds_view;                         /**< Depth and normal are those of the last record's frame. */
} ao_targets;

/** What of the picture a record computes: begin[] to end[] - 1. */
typedef struct ao_region {
    int32_t full_begin[2], full_end[2]; /**< Full-size pixels. */
    int32_t begin[2], end[2]; /**< Trace pixels: those above, and what filter and upscaling read around them. */
    int32_t origin[2];        /**< begin, rounded down to whole groups. */
} ao_region;

/** What live volumes are made with; all zero before there is one. */
typedef struct ao_voxelizer {
    nook_slicemap slices[3]; /**< Along x, y, z. */
    nook_slicer slicer;
} ao_voxelizer;

struct nook_ao {
    nook_gpu *gpu;
    uint32_t width, height;
    void (*progress)(void *user, double fraction);
    void *progress_user;
    ao_shared shared;
    ao_slot slots[AO_TECHNIQUE_MAX];
    uint32_t slot_count, current;
    ao_targets targets;
    ao_refine refine;
    ao_reuse reuse;
    nook_buffer frame, occluder_buffer, counter;
    uint32_t nearest_sampler; /**< Of the host's textures. */
    ao_bins bins;
    nook_texture occluder_texture;           /**< The buffer's rows as texels. */
    volume_atlas atlases[NOOK_VOLUME_KINDS]; /**< Of each kind but surfels, which are in the pool. */
    ao_voxelizer voxelizer;
    brick_pool pool;
    uint32_t *volume_ids; /**< Those that are known, ascending. */
    uint32_t volume_id_count, volume_id_capacity, next_volume_id;
    nook_ao_supply supply; /**< NULL: nobody is asked for volumes. */
    void *supply_user;
    ao_mesh *meshes;
    uint32_t mesh_count, mesh_capacity, next_mesh_id;
    nook_ao_occluder *occluders; /**< This frame's, as submitted. */
    uint32_t occluder_count, occluder_max;
    ao_gpu_occluder *gpu_occluders;   /**< Scratch of occluder_max. */
    nook_ao_mesh_instance *instances; /**< Scratch of occluder_max. */
    uint32_t *instance_occluders;     /**< Of each instance: which occluder it is. Scratch of occluder_max. */
    nook_ao_mesh_view *mesh_views;    /**< Scratch of mesh_capacity. */
    nook_ao_statistics statistics;
    ao_region recorded; /**< By the last record. */
    uint32_t scale;     /**< Of the last record: its exponent. */
    uint32_t kinds;     /**< Of the last record: ao_work. */
    uint32_t line_max;  /**< Of the last record: nook_ao_pass. */
    int counting;       /**< Of the last record: frame.counting of shaders/ao/counter.glsl. */
    int refining;       /**< Of the last record: ao_refining. */
    int supporting;     /**< Of the last record: ao_work. */
};

void ao_slot_release(nook_ao *ao, ao_slot *slot); /**< By its technique's code. */
uint32_t ao_slot_kinds(const ao_slot *slot);      /**< Of volumes that it marches with its parameters: bits; 0: none. */

/**
 * Makes the textures fit width, height and a scale; keeps them when they do.
 * @param scale  0, 1, 2: its exponent
 * @return NOOK_E_MEMORY, NOOK_E_DEVICE
 */
nook_result ao_targets_fit(nook_gpu *gpu, ao_targets *targets, uint32_t width, uint32_t height, uint32_t scale);
/** Makes the filtered texture of a trace that has been fitted, unless it is there. @return NOOK_E_MEMORY */
nook_result ao_trace_fit_filtered(nook_gpu *gpu, ao_trace *trace);
void ao_targets_release(nook_gpu *gpu, ao_targets *targets);
uint64_t ao_targets_bytes(const ao_targets *targets, uint32_t scale); /**< Those that a record of that scale uses. */

enum { AO_BINDING_COUNTER = 7 };

/** What becomes of pixels that upscaling has too little for: refine_internal.h. */
enum ao_refining { AO_REFINING_NOTHING, AO_REFINING_AROUND, AO_REFINING_TRACED };

/** What a record asks of ao_begin. */
typedef struct ao_work {
    uint32_t inputs; /**< NOOK_AO_IN_*. */
    uint32_t kinds;  /**< Of volumes: bits 1 << nook_volume_kind; of a volume of several kinds the first of them. */
    uint32_t scale;  /**< Of the trace: its exponent. */
    int32_t passes;  /**< After the trace, that read pixels around: ao_region_make. */
    int binned;      /**< Not 0: the technique reads bins. */
    int counting;    /**< frame.counting of shaders/ao/counter.glsl. */
    int refining;    /**< ao_refining. */
    int supporting; /**< Not 0: filtered pixels of the trace that few samples are like trace more: shaders/ao/support.glsl. */
} ao_work;

/**
 * Checks the frame and makes everything ready for a trace: lists of occluders, targets, uniforms, depth and normals.
 * @param out_pass  without a technique's parameters; nothing is bound
 */
nook_result ao_begin(nook_ao *ao, const nook_ao_frame *frame, const ao_work *work, nook_ao_pass *out_pass);
/** Depth and normals of the whole picture: techniques look beyond the part that is recorded. */
nook_result ao_fill_inputs(nook_ao *ao, const nook_ao_frame *frame);
/** From the trace's visibility to that of the picture, in one. */
nook_result ao_filter(nook_ao *ao);
/** In two: to that of the trace, filtered; from there to the picture. */
nook_result ao_filter_trace(nook_ao *ao);
nook_result ao_upscale(nook_ao *ao, const nook_ao_frame *frame);
/** Between these two: what filtering has listed, made ready to be traced; and from what was traced of it to the filtered trace. */
nook_result ao_support_gather(nook_ao *ao);
nook_result ao_support_finish(nook_ao *ao);
/** What upscaling has listed, made ready to be traced. */
nook_result ao_refine_gather(nook_ao *ao, const nook_ao_frame *frame);
/** From what was traced of it to the picture. */
nook_result ao_refine_finish(nook_ao *ao);
/** Runs one of our own shaders, 16 x 8 pixels a group, with what is bound. */
nook_result ao_dispatch_over(nook_ao *ao, const char *path, const char *defines, uint32_t width, uint32_t height);
nook_texture ao_host_texture(nook_ao_texture texture);

/** @return NOOK_E_RANGE a part that leaves the picture */
nook_result ao_region_check(const nook_ao *ao, const nook_rectangle *part);
/** @param scale 1, 2, 4 @param passes  after the trace, that read pixels around: 0, 1 filter, 2 filter and upscaling */
ao_region ao_region_make(const nook_ao *ao, const nook_rectangle *part, uint32_t scale, int32_t passes);

/**
 * How far distances read from the host's depth may be off, from its format: out_error[0] * z + out_error[1] * z^2 metres at z metres.
 */
void ao_depth_error(nook_gpu *gpu, nook_ao_texture depth, const double clip_from_view[16], double out_error[2]);

/** Every kind that there is. */
#define AO_EVERY_KIND (NOOK_VOLUME_BIT(NOOK_VOLUME_KINDS) - 1u)
/** Ids of volumes: given once, and known until they are removed, in whatever kinds they are there. */
nook_result ao_volume_id_take(nook_ao *ao, uint32_t *out_id); /**< @return NOOK_E_MEMORY */
bool ao_volume_id_is_known(const nook_ao *ao, uint32_t id);
void ao_volume_id_give(nook_ao *ao, uint32_t id); /**< One that is not known is allowed. */
/** Asks the host for kinds that submitted volumes lack: nook_ao_set_supply. */
nook_result ao_ask_for_volumes(nook_ao *ao, uint32_t kinds);
/** By id, of the first of `kinds` that it has. @return NULL when there is none */
const nook_volume_info *ao_volume_info(const nook_ao *ao, uint32_t id, uint32_t kinds);
nook_matrix ao_mesh_from_voxel(const nook_volume_info *info);
/** All of a row but its place. @return false: floats cannot hold it, or it is flat; *out is undefined then */
bool ao_compose(const nook_volume_info *info, const nook_matrix *view_from_mesh, ao_gpu_occluder *out);
/** Centre and radius of a row: the sphere around a box, whose corners are given in voxels. */
void ao_set_sphere(const nook_matrix *view_from_voxel, const double low[3], const double high[3], ao_gpu_occluder *out);
/**
 * Composes this frame's marched occluders, those that are there in one of `kinds`, into ao->gpu_occluders and
 * ao->line_max. @return how many
 */
uint32_t ao_collect_volumes(nook_ao *ao, const nook_matrix *view_from_world, uint32_t kinds);
/** Composes this frame's traced instances into ao->instances, ao->instance_occluders and ao->mesh_views. @return how many */
uint32_t ao_collect_meshes(nook_ao *ao, const nook_matrix *view_from_world);
/** By id, in the time of a binary search. @return UINT32_MAX when there is none */
uint32_t ao_mesh_index(const nook_ao *ao, uint32_t id);
void ao_meshes_release(nook_ao *ao);
void ao_voxelizer_release(nook_ao *ao);
