#include "game/material_alpha.h"
#include <stdlib.h>

bool nook_material_alpha(const nook_scene *scene, const nook_material *material, nook_alpha_part *out)
{
    const uint32_t image = material->base_colour_image;
    if (material->alpha_mode == NOOK_ALPHA_OPAQUE)
        return false;
    *out = (nook_alpha_part){ .alpha = material->base_colour[3],
                              .masked = material->alpha_mode == NOOK_ALPHA_MASK,
                              .cutoff = material->alpha_cutoff };
    if (image != NOOK_NONE && scene->images[image].pixels) {
        out->texels = scene->images[image].pixels;
        out->width = scene->images[image].width;
        out->height = scene->images[image].height;
    }
    return true;
}

bool nook_primitive_live_range(const nook_scene *scene, const nook_primitive *primitive, nook_ao_triangle_range *out)
{
    nook_alpha_part part;
    if (!nook_primitive_is_opaque(scene, primitive))
        return false;
    *out = (nook_ao_triangle_range){ .first_index = primitive->first_index,
                                     .index_count = primitive->index_count,
                                     .first_vertex = primitive->first_vertex };
    if (!nook_material_alpha(scene, &scene->materials[primitive->material], &part))
        return true;
    out->mask = part.texels ? primitive->material + 1 : 0;
    return part.texels || nook_alpha_of_texel(&part, UINT8_MAX) > 0.0;
}

nook_ao_live_mask *nook_scene_live_masks(const nook_scene *scene)
{
    nook_ao_live_mask *masks = calloc(scene->material_count + (size_t)1, sizeof *masks);
    for (uint32_t i = 0; masks && i < scene->material_count; i++)
        masks[i] = (nook_ao_live_mask){ .factor = scene->materials[i].base_colour[3],
                                        .cutoff = scene->materials[i].alpha_cutoff };
    return masks;
}

void nook_scene_live_masks_find(const nook_scene *scene, const nook_render_scene *drawn, nook_ao_live_mask *masks)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        masks[i].texture = nook_render_scene_base_colour(drawn, i).id;
}
