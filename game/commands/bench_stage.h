/** bench_stage.h - what benches share that draw a scene: their options, and the stage that these ask for. */
#pragma once
#include "game/command.h"
#include "game/option_rows.h"
#include "game/stage_settings.h"

typedef struct nook_bench_stage_options {
    const char *scene, *settings, *cache;
    nook_option_size size;
    nook_backend backend;
    bool plays; /**< nook_stage_desc.plays; yours to set before it is opened. */
    char default_scene[NOOK_OPTION_PATH_MAX], default_cache[NOOK_OPTION_PATH_MAX];
} nook_bench_stage_options;

enum { NOOK_BENCH_OPTIONS_MAX = 12 };

/**
 * Reads [SCENE], --size, --settings, --backend and --cache, and a bench's own.
 * @param usage  with its own options, at most 8; its positionals are not looked at
 * @param out    must stay where it is: the defaults point into it
 * @return as nook_arguments_read
 */
bool nook_bench_stage_read(const nook_app *app, const nook_usage *usage, int argc, char **argv,
                           nook_bench_stage_options *out, int *out_exit_code);

/**
 * Opens the stage, filled as the settings say.
 * @param root          the folder that holds shaders/
 * @param quick         nook_stage.quick
 * @param out_settings  what was read; NULL is allowed
 * @return why not; there is nothing to close then
 */
nook_result nook_bench_stage_open(const nook_bench_stage_options *options, const char *root, bool quick,
                                  nook_stage *out_stage, nook_settings_file *out_settings);
