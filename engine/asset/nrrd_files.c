#include "engine/asset/nrrd_internal.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_CAPACITY = 4096, DATA_FILES_MAX = 65536 };

/* Relative, and never upwards; "-" is standard input to other readers, and '%' belongs to patterns only. */
static bool safe_name(const char *name)
{
    if (name[0] == 0 || name[0] == '/' || strcmp(name, "-") == 0 || strpbrk(name, "%\\"))
        return false;
    for (const char *part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == 0))
            return false;
    }
    return true;
}

/* What is being looked for. */
typedef struct search {
    const char *name;        /* of the header, in messages */
    const char *header_path; /* its folder is where data files are */
    nook_nrrd_files files;   /* found so far */
} search;

static nook_result add_path(search *s, const char *path)
{
    if (s->files.count == DATA_FILES_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: more than %d data files", s->name, DATA_FILES_MAX);
    if ((s->files.count & (s->files.count - 1)) == 0) { /* full at each power of two */
        char **grown = realloc(s->files.paths, (s->files.count ? s->files.count * 2 : 1) * sizeof *grown);
        if (!grown)
            return nook_fail(NOOK_E_MEMORY, "%s: no memory for the names of its data files", s->name);
        s->files.paths = grown;
    }
    size_t size = strlen(path) + 1;
    char *copy = malloc(size);
    if (!copy)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for the names of its data files", s->name);
    memcpy(copy, path, size);
    s->files.paths[s->files.count++] = copy;
    return NOOK_OK;
}

static nook_result add_name(search *s, const char *name)
{
    char path[PATH_CAPACITY];
    if (!safe_name(name))
        return nook_fail(NOOK_E_FORMAT, "%s: data file '%s' is refused: only files below the header's folder are read",
                         s->name, name);
    int folder_length = (int)(nook_path_name(s->header_path) - s->header_path);
    int length = snprintf(path, sizeof path, "%.*s%s", folder_length, s->header_path, name);
    if (length < 0 || (size_t)length >= sizeof path)
        return nook_fail(NOOK_E_FORMAT, "%s: the path of its data file is too long", s->name);
    if (!nook_file_exists(path))
        return nook_fail(NOOK_E_NOT_FOUND, "%s: its data file '%s' does not exist or is not a regular file", s->name,
                         name);
    return add_path(s, path);
}

/* "LIST": the names stand in the lines behind the header. */
static nook_result add_listed(search *s, const char *at, const char *end)
{
    const char *line;
    size_t length;
    char name[NOOK_NRRD_VALUE_CAPACITY];
    while (nook_nrrd_next_line(&at, end, &line, &length)) {
        if (length == 0)
            continue;
        if (!nook_nrrd_copy_trimmed(line, length, name, sizeof name))
            return nook_fail(NOOK_E_FORMAT, "%s: the name of a data file is too long", s->name);
        nook_result result = add_name(s, name);
        if (result != NOOK_OK)
            return result;
    }
    return s->files.count > 0 ? NOOK_OK : nook_fail(NOOK_E_FORMAT, "%s: its list of data files is empty", s->name);
}

/* "name%03d.raw first last step [dimension]" */
typedef struct pattern {
    int prefix_length;  /* before '%' */
    const char *suffix; /* behind 'd' */
    int suffix_length;
    int width;
    bool zeros;
    int64_t first, last, step;
} pattern;

static bool read_pattern(const char *text, pattern *out)
{
    const char *percent = strchr(text, '%'), *at = percent + 1;
    out->prefix_length = (int)(percent - text);
    out->zeros = *at == '0';
    out->width = 0;
    while (isdigit((unsigned char)*at) && at - percent < 3)
        out->width = out->width * 10 + (*at++ - '0');
    if (*at++ != 'd')
        return false;
    out->suffix = at;
    out->suffix_length = (int)strcspn(at, " ");
    at += out->suffix_length;
    at += strspn(at, " ");
    return nook_nrrd_take_number(&at, &out->first) && nook_nrrd_take_number(&at, &out->last) &&
           nook_nrrd_take_number(&at, &out->step) && out->first >= 0 && out->last >= out->first && out->step >= 1 &&
           out->last <= INT32_MAX;
}

/* The pattern is taken apart and never given to printf as it stands. */
static nook_result add_numbered(search *s, const char *text)
{
    pattern p;
    if (!read_pattern(text, &p))
        return nook_fail(NOOK_E_FORMAT, "%s: data file '%s': not a pattern with one %%d and first, last, step", s->name,
                         text);
    for (int64_t i = p.first; i <= p.last; i += p.step) {
        char name[NOOK_NRRD_VALUE_CAPACITY + 128], number[128];
        snprintf(number, sizeof number, p.zeros ? "%0*d" : "%*d", p.width, (int)i);
        snprintf(name, sizeof name, "%.*s%s%.*s", p.prefix_length, text, number, p.suffix_length, p.suffix);
        nook_result result = add_name(s, name);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

nook_result nook_nrrd_files_find(const char *name, const char *path, const nook_nrrd_header *header,
                                 const uint8_t *bytes, size_t size, nook_nrrd_files *out_files)
{
    search s = { .name = name, .header_path = path };
    nook_result result;
    if (strncmp(header->data_file, "LIST", 4) == 0)
        result = add_listed(&s, (const char *)bytes + header->rest, (const char *)bytes + size);
    else if (strchr(header->data_file, '%'))
        result = add_numbered(&s, header->data_file);
    else
        result = add_name(&s, header->data_file);
    if (result == NOOK_OK)
        *out_files = s.files;
    else
        nook_nrrd_files_free(&s.files);
    return result;
}

void nook_nrrd_files_free(nook_nrrd_files *files)
{
    for (size_t i = 0; i < files->count; i++)
        free(files->paths[i]);
    free(files->paths);
    *files = (nook_nrrd_files){ 0 };
}
