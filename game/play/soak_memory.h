/**
 * soak_memory.h - whether the memory of a process grows, told from what it held over time.
 *
 * What is held comes and goes: a driver that compiles shaders takes tens of megabytes for a moment. What leaks stays: it lifts the
 * least that the process comes down to. So a run is cut into tenths; the first is for warming up, and the least of the second is held
 * against the least of the last.
 *
 * The heap, what was allocated and not freed, is known to the byte: a leak of 14 bytes a frame shows in 100,000 frames. What the
 * process occupies is coarser, as allocators keep and tear to pieces what was freed, but counts what no allocator knows of.
 */
#pragma once
#include <stdbool.h>
#include <stdint.h>

enum {
    NOOK_SOAK_PARTS = 10,
    NOOK_SOAK_HEAP_ALLOWED = 1 << 20 /**< Bytes by which the heap may grow: a driver keeps some. */
};

/** Bytes of one kind; zeroed before the first frame. */
typedef struct nook_soak_memory {
    uint64_t least[NOOK_SOAK_PARTS]; /**< In each tenth of the frames; 0: not looked at yet. */
    uint64_t most;                   /**< After the first tenth. */
} nook_soak_memory;

/** @param frame  [1, frames] @param frames of the whole run, at least NOOK_SOAK_PARTS @param bytes  > 0 */
void nook_soak_memory_add(nook_soak_memory *memory, uint32_t frame, uint32_t frames, uint64_t bytes);
/** From the second tenth to the last, bytes. @return 0 when it shrank, or before the last tenth */
uint64_t nook_soak_memory_growth(const nook_soak_memory *memory);
/** Whether it grew by at most that; false before the last tenth. */
bool nook_soak_memory_holds(const nook_soak_memory *memory, uint64_t allowed);
/** Bytes by which what a process occupies may grow: 2 %, and 4 MiB for what the driver and the allocator keep. */
uint64_t nook_soak_resident_allowed(const nook_soak_memory *resident);
