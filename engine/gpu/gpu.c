#include "engine/core/log.h"
#include "engine/gpu/gpu_internal.h"
#include "engine/platform/renderer.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static void on_debug_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                             const GLchar *message, const void *user)
{
    (void)source, (void)id, (void)length, (void)user;
    nook_log_at(__FILE__, __LINE__,
                type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH ? NOOK_LOG_ERROR : NOOK_LOG_WARNING,
                "opengl: %s", message);
}

/* Errors and high severity only. What shader compilers say is left to program.c, which knows files and lines. */
static void listen_to_driver(const nook_gl *gl)
{
    gl->Enable(GL_DEBUG_OUTPUT);
    gl->DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_FALSE);
    gl->DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_HIGH, 0, NULL, GL_TRUE);
    gl->DebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, NULL, GL_TRUE);
    gl->DebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_FALSE);
    gl->DebugMessageCallback(on_debug_message, NULL);
}

static bool has_extension(const nook_gl *gl, const char *name)
{
    GLint count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++)
        if (strcmp((const char *)gl->GetStringi(GL_EXTENSIONS, (GLuint)i), name) == 0)
            return true;
    return false;
}

static void read_limits(nook_gpu *gpu)
{
    const nook_gl *gl = gpu->gl;
    GLint side = 0, side_3d = 0, texels = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    gl->GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &side_3d);
    gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    gpu->max_texture_size = (uint32_t)side;
    gpu->max_texture_3d_size = (uint32_t)side_3d;
    gpu->max_texture_buffer_size = (uint32_t)texels;
    gpu->renderer = (const char *)gl->GetString(GL_RENDERER);
    gpu->version = (const char *)gl->GetString(GL_VERSION);
    gpu->software = nook_renderer_is_software(gpu->renderer);
    gpu->skips_srgb_decode = has_extension(gl, "GL_EXT_texture_sRGB_decode");
    gpu->cache->max_anisotropy = 1;
    if (has_extension(gl, "GL_EXT_texture_filter_anisotropic") ||
        has_extension(gl, "GL_ARB_texture_filter_anisotropic"))
        gl->GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &gpu->cache->max_anisotropy);
}

/* The parts that own memory; on failure nothing is left. */
static nook_gpu *allocate(const char *source_root)
{
    nook_gpu *gpu = calloc(1, sizeof *gpu);
    struct nook_gpu_cache *cache = calloc(1, sizeof *cache);
    size_t size = strlen(source_root) + 1;
    char *root = malloc(size);
    if (!gpu || !cache || !root) {
        free(root);
        free(cache);
        free(gpu);
        return NULL;
    }
    memcpy(root, source_root, size);
    cache->source_root = root;
    gpu->cache = cache;
    gpu->gl = &cache->gl;
    return gpu;
}

static void release(nook_gpu *gpu)
{
    free(gpu->cache->source_root);
    free(gpu->cache);
    free(gpu);
}

nook_result nook_gpu_create(const nook_gpu_desc *desc, nook_gpu **out_gpu)
{
    *out_gpu = NULL;
    nook_gpu *gpu = allocate(desc->source_root);
    if (!gpu)
        return nook_fail(NOOK_E_MEMORY, "gpu: out of memory");
    nook_result result = nook_gl_load(desc->get_proc, &gpu->cache->gl);
    if (result != NOOK_OK) {
        release(gpu);
        return result;
    }
    read_limits(gpu);
    gpu->cache->listens = desc->log_debug_output;
    if (gpu->cache->listens)
        listen_to_driver(gpu->gl);
    *out_gpu = gpu;
    return NOOK_OK;
}

void nook_gpu_destroy(nook_gpu *gpu)
{
    if (!gpu)
        return;
    nook_program_cache_free(gpu);
    if (gpu->cache->listens)
        gpu->gl->DebugMessageCallback(NULL, NULL);
    release(gpu);
}

const char *nook_gpu_source_root(const nook_gpu *gpu)
{
    return gpu->cache->source_root;
}

static const char *error_name(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown GL error";
    }
}

uint32_t nook_gpu_take_errors(nook_gpu *gpu, const char *where)
{
    GLenum last = GL_NO_ERROR;
    /* A lost context raises its error for ever; eight different ones is more than GL can hold. */
    for (int i = 0; i < 8; i++) {
        GLenum error = gpu->gl->GetError();
        if (error == GL_NO_ERROR)
            break;
        nook_log_at(__FILE__, __LINE__, NOOK_LOG_ERROR, "opengl: %s in %s", error_name(error), where);
        gpu->cache->error_pending = true;
        last = error;
    }
    return last;
}

bool nook_gpu_check(nook_gpu *gpu, const char *where)
{
    nook_gpu_take_errors(gpu, where);
    bool pending = gpu->cache->error_pending;
    gpu->cache->error_pending = false;
    return pending;
}

void nook_gpu_finish(nook_gpu *gpu)
{
    gpu->gl->Finish();
}

static void show_writes(nook_gpu *gpu)
{
    gpu->gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                           GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                           GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

/* GL promises that a dispatch sees what was drawn before it. Under llvmpipe a part of the picture was without occlusion in 3 of 14 first
   frames, and after a barrier, for which it waits until nothing is drawn any more, in none of 20. */
static void wait_for_draws(nook_gpu *gpu)
{
    if (gpu->software)
        gpu->gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void nook_dispatch(nook_gpu *gpu, nook_program program, uint32_t x, uint32_t y, uint32_t z)
{
    wait_for_draws(gpu);
    nook_program_use(gpu, program);
    gpu->gl->DispatchCompute(x, y, z);
    show_writes(gpu);
}

void nook_dispatch_indirect(nook_gpu *gpu, nook_program program, nook_buffer groups)
{
    assert(groups.size >= 3 * sizeof(GLuint));
    wait_for_draws(gpu);
    nook_program_use(gpu, program);
    gpu->gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups.id);
    gpu->gl->DispatchComputeIndirect(0);
    gpu->gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    show_writes(gpu);
}
