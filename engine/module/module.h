/**
 * module.h - what a piece of code that can be exchanged while the program runs gives to its host (host.h).
 *
 * A module is constant data and code. Its state is the host's memory, which outlives the code:
 *
 *   create -> frame, frame, ... -> suspend (old code) -> resume (new code) -> frame, ... -> destroy
 *
 * The same descriptor is linked into the program (the built-in module) and exported by the shared library of the module's
 * name, so that one program does both. There is one main module, which owns the state and makes the frames, and any number
 * of parts, which lend it code: the main module finds them in nook_module_news and asks each for the interface of a kind.
 *
 * What must hold: no mutable file-scope variables in a module (a library has its own, new ones). Whatever in the state
 * points into a module, the main one's own or a part's, is renewed in `resume`: functions, constant tables, texts between
 * quotes. Both the old and the new code are loaded at that time; afterwards the old one is gone.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_MODULE_VERSION 1u

typedef struct nook_module nook_module;

/** A part as it is now. */
typedef struct nook_module_part {
    const nook_module *module;
    bool other_layout; /**< In resume: a type of its state is laid out otherwise than in the code before. Else false. */
} nook_module_part;

/** What the program was called with. */
typedef struct nook_module_arguments {
    const char *root; /**< The folder that holds shaders/. */
    int argc;
    char **argv; /**< argv[0] is the command's name. */
    void *user;  /**< For tests. */
} nook_module_arguments;

/** What the host tells the main module. Valid during the call. */
typedef struct nook_module_news {
    const nook_module_arguments *arguments;
    const nook_module_part *parts; /**< part_count of them, in the order of nook_module_host_desc. */
    uint32_t part_count;
    const char *message; /**< For the screen: what is wrong with the code that was to be loaded; "": nothing. */
    uint32_t swaps;      /**< Of code, so far. */
    bool stop_asked;     /**< By nook_module_host_stop: this frame is to be the last. */
} nook_module_news;

/** Functions of a part may all be NULL; of a main module those that may are marked. */
struct nook_module {
    uint32_t version; /**< NOOK_MODULE_VERSION, else it is refused with NOOK_E_VERSION. */
    const char *name; /**< [a-z0-9_]+; the shared library is <name>.so. */

    const char *kind;      /**< Of `interface`, "ao.technique"; NULL: it lends nothing. */
    const void *interface; /**< What a part lends: its meaning is between the part and the main module. */

    size_t state_size;      /**< Bytes; zeroed before create and before migrate. */
    uint32_t state_version; /**< Raise it with a change of the state that `migrate` knows how to take over. */

    /** On failure nothing is left to destroy. */
    nook_result (*create)(void *state, const nook_module_news *news);
    /** @return what it could not write; destroyed it is in any case */
    nook_result (*destroy)(void *state);
    /** One frame. A failure ends the program, but in the first frame of new code: then the old one comes back. */
    nook_result (*frame)(void *state, const nook_module_news *news, bool *out_running);
    /** Before any code is exchanged: stop threads and call-backs that run code of a module. Twice is allowed. May be NULL. */
    void (*suspend)(void *state);
    /**
     * After code was exchanged, the module's own or a part's: renew what points into it, start again what suspend stopped.
     * May be called without a suspend before it, after a crash. On failure the old code's resume follows. May be NULL.
     */
    nook_result (*resume)(void *state, const nook_module_news *news);
    /**
     * Makes the new state from one of another version, that was suspended; resume follows. `old` stays as it is, and stays
     * good: it comes back when the new code fails in its first frame. On failure, or without this function, the old code
     * destroys the old state and the new code creates one. May be NULL.
     */
    nook_result (*migrate)(const void *old, uint32_t old_version, size_t old_size, void *new_state);
};

/** The symbol that a shared library exports, and its type. */
#define NOOK_MODULE_ENTRY "nook_module_entry"
typedef const nook_module *(*nook_module_entry_function)(void);

#if defined(__GNUC__)
#define NOOK_MODULE_EXPORT __attribute__((visibility("default")))
#else
#define NOOK_MODULE_EXPORT
#endif

#ifdef __cplusplus
}
#endif
