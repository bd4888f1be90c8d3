#include "engine/core/log.h"
#include "engine/gpu/gpu_internal.h"

enum { COLOUR_CAPACITY = 8 }; /* what 4.5 promises */

static nook_result check_sizes(const nook_texture *colours, uint32_t colour_count, nook_texture depth)
{
    if (colour_count > COLOUR_CAPACITY || (colour_count == 0 && depth.id == 0))
        return nook_fail(NOOK_E_RANGE,
                         "framebuffer: %u colour textures and %s depth; it takes 1 texture to %d and depth",
                         colour_count, depth.id ? "one" : "no", COLOUR_CAPACITY);
    const nook_texture *first = colour_count > 0 ? &colours[0] : &depth;
    for (uint32_t i = 0; i <= colour_count; i++) {
        const nook_texture *texture = i < colour_count ? &colours[i] : &depth;
        if (i == colour_count && depth.id == 0)
            break;
        if (texture->id == 0 || texture->width != first->width || texture->height != first->height)
            return nook_fail(NOOK_E_RANGE, "framebuffer: texture %u is %u x %u, the first is %u x %u", i,
                             texture->width, texture->height, first->width, first->height);
    }
    return NOOK_OK;
}

/* The targets are those of the shader's outputs; what the driver cannot draw to is deleted. */
static nook_result complete(nook_gpu *gpu, nook_framebuffer framebuffer, uint32_t colour_count,
                            nook_framebuffer *out_framebuffer)
{
    const nook_gl *gl = gpu->gl;
    GLenum targets[COLOUR_CAPACITY] = { GL_NONE };
    for (uint32_t i = 0; i < colour_count; i++)
        targets[i] = GL_COLOR_ATTACHMENT0 + i;
    gl->NamedFramebufferDrawBuffers(framebuffer.id, colour_count > 0 ? (GLsizei)colour_count : 1, targets);
    GLenum status = gl->CheckNamedFramebufferStatus(framebuffer.id, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        gl->DeleteFramebuffers(1, &framebuffer.id);
        return nook_fail(NOOK_E_DEVICE, "framebuffer: this driver cannot draw to these formats (status 0x%04x)",
                         status);
    }
    *out_framebuffer = framebuffer;
    return NOOK_OK;
}

nook_result nook_framebuffer_create(nook_gpu *gpu, const nook_texture *colours, uint32_t colour_count,
                                    nook_texture depth, nook_framebuffer *out_framebuffer)
{
    const nook_gl *gl = gpu->gl;
    nook_result result = check_sizes(colours, colour_count, depth);
    if (result != NOOK_OK)
        return result;
    const nook_texture *first = colour_count > 0 ? &colours[0] : &depth;
    nook_framebuffer framebuffer = { .width = first->width, .height = first->height };
    gl->CreateFramebuffers(1, &framebuffer.id);
    for (uint32_t i = 0; i < colour_count; i++)
        gl->NamedFramebufferTexture(framebuffer.id, GL_COLOR_ATTACHMENT0 + i, colours[i].id, 0);
    if (depth.id != 0)
        gl->NamedFramebufferTexture(framebuffer.id, GL_DEPTH_ATTACHMENT, depth.id, 0);
    return complete(gpu, framebuffer, colour_count, out_framebuffer);
}

nook_result nook_framebuffer_create_slices(nook_gpu *gpu, nook_texture colours, nook_framebuffer *out_framebuffer)
{
    const nook_gl *gl = gpu->gl;
    if (colours.id == 0 || colours.depth > COLOUR_CAPACITY)
        return nook_fail(NOOK_E_RANGE, "framebuffer: a texture of %u slices; 1 to %d can be drawn to at once",
                         colours.depth, COLOUR_CAPACITY);
    nook_framebuffer framebuffer = { .width = colours.width, .height = colours.height };
    gl->CreateFramebuffers(1, &framebuffer.id);
    for (uint32_t i = 0; i < colours.depth; i++)
        gl->NamedFramebufferTextureLayer(framebuffer.id, GL_COLOR_ATTACHMENT0 + i, colours.id, 0, (GLint)i);
    return complete(gpu, framebuffer, colours.depth, out_framebuffer);
}

void nook_framebuffer_destroy(nook_gpu *gpu, nook_framebuffer *framebuffer)
{
    if (framebuffer->id != 0)
        gpu->gl->DeleteFramebuffers(1, &framebuffer->id);
    *framebuffer = (nook_framebuffer){ 0 };
}

void nook_framebuffer_bind(nook_gpu *gpu, nook_framebuffer framebuffer)
{
    gpu->gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id);
    gpu->gl->Viewport(0, 0, (GLsizei)framebuffer.width, (GLsizei)framebuffer.height);
}
