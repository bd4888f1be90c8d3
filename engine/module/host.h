/**
 * host.h - runs a main module and its parts (module.h), and exchanges their code while they run.
 *
 *   create -> frame, frame, ... -> destroy
 *
 * It starts with the code that is linked into the program. When a folder is given and something was built there
 * (./nook watch does), the libraries that are new take the place of what runs, between two frames. What does not load,
 * was made for another engine, fails or crashes in its first frame is put back: the last good code goes on.
 *
 * The state is kept when the new code lays out all types alike; else the new code's `migrate` makes one of it, if its
 * state_version is another; else it is destroyed by the old code and created by the new one.
 */
#pragma once
#include "engine/module/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A module that is linked into the program, with the folders of its sources: "game/"; NULL after the last. */
typedef struct nook_module_builtin {
    const nook_module *module;
    const char *const *folders;
    const char *const *without; /**< Folders below these that belong to others. NULL: none. */
} nook_module_builtin;

typedef struct nook_module_host_desc {
    const char *folder;               /**< Where libraries are built; NULL: nothing is ever exchanged. */
    nook_module_builtin main;         /**< Outlives the host, as the parts do. */
    const nook_module_builtin *parts; /**< part_count of them. */
    uint32_t part_count;
    nook_module_arguments arguments; /**< For the main module, in nook_module_news. */
} nook_module_host_desc;

enum { NOOK_MODULE_PARTS_MAX = 31 };

typedef struct nook_module_host nook_module_host;

/** @return what the main module's create returned, or NOOK_E_MEMORY; *out_host is NULL then */
nook_result nook_module_host_create(const nook_module_host_desc *desc, nook_module_host **out_host);
/** NULL is allowed. @return what the main module's destroy returned */
nook_result nook_module_host_destroy(nook_module_host *host);

/**
 * Looks for new code, then makes one frame.
 * @return what the main module's frame returned, unless the code was new: that is put back. Or why not even the last good code
 *         could be put back; destroy the host then
 */
nook_result nook_module_host_frame(nook_module_host *host, bool *out_running);
void nook_module_host_stop(nook_module_host *host); /**< Asks the main module to make the next frame the last. */

/** For the screen and for tests. */
typedef struct nook_module_host_view {
    const char *message;   /**< As in nook_module_news. Until the next frame. */
    uint32_t swaps;        /**< Exchanges that lasted longer than their first frame, of one or more modules at once. */
    uint32_t refusals;     /**< Libraries that were refused or put back. */
    uint32_t kept, made;   /**< Exchanges of the main module: state kept or migrated; made anew. */
    double swap_ms;        /**< Of the last exchange: from finding it to the end of its first frame. */
    void *state;           /**< The main module's. */
    const char *main_path; /**< Of the library that the main module was loaded from; "": the program. */
} nook_module_host_view;
nook_module_host_view nook_module_host_look(const nook_module_host *host);

#ifdef __cplusplus
}
#endif
