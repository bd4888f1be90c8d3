/**
 * option_rows.h - rows of the tables of options that several commands share: one name, one range and one reader each. The help is
 * the command's own where what it says differs.
 */
#pragma once
#include "engine/platform/context.h"
#include "game/command.h"

enum { NOOK_OPTION_PATH_MAX = 4096 };

/** A row of a command's own: --name N, a whole number in [lowest, highest]. */
nook_option nook_option_row_int(const char *name, int32_t *target, int32_t lowest, int32_t highest, const char *help);
/** The same: --name. */
nook_option nook_option_row_flag(const char *name, bool *target, const char *help);

/** The same: --name PLACEHOLDER, any text. */
nook_option nook_option_row_text(const char *name, const char **target, const char *placeholder, const char *help);

/** --cpu, of a bench. */
nook_option nook_option_row_cpu(bool *target);
/** --from SECONDS, into what is played; up to a day. */
nook_option nook_option_row_from(double *target, const char *help);
/** --backend NAME. */
nook_option nook_option_row_backend(nook_backend *target);
/** --size WxH, in pixels. */
nook_option nook_option_row_size(nook_option_size *target, const char *help);
/** --r-max M, in metres, within the range of ao.r_max. */
nook_option nook_option_row_r_max(double *target, const char *help);
/** The help of --r-max where it says how far occlusion is computed, not what is baked. */
extern const char nook_option_r_max_help[];
/** --falloff NAME; the name is not looked at yet. */
nook_option nook_option_row_falloff(const char **target);
/** --techniques a,b,c; the names are not looked at yet. */
nook_option nook_option_row_techniques(const char **target, const char *help);
/** --settings FILE. */
nook_option nook_option_row_settings(const char **target, const char *help);
/** --reference-rays N, at least `lowest` of them. */
nook_option nook_option_row_reference_rays(int32_t *target, int32_t lowest, const char *help);
/** --resolution N: voxels along the longest side of a body. */
nook_option nook_option_row_resolution(int32_t *target, const char *help);
/** --cache DIR. */
nook_option nook_option_row_cache(const char **target, const char *help);
/** --out FILE of what is printed as a table: "also write everything as JSON". */
nook_option nook_option_row_json_file(const char **target);
/** --json. */
nook_option nook_option_row_json(bool *target, const char *help);

/** The scene of a command that is given none: the demo level. @return out */
const char *nook_option_default_scene(const nook_app *app, char out[NOOK_OPTION_PATH_MAX]);
/** The folder of a command that is given no --cache. @return out */
const char *nook_option_default_cache(const nook_app *app, char out[NOOK_OPTION_PATH_MAX]);
