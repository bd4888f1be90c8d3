#include "engine/render/internal.h"

static nook_result create_textures(nook_gpu *gpu, uint32_t width, uint32_t height, render_targets *t)
{
    const struct {
        uint32_t format, filter;
        nook_texture *texture;
    } list[] = {
        { GL_SRGB8_ALPHA8, GL_NEAREST, &t->gbuffer.base_colour },
        { GL_RG16, GL_NEAREST, &t->gbuffer.normal },
        { GL_RG16, GL_NEAREST, &t->gbuffer.geometric_normal },
        { GL_RGBA8, GL_NEAREST, &t->gbuffer.material },
        { GL_R11F_G11F_B10F, GL_NEAREST, &t->gbuffer.emissive },
        { GL_DEPTH_COMPONENT32F, GL_NEAREST, &t->gbuffer.depth },
        { GL_RGBA16F, GL_NEAREST, &t->light },
        { GL_RGBA8, GL_LINEAR, &t->image },
    };
    for (size_t i = 0; i < NOOK_COUNT(list); i++) {
        nook_result result =
            nook_texture_create_2d(gpu, list[i].format, width, height, list[i].filter, list[i].texture);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

static nook_result create_framebuffers(nook_gpu *gpu, render_targets *t)
{
    const nook_texture none = { 0 };
    const nook_texture colours[] = { t->gbuffer.base_colour, t->gbuffer.normal, t->gbuffer.geometric_normal,
                                     t->gbuffer.material, t->gbuffer.emissive };
    nook_result result =
        nook_framebuffer_create(gpu, colours, (uint32_t)NOOK_COUNT(colours), t->gbuffer.depth, &t->gbuffer_target);
    if (result == NOOK_OK)
        result = nook_framebuffer_create(gpu, colours, (uint32_t)NOOK_COUNT(colours) - 1, t->gbuffer.depth,
                                         &t->dark_gbuffer_target);
    if (result == NOOK_OK)
        result = nook_framebuffer_create(gpu, &t->light, 1, none, &t->light_target);
    if (result == NOOK_OK)
        result = nook_framebuffer_create(gpu, &t->light, 1, t->gbuffer.depth, &t->blended_target);
    if (result == NOOK_OK)
        result = nook_framebuffer_create(gpu, &t->image, 1, none, &t->image_target);
    return result;
}

nook_result nook_targets_create(nook_gpu *gpu, uint32_t width, uint32_t height, render_targets *out)
{
    render_targets t = { 0 };
    nook_result result = create_textures(gpu, width, height, &t);
    if (result == NOOK_OK)
        result = create_framebuffers(gpu, &t);
    if (result != NOOK_OK) {
        nook_targets_destroy(gpu, &t);
        return result;
    }
    *out = t;
    return NOOK_OK;
}

void nook_targets_destroy(nook_gpu *gpu, render_targets *t)
{
    nook_framebuffer_destroy(gpu, &t->gbuffer_target);
    nook_framebuffer_destroy(gpu, &t->dark_gbuffer_target);
    nook_framebuffer_destroy(gpu, &t->light_target);
    nook_framebuffer_destroy(gpu, &t->blended_target);
    nook_framebuffer_destroy(gpu, &t->image_target);
    nook_texture_destroy(gpu, &t->gbuffer.base_colour);
    nook_texture_destroy(gpu, &t->gbuffer.normal);
    nook_texture_destroy(gpu, &t->gbuffer.geometric_normal);
    nook_texture_destroy(gpu, &t->gbuffer.material);
    nook_texture_destroy(gpu, &t->gbuffer.emissive);
    nook_texture_destroy(gpu, &t->gbuffer.depth);
    nook_texture_destroy(gpu, &t->light);
    nook_texture_destroy(gpu, &t->image);
    *t = (render_targets){ 0 };
}
