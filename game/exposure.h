#pragma once
#include "game/stage.h"

/**
 * Opens up for scenes that bring no lights of their own and lie in the dark under the default ones, as rooms do: sets
 * stage->lights.exposure so that what the camera sees without occlusion is not too dim to judge. Never darkens.
 * @return NOOK_E_MEMORY, or why a frame could not be drawn
 */
nook_result nook_stage_expose(nook_stage *stage, const nook_camera *camera);
