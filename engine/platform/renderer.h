/**
 * renderer.h - what GL_RENDERER tells. Only inline functions: nothing to link.
 */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/** True for GL that draws on the CPU: llvmpipe and its kind, on every backend. @param renderer GL_RENDERER or NULL */
static inline bool nook_renderer_is_software(const char *renderer)
{
    static const char *const names[] = { "llvmpipe", "softpipe", "swrast", "SWR", "Software" };
    for (size_t i = 0; renderer && i < sizeof names / sizeof names[0]; i++)
        if (strstr(renderer, names[i]))
            return true;
    return false;
}
