/* A host of its own: no ECS, renderer, asset loader, context or test helper of ours. premake5.lua links it with the AO core, two
   techniques, the volume file, the device and engine/core, and nothing else. docs/embedding.md walks through it. */
#include "engine/core/result.h"
#include "engine/gpu/gpu.h"
#include "modules/ao/nook_ao.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"
#include "modules/bake/volume_file.h"
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48 };

/* ---- What a host has already: a GL context, a depth buffer, a file ---- */

typedef struct host {
    void *library; /* libOSMesa */
    OSMesaContext context;
    OSMesaContext (*create_context)(const int *attributes, OSMesaContext share);
    GLboolean (*make_current)(OSMesaContext context, void *buffer, GLenum type, GLsizei width, GLsizei height);
    void (*destroy_context)(OSMesaContext context);
    void (*(*get_proc)(const char *name))(void);
    uint32_t pixels[16 * 16]; /* the window, which nobody looks at */

    nook_gpu *gpu;
    nook_ao *ao;
    GLuint depth; /* GL_DEPTH_COMPONENT32F, WIDTH x HEIGHT */
    double clip_from_view[16], view_from_world[16];
} host;

static void find(const host *self, const char *name, void *out_function)
{
    *(void **)out_function = dlsym(self->library, name);
    assert_non_null(*(void **)out_function);
}

static void open_context(host *self)
{
    static const int attributes[] = {
        OSMESA_PROFILE, OSMESA_CORE_PROFILE, OSMESA_CONTEXT_MAJOR_VERSION, 4, OSMESA_CONTEXT_MINOR_VERSION, 5, 0
    };
    self->library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    assert_non_null(self->library);
    find(self, "OSMesaCreateContextAttribs", &self->create_context);
    find(self, "OSMesaMakeCurrent", &self->make_current);
    find(self, "OSMesaDestroyContext", &self->destroy_context);
    find(self, "OSMesaGetProcAddress", &self->get_proc);
    self->context = self->create_context(attributes, NULL);
    assert_non_null(self->context);
    assert_true(self->make_current(self->context, self->pixels, GL_UNSIGNED_BYTE, 16, 16));
}

/** The host's own frame: a floor 1 m below a camera that looks straight down; reversed-Z, near plane at 0.1 m. */
static void draw_floor(host *self)
{
    static const double near = 0.1, zoom = 4.0;
    float depth[WIDTH * HEIGHT];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        depth[i] = (float)(near / 1.0);
    self->gpu->gl->CreateTextures(GL_TEXTURE_2D, 1, &self->depth);
    self->gpu->gl->TextureStorage2D(self->depth, 1, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT);
    self->gpu->gl->TextureSubImage2D(self->depth, 0, 0, 0, WIDTH, HEIGHT, GL_DEPTH_COMPONENT, GL_FLOAT, depth);

    self->clip_from_view[0] = zoom * HEIGHT / WIDTH;
    self->clip_from_view[5] = zoom;
    self->clip_from_view[11] = -1.0;
    self->clip_from_view[14] = near;
    /* The camera's axes in the world: x right, -z up, y backwards; it stands at (0, 1, 0). */
    self->view_from_world[0] = 1.0;
    self->view_from_world[6] = 1.0;
    self->view_from_world[9] = -1.0;
    self->view_from_world[14] = -1.0;
    self->view_from_world[15] = 1.0;
}

enum { SHEET = 40, LAYERS = 3 };

/** A .nkv file image as ./nook bake makes them: a sheet of 40 x 40 voxels of 0.05 m, around the origin of its mesh. */
static void *load_file(size_t *out_size)
{
    nook_volume volume = { .info = { .kind = NOOK_VOLUME_BINARY,
                                     .width = SHEET + 2,
                                     .height = LAYERS,
                                     .depth = SHEET + 2,
                                     .voxel_size = 0.05,
                                     .origin = { -1.05, -0.075, -1.05 },
                                     .occupied = SHEET * SHEET } };
    volume.voxels = calloc((size_t)(SHEET + 2) * LAYERS * (SHEET + 2), 1);
    assert_non_null(volume.voxels);
    for (size_t z = 1; z <= SHEET; z++) {
        for (size_t x = 1; x <= SHEET; x++)
            volume.voxels[(z * LAYERS + 1) * (SHEET + 2) + x] = 255;
    }
    void *bytes;
    assert_int_equal(nook_volume_encode(&volume, &bytes, out_size), NOOK_OK);
    nook_volume_free(&volume);
    return bytes;
}

/* ---- What a host writes to get ambient occlusion ---- */

static nook_result start_ambient_occlusion(host *self)
{
    const char *root = getenv("NOOK_ROOT"); /* where shaders/ and modules/ are */
    nook_gpu_desc device = { .get_proc = self->get_proc, .source_root = root && *root ? root : "." };
    nook_result result = nook_gpu_create(&device, &self->gpu);
    if (result != NOOK_OK)
        return result;
    nook_ao_desc desc = { .version = NOOK_AO_VERSION, .gpu = self->gpu, .width = WIDTH, .height = HEIGHT };
    result = nook_ao_create(&desc, &self->ao);
    if (result == NOOK_OK)
        result = nook_ao_add_technique(self->ao, &nook_ao_volume_technique);
    if (result == NOOK_OK)
        result = nook_ao_add_technique(self->ao, &nook_ao_ssao_technique);
    if (result == NOOK_OK)
        result = nook_ao_set_param(self->ao, "ao.r_max", 10.0);
    if (result == NOOK_OK)
        result = nook_ao_set_param(self->ao, "volume.rays", 64);
    return result;
}

static nook_result draw_ambient_occlusion(host *self, const nook_ao_occluder *occluders, uint32_t count,
                                          nook_ao_texture *out_visibility)
{
    nook_ao_frame frame = { .depth = { self->depth, WIDTH, HEIGHT } }; /* no normals: rebuilt from depth */
    for (int i = 0; i < 16; i++) {
        frame.view_from_world[i] = self->view_from_world[i];
        frame.clip_from_view[i] = self->clip_from_view[i];
    }
    nook_result result = nook_ao_submit_occluders(self->ao, occluders, count);
    if (result == NOOK_OK)
        result = nook_ao_record(self->ao, &frame);
    if (result == NOOK_OK)
        *out_visibility = nook_ao_visibility(self->ao);
    return result;
}

/* ---- The tests ---- */

static int setup(void **state)
{
    host *self = calloc(1, sizeof *self);
    assert_non_null(self);
    open_context(self);
    assert_int_equal(start_ambient_occlusion(self), NOOK_OK);
    draw_floor(self);
    *state = self;
    return 0;
}

static int teardown(void **state)
{
    host *self = *state;
    nook_ao_destroy(self->ao);
    self->gpu->gl->DeleteTextures(1, &self->depth);
    assert_false(nook_gpu_check(self->gpu, "the host"));
    nook_gpu_destroy(self->gpu);
    self->make_current(NULL, NULL, 0, 0, 0);
    self->destroy_context(self->context);
    dlclose(self->library);
    free(self);
    return 0;
}

/** Mean visibility of the four pixels in the middle. */
static double visibility_at_centre(host *self, nook_ao_texture texture)
{
    float visibility[WIDTH * HEIGHT];
    assert_int_equal(texture.width, WIDTH);
    assert_int_equal(texture.height, HEIGHT);
    self->gpu->gl->GetTextureImage(texture.native, 0, GL_RED, GL_FLOAT, sizeof visibility, visibility);
    size_t middle = HEIGHT / 2 * WIDTH + WIDTH / 2;
    return (visibility[middle] + visibility[middle - 1] + visibility[middle - WIDTH] + visibility[middle - WIDTH - 1]) /
           4.0;
}

/** A sheet behind the camera at `height` over the floor, as one occluder. */
static nook_ao_occluder sheet_at(nook_ao_volume volume, double height)
{
    return (nook_ao_occluder){ .volume = volume,
                               .world_from_mesh = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, height, 0, 1 } };
}

static void test_host_gets_the_occlusion_of_a_sheet_that_its_camera_does_not_see(void **state)
{
    host *self = *state;
    size_t size;
    void *bytes = load_file(&size);
    nook_ao_volume volume;
    nook_ao_texture visibility;
    assert_int_equal(nook_ao_add_volume(self->ao, "sheet.nkv", bytes, size, &volume), NOOK_OK);
    free(bytes); /* the volume was copied */
    nook_ao_occluder sheet = sheet_at(volume, 1.5);
    assert_int_equal(nook_ao_set_technique(self->ao, "volume"), NOOK_OK);
    assert_int_equal(draw_ambient_occlusion(self, &sheet, 1, &visibility), NOOK_OK);
    /* Four rectangles of 1 m x 1 m, each with a corner overhead: fixture 15 of docs/techniques.md. */
    double x = 1.0 / 1.5, angle = x / sqrt(1 + x * x) * atan(x / sqrt(1 + x * x)),
           truth = 4 * 2 * angle / (2 * acos(-1.0));
    double got = 1.0 - visibility_at_centre(self, visibility);
    if (fabs(got - truth) > 0.03)
        fail_msg("A = %.4f, truth %.4f", got, truth);

    sheet = sheet_at(volume, 1e6); /* it flies away */
    assert_int_equal(draw_ambient_occlusion(self, &sheet, 1, &visibility), NOOK_OK);
    assert_true(visibility_at_centre(self, visibility) == 1.0);
    nook_ao_remove_volume(self->ao, volume);
    assert_int_equal(draw_ambient_occlusion(self, &sheet, 1, &visibility), NOOK_E_ARG);
}

static void test_host_without_volumes_gets_an_open_floor_from_every_technique(void **state)
{
    host *self = *state;
    static const char *const techniques[] = { "volume", "ssao" };
    for (size_t i = 0; i < NOOK_COUNT(techniques); i++) {
        nook_ao_texture visibility;
        assert_int_equal(nook_ao_set_technique(self->ao, techniques[i]), NOOK_OK);
        assert_int_equal(draw_ambient_occlusion(self, NULL, 0, &visibility), NOOK_OK);
        assert_true(visibility_at_centre(self, visibility) > 0.999);
    }
}

static void test_host_is_told_about_techniques_that_it_did_not_link(void **state)
{
    host *self = *state;
    assert_int_equal(nook_ao_set_technique(self->ao, "reference"), NOOK_E_NOT_FOUND);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_host_gets_the_occlusion_of_a_sheet_that_its_camera_does_not_see),
        cmocka_unit_test(test_host_without_volumes_gets_an_open_floor_from_every_technique),
        cmocka_unit_test(test_host_is_told_about_techniques_that_it_did_not_link),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
