/**
 * scene_loading.h - a scene read and its volumes baked on a thread of its own, while the one that is shown is drawn on.
 */
#pragma once
#include "engine/asset/scene.h"
#include "game/level/level.h"
#include "game/moment.h"
#include "game/volumes.h"

typedef struct nook_scene_loading nook_scene_loading;

typedef struct nook_scene_loading_desc {
    const char *path;    /**< .level, .gltf or .glb. */
    bool is_level;       /**< The scene is joined of what a level names. */
    nook_moment moment;  /**< The pose of a scene that is one file. */
    uint32_t resolution; /**< As nook_game_world_desc. */
    double r_max;        /**< The same. */
    uint32_t kinds;      /**< Of volumes: bits NOOK_VOLUME_BIT; 0: binary ones. */
    const char *cache;   /**< The same; volumes of meshes that are as they were come from it. */
    /** The scene that is shown: surfels are made anew only where meshes differ from its. Constant until the load is finished; NULL: none. */
    const nook_scene *shown;
    nook_volumes_plan plan;   /**< Zero: nothing is planned. */
    bool live;                /**< As nook_stage.live_scene: nothing is planned or baked. */
    bool streams;             /**< As nook_volumes_desc. */
    uint32_t unreadable_most; /**< Images that may be unreadable: those that are so in the scene that is shown. */
} nook_scene_loading_desc;

/** What a load gives; everything is the caller's. */
typedef struct nook_loaded_scene {
    nook_level *level; /**< NULL: the scene is one file. */
    nook_scene *scene;
    nook_scene_volumes volumes; /**< Of the scene. */
} nook_loaded_scene;

/** Images of a scene that could not be read. */
uint32_t nook_scene_unreadable_images(const nook_scene *scene);

/** Starts a thread. @return NOOK_E_MEMORY no memory or no thread; *out_load is NULL then */
nook_result nook_scene_loading_start(const nook_scene_loading_desc *desc, nook_scene_loading **out_load);
/** Whether nook_scene_loading_finish will not wait. */
bool nook_scene_loading_is_done(const nook_scene_loading *load);
/**
 * Waits for the thread and ends the load.
 * @param out      on NOOK_OK what was loaded; else zero
 * @param out_why  on failure the line that was logged, cut to capacity
 */
nook_result nook_scene_loading_finish(nook_scene_loading *load, nook_loaded_scene *out, char *out_why, size_t capacity);
void nook_loaded_scene_free(nook_loaded_scene *loaded); /**< Zeroed ones are allowed; becomes zero. */
