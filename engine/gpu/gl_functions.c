#include "engine/gpu/gl_functions.h"
#include "engine/core/log.h"
#include <stddef.h>
#include <string.h>

/* A table and a loop: written out, the hundreds of calls took the compiler 20 seconds. */
static const struct {
    const char *name;
    size_t offset; /* into nook_gl */
} functions[] = {
#define NOOK_GL_ROW(type, name) { "gl" #name, offsetof(nook_gl, name) },
    NOOK_GL_FUNCTIONS(NOOK_GL_ROW)
#undef NOOK_GL_ROW
};

nook_result nook_gl_load(void (*(*get_proc)(const char *name))(void), nook_gl *out_gl)
{
    nook_gl gl = { 0 };
    const char *missing = NULL;
    for (size_t i = 0; i < NOOK_COUNT(functions); i++) {
        void (*address)(void) = get_proc(functions[i].name);
        if (!address && !missing)
            missing = functions[i].name;
        memcpy((char *)&gl + functions[i].offset, &address, sizeof address); /* all pointers to functions are alike */
    }
    const GLubyte *version = gl.GetString ? gl.GetString(GL_VERSION) : NULL;
    if (!version)
        return nook_fail(NOOK_E_DEVICE, "opengl: no context is current on this thread; create one first");
    GLint major = 0, minor = 0;
    if (gl.GetIntegerv) {
        gl.GetIntegerv(GL_MAJOR_VERSION, &major);
        gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    }
    if (major < 4 || (major == 4 && minor < 5))
        return nook_fail(NOOK_E_DEVICE,
                         "opengl: version 4.5 core is needed, this driver gives '%s'; try --backend osmesa",
                         (const char *)version);
    if (missing)
        return nook_fail(NOOK_E_DEVICE, "opengl: '%s' has no %s; try --backend osmesa", (const char *)version, missing);
    *out_gl = gl;
    return NOOK_OK;
}
