/* The container: plain JSON text, or GLB with its chunks. Sizes are compared in 64 bits, where nothing wraps. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/scene_internal.h"
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { HEADER_SIZE = 12, CHUNK_HEADER_SIZE = 8 };
#define GLB_MAGIC 0x46546C67u
#define CHUNK_JSON 0x4E4F534Au
#define CHUNK_BIN 0x004E4942u

static uint32_t read_u32(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static nook_result check_glb_header(nook_gltf *gltf, uint64_t *out_length)
{
    const nook_file *file = &gltf->source.file;
    if (file->size < HEADER_SIZE)
        return nook_fail(NOOK_E_FORMAT, "%s: %zu bytes, shorter than a GLB header (%d)", gltf->path, file->size,
                         HEADER_SIZE);
    if (read_u32(file->bytes) != GLB_MAGIC)
        return nook_fail(NOOK_E_FORMAT, "%s: not a GLB file (starts with 0x%08x); give a .gltf or .glb scene",
                         gltf->path, read_u32(file->bytes));
    uint32_t version = read_u32(file->bytes + 4), length = read_u32(file->bytes + 8);
    if (version != 2)
        return nook_fail(NOOK_E_VERSION, "%s: GLB version %u; only version 2 is read, convert it", gltf->path, version);
    if (length > file->size)
        return nook_fail(NOOK_E_FORMAT, "%s: cut off: %zu bytes of the %u its header promises", gltf->path, file->size,
                         length);
    *out_length = length;
    return NOOK_OK;
}

static void take_chunk(nook_gltf_source *source, uint32_t type, const uint8_t *bytes, uint32_t size)
{
    if (type == CHUNK_JSON && !source->json) {
        source->json = (const char *)bytes;
        source->json_size = size;
    } else if (type == CHUNK_BIN && !source->bin) {
        source->bin = bytes;
        source->bin_size = size;
    }
}

static nook_result split_glb(nook_gltf *gltf)
{
    uint64_t length = 0;
    nook_result result = check_glb_header(gltf, &length);
    if (result != NOOK_OK)
        return result;
    const uint8_t *bytes = gltf->source.file.bytes;
    for (uint64_t at = HEADER_SIZE; at < length;) {
        if (length - at < CHUNK_HEADER_SIZE)
            return nook_fail(NOOK_E_FORMAT, "%s: cut off inside a chunk header", gltf->path);
        uint32_t size = read_u32(bytes + at), type = read_u32(bytes + at + 4);
        at += CHUNK_HEADER_SIZE;
        if (size > length - at)
            return nook_fail(NOOK_E_FORMAT, "%s: a chunk of %u bytes, %llu are left", gltf->path, size,
                             (unsigned long long)(length - at));
        if (!gltf->source.json && type != CHUNK_JSON)
            return nook_fail(NOOK_E_FORMAT, "%s: the first chunk is not JSON", gltf->path);
        take_chunk(&gltf->source, type, bytes + at, size);
        at += size;
    }
    if (!gltf->source.json)
        return nook_fail(NOOK_E_FORMAT, "%s: GLB without a JSON chunk", gltf->path);
    if (length < gltf->source.file.size) /* last: a file that is refused gets one line */
        nook_scene_warn(gltf->scene, "%s: %zu bytes after the end of the GLB are ignored", gltf->path,
                        gltf->source.file.size - (size_t)length);
    return NOOK_OK;
}

/* What does not start like JSON is another kind of file, of which a JSON reader's words would be a riddle. */
static nook_result open_json(nook_gltf *gltf)
{
    nook_gltf_source *source = &gltf->source;
    source->json = (const char *)source->file.bytes;
    source->json_size = source->file.size;
    if (source->json_size >= 3 && memcmp(source->json, "\xEF\xBB\xBF", 3) == 0) {
        source->json += 3; /* a byte order mark: not allowed, harmless */
        source->json_size -= 3;
    }
    size_t blanks = strspn(source->json, " \t\r\n"); /* ends at the zero byte behind the file */
    if (blanks == source->json_size || (source->json[blanks] != '{' && source->json[blanks] != '['))
        return nook_fail(NOOK_E_FORMAT,
                         "%s: not a glTF scene; give a .gltf or .glb file (.nkv and .nrrd files: ./nook info)",
                         gltf->path);
    return NOOK_OK;
}

nook_result nook_gltf_open_source(nook_gltf *gltf)
{
    nook_gltf_source *source = &gltf->source;
    nook_result result = nook_file_read(gltf->path, &source->file);
    if (result != NOOK_OK)
        return result;
    if (source->file.size == 0)
        return nook_fail(NOOK_E_FORMAT, "%s: is empty; give a .gltf or .glb scene", gltf->path);
    bool named_glb = strcasecmp(nook_path_extension(gltf->path), ".glb") == 0;
    if (named_glb || (source->file.size >= 4 && read_u32(source->file.bytes) == GLB_MAGIC))
        return split_glb(gltf);
    return open_json(gltf);
}

void nook_gltf_close(nook_gltf *gltf)
{
    for (uint32_t i = 0; i < gltf->buffer_count; i++)
        nook_gltf_bytes_free(&gltf->buffers[i]);
    free(gltf->buffers);
    for (uint32_t i = 0; gltf->origins && i <= gltf->scene->primitive_count; i++) /* the last one was being read */
        free(gltf->origins[i].source_vertices);
    free(gltf->origins);
    free(gltf->scene_nodes);
    free(gltf->file_nodes);
    nook_gltf_model_free(gltf->model);
    nook_json_tree_free(&gltf->json);
    nook_file_free(&gltf->source.file);
}
