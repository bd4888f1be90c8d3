/* URIs: which ones may be opened, and their bytes. A scene from anywhere must not read files outside its folder. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/scene_internal.h"
#include <assert.h>
#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_CAPACITY = 4096, SHOWN = 60 };

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    return isxdigit((unsigned char)c) ? tolower((unsigned char)c) - 'a' + 10 : -1;
}

/* Resolves %41 in place; anything else after % stays. @return the new length */
static size_t percent_decode(char *text, size_t length)
{
    size_t to = 0;
    for (size_t from = 0; from < length; to++) {
        bool escape =
            text[from] == '%' && length - from > 2 && hex_digit(text[from + 1]) >= 0 && hex_digit(text[from + 2]) >= 0;
        text[to] = escape ? (char)(hex_digit(text[from + 1]) * 16 + hex_digit(text[from + 2])) : text[from];
        from += escape ? 3 : 1;
    }
    text[to] = '\0';
    return to;
}

static bool has_scheme(const char *uri)
{
    size_t i = 0;
    while (isalnum((unsigned char)uri[i]) || (uri[i] && strchr("+-.", uri[i])))
        i++;
    return i > 0 && uri[i] == ':';
}

static bool climbs(const char *path)
{
    for (const char *segment = path; segment;) {
        size_t length = strcspn(segment, "/\\");
        if (length == 2 && segment[0] == '.' && segment[1] == '.')
            return true;
        segment = segment[length] ? segment + length + 1 : NULL;
    }
    return false;
}

/* What forbids this decoded, relative reference; NULL when it may be opened. */
static const char *forbidden(const char *path, size_t length)
{
    if (length == 0)
        return "is empty";
    if (strlen(path) != length)
        return "holds a NUL character";
    if (path[0] == '/' || path[0] == '\\')
        return "is an absolute path; only files in the scene's own folder are read";
    if (has_scheme(path))
        return "has a scheme; only data: and files in the scene's own folder are read";
    if (climbs(path))
        return "climbs out of the scene's folder with '..'; put the file beside the scene";
    return NULL;
}

static bool is_data(const char *uri)
{
    return strncmp(uri, "data:", 5) == 0;
}

NOOK_PRINTF(3, 4)
static nook_result refuse(nook_result code, nook_gltf_reason *out_reason, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out_reason->text, sizeof out_reason->text, format, arguments);
    va_end(arguments);
    for (char *c = out_reason->text; *c; c++) /* a uri can hold anything; keep the message on one line */
        if (iscntrl((unsigned char)*c))
            *c = '?';
    return code;
}

static nook_result decode_uri(const nook_gltf *gltf, uint32_t uri, char **out_text, nook_gltf_reason *out_reason)
{
    size_t length = 0;
    char *text = nook_json_tree_copy_string(&gltf->json, uri, &length);
    if (!text)
        return refuse(NOOK_E_MEMORY, out_reason, "does not fit into memory");
    const char *reason = NULL;
    if (!is_data(text)) {
        reason = has_scheme(text) ? forbidden(text, length) : NULL;
        length = percent_decode(text, length);
        reason = reason ? reason : forbidden(text, length);
    }
    if (reason) {
        refuse(NOOK_E_FORMAT, out_reason, "its uri '%.*s' %s", SHOWN, text, reason);
        free(text);
        return NOOK_E_FORMAT;
    }
    *out_text = text;
    return NOOK_OK;
}

nook_result nook_gltf_check_uri(const nook_gltf *gltf, const char *what, uint32_t uri)
{
    char *text = NULL;
    nook_gltf_reason reason;
    nook_result result = decode_uri(gltf, uri, &text, &reason);
    if (result != NOOK_OK)
        return nook_fail(result, "%s: %s: %s", gltf->path, what, reason.text);
    free(text);
    return NOOK_OK;
}

static int base64_digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = c ? strchr(digits, c) : NULL;
    return found ? (int)(found - digits) : -1;
}

/* Decodes in place (the result is shorter). @return its length, or SIZE_MAX when it is not base64 */
static size_t base64_decode(char *text)
{
    size_t length = strlen(text), to = 0;
    while (length > 0 && text[length - 1] == '=')
        length--;
    if (length % 4 == 1)
        return SIZE_MAX;
    uint32_t bits = 0;
    for (size_t i = 0; i < length; i++) {
        int digit = base64_digit(text[i]);
        if (digit < 0)
            return SIZE_MAX;
        bits = bits << 6 | (uint32_t)digit;
        if (i % 4 == 3 || i + 1 == length) {
            size_t digits = i % 4 + 1, bytes = digits * 6 / 8;
            bits <<= 6 * (4 - digits);
            for (size_t k = 0; k < bytes; k++)
                text[to++] = (char)(bits >> (16 - 8 * k));
            bits = 0;
        }
    }
    return to;
}

/* data:[type];base64,DIGITS. Takes over `text`. */
static nook_result read_data(char *text, nook_gltf_bytes *out_bytes, nook_gltf_reason *out_reason)
{
    char *comma = strchr(text, ',');
    bool base64 = comma && comma - text >= 7 && strncmp(comma - 7, ";base64", 7) == 0;
    size_t size = base64 ? base64_decode(comma + 1) : SIZE_MAX;
    if (size == SIZE_MAX) {
        free(text);
        return refuse(NOOK_E_FORMAT, out_reason, "its data uri is %s",
                      !comma    ? "without data"
                      : !base64 ? "not marked as base64"
                                : "broken base64");
    }
    *out_bytes = (nook_gltf_bytes){ (const uint8_t *)comma + 1, size, (uint8_t *)text };
    return NOOK_OK;
}

static nook_result find_beside(const nook_gltf *gltf, const char *name, char *path, size_t capacity,
                               nook_gltf_reason *out_reason)
{
    struct stat info;
    size_t folder = (size_t)(nook_path_name(gltf->path) - gltf->path);
    if (folder + strlen(name) >= capacity)
        return refuse(NOOK_E_FORMAT, out_reason, "its path is too long");
    memcpy(path, gltf->path, folder);
    memcpy(path + folder, name, strlen(name) + 1);
    if (!nook_scene_add_file(gltf->scene, path))
        return refuse(NOOK_E_MEMORY, out_reason, "does not fit into memory");
    /* Looked at before it is opened: opening a device can already do something. */
    if (stat(path, &info) != 0 || access(path, R_OK) != 0)
        return refuse(NOOK_E_NOT_FOUND, out_reason, "its file '%.*s' cannot be read: %s", SHOWN, name, strerror(errno));
    if (!S_ISREG(info.st_mode))
        return refuse(NOOK_E_IO, out_reason, "'%.*s' is not a regular file", SHOWN, name);
    return NOOK_OK;
}

static nook_result read_beside(const nook_gltf *gltf, const char *name, nook_gltf_bytes *out_bytes,
                               nook_gltf_reason *out_reason)
{
    char path[PATH_CAPACITY];
    nook_file file;
    nook_result result = find_beside(gltf, name, path, sizeof path, out_reason);
    if (result != NOOK_OK)
        return result;
    result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return refuse(result, out_reason, "its file '%.*s' could not be read", SHOWN, name);
    *out_bytes = (nook_gltf_bytes){ file.bytes, file.size, file.bytes };
    return NOOK_OK;
}

nook_result nook_gltf_read_uri(const nook_gltf *gltf, uint32_t uri, nook_gltf_bytes *out_bytes,
                               nook_gltf_reason *out_reason)
{
    char *text = NULL;
    nook_result result = decode_uri(gltf, uri, &text, out_reason);
    if (!text)
        return result;
    assert(text);
    if (is_data(text))
        return read_data(text, out_bytes, out_reason);
    result = read_beside(gltf, text, out_bytes, out_reason);
    free(text);
    return result;
}

nook_result nook_gltf_uri_path(const nook_gltf *gltf, uint32_t uri, char *out_path, size_t capacity,
                               nook_gltf_reason *out_reason)
{
    char *text = NULL;
    nook_result result = decode_uri(gltf, uri, &text, out_reason);
    if (!text)
        return result;
    result = is_data(text) ? refuse(NOOK_E_FORMAT, out_reason, "is a data uri; give the name of a file")
                           : find_beside(gltf, text, out_path, capacity, out_reason);
    free(text);
    return result;
}

void nook_gltf_bytes_free(nook_gltf_bytes *bytes)
{
    free(bytes->owned);
    *bytes = (nook_gltf_bytes){ 0 };
}

static nook_result read_buffer(nook_gltf *gltf, uint32_t index, uint32_t object)
{
    nook_gltf_reason reason;
    nook_gltf_bytes *buffer = &gltf->buffers[index];
    uint64_t promised = 0;
    uint32_t uri = nook_json_tree_find(&gltf->json, object, "uri");
    nook_json_tree_integer(&gltf->json, nook_json_tree_find(&gltf->json, object, "byteLength"), &promised);
    if (uri != NOOK_JSON_NONE) {
        nook_result result = nook_gltf_read_uri(gltf, uri, buffer, &reason);
        if (result != NOOK_OK)
            return nook_fail(result, "%s: buffers[%u]: %s", gltf->path, index, reason.text);
    } else if (index == 0 && gltf->source.bin) {
        *buffer = (nook_gltf_bytes){ gltf->source.bin, gltf->source.bin_size, NULL };
    } else {
        return nook_fail(NOOK_E_FORMAT, "%s: buffers[%u] has neither a uri nor a BIN chunk", gltf->path, index);
    }
    if (buffer->size < promised)
        return nook_fail(NOOK_E_FORMAT, "%s: buffers[%u] has %zu bytes, it promises %llu", gltf->path, index,
                         buffer->size, (unsigned long long)promised);
    buffer->size = (size_t)promised;
    return NOOK_OK;
}

nook_result nook_gltf_read_buffers(nook_gltf *gltf)
{
    uint32_t count = nook_gltf_document_count(gltf, "buffers");
    gltf->buffers = nook_scene_allocate(gltf->path, count, sizeof *gltf->buffers);
    if (!gltf->buffers)
        return NOOK_E_MEMORY;
    gltf->buffer_count = count;
    uint32_t object = nook_gltf_document_element(gltf, "buffers", 0);
    for (uint32_t i = 0; i < count; i++, object = gltf->json.values[object].next) {
        nook_result result = read_buffer(gltf, i, object);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}
