#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include <assert.h>
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/** As Material in shaders/render/material.glsl, std140, one every MATERIAL_STRIDE bytes. */
typedef struct material_block {
    float base_colour[4];
    float emissive_cutoff[4];
    float metallic, roughness, normal_scale, occlusion_strength;
    uint32_t flags[4];
    uint8_t padding[MATERIAL_STRIDE - 64];
} material_block;

static_assert(sizeof(material_block) == MATERIAL_STRIDE, "bound by its number times the stride");

enum { MATERIAL_UNLIT = 32 }; /* below it: 1 << UNIT_*_IMAGE */

/** Unit normal of a triangle, 0 when it has no area. In double: edges of large meshes are small differences. */
static void triangle_normal(const float *a, const float *b, const float *c, float out[3])
{
    double ab[3], ac[3], normal[3], unit[3] = { 0.0, 0.0, 0.0 };
    nook_vector_between(a, b, ab);
    nook_vector_between(a, c, ac);
    nook_vector_cross(ab, ac, normal);
    nook_vector_normalize(normal, unit);
    for (int i = 0; i < 3; i++)
        out[i] = (float)unit[i];
}

static void primitive_normals(const nook_scene *scene, const nook_primitive *primitive, float *out)
{
    const nook_vertex *vertices = scene->vertices + primitive->first_vertex;
    const uint32_t *index = scene->indices + primitive->first_index;
    for (uint32_t i = 0; i < primitive->index_count; i += 3)
        triangle_normal(vertices[index[i]].position, vertices[index[i + 1]].position, vertices[index[i + 2]].position,
                        out + i);
}

static void primitive_centre(const nook_scene *scene, const nook_primitive *primitive, float out[3])
{
    vec3 box[2];
    glm_aabb_invalidate(box);
    for (uint32_t i = 0; i < primitive->vertex_count; i++) {
        float *position = scene->vertices[primitive->first_vertex + i].position;
        glm_vec3_minv(box[0], position, box[0]);
        glm_vec3_maxv(box[1], position, box[1]);
    }
    glm_vec3_scale(box[0], 0.5f, out); /* halves first: their sum is a float at any size; without vertices it is 0 */
    glm_vec3_muladds(box[1], 0.5f, out);
}

static bool has_tangents(const nook_scene *scene)
{
    bool some = false;
    for (uint32_t i = 0; i < scene->vertex_count && !some; i++) {
        const float *t = scene->vertices[i].tangent;
        some = t[0] != 0.0f || t[1] != 0.0f || t[2] != 0.0f;
    }
    return some;
}

static bool has_colours(const nook_scene *scene)
{
    bool some = false;
    for (uint32_t i = 0; i < scene->vertex_count && !some; i++) {
        const float *c = scene->vertices[i].colour;
        some = c[0] != 1.0f || c[1] != 1.0f || c[2] != 1.0f || c[3] != 1.0f;
    }
    return some;
}

static nook_result upload(nook_render_scene *s, const void *data, size_t size, nook_buffer *out)
{
    static const uint32_t nothing[4] = { 0 };
    nook_result result = size > 0 ? nook_buffer_create(s->gpu, data, size, out)
                                  : nook_buffer_create(s->gpu, nothing, sizeof nothing, out);
    if (result == NOOK_OK)
        s->bytes += out->size;
    return result;
}

static nook_result upload_geometry(nook_render_scene *s)
{
    const nook_scene *scene = s->scene;
    size_t triangle_count = 0;
    for (uint32_t i = 0; i < scene->primitive_count; i++)
        triangle_count += scene->primitives[i].index_count / 3;
    float *normals = malloc(triangle_count * 3 * sizeof *normals + 1);
    if (normals == NULL)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu triangle normals", scene->path, triangle_count);

    uint32_t triangle = 0;
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        const nook_primitive *primitive = &scene->primitives[i];
        s->primitives[i] = (render_primitive){
            .first_index = primitive->first_index,
            .index_count = primitive->index_count,
            .first_vertex = primitive->first_vertex,
            .first_triangle = triangle,
            .material = primitive->material,
        };
        primitive_normals(scene, primitive, normals + (size_t)triangle * 3);
        primitive_centre(scene, primitive, s->primitives[i].centre);
        triangle += primitive->index_count / 3;
    }
    s->has_tangents = has_tangents(scene);
    s->has_colours = has_colours(scene);
    nook_result result = upload(s, normals, triangle_count * 3 * sizeof *normals, &s->triangle_normals);
    free(normals);
    if (result == NOOK_OK)
        result = upload(s, scene->vertices, scene->vertex_count * sizeof *scene->vertices, &s->vertices);
    if (result == NOOK_OK)
        result = upload(s, scene->indices, scene->index_count * sizeof *scene->indices, &s->indices);
    return result;
}

/** Index into s->textures of an image in one encoding; made on first use. */
static nook_result upload_image(nook_render_scene *s, uint32_t image, bool srgb, nook_texture *out)
{
    if (image == NOOK_NONE || s->scene->images[image].pixels == NULL)
        return NOOK_OK;
    nook_texture *texture = &s->textures[image * 2 + (srgb ? 1 : 0)];
    if (texture->id == 0) {
        const nook_image *source = &s->scene->images[image];
        nook_result result = nook_texture_create_mipped(s->gpu, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, source->width,
                                                        source->height, source->pixels, texture);
        if (result != NOOK_OK)
            return result;
        s->bytes += (uint64_t)source->width * source->height * 4 * 4 / 3;
    }
    *out = *texture;
    return NOOK_OK;
}

static nook_result upload_material_images(nook_render_scene *s, const nook_material *material, render_material *out)
{
    const struct {
        uint32_t image;
        bool srgb;
    } slots[] = {
        [UNIT_BASE_COLOUR_IMAGE] = { material->base_colour_image, true },
        [UNIT_METALLIC_ROUGHNESS_IMAGE] = { material->metallic_roughness_image, false },
        [UNIT_NORMAL_IMAGE] = { material->normal_image, false },
        [UNIT_EMISSIVE_IMAGE] = { material->emissive_image, true },
        [UNIT_OCCLUSION_IMAGE] = { material->occlusion_image, false },
    };
    for (size_t i = 0; i < NOOK_COUNT(slots); i++) {
        nook_result result = upload_image(s, slots[i].image, slots[i].srgb, &out->images[i]);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

static bool emits(const nook_material *material)
{
    return material->emissive[0] != 0.0f || material->emissive[1] != 0.0f || material->emissive[2] != 0.0f;
}

static uint32_t image_set(const render_material *material)
{
    uint32_t set = 0;
    for (uint32_t i = 0; i < MATERIAL_IMAGES; i++)
        set |= material->images[i].id != 0 ? 1u << i : 0u;
    return set;
}

static material_block material_numbers(const nook_material *material, uint32_t images)
{
    material_block block = {
        .metallic = material->metallic,
        .roughness = material->roughness,
        .normal_scale = material->normal_scale,
        .occlusion_strength = material->occlusion_strength,
    };
    memcpy(block.base_colour, material->base_colour, sizeof block.base_colour);
    memcpy(block.emissive_cutoff, material->emissive, sizeof material->emissive);
    block.emissive_cutoff[3] = material->alpha_cutoff;
    block.flags[0] = images | (material->unlit ? MATERIAL_UNLIT : 0u);
    return block;
}

static nook_result upload_materials(nook_render_scene *s)
{
    const nook_scene *scene = s->scene;
    material_block *blocks = calloc(scene->material_count, sizeof *blocks);
    if (blocks == NULL)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for %u materials", scene->path, scene->material_count);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < scene->material_count && result == NOOK_OK; i++) {
        result = upload_material_images(s, &scene->materials[i], &s->material_images[i]);
        s->material_images[i].image_set = image_set(&s->material_images[i]);
        s->material_images[i].emits = emits(&scene->materials[i]);
        blocks[i] = material_numbers(&scene->materials[i], s->material_images[i].image_set);
    }
    if (result == NOOK_OK)
        result = upload(s, blocks, scene->material_count * sizeof *blocks, &s->materials);
    free(blocks);
    return result;
}

nook_result nook_render_scene_create(nook_gpu *gpu, const nook_scene *scene, nook_render_scene **out_scene)
{
    *out_scene = NULL;
    nook_render_scene *s = calloc(1, sizeof *s);
    if (s == NULL)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to upload it", scene->path);
    s->gpu = gpu;
    s->scene = scene;
    s->created_ms = nook_clock_ms();
    s->texture_count = scene->image_count * 2;
    s->textures = calloc((size_t)s->texture_count + 1, sizeof *s->textures);
    s->primitives = calloc((size_t)scene->primitive_count + 1, sizeof *s->primitives);
    s->material_images = calloc((size_t)scene->material_count + 1, sizeof *s->material_images);

    nook_result result = NOOK_OK;
    if (s->textures == NULL || s->primitives == NULL || s->material_images == NULL)
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory to upload it", scene->path);
    if (result == NOOK_OK)
        result = upload_geometry(s);
    if (result == NOOK_OK)
        result = upload_materials(s);
    if (result == NOOK_OK)
        result = nook_deform_create(s);
    if (result != NOOK_OK) {
        nook_render_scene_destroy(s);
        return result;
    }
    *out_scene = s;
    return NOOK_OK;
}

void nook_render_scene_destroy(nook_render_scene *s)
{
    if (s == NULL)
        return;
    for (uint32_t i = 0; s->textures != NULL && i < s->texture_count; i++)
        nook_texture_destroy(s->gpu, &s->textures[i]);
    nook_buffer_destroy(s->gpu, &s->vertices);
    nook_buffer_destroy(s->gpu, &s->indices);
    nook_buffer_destroy(s->gpu, &s->triangle_normals);
    nook_buffer_destroy(s->gpu, &s->materials);
    nook_deform_destroy(s);
    nook_chunks_destroy(&s->chunks);
    free(s->textures);
    free(s->primitives);
    free(s->material_images);
    free(s);
}

uint64_t nook_render_scene_bytes(const nook_render_scene *scene)
{
    return scene->bytes;
}

size_t nook_scene_draws(const nook_scene *scene, nook_draw *out)
{
    size_t count = 0;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const nook_node *node = &scene->nodes[i];
        if (node->mesh == NOOK_NONE)
            continue;
        if (out != NULL)
            out[count] =
                (nook_draw){ .mesh = node->mesh, .moves = node->moving, .world_from_local = node->world_from_local };
        count++;
    }
    return count;
}
