#include "engine/overlay/overlay_internal.h"

enum {
    STREAM = 0,
    LOCATION_SIZE = 0,
    UNIT_IMAGE = 0,
    GROW_STEP = 4096 /* bytes, a multiple of both elements' sizes */
};

static void attribute(const overlay_painter *painter, GLuint index, GLint components, GLenum type, GLboolean normalized,
                      size_t offset)
{
    const nook_gl *gl = painter->gpu->gl;
    gl->EnableVertexArrayAttrib(painter->vertex_array, index);
    gl->VertexArrayAttribFormat(painter->vertex_array, index, components, type, normalized, (GLuint)offset);
    gl->VertexArrayAttribBinding(painter->vertex_array, index, STREAM);
}

/* Asked for each time: it may have been reloaded. */
static nook_result find_program(nook_gpu *gpu, nook_program *out_program)
{
    return nook_program_raster(gpu, "shaders/overlay/overlay.vert.glsl", "shaders/overlay/overlay.frag.glsl", "",
                               out_program);
}

nook_result overlay_painter_create(nook_gpu *gpu, overlay_painter *out_painter)
{
    overlay_painter painter = { .gpu = gpu };
    nook_program program;
    nook_result result = find_program(gpu, &program);
    if (result != NOOK_OK)
        return result;
    gpu->gl->CreateVertexArrays(1, &painter.vertex_array);
    attribute(&painter, 0, 2, GL_FLOAT, GL_FALSE, offsetof(overlay_vertex, position));
    attribute(&painter, 1, 2, GL_FLOAT, GL_FALSE, offsetof(overlay_vertex, uv));
    attribute(&painter, 2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(overlay_vertex, colour));
    *out_painter = painter;
    return NOOK_OK;
}

void overlay_painter_destroy(overlay_painter *painter)
{
    if (!painter->gpu)
        return;
    painter->gpu->gl->DeleteVertexArrays(1, &painter->vertex_array);
    nook_texture_destroy(painter->gpu, &painter->font);
    nook_buffer_destroy(painter->gpu, &painter->vertices);
    nook_buffer_destroy(painter->gpu, &painter->indices);
    *painter = (overlay_painter){ 0 };
}

nook_result overlay_painter_set_font(overlay_painter *painter, const void *rgba8, uint32_t width, uint32_t height)
{
    nook_texture font;
    nook_result result = nook_texture_create_2d(painter->gpu, GL_RGBA8, width, height, GL_LINEAR, &font);
    if (result != NOOK_OK)
        return result;
    nook_texture_write(painter->gpu, font, GL_RGBA, GL_UNSIGNED_BYTE, rgba8, (size_t)width * height * 4);
    nook_texture_destroy(painter->gpu, &painter->font);
    painter->font = font;
    return NOOK_OK;
}

static nook_result make_room(nook_gpu *gpu, nook_buffer *buffer, size_t size)
{
    if (buffer->size >= size && buffer->id != 0)
        return NOOK_OK;
    nook_buffer grown;
    nook_result result = nook_buffer_create(gpu, NULL, (size / GROW_STEP + 1) * GROW_STEP * 2, &grown);
    if (result != NOOK_OK)
        return result;
    nook_buffer_destroy(gpu, buffer);
    *buffer = grown;
    return NOOK_OK;
}

static void set_state(const overlay_painter *painter, nook_program program)
{
    const nook_gl *gl = painter->gpu->gl;
    nook_framebuffer_bind(painter->gpu, painter->target);
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_CULL_FACE);
    gl->Disable(GL_STENCIL_TEST);
    gl->Disable(GL_FRAMEBUFFER_SRGB);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    nook_program_use(painter->gpu, program);
    nook_uniform_float(painter->gpu, LOCATION_SIZE, painter->size, 2);
    gl->VertexArrayVertexBuffer(painter->vertex_array, STREAM, painter->vertices.id, 0, sizeof(overlay_vertex));
    gl->VertexArrayElementBuffer(painter->vertex_array, painter->indices.id);
    gl->BindVertexArray(painter->vertex_array);
}

nook_result overlay_painter_begin(overlay_painter *painter, nook_framebuffer target, const float size[2],
                                  uint32_t vertex_count, uint32_t index_count)
{
    nook_program program;
    nook_result result = find_program(painter->gpu, &program);
    if (result == NOOK_OK)
        result = make_room(painter->gpu, &painter->vertices, vertex_count * sizeof(overlay_vertex));
    if (result == NOOK_OK)
        result = make_room(painter->gpu, &painter->indices, index_count * sizeof(uint16_t));
    if (result != NOOK_OK)
        return result;
    painter->target = target;
    painter->size[0] = size[0], painter->size[1] = size[1];
    set_state(painter, program);
    return NOOK_OK;
}

void overlay_painter_upload(overlay_painter *painter, const overlay_vertex *vertices, uint32_t first_vertex,
                            uint32_t vertex_count, const uint16_t *indices, uint32_t first_index, uint32_t index_count)
{
    if (vertex_count > 0)
        nook_buffer_update(painter->gpu, painter->vertices, first_vertex * sizeof *vertices, vertices,
                           vertex_count * sizeof *vertices);
    if (index_count > 0)
        nook_buffer_update(painter->gpu, painter->indices, first_index * sizeof *indices, indices,
                           index_count * sizeof *indices);
}

static GLint clamp(float x, uint32_t high)
{
    return x < 0.0f ? 0 : x > (float)high ? (GLint)high : (GLint)x;
}

void overlay_painter_draw(overlay_painter *painter, const overlay_command *command)
{
    const nook_gl *gl = painter->gpu->gl;
    const nook_framebuffer *target = &painter->target;
    const float x = (float)target->width / painter->size[0], y = (float)target->height / painter->size[1];
    GLint left = clamp(command->clip[0] * x, target->width), right = clamp(command->clip[2] * x, target->width);
    GLint top = clamp(command->clip[1] * y, target->height), bottom = clamp(command->clip[3] * y, target->height);
    if (right <= left || bottom <= top || command->index_count == 0)
        return;
    gl->Scissor(left, (GLint)target->height - bottom, right - left, bottom - top);
    gl->BindTextureUnit(UNIT_IMAGE, command->texture);
    gl->DrawElementsBaseVertex(GL_TRIANGLES, (GLsizei)command->index_count, GL_UNSIGNED_SHORT,
                               (const void *)((uintptr_t)command->first_index * sizeof(uint16_t)),
                               (GLint)command->first_vertex);
}

void overlay_painter_end(overlay_painter *painter)
{
    const nook_gl *gl = painter->gpu->gl;
    gl->BindVertexArray(0);
    gl->Disable(GL_SCISSOR_TEST);
    gl->Disable(GL_BLEND);
    gl->BlendFunc(GL_ONE, GL_ZERO);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
}
