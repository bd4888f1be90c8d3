/**
 * technique.h - what an ambient-occlusion technique is: constant data and code, no state of its own.
 *
 * The host (modules/ao/ao.c) prepares the inputs at the AO resolution, owns state and parameters, filters and upscales the
 * result. A technique turns view-space depth and normals into visibility; see docs/adding_a_technique.md.
 */
#pragma once
#include "engine/core/matrix.h"
#include "engine/core/param.h"
#include "engine/gpu/gpu.h"
#include "modules/ao/nook_ao.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_AO_TECHNIQUE_VERSION 16

/** A box of voxels. */
typedef struct nook_ao_box {
    uint32_t origin[3], size[3];
} nook_ao_box;

#define NOOK_AO_CHANGED_ALL UINT32_MAX

/** Triangles for the reference, in mesh space. */
typedef struct nook_ao_mesh_view {
    const float *positions;  /**< xyz * vertex_count, metres. */
    const uint32_t *indices; /**< index_count, a multiple of 3. */
    uint32_t vertex_count, index_count;
    uint32_t solid_index_count; /**< Of the indices: those before blended parts. */
    const nook_alphas *alphas;  /**< NULL: all is opaque. Lives as long as the mesh. */
    const nook_medium
        *medium; /**< Instead of triangles, of which there are none then. NULL: none. Lives as long as the mesh. */
    uint32_t id; /**< Never reused: a cache key. */
} nook_ao_mesh_view;

/** One traced instance of this frame: view space, metres, composed in double. */
typedef struct nook_ao_mesh_instance {
    uint32_t mesh; /**< Into pass->meshes. */
    nook_matrix view_from_mesh;
} nook_ao_mesh_instance;

/**
 * One frame's work at the AO resolution. Everything is in view space: metres, right-handed, the camera at the origin
 * looking along -Z. Row 0 is the bottom row.
 */
typedef struct nook_ao_pass {
    nook_gpu *gpu;
    nook_texture depth; /**< R32F, distance along -Z in metres, > 0; 0 where there is no geometry. */
    nook_texture
        normal; /**< RG16 octahedral (shaders/nook/octahedral.glsl), unit, view space; any value without geometry. */
    nook_texture
        visibility; /**< Output, R32F, [0, 1], 1 = open. Write every wanted pixel; 1 where there is no geometry. */
    nook_buffer
        frame; /**< Uniform block of shaders/ao/frame.glsl: sizes, rays of view, r_max, falloff, seed. Binding 0. */
    nook_buffer params;  /**< Uniform block of this technique's params.def. Binding 1. */
    nook_buffer counter; /**< Storage, texture fetches and values out of range. Binding 7: shaders/ao/counter.glsl. */
    int counting;        /**< Not 0: something is counted, see nook_ao_pass_defines. */
    uint32_t width, height; /**< Of depth, normal and visibility, pixels. */
    /** NULL, or the trace is of a list of points: shaders/ao/refine.glsl, whose groups this buffer begins with. Depth and normals are those of the
        trace before it; visibility, width and height are those of the list, a texel for each of them. */
    const nook_buffer *listed;
    int lists; /**< Not 0: both are traced in this frame, the trace and a list. One program may do both: EITHER of shaders/ao/listed.glsl. */
    /** Which part of a sequence of rays is traced, 0 unless the technique is reusable: nook_fill_directions of modules/ao/sampling.h. All parts
        together are one sequence of as many times the rays. */
    uint32_t part;
    /** Only these pixels are wanted, begin[] to end[] - 1: all others must keep what visibility holds. */
    uint32_t begin[2], end[2];
    uint32_t origin[2]; /**< Pixel of invocation (0, 0) of a dispatch, see nook_ao_pass_groups: a multiple of 8. */
    /** NULL: all wanted pixels are traced. Else only those that this buffer lists tile by tile: shaders/ao/tiles.glsl, binding
        NOOK_AO_BINDING_TILES. It begins with the groups of a dispatch. The others have been written. Only for techniques that say
        that they are reusable. */
    const nook_buffer *tiles;

    /** The same numbers as in the frame block, for techniques that run on the CPU. */
    double r_max;
    int falloff;   /**< Index into the choices of ao.falloff: shaders/ao/falloff.glsl has the formulas. */
    uint32_t seed; /**< From the frame index. */
    double falloff_tau;
    /** View position of a pixel: (ndc * ray_scale + ray_offset, -1) * depth, with ndc = 2 (pixel + 0.5) / size - 1. */
    double ray_scale[2], ray_offset[2];
    nook_matrix view_from_world; /**< Rigid: for what stands still in the world while the view moves. */
    /** For work over a second: fraction in [0, 1]. Never NULL; called on the recording thread. */
    void (*progress)(void *user, double fraction);
    void *progress_user;

    /** NOOK_AO_IN_VOLUMES: bound by the host for modules/ao/volumes.h; see shaders/ao/occluders.glsl. */
    nook_texture volume_atlas; /**< R8 3D, of the kind that is marched, but for surfels. Binding 2. */
    uint32_t
        volume_atlas_version; /**< Another one when the atlas, or what it holds, is another: for what is made of it. */
    /** Where the atlas has changed since the version before; of another texture, of other sides maybe, all boxes that hold volumes.
        NOOK_AO_CHANGED_ALL: anywhere. */
    uint32_t volume_atlas_change_count;
    const nook_ao_box *volume_atlas_changes;
    nook_texture bricks;  /**< Texture buffer RGBA32UI, of all surfel volumes: docs/surfel_bricks.md. Binding 5. */
    nook_texture surfels; /**< Texture buffer RG32UI. Binding 6. */
    uint32_t line_max;    /**< More voxels than this no straight line crosses in any of the occluders. */
    nook_texture occluder_texture; /**< RGBA32F of a buffer: the occluders' rows. Binding 3. */
    nook_buffer occluders;         /**< That buffer. */
    uint32_t occluder_count;
    /** NULL: not asked for by reads_bins, or they would win nothing. Else which of them may reach which part of the picture, for programs with BINNED defined:
        shaders/ao/tile_list.glsl. Storage, binding 2. */
    const nook_buffer *bins;
    uint32_t occluders_tested; /**< By a tile at the most: of a bin's list, or all. */

    /** NOOK_AO_IN_MESHES. */
    const nook_ao_mesh_view *meshes;
    uint32_t mesh_count;
    const nook_ao_mesh_instance *instances;
    uint32_t instance_count;
    /** A distance z may be off by depth_error[0] * z + depth_error[1] * z^2 metres: the format of the host's depth. */
    double depth_error[2];
} nook_ao_pass;

enum { NOOK_AO_IN_VOLUMES = 1, NOOK_AO_IN_MESHES = 2 };
enum { NOOK_AO_BINDING_TILES = 3 }; /**< Of storage. */

/** What a shared library of a technique lends (engine/module/module.h): its interface is a nook_ao_technique. */
#define NOOK_AO_TECHNIQUE_KIND "ao.technique"

/** The one thing a technique module exports. */
typedef struct nook_ao_technique {
    uint32_t version; /**< NOOK_AO_TECHNIQUE_VERSION, else the module is refused with NOOK_E_VERSION. */
    uint32_t inputs;  /**< NOOK_AO_IN_*, beyond depth and normal, which all have. */
    uint32_t exact;   /**< 1: truth; always at full resolution, and not filtered, unless is_filtered says so. */
    /** 1: record can trace a list (pass->listed), which all do that dispatch by the functions below and find their point by
        shaders/ao/point.glsl. */
    uint32_t refines;
    const char *name;    /**< [a-z0-9_]+; the folder is modules/ao_<name>. */
    const char *summary; /**< One line for the menu. */
    /** NOOK_AO_IN_VOLUMES: the kind of volume that it marches with these parameters, a nook_volume_kind. NULL: binary. */
    uint32_t (*volume_kind)(const void *params);
    /** NOOK_AO_IN_VOLUMES: whether record reads pass->bins with these parameters; else none are made. NULL: never. */
    uint32_t (*reads_bins)(const void *params);
    /** 1: with these parameters a pixel's visibility follows from its surface, the volumes within r_max and the seed, wherever the
        camera is; and record traces no more than pass->tiles where that is given. So it can be taken over from the frame before,
        ao.reuse, and be a mean over frames, ao.accumulate. NULL: never. */
    uint32_t (*is_reusable)(const void *params);
    /** Of an exact one: whether it is filtered with these parameters. NULL: never. */
    uint32_t (*is_filtered)(const void *params);
    const nook_param *params;
    uint32_t param_count;
    uint32_t params_size;   /**< Bytes of the struct made from params.def. */
    uint32_t state_size;    /**< Bytes; the host owns them, zeroes them and keeps them across reloads. */
    uint32_t state_version; /**< Raise it with the state struct: the host destroys (old code), creates (new). */
    nook_result (*create)(void *state, nook_gpu *gpu); /**< May be NULL. On failure nothing is left to destroy. */
    void (*destroy)(void *state, nook_gpu *gpu);       /**< May be NULL. */
    /** @param params  the struct made from params.def; the same bytes are in pass->params */
    nook_result (*record)(void *state, const void *params, const nook_ao_pass *pass);
} nook_ao_technique;

/**
 * Lines that programs of a technique are compiled with: those that count, when the pass does.
 * @param either  not 0: the shader takes EITHER, and is told by a uniform which of both it traces
 */
const char *nook_ao_pass_defines(const nook_ao_pass *pass, int either);

/** Groups of a dispatch over a trace's pixels that starts at origin and covers the wanted pixels. @param local_x, local_y  local size, pixels */
void nook_ao_pass_groups(const nook_ao_pass *pass, uint32_t local_x, uint32_t local_y, uint32_t out_groups[2]);

/**
 * Runs one compute shader over the trace with everything of the pass bound (see nook_ao_pass): most techniques' record.
 * @param local_x, local_y  the shader's local size, pixels
 * @return NOOK_E_NOT_FOUND, NOOK_E_DEVICE
 */
nook_result nook_ao_pass_dispatch(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x,
                                  uint32_t local_y);

/** Loop turns of one invocation that a dispatch may take: a software driver ends all loops silently after 65535. */
enum { NOOK_AO_TURNS_PER_DISPATCH = 60000 };

/**
 * As nook_ao_pass_dispatch, for work that may be too much for one dispatch: a GPU that works for seconds on one is reset, and
 * llvmpipe ends all loops of an invocation without a word after 65535 turns in sum. The work of a pixel is `count` items. Each
 * dispatch does items part.x to part.y - 1, part being the shader's `layout(location = 0) uniform ivec2`, and takes their
 * occlusion off the visibility image, which starts with the dispatch whose part.x is 0: see shaders/ao/screen.glsl.
 * @param turns_per_item  loop turns of an item, in [1, NOOK_AO_TURNS_PER_DISPATCH]
 * @return NOOK_E_NOT_FOUND, NOOK_E_DEVICE
 */
nook_result nook_ao_pass_dispatch_parts(const nook_ao_pass *pass, const char *shader_path, uint32_t local_x,
                                        uint32_t local_y, int32_t count, int32_t turns_per_item);

#ifdef __cplusplus
}
#endif
