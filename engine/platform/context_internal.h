/**
 * context_internal.h - what the backends give to context.c. Not for use outside engine/platform.
 */
#pragma once
#include "engine/platform/context.h"
#include <stddef.h>

/** Why a backend could not be had, as one line without a newline. The dispatcher logs it only when nobody else can step in. */
typedef struct nook_context_reason {
    char text[512];
} nook_context_reason;

/** First member of every backend's own struct. */
struct nook_context {
    nook_backend backend;
    nook_gl_get_proc get_proc;
    void (*destroy)(nook_context *context);
    void (*poll)(nook_context *context, nook_input *out_input);     /**< NULL: no input, zeros. */
    void (*present)(nook_context *context);                         /**< NULL: nothing to show. */
    void (*show)(nook_context *context);                            /**< NULL: no window. */
    void (*set_title)(nook_context *context, const char *title);    /**< NULL: no window. */
    void (*capture_mouse)(nook_context *context, bool captured);    /**< NULL: no window. */
    void (*set_fullscreen)(nook_context *context, bool fullscreen); /**< NULL: no window. */
};

/** Each makes its context current. On failure: NOOK_E_DEVICE or NOOK_E_MEMORY, the reason, nothing logged, no output. */
nook_result nook_osmesa_create(const nook_context_desc *desc, nook_context_reason *out_reason,
                               nook_context **out_context);
nook_result nook_window_create(const nook_context_desc *desc, nook_context_reason *out_reason,
                               nook_context **out_context);
/** @param hardware_only refuse software GL, so that the caller can choose among software backends itself */
nook_result nook_egl_create(const nook_context_desc *desc, bool hardware_only, nook_context_reason *out_reason,
                            nook_context **out_context);

/** Fills in the reason, printf-style, and gives `code` back. */
nook_result nook_context_refuse(nook_context_reason *out_reason, nook_result code, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/** True when the context that is current draws on the CPU (llvmpipe and its kind), by GL_RENDERER. */
bool nook_context_is_software(nook_gl_get_proc get_proc);
