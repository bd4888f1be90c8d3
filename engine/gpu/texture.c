#include "engine/core/log.h"
#include "engine/gpu/gpu_internal.h"
#include <assert.h>

/* Enough for grazing floors; more costs software GL dearly. */
static const float WANTED_ANISOTROPY = 8.0f;

static nook_result check_size(const nook_gpu *gpu, const nook_texture *texture)
{
    uint32_t most = texture->target == GL_TEXTURE_3D ? gpu->max_texture_3d_size : gpu->max_texture_size;
    uint32_t least_side = texture->width < texture->height ? texture->width : texture->height;
    uint32_t greatest_side = texture->width > texture->height ? texture->width : texture->height;
    if (texture->depth < least_side)
        least_side = texture->depth;
    if (texture->depth > greatest_side)
        greatest_side = texture->depth;
    if (least_side == 0 || greatest_side > most)
        return nook_fail(NOOK_E_RANGE, "texture: %u x %u x %u texels; each side must be 1 to %u", texture->width,
                         texture->height, texture->depth, most);
    return NOOK_OK;
}

/* Names the texture and gives it its storage. texture->id is 0 on failure. */
static nook_result allocate(nook_gpu *gpu, nook_texture *texture, GLsizei levels)
{
    const nook_gl *gl = gpu->gl;
    nook_result result = check_size(gpu, texture);
    if (result != NOOK_OK)
        return result;
    nook_gpu_take_errors(gpu, "a call before a texture was made");
    gl->CreateTextures(texture->target, 1, &texture->id);
    if (texture->target == GL_TEXTURE_3D)
        gl->TextureStorage3D(texture->id, levels, texture->format, (GLsizei)texture->width, (GLsizei)texture->height,
                             (GLsizei)texture->depth);
    else
        gl->TextureStorage2D(texture->id, levels, texture->format, (GLsizei)texture->width, (GLsizei)texture->height);
    GLenum error = gl->GetError();
    if (error == GL_NO_ERROR)
        return NOOK_OK;
    gl->DeleteTextures(1, &texture->id);
    texture->id = 0;
    if (error == GL_OUT_OF_MEMORY)
        return nook_fail(NOOK_E_MEMORY, "texture: no room for %u x %u x %u texels of format 0x%04x", texture->width,
                         texture->height, texture->depth, texture->format);
    return nook_fail(NOOK_E_RANGE, "texture: 0x%04x is not a sized format that textures can have", texture->format);
}

static void set_sampling(nook_gpu *gpu, uint32_t id, uint32_t min_filter, uint32_t mag_filter, GLint wrap)
{
    const nook_gl *gl = gpu->gl;
    gl->TextureParameteri(id, GL_TEXTURE_MIN_FILTER, (GLint)min_filter);
    gl->TextureParameteri(id, GL_TEXTURE_MAG_FILTER, (GLint)mag_filter);
    gl->TextureParameteri(id, GL_TEXTURE_WRAP_S, wrap);
    gl->TextureParameteri(id, GL_TEXTURE_WRAP_T, wrap);
    gl->TextureParameteri(id, GL_TEXTURE_WRAP_R, wrap);
}

static nook_result create_one_level(nook_gpu *gpu, nook_texture texture, uint32_t filter, nook_texture *out_texture)
{
    assert(filter == GL_NEAREST || filter == GL_LINEAR);
    nook_result result = allocate(gpu, &texture, 1);
    if (result != NOOK_OK)
        return result;
    set_sampling(gpu, texture.id, filter, filter, GL_CLAMP_TO_EDGE);
    *out_texture = texture;
    return NOOK_OK;
}

nook_result nook_texture_create_2d(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height, uint32_t filter,
                                   nook_texture *out_texture)
{
    nook_texture texture = { .target = GL_TEXTURE_2D, .width = width, .height = height, .depth = 1, .format = format };
    return create_one_level(gpu, texture, filter, out_texture);
}

nook_result nook_texture_create_3d(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height, uint32_t depth,
                                   uint32_t filter, nook_texture *out_texture)
{
    nook_texture texture = {
        .target = GL_TEXTURE_3D, .width = width, .height = height, .depth = depth, .format = format
    };
    return create_one_level(gpu, texture, filter, out_texture);
}

nook_result nook_texture_create_mipped(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height,
                                       const void *rgba8, nook_texture *out_texture)
{
    nook_texture texture = { .target = GL_TEXTURE_2D, .width = width, .height = height, .depth = 1, .format = format };
    GLsizei levels = 1;
    for (uint32_t side = width > height ? width : height; side > 1; side /= 2)
        levels++;
    nook_result result = allocate(gpu, &texture, levels);
    if (result != NOOK_OK)
        return result;
    set_sampling(gpu, texture.id, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    float anisotropy = gpu->cache->max_anisotropy < WANTED_ANISOTROPY ? gpu->cache->max_anisotropy : WANTED_ANISOTROPY;
    if (anisotropy > 1 && !gpu->software) /* the CPU would spend more than half of the G-buffer's time on it */
        gpu->gl->TextureParameterf(texture.id, GL_TEXTURE_MAX_ANISOTROPY, anisotropy);
    nook_texture_write(gpu, texture, GL_RGBA, GL_UNSIGNED_BYTE, rgba8, (size_t)width * height * 4);
    gpu->gl->GenerateTextureMipmap(texture.id);
    *out_texture = texture;
    return NOOK_OK;
}

/* Bytes; 0 for a format that nobody here shows a buffer in. */
static size_t buffer_texel_size(uint32_t format)
{
    switch (format) {
    case GL_RGBA32F:
    case GL_RGBA32UI:
        return 16;
    case GL_RG32UI:
        return 8;
    case GL_R8UI:
        return 1;
    default:
        return 0;
    }
}

nook_result nook_texture_create_buffer(nook_gpu *gpu, uint32_t format, nook_buffer buffer, nook_texture *out_texture)
{
    const nook_gl *gl = gpu->gl;
    assert(buffer.id != 0 && buffer_texel_size(format) != 0);
    const size_t count = buffer.size / buffer_texel_size(format);
    nook_texture texture = { .target = GL_TEXTURE_BUFFER, .height = 1, .depth = 1, .format = format };
    if (count > gpu->max_texture_buffer_size)
        return nook_fail(NOOK_E_RANGE, "texture: a buffer of %zu texels; the device takes %u", count,
                         gpu->max_texture_buffer_size);
    texture.width = (uint32_t)count;
    nook_gpu_take_errors(gpu, "a call before a texture was made");
    gl->CreateTextures(GL_TEXTURE_BUFFER, 1, &texture.id);
    gl->TextureBuffer(texture.id, texture.format, buffer.id);
    if (gl->GetError() != GL_NO_ERROR) {
        gl->DeleteTextures(1, &texture.id);
        return nook_fail(NOOK_E_MEMORY, "texture: no room for one of a buffer");
    }
    *out_texture = texture;
    return NOOK_OK;
}

void nook_texture_destroy(nook_gpu *gpu, nook_texture *texture)
{
    if (texture->id != 0)
        gpu->gl->DeleteTextures(1, &texture->id);
    *texture = (nook_texture){ 0 };
}

static size_t channel_count(uint32_t gl_format)
{
    switch (gl_format) {
    case GL_RG:
    case GL_RG_INTEGER:
        return 2;
    case GL_RGB:
    case GL_RGB_INTEGER:
    case GL_BGR:
        return 3;
    case GL_RGBA:
    case GL_RGBA_INTEGER:
    case GL_BGRA:
        return 4;
    default:
        return 1;
    }
}

/* Bytes of one texel in memory; packed types hold all their channels in 4 bytes. */
static size_t texel_size(uint32_t gl_format, uint32_t gl_type)
{
    switch (gl_type) {
    case GL_BYTE:
    case GL_UNSIGNED_BYTE:
        return channel_count(gl_format);
    case GL_SHORT:
    case GL_UNSIGNED_SHORT:
    case GL_HALF_FLOAT:
        return channel_count(gl_format) * 2;
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_FLOAT:
        return channel_count(gl_format) * 4;
    default:
        return 4;
    }
}

void nook_texture_write(nook_gpu *gpu, nook_texture texture, uint32_t gl_format, uint32_t gl_type, const void *data,
                        size_t size)
{
    const uint32_t origin[3] = { 0, 0, 0 }, extent[3] = { texture.width, texture.height, texture.depth };
    nook_texture_write_box(gpu, texture, origin, extent, gl_format, gl_type, data, size);
}

void nook_texture_write_box(nook_gpu *gpu, nook_texture texture, const uint32_t origin[3], const uint32_t extent[3],
                            uint32_t gl_format, uint32_t gl_type, const void *data, size_t size)
{
    const nook_gl *gl = gpu->gl;
    assert((uint64_t)origin[0] + extent[0] <= texture.width && (uint64_t)origin[1] + extent[1] <= texture.height &&
           (uint64_t)origin[2] + extent[2] <= texture.depth);
    assert(size == (size_t)extent[0] * extent[1] * extent[2] * texel_size(gl_format, gl_type));
    (void)size;
    GLint alignment; /* the host's own is put back */
    gl->GetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (texture.target == GL_TEXTURE_3D)
        gl->TextureSubImage3D(texture.id, 0, (GLint)origin[0], (GLint)origin[1], (GLint)origin[2], (GLsizei)extent[0],
                              (GLsizei)extent[1], (GLsizei)extent[2], gl_format, gl_type, data);
    else
        gl->TextureSubImage2D(texture.id, 0, (GLint)origin[0], (GLint)origin[1], (GLsizei)extent[0], (GLsizei)extent[1],
                              gl_format, gl_type, data);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, alignment);
}

void nook_texture_read(nook_gpu *gpu, nook_texture texture, uint32_t gl_format, uint32_t gl_type, void *out,
                       size_t out_size)
{
    assert(out_size >= (size_t)texture.width * texture.height * texture.depth * texel_size(gl_format, gl_type));
    GLint alignment;
    gpu->gl->GetIntegerv(GL_PACK_ALIGNMENT, &alignment);
    gpu->gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    /* The driver counts in int; it never writes more than the texture holds, so a smaller bound is safe. */
    gpu->gl->GetTextureImage(texture.id, 0, gl_format, gl_type, out_size > INT32_MAX ? INT32_MAX : (GLsizei)out_size,
                             out);
    gpu->gl->PixelStorei(GL_PACK_ALIGNMENT, alignment);
}

void nook_bind_texture(nook_gpu *gpu, uint32_t unit, nook_texture texture)
{
    gpu->gl->BindTextureUnit(unit, texture.id);
}

void nook_bind_image(nook_gpu *gpu, uint32_t unit, nook_texture texture, uint32_t access)
{
    gpu->gl->BindImageTexture(unit, texture.id, 0, texture.target == GL_TEXTURE_3D ? GL_TRUE : GL_FALSE, 0, access,
                              texture.format);
}
