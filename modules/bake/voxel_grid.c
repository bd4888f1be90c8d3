#include "modules/bake/voxel_grid.h"
#include <assert.h>
#include <stdatomic.h>
#include <stdlib.h>

struct nook_voxel_grid {
    uint32_t size[3];
    size_t voxel_count;
    _Atomic uint64_t words[]; /* voxel i is bit i % 64 of word i / 64 */
};

static size_t voxel_index(const nook_voxel_grid *grid, const int32_t voxel[3])
{
    assert(voxel[0] >= 0 && voxel[1] >= 0 && voxel[2] >= 0);
    assert((uint32_t)voxel[0] < grid->size[0] && (uint32_t)voxel[1] < grid->size[1] &&
           (uint32_t)voxel[2] < grid->size[2]);
    return ((size_t)voxel[2] * grid->size[1] + (size_t)voxel[1]) * grid->size[0] + (size_t)voxel[0];
}

static bool is_set(const nook_voxel_grid *grid, size_t index)
{
    return atomic_load_explicit(&grid->words[index / 64], memory_order_relaxed) >> (index % 64) & 1;
}

nook_voxel_grid *nook_voxel_grid_create(const uint32_t size[3])
{
    size_t voxel_count = (size_t)size[0] * size[1] * size[2];
    size_t word_count = (voxel_count + 63) / 64;
    nook_voxel_grid *grid = malloc(sizeof *grid + word_count * sizeof grid->words[0]);
    if (!grid)
        return NULL;
    for (int axis = 0; axis < 3; axis++)
        grid->size[axis] = size[axis];
    grid->voxel_count = voxel_count;
    for (size_t i = 0; i < word_count; i++)
        atomic_init(&grid->words[i], 0);
    return grid;
}

void nook_voxel_grid_destroy(nook_voxel_grid *grid)
{
    free(grid);
}

void nook_voxel_grid_set(nook_voxel_grid *grid, const int32_t voxel[3])
{
    size_t index = voxel_index(grid, voxel);
    /* Most voxels are hit several times: looking first spares the locked instruction. */
    if (!is_set(grid, index))
        atomic_fetch_or_explicit(&grid->words[index / 64], (uint64_t)1 << (index % 64), memory_order_relaxed);
}

bool nook_voxel_grid_has_near(const nook_voxel_grid *grid, const int32_t voxel[3])
{
    size_t index = voxel_index(grid, voxel);
    size_t row = grid->size[0], slice = row * grid->size[1];
    return is_set(grid, index) || is_set(grid, index - 1) || is_set(grid, index + 1) || is_set(grid, index - row) ||
           is_set(grid, index + row) || is_set(grid, index - slice) || is_set(grid, index + slice);
}

uint64_t nook_voxel_grid_expand(const nook_voxel_grid *a, const nook_voxel_grid *b, uint8_t *out_voxels)
{
    uint64_t occupied = 0;
    for (size_t first = 0; first < a->voxel_count; first += 64) {
        uint64_t word = atomic_load_explicit(&a->words[first / 64], memory_order_relaxed) |
                        atomic_load_explicit(&b->words[first / 64], memory_order_relaxed);
        size_t end = first + 64 < a->voxel_count ? first + 64 : a->voxel_count;
        for (size_t i = first; i < end; i++, word >>= 1) {
            out_voxels[i] = word & 1 ? 255 : 0;
            occupied += word & 1;
        }
    }
    return occupied;
}
