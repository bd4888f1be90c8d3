#pragma once
#include "engine/core/alpha.h"

/** A part that is a mask: there where a texel is at least 128. @param texels  side * side bytes, borrowed */
static inline nook_alpha_part test_mask(size_t first_index, size_t index_count, const uint8_t *texels, uint32_t side)
{
    return (nook_alpha_part){ .first_index = first_index,
                              .index_count = index_count,
                              .alpha = 1,
                              .masked = true,
                              .cutoff = 0.5f,
                              .texels = texels,
                              .width = side,
                              .height = side,
                              .texel_size = 1 };
}
