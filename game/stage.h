/**
 * stage.h - everything a picture needs, made in its one right order: context, GPU, scene, ambient occlusion, world, renderer.
 */
#pragma once
#include "engine/asset/scene.h"
#include "engine/platform/context.h"
#include "engine/render/renderer.h"
#include "game/moment.h"
#include "game/progress.h"
#include "game/world.h"
#include "modules/ao/nook_ao.h"
#include "modules/plan/plan_params.h"
#include "modules/stream/stream.h"

typedef struct nook_stage_desc {
    const char *root;       /**< The folder that holds shaders/. */
    const char *scene_path; /**< Loaded, unless there is a scene. */
    nook_scene *scene;      /**< Taken over, also on failure. NULL: load scene_path. */
    nook_backend backend;
    bool want_window;       /**< Where there is a display. */
    uint32_t width, height; /**< Of the pictures, pixels. */
    nook_moment moment;     /**< The pose that the scene stands in, unless it plays. */
    bool plays; /**< Clips run; else the scene stands still, and its volumes and reference are of its pose. */
} nook_stage_desc;

/** Members are for reading, unless they say otherwise; the stage owns them. It must stay where it was opened. */
typedef struct nook_stage {
    uint32_t width, height;
    nook_scene *scene;
    nook_context *context;
    nook_gpu *gpu;
    nook_ao *ao;            /**< With every technique. */
    nook_game_world *world; /**< Its entities stand from opening on; what they darken comes with filling. */
    nook_render_scene *render_scene;
    nook_renderer *renderer;
    nook_lights lights;
    nook_frame frame; /**< The last one begun. */
    bool shows;       /**< There is a window, and it is wanted. */
    bool filled;
    nook_moment moment;           /**< As it was opened; its text is that of who opened it. */
    bool plays;                   /**< The same. */
    nook_game_world_desc volumes; /**< As it was filled; its text is that of who filled it. */
    uint32_t occluder_max;        /**< Bodies that the AO has room for. */
    bool stop_asked;              /**< Esc or the close button while nook_stage_show looked. */
    bool quick; /**< Yours to set: draws as for play, nook_frame.quick and single-sided materials from one side. */
    nook_stream_params stream_params; /**< Yours to set before filling: budget 0: all volumes stay on the GPU. */
    nook_stream *stream;              /**< NULL: they do. */
    nook_plan_params plan; /**< Yours to set before filling: what may be left out and made coarser; zero: nothing. */
    bool
        live_scene; /**< Yours to set before filling: one volume of all that is rigid, voxelised as it moves; nothing is baked. */
    uint32_t frame_index;    /**< Yours to set: seeds the noise of nook_stage_occlude. */
    nook_progress *progress; /**< Yours to set: told how far a long record is. NULL: nobody. */
} nook_stage;

/**
 * Loads the scene and opens the devices: all that is cheap to fail. The AO takes parameters from here on.
 * @return NOOK_E_RANGE a size that this machine cannot hold, NOOK_E_FORMAT nothing to draw, or why loading or GL failed;
 *         *out_stage is zero then
 */
nook_result nook_stage_open(const nook_stage_desc *desc, nook_stage *out_stage);

/**
 * Bakes the volumes and uploads everything: the long part. Kinds of volumes that no technique marches as it is set now are baked when a
 * record asks for them. Again with another description it makes the world anew
 * with other volumes; begin a frame after it.
 * @return why not; close the stage then
 */
nook_result nook_stage_fill(nook_stage *stage, const nook_game_world_desc *desc);

/**
 * After code was loaded anew: the world's systems, whom the AO tells of long records, and whom it asks for volumes. Its techniques are replaced by
 * nook_ao_replace_technique. @return as nook_world_replace_system
 */
nook_result nook_stage_renew(nook_stage *stage);

/** What is seen and what darkens it: what a stage can exchange while it runs. */
typedef struct nook_stage_scene {
    nook_scene *scene;
    nook_game_world *world; /**< Of the scene, with its volumes in the stage's AO. */
    nook_render_scene *render_scene;
} nook_stage_scene;

/**
 * Uploads a scene whose volumes were baked elsewhere, beside the one that is shown; the stage stays as it is.
 * @param scene  stays the caller's on failure @param baked of the scene; emptied
 * @return NOOK_E_RANGE more bodies than the stage has room for; NOOK_E_FORMAT nothing to draw; NOOK_E_MEMORY, NOOK_E_DEVICE; *out is zero then
 */
nook_result nook_stage_scene_upload(nook_stage *stage, nook_scene *scene, struct nook_scene_volumes *baked,
                                    nook_stage_scene *out);
/** Shows that one from the next frame on; the exposure stays, the lights are its own. What was shown before is the caller's. */
nook_stage_scene nook_stage_exchange_scene(nook_stage *stage, const nook_stage_scene *scene);
void nook_stage_scene_destroy(nook_stage_scene *scene); /**< With its volumes in the AO; zeroed ones are allowed. */

void nook_stage_close(nook_stage *stage); /**< Zeroed stages are allowed; becomes zero. */

/** @return why not; the stage must be closed then */
nook_result nook_stage_set_size(nook_stage *stage, uint32_t width, uint32_t height);

/* The parts of begin, occlude and finish, for those who draw several views of one frame (game/live). */

/** Runs the systems, submits the occluders and fills in the frame; draws nothing. @return why not */
nook_result nook_stage_update(nook_stage *stage, const nook_camera *camera);
/** Whether GL took everything since the last check; that says itself what it did not take. @return NOOK_E_DEVICE */
nook_result nook_stage_check(nook_stage *stage, const char *where);
/** What nook_ao_record takes for the last G-buffer: the whole picture. */
nook_ao_frame nook_stage_ao_frame(const nook_stage *stage);
/** What the AO wrote last; id 0 before its first record. */
nook_texture nook_stage_visibility(const nook_stage *stage);

/** Runs the systems, submits the occluders, draws the G-buffer. @return why not; NOOK_E_DEVICE: GL raised an error */
nook_result nook_stage_begin(nook_stage *stage, const nook_camera *camera);
/** Records the chosen technique on the last G-buffer. */
nook_result nook_stage_occlude(nook_stage *stage);
/**
 * With ao.accumulate, what an eye that stands sees of it at last, whatever was drawn before; else nothing is done. After nook_stage_occlude,
 * before a picture is measured.
 */
nook_result nook_stage_settle(nook_stage *stage);
/** With ao.accumulate, the next record takes nothing over: before one that is timed, or it might have nothing left to trace. */
void nook_stage_begin_means(nook_stage *stage);
/**
 * Shows the last finished picture in the window and answers its events: for long jobs, between their steps. Nothing when
 * there is no window.
 * @param doing  for the title
 */
void nook_stage_show(nook_stage *stage, const char *doing);
/** Lights the picture. @param occluded  false: as if everything were open @return NOOK_E_DEVICE GL raised an error */
nook_result nook_stage_finish(nook_stage *stage, bool occluded, nook_view view);
