/* OSMesa: Mesa's software GL drawing into memory. Loaded at run time and never linked: a linked libOSMesa and libGL both
   export gl* symbols, and then the order of linking decides whose context they mean. */
#include "engine/platform/context_internal.h"
#include <GL/glcorearb.h>
#include <GL/osmesa.h>
#include <assert.h>
#include <dlfcn.h>
#include <stdlib.h>

/* The default framebuffer is never drawn to; make-current wants one. */
enum { BUFFER_SIDE = 16 };

typedef struct osmesa_context {
    nook_context base;
    void *library;
    OSMesaContext handle;
    OSMesaContext (*create)(const int *attributes, OSMesaContext share);
    OSMesaContext (*get_current)(void);
    GLboolean (*make_current)(OSMesaContext handle, void *buffer, GLenum type, GLsizei width, GLsizei height);
    void (*release)(OSMesaContext handle);
    uint32_t buffer[BUFFER_SIDE * BUFFER_SIDE];
} osmesa_context;

/* ISO C has no cast from the void * of dlsym to a function; POSIX promises that the bytes are the same. */
static void find(void *library, const char *name, void *out_function)
{
    *(void **)out_function = dlsym(library, name);
}

static void destroy(nook_context *context)
{
    osmesa_context *self = (osmesa_context *)context;
    if (self->handle) {
        if (self->get_current() == self->handle) /* else it is a later one that is current */
            self->make_current(NULL, NULL, 0, 0, 0);
        self->release(self->handle);
    }
    if (self->library)
        dlclose(self->library);
    free(self);
}

static nook_result load(osmesa_context *self, nook_context_reason *out_reason)
{
    /* NODELETE: LLVM registers exit handlers that must still be there when the process ends. */
    self->library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!self->library)
        return nook_context_refuse(out_reason, NOOK_E_DEVICE, "osmesa: %s; install libosmesa6", dlerror());
    find(self->library, "OSMesaCreateContextAttribs", &self->create);
    find(self->library, "OSMesaGetCurrentContext", &self->get_current);
    find(self->library, "OSMesaMakeCurrent", &self->make_current);
    find(self->library, "OSMesaDestroyContext", &self->release);
    find(self->library, "OSMesaGetProcAddress", &self->base.get_proc);
    if (!self->create || !self->get_current || !self->make_current || !self->release || !self->base.get_proc)
        return nook_context_refuse(out_reason, NOOK_E_DEVICE,
                                   "osmesa: libOSMesa.so.8 is older than Mesa 12; install libosmesa6");
    return NOOK_OK;
}

static nook_result start(osmesa_context *self, nook_context_reason *out_reason)
{
    static const int attributes[] = {
        OSMESA_FORMAT,
        GL_RGBA,
        OSMESA_DEPTH_BITS,
        0,
        OSMESA_STENCIL_BITS,
        0,
        OSMESA_PROFILE,
        OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION,
        4,
        OSMESA_CONTEXT_MINOR_VERSION,
        5,
        0,
    };
    assert(self->create && self->make_current); /* load has found them */
    self->handle = self->create(attributes, NULL);
    if (!self->handle)
        return nook_context_refuse(out_reason, NOOK_E_DEVICE,
                                   "osmesa: no OpenGL 4.5 core; install libosmesa6 of Mesa 20 or later");
    if (!self->make_current(self->handle, self->buffer, GL_UNSIGNED_BYTE, BUFFER_SIDE, BUFFER_SIDE))
        return nook_context_refuse(out_reason, NOOK_E_DEVICE, "osmesa: the context cannot be made current");
    return NOOK_OK;
}

nook_result nook_osmesa_create(const nook_context_desc *desc, nook_context_reason *out_reason,
                               nook_context **out_context)
{
    (void)desc; /* neither a size nor a debug context: KHR_debug works here without one */
    osmesa_context *self = calloc(1, sizeof *self);
    if (!self)
        return nook_context_refuse(out_reason, NOOK_E_MEMORY, "osmesa: out of memory");
    self->base.backend = NOOK_BACKEND_OSMESA;
    self->base.destroy = destroy;
    nook_result result = load(self, out_reason);
    if (result == NOOK_OK)
        result = start(self, out_reason);
    if (result != NOOK_OK) {
        destroy(&self->base);
        return result;
    }
    *out_context = &self->base;
    return NOOK_OK;
}
