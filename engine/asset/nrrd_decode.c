#include "engine/asset/nrrd_internal.h"
#include "engine/asset/scene_internal.h"
#include "engine/core/log.h"
#include <bzlib.h>
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* zlib and bzip2 count in 32 bits: larger buffers are handed over in parts. */
static const size_t part_max = (size_t)1 << 30;

static unsigned part_of(size_t size)
{
    return (unsigned)(size < part_max ? size : part_max);
}

static nook_result fail_short(const char *name, size_t got, size_t wanted)
{
    return nook_fail(NOOK_E_FORMAT, "%s: cut short: %zu of %zu bytes of samples", name, got, wanted);
}

static void warn_of_rest(const char *name, nook_scene *scene)
{
    nook_scene_warn(scene, "%s: the data behind the last sample are left out", name);
}

/* ---- raw -------------------------------------------------------------------------------------------------------- */

static nook_result decode_raw(const char *name, nook_scene *scene, int64_t byte_skip, const uint8_t *stored,
                              size_t stored_size, uint8_t *out, size_t out_size)
{
    if (stored_size < out_size)
        return fail_short(name, stored_size, out_size);
    size_t spare = stored_size - out_size;
    if (byte_skip >= 0 && (uint64_t)byte_skip > spare)
        return nook_fail(NOOK_E_FORMAT, "%s: cut short: %zu bytes behind %lld skipped ones are wanted", name, out_size,
                         (long long)byte_skip);
    size_t skip = byte_skip < 0 ? spare : (size_t)byte_skip;
    if (spare > skip)
        warn_of_rest(name, scene);
    memcpy(out, stored + skip, out_size);
    return NOOK_OK;
}

/* ---- hex -------------------------------------------------------------------------------------------------------- */

static int digit_of(uint8_t c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

static nook_result decode_hex(const char *name, const uint8_t *stored, size_t stored_size, uint8_t *out,
                              size_t out_size)
{
    size_t digits = 0;
    for (size_t i = 0; i < stored_size && digits < out_size * 2; i++) {
        int digit = digit_of(stored[i]);
        if (digit < 0 && !isspace(stored[i]))
            return nook_fail(NOOK_E_FORMAT, "%s: byte 0x%02x is no hexadecimal digit", name, stored[i]);
        if (digit < 0)
            continue;
        out[digits / 2] = (uint8_t)(digits % 2 ? out[digits / 2] | digit : digit << 4);
        digits++;
    }
    return digits == out_size * 2 ? NOOK_OK : fail_short(name, digits / 2, out_size);
}

/* ---- text ------------------------------------------------------------------------------------------------------- */

static bool store_integer(int64_t value, int64_t low, int64_t high, size_t size, uint8_t *out)
{
    if (value < low || value > high)
        return false;
    int8_t i8 = (int8_t)value;
    int16_t i16 = (int16_t)value; /* the bits of an unsigned one are the same */
    int32_t i32 = (int32_t)value;
    memcpy(out, size == 1 ? (void *)&i8 : size == 2 ? (void *)&i16 : size == 4 ? (void *)&i32 : (void *)&value, size);
    return true;
}

/* Reads one number of `type` at `text`. @return behind it, or NULL when there is none or it does not fit */
static const char *read_sample(const char *text, nook_sample_type type, uint8_t *out)
{
    char *stop;
    size_t size = nook_sample_type_size(type);
    errno = 0;
    if (type == NOOK_SAMPLE_F32 || type == NOOK_SAMPLE_F64) {
        double value = strtod(text, &stop);
        float narrow = (float)value;
        memcpy(out, type == NOOK_SAMPLE_F32 ? (void *)&narrow : (void *)&value, size);
        return stop == text ? NULL : stop;
    }
    if (type == NOOK_SAMPLE_U64) {
        uint64_t value = strtoull(text, &stop, 10);
        memcpy(out, &value, size);
        return stop == text || errno == ERANGE || *text == '-' ? NULL : stop;
    }
    int bits = (int)size * 8;
    bool is_signed =
        type == NOOK_SAMPLE_I8 || type == NOOK_SAMPLE_I16 || type == NOOK_SAMPLE_I32 || type == NOOK_SAMPLE_I64;
    int64_t high = is_signed ? INT64_MAX >> (64 - bits) : INT64_MAX >> (63 - bits), low = is_signed ? -high - 1 : 0;
    int64_t value = strtoll(text, &stop, 10);
    bool read = stop != text && errno != ERANGE && store_integer(value, low, high, size, out);
    return read ? stop : NULL;
}

static const char *skip_separators(const char *at)
{
    while (isspace((unsigned char)*at) || *at == ',')
        at++;
    return at;
}

/* Of what stands in a message, which is one line: no more than the word. */
static int word_length(const char *at)
{
    int length = 0;
    while (length < 16 && isgraph((unsigned char)at[length]) && at[length] != ',')
        length++;
    return length;
}

static nook_result decode_text(const char *name, nook_sample_type type, const uint8_t *stored, uint8_t *out,
                               size_t out_size)
{
    /* The zero byte behind `stored` ends the last number. */
    const char *at = (const char *)stored;
    size_t size = nook_sample_type_size(type), count = out_size / size;
    for (size_t i = 0; i < count; i++) {
        at = skip_separators(at);
        if (*at == 0)
            return fail_short(name, i * size, out_size);
        const char *stop = read_sample(at, type, out + i * size);
        if (!stop || (*stop != 0 && *stop != ',' && !isspace((unsigned char)*stop)))
            return nook_fail(NOOK_E_FORMAT, "%s: sample %zu of %zu, '%.*s', is not a number of its type", name, i + 1,
                             count, word_length(at), at);
        at = stop;
    }
    return NOOK_OK;
}

/* ---- gzip and bzip2 --------------------------------------------------------------------------------------------- */

/* Where a stream stands: what is left to read, and to write. */
typedef struct flow {
    const uint8_t *in;
    size_t in_left;
    uint8_t *out;
    size_t out_left;
} flow;

typedef enum flow_state { FLOW_GOES_ON, FLOW_ENDED, FLOW_BROKEN } flow_state;

static flow_state step_gzip(void *stream, flow *f)
{
    z_stream *z = stream;
    unsigned in = part_of(f->in_left), out = part_of(f->out_left);
    z->next_in = (Bytef *)(uintptr_t)f->in; /* zlib's pointer is not const, but it only reads */
    z->avail_in = in;
    z->next_out = f->out;
    z->avail_out = out;
    int code = inflate(z, Z_NO_FLUSH);
    f->in += in - z->avail_in, f->in_left -= in - z->avail_in;
    f->out += out - z->avail_out, f->out_left -= out - z->avail_out;
    if (code == Z_STREAM_END) /* another member may follow: files can be joined */
        return f->in_left > 0 && inflateReset(z) == Z_OK ? FLOW_GOES_ON : FLOW_ENDED;
    return code == Z_OK ? FLOW_GOES_ON : FLOW_BROKEN;
}

static flow_state step_bzip2(void *stream, flow *f)
{
    bz_stream *b = stream;
    unsigned in = part_of(f->in_left), out = part_of(f->out_left);
    b->next_in = (char *)(uintptr_t)f->in;
    b->avail_in = in;
    b->next_out = (char *)f->out;
    b->avail_out = out;
    int code = BZ2_bzDecompress(b);
    bool moved = b->avail_in != in || b->avail_out != out;
    f->in += in - b->avail_in, f->in_left -= in - b->avail_in;
    f->out += out - b->avail_out, f->out_left -= out - b->avail_out;
    if (code == BZ_STREAM_END)
        return FLOW_ENDED;
    return code == BZ_OK && moved ? FLOW_GOES_ON : FLOW_BROKEN;
}

typedef flow_state (*flow_step)(void *stream, flow *f);

/* Fills `size` bytes. @return false when the stream ends or breaks before */
static bool fill(flow_step step, void *stream, flow *f, uint8_t *out, size_t size, flow_state *state)
{
    f->out = out;
    f->out_left = size;
    while (f->out_left > 0 && *state == FLOW_GOES_ON)
        *state = step(stream, f);
    return f->out_left == 0;
}

static nook_result decode_stream(const char *name, nook_scene *scene, flow_step step, void *stream, int64_t byte_skip,
                                 flow f, uint8_t *out, size_t out_size)
{
    uint8_t scrap[4096];
    flow_state state = FLOW_GOES_ON;
    for (int64_t left = byte_skip; left > 0;) {
        size_t part = left < (int64_t)sizeof scrap ? (size_t)left : sizeof scrap;
        if (!fill(step, stream, &f, scrap, part, &state))
            return nook_fail(NOOK_E_FORMAT, "%s: its compressed data end before byte skip %lld", name,
                             (long long)byte_skip);
        left -= (int64_t)part;
    }
    if (!fill(step, stream, &f, out, out_size, &state)) {
        if (state == FLOW_BROKEN && f.in_left > 0)
            return nook_fail(NOOK_E_FORMAT, "%s: its compressed data are damaged", name);
        return fail_short(name, out_size - f.out_left, out_size);
    }
    /* The checksum comes behind the last sample, or there is a sample too many; nothing beyond that is inflated. */
    if (fill(step, stream, &f, scrap, 1, &state))
        warn_of_rest(name, scene);
    else if (state == FLOW_BROKEN)
        return nook_fail(NOOK_E_FORMAT, "%s: its compressed data are damaged at the end", name);
    return NOOK_OK;
}

static nook_result decode_gzip(const char *name, nook_scene *scene, int64_t byte_skip, flow f, uint8_t *out,
                               size_t out_size)
{
    z_stream stream = { 0 };
    if (inflateInit2(&stream, 15 + 32) != Z_OK) /* 15: the largest window; 32: gzip or zlib header */
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to inflate", name);
    nook_result result = decode_stream(name, scene, step_gzip, &stream, byte_skip, f, out, out_size);
    inflateEnd(&stream);
    return result;
}

static nook_result decode_bzip2(const char *name, nook_scene *scene, int64_t byte_skip, flow f, uint8_t *out,
                                size_t out_size)
{
    bz_stream stream = { 0 };
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to decompress", name);
    nook_result result = decode_stream(name, scene, step_bzip2, &stream, byte_skip, f, out, out_size);
    BZ2_bzDecompressEnd(&stream);
    return result;
}

/* ---- The whole -------------------------------------------------------------------------------------------------- */

static void swap_bytes(uint8_t *samples, size_t size, size_t sample_size)
{
    for (uint8_t *s = samples; s < samples + size; s += sample_size)
        for (size_t i = 0; i < sample_size / 2; i++) {
            uint8_t byte = s[i];
            s[i] = s[sample_size - 1 - i];
            s[sample_size - 1 - i] = byte;
        }
}

static nook_result decode(const char *name, nook_scene *scene, const nook_nrrd_header *header, const uint8_t *stored,
                          size_t stored_size, uint8_t *out, size_t out_size)
{
    bool compressed = header->encoding == NOOK_NRRD_GZIP || header->encoding == NOOK_NRRD_BZIP2;
    flow f = { .in = stored, .in_left = stored_size };
    if (compressed) /* its byte skip counts decompressed bytes */
        return header->encoding == NOOK_NRRD_GZIP ? decode_gzip(name, scene, header->byte_skip, f, out, out_size)
                                                  : decode_bzip2(name, scene, header->byte_skip, f, out, out_size);
    if (header->encoding == NOOK_NRRD_RAW)
        return decode_raw(name, scene, header->byte_skip, stored, stored_size, out, out_size);
    if ((uint64_t)header->byte_skip > stored_size)
        return nook_fail(NOOK_E_FORMAT, "%s: byte skip %lld goes past the end", name, (long long)header->byte_skip);
    stored += header->byte_skip;
    stored_size -= (size_t)header->byte_skip;
    return header->encoding == NOOK_NRRD_HEX ? decode_hex(name, stored, stored_size, out, out_size)
                                             : decode_text(name, header->type, stored, out, out_size);
}

nook_result nook_nrrd_decode(const char *name, nook_scene *scene, const nook_nrrd_header *header, const uint8_t *stored,
                             size_t stored_size, uint8_t *out, size_t out_size)
{
    const uint8_t *end = stored + stored_size;
    for (int64_t i = 0; i < header->line_skip; i++) {
        const uint8_t *newline = memchr(stored, '\n', (size_t)(end - stored));
        if (!newline)
            return nook_fail(NOOK_E_FORMAT, "%s: line skip %lld goes past the end", name, (long long)header->line_skip);
        stored = newline + 1;
    }
    nook_result result = decode(name, scene, header, stored, (size_t)(end - stored), out, out_size);
    if (result == NOOK_OK && header->swapped)
        swap_bytes(out, out_size, nook_sample_type_size(header->type));
    return result;
}

uint64_t nook_nrrd_most_decoded(const nook_nrrd_header *header, uint64_t stored_size)
{
    switch (header->encoding) {
    case NOOK_NRRD_TEXT: /* a digit and a blank each */
        return (stored_size + 1) / 2 * nook_sample_type_size(header->type);
    case NOOK_NRRD_HEX:
        return stored_size / 2;
    case NOOK_NRRD_GZIP: /* deflate's limit is 1032 to 1 */
        return stored_size * 1032;
    case NOOK_NRRD_BZIP2: /* has no limit worth naming */
        return UINT64_MAX;
    default:
        return stored_size;
    }
}
