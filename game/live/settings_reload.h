/**
 * settings_reload.h - a settings file that is saved while the program runs is used from the next frame on. One that is wrong is said,
 * and what was set stays.
 */
#pragma once
#include "game/settings/settings_file.h"

typedef struct nook_settings_reload nook_settings_reload;

/**
 * Watches the file's folder. @param path  of a settings file, which may come later; copied
 * @return NOOK_E_NOT_FOUND its folder is missing; NOOK_E_IO, NOOK_E_MEMORY; *out_reload is NULL then
 */
nook_result nook_settings_reload_create(const char *path, nook_settings_reload **out_reload);
void nook_settings_reload_destroy(nook_settings_reload *reload); /**< NULL is allowed. */

/** The next poll reads the file as if it had just been saved. */
void nook_settings_reload_ask(nook_settings_reload *reload);
/** Once a frame. @param out  what the file says now; untouched otherwise @return true: it was saved and can be read */
bool nook_settings_reload_poll(nook_settings_reload *reload, nook_settings_file *out);
/** For the screen: what is wrong with the file as it was saved last, with its line; "" while it can be read. */
const char *nook_settings_reload_error(const nook_settings_reload *reload);
