/** findings.h - what commands share that hold the program to rows of checks (verify, extremes): a device, and the rows as JSON. */
#pragma once
#include "engine/core/json.h"
#include "engine/gpu/gpu.h"
#include "engine/platform/context.h"
#include "game/command.h"

/** Runs the checks. @param out_hold  false to begin with: whether all of them hold */
typedef nook_result (*nook_findings_run)(void *user, nook_gpu *gpu, bool *out_hold);

/**
 * Opens the device, runs, closes it.
 * @param file  that will be written at the end: where that cannot be, nothing is run; NULL: none
 * @return NOOK_EXIT_OK only when the run came to its end and all checks hold
 */
int nook_findings_with_device(const nook_app *app, nook_backend backend, const char *file, nook_findings_run run,
                              void *user);

/** Ends the JSON, writes it to `file` unless that is NULL, prints it to standard output if `print` in any case, and frees it. */
nook_result nook_findings_put_json(nook_json *json, const char *file, bool print);
