#include "modules/ao/mesh_alphas_internal.h"
#include <stdlib.h>
#include <string.h>

struct ao_mesh_alphas {
    nook_alphas alphas; /* its arrays are those below */
    nook_alpha_part *parts;
    uint8_t **textures; /* of each part; a texture that parts share is the first one's */
    float *uvs;
};

static bool share_texture(const nook_alpha_part *a, const nook_alpha_part *b)
{
    return a->texels == b->texels && a->width == b->width && a->height == b->height && a->texel_size == b->texel_size;
}

static uint8_t *copy_texture(const nook_alpha_part *part)
{
    uint8_t *texels = malloc((size_t)part->width * part->height), *next = texels;
    for (uint32_t y = 0; texels && y < part->height; y++)
        for (uint32_t x = 0; x < part->width; x++)
            *next++ = nook_alpha_texel(part, x, y);
    return texels;
}

static bool copy_textures(const nook_alphas *from, ao_mesh_alphas *to)
{
    for (uint32_t i = 0; i < from->part_count; i++) {
        uint32_t first = 0;
        if (!from->parts[i].texels)
            continue;
        while (!share_texture(&from->parts[first], &from->parts[i]))
            first++;
        if (first == i && !(to->textures[i] = copy_texture(&from->parts[i])))
            return false;
        to->parts[i].texels = to->textures[first];
        to->parts[i].texel_size = 1;
    }
    return true;
}

ao_mesh_alphas *ao_mesh_alphas_create(const nook_alphas *alphas, uint32_t vertex_count)
{
    size_t count = alphas->part_count, uv_size = (size_t)vertex_count * 2 * sizeof(float);
    ao_mesh_alphas *copy = calloc(1, sizeof *copy);
    if (!copy)
        return NULL;
    copy->alphas.part_count = alphas->part_count;
    copy->parts = malloc((count + 1) * sizeof *copy->parts);
    copy->textures = calloc(count + 1, sizeof *copy->textures);
    copy->uvs = alphas->uvs ? malloc(uv_size + 1) : NULL;
    bool made = copy->parts && copy->textures && (copy->uvs || !alphas->uvs);
    if (made && count)
        memcpy(copy->parts, alphas->parts, count * sizeof *copy->parts);
    if (made && alphas->uvs && uv_size)
        memcpy(copy->uvs, alphas->uvs, uv_size);
    if (!made || !copy_textures(alphas, copy)) {
        ao_mesh_alphas_destroy(copy);
        return NULL;
    }
    copy->alphas = (nook_alphas){ copy->parts, alphas->part_count, copy->uvs };
    return copy;
}

void ao_mesh_alphas_destroy(ao_mesh_alphas *copy)
{
    if (!copy)
        return;
    for (uint32_t i = 0; copy->textures && i < copy->alphas.part_count; i++)
        free(copy->textures[i]);
    free(copy->textures);
    free(copy->parts);
    free(copy->uvs);
    free(copy);
}

const nook_alphas *ao_mesh_alphas_get(const ao_mesh_alphas *copy)
{
    return copy ? &copy->alphas : NULL;
}
