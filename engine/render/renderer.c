#include "engine/render/renderer.h"
#include "engine/core/log.h"
#include "engine/render/internal.h"
#include <stdlib.h>
#include <string.h>

static const char *const view_names[NOOK_VIEW_COUNT] = {
    "lit",      "base_colour", "normal", "geometric_normal", "depth", "metallic",   "roughness",
    "emissive", "visibility",  "shadow", "occlusion_map",    "light", "shadow_map",
};

const char *nook_view_name(nook_view view)
{
    return view_names[view];
}

bool nook_view_parse(const char *name, nook_view *out_view)
{
    for (int i = 0; i < NOOK_VIEW_COUNT; i++) {
        if (strcmp(name, view_names[i]) == 0) {
            *out_view = (nook_view)i;
            return true;
        }
    }
    return false;
}

static nook_result create_programs(nook_renderer *r)
{
    const char *surface = "shaders/render/surface.vert.glsl", *screen = "shaders/render/fullscreen.vert.glsl";
    const char *shadow = "shaders/render/shadow.vert.glsl", *masked = "#define MASKED\n";
    const struct {
        const char *vertex, *fragment, *defines;
        nook_program *program;
    } list[] = {
        { shadow, "shaders/render/shadow.frag.glsl", "", &r->shadow_program },
        { shadow, "shaders/render/shadow.frag.glsl", masked, &r->shadow_masked_program },
        { surface, "shaders/render/gbuffer.frag.glsl", "", &r->gbuffer_program },
        { surface, "shaders/render/gbuffer.frag.glsl", masked, &r->gbuffer_masked_program },
        { surface, "shaders/render/blended.frag.glsl", "", &r->blended_program },
        { screen, "shaders/render/lighting.frag.glsl", "", &r->lighting_program },
        { screen, "shaders/render/lighting.frag.glsl", "#define TO_IMAGE\n", &r->lighting_image_program },
        { screen, "shaders/render/view.frag.glsl", "", &r->view_program },
    };
    for (size_t i = 0; i < NOOK_COUNT(list); i++) {
        nook_result result =
            nook_program_raster(r->gpu, list[i].vertex, list[i].fragment, list[i].defines, list[i].program);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

enum { TEXTURE_SRGB_DECODE = 0x8A48, SKIP_DECODE = 0x8A4A /* GL_EXT_texture_sRGB_decode, in no header of core GL */ };

/**
 * Bilinear in the nearest level: on software GL half of trilinear, and a quarter of anisotropic. Colours stay as they are encoded: they
 * go into the G-buffer so, and a software driver decodes each of four texels, filters in float and encodes again. The level is rounded
 * down, to the sharper of the two that trilinear mixes: rounded to the nearest, walls are blurred (docs/measurements.md).
 */
static void create_quick_sampler(nook_renderer *r)
{
    const nook_gl *gl = r->gpu->gl;
    gl->CreateSamplers(1, &r->quick_sampler);
    gl->SamplerParameteri(r->quick_sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    gl->SamplerParameteri(r->quick_sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->SamplerParameterf(r->quick_sampler, GL_TEXTURE_LOD_BIAS, -0.5f);
    gl->SamplerParameteri(r->quick_sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->SamplerParameteri(r->quick_sampler, GL_TEXTURE_WRAP_T, GL_REPEAT);
    if (r->gpu->skips_srgb_decode)
        gl->SamplerParameteri(r->quick_sampler, TEXTURE_SRGB_DECODE, SKIP_DECODE);
}

static void create_nearest_sampler(nook_renderer *r)
{
    const nook_gl *gl = r->gpu->gl;
    gl->CreateSamplers(1, &r->nearest_sampler);
    gl->SamplerParameteri(r->nearest_sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->SamplerParameteri(r->nearest_sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static nook_result create_fixed(nook_renderer *r)
{
    const uint8_t white[4] = { 255, 255, 255, 255 };
    nook_result result =
        nook_texture_create_2d(r->gpu, GL_DEPTH_COMPONENT32F, SHADOW_SIZE, SHADOW_SIZE, GL_NEAREST, &r->shadow_map);
    if (result == NOOK_OK)
        result = nook_framebuffer_create(r->gpu, NULL, 0, r->shadow_map, &r->shadow_target);
    if (result == NOOK_OK)
        result = nook_texture_create_mipped(r->gpu, GL_RGBA8, 1, 1, white, &r->white);
    if (result == NOOK_OK)
        result = nook_buffer_create(r->gpu, NULL, sizeof(frame_block), &r->frame_uniforms);
    if (result == NOOK_OK)
        result = nook_buffer_create(r->gpu, NULL, sizeof(lights_block), &r->light_uniforms);
    if (result == NOOK_OK) {
        create_quick_sampler(r);
        create_nearest_sampler(r);
        r->vertex_array = nook_vertex_array_create(r->gpu);
        r->gpu->gl->CreateVertexArrays(1, &r->empty_vertex_array);
    }
    return result;
}

nook_result nook_renderer_create(nook_gpu *gpu, uint32_t width, uint32_t height, nook_renderer **out_renderer)
{
    *out_renderer = NULL;
    nook_renderer *r = calloc(1, sizeof *r);
    if (r == NULL)
        return nook_fail(NOOK_E_MEMORY, "renderer: no memory");
    r->gpu = gpu;
    nook_result result = nook_renderer_set_size(r, width, height);
    if (result == NOOK_OK)
        result = create_programs(r);
    if (result == NOOK_OK)
        result = create_fixed(r);
    if (result != NOOK_OK) {
        nook_renderer_destroy(r);
        return result;
    }
    *out_renderer = r;
    return NOOK_OK;
}

void nook_renderer_destroy(nook_renderer *r)
{
    if (r == NULL)
        return;
    const nook_gl *gl = r->gpu->gl;
    nook_targets_destroy(r->gpu, &r->targets);
    nook_draw_set_destroy(r->gpu, &r->visible);
    nook_draw_set_destroy(r->gpu, &r->casters);
    nook_cull_destroy(r->gpu, &r->cull);
    free(r->blended.items);
    free(r->shadow.draws.items);
    free(r->shadow.some.items);
    nook_framebuffer_destroy(r->gpu, &r->shadow_target);
    nook_framebuffer_destroy(r->gpu, &r->shadow_base_target);
    gl->DeleteVertexArrays(1, &r->vertex_array);
    gl->DeleteVertexArrays(1, &r->empty_vertex_array);
    gl->DeleteSamplers(1, &r->quick_sampler);
    gl->DeleteSamplers(1, &r->nearest_sampler);
    nook_texture_destroy(r->gpu, &r->shadow_map);
    nook_texture_destroy(r->gpu, &r->shadow_base);
    nook_texture_destroy(r->gpu, &r->white);
    nook_buffer_destroy(r->gpu, &r->frame_uniforms);
    nook_buffer_destroy(r->gpu, &r->light_uniforms);
    free(r);
}

nook_result nook_renderer_set_size(nook_renderer *r, uint32_t width, uint32_t height)
{
    uint32_t most = r->gpu->max_texture_size;
    if (width == r->width && height == r->height && width != 0)
        return NOOK_OK;
    if (width == 0 || height == 0 || width > most || height > most)
        return nook_fail(NOOK_E_RANGE, "picture of %u x %u pixels: both must lie in 1 .. %u", width, height, most);
    render_targets targets;
    nook_result result = nook_targets_create(r->gpu, width, height, &targets);
    if (result != NOOK_OK)
        return result;
    nook_targets_destroy(r->gpu, &r->targets);
    r->targets = targets;
    r->width = width;
    r->height = height;
    return NOOK_OK;
}

nook_gbuffer nook_renderer_gbuffer(const nook_renderer *r)
{
    return r->targets.gbuffer;
}

nook_matrix nook_renderer_clip_from_view(const nook_renderer *r, const nook_camera *camera)
{
    return nook_matrix_perspective_reversed(camera->fov_y_radians, (double)r->width / r->height, camera->z_near);
}

nook_texture nook_renderer_image(const nook_renderer *r)
{
    return r->targets.image;
}

void nook_renderer_read(nook_renderer *r, uint8_t *out)
{
    size_t row = (size_t)r->width * 3;
    nook_texture_read(r->gpu, r->targets.image, GL_RGB, GL_UNSIGNED_BYTE, out, row * r->height);
    for (uint32_t low = 0, high = r->height - 1; low < high; low++, high--) {
        for (size_t i = 0; i < row; i++) {
            uint8_t byte = out[low * row + i];
            out[low * row + i] = out[high * row + i];
            out[high * row + i] = byte;
        }
    }
}

void nook_renderer_present(nook_renderer *r, uint32_t width, uint32_t height)
{
    r->gpu->gl->BlitNamedFramebuffer(r->targets.image_target.id, 0, 0, 0, (GLint)r->width, (GLint)r->height, 0, 0,
                                     (GLint)width, (GLint)height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}
