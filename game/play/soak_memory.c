#include "game/play/soak_memory.h"

static void take_least(uint64_t *least, uint64_t resident)
{
    if (*least == 0 || resident < *least)
        *least = resident;
}

void nook_soak_memory_add(nook_soak_memory *memory, uint32_t frame, uint32_t frames, uint64_t resident)
{
    const uint32_t tenth = frames / 10;
    if (frame <= tenth)
        return;
    if (frame <= 2 * tenth)
        take_least(&memory->early, resident);
    if (frame > frames - tenth)
        take_least(&memory->late, resident);
    if (resident > memory->most)
        memory->most = resident;
}

uint64_t nook_soak_memory_allowed(const nook_soak_memory *memory)
{
    return memory->early / 50 + (4u << 20);
}

bool nook_soak_memory_holds(const nook_soak_memory *memory)
{
    return memory->early > 0 && memory->late > 0 && memory->late <= memory->early + nook_soak_memory_allowed(memory);
}
