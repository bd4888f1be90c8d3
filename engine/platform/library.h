#pragma once
#include "engine/core/result.h"
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A shared library of code in memory. */
typedef struct nook_library nook_library;

/** What a symbol of a library leads to; cast it to its own type before the call. */
typedef void (*nook_library_function)(void);

/** Why a library could not be had, as one line without a newline. Nothing is logged here: who tries says what it means. */
typedef struct nook_library_reason {
    char text[512];
} nook_library_reason;

/**
 * Loads a shared library: every symbol that it lacks must be in the program or in what the program was linked with. A path
 * that is loaded already gives the code that is loaded: for new code take a new path, and a new file, never one written in place.
 * @param path  of a file; without a '/' it is one in the current folder
 * @return NOOK_E_NOT_FOUND no such file; NOOK_E_FORMAT no library for this machine, or a symbol is missing (the reason names it);
 *         NOOK_E_MEMORY; *out_library is NULL then
 */
nook_result nook_library_open(const char *path, nook_library_reason *out_reason, nook_library **out_library);
/** Unloads it: nothing may point into its code or its constants any more. NULL is allowed. */
void nook_library_close(nook_library *library);

/** @return the function of that name that it exports, or NULL */
nook_library_function nook_library_find(const nook_library *library, const char *symbol);
/** Whether an address, as a crash tells it (engine/module/guard.h), lies in it. */
int nook_library_holds(const nook_library *library, const void *address);

#ifdef __cplusplus
}
#endif
