#include "engine/asset/scalar_volume.h"
#include "engine/asset/nrrd_internal.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

enum { COMPONENTS_MAX = 16, PATH_CAPACITY = 4096 + 128, NAME_CAPACITY = 2 * PATH_CAPACITY /* an owner's and a path */ };

/* ---- Types ------------------------------------------------------------------------------------------------------ */

static const struct {
    const char *name;
    size_t size;
} types[NOOK_SAMPLE_TYPE_COUNT] = {
    [NOOK_SAMPLE_I8] = { "int8", 1 },     [NOOK_SAMPLE_U8] = { "uint8", 1 },   [NOOK_SAMPLE_I16] = { "int16", 2 },
    [NOOK_SAMPLE_U16] = { "uint16", 2 },  [NOOK_SAMPLE_I32] = { "int32", 4 },  [NOOK_SAMPLE_U32] = { "uint32", 4 },
    [NOOK_SAMPLE_I64] = { "int64", 8 },   [NOOK_SAMPLE_U64] = { "uint64", 8 }, [NOOK_SAMPLE_F32] = { "float32", 4 },
    [NOOK_SAMPLE_F64] = { "float64", 8 },
};

const char *nook_sample_type_name(nook_sample_type type)
{
    return types[type].name;
}

size_t nook_sample_type_size(nook_sample_type type)
{
    return types[type].size;
}

double nook_scalar_volume_sample(const nook_scalar_volume *volume, size_t index)
{
    switch (volume->type) {
    case NOOK_SAMPLE_I8:
        return ((const int8_t *)volume->samples)[index];
    case NOOK_SAMPLE_U8:
        return ((const uint8_t *)volume->samples)[index];
    case NOOK_SAMPLE_I16:
        return ((const int16_t *)volume->samples)[index];
    case NOOK_SAMPLE_U16:
        return ((const uint16_t *)volume->samples)[index];
    case NOOK_SAMPLE_I32:
        return ((const int32_t *)volume->samples)[index];
    case NOOK_SAMPLE_U32:
        return ((const uint32_t *)volume->samples)[index];
    case NOOK_SAMPLE_I64:
        return (double)((const int64_t *)volume->samples)[index];
    case NOOK_SAMPLE_U64:
        return (double)((const uint64_t *)volume->samples)[index];
    case NOOK_SAMPLE_F32:
        return (double)((const float *)volume->samples)[index];
    default:
        return ((const double *)volume->samples)[index];
    }
}

static void measure_range(nook_scalar_volume *volume)
{
    double low = INFINITY, high = -INFINITY;
    volume->not_finite = 0;
    for (size_t i = 0; i < volume->sample_count; i++) {
        double sample = nook_scalar_volume_sample(volume, i);
        if (!isfinite(sample)) {
            volume->not_finite++;
            continue;
        }
        low = sample < low ? sample : low;
        high = sample > high ? sample : high;
    }
    bool any = volume->not_finite < volume->sample_count;
    volume->minimum = any ? low : 0.0;
    volume->maximum = any ? high : 0.0;
}

/* ---- NRRD ------------------------------------------------------------------------------------------------------- */

/* From the file's axes to x, y, z. A first axis of a few numbers before three more is components. */
static nook_result set_shape(const char *name, const nook_nrrd_header *header, nook_scalar_volume *volume)
{
    uint32_t first = header->dimension == 4 ? 1 : 0;
    volume->dimension = header->dimension;
    volume->components = first ? header->sizes[0] : 1;
    volume->type = header->type;
    volume->sample_count = (size_t)(header->data_bytes / nook_sample_type_size(header->type));
    for (uint32_t axis = 0; axis < 3; axis++) {
        bool there = first + axis < header->dimension;
        volume->size[axis] = there ? header->sizes[first + axis] : 1;
        volume->spacing[axis] = there ? header->spacing[first + axis] : 1.0;
    }
    if (volume->components > COMPONENTS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: 4 dimensions, of which the first has %u: series of volumes are not read",
                         name, volume->components);
    return NOOK_OK;
}

/* What messages call a file. @return out */
static const char *name_file(const nook_nrrd_owner *owner, const char *path, char *out, size_t capacity)
{
    snprintf(out, capacity, "%s%s%s", owner->name ? owner->name : "", owner->name ? ": " : "", path);
    return out;
}

static nook_result read_file(const nook_nrrd_owner *owner, const char *path, nook_file *out_file)
{
    char why[PATH_CAPACITY], text[NAME_CAPACITY];
    nook_result result = nook_file_try_read(path, out_file, why, sizeof why);
    return result == NOOK_OK ? NOOK_OK : nook_fail(result, "%s", name_file(owner, why, text, sizeof text));
}

static nook_result decode_file(const nook_nrrd_owner *owner, const char *path, const nook_nrrd_header *header,
                               uint8_t *out, size_t out_size)
{
    nook_file file;
    char name[NAME_CAPACITY];
    nook_result result = read_file(owner, path, &file);
    if (result != NOOK_OK)
        return result;
    result = nook_nrrd_decode(name_file(owner, path, name, sizeof name), owner->scene, header, file.bytes, file.size,
                              out, out_size);
    nook_file_free(&file);
    return result;
}

/* Each file holds an equal share of the samples. */
static nook_result decode_files(const char *name, const nook_nrrd_owner *owner, const nook_nrrd_header *header,
                                const nook_nrrd_files *files, uint8_t *out)
{
    size_t samples = (size_t)header->data_bytes / nook_sample_type_size(header->type);
    if (samples % files->count != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: %zu samples cannot be shared by %zu data files", name, samples,
                         files->count);
    size_t share = (size_t)header->data_bytes / files->count;
    for (size_t i = 0; i < files->count; i++) {
        nook_result result = decode_file(owner, files->paths[i], header, out + i * share, share);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

static nook_result allocate(const char *name, const nook_nrrd_header *header, uint64_t stored_size, uint8_t **out)
{
    if (header->data_bytes > nook_nrrd_most_decoded(header, stored_size))
        return nook_fail(NOOK_E_FORMAT, "%s: cut short: %llu bytes of data cannot hold the samples (%llu bytes)", name,
                         (unsigned long long)stored_size, (unsigned long long)header->data_bytes);
    *out = malloc((size_t)header->data_bytes);
    return *out ? NOOK_OK
                : nook_fail(NOOK_E_MEMORY, "%s: no memory for %llu bytes of samples", name,
                            (unsigned long long)header->data_bytes);
}

static uint64_t total_size(const nook_nrrd_files *files)
{
    uint64_t total = 0;
    struct stat info;
    for (size_t i = 0; i < files->count; i++)
        total += stat(files->paths[i], &info) == 0 ? (uint64_t)info.st_size : 0;
    return total;
}

/* *out_samples and *out_files may be set on failure too; the caller frees them. */
static nook_result read_detached(const char *name, const char *path, const nook_nrrd_owner *owner,
                                 const nook_nrrd_header *header, const nook_file *file, uint8_t **out_samples,
                                 nook_nrrd_files *out_files)
{
    nook_result result = nook_nrrd_files_find(name, path, header, file->bytes, file->size, out_files);
    if (result == NOOK_OK)
        result = allocate(name, header, total_size(out_files), out_samples);
    if (result == NOOK_OK)
        result = decode_files(name, owner, header, out_files, *out_samples);
    return result;
}

static nook_result read_attached(const char *name, nook_scene *scene, const nook_nrrd_header *header,
                                 const nook_file *file, uint8_t **out_samples)
{
    size_t stored_size = file->size - header->rest;
    nook_result result = allocate(name, header, stored_size, out_samples);
    if (result == NOOK_OK)
        result = nook_nrrd_decode(name, scene, header, file->bytes + header->rest, stored_size, *out_samples,
                                  (size_t)header->data_bytes);
    return result;
}

static nook_result load_image(const char *path, const nook_nrrd_owner *owner, const nook_file *file,
                              nook_scalar_volume *out_volume, nook_nrrd_files *out_files)
{
    char name[NAME_CAPACITY];
    nook_nrrd_header header;
    nook_scalar_volume volume = { 0 };
    nook_result result = nook_nrrd_header_read(name_file(owner, path, name, sizeof name), owner->scene, file->bytes,
                                               file->size, &header);
    if (result == NOOK_OK)
        result = set_shape(name, &header, &volume);
    if (result != NOOK_OK)
        return result;
    uint8_t *samples = NULL;
    result = header.detached ? read_detached(name, path, owner, &header, file, &samples, out_files)
                             : read_attached(name, owner->scene, &header, file, &samples);
    if (result != NOOK_OK) {
        free(samples);
        return result;
    }
    volume.samples = samples;
    measure_range(&volume);
    *out_volume = volume;
    return NOOK_OK;
}

nook_result nook_scalar_volume_load_files(const char *path, const nook_nrrd_owner *owner,
                                          nook_scalar_volume *out_volume, nook_nrrd_files *out_files)
{
    nook_file file;
    *out_files = (nook_nrrd_files){ 0 };
    nook_result result = read_file(owner, path, &file);
    if (result != NOOK_OK)
        return result;
    result = load_image(path, owner, &file, out_volume, out_files);
    nook_file_free(&file);
    return result;
}

nook_result nook_scalar_volume_load(const char *path, nook_scalar_volume *out_volume)
{
    static const nook_nrrd_owner nobody = { 0 };
    nook_nrrd_files files;
    nook_result result = nook_scalar_volume_load_files(path, &nobody, out_volume, &files);
    nook_nrrd_files_free(&files);
    return result;
}

/* ---- Bare samples ----------------------------------------------------------------------------------------------- */

nook_result nook_scalar_volume_load_raw(const char *path, nook_sample_type type, const uint32_t size[3],
                                        nook_scalar_volume *out_volume)
{
    uint64_t bytes = nook_sample_type_size(type);
    for (int axis = 0; axis < 3; axis++) {
        if (size[axis] == 0 || size[axis] > NOOK_SCALAR_BYTES_MAX / bytes)
            return nook_fail(NOOK_E_FORMAT, "%s: %ux%ux%u samples: none, or too many", path, size[0], size[1], size[2]);
        bytes *= size[axis];
    }
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    if (file.size != bytes) {
        result = nook_fail(NOOK_E_FORMAT, "%s: %zu bytes, but %ux%ux%u samples of %s need %llu", path, file.size,
                           size[0], size[1], size[2], nook_sample_type_name(type), (unsigned long long)bytes);
        nook_file_free(&file);
        return result;
    }
    nook_scalar_volume volume = { .dimension = 3,
                                  .components = 1,
                                  .size = { size[0], size[1], size[2] },
                                  .spacing = { 1.0, 1.0, 1.0 },
                                  .type = type,
                                  .samples = file.bytes,
                                  .sample_count = (size_t)(bytes / nook_sample_type_size(type)) };
    measure_range(&volume);
    *out_volume = volume;
    return NOOK_OK;
}

void nook_scalar_volume_free(nook_scalar_volume *volume)
{
    if (!volume)
        return;
    free(volume->samples);
    *volume = (nook_scalar_volume){ 0 };
}
