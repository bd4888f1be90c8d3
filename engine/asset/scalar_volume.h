/**
 * scalar_volume.h - a .nrrd or .nhdr file, or bare samples, as plain data: sizes, spacing and range checked.
 *
 * Nothing outside the header's folder is opened, and no more memory is taken than the stored bytes can fill.
 */
#pragma once
#include "engine/core/result.h"
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_SCALAR_BYTES_MAX ((uint64_t)2 << 30) /**< Of samples; larger volumes are refused. */

typedef enum nook_sample_type {
    NOOK_SAMPLE_I8,
    NOOK_SAMPLE_U8,
    NOOK_SAMPLE_I16,
    NOOK_SAMPLE_U16,
    NOOK_SAMPLE_I32,
    NOOK_SAMPLE_U32,
    NOOK_SAMPLE_I64,
    NOOK_SAMPLE_U64,
    NOOK_SAMPLE_F32,
    NOOK_SAMPLE_F64,
    NOOK_SAMPLE_TYPE_COUNT
} nook_sample_type;

/** A regular grid of samples. */
typedef struct nook_scalar_volume {
    uint32_t dimension;  /**< Of the file: 1 to 3, or 4 when the first axis holds components. */
    uint32_t components; /**< Numbers per sample: 1, or the first of 4 sizes (colours, vectors). */
    uint32_t size[3];    /**< Samples along x, y, z; 1 along axes that the file does not have. */
    double spacing[3];   /**< Between samples, in the file's unit; finite, > 0; 1 where the file does not say. */
    nook_sample_type type;
    void *samples;           /**< components fastest, then x, y, z; this machine's byte order. Owned. */
    size_t sample_count;     /**< components * x * y * z. */
    double minimum, maximum; /**< Of the finite samples; 0 and 0 when there are none. */
    size_t not_finite;       /**< Samples that are NaN or infinite. */
} nook_scalar_volume;

/**
 * Loads NRRD (versions 1 to 5; raw, gzip, bzip2, ascii, hex; attached or detached, lists and numbered files).
 * Warns of what it leaves out: data behind the last sample, the sign of a spacing, the turn of the axes. Spacing that is
 * zero or infinite is refused.
 * @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (one line says what is wrong), NOOK_E_MEMORY; *out_volume is untouched
 *         on failure
 */
nook_result nook_scalar_volume_load(const char *path, nook_scalar_volume *out_volume);

/**
 * Loads samples without a header, in this machine's byte order.
 * @return as above; NOOK_E_FORMAT when the file does not have exactly the bytes that `size` needs
 */
nook_result nook_scalar_volume_load_raw(const char *path, nook_sample_type type, const uint32_t size[3],
                                        nook_scalar_volume *out_volume);

void nook_scalar_volume_free(nook_scalar_volume *volume); /**< NULL and zeroed volumes are allowed. */

/** A sample as a double. @param index  below sample_count */
double nook_scalar_volume_sample(const nook_scalar_volume *volume, size_t index);

const char *nook_sample_type_name(nook_sample_type type); /**< "uint8", "float32", ... */
size_t nook_sample_type_size(nook_sample_type type);      /**< Bytes. */

#ifdef __cplusplus
}
#endif
