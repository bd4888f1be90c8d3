#include "engine/core/alpha.h"
#include <math.h>

bool nook_alphas_are_sound(const nook_alphas *alphas, size_t index_count)
{
    size_t free_from = 0;
    for (uint32_t i = 0; alphas && i < alphas->part_count; i++) {
        const nook_alpha_part *part = &alphas->parts[i];
        if (part->first_index < free_from || part->first_index > index_count ||
            part->index_count > index_count - part->first_index || part->first_index % 3 != 0 ||
            part->index_count % 3 != 0 || (part->texels && (!alphas->uvs || part->width == 0 || part->height == 0)))
            return false;
        free_from = part->first_index + part->index_count;
    }
    return true;
}

const nook_alpha_part *nook_alpha_part_of(const nook_alphas *alphas, size_t triangle)
{
    uint32_t first = 0, end = alphas ? alphas->part_count : 0;
    while (first < end) {
        uint32_t middle = first + (end - first) / 2;
        if (alphas->parts[middle].first_index <= 3 * triangle)
            first = middle + 1;
        else
            end = middle;
    }
    if (first == 0)
        return NULL;
    const nook_alpha_part *part = &alphas->parts[first - 1];
    return 3 * triangle < part->first_index + part->index_count ? part : NULL;
}

uint8_t nook_alpha_texel(const nook_alpha_part *part, uint32_t x, uint32_t y)
{
    size_t size = part->texel_size ? part->texel_size : 4;
    return part->texels[((size_t)y * part->width + x) * size + size - 1];
}

uint32_t nook_alpha_texel_at(double coordinate, uint32_t size)
{
    double within = coordinate - floor(coordinate);
    uint32_t texel = (uint32_t)(within * size);
    return texel < size ? texel : size - 1;
}

double nook_alpha_of_texel(const nook_alpha_part *part, uint8_t texel)
{
    double alpha = (double)part->alpha * (texel / 255.0);
    if (part->masked)
        return alpha >= (double)part->cutoff ? 1.0 : 0.0;
    return fmin(fmax(alpha, 0.0), 1.0);
}

double nook_alpha_most(const nook_alpha_part *part)
{
    uint8_t most = part->texels ? 0 : UINT8_MAX; /* more of a texel is never less of the part */
    for (uint32_t y = 0; part->texels && y < part->height && most < UINT8_MAX; y++)
        for (uint32_t x = 0; x < part->width && most < UINT8_MAX; x++) {
            const uint8_t texel = nook_alpha_texel(part, x, y);
            most = texel > most ? texel : most;
        }
    return nook_alpha_of_texel(part, most);
}

double nook_alpha_at(const nook_alphas *alphas, const nook_alpha_part *part, const uint32_t corners[3],
                     const double weight[3])
{
    double uv[2] = { 0.0, 0.0 };
    if (!part->texels)
        return nook_alpha_of_texel(part, UINT8_MAX);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++)
            uv[i] += weight[k] * (double)alphas->uvs[2 * (size_t)corners[k] + (size_t)i];
    if (!isfinite(uv[0]) || !isfinite(uv[1]))
        return nook_alpha_of_texel(part, UINT8_MAX);
    return nook_alpha_of_texel(part, nook_alpha_texel(part, nook_alpha_texel_at(uv[0], part->width),
                                                      nook_alpha_texel_at(uv[1], part->height)));
}
