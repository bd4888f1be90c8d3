#include "engine/core/log.h"
#include "engine/gpu/program_layout_internal.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GROUP_CAPACITY = 32, ROW_CAPACITY = 256 };

static size_t line_length(const char *line)
{
    return strcspn(line, "\n");
}

static const char *next_line(const char *line)
{
    size_t length = line_length(line);
    return line + length + (line[length] == '\n');
}

/* The group with the space behind it. */
static size_t group_length(const char *line)
{
    return strcspn(line, " ") + 1;
}

static bool has_line(const char *text, const char *line, size_t length)
{
    for (; *text != '\0'; text = next_line(text))
        if (line_length(text) == length && memcmp(text, line, length) == 0)
            return true;
    return false;
}

/* Lines of the group that `line` is of. */
static size_t count_group(const char *text, const char *line)
{
    size_t length = group_length(line), count = 0;
    for (; *text != '\0'; text = next_line(text))
        count += strncmp(text, line, length) == 0;
    return count;
}

/* ---- rows that C code expects -------------------------------------------------------------------------------------- */

/* "rays int at 0": the rows as lines of program_layout_internal.h. Owned by the caller; NULL without memory. */
static char *print_rows(const nook_param *table, size_t count)
{
    enum { ROW_MAX = 96 };
    char *rows = malloc(count * ROW_MAX + 1);
    size_t used = 0;
    if (!rows)
        return NULL;
    rows[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        int length = snprintf(rows + used, ROW_MAX, "%s %s at %zu\n", table[i].name,
                              table[i].type == NOOK_PARAM_FLOAT ? "float" : "int", table[i].offset);
        assert(length > 0 && length < ROW_MAX);
        used += (size_t)length;
    }
    return rows;
}

nook_result nook_gpu_expect_params(nook_gpu *gpu, const char *path, const nook_param *table, size_t count)
{
    struct nook_gpu_cache *cache = gpu->cache;
    size_t at = 0;
    while (at < cache->rows_count && strcmp(cache->rows[at].path, path) != 0)
        at++;
    char *rows = print_rows(table, count), *name = strdup(path);
    program_rows *list = at < cache->rows_count ? cache->rows : realloc(cache->rows, (at + 1) * sizeof *list);
    if (list)
        cache->rows = list;
    if (!rows || !name || !list) {
        free(rows);
        free(name);
        return nook_fail(NOOK_E_MEMORY, "%s: out of memory", path);
    }
    if (at < cache->rows_count) {
        free(list[at].path);
        free(list[at].rows);
    } else {
        cache->rows_count++;
    }
    list[at] = (program_rows){ name, rows };
    return NOOK_OK;
}

static const program_rows *find_rows(const nook_gpu *gpu, const char *path)
{
    for (size_t i = 0; i < gpu->cache->rows_count; i++)
        if (strcmp(gpu->cache->rows[i].path, path) == 0)
            return &gpu->cache->rows[i];
    return NULL;
}

/* The first row that the group of `group_line` lacks, or NULL when it has them all. */
static const char *missing_row(const char *layout, const char *group_line, const char *rows)
{
    char line[GROUP_CAPACITY + ROW_CAPACITY];
    for (; *rows != '\0'; rows = next_line(rows)) {
        int length = snprintf(line, sizeof line, "%.*s%.*s", (int)group_length(group_line), group_line,
                              (int)line_length(rows), rows);
        if (length < 0 || (size_t)length >= sizeof line || !has_line(layout, line, (size_t)length))
            return rows;
    }
    return NULL;
}

/* The block that has all these rows and no others. @return false: there is none, and out_why says what the likeliest lacks */
static bool find_block(const char *layout, const program_rows *expected, char out_group[GROUP_CAPACITY], char *out_why,
                       size_t capacity)
{
    size_t count = 0;
    bool has_more = false;
    const char *lacks = expected->rows;
    for (const char *row = expected->rows; *row != '\0'; row = next_line(row))
        count++;
    for (const char *line = layout; *line != '\0'; line = next_line(line)) {
        const char *missing = strncmp(line, "uniform=", 8) == 0 ? missing_row(layout, line, expected->rows) : lacks;
        if (!missing && count_group(layout, line) == count) {
            snprintf(out_group, GROUP_CAPACITY, "%.*s", (int)group_length(line), line);
            return true;
        }
        has_more = has_more || !missing;
        if (missing > lacks) /* that block has the rows before it */
            lacks = missing;
    }
    if (has_more)
        nook_refuse(out_why, capacity, NOOK_E_VERSION,
                    "%s: holds a row that the running code does not know; build the code anew: ./nook watch does so",
                    expected->path);
    else
        nook_refuse(out_why, capacity, NOOK_E_VERSION,
                    "%s: the running code expects '%.*s' in it; build the code anew: ./nook watch does so",
                    expected->path, (int)line_length(lacks), lacks);
    return false;
}

/* ---- what the program before it had -------------------------------------------------------------------------------- */

/* The first line of `layout` that `other` lacks although it has the group; groups in `exempt` do not count. */
static const char *find_difference(const char *layout, const char *other, const char *exempt)
{
    for (const char *line = layout; *line != '\0'; line = next_line(line)) {
        char group[GROUP_CAPACITY];
        snprintf(group, sizeof group, "%.*s", (int)group_length(line), line);
        if (count_group(other, line) > 0 && !has_line(other, line, line_length(line)) && !strstr(exempt, group))
            return line;
    }
    return NULL;
}

/* Two kinds of sampler at one binding: GL refuses to draw with that. */
static const char *find_clash(const char *layout)
{
    for (const char *line = layout; *line != '\0'; line = next_line(line))
        if (strncmp(line, "texture=", 8) == 0 && count_group(next_line(line), line) > 0 &&
            !has_line(next_line(line), line, line_length(line)))
            return line;
    return NULL;
}

bool nook_program_layout_fits(const nook_gpu *gpu, char *const *files, uint32_t file_count, const char *layout,
                              const char *before, char *out_why, size_t capacity)
{
    char exempt[8 * GROUP_CAPACITY] = "", group[GROUP_CAPACITY];
    for (uint32_t i = 0; i < file_count; i++) {
        const program_rows *expected = find_rows(gpu, files[i]);
        if (!expected)
            continue;
        if (!find_block(layout, expected, group, out_why, capacity))
            return false;
        snprintf(exempt + strlen(exempt), sizeof exempt - strlen(exempt), "%s", group);
    }
    const char *difference = find_clash(layout);
    if (difference) {
        nook_refuse(out_why, capacity, NOOK_E_VERSION, "'%.*s': another kind of sampler has that binding, too",
                    (int)line_length(difference), difference);
        return false;
    }
    const char *fresh = before ? find_difference(layout, before, exempt) : NULL;
    const char *lost = before ? find_difference(before, layout, exempt) : NULL;
    if (!fresh && !lost)
        return true;
    nook_refuse(out_why, capacity, NOOK_E_VERSION,
                "%s '%.*s', and the running code relies on what was there; build it anew and start it again",
                fresh ? "has" : "lacks", (int)line_length(fresh ? fresh : lost), fresh ? fresh : lost);
    return false;
}

char *nook_program_layout_join(const char *layout, const char *before)
{
    size_t size = strlen(layout);
    char *joined = malloc(size + (before ? strlen(before) : 0) + 1);
    if (!joined)
        return NULL;
    memcpy(joined, layout, size + 1);
    for (const char *line = before; line && *line != '\0'; line = next_line(line)) {
        size_t length = line_length(line) + 1;
        if (count_group(layout, line) > 0)
            continue;
        memcpy(joined + size, line, length);
        size += length;
        joined[size] = '\0';
    }
    return joined;
}
