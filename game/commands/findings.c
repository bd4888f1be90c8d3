#include "game/commands/findings.h"
#include "engine/core/file.h"
#include <stdio.h>

int nook_findings_with_device(const nook_app *app, nook_backend backend, const char *file, nook_findings_run run,
                              void *user)
{
    bool hold = false;
    nook_context *context;
    nook_gpu *gpu = NULL;
    const nook_context_desc desc = { .backend = backend };
    if (file && nook_file_probe(file) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    if (nook_context_create(&desc, &context) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    const nook_gpu_desc gpu_desc = { nook_context_get_proc(context), app->root, .log_debug_output = true };
    nook_result result = nook_gpu_create(&gpu_desc, &gpu);
    if (result == NOOK_OK)
        result = run(user, gpu, &hold);
    nook_gpu_destroy(gpu);
    nook_context_destroy(context);
    return result == NOOK_OK && hold ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}

nook_result nook_findings_put_json(nook_json *json, const char *file, bool print)
{
    const char *text;
    size_t size;
    nook_result result = nook_json_finish(json, &text, &size);
    bool whole = result == NOOK_OK;
    if (whole && file)
        result = nook_file_write(file, text, size);
    if (whole && print) { /* whatever became of the file */
        nook_result printed = nook_json_print(json, stdout);
        result = result == NOOK_OK ? printed : result;
    }
    nook_json_free(json);
    return result;
}
