/* What a technique is given: the host's depth and normals in view space, whatever the projection. */
#include "tests/support/ao_view.h"
#include <math.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 37, HEIGHT = 23 };

static const double z_near = 0.2, z_far = 80.0;

typedef struct projection {
    const char *name;
    bool normal_z;
    double z_far;
    double skew[2]; /* an off-centre image */
} projection;

static size_t list_projections(projection out[8])
{
    const projection kinds[4] = { { "reversed, infinite", false, 0.0, { 0.0 } },
                                  { "reversed, finite", false, z_far, { 0.0 } },
                                  { "normal, infinite", true, 0.0, { 0.0 } },
                                  { "normal, finite", true, z_far, { 0.0 } } };
    for (size_t i = 0; i < 8; i++) {
        out[i] = kinds[i / 2];
        if (i % 2)
            out[i].skew[0] = 0.7, out[i].skew[1] = -0.4;
    }
    return 8;
}

static void use(nook_fixture_view *view, const projection *p)
{
    const nook_fixture_projection desc = { .fov_y_radians = 1.0,
                                           .aspect = (double)WIDTH / HEIGHT,
                                           .z_near = z_near,
                                           .z_far = p->z_far,
                                           .normal_z = p->normal_z,
                                           .skew = { p->skew[0], p->skew[1] } };
    view->clip_from_view = nook_fixture_projection_matrix(&desc);
    nook_fixture_view_clear(view);
}

static int setup(void **state)
{
    *state = ao_view_create(WIDTH, HEIGHT);
    return 0;
}

/** Distances that cover the range; every seventh pixel sees nothing. */
static double distance_of(uint32_t x, uint32_t y)
{
    uint32_t i = y * WIDTH + x;
    return i % 7 == 3 ? 0.0 : z_near * pow(z_far / z_near, 0.01 + 0.98 * i / (WIDTH * HEIGHT));
}

static void draw_distances(nook_fixture_view *view)
{
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        double distance = distance_of(i % WIDTH, i / WIDTH);
        if (distance > 0.0)
            nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, distance, (double[]){ 0, 0, 1 });
    }
}

static void expect_distance(const projection *p, double got, double truth)
{
    /* The rounding of a depth to float, half of 2^-24 near 1, is distance^2 / z_near of it; arithmetic adds nothing of that kind. */
    double tolerance = truth * (1e-6 + (p->normal_z ? truth / z_near * 0x1.1p-25 : 0.0));
    if (fabs(got - truth) > tolerance)
        fail_msg("%s%s: distance %.9g, truth %.9g", p->name, p->skew[0] != 0.0 ? ", off-centre" : "", got, truth);
}

static void test_prepare_gives_true_distances_under_every_projection(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    size_t count = list_projections(projections);
    for (size_t k = 0; k < count; k++) {
        use(view, &projections[k]);
        draw_distances(view);
        ao_view_record(view, "probe");
        assert_int_equal(ao_view_probe(view)->width, WIDTH);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            expect_distance(&projections[k], ao_view_probe(view)->depth[i], distance_of(i % WIDTH, i / WIDTH));
    }
}

static void test_prepare_picks_one_true_pixel_of_each_block_at_lower_scales(void **state)
{
    static const char *const names[] = { "half", "quarter" };
    nook_fixture_view *view = *state;
    projection projections[8];
    list_projections(projections);
    use(view, &projections[0]);
    draw_distances(view);
    for (uint32_t k = 0; k < 2; k++) {
        uint32_t scale = 2u << k;
        ao_view_param(view, "ao.scale", names[k]);
        ao_view_record(view, "probe");
        assert_int_equal(ao_view_probe(view)->width, (WIDTH + scale - 1) / scale);
        assert_int_equal(ao_view_probe(view)->height, (HEIGHT + scale - 1) / scale);
        const ao_probe *probe = ao_view_probe(view);
        for (uint32_t i = 0; i < probe->width * probe->height; i++) {
            uint32_t x = i % probe->width * scale + scale / 2, y = i / probe->width * scale + scale / 2;
            x = x < WIDTH ? x : WIDTH - 1, y = y < HEIGHT ? y : HEIGHT - 1;
            expect_distance(&projections[0], probe->depth[i], distance_of(x, y));
        }
    }
    ao_view_param(view, "ao.scale", "full");
}

static void normalize(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    v[0] /= length, v[1] /= length, v[2] /= length;
}

/** Distance along -Z to the plane through (0, 0, -depth) with normal n. */
static double plane_distance(const nook_fixture_view *view, uint32_t x, uint32_t y, const double n[3], double depth)
{
    double ray[3];
    nook_fixture_view_position(view, x, y, 1.0, ray);
    return -depth * n[2] / (n[0] * ray[0] + n[1] * ray[1] + n[2] * ray[2]);
}

static void expect_normal(const nook_fixture_view *view, uint32_t x, uint32_t y, const double truth[3],
                          double tolerance)
{
    double got[3];
    nook_fixture_decode_normal(ao_view_probe(view)->normals[y * WIDTH + x], got);
    double apart = sqrt((got[0] - truth[0]) * (got[0] - truth[0]) + (got[1] - truth[1]) * (got[1] - truth[1]) +
                        (got[2] - truth[2]) * (got[2] - truth[2]));
    if (!(apart <= tolerance))
        fail_msg("pixel (%u, %u): normal %.5f %.5f %.5f, truth %.5f %.5f %.5f", x, y, got[0], got[1], got[2], truth[0],
                 truth[1], truth[2]);
}

static void test_prepare_rebuilds_normals_of_a_tilted_plane_to_the_border(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    size_t count = list_projections(projections);
    view->without_normals = 1;
    for (size_t k = 0; k < count; k++) {
        double n[3] = { 0.3, 0.5, 1.0 };
        normalize(n);
        use(view, &projections[k]);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, plane_distance(view, i % WIDTH, i / WIDTH, n, 2.0),
                                        n);
        ao_view_record(view, "probe");
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            expect_normal(view, i % WIDTH, i / WIDTH, n, 1e-3);
    }
    view->without_normals = 0;
}

static void test_prepare_rebuilds_normals_in_worlds_of_any_size(void **state)
{
    nook_fixture_view *view = *state;
    double n[3] = { -0.4, 0.2, 1.0 };
    normalize(n);
    view->without_normals = 1;
    for (double size = 1e-9; size < 1e13; size *= 1e3) {
        view->clip_from_view = nook_matrix_perspective_reversed(1.0, (double)WIDTH / HEIGHT, 0.1 * size);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, plane_distance(view, i % WIDTH, i / WIDTH, n, size),
                                        n);
        ao_view_record(view, "probe");
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
            expect_normal(view, i % WIDTH, i / WIDTH, n, 1e-3);
    }
    view->without_normals = 0;
}

static void test_prepare_rebuilds_normals_from_the_right_side_of_a_silhouette(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    list_projections(projections);
    use(view, &projections[0]);
    double left[3] = { 0.5, 0.1, 1.0 }, right[3] = { -0.6, -0.2, 1.0 };
    normalize(left), normalize(right);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        uint32_t x = i % WIDTH, y = i / WIDTH, at_left = x < 18;
        const double *n = at_left ? left : right;
        nook_fixture_view_set_pixel(view, x, y, plane_distance(view, x, y, n, at_left ? 2.0 : 8.0), n);
    }
    view->without_normals = 1;
    ao_view_record(view, "probe");
    view->without_normals = 0;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++)
        expect_normal(view, i % WIDTH, i / WIDTH, i % WIDTH < 18 ? left : right, 1e-3);
}

static void test_prepare_turns_a_lone_pixel_to_the_camera(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    list_projections(projections);
    use(view, &projections[0]);
    nook_fixture_view_set_pixel(view, 18, 11, 3.0, (double[]){ 1, 0, 0 });
    view->without_normals = 1;
    ao_view_record(view, "probe");
    view->without_normals = 0;
    expect_normal(view, 18, 11, (double[]){ 0, 0, 1 }, 1e-3);
}

static void test_prepare_rotates_world_normals_into_view_space(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    list_projections(projections);
    const double eye[3] = { 1e6, 3, -2e5 }, target[3] = { 1e6 + 2, 4.5, -2e5 - 1 }, up[3] = { 0, 1, 0 };
    view->view_from_world = nook_matrix_look_at(eye, target, up);
    use(view, &projections[0]);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        double n[3] = { sin(0.7 * i), cos(1.3 * i), sin(2.1 * i + 1.0) };
        normalize(n);
        nook_fixture_view_set_pixel(view, i % WIDTH, i / WIDTH, 3.0, n);
    }
    ao_view_record(view, "probe");
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        double n[3] = { sin(0.7 * i), cos(1.3 * i), sin(2.1 * i + 1.0) };
        normalize(n);
        nook_matrix_apply_vector(&view->view_from_world, n, n);
        expect_normal(view, i % WIDTH, i / WIDTH, n, 1e-4);
    }
    view->view_from_world = nook_matrix_identity();
}

static void test_prepare_keeps_axis_normals_exact(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    list_projections(projections);
    use(view, &projections[0]);
    for (uint32_t i = 0; i < 6; i++) {
        double n[3] = { 0, 0, 0 };
        n[i / 2] = i % 2 ? 1.0 : -1.0;
        nook_fixture_view_set_pixel(view, i, 0, 3.0, n);
    }
    ao_view_record(view, "probe");
    for (uint32_t i = 0; i < 6; i++) {
        double n[3] = { 0, 0, 0 };
        n[i / 2] = i % 2 ? 1.0 : -1.0;
        expect_normal(view, i, 0, n, 0.0);
    }
}

static float paint_pattern(const ao_probe *probe, uint32_t x, uint32_t y)
{
    (void)probe;
    return (float)((x * 7 + y * 13) % 11) / 10.0f;
}

/** A host's way of looking at its own textures, as unlike ours as can be: filtered, and by sampler objects that it has left bound. */
static GLuint leave_samplers_bound(nook_fixture_view *view)
{
    const nook_gl *gl = view->gpu->gl;
    GLuint sampler;
    const nook_texture own[2] = { view->depth, view->normal };
    for (int i = 0; i < 2; i++) {
        gl->TextureParameteri(own[i].id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        gl->TextureParameteri(own[i].id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl->TextureParameteri(own[i].id, GL_TEXTURE_WRAP_S, GL_MIRRORED_REPEAT);
    }
    gl->CreateSamplers(1, &sampler);
    gl->SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    for (GLuint unit = 0; unit < 7; unit++)
        gl->BindSampler(unit, sampler);
    return sampler;
}

static void test_prepare_and_upscaling_do_not_care_how_the_host_samples_its_textures(void **state)
{
    nook_fixture_view *view = *state;
    projection projections[8];
    float depth[WIDTH * HEIGHT], visibility[WIDTH * HEIGHT];
    list_projections(projections);
    use(view, &projections[0]);
    draw_distances(view);
    ao_view_param(view, "ao.scale", "half");
    ao_view_param(view, "ao.upscale", "stepped");
    ao_view_probe(view)->paint = paint_pattern;
    ao_view_record(view, "probe");
    const size_t count = (size_t)ao_view_probe(view)->width * ao_view_probe(view)->height;
    memcpy(depth, ao_view_probe(view)->depth, count * sizeof *depth);
    memcpy(visibility, view->visibility, sizeof visibility);

    GLuint sampler = leave_samplers_bound(view);
    ao_view_record(view, "probe");
    assert_memory_equal(ao_view_probe(view)->depth, depth, count * sizeof *depth);
    assert_memory_equal(view->visibility, visibility, sizeof visibility);
    for (GLuint unit = 0; unit < 7; unit++)
        view->gpu->gl->BindSampler(unit, 0);
    view->gpu->gl->DeleteSamplers(1, &sampler);
    ao_view_probe(view)->paint = NULL;
    ao_view_param(view, "ao.upscale", "direct");
    ao_view_param(view, "ao.scale", "full");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_prepare_gives_true_distances_under_every_projection),
        cmocka_unit_test(test_prepare_picks_one_true_pixel_of_each_block_at_lower_scales),
        cmocka_unit_test(test_prepare_rebuilds_normals_of_a_tilted_plane_to_the_border),
        cmocka_unit_test(test_prepare_rebuilds_normals_in_worlds_of_any_size),
        cmocka_unit_test(test_prepare_rebuilds_normals_from_the_right_side_of_a_silhouette),
        cmocka_unit_test(test_prepare_turns_a_lone_pixel_to_the_camera),
        cmocka_unit_test(test_prepare_rotates_world_normals_into_view_space),
        cmocka_unit_test(test_prepare_keeps_axis_normals_exact),
        cmocka_unit_test(test_prepare_and_upscaling_do_not_care_how_the_host_samples_its_textures),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
