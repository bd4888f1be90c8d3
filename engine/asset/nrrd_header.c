#include "engine/asset/nrrd_internal.h"
#include "engine/asset/scene_internal.h"
#include "engine/core/log.h"
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { VALUE_CAPACITY = NOOK_NRRD_VALUE_CAPACITY };

/* ---- Words of the format (NRRD 5) ------------------------------------------------------------------------------- */

typedef enum field {
    FIELD_TYPE,
    FIELD_DIMENSION,
    FIELD_SIZES,
    FIELD_ENCODING,
    FIELD_ENDIAN,
    FIELD_DATA_FILE,
    FIELD_LINE_SKIP,
    FIELD_BYTE_SKIP,
    FIELD_SPACINGS,
    FIELD_SPACE_DIRECTIONS,
    FIELD_COUNT,
    FIELD_OTHER = FIELD_COUNT, /* known, and of no use here */
    FIELD_UNKNOWN
} field;

typedef struct word {
    const char *text;
    int value;
} word;

static const word field_words[] = {
    { "type", FIELD_TYPE },
    { "dimension", FIELD_DIMENSION },
    { "sizes", FIELD_SIZES },
    { "encoding", FIELD_ENCODING },
    { "endian", FIELD_ENDIAN },
    { "data file", FIELD_DATA_FILE },
    { "datafile", FIELD_DATA_FILE },
    { "line skip", FIELD_LINE_SKIP },
    { "lineskip", FIELD_LINE_SKIP },
    { "byte skip", FIELD_BYTE_SKIP },
    { "byteskip", FIELD_BYTE_SKIP },
    { "content", FIELD_OTHER },
    { "number", FIELD_OTHER },
    { "block size", FIELD_OTHER },
    { "blocksize", FIELD_OTHER },
    { "space", FIELD_OTHER },
    { "space dimension", FIELD_OTHER },
    { "spacings", FIELD_SPACINGS },
    { "thicknesses", FIELD_OTHER },
    { "axis mins", FIELD_OTHER },
    { "axismins", FIELD_OTHER },
    { "axis maxs", FIELD_OTHER },
    { "axismaxs", FIELD_OTHER },
    { "space directions", FIELD_SPACE_DIRECTIONS },
    { "centers", FIELD_OTHER },
    { "centerings", FIELD_OTHER },
    { "kinds", FIELD_OTHER },
    { "labels", FIELD_OTHER },
    { "units", FIELD_OTHER },
    { "min", FIELD_OTHER },
    { "max", FIELD_OTHER },
    { "old min", FIELD_OTHER },
    { "oldmin", FIELD_OTHER },
    { "old max", FIELD_OTHER },
    { "oldmax", FIELD_OTHER },
    { "sample units", FIELD_OTHER },
    { "sampleunits", FIELD_OTHER },
    { "space units", FIELD_OTHER },
    { "space origin", FIELD_OTHER },
    { "measurement frame", FIELD_OTHER },
};

static const word type_words[] = {
    { "signed char", NOOK_SAMPLE_I8 },
    { "int8", NOOK_SAMPLE_I8 },
    { "int8_t", NOOK_SAMPLE_I8 },
    { "uchar", NOOK_SAMPLE_U8 },
    { "unsigned char", NOOK_SAMPLE_U8 },
    { "uint8", NOOK_SAMPLE_U8 },
    { "uint8_t", NOOK_SAMPLE_U8 },
    { "short", NOOK_SAMPLE_I16 },
    { "short int", NOOK_SAMPLE_I16 },
    { "signed short", NOOK_SAMPLE_I16 },
    { "signed short int", NOOK_SAMPLE_I16 },
    { "int16", NOOK_SAMPLE_I16 },
    { "int16_t", NOOK_SAMPLE_I16 },
    { "ushort", NOOK_SAMPLE_U16 },
    { "unsigned short", NOOK_SAMPLE_U16 },
    { "unsigned short int", NOOK_SAMPLE_U16 },
    { "uint16", NOOK_SAMPLE_U16 },
    { "uint16_t", NOOK_SAMPLE_U16 },
    { "int", NOOK_SAMPLE_I32 },
    { "signed int", NOOK_SAMPLE_I32 },
    { "int32", NOOK_SAMPLE_I32 },
    { "int32_t", NOOK_SAMPLE_I32 },
    { "uint", NOOK_SAMPLE_U32 },
    { "unsigned int", NOOK_SAMPLE_U32 },
    { "uint32", NOOK_SAMPLE_U32 },
    { "uint32_t", NOOK_SAMPLE_U32 },
    { "longlong", NOOK_SAMPLE_I64 },
    { "long long", NOOK_SAMPLE_I64 },
    { "long long int", NOOK_SAMPLE_I64 },
    { "signed long long", NOOK_SAMPLE_I64 },
    { "signed long long int", NOOK_SAMPLE_I64 },
    { "int64", NOOK_SAMPLE_I64 },
    { "int64_t", NOOK_SAMPLE_I64 },
    { "ulonglong", NOOK_SAMPLE_U64 },
    { "unsigned long long", NOOK_SAMPLE_U64 },
    { "unsigned long long int", NOOK_SAMPLE_U64 },
    { "uint64", NOOK_SAMPLE_U64 },
    { "uint64_t", NOOK_SAMPLE_U64 },
    { "float", NOOK_SAMPLE_F32 },
    { "double", NOOK_SAMPLE_F64 },
};

static const word encoding_words[] = {
    { "raw", NOOK_NRRD_RAW },    { "txt", NOOK_NRRD_TEXT },  { "text", NOOK_NRRD_TEXT },
    { "ascii", NOOK_NRRD_TEXT }, { "hex", NOOK_NRRD_HEX },   { "gz", NOOK_NRRD_GZIP },
    { "gzip", NOOK_NRRD_GZIP },  { "bz2", NOOK_NRRD_BZIP2 }, { "bzip2", NOOK_NRRD_BZIP2 },
};

enum { ENDIAN_LITTLE, ENDIAN_BIG, ENDIAN_UNKNOWN };
static const word endian_words[] = { { "little", ENDIAN_LITTLE }, { "big", ENDIAN_BIG } };

static int find_word(const word *words, size_t count, const char *text, int otherwise)
{
    for (size_t i = 0; i < count; i++)
        if (strcasecmp(words[i].text, text) == 0)
            return words[i].value;
    return otherwise;
}

/* ---- Lines ------------------------------------------------------------------------------------------------------ */

typedef struct reader {
    const char *name;                        /* in messages */
    nook_scene *scene;                       /* keeps warnings; NULL: none does */
    const char *at, *end;                    /* what is left */
    char value[FIELD_COUNT][VALUE_CAPACITY]; /* "" when absent */
    bool present[FIELD_COUNT];
    bool blank_line; /* the header ended in one; `at` stands behind it */
} reader;

bool nook_nrrd_next_line(const char **at, const char *end, const char **out_line, size_t *out_length)
{
    if (*at == end)
        return false;
    const char *newline = memchr(*at, '\n', (size_t)(end - *at));
    const char *stop = newline ? newline : end;
    *out_line = *at;
    *out_length = (size_t)(stop - *at);
    if (*out_length > 0 && stop[-1] == '\r')
        --*out_length;
    *at = newline ? newline + 1 : end;
    return true;
}

bool nook_nrrd_copy_trimmed(const char *text, size_t length, char *out, size_t capacity)
{
    while (length > 0 && isspace((unsigned char)text[0]))
        text++, length--;
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        length--;
    if (length >= capacity || memchr(text, 0, length))
        return false;
    memcpy(out, text, length);
    out[length] = 0;
    return true;
}

static field find_field(const char *line, size_t name_length)
{
    char name[32];
    if (name_length >= sizeof name)
        return FIELD_UNKNOWN;
    memcpy(name, line, name_length);
    name[name_length] = 0;
    return (field)find_word(field_words, NOOK_COUNT(field_words), name, FIELD_UNKNOWN);
}

/* A comment, "field: value" or "key:=value". */
static nook_result read_line(reader *r, const char *line, size_t length)
{
    if (line[0] == '#')
        return NOOK_OK;
    int shown = length < 40 ? (int)length : 40;
    const char *colon = memchr(line, ':', length);
    size_t name_length = colon ? (size_t)(colon - line) : 0;
    field which = colon ? find_field(line, name_length) : FIELD_UNKNOWN;
    char after = colon && name_length + 1 < length ? colon[1] : 0;
    if (which == FIELD_UNKNOWN) {
        /* A key may hold colons itself. */
        for (const char *c = colon; c && c + 1 < line + length; c = memchr(c + 1, ':', (size_t)(line + length - c - 1)))
            if (c[1] == '=')
                return NOOK_OK;
        return nook_fail(NOOK_E_FORMAT, "%s: header line '%.*s' is neither a field of NRRD nor key:=value", r->name,
                         shown, line);
    }
    if (after != ' ')
        return nook_fail(NOOK_E_FORMAT, "%s: header line '%.*s': a field needs ': ' and a value", r->name, shown, line);
    if (which == FIELD_OTHER)
        return NOOK_OK;
    if (r->present[which])
        return nook_fail(NOOK_E_FORMAT, "%s: header field '%.*s' stands twice", r->name, (int)name_length, line);
    r->present[which] = true;
    if (!nook_nrrd_copy_trimmed(colon + 1, length - name_length - 1, r->value[which], VALUE_CAPACITY))
        return nook_fail(NOOK_E_FORMAT, "%s: header field '%.*s' is too long", r->name, (int)name_length, line);
    return NOOK_OK;
}

static bool is_list(const reader *r)
{
    return r->present[FIELD_DATA_FILE] && strncmp(r->value[FIELD_DATA_FILE], "LIST", 4) == 0;
}

/* Up to the blank line, the end of the file, or the names of a list of data files. */
static nook_result read_lines(reader *r)
{
    const char *line;
    size_t length;
    if (!nook_nrrd_next_line(&r->at, r->end, &line, &length) || length != 8 || memcmp(line, "NRRD000", 7) != 0 ||
        line[7] < '1' || line[7] > '5')
        return nook_fail(NOOK_E_FORMAT, "%s: not an NRRD file of version 1 to 5", r->name);
    while (!is_list(r) && nook_nrrd_next_line(&r->at, r->end, &line, &length)) {
        if (length == 0) {
            r->blank_line = true;
            return NOOK_OK;
        }
        nook_result result = read_line(r, line, length);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

/* ---- Numbers ---------------------------------------------------------------------------------------------------- */

bool nook_nrrd_take_number(const char **text, int64_t *out)
{
    char *stop;
    if (!isdigit((unsigned char)**text) && !(**text == '-' && isdigit((unsigned char)(*text)[1])))
        return false;
    long long value = strtoll(*text, &stop, 10); /* saturates, and no limit here is near that */
    if (*stop != 0 && !isspace((unsigned char)*stop))
        return false;
    while (isspace((unsigned char)*stop))
        stop++;
    *text = stop;
    *out = value;
    return true;
}

static bool read_number(const char *text, int64_t low, int64_t high, int64_t *out)
{
    return nook_nrrd_take_number(&text, out) && *text == 0 && *out >= low && *out <= high;
}

static nook_result read_sizes(const reader *r, nook_nrrd_header *header)
{
    const char *text = r->value[FIELD_SIZES];
    int64_t dimension;
    if (!read_number(r->value[FIELD_DIMENSION], 1, NOOK_NRRD_DIMENSION_MAX, &dimension))
        return nook_fail(NOOK_E_FORMAT, "%s: dimension '%s'; 1 to 4 are read", r->name, r->value[FIELD_DIMENSION]);
    header->dimension = (uint32_t)dimension;
    header->data_bytes = nook_sample_type_size(header->type);
    for (uint32_t axis = 0; axis < header->dimension; axis++) {
        int64_t size;
        if (!nook_nrrd_take_number(&text, &size) || size < 1)
            return nook_fail(NOOK_E_FORMAT, "%s: sizes '%s' are not %u numbers above 0", r->name, r->value[FIELD_SIZES],
                             header->dimension);
        if ((uint64_t)size > NOOK_SCALAR_BYTES_MAX / header->data_bytes)
            return nook_fail(NOOK_E_FORMAT, "%s: sizes '%s': more than %llu bytes of samples", r->name,
                             r->value[FIELD_SIZES], (unsigned long long)NOOK_SCALAR_BYTES_MAX);
        header->sizes[axis] = (uint32_t)size;
        header->data_bytes *= (uint64_t)size;
    }
    if (*text != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: sizes '%s' are more than %u numbers", r->name, r->value[FIELD_SIZES],
                         header->dimension);
    return NOOK_OK;
}

/* ---- Spacing ---------------------------------------------------------------------------------------------------- */

/* Reads a number, which may be nan or inf, and moves on behind it and the blanks that follow. */
static bool take_double(const char **text, double *out)
{
    char *stop;
    *out = strtod(*text, &stop);
    if (stop == *text)
        return false;
    while (isspace((unsigned char)*stop))
        stop++;
    *text = stop;
    return true;
}

/* "(x,y,z)": the length of the step. */
static bool take_direction(const char **text, double *out_length, bool *out_slanted)
{
    const char *at = *text + 1;
    double squared = 0.0;
    int along = 0;
    for (;;) {
        double part;
        if (!take_double(&at, &part))
            return false;
        squared += part * part;
        along += part != 0.0;
        if (*at != ',')
            break;
        at++;
    }
    if (*at != ')')
        return false;
    *out_length = sqrt(squared);
    *out_slanted = *out_slanted || along > 1;
    *text = at + 1;
    return true;
}

static bool take_step(const char **text, double *out_step, bool *out_slanted)
{
    bool taken;
    if (strncmp(*text, "none", 4) == 0) {
        *out_step = NAN;
        *text += 4;
        taken = true;
    } else {
        taken = **text == '(' ? take_direction(text, out_step, out_slanted) : take_double(text, out_step);
    }
    while (isspace((unsigned char)**text))
        ++*text;
    return taken;
}

/* "spacings", else "space directions", else 1; an axis whose step is not known (nan, none) has 1 too. */
static nook_result read_spacing(const reader *r, nook_nrrd_header *header)
{
    field which = r->present[FIELD_SPACINGS] ? FIELD_SPACINGS : FIELD_SPACE_DIRECTIONS;
    const char *text = r->value[which];
    bool slanted = false;
    for (uint32_t axis = 0; axis < header->dimension; axis++) {
        double step = NAN;
        if (r->present[which] && !take_step(&text, &step, &slanted))
            return nook_fail(NOOK_E_FORMAT, "%s: spacing '%s' is not %u steps", r->name, r->value[which],
                             header->dimension);
        if (isinf(step) || step == 0.0)
            return nook_fail(NOOK_E_FORMAT, "%s: the spacing of axis %u is %g", r->name, axis, step);
        if (step < 0.0)
            nook_scene_warn(r->scene, "%s: the spacing of axis %u is %g; its sign is left out", r->name, axis, step);
        header->spacing[axis] = isnan(step) ? 1.0 : fabs(step);
    }
    if (*text != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: spacing '%s' is more than %u steps", r->name, r->value[which],
                         header->dimension);
    if (slanted)
        nook_scene_warn(r->scene, "%s: its space directions turn the volume; only their lengths are used", r->name);
    return NOOK_OK;
}

/* ---- The whole -------------------------------------------------------------------------------------------------- */

static bool this_machine_is_big_endian(void)
{
    const uint16_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 0;
}

static nook_result read_endian(const reader *r, nook_nrrd_header *header)
{
    int endian = find_word(endian_words, NOOK_COUNT(endian_words), r->value[FIELD_ENDIAN], ENDIAN_UNKNOWN);
    bool matters = header->encoding != NOOK_NRRD_TEXT && nook_sample_type_size(header->type) > 1;
    if (endian == ENDIAN_UNKNOWN && (matters || r->present[FIELD_ENDIAN]))
        return nook_fail(NOOK_E_FORMAT, "%s: 'endian: little' or 'endian: big' is missing", r->name);
    header->swapped = matters && (endian == ENDIAN_BIG) != this_machine_is_big_endian();
    return NOOK_OK;
}

static nook_result read_words(const reader *r, nook_nrrd_header *header)
{
    static const field needed[] = { FIELD_TYPE, FIELD_DIMENSION, FIELD_SIZES, FIELD_ENCODING };
    static const char *const names[] = { "type", "dimension", "sizes", "encoding" };
    for (size_t i = 0; i < NOOK_COUNT(needed); i++)
        if (!r->present[needed[i]])
            return nook_fail(NOOK_E_FORMAT, "%s: the header has no field '%s'", r->name, names[i]);
    int type = find_word(type_words, NOOK_COUNT(type_words), r->value[FIELD_TYPE], NOOK_SAMPLE_TYPE_COUNT);
    if (type == NOOK_SAMPLE_TYPE_COUNT)
        return nook_fail(NOOK_E_FORMAT, "%s: type '%s' is not read", r->name, r->value[FIELD_TYPE]);
    int encoding =
        find_word(encoding_words, NOOK_COUNT(encoding_words), r->value[FIELD_ENCODING], NOOK_NRRD_ENCODING_COUNT);
    if (encoding == NOOK_NRRD_ENCODING_COUNT)
        return nook_fail(NOOK_E_FORMAT, "%s: encoding '%s' is not read", r->name, r->value[FIELD_ENCODING]);
    header->type = (nook_sample_type)type;
    header->encoding = (nook_nrrd_encoding)encoding;
    return NOOK_OK;
}

static nook_result read_skips(const reader *r, nook_nrrd_header *header)
{
    const char *lines = r->value[FIELD_LINE_SKIP], *bytes = r->value[FIELD_BYTE_SKIP];
    if ((r->present[FIELD_LINE_SKIP] && !read_number(lines, 0, INT32_MAX, &header->line_skip)) ||
        (r->present[FIELD_BYTE_SKIP] && !read_number(bytes, -1, INT32_MAX, &header->byte_skip)))
        return nook_fail(NOOK_E_FORMAT, "%s: line skip '%s' or byte skip '%s' is not a number of lines or bytes",
                         r->name, lines, bytes);
    if (header->byte_skip < 0 && header->encoding != NOOK_NRRD_RAW)
        return nook_fail(NOOK_E_FORMAT, "%s: byte skip -1 goes with raw data only", r->name);
    return NOOK_OK;
}

static nook_result read_header(reader *r, nook_nrrd_header *header)
{
    nook_result result = read_lines(r);
    if (result == NOOK_OK)
        result = read_words(r, header);
    if (result == NOOK_OK)
        result = read_sizes(r, header);
    if (result == NOOK_OK)
        result = read_endian(r, header);
    if (result == NOOK_OK)
        result = read_skips(r, header);
    if (result == NOOK_OK)
        result = read_spacing(r, header);
    if (result == NOOK_OK && !r->present[FIELD_DATA_FILE] && !r->blank_line)
        result = nook_fail(NOOK_E_FORMAT, "%s: the header has no blank line at its end, and no data follow", r->name);
    return result;
}

nook_result nook_nrrd_header_read(const char *name, nook_scene *scene, const uint8_t *bytes, size_t size,
                                  nook_nrrd_header *out_header)
{
    reader *r = calloc(1, sizeof *r);
    if (!r)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to read its header", name);
    r->name = name;
    r->scene = scene;
    r->at = (const char *)bytes;
    r->end = r->at + size;
    nook_nrrd_header header = { 0 };
    nook_result result = read_header(r, &header);
    if (result == NOOK_OK) {
        header.detached = r->present[FIELD_DATA_FILE];
        memcpy(header.data_file, r->value[FIELD_DATA_FILE], VALUE_CAPACITY);
        header.rest = (size_t)((const uint8_t *)r->at - bytes);
        *out_header = header;
    }
    free(r);
    return result;
}
