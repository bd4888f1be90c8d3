/* Pixels that no pixel of the trace stands for, traced by themselves: docs/techniques.md "Refinement". */
#include "modules/ao/refine_internal.h"
#include <math.h>
#include <stdbool.h>

enum {
    GROUP = 64, /* REFINE_GROUP of shaders/ao/refine.glsl */
    BINDING_CANDIDATES = 6,
    BINDING_LISTED = 4,
    PIXEL_BYTES = 4,
    RECORD_BYTES = 16
};

/** Heads of the buffers: those of shaders/ao/refine.glsl. */
typedef struct candidates_head {
    uint32_t groups[3], count, lacking;
} candidates_head;

typedef struct listed_head {
    uint32_t groups[3], count, capacity, padding[3];
} listed_head;

void ao_refine_release(nook_gpu *gpu, ao_refine *refine)
{
    nook_buffer_destroy(gpu, &refine->candidates);
    nook_buffer_destroy(gpu, &refine->listed);
    nook_texture_destroy(gpu, &refine->traced);
    *refine = (ao_refine){ 0 };
}

static uint32_t rows_of(uint32_t capacity)
{
    return nook_groups(capacity, GROUP);
}

/** Room for a share of the pixels, whole groups of it; no more than a texture has rows. */
static uint32_t capacity_of(const nook_gpu *gpu, uint32_t pixels, double share)
{
    uint32_t rows = rows_of((uint32_t)ceil((double)pixels * share));
    return (rows < gpu->max_texture_size ? rows : gpu->max_texture_size) * GROUP;
}

static bool is_power_of_two(uint32_t n)
{
    return (n & (n - 1)) == 0;
}

/** At least `side`, and a power of two where that of the trace is one: llvmpipe compiles a program again for images that are, or are not. */
static uint32_t side_like(const nook_gpu *gpu, uint32_t side, uint32_t traced)
{
    while (is_power_of_two(side) != is_power_of_two(traced) && side < gpu->max_texture_size)
        side++;
    return side;
}

nook_result ao_refine_fit(nook_gpu *gpu, ao_refine *refine, uint32_t width, uint32_t height, uint32_t scale,
                          double share)
{
    uint32_t pixels = width * height, capacity = capacity_of(gpu, pixels, share);
    uint32_t traced_width = side_like(gpu, GROUP, nook_groups(width, scale));
    uint32_t traced_height = side_like(gpu, rows_of(capacity), nook_groups(height, scale));
    if (refine->pixels == pixels && refine->capacity == capacity && refine->traced.width == traced_width &&
        refine->traced.height == traced_height)
        return NOOK_OK;
    ao_refine_release(gpu, refine);
    nook_result result =
        nook_buffer_create(gpu, NULL, sizeof(candidates_head) + (size_t)pixels * PIXEL_BYTES, &refine->candidates);
    if (result == NOOK_OK)
        result = nook_buffer_create(gpu, NULL, sizeof(listed_head) + (size_t)capacity * RECORD_BYTES, &refine->listed);
    if (result == NOOK_OK)
        result = nook_texture_create_2d(gpu, GL_R32F, traced_width, traced_height, GL_NEAREST, &refine->traced);
    if (result == NOOK_OK)
        refine->pixels = pixels, refine->capacity = capacity;
    else
        ao_refine_release(gpu, refine);
    return result;
}

uint64_t ao_refine_bytes(const ao_refine *refine)
{
    const uint64_t texels = (uint64_t)refine->traced.width * refine->traced.height;
    return (uint64_t)refine->candidates.size + refine->listed.size + texels * sizeof(float);
}

void ao_refine_begin(nook_gpu *gpu, const ao_refine *refine)
{
    const candidates_head candidates = { .groups = { 0, 1, 1 } };
    const listed_head listed = { .groups = { 0, 1, 1 }, .capacity = refine->capacity };
    nook_buffer_update(gpu, refine->candidates, 0, &candidates, sizeof candidates);
    nook_buffer_update(gpu, refine->listed, 0, &listed, sizeof listed);
    ao_refine_bind(gpu, refine);
}

void ao_refine_bind(nook_gpu *gpu, const ao_refine *refine)
{
    nook_bind_storage(gpu, BINDING_CANDIDATES, refine->candidates);
    nook_bind_storage(gpu, BINDING_LISTED, refine->listed);
}

uint32_t ao_refine_count(nook_gpu *gpu, const ao_refine *refine)
{
    listed_head head;
    if (refine->capacity == 0)
        return 0;
    nook_buffer_read(gpu, refine->listed, 0, &head, sizeof head);
    return head.count < refine->capacity ? head.count : refine->capacity;
}
