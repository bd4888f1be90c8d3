/**
 * shader_reload.h - shaders that are saved while the program runs are seen in its next frame; those that are wrong say why, and
 * what ran goes on.
 */
#pragma once
#include "engine/gpu/gpu.h"

typedef struct nook_shader_reload nook_shader_reload;

typedef struct nook_shader_status {
    const char *error;  /**< Why shaders do not build as they are on disk: lines with file and line; "" when all do. */
    uint32_t failed;    /**< Programs of which that is said. */
    uint32_t reloads;   /**< Programs replaced since the start. */
    uint32_t failures;  /**< Saves since the start after which some program did not build. */
    double last_ms;     /**< From the last change, on disk, until its programs were replaced; 0: none yet. */
    double building_ms; /**< Of that, what the driver took. */
} nook_shader_status;

/**
 * Watches shaders/ under the device's source root, and the params.def files under modules/, which shaders include.
 * @param gpu borrowed: destroy this before it
 * @return NOOK_E_NOT_FOUND there are no shaders there; NOOK_E_IO, NOOK_E_MEMORY; *out_reload is NULL then
 */
nook_result nook_shader_reload_create(nook_gpu *gpu, nook_shader_reload **out_reload);
void nook_shader_reload_destroy(nook_shader_reload *reload); /**< NULL is allowed. */

/**
 * Once a frame, before anything of it is drawn: reloads what was saved since the last call.
 * Costs microseconds when nothing was, and the rest of NOOK_FILE_WATCH_SETTLE_MS when something was just now.
 * @return true: draw again, programs were replaced or `error` is another one
 */
bool nook_shader_reload_poll(nook_shader_reload *reload);

/** As of the last poll; valid until the next. */
const nook_shader_status *nook_shader_reload_status(const nook_shader_reload *reload);
