#include "game/measure/result_columns.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* clang-format off */
#define ROW(name, kind, member) { name, NOOK_RESULT_##kind, offsetof(nook_result_row, member) }
static const nook_result_column row_columns[] = {
    ROW("scene", TEXT, scene),
    ROW("scene_hash", TEXT, scene_hash),
    ROW("camera", TEXT, camera),
    ROW("width", WHOLE, width),
    ROW("height", WHOLE, height),
    ROW("r_max", NUMBER, r_max),
    ROW("r_max_part", NUMBER, r_max_part),
    ROW("falloff", TEXT, falloff),
    ROW("technique", TEXT, technique),
    ROW("setting", TEXT, setting),
    ROW("initial", FLAG, initial),
#define NOOK_SAMPLE_NUMBER(member, name, key, over) ROW(#name, NUMBER, sample.member),
#define NOOK_SAMPLE_DETAIL(member, name, kind) ROW(#name, kind, sample.member),
#include "game/measure/sample_members.def"
#undef NOOK_SAMPLE_NUMBER
#undef NOOK_SAMPLE_DETAIL
    ROW("build", TEXT, build),
    ROW("date", TEXT, date),
    ROW("picture", TEXT, picture),
    ROW("machine", TEXT, machine), /* last: for those who cut at commas, of which it has some */
};

#define SITE(name, kind, member) { name, NOOK_RESULT_##kind, offsetof(nook_result_site, member) }
static const nook_result_column site_columns[] = {
    SITE("scene", TEXT, scene),
    SITE("scene_hash", TEXT, scene_hash),
    SITE("camera", TEXT, camera),
    SITE("width", WHOLE, width),
    SITE("height", WHOLE, height),
    SITE("r_max", NUMBER, r_max),
    SITE("falloff", TEXT, falloff),
    SITE("reference_noise", NUMBER, reference_noise),
    SITE("reference_rays", WHOLE, reference_rays),
    SITE("truth", TEXT, truth),
    SITE("screen", TEXT, screen),
    SITE("geometry", TEXT, geometry),
    SITE("lit", TEXT, lit),
};
/* clang-format on */

const nook_result_column *nook_result_row_columns(size_t *out_count)
{
    *out_count = NOOK_COUNT(row_columns);
    return row_columns;
}

const nook_result_column *nook_result_site_columns(size_t *out_count)
{
    *out_count = NOOK_COUNT(site_columns);
    return site_columns;
}

/* ---- Writing ---------------------------------------------------------------------------------------------------- */

void nook_result_write_json(nook_json *json, const nook_result_column *columns, size_t count, const void *record)
{
    nook_json_begin_object(json);
    for (size_t i = 0; i < count; i++) {
        const char *member = (const char *)record + columns[i].offset;
        nook_json_key(json, columns[i].name);
        switch (columns[i].kind) {
        case NOOK_RESULT_TEXT:
            nook_json_string(json, *(char *const *)(const void *)member);
            break;
        case NOOK_RESULT_NUMBER:
            nook_json_number(json, *(const double *)(const void *)member);
            break;
        case NOOK_RESULT_WHOLE:
            nook_json_integer(json, *(const uint32_t *)(const void *)member);
            break;
        case NOOK_RESULT_COUNT:
            nook_json_integer(json, (int64_t) * (const uint64_t *)(const void *)member);
            break;
        case NOOK_RESULT_FLAG:
            nook_json_bool(json, *(const bool *)(const void *)member);
            break;
        }
    }
    nook_json_end_object(json);
}

/* ---- Reading ---------------------------------------------------------------------------------------------------- */

static nook_result refuse(const char *where, const nook_result_column *column, const char *expected)
{
    return nook_fail(NOOK_E_FORMAT, "%s: no result: %s is not %s", where, column->name, expected);
}

static nook_result read_text(const char *where, const nook_json_tree *tree, uint32_t value,
                             const nook_result_column *column, char **out)
{
    size_t length = 0;
    if (value != NOOK_JSON_NONE && tree->values[value].kind != NOOK_JSON_STRING)
        return refuse(where, column, "a text");
    char *text = value == NOOK_JSON_NONE ? strdup("") : nook_json_tree_copy_string(tree, value, &length);
    if (!text)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory", where);
    *out = text;
    return NOOK_OK;
}

static nook_result read_number(const char *where, const nook_json_tree *tree, uint32_t value,
                               const nook_result_column *column, double *out)
{
    *out = NAN;
    if (value == NOOK_JSON_NONE || tree->values[value].kind == NOOK_JSON_NULL)
        return NOOK_OK;
    if (tree->values[value].kind != NOOK_JSON_NUMBER || !isfinite(nook_json_tree_number(tree, value)))
        return refuse(where, column, "a number");
    *out = nook_json_tree_number(tree, value);
    return NOOK_OK;
}

static nook_result read_whole(const char *where, const nook_json_tree *tree, uint32_t value,
                              const nook_result_column *column, void *member)
{
    uint64_t whole = 0, most = column->kind == NOOK_RESULT_WHOLE ? UINT32_MAX : UINT64_MAX;
    if (value != NOOK_JSON_NONE && (!nook_json_tree_integer(tree, value, &whole) || whole > most))
        return refuse(where, column, "a whole number");
    if (column->kind == NOOK_RESULT_WHOLE)
        *(uint32_t *)member = (uint32_t)whole;
    else
        *(uint64_t *)member = whole;
    return NOOK_OK;
}

static nook_result read_flag(const char *where, const nook_json_tree *tree, uint32_t value,
                             const nook_result_column *column, bool *out)
{
    if (value != NOOK_JSON_NONE && tree->values[value].kind != NOOK_JSON_BOOL)
        return refuse(where, column, "true or false");
    *out = value != NOOK_JSON_NONE && tree->text[tree->values[value].start] == 't';
    return NOOK_OK;
}

nook_result nook_result_read_json(const char *where, const nook_json_tree *tree, uint32_t object,
                                  const nook_result_column *columns, size_t count, void *record)
{
    nook_result result = NOOK_OK;
    if (tree->values[object].kind != NOOK_JSON_OBJECT)
        return nook_fail(NOOK_E_FORMAT, "%s: no result", where);
    for (size_t i = 0; i < count && result == NOOK_OK; i++) {
        void *member = (char *)record + columns[i].offset;
        uint32_t value = nook_json_tree_find(tree, object, columns[i].name);
        switch (columns[i].kind) {
        case NOOK_RESULT_TEXT:
            result = read_text(where, tree, value, &columns[i], member);
            break;
        case NOOK_RESULT_NUMBER:
            result = read_number(where, tree, value, &columns[i], member);
            break;
        case NOOK_RESULT_WHOLE:
        case NOOK_RESULT_COUNT:
            result = read_whole(where, tree, value, &columns[i], member);
            break;
        case NOOK_RESULT_FLAG:
            result = read_flag(where, tree, value, &columns[i], member);
            break;
        }
    }
    return result;
}

void nook_result_clear(const nook_result_column *columns, size_t count, void *record, size_t record_size)
{
    for (size_t i = 0; i < count; i++) {
        if (columns[i].kind == NOOK_RESULT_TEXT)
            free(*(char **)(void *)((char *)record + columns[i].offset));
    }
    memset(record, 0, record_size);
}
