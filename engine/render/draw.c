#include "engine/render/internal.h"

static void enable(const nook_gl *gl, GLenum what, bool on)
{
    if (on)
        gl->Enable(what);
    else
        gl->Disable(what);
}

void nook_raster_begin(nook_gpu *gpu, nook_framebuffer framebuffer, raster_state state)
{
    const nook_gl *gl = gpu->gl;
    nook_framebuffer_bind(gpu, framebuffer);
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    enable(gl, GL_SCISSOR_TEST, state.part.width != 0);
    if (state.part.width != 0)
        gl->Scissor((GLint)state.part.x, (GLint)state.part.y, (GLsizei)state.part.width, (GLsizei)state.part.height);
    gl->Disable(GL_STENCIL_TEST);
    enable(gl, GL_DEPTH_TEST, state.depth_compare != 0);
    if (state.depth_compare != 0)
        gl->DepthFunc(state.depth_compare);
    gl->DepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    enable(gl, GL_CULL_FACE, state.cull);
    gl->CullFace(GL_BACK);
    gl->FrontFace(GL_CCW);
    enable(gl, GL_BLEND, state.blend);
    if (state.blend)
        gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    enable(gl, GL_FRAMEBUFFER_SRGB, state.srgb);
}

void nook_raster_end(nook_gpu *gpu)
{
    const nook_gl *gl = gpu->gl;
    gl->BindVertexArray(0);
    gl->Disable(GL_SCISSOR_TEST);
    gl->Disable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->DepthMask(GL_TRUE);
    gl->Disable(GL_CULL_FACE);
    gl->FrontFace(GL_CCW);
    gl->Disable(GL_BLEND);
    gl->Disable(GL_FRAMEBUFFER_SRGB);
    gl->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void attribute(const nook_gl *gl, GLuint array, GLuint index, GLint components, size_t offset, GLuint stream)
{
    gl->EnableVertexArrayAttrib(array, index);
    gl->VertexArrayAttribFormat(array, index, components, GL_FLOAT, GL_FALSE, (GLuint)offset);
    gl->VertexArrayAttribBinding(array, index, stream);
}

uint32_t nook_vertex_array_create(nook_gpu *gpu)
{
    const nook_gl *gl = gpu->gl;
    GLuint array = 0;
    gl->CreateVertexArrays(1, &array);
    attribute(gl, array, 0, 3, offsetof(nook_vertex, position), VERTEX_STREAM);
    attribute(gl, array, 1, 3, offsetof(nook_vertex, normal), VERTEX_STREAM);
    attribute(gl, array, 2, 4, offsetof(nook_vertex, tangent), VERTEX_STREAM);
    attribute(gl, array, 3, 2, offsetof(nook_vertex, uv), VERTEX_STREAM);
    attribute(gl, array, 4, 4, offsetof(nook_vertex, colour), VERTEX_STREAM);
    for (GLuint i = 0; i < sizeof(instance_data) / 16; i++) /* columns of both matrices, four floats each */
        attribute(gl, array, ATTRIBUTE_INSTANCE + i, 4, i * 16, INSTANCE_STREAM);
    gl->VertexArrayBindingDivisor(array, INSTANCE_STREAM, 1);
    return array;
}

void nook_bind_geometry(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set)
{
    const nook_gl *gl = renderer->gpu->gl;
    GLuint array = renderer->vertex_array;
    gl->VertexArrayVertexBuffer(array, VERTEX_STREAM, scene->vertices.id, 0, sizeof(nook_vertex));
    gl->VertexArrayVertexBuffer(array, INSTANCE_STREAM, set->buffer.id, 0, sizeof(instance_data));
    gl->VertexArrayElementBuffer(array, scene->indices.id);
    gl->BindVertexArray(array);
    nook_bind_uniform(renderer->gpu, UNIFORM_FRAME, renderer->frame_uniforms);
    nook_bind_uniform(renderer->gpu, UNIFORM_LIGHTS, renderer->light_uniforms);
    nook_bind_storage(renderer->gpu, STORAGE_TRIANGLE_NORMALS, scene->triangle_normals);
}

void nook_bind_material(nook_renderer *renderer, const nook_render_scene *scene, uint32_t material)
{
    const render_material *m = &scene->material_images[material];
    renderer->gpu->gl->BindBufferRange(GL_UNIFORM_BUFFER, UNIFORM_MATERIAL, scene->materials.id,
                                       (GLintptr)material * MATERIAL_STRIDE, MATERIAL_STRIDE);
    for (uint32_t i = 0; i < NOOK_COUNT(m->images); i++)
        nook_bind_texture(renderer->gpu, i, m->images[i].id != 0 ? m->images[i] : renderer->white);
}

void nook_draw_primitive(nook_renderer *renderer, const nook_render_scene *scene, uint32_t primitive,
                         uint32_t first_instance, uint32_t instance_count)
{
    const nook_gl *gl = renderer->gpu->gl;
    const render_primitive *p = &scene->primitives[primitive];
    if (p->index_count == 0)
        return;
    const uint32_t draw[2] = { p->first_triangle, p->index_count / 3 };
    nook_uniform_uint(renderer->gpu, LOCATION_DRAW, draw, 2);
    gl->DrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, (GLsizei)p->index_count, GL_UNSIGNED_INT,
                                                    (const void *)((uintptr_t)p->first_index * sizeof(uint32_t)),
                                                    (GLsizei)instance_count, (GLint)p->first_vertex, first_instance);
}

/** How a pass draws. */
typedef struct solid_draw {
    program_choice choose;
    const void *user;
    bool cull;
    const index_range *ranges; /* NULL: whole primitives */
    const uint32_t *first_range, *draws;
} solid_draw;

/** What is listed of an instance's primitive. @param primitive  of its mesh */
static const index_range *range_of(const solid_draw *how, uint32_t instance, uint32_t primitive)
{
    return &how->ranges[how->first_range[how->draws[instance]] + primitive];
}

/** How many indices of a primitive of a batch's mesh are drawn. */
static uint32_t indices_of(const nook_render_scene *s, const batch *b, uint32_t primitive, const solid_draw *how)
{
    uint32_t indices = 0;
    if (!how->ranges)
        return s->primitives[s->scene->meshes[b->mesh].first_primitive + primitive].index_count * b->instance_count;
    for (uint32_t i = 0; i < b->instance_count; i++)
        indices += range_of(how, b->first_instance + i, primitive)->count;
    return indices;
}

/** Draws of each instance of one primitive what is listed; its material is bound. */
static void draw_ranges(nook_renderer *renderer, const nook_render_scene *s, const batch *b, uint32_t primitive,
                        const solid_draw *how)
{
    const render_primitive *p = &s->primitives[s->scene->meshes[b->mesh].first_primitive + primitive];
    for (uint32_t i = b->first_instance; i < b->first_instance + b->instance_count; i++) {
        const index_range *range = range_of(how, i, primitive);
        if (range->count > 0)
            renderer->gpu->gl->DrawElementsInstancedBaseVertexBaseInstance(
                GL_TRIANGLES, (GLsizei)range->count, GL_UNSIGNED_INT,
                (const void *)((uintptr_t)range->first * sizeof(uint32_t)), 1, (GLint)p->first_vertex, i);
    }
}

/** The primitives of a batch that have one alpha mode. */
static void draw_batch(nook_renderer *renderer, const nook_render_scene *s, const batch *b, nook_alpha_mode mode,
                       const solid_draw *how)
{
    const nook_gl *gl = renderer->gpu->gl;
    const nook_mesh *mesh = &s->scene->meshes[b->mesh];
    gl->FrontFace(b->mirrored ? GL_CW : GL_CCW);
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        uint32_t primitive = mesh->first_primitive + i, number = s->primitives[primitive].material;
        const nook_material *material = &s->scene->materials[number];
        if (material->alpha_mode != mode)
            continue;
        if (indices_of(s, b, i, how) == 0)
            continue;
        nook_program program = how->choose(renderer, how->user, &s->material_images[number], mode == NOOK_ALPHA_MASK);
        if (program.handle == 0)
            continue;
        enable(gl, GL_CULL_FACE, how->cull && !material->double_sided);
        nook_program_use(renderer->gpu, program);
        nook_bind_material(renderer, s, number);
        if (how->ranges)
            draw_ranges(renderer, s, b, i, how);
        else
            nook_draw_primitive(renderer, s, primitive, b->first_instance, b->instance_count);
    }
}

static uint32_t triangles_of(const nook_render_scene *s, const batch *b, const solid_draw *how)
{
    uint32_t indices = 0;
    for (uint32_t i = 0; i < s->scene->meshes[b->mesh].primitive_count; i++)
        indices += indices_of(s, b, i, how);
    return indices / 3;
}

/**
 * Software GL begins to fill triangles, on threads of its own, when it is flushed, and works on vertices in this thread only: what is
 * flushed early fills its pixels meanwhile. Of listed triangles nearly each has pixels.
 */
enum { FLUSHED_TRIANGLES = 24000, FLUSHED_LISTED = 6000 };

static void draw_batches(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set,
                         const solid_draw *how)
{
    const batch *batches = set->batches.items;
    const uint32_t most = how->ranges ? FLUSHED_LISTED : FLUSHED_TRIANGLES;
    uint32_t triangles = 0;
    for (uint32_t i = 0; i < set->batch_count; i++) {
        draw_batch(renderer, scene, &batches[i], NOOK_ALPHA_OPAQUE, how);
        triangles += triangles_of(scene, &batches[i], how);
        if (renderer->gpu->software && triangles >= most) {
            renderer->gpu->gl->Flush();
            triangles = 0;
        }
    }
    for (uint32_t i = 0; i < set->batch_count; i++)
        draw_batch(renderer, scene, &batches[i], NOOK_ALPHA_MASK, how);
}

void nook_draw_solid(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set,
                     program_choice choose, const void *user, bool cull)
{
    const solid_draw how = { choose, user, cull, NULL, NULL, NULL };
    nook_bind_geometry(renderer, scene, set);
    draw_batches(renderer, scene, set, &how);
}

void nook_draw_listed(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set,
                      program_choice choose, const void *user, bool cull, const index_list *list,
                      const uint32_t *first_range)
{
    const solid_draw how = { choose, user, cull, list->ranges.items, first_range, set->draws.items };
    nook_bind_geometry(renderer, scene, set);
    renderer->gpu->gl->VertexArrayElementBuffer(renderer->vertex_array, list->buffer.id);
    draw_batches(renderer, scene, set, &how);
}

void nook_draw_fullscreen(nook_renderer *renderer, nook_program program)
{
    const nook_gl *gl = renderer->gpu->gl;
    nook_program_use(renderer->gpu, program);
    gl->BindVertexArray(renderer->empty_vertex_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}
