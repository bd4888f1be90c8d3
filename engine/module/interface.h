/**
 * interface.h - how a program or library lays out its types and what its functions take, as its debug information tells: so that
 * code that does not fit together is refused, by name, before it runs.
 *
 * Two layouts are the same when size, members, their places, types and order are, through structs that stand in them; what a
 * pointer leads to counts by its name alone. Functions are the same when what they return and take is. A name may stand for
 * several types, in files that do not know of each other.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_interface nook_interface;

/**
 * Reads a program or library that was built with -g.
 * @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_MEMORY, NOOK_E_FORMAT; NOOK_E_VERSION there is no debug information; NULL then
 */
nook_result nook_interface_read(const char *path, nook_interface **out_interface);
void nook_interface_free(nook_interface *interface); /**< NULL is allowed. */

/** What the source files below some folders know of. */
typedef struct nook_interface_view {
    const nook_interface *interface;
    const char *const *folders; /**< "engine/", ...; NULL after the last. NULL: all. */
    const char *const *without; /**< The same, and these not. NULL: none. */
} nook_interface_view;

typedef enum nook_interface_scope {
    NOOK_INTERFACE_PUBLIC_TYPES = 1, /**< Structs, unions and enums whose name starts with nook_. */
    NOOK_INTERFACE_ALL_TYPES = 2,
    NOOK_INTERFACE_FUNCTIONS = 4 /**< Those that other files may call, whose name starts with nook_. */
} nook_interface_scope;

/**
 * Compares what both know by name.
 * @param scope  NOOK_INTERFACE_*, joined
 * @return a name that stands for something in `later` that it does not stand for in `earlier`; NULL: they fit together
 */
const char *nook_interface_difference(const nook_interface_view *earlier, const nook_interface_view *later,
                                      unsigned scope);

#ifdef __cplusplus
}
#endif
