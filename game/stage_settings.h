/** stage_settings.h - a stage as a file for --settings has it: of commands and games that begin with one technique. */
#pragma once
#include "game/settings/settings_file.h"
#include "game/stage.h"

/**
 * What the file says, else the technique volume as it comes.
 * @param path  NULL or "": there is none
 * @return as nook_settings_file_read; *out untouched then
 */
nook_result nook_stage_settings_read(const char *path, nook_settings_file *out);

/**
 * Chooses technique, reach and falloff, and fills the stage. A reach that is not given is the scene's own.
 * Its volumes.budget is not used: who draws many frames sets nook_stage.stream_params.
 * @param cache  of baked volumes; outlives the stage
 * @return as nook_setting_apply, nook_ao_parse_param and nook_stage_fill; close the stage then
 */
nook_result nook_stage_fill_as_set(nook_stage *stage, const nook_settings_file *settings, const char *cache);
