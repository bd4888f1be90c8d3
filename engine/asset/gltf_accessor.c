/* Accessors: every byte that will be read is proved to lie in its buffer, then reading is plain. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/scene_internal.h"
#include <assert.h>
#include <math.h>
#include <string.h>

enum { BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126 };

/* Without a view, a count costs the file nothing; this bounds what it costs us. */
enum { ZERO_COUNT_MAX = 1 << 24 };

static uint32_t component_size(int type)
{
    switch (type) {
    case BYTE:
    case UBYTE:
        return 1;
    case SHORT:
    case USHORT:
        return 2;
    case UINT:
    case FLOAT:
        return 4;
    default:
        return 0;
    }
}

static nook_result check_view(const nook_gltf *gltf, uint32_t index)
{
    const nook_gltf_view *view = &gltf->model->views[index];
    size_t size = gltf->buffers[view->buffer].size;
    if (view->offset + view->length > size)
        return nook_fail(NOOK_E_FORMAT, "%s: bufferViews[%u] ends at byte %llu of buffer %u, which has %zu", gltf->path,
                         index, (unsigned long long)(view->offset + view->length), view->buffer, size);
    if (view->stride % 4 != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: bufferViews[%u] has byteStride %u; expected a multiple of 4", gltf->path,
                         index, view->stride);
    return NOOK_OK;
}

/* Elements of `size` bytes at `offset` of a view. */
static nook_result check_range(const nook_gltf *gltf, uint32_t accessor, uint32_t view_index, uint64_t offset,
                               uint64_t count, uint32_t size, const char *what)
{
    const nook_gltf_view *view = &gltf->model->views[view_index];
    uint64_t stride = view->stride ? view->stride : size;
    if (stride < size)
        return nook_fail(NOOK_E_FORMAT, "%s: accessors[%u] has elements of %u bytes, bufferViews[%u] a stride of %llu",
                         gltf->path, accessor, size, view_index, (unsigned long long)stride);
    uint64_t end = offset + (count - 1) * stride + size; /* below 2^32 + 2^32 * 252 + 16 */
    if (end > view->length)
        return nook_fail(NOOK_E_FORMAT, "%s: %s of accessors[%u] end at byte %llu of bufferViews[%u], which has %llu",
                         gltf->path, what, accessor, (unsigned long long)end, view_index,
                         (unsigned long long)view->length);
    return NOOK_OK;
}

static uint32_t read_index(const uint8_t *p, int type)
{
    uint16_t narrow;
    uint32_t wide;
    switch (type) {
    case UBYTE:
        return *p;
    case USHORT:
        memcpy(&narrow, p, sizeof narrow);
        return narrow;
    default:
        memcpy(&wide, p, sizeof wide);
        return wide;
    }
}

static const uint8_t *view_bytes(const nook_gltf *gltf, uint32_t view, uint64_t offset)
{
    const nook_gltf_view *v = &gltf->model->views[view];
    return gltf->buffers[v->buffer].bytes + v->offset + offset;
}

static nook_result check_sparse(const nook_gltf *gltf, uint32_t index)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[index];
    uint32_t index_size = component_size(a->sparse_index_type);
    uint32_t value_size = component_size(a->component_type) * a->components;
    if (a->sparse_index_type != UBYTE && a->sparse_index_type != USHORT && a->sparse_index_type != UINT)
        return nook_fail(NOOK_E_FORMAT, "%s: accessors[%u].sparse has indices of type %d", gltf->path, index,
                         a->sparse_index_type);
    if (a->sparse_count > a->count)
        return nook_fail(NOOK_E_FORMAT, "%s: accessors[%u].sparse replaces %u of %u elements", gltf->path, index,
                         a->sparse_count, a->count);
    nook_result result = check_range(gltf, index, a->sparse_index_view, a->sparse_index_offset, a->sparse_count,
                                     index_size, "the sparse indices");
    if (result == NOOK_OK)
        result = check_range(gltf, index, a->sparse_value_view, a->sparse_value_offset, a->sparse_count, value_size,
                             "the sparse values");
    if (result != NOOK_OK)
        return result;
    const uint8_t *p = view_bytes(gltf, a->sparse_index_view, a->sparse_index_offset);
    for (uint32_t i = 0; i < a->sparse_count; i++)
        if (read_index(p + (size_t)i * index_size, a->sparse_index_type) >= a->count)
            return nook_fail(NOOK_E_FORMAT, "%s: accessors[%u].sparse replaces element %u of %u", gltf->path, index,
                             read_index(p + (size_t)i * index_size, a->sparse_index_type), a->count);
    return NOOK_OK;
}

static nook_result check_accessor(const nook_gltf *gltf, uint32_t index)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[index];
    uint32_t size = component_size(a->component_type);
    if (!size)
        return nook_fail(NOOK_E_FORMAT, "%s: accessors[%u] has componentType %d", gltf->path, index, a->component_type);
    if (a->components == 0)
        return NOOK_OK; /* nothing that is read has smaller matrices */
    if (a->view == NOOK_GLTF_NONE && a->count > ZERO_COUNT_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: accessors[%u] has %u elements and no data", gltf->path, index, a->count);
    nook_result result = NOOK_OK;
    if (a->view != NOOK_GLTF_NONE)
        result = check_range(gltf, index, a->view, a->offset, a->count, size * a->components, "the elements");
    if (result == NOOK_OK && a->view != NOOK_GLTF_NONE &&
        (a->offset % size || gltf->model->views[a->view].offset % size))
        nook_scene_warn(gltf->scene, "%s: accessors[%u] is not aligned to its %u-byte numbers; read anyway", gltf->path,
                        index, size);
    return result == NOOK_OK && a->sparse_count ? check_sparse(gltf, index) : result;
}

nook_result nook_gltf_check_accessors(nook_gltf *gltf)
{
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; result == NOOK_OK && i < gltf->model->view_count; i++)
        result = check_view(gltf, i);
    for (uint32_t i = 0; result == NOOK_OK && i < gltf->model->accessor_count; i++)
        result = check_accessor(gltf, i);
    return result;
}

/* One element as float; the scale is 1 or makes integers normalised (glTF 2.0, section 3.6.2.2). */
static void read_element(const uint8_t *p, int type, uint32_t components, bool normalized, float *out)
{
    for (uint32_t i = 0; i < components; i++) {
        int8_t byte;
        int16_t narrow;
        switch (type) {
        case BYTE:
            memcpy(&byte, p + i, sizeof byte);
            out[i] = normalized ? fmaxf((float)byte / 127.0f, -1.0f) : (float)byte;
            break;
        case UBYTE:
            out[i] = normalized ? (float)p[i] / 255.0f : (float)p[i];
            break;
        case SHORT:
            memcpy(&narrow, p + 2 * i, sizeof narrow);
            out[i] = normalized ? fmaxf((float)narrow / 32767.0f, -1.0f) : (float)narrow;
            break;
        case USHORT:
            out[i] = (float)read_index(p + 2 * i, type) / (normalized ? 65535.0f : 1.0f);
            break;
        case UINT:
            out[i] = (float)read_index(p + 4 * i, type);
            break;
        default:
            memcpy(&out[i], p + 4 * i, sizeof out[i]);
        }
    }
}

void nook_gltf_read_floats(const nook_gltf *gltf, uint32_t accessor, float *out)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[accessor];
    uint32_t size = component_size(a->component_type) * a->components;
    memset(out, 0, (size_t)a->count * a->components * sizeof *out);
    if (a->view != NOOK_GLTF_NONE) {
        size_t stride = gltf->model->views[a->view].stride ? gltf->model->views[a->view].stride : size;
        const uint8_t *p = view_bytes(gltf, a->view, a->offset);
        for (size_t i = 0; i < a->count; i++)
            read_element(p + i * stride, a->component_type, a->components, a->normalized, out + i * a->components);
    }
    for (uint32_t i = 0; i < a->sparse_count; i++) {
        size_t index_size = component_size(a->sparse_index_type);
        uint32_t at = read_index(view_bytes(gltf, a->sparse_index_view, a->sparse_index_offset) + i * index_size,
                                 a->sparse_index_type);
        read_element(view_bytes(gltf, a->sparse_value_view, a->sparse_value_offset) + (size_t)i * size,
                     a->component_type, a->components, a->normalized, out + (size_t)at * a->components);
    }
}

void nook_gltf_read_indices(const nook_gltf *gltf, uint32_t accessor, uint32_t *out)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[accessor];
    uint32_t size = component_size(a->component_type);
    assert(a->components == 1);
    memset(out, 0, (size_t)a->count * sizeof *out);
    if (a->view != NOOK_GLTF_NONE) {
        size_t stride = gltf->model->views[a->view].stride ? gltf->model->views[a->view].stride : size;
        const uint8_t *p = view_bytes(gltf, a->view, a->offset);
        for (size_t i = 0; i < a->count; i++)
            out[i] = read_index(p + i * stride, a->component_type);
    }
    for (uint32_t i = 0; i < a->sparse_count; i++) {
        size_t index_size = component_size(a->sparse_index_type);
        uint32_t at = read_index(view_bytes(gltf, a->sparse_index_view, a->sparse_index_offset) + i * index_size,
                                 a->sparse_index_type);
        out[at] = read_index(view_bytes(gltf, a->sparse_value_view, a->sparse_value_offset) + (size_t)i * size,
                             a->component_type);
    }
}
