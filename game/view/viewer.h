#pragma once
#include "game/compare/choice.h"
#include "game/stage.h"

/**
 * Shows the stage in its window until it is closed or Esc is pressed. The keys are listed by `compare --help`.
 * Resizes the stage; the AO is set as the views are afterwards.
 * @param choice      the techniques that the number keys choose from: in its order, the exact ones last
 * @param scene_name  for the title
 * @return why it had to stop
 */
nook_result nook_view_run(nook_stage *stage, const nook_camera *camera, const nook_compare_choice *choice,
                          const char *scene_name);
