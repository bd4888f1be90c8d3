#pragma once
#include "game/compare/views.h"
#include "game/moment.h"
#include "game/option_rows.h"
#include "game/settings/settings_file.h"

/** The command line of `compare`, read but not yet held against the scene. Texts point into argv or into this struct. */
typedef struct nook_compare_options {
    const char *scene;
    const char *camera; /**< Name or seven numbers; NULL: chosen (game/compare/camera.h). */
    nook_moment moment; /**< The pose of what moves. */
    nook_option_size size;
    double r_max;            /**< Metres; 0: a tenth of the diagonal of the scene's box. */
    const char *settings;    /**< A settings file; NULL: none. What other options say counts more. */
    const char *falloff;     /**< For ao.falloff; NULL: as in modules/ao/params.def. */
    const char *techniques;  /**< "a,b,c"; NULL: all. */
    const char *ao_scale;    /**< For ao.scale, one of its choices; NULL: as in modules/ao/params.def. */
    int32_t plan;            /**< nook_plan_params.mode; -1: as `settings` says, else off. */
    int32_t volumes;         /**< 0 baked, 1 live; -1: as `settings` says, else baked. */
    nook_option_list params; /**< "technique.name=value" */
    int32_t reference_rays;  /**< 0: the reference's own default. */
    int32_t frames;          /**< Timed ones of each technique; 0: as many as a few seconds allow. */
    nook_view_list views;    /**< To write beside the comparison. */
    const char *out;
    nook_backend backend;
    int32_t resolution; /**< Voxels along a body's longest side; 0: the baker's own default. */
    const char *cache;
    bool no_instability; /**< No second view: about half the work. */
    bool no_window;
    bool list_params;        /**< Do nothing but print them (game/compare/param_list.h). */
    bool json;               /**< compare.json on standard output instead of the table. */
    nook_settings_file file; /**< What `settings` holds: nook_compare_options_settle. */
    char default_scene[NOOK_OPTION_PATH_MAX], default_cache[NOOK_OPTION_PATH_MAX];
} nook_compare_options;

/** nook_arguments_read for this command. @return false: return *out_exit_code from the command */
bool nook_compare_options_read(const nook_app *app, int argc, char **argv, nook_compare_options *out,
                               int *out_exit_code);
