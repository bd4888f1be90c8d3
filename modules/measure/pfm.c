#include "modules/measure/pfm.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

nook_result nook_grey_create(uint32_t width, uint32_t height, nook_grey *out_grey)
{
    if (width == 0 || height == 0 || width > NOOK_PFM_SIDE_MAX || height > NOOK_PFM_SIDE_MAX)
        return nook_fail(NOOK_E_RANGE, "a float picture of %u x %u pixels: sides go from 1 to %u", width, height,
                         NOOK_PFM_SIDE_MAX);
    float *values = calloc((size_t)width * height, sizeof *values);
    if (!values)
        return nook_fail(NOOK_E_MEMORY, "no memory for a float picture of %u x %u pixels", width, height);
    *out_grey = (nook_grey){ values, width, height };
    return NOOK_OK;
}

void nook_grey_free(nook_grey *grey)
{
    if (!grey)
        return;
    free(grey->values);
    *grey = (nook_grey){ 0 };
}

/* Byte by byte, so that the file is the same whatever the byte order of the machine. */
static void store_float(uint8_t *to, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(bits >> (8 * i));
}

static float load_float(const uint8_t *from, bool little_endian)
{
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)from[little_endian ? i : 3 - i] << (8 * i);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

nook_result nook_pfm_write(const nook_grey *grey, const char *path)
{
    char header[64];
    int length = snprintf(header, sizeof header, "Pf\n%u %u\n-1.0\n", grey->width, grey->height);
    size_t count = (size_t)grey->width * grey->height;
    size_t size = (size_t)length + count * 4;
    uint8_t *bytes = malloc(size);
    if (!bytes)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu bytes", path, size);
    memcpy(bytes, header, (size_t)length);
    for (size_t i = 0; i < count; i++)
        store_float(bytes + length + i * 4, grey->values[i]);
    nook_result result = nook_file_write(path, bytes, size);
    free(bytes);
    return result;
}

/* Where the header's last line ends, with its numbers; 0 when it is not a header of a grey file. */
static size_t parse_header(const nook_file *file, unsigned *out_width, unsigned *out_height, double *out_scale)
{
    int used = 0;
    if (file->size < 3 || memcmp(file->bytes, "Pf", 2) != 0 || !isspace(file->bytes[2]))
        return 0;
    /* nook_file_read puts a zero byte behind the file, so sscanf stops there at the latest. */
    if (sscanf((const char *)file->bytes + 2, "%5u %5u %32lf%n", out_width, out_height, out_scale, &used) != 3)
        return 0;
    size_t end = 2 + (size_t)used;
    if (!isfinite(*out_scale) || *out_scale == 0.0 || !isspace(file->bytes[end]))
        return 0;
    return end + 1; /* exactly one white space byte stands before the floats */
}

static nook_result decode(const char *path, const nook_file *file, nook_grey *out_grey)
{
    unsigned width = 0, height = 0;
    double scale = 0.0;
    size_t header = parse_header(file, &width, &height, &scale);
    if (header == 0)
        return nook_fail(NOOK_E_FORMAT, "%s: not a grey PFM file (\"Pf\", width, height, scale)", path);
    if (width == 0 || height == 0 || width > NOOK_PFM_SIDE_MAX || height > NOOK_PFM_SIDE_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: %u x %u pixels; sides go from 1 to %u", path, width, height,
                         NOOK_PFM_SIDE_MAX);
    size_t count = (size_t)width * height;
    if (file->size - header != count * 4)
        return nook_fail(NOOK_E_FORMAT, "%s: %zu bytes of pixels, its header promises %zu", path, file->size - header,
                         count * 4);
    nook_grey grey;
    nook_result result = nook_grey_create(width, height, &grey);
    if (result != NOOK_OK)
        return result;
    for (size_t i = 0; i < count; i++)
        grey.values[i] = load_float(file->bytes + header + i * 4, scale < 0.0);
    *out_grey = grey;
    return NOOK_OK;
}

nook_result nook_pfm_read(const char *path, nook_grey *out_grey)
{
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    result = decode(path, &file, out_grey);
    nook_file_free(&file);
    return result;
}
