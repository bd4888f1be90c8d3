#include "tests/support/test_render.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

void test_scene_init(test_scene *s)
{
    memset(s, 0, sizeof *s);
    s->scene.path = "test scene";
    s->scene.vertices = s->vertices;
    s->scene.indices = s->indices;
    s->scene.primitives = s->primitives;
    s->scene.meshes = s->meshes;
    s->scene.materials = s->materials;
    s->scene.images = s->images;
}

static void add_material(test_scene *s)
{
    s->materials[s->scene.material_count++] = (nook_material){
        .base_colour = { 0.5f, 0.5f, 0.5f, 1.0f },
        .roughness = 1.0f,
        .normal_scale = 1.0f,
        .occlusion_strength = 1.0f,
        .alpha_cutoff = 0.5f,
        .base_colour_image = NOOK_NONE,
        .metallic_roughness_image = NOOK_NONE,
        .normal_image = NOOK_NONE,
        .emissive_image = NOOK_NONE,
        .occlusion_image = NOOK_NONE,
    };
}

uint32_t test_scene_add_quad(test_scene *s, const float corner[3], const float u[3], const float v[3])
{
    static const uint32_t order[6] = { 0, 1, 2, 0, 2, 3 };
    nook_scene *scene = &s->scene;
    uint32_t number = scene->mesh_count;
    assert_true(number < TEST_SCENE_MESHES);
    nook_mesh *mesh = &s->meshes[number];
    *mesh = (nook_mesh){ .name = "quad", .first_primitive = number, .primitive_count = 1 };
    float n[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    s->primitives[number] =
        (nook_primitive){ (uint32_t)scene->vertex_count, 4, (uint32_t)scene->index_count, 6, number, false };
    for (int i = 0; i < 4; i++) {
        nook_vertex *vertex = &s->vertices[scene->vertex_count++];
        *vertex = (nook_vertex){ .colour = { 1, 1, 1, 1 } };
        vertex->uv[0] = i == 1 || i == 2 ? 1.0f : 0.0f;
        vertex->uv[1] = i >= 2 ? 0.0f : 1.0f; /* v = 0 is the image's top row */
        for (int k = 0; k < 3; k++) {
            vertex->position[k] = corner[k] + (i == 1 || i == 2 ? u[k] : 0.0f) + (i >= 2 ? v[k] : 0.0f);
            vertex->normal[k] = n[k] / length;
            mesh->bounds_min[k] = i == 0 ? vertex->position[k] : fminf(mesh->bounds_min[k], vertex->position[k]);
            mesh->bounds_max[k] = i == 0 ? vertex->position[k] : fmaxf(mesh->bounds_max[k], vertex->position[k]);
        }
    }
    for (int i = 0; i < 6; i++)
        s->indices[scene->index_count++] = order[i];
    scene->primitive_count++;
    scene->mesh_count++;
    add_material(s);
    return number;
}

uint32_t test_scene_add_facing(test_scene *s, float half, float z)
{
    return test_scene_add_quad(s, (float[3]){ -half, -half, z }, (float[3]){ 2 * half, 0, 0 },
                               (float[3]){ 0, 2 * half, 0 });
}

uint32_t test_scene_add_level(test_scene *s, float half, float x, float y, float z, bool up)
{
    float turn = up ? -2 * half : 2 * half;
    return test_scene_add_quad(s, (float[3]){ x - half, y, z - 0.5f * turn }, (float[3]){ 2 * half, 0, 0 },
                               (float[3]){ 0, 0, turn });
}

void test_picture_create(test_picture *p, nook_gpu *gpu, const test_scene *scene, uint32_t width, uint32_t height)
{
    memset(p, 0, sizeof *p);
    p->gpu = gpu;
    p->width = width;
    p->height = height;
    assert_int_equal(nook_renderer_create(gpu, width, height, &p->renderer), NOOK_OK);
    assert_int_equal(nook_render_scene_create(gpu, &scene->scene, &p->scene), NOOK_OK);
    for (uint32_t i = 0; i < scene->scene.mesh_count; i++)
        p->draws[i] = (nook_draw){ .mesh = i, .world_from_local = nook_matrix_identity() };
    p->lights = nook_lights_default();
    p->frame = (nook_frame){
        .scene = p->scene,
        .draws = p->draws,
        .draw_count = scene->scene.mesh_count,
        .camera = { nook_matrix_identity(), 1.5707963267948966, 0.1 },
        .lights = &p->lights,
    };
}

void test_picture_destroy(test_picture *p)
{
    nook_render_scene_destroy(p->scene);
    nook_renderer_destroy(p->renderer);
    free(p->pixels);
    memset(p, 0, sizeof *p);
}

void test_picture_render(test_picture *p, nook_view view)
{
    assert_int_equal(nook_frame_begin(p->renderer, &p->frame), NOOK_OK);
    nook_frame_finish(p->renderer, &p->frame, p->visibility, view);
    free(p->pixels);
    p->pixels = malloc((size_t)p->width * p->height * 3);
    assert_non_null(p->pixels);
    nook_renderer_read(p->renderer, p->pixels);
    assert_false(nook_gpu_check(p->gpu, "test picture"));
}

const uint8_t *test_picture_at(const test_picture *p, uint32_t x, uint32_t y)
{
    return p->pixels + ((size_t)y * p->width + x) * 3;
}

float test_picture_depth(const test_picture *p, uint32_t x, uint32_t y)
{
    size_t count = (size_t)p->width * p->height;
    float *all = malloc(count * sizeof *all);
    assert_non_null(all);
    nook_texture_read(p->gpu, nook_renderer_gbuffer(p->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT, all,
                      count * sizeof *all);
    float depth = all[(size_t)(p->height - 1 - y) * p->width + x];
    free(all);
    return depth;
}

/* As shaders/nook/octahedral.glsl, in double. */
static void decode(const uint16_t texel[2], double out[3])
{
    double x = (texel[0] - 32768.0) / 32767.0, y = (texel[1] - 32768.0) / 32767.0, z = 1.0 - fabs(x) - fabs(y);
    double fold = fmax(-z, 0.0);
    out[0] = x + (x >= 0.0 ? -fold : fold);
    out[1] = y + (y >= 0.0 ? -fold : fold);
    out[2] = z;
    double length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    for (int i = 0; i < 3; i++)
        out[i] /= length;
}

void test_picture_normal(const test_picture *p, nook_texture texture, uint32_t x, uint32_t y, double out[3])
{
    size_t size = (size_t)p->width * p->height * 2 * sizeof(uint16_t);
    uint16_t *all = malloc(size);
    assert_non_null(all);
    nook_texture_read(p->gpu, texture, GL_RG, GL_UNSIGNED_SHORT, all, size);
    decode(all + ((size_t)(p->height - 1 - y) * p->width + x) * 2, out);
    free(all);
}
