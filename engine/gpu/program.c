#include "engine/core/log.h"
#include "engine/gpu/gpu_internal.h"
#include "engine/gpu/shader_source.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_CAPACITY = 16384, LINE_CAPACITY = 1280 };

typedef struct stage {
    GLenum type;
    const char *path;
} stage;

/* One log line for each line of the driver's. */
static void report(const char *path, const nook_shader_source *source, const char *log)
{
    bool said = false;
    for (const char *line = log; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        char text[LINE_CAPACITY];
        if (length > 0 && source)
            nook_shader_source_translate(source, line, length, text, sizeof text);
        else
            snprintf(text, sizeof text, "%s: %.*s", path, (int)(length < 1024 ? length : 1024), line);
        if (length > 0)
            nook_log_at(__FILE__, __LINE__, NOOK_LOG_ERROR, "%s", text);
        said = said || length > 0;
        line += length + (line[length] == '\n');
    }
    if (!said)
        nook_log_at(__FILE__, __LINE__, NOOK_LOG_ERROR, "%s: the driver refuses it and does not say why", path);
}

static nook_result compile(nook_gpu *gpu, stage wanted, const char *defines, GLuint *out_shader)
{
    const nook_gl *gl = gpu->gl;
    nook_shader_source source = { 0 };
    nook_result result = nook_shader_source_read(gpu->cache->source_root, wanted.path, defines, &source);
    if (result != NOOK_OK)
        return result;
    GLuint shader = gl->CreateShader(wanted.type);
    const GLchar *text = source.text;
    GLint compiled = GL_FALSE;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) {
        *out_shader = shader;
    } else {
        char log[LOG_CAPACITY] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        report(wanted.path, &source, log);
        gl->DeleteShader(shader);
        result = NOOK_E_DEVICE;
    }
    nook_shader_source_free(&source);
    return result;
}

/* Takes the shaders over: they are gone afterwards in any case. */
static nook_result link(nook_gpu *gpu, const char *path, const GLuint *shaders, size_t shader_count,
                        GLuint *out_program)
{
    const nook_gl *gl = gpu->gl;
    GLuint program = gl->CreateProgram();
    GLint linked = GL_FALSE;
    for (size_t i = 0; i < shader_count; i++)
        gl->AttachShader(program, shaders[i]);
    gl->LinkProgram(program);
    for (size_t i = 0; i < shader_count; i++) {
        gl->DetachShader(program, shaders[i]);
        gl->DeleteShader(shaders[i]);
    }
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[LOG_CAPACITY] = "";
        gl->GetProgramInfoLog(program, sizeof log, NULL, log);
        report(path, NULL, log);
        gl->DeleteProgram(program);
        return NOOK_E_DEVICE;
    }
    *out_program = program;
    return NOOK_OK;
}

static nook_result build(nook_gpu *gpu, const stage *stages, size_t stage_count, const char *defines,
                         GLuint *out_program)
{
    GLuint shaders[2] = { 0, 0 };
    for (size_t i = 0; i < stage_count; i++) {
        nook_result result = compile(gpu, stages[i], defines, &shaders[i]);
        if (result != NOOK_OK) {
            for (size_t k = 0; k < i; k++)
                gpu->gl->DeleteShader(shaders[k]);
            return result;
        }
    }
    return link(gpu, stages[stage_count - 1].path, shaders, stage_count, out_program);
}

/* What makes two requests the same. A newline cannot be part of a path that a shader is found by. Owned by the caller. */
static char *make_identity(const stage *stages, size_t stage_count, const char *defines)
{
    const char *second = stage_count > 1 ? stages[1].path : "";
    size_t size = strlen(stages[0].path) + strlen(second) + strlen(defines) + 3;
    char *identity = malloc(size);
    if (identity)
        snprintf(identity, size, "%s\n%s\n%s", stages[0].path, second, defines);
    return identity;
}

static bool reserve_entry(struct nook_gpu_cache *cache)
{
    if (cache->program_count < cache->program_capacity)
        return true;
    size_t capacity = cache->program_capacity ? cache->program_capacity * 2 : 16;
    nook_program_entry *programs = realloc(cache->programs, capacity * sizeof *programs);
    if (!programs)
        return false;
    cache->programs = programs;
    cache->program_capacity = capacity;
    return true;
}

static nook_result find_or_build(nook_gpu *gpu, const stage *stages, size_t stage_count, const char *defines,
                                 nook_program *out_program)
{
    struct nook_gpu_cache *cache = gpu->cache;
    GLuint id = 0;
    char *identity = make_identity(stages, stage_count, defines);
    if (!identity || !reserve_entry(cache)) {
        free(identity);
        return nook_fail(NOOK_E_MEMORY, "%s: out of memory", stages[0].path);
    }
    for (size_t i = 0; i < cache->program_count; i++)
        if (strcmp(cache->programs[i].identity, identity) == 0)
            id = cache->programs[i].id;
    if (id != 0) {
        free(identity);
        out_program->id = id;
        return NOOK_OK;
    }
    nook_result result = build(gpu, stages, stage_count, defines, &id);
    if (result != NOOK_OK) {
        free(identity);
        return result;
    }
    cache->programs[cache->program_count++] = (nook_program_entry){ identity, id };
    out_program->id = id;
    return NOOK_OK;
}

nook_result nook_program_compute(nook_gpu *gpu, const char *path, const char *defines, nook_program *out_program)
{
    const stage stages[] = { { GL_COMPUTE_SHADER, path } };
    return find_or_build(gpu, stages, NOOK_COUNT(stages), defines, out_program);
}

nook_result nook_program_raster(nook_gpu *gpu, const char *vertex_path, const char *fragment_path, const char *defines,
                                nook_program *out_program)
{
    const stage stages[] = { { GL_VERTEX_SHADER, vertex_path }, { GL_FRAGMENT_SHADER, fragment_path } };
    return find_or_build(gpu, stages, NOOK_COUNT(stages), defines, out_program);
}

void nook_program_cache_free(nook_gpu *gpu)
{
    struct nook_gpu_cache *cache = gpu->cache;
    for (size_t i = 0; i < cache->program_count; i++) {
        gpu->gl->DeleteProgram(cache->programs[i].id);
        free(cache->programs[i].identity);
    }
    free(cache->programs);
}
