/**
 * module_image_internal.h - a module as it was linked into the program or loaded from a library. Not for use outside engine/module.
 */
#pragma once
#include "engine/module/interface.h"
#include "engine/module/live_folder_internal.h"
#include "engine/module/module.h"
#include "engine/platform/library.h"

/** Zeroed: none. */
typedef struct nook_module_image {
    const nook_module *module;
    nook_library *library;         /**< Owned; NULL: linked into the program. */
    nook_interface *interface;     /**< Owned, of the library; NULL: the program's. */
    char path[NOOK_LIVE_PATH_MAX]; /**< Of the copy that was loaded. */
    nook_file_mark file;           /**< What it is a copy of. */
} nook_module_image;

/** Why something was refused: for the log and the screen, one line. */
typedef struct nook_module_reason {
    char text[640];
    const void *address; /**< Where it crashed; NULL: it did not, or nobody knows. */
} nook_module_reason;

/** Fills in the reason, printf-style, and gives `code` back. */
nook_result nook_module_refuse(nook_module_reason *out_reason, nook_result code, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/**
 * Copies and loads the library of a module, after comparing it with what the program's engine knows.
 * @param engine  types and functions that must be the same
 * @return NOOK_E_VERSION made for other headers or another version of module.h, or without debug information; NOOK_E_FORMAT no library,
 *         or a symbol is missing, its own entry for example; NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_MEMORY. *out_image is zero then
 */
nook_result nook_module_image_load(nook_live_folder *folder, const char *name, const nook_interface_view *engine,
                                   nook_module_reason *out_reason, nook_module_image *out_image);
/** Unloads it and removes the copy. Zeroed and linked ones are allowed; becomes zero. */
void nook_module_image_close(nook_module_image *image);
