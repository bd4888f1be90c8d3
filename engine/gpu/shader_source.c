#include "engine/gpu/shader_source.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_CAPACITY = 1024, VERSION_CAPACITY = 64, DEPTH_LIMIT = 32 };

typedef struct reader {
    const char *root;
    nook_shader_source *out;
    char version[VERSION_CAPACITY]; /* the main file's own #version line, or empty */
    bool out_of_memory;             /* sticky: appending went wrong */
} reader;

/* Where an include stands, for messages; `from` is NULL for the main file. */
typedef struct place {
    const char *from;
    uint32_t line;
    int depth;
} place;

static void append(reader *self, const char *bytes, size_t size)
{
    nook_shader_source *out = self->out;
    if (self->out_of_memory)
        return;
    if (out->size + size + 1 > out->capacity) {
        size_t capacity = (out->size + size + 1) * 2;
        char *text = realloc(out->text, capacity);
        if (!text) {
            self->out_of_memory = true;
            return;
        }
        out->text = text;
        out->capacity = capacity;
    }
    memcpy(out->text + out->size, bytes, size);
    out->size += size;
    out->text[out->size] = '\0';
}

static void append_text(reader *self, const char *text)
{
    append(self, text, strlen(text));
}

/* The next line of the text is `line` of that file. */
static void append_line_mark(reader *self, uint32_t line, uint32_t file)
{
    char mark[48];
    snprintf(mark, sizeof mark, "#line %u %u\n", line, file);
    append_text(self, mark);
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
        return nook_fail(NOOK_E_FORMAT, "%s:%u: #include wants a path in double quotes", at.from, at.line);
    if (at.depth > DEPTH_LIMIT)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: #include is nested deeper than %d files", at.from, at.line,
                         DEPTH_LIMIT);
    size_t length = (size_t)(close - rest - 1);
    memcpy(name, rest + 1, length);
    name[length] = '\0';
    return read_file(self, name, at);
}

/* Copies a file's lines. The directives that are ours leave an empty line, so that the driver counts as the file does. */
static nook_result read_lines(reader *self, uint32_t index, const char *text, const char *text_end, int depth)
{
    bool in_comment = false;
    uint32_t number = 1;
    for (const char *line = text; line < text_end; number++) {
        const char *newline = memchr(line, '\n', (size_t)(text_end - line));
        const char *end = newline ? newline : text_end;
        const char *code = first_code(line, end, &in_comment), *rest;
        if ((rest = directive(code, end, "include")) != NULL) {
            place here = { self->out->files[index].path, number, depth + 1 };
            nook_result result = read_include(self, rest, end, here);
            if (result != NOOK_OK)
                return result;
            append_line_mark(self, number + 1, index);
        } else if ((rest = directive(code, end, "pragma")) != NULL && end - rest >= 4 && memcmp(rest, "once", 4) == 0) {
            self->out->files[index].once = true;
            append_text(self, "\n");
        } else if (depth == 0 && directive(code, end, "version") != NULL) {
            snprintf(self->version, sizeof self->version, "%.*s", (int)(end - code), code);
            append_text(self, "\n");
        } else {
            append(self, line, (size_t)(end - line));
            append_text(self, "\n");
        }
        line = end + 1;
    }
    return NOOK_OK;
}

/* Finds the file a name means. @return false when there is none */
static bool resolve(const char *root, const char *name, char relative[PATH_CAPACITY], char full[PATH_CAPACITY])
{
    static const char *const folders[] = { "", "shaders/" };
    for (size_t i = 0; i < NOOK_COUNT(folders); i++) {
        int length = snprintf(relative, PATH_CAPACITY, "%s%s", folders[i], name);
        nook_path_join(full, PATH_CAPACITY, root, relative);
        if (length > 0 && length < PATH_CAPACITY && nook_file_exists(full))
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
        return at.from ? nook_fail(NOOK_E_NOT_FOUND, "%s:%u: #include \"%s\": no such file in %s or its shaders/",
                                   at.from, at.line, name, self->root)
                       : nook_fail(NOOK_E_NOT_FOUND, "%s: no such shader in %s or its shaders/", name, self->root);
    if (find_file(self->out, relative, &index) && self->out->files[index].once)
        return NOOK_OK;
    if (find_file(self->out, relative, &index) && self->out->files[index].open)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: #include \"%s\" goes in a circle: that file is being read", at.from,
                         at.line, name);
    if (!add_file(self->out, relative, &index))
        return nook_fail(NOOK_E_MEMORY, "%s: out of memory", relative);
    nook_result result = nook_file_read(full, &file);
    if (result != NOOK_OK)
        return result;
    self->out->files[index].open = true;
    append_line_mark(self, 1, index);
    const char *text = (const char *)file.bytes;
    result = read_lines(self, index, text, text + file.size, at.depth);
    self->out->files[index].open = false;
    nook_file_free(&file);
    return result;
}

/* #version must come first, but is known only after the files were read: puts it and the defines before the text. */
static void put_header(reader *self, const char *defines)
{
    nook_shader_source *out = self->out;
    char *body = out->text;
    size_t body_size = out->size;
    out->text = NULL;
    out->size = out->capacity = 0;
    append_text(self, self->version[0] ? self->version : "#version 450 core");
    append_text(self, "\n#line 1 0\n");
    append_text(self, defines);
    append_text(self, "\n");
    append(self, body ? body : "", body_size);
    free(body);
}

nook_result nook_shader_source_read(const char *root, const char *path, const char *defines,
                                    nook_shader_source *out_source)
{
    nook_shader_source source = { 0 };
    reader self = { .root = root, .out = &source };
    uint32_t defines_index = 0;
    nook_result result = NOOK_OK;
    if (!add_file(&source, "(defines)", &defines_index))
        result = nook_fail(NOOK_E_MEMORY, "%s: out of memory", path);
    if (result == NOOK_OK)
        result = read_file(&self, path, (place){ NULL, 0, 0 });
    if (result == NOOK_OK) {
        put_header(&self, defines);
        if (self.out_of_memory)
            result = nook_fail(NOOK_E_MEMORY, "%s: out of memory", path);
    }
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
    if (known && file < source->file_count)
        snprintf(out, capacity, "%s:%u: %s%s", source->files[file].path, number, severity, text + rest);
    else
        snprintf(out, capacity, "%s", text);
}
