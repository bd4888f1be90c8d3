#include "engine/core/log.h"
#include "engine/platform/context_internal.h"
#include "engine/platform/renderer.h"
#include <GL/glcorearb.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const backend_names[] = {
    [NOOK_BACKEND_AUTO] = "auto",
    [NOOK_BACKEND_WINDOW] = "window",
    [NOOK_BACKEND_OSMESA] = "osmesa",
    [NOOK_BACKEND_EGL] = "egl",
};

nook_result nook_context_refuse(nook_context_reason *out_reason, nook_result code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out_reason->text, sizeof out_reason->text, format, arguments);
    va_end(arguments);
    return code;
}

bool nook_context_is_software(nook_gl_get_proc get_proc)
{
    PFNGLGETSTRINGPROC get_string = (PFNGLGETSTRINGPROC)get_proc("glGetString");
    return get_string && nook_renderer_is_software((const char *)get_string(GL_RENDERER));
}

static bool has_display(void)
{
    const char *x11 = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");
    return (x11 && *x11) || (wayland && *wayland);
}

/* A real GPU first, then OSMesa, whose results every machine repeats, then whatever software EGL there is. */
static nook_result create_headless(const nook_context_desc *desc, nook_context **out_context)
{
    nook_context_reason hardware = { "" }, osmesa = { "" }, egl = { "" };
    if (nook_egl_create(desc, true, &hardware, out_context) == NOOK_OK)
        return NOOK_OK;
    if (nook_osmesa_create(desc, &osmesa, out_context) == NOOK_OK)
        return NOOK_OK;
    if (nook_egl_create(desc, false, &egl, out_context) == NOOK_OK)
        return NOOK_OK;
    return nook_fail(NOOK_E_DEVICE, "no OpenGL 4.5 context: %s; %s", osmesa.text, egl.text);
}

static nook_result create_auto(const nook_context_desc *desc, nook_context **out_context)
{
    nook_context_reason reason = { "" };
    if (desc->want_window && has_display()) {
        if (nook_window_create(desc, &reason, out_context) == NOOK_OK)
            return NOOK_OK;
        nook_log_warning("%s; going on without a window", reason.text);
    }
    return create_headless(desc, out_context);
}

nook_result nook_context_create(const nook_context_desc *desc, nook_context **out_context)
{
    nook_context_reason reason = { "unknown backend" };
    nook_result result = NOOK_E_ARG;
    *out_context = NULL;
    switch (desc->backend) {
    case NOOK_BACKEND_AUTO:
        return create_auto(desc, out_context);
    case NOOK_BACKEND_WINDOW:
        result = nook_window_create(desc, &reason, out_context);
        break;
    case NOOK_BACKEND_OSMESA:
        result = nook_osmesa_create(desc, &reason, out_context);
        break;
    case NOOK_BACKEND_EGL:
        result = nook_egl_create(desc, false, &reason, out_context);
        break;
    }
    return result == NOOK_OK ? NOOK_OK : nook_fail(result, "%s", reason.text);
}

void nook_context_destroy(nook_context *context)
{
    if (context)
        context->destroy(context);
}

nook_backend nook_context_backend(const nook_context *context)
{
    return context->backend;
}

nook_gl_get_proc nook_context_get_proc(const nook_context *context)
{
    return context->get_proc;
}

void nook_context_poll(nook_context *context, nook_input *out_input)
{
    if (context->poll) {
        context->poll(context, out_input);
    } else {
        memset(out_input, 0, sizeof *out_input);
        out_input->content_scale = 1.0;
    }
}

void nook_context_present(nook_context *context)
{
    if (context->present)
        context->present(context);
}

void nook_context_show(nook_context *context)
{
    if (context->show)
        context->show(context);
}

void nook_context_capture_mouse(nook_context *context, bool captured)
{
    if (context->capture_mouse)
        context->capture_mouse(context, captured);
}

void nook_context_set_fullscreen(nook_context *context, bool fullscreen)
{
    if (context->set_fullscreen)
        context->set_fullscreen(context, fullscreen);
}

void nook_context_set_title(nook_context *context, const char *title)
{
    if (context->set_title)
        context->set_title(context, title);
}

const char *nook_backend_name(nook_backend backend)
{
    return (size_t)backend < NOOK_COUNT(backend_names) ? backend_names[backend] : "unknown";
}

bool nook_backend_parse(const char *name, nook_backend *out_backend)
{
    for (size_t i = 0; i < NOOK_COUNT(backend_names); i++) {
        if (strcmp(name, backend_names[i]) == 0) {
            *out_backend = (nook_backend)i;
            return true;
        }
    }
    return false;
}
