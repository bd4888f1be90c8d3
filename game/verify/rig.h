/** rig.h - where techniques meet fixtures: a receiver seen head-on, for those that are told the geometry, and a picture. */
#pragma once
#include "game/settings/setting.h"
#include "game/verify/scene.h"
#include "modules/fixture/receiver.h"

enum { NOOK_VERIFY_RECEIVER_SIDE = 4 }; /**< Pixels. */

/** What a setting makes of the receiver. */
typedef struct nook_verify_reading {
    nook_fixture_occlusion occlusion;     /**< Over the pixels. */
    double pixels[NOOK_VERIFY_LOOKED_AT]; /**< A of each, row by row from the bottom. */
    uint64_t outside;                     /**< Visibilities of the whole image that were not in [0, 1]. */
} nook_verify_reading;

/** Two views with every technique of the program. */
typedef struct nook_verify_rig {
    nook_fixture_view *receiver; /**< 4 x 4 pixels that see one point: one tile of rays. */
    nook_fixture_view *picture;  /**< Square; the receiver in its middle. */
} nook_verify_rig;

/** @param gpu  outlives the rig @return why not; *out_rig is zero then */
nook_result nook_verify_rig_open(nook_gpu *gpu, nook_verify_rig *out_rig);
void nook_verify_rig_close(nook_verify_rig *rig);

/** Adds the objects as occluders of the receiver, with volumes when the setting's technique reads them, in place of others. */
nook_result nook_verify_rig_set(nook_verify_rig *rig, const nook_verify_scene *scene, bool with_volumes);
/** A of the setting at the receiver, which all pixels see. */
nook_result nook_verify_rig_measure(nook_verify_rig *rig, const nook_verify_scene *scene, const nook_setting *setting,
                                    nook_verify_reading *out_reading);

/** Draws ground and objects as the camera sees them. */
nook_result nook_verify_rig_draw(nook_verify_rig *rig, const nook_verify_scene *scene,
                                 const nook_verify_camera *camera);
/** A of the setting over the 4 x 4 pixels around the receiver in the picture that was drawn. */
nook_result nook_verify_rig_look(nook_verify_rig *rig, const nook_verify_scene *scene, const nook_setting *setting,
                                 nook_verify_reading *out_reading);
