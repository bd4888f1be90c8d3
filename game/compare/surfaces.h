#pragma once
#include "engine/render/renderer.h"
#include "modules/measure/instability.h"

struct nook_stage;

/** What a camera sees of a scene, read back from the G-buffer. */
typedef struct nook_surfaces {
    float *distances; /**< Metres along the view axis, 0 where nothing is. Owned. */
    float *normals;   /**< Three a pixel: unit, world, of the geometry. Owned. */
    nook_seen seen;   /**< Borrows both. */
} nook_surfaces;

/**
 * Draws the G-buffer of a camera, which then is the stage's frame, and reads it back.
 * @return NOOK_E_MEMORY, or why drawing failed; *out_surfaces is zero then
 */
nook_result nook_surfaces_draw(struct nook_stage *stage, const nook_camera *camera, nook_surfaces *out_surfaces);
void nook_surfaces_free(nook_surfaces *surfaces); /**< Zeroed ones are allowed; becomes zero. */

/** What of the stage's frame is geometry: one byte a pixel, not 0 where something was drawn.
 * @param out_geometry  owned by the caller, release with free(); also when nothing is seen
 * @return NOOK_E_MEMORY; NOOK_E_NOT_FOUND the camera sees nothing */
nook_result nook_geometry_read(struct nook_stage *stage, uint8_t **out_geometry);
