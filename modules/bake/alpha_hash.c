#include "modules/bake/alpha_hash.h"
#include <xxhash.h>

enum { RGBA = 4 };

/* Alphas alone where they are stored alone; else the colours with them, as they lie in memory: one pass. */
static uint64_t hash_texels(const nook_alpha_part *part, uint64_t hash)
{
    size_t size = part->texel_size ? part->texel_size : RGBA;
    return XXH3_64bits_withSeed(part->texels, (size_t)part->width * part->height * size, hash);
}

uint64_t nook_alpha_part_hash(const nook_alpha_part *part, uint64_t seed)
{
    const float numbers[] = { part->alpha, part->masked ? part->cutoff : -1.0f };
    const uint64_t size[] = { part->texels ? part->width : 0, part->texels ? part->height : 0 };
    uint64_t hash = XXH3_64bits_withSeed(numbers, sizeof numbers, seed);
    hash = XXH3_64bits_withSeed(size, sizeof size, hash);
    return part->texels ? hash_texels(part, hash) : hash;
}

uint64_t nook_alphas_hash(const nook_triangles *triangles, const nook_alphas *alphas, uint64_t seed)
{
    uint64_t hash = seed;
    bool textured = false;
    for (uint32_t i = 0; alphas && i < alphas->part_count; i++) {
        const nook_alpha_part *part = &alphas->parts[i];
        const float numbers[] = { part->alpha, part->masked ? part->cutoff : -1.0f };
        const uint64_t places[] = { part->first_index, part->index_count, part->texels ? part->width : 0,
                                    part->texels ? part->height : 0 };
        hash = XXH3_64bits_withSeed(numbers, sizeof numbers, hash);
        hash = XXH3_64bits_withSeed(places, sizeof places, hash);
        if (part->texels)
            hash = hash_texels(part, hash);
        textured = textured || part->texels;
    }
    if (textured)
        hash = XXH3_64bits_withSeed(alphas->uvs, (size_t)triangles->vertex_count * 2 * sizeof(float), hash);
    return hash;
}
