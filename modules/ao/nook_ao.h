/**
 * nook_ao.h - ambient occlusion for a deferred renderer, in plain C. No ECS, no globals, no threads of its own
 * (the ray-traced reference borrows threads while it records).
 *
 *   create -> add techniques, volumes -> every frame: submit occluders, record -> read the visibility texture -> destroy
 *
 * Space    metres, right-handed, Y up.
 * Matrices 16 doubles, column-major, column vectors; the name says to_from. They are composed here in double precision
 *          relative to the camera, so that a world far from its origin loses nothing (docs/architecture.md, Precision).
 * Result   visibility in [0, 1]: 1 sees the whole sky, 0 sees none of it: 1 - A of docs/techniques.md, equation 1.
 * Threads  one context is used by one thread at a time; two contexts are independent.
 * Memory   inputs are copied before the call returns, unless the field says otherwise.
 */
#pragma once
#include "engine/core/alpha.h"
#include "engine/core/medium.h"
#include "engine/core/rectangle.h"
#include "engine/core/result.h"
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_AO_VERSION 5

typedef struct nook_ao nook_ao; /**< One per device and view. */
typedef struct nook_ao_volume {
    uint32_t id;
} nook_ao_volume; /**< id 0 is none; a removed volume's id never comes back. */
typedef struct nook_ao_mesh {
    uint32_t id;
} nook_ao_mesh; /**< Triangles for the reference; id 0 is none. */

struct nook_gpu;          /* engine/gpu/gpu.h */
struct nook_ao_technique; /* modules/ao/technique.h */
struct nook_param;        /* engine/core/param.h */

/** The host's own 2D texture by its GL name. 0 is none. */
typedef struct nook_ao_texture {
    uint32_t native;
    uint32_t width, height; /**< Pixels. */
} nook_ao_texture;

typedef struct nook_ao_desc {
    uint32_t version;       /**< NOOK_AO_VERSION. */
    struct nook_gpu *gpu;   /**< Outlives us. A host with its own loader makes one with nook_gpu_create. */
    uint32_t width, height; /**< Full-resolution target, pixels. */
    uint32_t max_occluders; /**< Per frame; 0 means 4096. Every device takes 7281, most many more. */
    /** Called while a long record works (the reference): fraction in [0, 1]. NULL: silence. */
    void (*progress)(void *user, double fraction);
    void *progress_user;
} nook_ao_desc;

/** One instance of a volume in this frame. */
typedef struct nook_ao_occluder {
    nook_ao_volume volume; /**< What the volume techniques march; id 0: they do not see this occluder. */
    nook_ao_mesh mesh;     /**< What the reference traces; id 0: it does not see this occluder. */
    /** Any affine matrix. A singular one leaves the occluder out, and so does one that floats cannot hold: with voxels smaller than
        1e-18 m or larger than 1e18 m the volume techniques do not see it. Elements 3, 7 and 11 are 0: to 1e-5. */
    double world_from_mesh[16];
} nook_ao_occluder;

enum { NOOK_AO_FETCH_UNITS = 16 };
/** What nook_ao_frame.fetches counts. Steps: turns of the loops in which `volume` and `hao` follow rays; other techniques have none. */
enum { NOOK_AO_COUNTS_FETCHES, NOOK_AO_COUNTS_STEPS };

typedef struct nook_ao_frame {
    double view_from_world[16]; /**< Rigid: to 1e-5. */
    /** Perspective, depth in [0, 1]; normal or reversed-Z is told from it. Only elements 0, 5, 8, 9, 10 and 14 may be anything: no
        oblique near planes. */
    double clip_from_view[16];
    nook_ao_texture depth;  /**< Required. Device depth at full size, row 0 at the bottom. */
    nook_ao_texture normal; /**< World space, octahedral RG (shaders/nook/octahedral.glsl). None: rebuilt from depth.
                                 Give the geometric normal: rays below the true surface are nobody's occlusion. */
    uint32_t index;         /**< Seeds the noise. Same index, same pixels; with ao.reuse where nothing has moved. */
    /** Only its visibility is computed, bit for bit as in a record of the whole picture; what lies outside stays as it was. So
        several techniques can share one picture. All zero: the whole. */
    nook_rectangle part;
    /** 1: depth, normals and both matrices are those of the last record: what was made of them is used again. */
    int same_view;
    /** R32UI of the full size, cleared by the host; none: not counted. NOOK_AO_FETCH_UNITS for every texture fetch of a pixel of
        the part are added to it; those of a pixel of a coarser trace are shared out to the full-size pixels that it stands for. Slower. */
    nook_ao_texture fetches;
    uint32_t counts; /**< NOOK_AO_COUNTS_*: what is added to it instead. */
} nook_ao_frame;

/** @return NOOK_E_ARG, NOOK_E_VERSION, NOOK_E_MEMORY or NOOK_E_DEVICE; *out_ao is NULL on failure. */
nook_result nook_ao_create(const nook_ao_desc *desc, nook_ao **out_ao);
void nook_ao_destroy(nook_ao *ao); /**< NULL is allowed. */
nook_result nook_ao_set_size(nook_ao *ao, uint32_t width, uint32_t height);

/**
 * Makes a technique available by its name; link only those you use. The first one added records until another is chosen.
 * @return NOOK_E_VERSION; NOOK_E_ARG its name is taken; NOOK_E_MEMORY, NOOK_E_DEVICE
 */
nook_result nook_ao_add_technique(nook_ao *ao, const struct nook_ao_technique *technique);

/**
 * Puts a technique into the place of the one of its name, whose code was loaded anew. Both must be loaded; the old one is not
 * used afterwards. Parameters keep their values by name, brought into their range; the shaders are made anew when
 * rows of params.def have changed.
 * @param keep_state  the state's types are laid out alike: it is kept where state_size and state_version are the same, too. Else the
 *                    old code destroys it and the new one creates its own.
 * @return NOOK_E_NOT_FOUND no technique of that name; NOOK_E_VERSION; NOOK_E_MEMORY, NOOK_E_DEVICE or why its create failed: the old
 *         one stays as it was
 */
nook_result nook_ao_replace_technique(nook_ao *ao, const struct nook_ao_technique *technique, int keep_state);

/** The same for nook_ao_desc.progress: who is told how far a long record is. NULL: nobody. */
void nook_ao_set_progress(nook_ao *ao, void (*progress)(void *user, double fraction), void *user);

/**
 * Uploads one .nkv file image (docs/volume_format.md).
 * @param name  used in messages
 * @return NOOK_E_FORMAT not a whole volume file; NOOK_E_VERSION bake again; NOOK_E_MEMORY
 */
nook_result nook_ao_add_volume(nook_ao *ao, const char *name, const void *bytes, size_t size,
                               nook_ao_volume *out_volume);
/** A volume that is there in no kind yet: for nook_ao_extend_volume. @return NOOK_E_MEMORY */
nook_result nook_ao_reserve_volume(nook_ao *ao, nook_ao_volume *out_volume);
/**
 * Gives a volume the same body in one more kind. A technique marches the kind that it reads (`volume.kind`), and leaves out what is
 * not there in it.
 * @return as nook_ao_add_volume; NOOK_E_NOT_FOUND it has been removed; NOOK_E_ARG it is there in this kind. It stays as it was then
 */
nook_result nook_ao_extend_volume(nook_ao *ao, nook_ao_volume volume, const char *name, const void *bytes, size_t size);
void nook_ao_remove_volume(nook_ao *ao, nook_ao_volume volume); /**< In all its kinds. */

/**
 * Called by a record, before it does anything, that is to march kinds of volumes (bits 1 << nook_volume_kind) in which some of the
 * submitted ones are not there: time to extend them, so that nobody bakes kinds that are not marched. Each record asks again
 * while something is missing.
 * @return what the record returns when it is no NOOK_OK
 */
typedef nook_result (*nook_ao_supply)(void *user, uint32_t kinds);
void nook_ao_set_supply(nook_ao *ao, nook_ao_supply supply, void *user); /**< NULL: nobody is asked, as at first. */
/** Kinds of volumes that its techniques march with their parameters as they are now: bits 1 << nook_volume_kind. */
uint32_t nook_ao_volume_kinds(const nook_ao *ao);

enum { NOOK_AO_LIVE_SIDE_MAX = 512 /**< Voxels along a side of a live volume, the empty border included. */ };

/** Triangles in a mesh's buffers. */
typedef struct nook_ao_triangle_range {
    uint32_t first_index, index_count; /**< Into the index buffer; a multiple of 3. */
    uint32_t first_vertex;             /**< Added to each index. */
    uint32_t mask;                     /**< 1 + an index of the mesh's masks; 0: all of it is there. */
} nook_ao_triangle_range;

/** A texture with holes: a point is there where the factor times the alpha of the nearest texel, repeated, is at least the cutoff. */
typedef struct nook_ao_live_mask {
    /** GL name, 2D, of which level 0 is looked at, its first row at v = 0; 0: it has none, and all is there. */
    uint32_t texture;
    float factor, cutoff;
} nook_ao_live_mask;

/** Triangles that stand together. */
typedef struct nook_ao_live_part {
    const nook_ao_triangle_range *ranges;
    uint32_t range_count;
    double volume_from_part[16]; /**< Affine, column-major: from the vertices' space to the volume's, metres. */
} nook_ao_live_part;

/** A mesh on the GPU, in the shape that it has now, or several. */
typedef struct nook_ao_live_mesh {
    uint32_t vertex_buffer; /**< GL name; a vertex begins with its position, three floats, metres. */
    uint32_t vertex_stride; /**< Bytes. */
    uint32_t index_buffer;  /**< GL name; 32-bit. */
    const nook_ao_live_part *parts;
    uint32_t part_count;
    const nook_ao_live_mask *masks; /**< Of the ranges; NULL: none has one. */
    uint32_t uv_offset; /**< Of ranges with a mask: bytes from a vertex to its place on the texture, two floats. */
    /** Of all of them, the volume's space. What leaves the volume's room darkens nothing; nor does anything where a box is not finite. */
    float box_min[3], box_max[3];
    double voxel_size; /**< Metres, > 0. */
} nook_ao_live_mesh;

/**
 * Makes room for a volume of a mesh that changes its shape, or of a whole scene that moves; empty until nook_ao_voxelize. Removed like any other.
 * @param size  voxels along x, y, z: each in [3, NOOK_AO_LIVE_SIDE_MAX]; a box takes its sides / voxel_size, and 4 more
 * @return NOOK_E_RANGE, NOOK_E_MEMORY, NOOK_E_DEVICE; *out_volume is untouched then
 */
nook_result nook_ao_add_live_volume(nook_ao *ao, const char *name, const uint32_t size[3], nook_ao_volume *out_volume);
/**
 * Voxelises a mesh into a live volume, on the GPU, for the records that follow: three slicemaps, ORed. GL's framebuffer, viewport,
 * vertex array and tests are left as they were. It binds a program, textures of units 0 to 2 and, of masks, 5, image unit 0, and does not restore
 * them; sampler objects of these texture units are unbound. Masks are read whatever their own filters. The voxels of a mesh that stands still stay as they are while its box moves.
 * @param volume  of nook_ao_add_live_volume
 * @return NOOK_E_ARG a stale id, a volume that is not live, a voxel_size that is none, a box_max below box_min: all is as it was;
 *         NOOK_E_MEMORY, NOOK_E_DEVICE
 */
nook_result nook_ao_voxelize(nook_ao *ao, nook_ao_volume volume, const nook_ao_live_mesh *mesh);

/**
 * Keeps a copy of a triangle mesh for the reference.
 * @param positions  xyz of vertex_count vertices, metres, mesh space, finite
 * @param indices    index_count of them, a multiple of 3, each below vertex_count
 */
nook_result nook_ao_add_mesh(nook_ao *ao, const float *positions, uint32_t vertex_count, const uint32_t *indices,
                             uint32_t index_count, nook_ao_mesh *out_mesh);
/**
 * The same, and what of it is not opaque: the reference's rays pass through the holes of masked parts, and through blended ones by their
 * alpha. hao's voxels hold masked parts with their holes, and no blended ones.
 * @param alphas  blended parts stand behind all other triangles; NULL: all is opaque
 * @return NOOK_E_ARG also for parts that are not some of the triangles in order and apart
 */
nook_result nook_ao_add_mesh_with_alphas(nook_ao *ao, const float *positions, uint32_t vertex_count,
                                         const uint32_t *indices, uint32_t index_count, const nook_alphas *alphas,
                                         nook_ao_mesh *out_mesh);
/**
 * Keeps a copy of a medium for the reference, as a mesh without triangles: its rays are stopped in it with the probability of what it takes.
 * What marches volumes needs its densities besides (modules/bake/medium_bake.h, modules/ao/residency.h).
 * @return NOOK_E_ARG no cells, more, smaller or longer in all than medium.h says, an extinction that is negative or
 *         not finite; NOOK_E_MEMORY
 */
nook_result nook_ao_add_medium(nook_ao *ao, const nook_medium *medium, nook_ao_mesh *out_mesh);
void nook_ao_remove_mesh(nook_ao *ao, nook_ao_mesh mesh);

/** Chooses who records. Its parameters keep their values. @return NOOK_E_NOT_FOUND (the line lists the names) */
nook_result nook_ao_set_technique(nook_ao *ao, const char *name);

/**
 * Sets "technique.parameter" or, for what all techniques share, "ao.parameter": r_max, falloff, scale, filter, ...
 * (modules/ao/params.def and modules/ao_<technique>/params.def).
 * @return NOOK_E_NOT_FOUND; NOOK_E_RANGE, and then the old value stays.
 */
nook_result nook_ao_set_param(nook_ao *ao, const char *name, double value);
/** The same from text: a number, or a choice by name. @return also NOOK_E_ARG */
nook_result nook_ao_parse_param(nook_ao *ao, const char *name, const char *text);
/** @return NOOK_E_NOT_FOUND */
nook_result nook_ao_get_param(const nook_ao *ao, const char *name, double *out_value);

/** Puts every parameter of every technique, and the shared ones, to its initial value. */
void nook_ao_reset_params(nook_ao *ao);

/** For menus and reports. @return the index-th technique's descriptor, or NULL past the end */
const struct nook_ao_technique *nook_ao_technique_at(const nook_ao *ao, uint32_t index);
/** The table of "ao.*" parameters. */
const struct nook_param *nook_ao_shared_params(size_t *out_count);

/**
 * Replaces the list used by the next record. Call it every frame; count may be 0. What is removed after it is left out.
 * @return NOOK_E_ARG too many, an id that has been removed, a matrix that is not affine: then the list stays as it was
 */
nook_result nook_ao_submit_occluders(nook_ao *ao, const nook_ao_occluder *occluders, uint32_t count);

/**
 * Records prepare, trace, filter and upscale.
 * @return NOOK_E_ARG; NOOK_E_RANGE a part that leaves the picture; NOOK_E_MEMORY; NOOK_E_DEVICE: also when GL raised an error meanwhile, and then the visibility is undefined.
 *         Errors that GL held before are logged and forgotten.
 */
nook_result nook_ao_record(nook_ao *ao, const nook_ao_frame *frame);

/**
 * The next record takes nothing over from those before, whatever ao.reuse and ao.accumulate say: it is the first of others. For what the context cannot
 * know (another `index`) and for what must not depend on what was drawn before (a measurement). Other parameters, shaders, code and sizes it knows.
 */
void nook_ao_forget(nook_ao *ao);

/** Full-resolution R32F visibility of the last records; 1 where there is no geometry. Undefined where nothing was recorded yet. Valid until set_size or destroy. */
nook_ao_texture nook_ao_visibility(const nook_ao *ao);

/** What the last record counted. */
typedef struct nook_ao_statistics {
    /** Texture fetches of the whole record (prepare, trace, filter, upscaling; depth, normals, directions, volumes, visibility), also
        those for pixels without geometry, per full-size pixel with geometry in the recorded part. One of a volume with trilinear filtering counts as
        one like any other; loads of images and buffers count nothing. Needs ao.count = 1, else 0; 0 for the reference. */
    double fetches_per_pixel;
    /** Visibilities that the trace or the filter computed as NaN, or further outside of [0, 1] than 1e-5, before they were clamped:
        0, or there is a mistake. Needs ao.count = 1, else 0. The reference does not clamp, and is not counted. */
    uint32_t outside;
    uint32_t refined;      /**< Pixels that the last record has traced by themselves: ao.refine. */
    uint32_t occluders;    /**< Marched this frame. */
    uint64_t volume_bytes; /**< On the GPU, of the kind that was marched. */
    uint64_t
        texture_bytes; /**< Of the last record's textures: depth, normals and visibility at the host's size and the trace's, with
                            ao.reuse what it keeps of them. Those of other scales are kept besides, once used. */
    uint32_t
        traced; /**< Pixels that the last record traced, when ao.reuse let it take over the others; UINT32_MAX: all of them. */
} nook_ao_statistics;
void nook_ao_get_statistics(nook_ao *ao, nook_ao_statistics *out_statistics); /**< Waits for the GPU. */

#ifdef __cplusplus
}
#endif
