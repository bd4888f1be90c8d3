#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/gpu/program_build_internal.h"
#include "engine/gpu/program_layout_internal.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- entries ------------------------------------------------------------------------------------------------------- */

static void free_files(program_entry *entry)
{
    for (uint32_t i = 0; i < entry->file_count; i++)
        free(entry->files[i]);
    free(entry->files);
}

static void free_entry(nook_gpu *gpu, program_entry *entry)
{
    if (entry->id != 0)
        gpu->gl->DeleteProgram(entry->id);
    free_files(entry);
    free(entry->paths[0]);
    free(entry->paths[1]);
    free(entry->defines);
    free(entry->layout);
    free(entry->trouble);
}

static program_entry *find_entry(struct nook_gpu_cache *cache, const char *const paths[2], const char *defines)
{
    for (size_t i = 0; i < cache->program_count; i++) {
        program_entry *entry = &cache->programs[i];
        bool one_stage = !paths[1] && !entry->paths[1], two_stages = paths[1] && entry->paths[1];
        if (strcmp(entry->paths[0], paths[0]) == 0 && strcmp(entry->defines, defines) == 0 &&
            (one_stage || (two_stages && strcmp(entry->paths[1], paths[1]) == 0)))
            return entry;
    }
    return NULL;
}

static bool reserve_entry(struct nook_gpu_cache *cache)
{
    if (cache->program_count < cache->program_capacity)
        return true;
    size_t capacity = cache->program_capacity ? cache->program_capacity * 2 : 16;
    program_entry *programs = realloc(cache->programs, capacity * sizeof *programs);
    if (!programs)
        return false;
    cache->programs = programs;
    cache->program_capacity = capacity;
    return true;
}

/* An entry that nothing has been built for yet; NULL without memory. */
static program_entry *add_entry(nook_gpu *gpu, const char *const paths[2], const char *defines)
{
    struct nook_gpu_cache *cache = gpu->cache;
    program_entry entry = { .paths = { strdup(paths[0]), paths[1] ? strdup(paths[1]) : NULL },
                            .defines = strdup(defines) };
    if (!entry.paths[0] || (paths[1] && !entry.paths[1]) || !entry.defines || !reserve_entry(cache)) {
        free_entry(gpu, &entry);
        return NULL;
    }
    cache->programs[cache->program_count] = entry;
    return &cache->programs[cache->program_count++];
}

/* ---- building ------------------------------------------------------------------------------------------------------ */

/* Logs lines that `logged` does not hold yet, and adds them to it. */
static void log_lines(const char *lines, char *logged, size_t capacity)
{
    for (const char *line = lines; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        if (nook_program_add_line(logged, capacity, line, length))
            nook_log_at(__FILE__, __LINE__, NOOK_LOG_ERROR, "%.*s", (int)length, line);
        line += length + (line[length] == '\n');
    }
}

/* The entry has the new program from here on; the old one is gone. */
static void take(nook_gpu *gpu, program_entry *entry, program_build *build)
{
    char *layout = nook_program_layout_join(build->layout, entry->layout);
    if (layout) { /* without memory the layout of before still tells what matters */
        free(entry->layout);
        entry->layout = layout;
    }
    gpu->cache->replaced += entry->id != 0;
    if (entry->id != 0)
        gpu->gl->DeleteProgram(entry->id);
    free_files(entry);
    free(entry->trouble);
    entry->id = build->id;
    entry->version++;
    entry->locations = build->locations;
    entry->files = build->files;
    entry->file_count = build->file_count;
    entry->trouble = NULL;
    build->id = 0;
    build->files = NULL;
    build->file_count = 0;
}

/* Builds what the entry asks for, and lets it have that when it is good. What is wrong is logged unless it was before. */
static nook_result build_entry(nook_gpu *gpu, program_entry *entry, char *logged, size_t capacity)
{
    program_build build;
    nook_program_build(gpu, entry, &build);
    nook_result result = entry->result = build.result;
    if (result == NOOK_OK) {
        take(gpu, entry, &build);
    } else if (!entry->trouble || strcmp(entry->trouble, build.trouble) != 0) {
        log_lines(build.trouble, logged, capacity);
        free(entry->trouble);
        entry->trouble = strdup(build.trouble);
    }
    nook_program_build_free(gpu, &build);
    return result;
}

static nook_result find_or_build(nook_gpu *gpu, const char *const paths[2], const char *defines,
                                 nook_program *out_program)
{
    program_entry *entry = find_entry(gpu->cache, paths, defines);
    if (!entry) {
        char logged[PROGRAM_TROUBLE_CAPACITY] = "";
        entry = add_entry(gpu, paths, defines);
        if (!entry)
            return nook_fail(NOOK_E_MEMORY, "%s: out of memory", paths[0]);
        build_entry(gpu, entry, logged, sizeof logged);
    }
    if (entry->id == 0)
        return entry->result;
    out_program->handle = (uint32_t)(entry - gpu->cache->programs) + 1;
    return NOOK_OK;
}

nook_result nook_program_compute(nook_gpu *gpu, const char *path, const char *defines, nook_program *out_program)
{
    return find_or_build(gpu, (const char *const[]){ path, NULL }, defines, out_program);
}

nook_result nook_program_raster(nook_gpu *gpu, const char *vertex_path, const char *fragment_path, const char *defines,
                                nook_program *out_program)
{
    return find_or_build(gpu, (const char *const[]){ vertex_path, fragment_path }, defines, out_program);
}

void nook_program_cache_free(nook_gpu *gpu)
{
    struct nook_gpu_cache *cache = gpu->cache;
    for (size_t i = 0; i < cache->program_count; i++)
        free_entry(gpu, &cache->programs[i]);
    for (size_t i = 0; i < cache->rows_count; i++) {
        free(cache->rows[i].path);
        free(cache->rows[i].rows);
    }
    free(cache->programs);
    free(cache->rows);
}

/* ---- reloading ----------------------------------------------------------------------------------------------------- */

/* Whether one of the paths is a file that the program is made of, or a folder that one lies in. */
static bool uses(const program_entry *entry, const char *const *paths, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        size_t length = strlen(paths[i]);
        for (uint32_t k = 0; k < entry->file_count; k++)
            if (strncmp(entry->files[k], paths[i], length) == 0 &&
                (entry->files[k][length] == '\0' || entry->files[k][length] == '/'))
                return true;
    }
    return false;
}

void nook_gpu_reload_shaders(nook_gpu *gpu, const char *const *changed, size_t count, nook_shader_report *out_report)
{
    struct nook_gpu_cache *cache = gpu->cache;
    char logged[PROGRAM_TROUBLE_CAPACITY] = "";
    uint32_t reloaded = 0;
    double start = nook_clock_ms();
    for (size_t i = 0; i < cache->program_count; i++) {
        program_entry *entry = &cache->programs[i];
        /* What failed may want a file that it did not get as far as naming. */
        if (!changed || (entry->trouble && count > 0) || uses(entry, changed, count))
            reloaded += build_entry(gpu, entry, logged, sizeof logged) == NOOK_OK;
    }
    nook_gpu_shader_report(gpu, out_report);
    out_report->reloaded = reloaded;
    out_report->ms = nook_clock_ms() - start;
}

void nook_gpu_shader_report(const nook_gpu *gpu, nook_shader_report *out_report)
{
    *out_report = (nook_shader_report){ .reloaded = 0 };
    for (size_t i = 0; i < gpu->cache->program_count; i++) {
        const char *line = gpu->cache->programs[i].trouble;
        out_report->failed += line != NULL;
        for (; line && *line != '\0'; line += strcspn(line, "\n") + 1)
            nook_program_add_line(out_report->text, sizeof out_report->text, line, strcspn(line, "\n"));
    }
}

/* ---- use ----------------------------------------------------------------------------------------------------------- */

static const program_entry *entry_of(const nook_gpu *gpu, nook_program program)
{
    assert(program.handle >= 1 && program.handle <= gpu->cache->program_count);
    return &gpu->cache->programs[program.handle - 1];
}

uint32_t nook_program_native(const nook_gpu *gpu, nook_program program)
{
    return entry_of(gpu, program)->id;
}

uint32_t nook_program_version(const nook_gpu *gpu, nook_program program)
{
    return entry_of(gpu, program)->version;
}

uint32_t nook_gpu_replaced_programs(const nook_gpu *gpu)
{
    return gpu->cache->replaced;
}

void nook_program_use(nook_gpu *gpu, nook_program program)
{
    gpu->gl->UseProgram(entry_of(gpu, program)->id);
    gpu->cache->program_used = program.handle - 1;
}

/* GL's name of the program in use, or 0 when it has no such uniform: the shader was changed so that it does not need it. */
static GLuint program_with(const nook_gpu *gpu, uint32_t location)
{
    assert(location < PROGRAM_LOCATIONS && gpu->cache->program_used < gpu->cache->program_count);
    const program_entry *entry = &gpu->cache->programs[gpu->cache->program_used];
    return entry->locations & 1u << location ? entry->id : 0;
}

void nook_uniform_int(nook_gpu *gpu, uint32_t location, const int32_t *values, uint32_t count)
{
    const nook_gl *gl = gpu->gl;
    const PFNGLPROGRAMUNIFORM1IVPROC set[] = { gl->ProgramUniform1iv, gl->ProgramUniform2iv, gl->ProgramUniform3iv,
                                               gl->ProgramUniform4iv };
    GLuint program = program_with(gpu, location);
    assert(count >= 1 && count <= NOOK_COUNT(set));
    if (program != 0)
        set[count - 1](program, (GLint)location, 1, values);
}

void nook_uniform_uint(nook_gpu *gpu, uint32_t location, const uint32_t *values, uint32_t count)
{
    const nook_gl *gl = gpu->gl;
    const PFNGLPROGRAMUNIFORM1UIVPROC set[] = { gl->ProgramUniform1uiv, gl->ProgramUniform2uiv, gl->ProgramUniform3uiv,
                                                gl->ProgramUniform4uiv };
    GLuint program = program_with(gpu, location);
    assert(count >= 1 && count <= NOOK_COUNT(set));
    if (program != 0)
        set[count - 1](program, (GLint)location, 1, values);
}

void nook_uniform_float(nook_gpu *gpu, uint32_t location, const float *values, uint32_t count)
{
    const nook_gl *gl = gpu->gl;
    const PFNGLPROGRAMUNIFORM1FVPROC set[] = { gl->ProgramUniform1fv, gl->ProgramUniform2fv, gl->ProgramUniform3fv,
                                               gl->ProgramUniform4fv };
    GLuint program = program_with(gpu, location);
    assert(count >= 1 && count <= NOOK_COUNT(set));
    if (program != 0)
        set[count - 1](program, (GLint)location, 1, values);
}
