/**
 * residency.h - volumes whose contents come and go, piece by piece: for those who stream them (modules/stream, docs/streaming.md).
 *
 *   reserve an id (nook_ao_reserve_volume) -> place -> write, write, ... until it is whole: seen from then on -> drop -> place ...
 *
 * Nothing here decodes, reads files or waits. A volume that is there in a kind may be placed in it once more: until the new contents
 * are whole the old ones are seen. What is submitted and not there is left out of the record, as ever.
 */
#pragma once
#include "modules/ao/nook_ao.h"
#include "modules/bake/volume_file.h"
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Memory that the volumes of one kind share; all zero: as much as they take. */
typedef struct nook_ao_room {
    uint32_t sides[3]; /**< Of the kinds of voxels: a byte for each of sides[0] * sides[1] * sides[2]. */
    uint32_t bricks;   /**< Of surfels: sizeof(nook_brick) bytes each. */
    uint32_t surfels;  /**< The same: sizeof(nook_surfel) bytes each. */
} nook_ao_room;

/**
 * Gives a kind a room that nothing streamed makes larger. Allocated at once; what was there before is copied as far as it fits, then freed: both are there
 * for a moment. Placed volumes that are not whole are dropped. What was added whole (nook_ao_add_volume, nook_ao_keep_volume, live volumes) comes
 * first, and later ones make the room grow.
 * @return NOOK_E_RANGE it does not hold what was added whole, or the device has no such texture; NOOK_E_MEMORY: all is as it was
 */
nook_result nook_ao_set_room(nook_ao *ao, nook_volume_kind kind, const nook_ao_room *room);

/**
 * Takes a place for a volume's contents. Without a room the memory grows with the next write.
 * @param volume  reserved; not placed in this kind @param info  of the contents to come
 * @return false: there is no room now, or no memory; logs nothing
 */
bool nook_ao_place_volume(nook_ao *ao, nook_ao_volume volume, const nook_volume_info *info);
/** How much of a write was done. */
typedef struct nook_ao_written {
    size_t bytes;
    bool whole; /**< It is seen from the next record on. */
} nook_ao_written;
/**
 * Uploads the next part of a placed volume.
 * @param contents  as its info said; the same in every call. Bricks are changed by the first. Yours to free once it is whole
 * @param most      bytes; a part is a slice of voxels at least, so that fewer than NOOK_VOLUME_SIDE_MAX^2 may write nothing
 * @return NOOK_E_MEMORY, NOOK_E_RANGE, NOOK_E_DEVICE: the memory could not grow
 */
nook_result nook_ao_write_volume(nook_ao *ao, nook_ao_volume volume, nook_volume *contents, size_t most,
                                 nook_ao_written *out_written);
/** Gives back the place of a volume that is not whole. One that has none is allowed. */
void nook_ao_unplace_volume(nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind);
bool nook_ao_is_placed(const nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind);
/** Takes its contents in a kind away; the id stays known. Not there is allowed. */
void nook_ao_drop_volume(nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind);
/** Whether it is there in a kind, whole. */
bool nook_ao_has_volume(const nook_ao *ao, nook_ao_volume volume, nook_volume_kind kind);

/**
 * Adds contents that are decoded, whole and to stay, as nook_ao_extend_volume does those of a file: no room is too small for them.
 * @param volume    reserved; not there and not placed in this kind
 * @param contents  taken over; zero afterwards, also where this fails
 * @return NOOK_E_MEMORY: also where it is larger than the device can hold
 */
nook_result nook_ao_keep_volume(nook_ao *ao, nook_ao_volume volume, nook_volume *contents);

/** Bytes of a kind's volumes that were added whole, and stay. */
uint64_t nook_ao_kept_bytes(const nook_ao *ao, nook_volume_kind kind);
/**
 * Lists them in the order in which another room would give them their places.
 * @param out  capacity of them; sizes are those of their places @return how many there are
 */
uint32_t nook_ao_list_kept(const nook_ao *ao, nook_volume_kind kind, nook_volume_info *out, uint32_t capacity);

/** Bytes of GPU memory that a kind's volumes have, as of the next record. */
uint64_t nook_ao_kind_bytes(const nook_ao *ao, nook_volume_kind kind);
/** Bytes that a kind's memory would have with these volumes, all of it, added whole one after the other. @param infos count of them */
uint64_t nook_ao_packed_bytes(nook_volume_kind kind, const nook_volume_info *const *infos, uint32_t count);
/** Bytes of those that find a place in a room of voxels, one after the other; the others are left out. Allocates. */
uint64_t nook_ao_fitting_bytes(const uint32_t sides[3], const nook_volume_info *const *infos, uint32_t count);
/** Bytes that one volume takes of it. */
uint64_t nook_volume_gpu_bytes(const nook_volume_info *info);

#ifdef __cplusplus
}
#endif
