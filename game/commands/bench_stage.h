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

/** What a bench does with its stage. */
typedef nook_result (*nook_bench_stage_work)(void *user, nook_stage *stage, const nook_settings_file *settings);
/** Opens the stage, lets `work` have it, and closes it. @param root, quick  as nook_bench_stage_open @return a NOOK_EXIT_* code */
int nook_bench_stage_run(const nook_bench_stage_options *options, const char *root, bool quick,
                         nook_bench_stage_work work, void *user);

/** A line: scene, size, renderer, r_max, setting. */
void nook_bench_stage_print(const nook_bench_stage_options *options, const nook_stage *stage,
                            const nook_settings_file *settings);

enum { NOOK_BENCH_CAMERA_NAME_SIZE = 128 };

/** Cameras of the scene; 1 where it has none. */
uint32_t nook_bench_stage_camera_count(const nook_stage *stage);
/** One of them; of a scene without any the one that nook_camera_choose finds. @return as that */
nook_result nook_bench_stage_camera(const nook_stage *stage, uint32_t index, nook_camera *out_camera,
                                    char out_name[NOOK_BENCH_CAMERA_NAME_SIZE]);
