#include "engine/core/file.h"
#include "game/commands/commands.h"
#include "game/tune/tune_report.h"
#include "game/tune/tune_run.h"

static nook_result tune(nook_stage *stage, const nook_tune_options *options, bool *out_holds)
{
    nook_tune_result result;
    nook_result done = nook_tune_run(stage, options, &result);
    if (done == NOOK_OK && result.holds)
        done = nook_tune_report_write(&result, options, stage);
    if (done != NOOK_OK)
        return done;
    *out_holds = result.holds;
    if (options->json)
        return nook_tune_report_print_json(&result, options, stage, stdout);
    nook_tune_report_print(&result, options, stdout);
    return NOOK_OK;
}

int nook_command_tune(const nook_app *app, int argc, char **argv)
{
    nook_tune_options options;
    int exit_code;
    bool holds = false;
    if (!nook_tune_options_read(app, argc, argv, &options, &exit_code))
        return exit_code;
    const nook_stage_desc desc = { .root = app->root,
                                   .scene_path = options.scene,
                                   .backend = options.backend,
                                   .width = (uint32_t)options.size.width,
                                   .height = (uint32_t)options.size.height };
    nook_stage stage = { 0 };
    nook_result result = nook_file_probe(options.out);
    if (result == NOOK_OK)
        result = nook_stage_open(&desc, &stage);
    if (result == NOOK_OK)
        result = tune(&stage, &options, &holds);
    nook_stage_close(&stage);
    return result == NOOK_OK && holds ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
