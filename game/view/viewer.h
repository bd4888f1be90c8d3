#pragma once
#include "game/stage.h"
#include "modules/ao/technique.h"

/**
 * Shows the stage in its window until it is closed or Esc is pressed. The keys are listed by `compare --help`.
 * Resizes the stage; leaves the AO parameters as they were.
 * @param scene_name  for the title
 * @return why it had to stop
 */
nook_result nook_view_run(nook_stage *stage, const nook_camera *camera, const char *scene_name);
