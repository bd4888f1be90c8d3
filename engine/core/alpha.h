/**
 * alpha.h - what of a list of triangles is not opaque: parts with an alpha, from textures or not. Bakers make volumes of it, and the
 * reference's rays pass through it, by the same rule.
 *
 * Alpha at a point is the part's times the texture's: the nearest texel at the interpolated coordinates, repeated, as they are stored.
 * A masked part is opaque where that reaches the cutoff and not there elsewhere. Where coordinates are not finite the texture's is 1.
 */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Triangles that are not opaque, all in one way. */
typedef struct nook_alpha_part {
    size_t first_index, index_count; /**< Of the indices; multiples of 3. */
    float alpha;                     /**< Of all of it; multiplies the texture's. [0, 1]. */
    bool masked;                     /**< Opaque where alpha is at least `cutoff`, and not there elsewhere. */
    float cutoff;
    const uint8_t *texels; /**< Top row first, at uv (0, 0) to (1, 1) and repeated; NULL: none. */
    uint32_t width, height;
    uint32_t texel_size; /**< Bytes, alpha being the last of them; 0: 4, RGBA. */
} nook_alpha_part;

typedef struct nook_alphas {
    const nook_alpha_part *parts; /**< In the order of their triangles, apart from each other; others are opaque. */
    uint32_t part_count;
    const float *uvs; /**< Two a vertex, packed; NULL where no part has a texture. */
} nook_alphas;

/** Whether the parts are some of `index_count` indices, in order and apart, with uvs and sizes where there are textures. NULL is. */
bool nook_alphas_are_sound(const nook_alphas *alphas, size_t index_count);

/** @param alphas  NULL: all is opaque @return the part in which a triangle lies; NULL: it is opaque */
const nook_alpha_part *nook_alpha_part_of(const nook_alphas *alphas, size_t triangle);

/** A texel's alpha as it is stored. @param x, y  below width and height */
uint8_t nook_alpha_texel(const nook_alpha_part *part, uint32_t x, uint32_t y);

/** Where along a side of `size` texels a coordinate lies. */
uint32_t nook_alpha_texel_at(double coordinate, uint32_t size);

/** What of light a texel holds back, [0, 1]: 0 or 1 where it is masked. @param texel  as it is stored; UINT8_MAX without a texture */
double nook_alpha_of_texel(const nook_alpha_part *part, uint8_t texel);

/** The most of it that any point with finite coordinates has. Reads the texels until one is 255. */
double nook_alpha_most(const nook_alpha_part *part);

/**
 * The same at a point of a triangle.
 * @param corners  its vertices @param weight  of them, at the point
 */
double nook_alpha_at(const nook_alphas *alphas, const nook_alpha_part *part, const uint32_t corners[3],
                     const double weight[3]);

#ifdef __cplusplus
}
#endif
