/**
 * volume_payload.h - what stands behind the header of a .nkv file, before it is compressed: docs/volume_format.md; inside
 * modules/bake only.
 */
#pragma once
#include "modules/bake/volume_file.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Bytes that a sound header's payload takes; above 0, below 2^31. */
size_t nook_payload_size(const nook_volume_info *info);
/** @param out  nook_payload_size bytes @return NOOK_E_ARG contents that no file may hold, or that info does not count */
nook_result nook_payload_write(const nook_volume *volume, uint8_t *out);
/**
 * @param name  used in messages @param raw  nook_payload_size bytes
 * @param volume  with its info; its contents are made, and are NULL on failure
 * @return NOOK_E_FORMAT, NOOK_E_MEMORY
 */
nook_result nook_payload_read(const char *name, const uint8_t *raw, nook_volume *volume);

#ifdef __cplusplus
}
#endif
