#pragma once
#include "game/option_rows.h"
#include "game/settings/settings_file.h"

/** The command line of `measure`. Texts point into argv or into this struct. */
typedef struct nook_measure_options {
    const char
        *scenes[NOOK_POSITIONAL_MAX]; /**< scene_count of them; none: the demo level, unless there is a folder. */
    int scene_count;
    const char *scene_folder; /**< Every scene in it and in its own folders; NULL: none. */
    int32_t suite;            /**< 0 quick, 1 full. */
    const char *sweep;        /**< A file in the place of a suite's. */
    nook_option_list params;  /**< For nook_sweep_param. */
    const char *settings;     /**< A settings file, measured beside the sweep; NULL: none. */
    const char *out;
    nook_option_list merge; /**< Folders whose rows are taken in. */
    bool keep;              /**< Rows of other builds count. */
    bool tables;            /**< Nothing is measured. */
    const char *document;   /**< That the tables go into; NULL: none. */
    const char *cache;
    nook_backend backend;
    nook_settings_file file; /**< What `settings` holds: for the command to read. */
    char default_cache[NOOK_OPTION_PATH_MAX], suite_path[NOOK_OPTION_PATH_MAX];
    char default_scene[NOOK_OPTION_PATH_MAX];
} nook_measure_options;

/** nook_arguments_read for this command. @return false: return *out_exit_code from the command */
bool nook_measure_options_read(const nook_app *app, int argc, char **argv, nook_measure_options *out,
                               int *out_exit_code);
