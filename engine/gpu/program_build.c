#include "engine/core/log.h"
#include "engine/gpu/program_build_internal.h"
#include "engine/gpu/program_layout_internal.h"
#include "engine/gpu/shader_source.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_CAPACITY = 16384, LINE_CAPACITY = 1280 };

bool nook_program_add_line(char *lines, size_t capacity, const char *line, size_t length)
{
    size_t used = strlen(lines);
    for (const char *at = lines; *at != '\0'; at += strcspn(at, "\n") + 1)
        if (strcspn(at, "\n") == length && memcmp(at, line, length) == 0)
            return false;
    if (used + length + 2 <= capacity) {
        memcpy(lines + used, line, length);
        memcpy(lines + used + length, "\n", 2);
    }
    return true;
}

static nook_result say(program_build *build, nook_result result, const char *line)
{
    nook_program_add_line(build->trouble, sizeof build->trouble, line, strlen(line));
    return result;
}

static bool is_warning(const char *line, size_t length)
{
    static const char *const words[] = { "warning", "WARNING" };
    for (size_t i = 0; i < NOOK_COUNT(words); i++) {
        const char *found = strstr(line, words[i]);
        if (found && (size_t)(found - line) < length)
            return true;
    }
    return false;
}

/* Lines of the driver's that are warnings, or those that are not, with the names of files. @return false: there are none */
static bool say_lines(program_build *build, const char *path, const nook_shader_source *source, const char *log,
                      bool warnings)
{
    bool said = false;
    for (const char *line = log; *line != '\0';) {
        char text[LINE_CAPACITY];
        size_t length = strcspn(line, "\n");
        if (length > 0 && is_warning(line, length) == warnings) {
            if (source)
                nook_shader_source_translate(source, line, length, text, sizeof text);
            else
                snprintf(text, sizeof text, "%s: %.*s", path, (int)(length < 1024 ? length : 1024), line);
            say(build, NOOK_E_DEVICE, text);
            said = true;
        }
        line += length + (line[length] == '\n');
    }
    return said;
}

/* What the driver says, what is wrong before what is odd. @param source NULL: it cannot know lines, as when it links */
static void say_driver(program_build *build, const char *path, const nook_shader_source *source, const char *log)
{
    char text[LINE_CAPACITY];
    bool said = say_lines(build, path, source, log, false);
    said = say_lines(build, path, source, log, true) || said;
    snprintf(text, sizeof text, "%s: the driver refuses it and does not say why", path);
    if (!said)
        say(build, NOOK_E_DEVICE, text);
}

static bool has_file(const program_build *build, const char *path)
{
    for (uint32_t i = 0; i < build->file_count; i++)
        if (strcmp(build->files[i], path) == 0)
            return true;
    return false;
}

/* Takes the paths out of a source: those of one more stage. @return false without memory */
static bool take_files(program_build *build, nook_shader_source *source)
{
    char **files = realloc(build->files, (build->file_count + source->file_count) * sizeof(char *));
    if (!files)
        return false;
    build->files = files;
    for (uint32_t i = 1; i < source->file_count; i++) { /* 0 is the defines */
        if (has_file(build, source->files[i].path))
            continue;
        build->files[build->file_count++] = source->files[i].path;
        source->files[i].path = NULL;
    }
    return true;
}

static nook_result compile(const nook_gl *gl, GLenum type, const char *path, const nook_shader_source *source,
                           program_build *build, GLuint *out_shader)
{
    GLuint shader = gl->CreateShader(type);
    const GLchar *text = source->text;
    GLint compiled = GL_FALSE;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) {
        *out_shader = shader;
        return NOOK_OK;
    }
    char log[LOG_CAPACITY] = "";
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    say_driver(build, path, source, log);
    gl->DeleteShader(shader);
    return NOOK_E_DEVICE;
}

static nook_result read_and_compile(nook_gpu *gpu, const program_entry *wanted, size_t stage, program_build *build,
                                    GLuint *out_shader)
{
    const GLenum types[] = { wanted->paths[1] ? GL_VERTEX_SHADER : GL_COMPUTE_SHADER, GL_FRAGMENT_SHADER };
    nook_shader_source source = { 0 };
    char why[LINE_CAPACITY] = "";
    const char *path = wanted->paths[stage];
    nook_result result =
        nook_shader_source_read(gpu->cache->source_root, path, wanted->defines, &source, why, sizeof why);
    if (result != NOOK_OK)
        return say(build, result, why);
    result = compile(gpu->gl, types[stage], path, &source, build, out_shader);
    if (!take_files(build, &source) && result == NOOK_OK) {
        gpu->gl->DeleteShader(*out_shader);
        *out_shader = 0;
        result = say(build, NOOK_E_MEMORY, "shaders: out of memory");
    }
    nook_shader_source_free(&source);
    return result;
}

/* Takes the shaders over: they are gone afterwards in any case. */
static nook_result link(const nook_gl *gl, const char *path, const GLuint *shaders, size_t shader_count,
                        program_build *build)
{
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
    if (linked) {
        build->id = program;
        return NOOK_OK;
    }
    char log[LOG_CAPACITY] = "";
    gl->GetProgramInfoLog(program, sizeof log, NULL, log);
    say_driver(build, path, NULL, log);
    gl->DeleteProgram(program);
    return NOOK_E_DEVICE;
}

/* Whether C code can work with the linked program. */
static nook_result check(const nook_gpu *gpu, const program_entry *wanted, program_build *build)
{
    char why[LINE_CAPACITY], line[LINE_CAPACITY + 512];
    const char *path = wanted->paths[wanted->paths[1] ? 1 : 0];
    build->layout = nook_program_layout_read(gpu->gl, build->id, !wanted->paths[1], &build->locations);
    if (!build->layout)
        return say(build, NOOK_E_MEMORY, "shaders: out of memory");
    if (nook_program_layout_fits(gpu, build->files, build->file_count, build->layout, wanted->layout, why, sizeof why))
        return NOOK_OK;
    snprintf(line, sizeof line, "%s: %s", path, why);
    return say(build, NOOK_E_VERSION, line);
}

void nook_program_build(nook_gpu *gpu, const program_entry *wanted, program_build *out_build)
{
    GLuint shaders[PROGRAM_STAGES_MAX] = { 0, 0 };
    size_t stage_count = wanted->paths[1] ? 2 : 1;
    nook_result result = NOOK_OK;
    *out_build = (program_build){ .id = 0 };
    for (size_t i = 0; i < stage_count && result == NOOK_OK; i++)
        result = read_and_compile(gpu, wanted, i, out_build, &shaders[i]);
    if (result == NOOK_OK) {
        result = link(gpu->gl, wanted->paths[stage_count - 1], shaders, stage_count, out_build);
    } else {
        for (size_t i = 0; i < stage_count; i++)
            gpu->gl->DeleteShader(shaders[i]); /* GL takes 0 for nothing */
    }
    if (result == NOOK_OK)
        result = check(gpu, wanted, out_build);
    if (result != NOOK_OK && out_build->id != 0) {
        gpu->gl->DeleteProgram(out_build->id);
        out_build->id = 0;
    }
    out_build->result = result;
}

void nook_program_build_free(nook_gpu *gpu, program_build *build)
{
    if (build->id != 0)
        gpu->gl->DeleteProgram(build->id);
    for (uint32_t i = 0; i < build->file_count; i++)
        free(build->files[i]);
    free(build->files);
    free(build->layout);
    *build = (program_build){ .id = 0 };
}
