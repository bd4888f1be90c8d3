#include "game/play/soak_memory.h"

enum { EARLY = 1, LATE = NOOK_SOAK_PARTS - 1 };

void nook_soak_memory_add(nook_soak_memory *memory, uint32_t frame, uint32_t frames, uint64_t bytes)
{
    const uint32_t part = (uint32_t)((uint64_t)(frame - 1) * NOOK_SOAK_PARTS / frames);
    uint64_t *least = &memory->least[part];
    if (*least == 0 || bytes < *least)
        *least = bytes;
    if (part >= EARLY && bytes > memory->most)
        memory->most = bytes;
}

uint64_t nook_soak_memory_growth(const nook_soak_memory *memory)
{
    uint64_t early = memory->least[EARLY], late = memory->least[LATE];
    return late > early ? late - early : 0;
}

bool nook_soak_memory_holds(const nook_soak_memory *memory, uint64_t allowed)
{
    return memory->least[EARLY] > 0 && memory->least[LATE] > 0 && nook_soak_memory_growth(memory) <= allowed;
}

uint64_t nook_soak_resident_allowed(const nook_soak_memory *resident)
{
    return resident->least[EARLY] / 50 + (4u << 20);
}
