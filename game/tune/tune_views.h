/**
 * tune_views.h - the views of a scene that settings are measured in: those to choose by, and as many others to prove the choice in.
 */
#pragma once
#include "game/stage.h"
#include "game/tune/search.h"

struct nook_site;

typedef struct nook_tune_views_desc {
    const char *cache;  /**< Of volumes and truths; NULL: none. */
    double r_max;       /**< Metres; set in the AO already, as the falloff is. */
    double noise;       /**< The truth is traced until its own noise (RMS) is at most this ... */
    uint32_t rays_max;  /**< ... or until it has taken this many rays a pixel. */
    uint32_t views_max; /**< Of each of the two sets; NOOK_TUNE_VIEWS_MAX. */
} nook_tune_views_desc;

typedef enum nook_tune_set { NOOK_TUNE_CHOOSE, NOOK_TUNE_PROVE, NOOK_TUNE_SETS } nook_tune_set;

/** Sites are opened when a view is first looked at: tracing its truth is slow. */
typedef struct nook_tune_views {
    nook_stage *stage;
    nook_tune_views_desc desc;
    nook_camera cameras[NOOK_TUNE_SETS][NOOK_TUNE_VIEWS_MAX];
    struct nook_site *sites[NOOK_TUNE_SETS][NOOK_TUNE_VIEWS_MAX];
    uint32_t resolution; /**< That the stage is filled with; 0: the default. */
} nook_tune_views;

/**
 * Chooses the cameras: views of game/cameras/sample.h, split so that both sets see the scene alike (tune_pairs.h).
 * @param stage  filled with the default resolution; outlives the views
 * @return as nook_cameras_sample; *out is zero then
 */
nook_result nook_tune_views_open(nook_stage *stage, const nook_tune_views_desc *desc, nook_tune_views *out);
void nook_tune_views_close(nook_tune_views *views); /**< Zeroed ones are allowed. */

/**
 * Measures a setting in one view; fills the stage with other volumes first when the setting needs them.
 * @param timed  all rounds at once; false: ms becomes NaN
 * @return NOOK_E_DEVICE also for a picture that is not numbers in [0, 1]
 */
nook_result nook_tune_views_measure(nook_tune_views *views, const nook_setting *setting, nook_tune_set set,
                                    uint32_t view, bool timed, nook_tune_view *out);

/**
 * Times a setting in the first views of a set, in turns: one round of all of them after another (game/measure/site_time.h), so that what
 * the machine does for a second does not fall on one view. All of them were measured before.
 * @param out_views  `count` of them: ms and ms_spread are put there
 */
nook_result nook_tune_views_time(nook_tune_views *views, const nook_setting *setting, nook_tune_set set, uint32_t count,
                                 nook_tune_view *out_views);
