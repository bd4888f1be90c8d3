/**
 * world.h - the ECS world made from a scene. Every node with a mesh is an entity with a transform, a rigid body and a
 * renderable; those that move have their volume occluder beside these, and what stands still shares one of its own.
 */
#pragma once
#include "engine/asset/scene.h"
#include "engine/ecs/world.h"
#include "engine/render/renderer.h"
#include "game/components.h"
#include "game/live_scene.h"
#include "game/live_volumes.h"
#include "modules/ao/nook_ao.h"
#include "modules/bake/volume_file.h"
#include <stdbool.h>

typedef struct nook_game_world nook_game_world;
struct nook_scene_volumes; /* game/volumes.h */
struct nook_volumes_plan;  /* the same */
struct nook_stream;        /* modules/stream/stream.h */

typedef struct nook_game_world_desc {
    uint32_t resolution; /**< Of volumes, see game/volumes.h; 0: the default. */
    double r_max;        /**< Metres; resolutions follow from it. */
    const char *cache;   /**< Folder of baked volumes; NULL: none. */
} nook_game_world_desc;

/** What a volume is in one kind. */
typedef struct nook_world_bake {
    bool there;     /**< It has been baked in this kind. */
    bool cached;    /**< Read from the cache. */
    uint64_t bytes; /**< As it is on the GPU. */
    double ms;      /**< Wall time of baking, or of reading it from the cache. */
} nook_world_bake;

/** A volume, for reports. */
typedef struct nook_world_volume {
    char name[64];
    uint32_t width, height, depth; /**< Voxels; 0 before it was baked in any kind. */
    double voxel_size;             /**< Metres. */
    uint32_t instances;            /**< Bodies that it stands for. */
    nook_volume_occluder occluder; /**< Its ids in the AO. */
    bool streamed;                 /**< Its volume is the stream's. */
    nook_world_bake bakes[NOOK_VOLUME_KINDS];
} nook_world_volume;

/** All of some kinds together: there and cached when everything that is there is. @param kinds  bits NOOK_VOLUME_BIT */
nook_world_bake nook_world_volume_sum(const nook_world_volume *volume, uint32_t kinds);
#define NOOK_WORLD_EVERY_KIND UINT32_MAX

/**
 * Makes the entities of a scene's nodes. Nothing darkens yet.
 * @param scene  outlives the world
 * @return why not; *out_world is NULL then
 */
nook_result nook_game_world_create(const nook_scene *scene, nook_game_world **out_world);
/**
 * Bakes or reads the volumes, in the kinds that the AO's techniques march as they are set (with progress on standard error), uploads
 * them with their triangles, and gives the entities their occluders. Once in the life of a world.
 * @param ao    outlives the world
 * @param plan  what may be left out and made coarser; NULL: nothing
 * @return why not; destroy the world then
 */
nook_result nook_game_world_bake(nook_game_world *world, nook_ao *ao, const nook_game_world_desc *desc,
                                 const struct nook_volumes_plan *plan);
/** Has volumes streamed that are baked from here on. @param stream  of the same AO; outlives the world. NULL: they stay */
void nook_game_world_set_stream(nook_game_world *world, struct nook_stream *stream);
/** Whether the AO multiplies the visibilities of several volumes (volume.combine, volume.path), as a plan must know. */
bool nook_game_world_multiplies(const nook_ao *ao);
/**
 * The same with volumes that were baked elsewhere, of the same scene; empties them. Takes as long as the uploads.
 * @param live  0; else voxels along the longest side of one live volume of all that is rigid (game/live_scene.h): what was baked is
 *              not marched then, and may be missing
 * @return as nook_game_world_bake
 */
nook_result nook_game_world_take_volumes(nook_game_world *world, nook_ao *ao, struct nook_scene_volumes *baked,
                                         uint32_t live);
/**
 * Bakes or reads the volumes in more kinds, and uploads those: when they are asked for (nook_ao_set_supply). What is there already
 * costs nothing.
 * @param kinds  bits NOOK_VOLUME_BIT @param desc  as the world was baked
 * @return as nook_game_world_bake; what was there stays
 */
nook_result nook_game_world_supply(nook_game_world *world, uint32_t kinds, const nook_game_world_desc *desc);
/** Kinds that its volumes are there in: bits NOOK_VOLUME_BIT. */
uint32_t nook_game_world_kinds(const nook_game_world *world);
/** NULL is allowed. Takes its volumes and triangles out of the AO that they were baked for. */
void nook_game_world_destroy(nook_game_world *world);

/** For those who give its entities more components. */
nook_world *nook_game_world_entities(nook_game_world *world);
const nook_components *nook_game_world_components(const nook_game_world *world);
/** The entity of a node, by its place in scene->nodes; {0} for a node without a mesh. */
nook_entity nook_game_world_entity_of_node(const nook_game_world *world, uint32_t node);

/** Gives the world the systems of this code, which was loaded anew. @return as nook_world_replace_system */
nook_result nook_game_world_renew(nook_game_world *world);

/** Runs one frame's systems and submits the occluders they collected. @return NOOK_E_MEMORY, NOOK_E_ARG */
nook_result nook_game_world_update(nook_game_world *world, nook_ao *ao);

/** The one volume of all that is rigid; zero where volumes were baked. */
const nook_live_scene *nook_game_world_live_scene(const nook_game_world *world);
/** Of what bends by clips; count 0 where nothing does. */
const nook_live_volumes *nook_game_world_live_volumes(const nook_game_world *world);
/** Seconds that pass for what is animated with the next update; calls before it add up. Backwards below 0. */
void nook_game_world_advance(nook_game_world *world, double seconds);
/** Of the scene's deformables, and their version, as in nook_frame; NULL where nothing is animated. */
const nook_mesh_pose *nook_game_world_poses(const nook_game_world *world, uint32_t *out_version);

/**
 * Makes live volumes anew: that of the scene where something has moved, those of deformables where their pose has changed and it matters
 * for what a camera sees. After an update.
 * @param scene  the world's, on the GPU; is put into the pose @return as nook_ao_voxelize
 */
nook_result nook_game_world_voxelize(nook_game_world *world, nook_render_scene *scene, const nook_camera *camera,
                                     double aspect);
/** Whether the next updates also give techniques that read triangles those of deformables as they are; false at first. */
void nook_game_world_set_traced(nook_game_world *world, bool traced);

/** What the last update collected; valid until the next. */
const nook_draw *nook_game_world_draws(const nook_game_world *world, size_t *out_count);
/** What it submitted to the AO; valid until the next. */
const nook_ao_occluder *nook_game_world_occluders(const nook_game_world *world, uint32_t *out_count);
const nook_world_volume *nook_game_world_volumes(const nook_game_world *world, uint32_t *out_count);
