#include "engine/gpu/gl_functions.h"
#include "engine/core/log.h"
#include <stddef.h>

nook_result nook_gl_load(void (*(*get_proc)(const char *name))(void), nook_gl *out_gl)
{
    nook_gl gl = { 0 };
    const char *missing = NULL;
#define NOOK_GL_LOAD(type, name)          \
    gl.name = (type)get_proc("gl" #name); \
    if (!gl.name && !missing)             \
        missing = "gl" #name;
    NOOK_GL_FUNCTIONS(NOOK_GL_LOAD)
#undef NOOK_GL_LOAD
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
