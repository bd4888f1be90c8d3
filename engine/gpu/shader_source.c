#include "engine/gpu/shader_source.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_CAPACITY = 1024, DEPTH_LIMIT = 32 };

typedef struct reader {
    const char *root;
    const char *defines;
    nook_shader_source *out;
    char *why;
    size_t why_capacity;
} reader;

/* Where an include stands, for messages; `from` is NULL for the main file. */
typedef struct place {
    const char *from;
    uint32_t line;
    int depth;
} place;

/* Makes room for one more line of `size` bytes, its newline and the zero behind it. */
static bool reserve_line(nook_shader_source *out, size_t size)
{
    if (out->size + size + 2 > out->capacity) {
        size_t capacity = (out->size + size + 2) * 2;
        char *text = realloc(out->text, capacity);
        if (!text)
            return false;
        out->text = text;
        out->capacity = capacity;
    }
    if (out->line_count == out->line_capacity) {
        uint32_t capacity = out->line_capacity ? out->line_capacity * 2 : 256;
        nook_shader_line *lines = realloc(out->lines, capacity * sizeof *lines);
        if (!lines)
            return false;
        out->lines = lines;
        out->line_capacity = capacity;
    }
    return true;
}

static nook_result append_line(reader *self, const char *bytes, size_t size, uint32_t file, uint32_t line)
{
    nook_shader_source *out = self->out;
    if (!reserve_line(out, size))
        return nook_refuse(self->why, self->why_capacity, NOOK_E_MEMORY, "%s: out of memory", out->files[file].path);
    assert(out->text && out->lines);
    memcpy(out->text + out->size, bytes, size);
    out->size += size;
    out->text[out->size++] = '\n';
    out->text[out->size] = '\0';
    out->lines[out->line_count++] = (nook_shader_line){ file, line };
    return NOOK_OK;
}

static bool find_file(const nook_shader_source *source, const char *path, uint32_t *out_index)
{
    for (uint32_t i = 0; i < source->file_count; i++) {
        if (strcmp(source->files[i].path, path) == 0) {
            *out_index = i;
            return true;
        }
    }
    return false;
}

static bool add_file(nook_shader_source *source, const char *path, uint32_t *out_index)
{
    if (find_file(source, path, out_index))
        return true;
    if (source->file_count == source->file_capacity) {
        uint32_t capacity = source->file_capacity ? source->file_capacity * 2 : 8;
        nook_shader_file *files = realloc(source->files, capacity * sizeof *files);
        if (!files)
            return false;
        source->files = files;
        source->file_capacity = capacity;
    }
    size_t size = strlen(path) + 1;
    char *copy = malloc(size);
    if (!copy)
        return false;
    memcpy(copy, path, size);
    source->files[source->file_count] = (nook_shader_file){ .path = copy };
    *out_index = source->file_count++;
    return true;
}

/* The first character of a line that is neither space nor comment, or NULL. `in_comment` lives from line to line. */
static const char *first_code(const char *line, const char *end, bool *in_comment)
{
    const char *first = NULL;
    for (const char *at = line; at < end; at++) {
        bool pair = at + 1 < end;
        if (*in_comment) {
            if (pair && at[0] == '*' && at[1] == '/') {
                *in_comment = false;
                at++;
            }
        } else if (pair && at[0] == '/' && at[1] == '/') {
            break;
        } else if (pair && at[0] == '/' && at[1] == '*') {
            *in_comment = true;
            at++;
        } else if (!first && *at != ' ' && *at != '\t' && *at != '\r') {
            first = at;
        }
    }
    return first;
}

/* What follows "# word" on a line, or NULL when the line is no such directive. */
static const char *directive(const char *code, const char *end, const char *word)
{
    size_t length = strlen(word);
    if (!code || *code != '#')
        return NULL;
    for (code++; code < end && (*code == ' ' || *code == '\t');)
        code++;
    if ((size_t)(end - code) < length || memcmp(code, word, length) != 0)
        return NULL;
    code += length;
    if (code < end && *code != ' ' && *code != '\t' && *code != '"' && *code != '<' && *code != '\r')
        return NULL;
    while (code < end && (*code == ' ' || *code == '\t'))
        code++;
    return code;
}

static nook_result read_file(reader *self, const char *name, place at);

static nook_result read_include(reader *self, const char *rest, const char *end, place at)
{
    char name[PATH_CAPACITY];
    const char *close = rest < end && *rest == '"' ? memchr(rest + 1, '"', (size_t)(end - rest - 1)) : NULL;
    if (!close || close == rest + 1 || (size_t)(close - rest) > sizeof name)
        return nook_refuse(self->why, self->why_capacity, NOOK_E_FORMAT,
                           "%s:%u: #include wants a path in double quotes", at.from, at.line);
    if (at.depth > DEPTH_LIMIT)
        return nook_refuse(self->why, self->why_capacity, NOOK_E_FORMAT,
                           "%s:%u: #include is nested deeper than %d files", at.from, at.line, DEPTH_LIMIT);
    size_t length = (size_t)(close - rest - 1);
    memcpy(name, rest + 1, length);
    name[length] = '\0';
    return read_file(self, name, at);
}

static const char *line_end(const char *line, const char *text_end)
{
    const char *newline = memchr(line, '\n', (size_t)(text_end - line));
    return newline ? newline : text_end;
}

/* Copies a file's lines. The directives that are ours are left out. */
static nook_result read_lines(reader *self, uint32_t index, const char *text, const char *text_end, int depth)
{
    bool in_comment = false;
    uint32_t number = 1;
    nook_result result = NOOK_OK;
    for (const char *line = text; line < text_end && result == NOOK_OK; number++) {
        const char *end = line_end(line, text_end);
        const char *code = first_code(line, end, &in_comment), *rest;
        if ((rest = directive(code, end, "include")) != NULL)
            result = read_include(self, rest, end, (place){ self->out->files[index].path, number, depth + 1 });
        else if ((rest = directive(code, end, "pragma")) != NULL && end - rest >= 4 && memcmp(rest, "once", 4) == 0)
            self->out->files[index].once = true;
        else if (depth > 0 || !directive(code, end, "version"))
            result = append_line(self, line, (size_t)(end - line), index, number);
        line = end < text_end ? end + 1 : end;
    }
    return result;
}

/* #version must come first: the file's own wherever it stands, else ours; then the defines. */
static nook_result read_header(reader *self, uint32_t index, const char *text, const char *text_end)
{
    static const char ours[] = "#version 450 core";
    const char *version = ours, *version_end = ours + sizeof ours - 1;
    bool in_comment = false;
    uint32_t version_line = 1, number = 1;
    for (const char *line = text; line < text_end; number++) {
        const char *end = line_end(line, text_end), *code = first_code(line, end, &in_comment);
        if (directive(code, end, "version")) {
            version = code;
            version_end = end;
            version_line = number;
            break;
        }
        line = end < text_end ? end + 1 : end;
    }
    nook_result result = append_line(self, version, (size_t)(version_end - version), index, version_line);
    const char *defines_end = self->defines + strlen(self->defines);
    number = 1;
    for (const char *line = self->defines; line < defines_end && result == NOOK_OK; number++) {
        const char *end = line_end(line, defines_end);
        result = append_line(self, line, (size_t)(end - line), 0, number);
        line = end < defines_end ? end + 1 : end;
    }
    return result;
}

static bool is_up(const char *part, size_t length)
{
    return length == 2 && part[0] == '.' && part[1] == '.';
}

/* Takes "." and "name/.." out of a path, so that a file has one name. */
static void clean_path(char path[PATH_CAPACITY])
{
    char clean[PATH_CAPACITY];
    size_t used = 0, last = 0; /* last: where the last part of what is used starts */
    for (const char *at = path; *at != '\0';) {
        size_t length = strcspn(at, "/");
        if (is_up(at, length) && used > 0 && !is_up(clean + last, used - last)) {
            used = last > 0 ? last - 1 : 0;
            for (last = used; last > 0 && clean[last - 1] != '/';)
                last--;
        } else if (length > 1 || (length == 1 && at[0] != '.')) {
            if (used > 0)
                clean[used++] = '/';
            last = used;
            memcpy(clean + used, at, length);
            used += length;
        }
        at += length + (at[length] == '/');
    }
    if (used > 0)
        memcpy(path, clean, used);
    path[used] = '\0';
}

/* Finds the file a name means. @return false when there is none */
static bool resolve(const char *root, const char *name, char relative[PATH_CAPACITY], char full[PATH_CAPACITY])
{
    static const char *const folders[] = { "", "shaders/" };
    for (size_t i = 0; i < NOOK_COUNT(folders); i++) {
        int length = snprintf(relative, PATH_CAPACITY, "%s%s", folders[i], name);
        if (length <= 0 || length >= PATH_CAPACITY)
            continue;
        clean_path(relative);
        nook_path_join(full, PATH_CAPACITY, root, relative);
        if (nook_file_exists(full))
            return true;
    }
    return false;
}

static nook_result read_file(reader *self, const char *name, place at)
{
    char relative[PATH_CAPACITY], full[PATH_CAPACITY];
    uint32_t index = 0;
    nook_file file = { 0 };
    if (!resolve(self->root, name, relative, full))
        return at.from ? nook_refuse(self->why, self->why_capacity, NOOK_E_NOT_FOUND,
                                     "%s:%u: #include \"%s\": no such file in %s or its shaders/", at.from, at.line,
                                     name, self->root)
                       : nook_refuse(self->why, self->why_capacity, NOOK_E_NOT_FOUND,
                                     "%s: no such shader in %s or its shaders/", name, self->root);
    if (find_file(self->out, relative, &index) && self->out->files[index].once)
        return NOOK_OK;
    if (find_file(self->out, relative, &index) && self->out->files[index].open)
        return nook_refuse(self->why, self->why_capacity, NOOK_E_FORMAT,
                           "%s:%u: #include \"%s\" goes in a circle: that file is being read", at.from, at.line, name);
    if (!add_file(self->out, relative, &index))
        return nook_refuse(self->why, self->why_capacity, NOOK_E_MEMORY, "%s: out of memory", relative);
    nook_result result = nook_file_try_read(full, &file, self->why, self->why_capacity);
    if (result != NOOK_OK)
        return result;
    if (memchr(file.bytes, '\0', file.size)) {
        nook_file_free(&file);
        return nook_refuse(self->why, self->why_capacity, NOOK_E_FORMAT, "%s: not a text file, it holds zero bytes",
                           relative);
    }
    self->out->files[index].open = true;
    const char *text = (const char *)file.bytes, *text_end = text + file.size;
    if (at.depth == 0)
        result = read_header(self, index, text, text_end);
    if (result == NOOK_OK)
        result = read_lines(self, index, text, text_end, at.depth);
    self->out->files[index].open = false;
    nook_file_free(&file);
    return result;
}

nook_result nook_shader_source_read(const char *root, const char *path, const char *defines,
                                    nook_shader_source *out_source, char *out_why, size_t capacity)
{
    nook_shader_source source = { 0 };
    reader self = { .root = root, .defines = defines, .out = &source };
    self.why = out_why;
    self.why_capacity = capacity;
    uint32_t defines_index = 0;
    nook_result result = NOOK_OK;
    if (!add_file(&source, "(defines)", &defines_index))
        result = nook_refuse(self.why, self.why_capacity, NOOK_E_MEMORY, "%s: out of memory", path);
    if (result == NOOK_OK)
        result = read_file(&self, path, (place){ NULL, 0, 0 });
    if (result != NOOK_OK) {
        nook_shader_source_free(&source);
        return result;
    }
    *out_source = source;
    return NOOK_OK;
}

void nook_shader_source_free(nook_shader_source *source)
{
    for (uint32_t i = 0; i < source->file_count; i++)
        free(source->files[i].path);
    free(source->files);
    free(source->lines);
    free(source->text);
    *source = (nook_shader_source){ 0 };
}

void nook_shader_source_translate(const nook_shader_source *source, const char *line, size_t length, char *out,
                                  size_t capacity)
{
    char text[1024];
    unsigned file = 0, number = 0;
    int rest = 0;
    const char *severity = "";
    snprintf(text, sizeof text, "%.*s", (int)(length < sizeof text ? length : sizeof text - 1), line);
    bool known = (sscanf(text, "%9u:%9u(%*9u): %n", &file, &number, &rest) == 2 && rest > 0) ||
                 (sscanf(text, "%9u(%9u) : %n", &file, &number, &rest) == 2 && rest > 0);
    if (!known && sscanf(text, "ERROR: %9u:%9u: %n", &file, &number, &rest) == 2 && rest > 0) {
        severity = "error: ";
        known = true;
    }
    if (known && file == 0 && number >= 1 && number <= source->line_count) {
        const nook_shader_line *from = &source->lines[number - 1];
        snprintf(out, capacity, "%s:%u: %s%s", source->files[from->file].path, from->line, severity, text + rest);
    } else {
        snprintf(out, capacity, "%s", text);
    }
}
