/**
 * volumes.h - what of a scene darkens its surroundings: its bodies, each with a volume, and where they stand.
 *
 * A moving node with a mesh is a body; its volume is in the mesh's own space, and all nodes with that mesh share it. All other
 * nodes with a mesh are one body, "static", in a space that is the world moved to the scene's centre (so that floats suffice).
 *
 * Animation     What a clip moves is a body. A mesh that skins or morph targets deform while it plays is voxelised every
 *               frame (game/live_volumes.h); one that stands still in a pose has one like any other (engine/animation/scene_stand.h).
 * Materials     Masked ones are in, with their holes. Blended ones are in densities and surfels with their alpha, in distances where that is at
 *               least a half, and left out of voxels, which would make glass as dark as a wall.
 * Densities     of the scene (nook_density) come last. They are in no cache: who uploads them bakes them (modules/bake/medium_bake.h).
 * Resolution    follows from r_max: finer than r_max / NOOK_VOLUMES_VOXELS_PER_R_MAX cannot be told apart in the result. The static
 *               volume takes the `resolution` asked for on its longest side. A body takes as many voxels as make them that
 *               small in the world (at its largest instance), but at least NOOK_VOLUMES_BODY_RESOLUTION_MIN and at most
 *               half the resolution asked for.
 */
#pragma once
#include "engine/asset/scene.h"
#include "modules/bake/cache.h"
#include "modules/plan/plan_params.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_VOLUMES_RESOLUTION_DEFAULT 256u
#define NOOK_VOLUMES_R_MAX_DEFAULT 0.1 /**< Of the diagonal of the scene's bounds. */
#define NOOK_VOLUMES_VOXELS_PER_R_MAX 64
#define NOOK_VOLUMES_BODY_RESOLUTION_MIN 16u

/** A file of a volume, for those who read it when it is wanted. */
typedef struct nook_volume_level {
    char *path;            /**< In the cache. Owned. */
    nook_volume_info info; /**< What it holds. */
    double error; /**< RMS of visibility with it, by measurement of voxels of this size (nook_plan_level_error). */
} nook_volume_level;

enum { NOOK_VOLUMES_LEVELS_MAX = 3 /**< Of a kind: each of half the resolution of the one before. */ };

/** A unique volume: one mesh, or all that stands still. */
typedef struct nook_scene_volume {
    char *name;       /**< The mesh's name, or "static"; never NULL. */
    float *positions; /**< xyz, metres, mesh space; packed. Finite. */
    uint32_t vertex_count;
    uint32_t *indices;  /**< First all but blended materials; the reference traces both. */
    size_t index_count; /**< A multiple of 3; 0: a body of glass alone, which is no voxels. */
    /** Blended ones stand behind those, in both arrays, and masked ones that are nowhere there. */
    uint32_t blended_vertex_count;
    size_t blended_index_count;
    /** The last ones among those: of no material that is anywhere there in distances, masked away ones too. They would only make the box of
        distances larger and its voxels coarser. */
    uint32_t clear_vertex_count;
    size_t clear_index_count;
    float *uvs;             /**< Two for each vertex, blended ones too. */
    nook_alpha_part *parts; /**< What of all this is not opaque; texels are the scene's. */
    uint32_t part_count;
    const nook_medium *medium; /**< Instead of triangles: a density of the scene, which outlives it. NULL: triangles. */
    double longest;      /**< Longest side of the box of what is not blended, or else of all, metres, mesh space. */
    uint32_t instances;  /**< Occluders that it stands for. */
    uint32_t resolution; /**< What it was baked at: voxels on the longest side; 0: not at all, a plan leaves out its
                              bodies. */
    nook_bake bakes[NOOK_VOLUME_KINDS]; /**< Of each kind asked for: the .nkv file image, what it holds, bake time,
                                             cache hit; else zero. */
    nook_volume_level
        *levels; /**< Where they are to be streamed: of each kind that is in the cache, the finest first. Owned. */
    uint32_t level_count;
    double scale; /**< The same: world metres for a metre of mesh space, at its largest instance. */
} nook_scene_volume;

/** A body in the scene. */
typedef struct nook_scene_occluder {
    uint32_t volume;             /**< Into volumes. */
    uint32_t node;               /**< Into scene->nodes; NOOK_NONE for the static body. */
    nook_matrix world_from_mesh; /**< Invertible. For the static body a translation. */
    bool left_out;               /**< By a plan: nobody marches it; the reference traces it. */
} nook_scene_occluder;

/** A primitive of what stands still. */
typedef struct nook_volumes_part {
    size_t first_index, index_count; /**< Into the static volume's indices. */
} nook_volumes_part;

/** What may be left out and made coarser (docs/plan.md). */
typedef struct nook_volumes_plan {
    nook_plan_params params; /**< Zero: nothing. */
    bool moves;              /**< Bodies will not stay where they stand. */
    bool multiplies;         /**< nook_setting_multiplies. */
} nook_volumes_plan;

/** Owns all it points to. */
typedef struct nook_scene_volumes {
    nook_scene_volume *volumes;
    uint32_t volume_count;
    nook_scene_occluder *occluders;
    uint32_t occluder_count;
    nook_volumes_part *
        parts; /**< Of the static volume, in its order; those that draw something. Empty once a plan has split it, and where
                     some of it is blended. */
    uint32_t part_count;
    double r_max;           /**< Metres; the one that the resolutions follow from. */
    uint32_t kinds;         /**< Those that were asked for: bits NOOK_VOLUME_BIT. */
    nook_volumes_plan plan; /**< As it was asked for: more kinds need the same. */
} nook_scene_volumes;

typedef struct nook_volumes_desc {
    uint32_t resolution;    /**< [1, 512]; 0: NOOK_VOLUMES_RESOLUTION_DEFAULT. */
    double r_max;           /**< Metres; 0: NOOK_VOLUMES_R_MAX_DEFAULT of the diagonal. */
    const char *cache_dir;  /**< NULL: no cache. */
    bool must_keep;         /**< Volumes that cannot be kept in the cache are a failure; else one warning. */
    uint32_t kinds;         /**< Of volumes: bits NOOK_VOLUME_BIT; 0: binary ones. */
    uint32_t threads;       /**< 0: all cores. */
    bool streams;           /**< Also bakes coarser levels, and says where all of them lie. */
    nook_volumes_plan plan; /**< Zero: nothing is planned. */
    /** Of the scene as it was before it was edited, from nook_volumes_collect: what has not changed is taken from its volumes in the cache.
        NULL: nothing is known. Borrowed. */
    const nook_scene_volumes *before;
    /** Called after each volume; NULL for none. `index` runs from 0 to count - 1. */
    void (*progress)(void *user, const nook_scene_volume *done, uint32_t index, uint32_t count);
    void *user;
} nook_volumes_desc;

/** r_max when none is given: 0 for a scene with nothing to draw. */
double nook_volumes_default_r_max(const nook_scene *scene);

/** Voxels along the longest side of a body that is `longest` metres in the world. See the top of this file. */
uint32_t nook_volumes_body_resolution(double longest, double r_max, uint32_t resolution);

/**
 * What would be baked: bodies with their triangles and resolutions, without volumes and densities.
 * @return as nook_volumes_bake
 */
nook_result nook_volumes_collect(const nook_scene *scene, const nook_volumes_desc *desc, nook_scene_volumes *out);

/** Makes room for so many more volumes and occluders, behind those that are there. @return NOOK_E_MEMORY */
nook_result nook_volumes_reserve(nook_scene_volumes *volumes, uint32_t more);

/**
 * Puts the scene's densities behind what is there, each a volume of its own that stands still: after a plan, which knows triangles only.
 * @return NOOK_E_MEMORY
 */
nook_result nook_volumes_add_densities(const nook_scene *scene, uint32_t resolution, nook_scene_volumes *volumes);

/**
 * Bakes a scene, or reads it from the cache. Nodes with corners that are not finite only, without any area, or
 * with a scale of zero have no volume; a scene may have none at all.
 * @return NOOK_E_RANGE resolution or r_max; NOOK_E_MEMORY; NOOK_E_IO must_keep, and they cannot be kept; *out is untouched on failure
 */
nook_result nook_volumes_bake(const nook_scene *scene, const nook_volumes_desc *desc, nook_scene_volumes *out);
/**
 * Whether a bake is in the cache, as the desc asks. What stops one volume stops all: one line for the whole cache.
 * @param warned  false before the first; true once the line is out
 * @return NOOK_E_IO must_keep, and it is not
 */
nook_result nook_volumes_check_kept(const nook_volumes_desc *desc, const nook_bake *bake, bool *warned);
/** What a kind is made of. @param out_triangles  of the volume; none: there is nothing to bake @param out_alphas  of them */
void nook_volumes_select(const nook_scene_volume *volume, nook_volume_kind kind, nook_triangles *out_triangles,
                         nook_alphas *out_alphas);
/** Of all its triangles, blended ones too. */
size_t nook_scene_volume_index_count(const nook_scene_volume *volume);
/** Of those that a volume of a kind is made of. */
size_t nook_scene_volume_indices_of(const nook_scene_volume *volume, nook_volume_kind kind);
/** The first kind that a volume was baked in. @return NULL for none */
const nook_bake *nook_scene_volume_bake(const nook_scene_volume *volume);
/** Its files of a kind. @param out_count  0: it is not to be streamed in this kind @return the finest */
const nook_volume_level *nook_scene_volume_levels(const nook_scene_volume *volume, nook_volume_kind kind,
                                                  uint32_t *out_count);
/** Frees one volume's data once it has been uploaded; its name, numbers and place stay. */
void nook_scene_volume_release(nook_scene_volume *volume);
void nook_volumes_free(nook_scene_volumes *volumes); /**< NULL and zeroed ones are allowed. */

#ifdef __cplusplus
}
#endif
