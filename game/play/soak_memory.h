/**
 * soak_memory.h - whether the memory of a process grows, told from its size over time.
 *
 * A driver that compiles shaders takes tens of megabytes for a moment, and the allocator gives them back when it pleases. What leaks
 * stays: it lifts the least that the process comes down to. So the least of the second tenth of the frames, when all is warm, is held
 * against the least of the last tenth.
 */
#pragma once
#include <stdbool.h>
#include <stdint.h>

/** Resident bytes; zeroed before the first frame. */
typedef struct nook_soak_memory {
    uint64_t early; /**< The least in the second tenth of the frames; 0: not looked at yet. */
    uint64_t late;  /**< The least in the last tenth; 0: not looked at yet. */
    uint64_t most;  /**< After the first tenth. */
} nook_soak_memory;

/** @param frame  [1, frames] @param frames of the whole run, at least 20 @param resident  > 0 */
void nook_soak_memory_add(nook_soak_memory *memory, uint32_t frame, uint32_t frames, uint64_t resident);
/** Bytes by which it may grow: 2 %, and 4 MiB for what the driver and the allocator keep. */
uint64_t nook_soak_memory_allowed(const nook_soak_memory *memory);
/** Whether it stayed within that; false before the last tenth. */
bool nook_soak_memory_holds(const nook_soak_memory *memory);
