#pragma once
#include <stdint.h>

/**
 * Names a component or resource type. A misspelt type does not compile; a module built against an older struct, that is
 * another size or alignment under the same name, is refused with NOOK_E_VERSION.
 */
typedef struct nook_type {
    const char *name; /**< Copied when registered. NULL ends a list of types. */
    uint32_t size;    /**< Bytes, [1, NOOK_TYPE_SIZE_MAX]. */
    uint32_t align;   /**< Bytes, a power of two up to NOOK_COLUMN_ALIGN. */
} nook_type;

enum {
    NOOK_TYPE_SIZE_MAX = 65536, /**< Larger data belong behind a handle. */
    NOOK_COLUMN_ALIGN = 64      /**< A cache line; every component column starts at a multiple of it. */
};

#ifdef __cplusplus
#define NOOK_TYPE(T)                                  \
    {                                                 \
#T, (uint32_t)sizeof(T), (uint32_t)alignof(T) \
    }
#else
#define NOOK_TYPE(T)                                    \
    {                                                   \
#T, (uint32_t)sizeof(T), (uint32_t) _Alignof(T) \
    }
/** The same as a pointer, for arguments. */
#define NOOK_TYPE_OF(T) (&(const nook_type)NOOK_TYPE(T))
#endif
