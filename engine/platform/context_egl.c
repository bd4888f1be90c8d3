/* EGL without a window: on the devices that the driver lists (a GPU server; NVIDIA needs no X here), else on Mesa's
   surfaceless platform. Loaded at run time, so that a machine without EGL runs the other backends. */
#include "engine/platform/context_internal.h"
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#ifndef EGL_PLATFORM_SURFACELESS_MESA
#define EGL_PLATFORM_SURFACELESS_MESA 0x31DD
#endif

enum { DEVICE_CAPACITY = 32 };

typedef struct egl_functions {
    nook_gl_get_proc get_proc;
    const char *(*query_string)(EGLDisplay display, EGLint name);
    EGLBoolean (*initialize)(EGLDisplay display, EGLint *major, EGLint *minor);
    EGLBoolean (*bind_api)(EGLenum api);
    EGLBoolean (*choose_config)(EGLDisplay display, const EGLint *wanted, EGLConfig *configs, EGLint capacity,
                                EGLint *count);
    EGLContext (*create_context)(EGLDisplay display, EGLConfig config, EGLContext share, const EGLint *attributes);
    EGLBoolean (*destroy_context)(EGLDisplay display, EGLContext context);
    EGLContext (*get_current_context)(void);
    EGLBoolean (*make_current)(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context);
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display;
    PFNEGLQUERYDEVICESEXTPROC query_devices;            /**< NULL: devices cannot be listed. */
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string; /**< NULL with query_devices. */
} egl_functions;

typedef struct egl_context {
    nook_context base;
    void *library;
    egl_functions egl;
    EGLDisplay display;
    EGLContext handle;
    bool debug;
    bool surfaceless; /**< EGL_MESA_platform_surfaceless is there. */
} egl_context;

static void find(void *library, const char *name, void *out_function)
{
    *(void **)out_function = dlsym(library, name);
}

/* A whole word of an extension string: one name may be the start of another. */
static bool has_extension(const char *extensions, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = extensions; at && (at = strstr(at, name)) != NULL; at += length)
        if ((at == extensions || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return true;
    return false;
}

static void drop_context(egl_context *self)
{
    if (self->handle == EGL_NO_CONTEXT)
        return;
    if (self->egl.get_current_context() == self->handle) /* else it is a later one that is current */
        self->egl.make_current(self->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    self->egl.destroy_context(self->display, self->handle);
    self->handle = EGL_NO_CONTEXT;
}

/* The display is not terminated: EGL gives one display per device to the whole process, and another context may use it. */
static void destroy(nook_context *context)
{
    egl_context *self = (egl_context *)context;
    drop_context(self);
    if (self->library)
        dlclose(self->library);
    free(self);
}

static bool load_functions(void *library, egl_functions *egl)
{
    find(library, "eglGetProcAddress", &egl->get_proc);
    find(library, "eglQueryString", &egl->query_string);
    find(library, "eglInitialize", &egl->initialize);
    find(library, "eglBindAPI", &egl->bind_api);
    find(library, "eglChooseConfig", &egl->choose_config);
    find(library, "eglCreateContext", &egl->create_context);
    find(library, "eglDestroyContext", &egl->destroy_context);
    find(library, "eglGetCurrentContext", &egl->get_current_context);
    find(library, "eglMakeCurrent", &egl->make_current);
    return egl->get_proc && egl->query_string && egl->initialize && egl->bind_api && egl->choose_config &&
           egl->create_context && egl->destroy_context && egl->get_current_context && egl->make_current;
}

static nook_result load(egl_context *self, nook_context_reason *out_reason)
{
    egl_functions *egl = &self->egl;
    /* NODELETE: drivers register exit handlers that must still be there when the process ends. */
    self->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!self->library)
        return nook_context_refuse(out_reason, NOOK_E_DEVICE, "egl: %s; install libegl1 or use --backend osmesa",
                                   dlerror());
    if (!load_functions(self->library, egl))
        return nook_context_refuse(out_reason, NOOK_E_DEVICE,
                                   "egl: libEGL.so.1 is older than EGL 1.4; use --backend osmesa");
    self->base.get_proc = egl->get_proc;

    const char *extensions = egl->query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_EXT_platform_base"))
        return nook_context_refuse(
            out_reason, NOOK_E_DEVICE,
            "egl: no driver behind libEGL.so.1 can do without a window; install libegl-mesa0 or the GPU's "
            "own driver, or use --backend osmesa");
    egl->get_platform_display = (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl->get_proc("eglGetPlatformDisplayEXT");
    self->surfaceless = has_extension(extensions, "EGL_MESA_platform_surfaceless");
    if (has_extension(extensions, "EGL_EXT_platform_device") &&
        (has_extension(extensions, "EGL_EXT_device_base") || (has_extension(extensions, "EGL_EXT_device_enumeration") &&
                                                              has_extension(extensions, "EGL_EXT_device_query")))) {
        egl->query_devices = (PFNEGLQUERYDEVICESEXTPROC)egl->get_proc("eglQueryDevicesEXT");
        egl->query_device_string = (PFNEGLQUERYDEVICESTRINGEXTPROC)egl->get_proc("eglQueryDeviceStringEXT");
    }
    return NOOK_OK;
}

static EGLContext create_handle(egl_context *self, EGLDisplay display)
{
    const egl_functions *egl = &self->egl;
    static const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE };
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,
        4,
        EGL_CONTEXT_MINOR_VERSION,
        5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_CONTEXT_OPENGL_DEBUG,
        self->debug ? EGL_TRUE : EGL_FALSE,
        EGL_NONE,
    };
    EGLConfig config = NULL; /* EGL_NO_CONFIG_KHR where the driver has no configuration to give */
    EGLint count = 0;
    if (!egl->choose_config(display, wanted, &config, 1, &count) || count == 0)
        config = NULL;
    return egl->create_context(display, config, EGL_NO_CONTEXT, attributes);
}

/* Makes a context current on this display. A context that is refused leaves nothing behind. */
static bool try_display(egl_context *self, EGLDisplay display, bool hardware_only)
{
    const egl_functions *egl = &self->egl;
    EGLint major = 0, minor = 0;
    if (display == EGL_NO_DISPLAY || !egl->initialize(display, &major, &minor) || !egl->bind_api(EGL_OPENGL_API))
        return false;
    self->display = display;
    self->handle = create_handle(self, display);
    if (self->handle == EGL_NO_CONTEXT)
        return false;
    if (egl->make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, self->handle) &&
        !(hardware_only && nook_context_is_software(egl->get_proc)))
        return true;
    drop_context(self);
    return false;
}

static bool try_devices(egl_context *self, bool hardware_only)
{
    const egl_functions *egl = &self->egl;
    EGLDeviceEXT devices[DEVICE_CAPACITY];
    EGLint count = 0;
    if (!egl->query_devices || !egl->query_devices(DEVICE_CAPACITY, devices, &count))
        return false;
    for (EGLint i = 0; i < count; i++) {
        /* Known to be software without the 100 ms that a context costs. */
        if (hardware_only &&
            has_extension(egl->query_device_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software"))
            continue;
        if (try_display(self, egl->get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL), hardware_only))
            return true;
    }
    return false;
}

static bool try_surfaceless(egl_context *self, bool hardware_only)
{
    return self->surfaceless &&
           try_display(self, self->egl.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL),
                       hardware_only);
}

/* Every real GPU that surfaceless could find is among the devices, when those can be listed. */
static bool start(egl_context *self, bool hardware_only)
{
    if (try_devices(self, true) || (!self->egl.query_devices && try_surfaceless(self, true)))
        return true;
    return !hardware_only && (try_surfaceless(self, false) || try_devices(self, false));
}

nook_result nook_egl_create(const nook_context_desc *desc, bool hardware_only, nook_context_reason *out_reason,
                            nook_context **out_context)
{
    egl_context *self = calloc(1, sizeof *self);
    if (!self)
        return nook_context_refuse(out_reason, NOOK_E_MEMORY, "egl: out of memory");
    self->base.backend = NOOK_BACKEND_EGL;
    self->base.destroy = destroy;
    self->display = EGL_NO_DISPLAY;
    self->handle = EGL_NO_CONTEXT;
    self->debug = desc->debug;
    nook_result result = load(self, out_reason);
    if (result == NOOK_OK && !start(self, hardware_only))
        result = nook_context_refuse(out_reason, NOOK_E_DEVICE,
                                     "egl: no device or surfaceless display gives %sOpenGL 4.5 core; use --backend "
                                     "osmesa",
                                     hardware_only ? "a hardware " : "");
    if (result != NOOK_OK) {
        destroy(&self->base);
        return result;
    }
    *out_context = &self->base;
    return NOOK_OK;
}
