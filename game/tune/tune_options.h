#pragma once
#include "game/option_rows.h"
#include "game/tune/goal.h"
#include "game/tune/space.h"

/** The command line of `tune`. Texts point into argv or into this struct. */
typedef struct nook_tune_options {
    const char *scene;
    nook_tune_goal goal;
    nook_option_size size;  /**< That ms are taken at. */
    double r_max;           /**< Metres; 0: a tenth of the diagonal of the scene's box. */
    const char *falloff;    /**< For ao.falloff; NULL: as in modules/ao/params.def. */
    const char *techniques; /**< "a,b,c"; NULL: all but the exact one. */
    const char *out;        /**< The settings file. */
    int32_t cameras;        /**< To choose by; 0: as many as the scene needs. */
    int32_t tries;          /**< Settings at most. */
    int32_t reference_rays; /**< Of the truth, at most. */
    nook_backend backend;
    const char *cache;
    bool json;
    nook_tune_space space; /**< Of the techniques. */
    char default_scene[NOOK_OPTION_PATH_MAX], default_cache[NOOK_OPTION_PATH_MAX], default_out[NOOK_OPTION_PATH_MAX];
} nook_tune_options;

/** nook_arguments_read for this command, with all that can be checked without the scene. @return false: return *out_exit_code */
bool nook_tune_options_read(const nook_app *app, int argc, char **argv, nook_tune_options *out, int *out_exit_code);
