/**
 * scene_reload.h - models, textures and levels that are saved while they are shown: read and baked in the background, then
 * exchanged between two frames. Until then, and when something is wrong with them, what is shown stays.
 *
 *   every frame:  if (nook_scene_reload_poll(reload)) { let go of the old scene; nook_scene_reload_swap(reload, go_on, game); }
 */
#pragma once
#include "game/level/level.h"
#include "game/stage.h"

typedef struct nook_scene_reload nook_scene_reload;

typedef struct nook_scene_reload_status {
    const char *error; /**< Why what is on disk is not shown: a line; "" when it is. */
    bool loading;      /**< Something is read or baked in the background. */
    uint32_t reloads, failures;
    double last_ms; /**< From the last change, on disk, until it was exchanged; 0: none yet. */
    double swap_ms; /**< Of that, what the frame waited for: uploads. */
} nook_scene_reload_status;

/**
 * Watches the files of the stage's scene: glTF files, their buffers and images, the level.
 * @param stage filled; outlives this @param level the level that its scene was made of; NULL: the scene is a file of its own
 * @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_MEMORY; *out_reload is NULL then
 */
nook_result nook_scene_reload_create(nook_stage *stage, const char *level, nook_scene_reload **out_reload);
void nook_scene_reload_destroy(
    nook_scene_reload *reload); /**< Waits for what runs in the background. NULL is allowed. */

/**
 * Tells how the AO joins several volumes, as a plan must know (nook_setting_multiplies); as they were planned until it is called.
 * Volumes that were planned for the other way are planned anew with the next poll, as after a file was saved.
 */
void nook_scene_reload_plan_for(nook_scene_reload *reload, bool multiplies);
/** Once a frame, before anything of it is drawn. @return true: a new scene waits for nook_scene_reload_swap */
bool nook_scene_reload_poll(nook_scene_reload *reload);
/**
 * What is played in the scene goes on in the new one. @param level  taken over, also on failure @param scene, world  outlive the game
 * @return why not; it goes on in the old one then
 */
typedef nook_result (*nook_scene_go_on)(void *game, nook_level *level, const nook_scene *scene, nook_game_world *world);
/**
 * Shows the scene that waits; the one of before is gone, with its world and its ids in the AO.
 * @param go_on  called with `game`; the stage's scene is a level then. NULL: nobody plays
 * @return why not, which `error` says too; everything is as it was then
 */
nook_result nook_scene_reload_swap(nook_scene_reload *reload, nook_scene_go_on go_on, void *game);

/** As of the last call; valid until the next. */
const nook_scene_reload_status *nook_scene_reload_status_of(const nook_scene_reload *reload);
/** Returns when nothing runs in the background: to be called before this code is exchanged for another build of it. */
void nook_scene_reload_wait(nook_scene_reload *reload);
