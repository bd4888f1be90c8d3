/* volume.path = raster: boxes that are drawn and blended give what tiles with combine = multiply compute, wherever the camera stands. */
#include "modules/ao_volume/volume.h"
#include "tests/support/ao_view.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* No multiple of a tile, nor of the trace's scales. */
enum { WIDTH = 75, HEIGHT = 50, PIXELS = WIDTH * HEIGHT };

static const char *const kinds[] = { "binary", "density", "surfel", "distance" };

typedef struct scene {
    const char *name;
    void (*fill)(nook_fixture_view *view);
} scene;

static nook_matrix place(double x, double y, double z, double turn, double scale_x, double scale_y, double scale_z)
{
    const double at[3] = { x, y, z },
                 rotation[4] = { 0.6 * sin(0.5 * turn), 0, 0.8 * sin(0.5 * turn), cos(0.5 * turn) };
    return nook_matrix_compose(at, rotation, (double[]){ scale_x, scale_y, scale_z });
}

static void add(nook_fixture_view *view, const nook_fixture_mesh *mesh, const nook_matrix *world_from_mesh)
{
    assert_int_equal(nook_fixture_view_add(view, mesh, 24, world_from_mesh, NULL), NOOK_OK);
}

static nook_fixture_mesh make_floor(void)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_quad(&mesh, (double[]){ -2, -2, 0 }, (double[]){ 4, 0, 0 }, (double[]){ 0, 4, 0 });
    return mesh;
}

static void draw_floor(nook_fixture_view *view)
{
    nook_fixture_mesh mesh = make_floor();
    ao_view_draw(view, &mesh);
    nook_fixture_mesh_free(&mesh);
}

static void add_floor(nook_fixture_view *view)
{
    nook_fixture_mesh mesh = make_floor();
    draw_floor(view);
    add(view, &mesh, NULL);
    nook_fixture_mesh_free(&mesh);
}

/** Nothing is drawn yet then. */
static void look(nook_fixture_view *view, const double eye[3], const double target[3], double angle)
{
    const nook_fixture_projection projection = { .fov_y_radians = angle, .aspect = 1.5, .z_near = 0.01 };
    view->view_from_world = nook_matrix_look_at(eye, target, (double[]){ 0, 0, 1 });
    view->clip_from_view = nook_fixture_projection_matrix(&projection);
    nook_fixture_view_clear(view);
}

static void look_down(nook_fixture_view *view)
{
    look(view, (double[]){ -1.5, -2, 1.5 }, (double[]){ 0.1, 0, 0.2 }, 1.0);
}

/** Turned, stretched and mirrored boxes that float over a floor, in reach of it and of each other; sky beside. */
static void fill_boxes(nook_fixture_view *view)
{
    nook_fixture_mesh box = { 0 };
    nook_fixture_add_box(&box, (double[]){ -0.3, -0.2, -0.1 }, (double[]){ 0.3, 0.2, 0.1 }, 63);
    const nook_matrix places[] = { place(-0.4, -0.3, 0.3, 0.7, 1, 1, 1), place(0.3, 0.1, 0.4, 2.0, 1, 2, 0.7),
                                   place(0.5, -0.6, 0.2, 1.1, -1, 1, 1), place(-0.1, 0.6, 0.3, -0.4, 1, 1, -2) };
    look_down(view);
    add_floor(view);
    for (size_t i = 0; i < NOOK_COUNT(places); i++)
        add(view, &box, &places[i]);
    nook_fixture_mesh_free(&box);
}

/** A room all around the camera, and a box whose reach the camera stands in: no front faces are in front of it. */
static void fill_inside(nook_fixture_view *view)
{
    nook_fixture_mesh room = { 0 }, box = { 0 };
    look(view, (double[]){ 0.2, -0.6, 0.4 }, (double[]){ 0, 1, 0.3 }, 1.2);
    nook_fixture_add_box(&room, (double[]){ -1, -1, 0 }, (double[]){ 1, 1, 1 }, 63);
    nook_fixture_add_box(&box, (double[]){ -0.2, -0.4, 0 }, (double[]){ 0.1, -0.1, 0.3 }, 63);
    ao_view_draw(view, &room);
    ao_view_draw(view, &box);
    add(view, &room, NULL);
    add(view, &box, NULL);
    nook_fixture_mesh_free(&room);
    nook_fixture_mesh_free(&box);
}

/** Many in one place: factors of one pixel in a row. */
static void fill_pile(nook_fixture_view *view)
{
    nook_fixture_mesh box = { 0 };
    nook_fixture_add_box(&box, (double[]){ -0.2, -0.2, 0.1 }, (double[]){ 0.2, 0.2, 0.3 }, 63);
    look_down(view);
    add_floor(view);
    add(view, &box, NULL);
    for (int i = 1; i < 20; i++) {
        const nook_matrix at = place(0.01 * i, 0, 0, 0, 1, 1, 1);
        assert_int_equal(nook_fixture_view_add_instance(view, 1, &at), NOOK_OK);
    }
    nook_fixture_mesh_free(&box);
}

static const scene scenes[] = { { "boxes", fill_boxes }, { "inside", fill_inside }, { "pile", fill_pile } };

static nook_fixture_view *prepare(void **state, const scene *of)
{
    static const char *const values[][2] = {
        { "volume.rays", "6" },     { "volume.kind", "binary" }, { "volume.combine", "multiply" },
        { "ao.falloff", "linear" }, { "ao.r_max", "0.4" },       { "volume.sampling", "filter" },
        { "ao.scale", "full" },     { "ao.filter", "none" },     { "ao.count", "0" },
    };
    nook_fixture_view *view = *state;
    nook_fixture_view_drop_occluders(view);
    view->part = (nook_rectangle){ 0 };
    for (size_t i = 0; i < NOOK_COUNT(values); i++)
        ao_view_param(view, values[i][0], values[i][1]);
    of->fill(view);
    return view;
}

static void record(nook_fixture_view *view, const char *path, float out[PIXELS])
{
    ao_view_param(view, "volume.path", path);
    ao_view_record(view, "volume");
    memcpy(out, view->visibility, PIXELS * sizeof *out);
}

/** Blending rounds as multiplying in a register does, but for the order of factors: steps of 2^-24, by two dozens of volumes. */
static void assert_alike(nook_fixture_view *view, const char *what)
{
    float computed[PIXELS], drawn[PIXELS];
    double darkest = 1.0;
    record(view, "compute", computed);
    record(view, "raster", drawn);
    for (int i = 0; i < PIXELS; i++) {
        darkest = fmin(darkest, computed[i]);
        if (!(fabs((double)computed[i] - (double)drawn[i]) <= 24.0 / 16777216.0))
            fail_msg("%s: pixel %d, %d: computed %.8f, drawn %.8f", what, i % WIDTH, i / WIDTH, computed[i], drawn[i]);
    }
    assert_true(darkest < 0.8); /* there is something to be alike */
}

static void test_drawn_boxes_are_what_tiles_multiply_for_every_kind_and_scale(void **state)
{
    for (size_t s = 0; s < NOOK_COUNT(scenes); s++) {
        for (size_t kind = 0; kind < NOOK_COUNT(kinds); kind++) {
            for (size_t scale = 0; scale < NOOK_FIXTURE_SCALES; scale++) {
                nook_fixture_view *view = prepare(state, &scenes[s]);
                char what[64];
                snprintf(what, sizeof what, "%s, %s, %s", scenes[s].name, kinds[kind], nook_fixture_scales[scale]);
                ao_view_param(view, "volume.kind", kinds[kind]);
                ao_view_param(view, "ao.scale", nook_fixture_scales[scale]);
                assert_alike(view, what);
            }
        }
    }
}

static void test_filters_and_corners_take_what_was_drawn(void **state)
{
    nook_fixture_view *view = prepare(state, &scenes[0]);
    ao_view_param(view, "volume.sampling", "corners");
    for (size_t filter = 0; filter < NOOK_FIXTURE_FILTERS; filter++) {
        ao_view_param(view, "ao.filter", nook_fixture_filters[filter]);
        assert_alike(view, nook_fixture_filters[filter]);
    }
}

/** All around, so that boxes are cut off by the plane of the eye at many angles, and close enough for faces to be seen edge-on. */
static void test_the_camera_may_stand_anywhere(void **state)
{
    for (int turn = 0; turn < 24; turn++) {
        nook_fixture_view *view = prepare(state, &scenes[0]);
        const double angle = turn * 0.2618, eye[3] = { 0.4 * cos(3 * angle), 0.5 * sin(2 * angle), 0.05 + 0.02 * turn };
        const double at[3] = { eye[0] + cos(angle), eye[1] + sin(angle), eye[2] - 0.4 };
        look(view, eye, at, 1.4);
        draw_floor(view);
        assert_alike(view, "turned");
    }
}

/** From outside of all boxes, and from within the floor's, of which only back faces are before the camera. */
static void test_projections_that_are_flipped_or_off_centre_draw_the_same(void **state)
{
    for (int turn = 0; turn < 6; turn++) {
        const int way = turn / 2;
        nook_fixture_view *view = prepare(state, &scenes[0]);
        if (turn % 2)
            look(view, (double[]){ 0.2, -0.9, 0.3 }, (double[]){ 0, 1, 0.1 }, 0.9);
        const nook_fixture_projection projection = { .fov_y_radians = 0.9,
                                                     .aspect = 1.5,
                                                     .z_near = 0.1,
                                                     .z_far = way == 2 ? 2.6 : 0.0,
                                                     .normal_z = way == 2,
                                                     .skew = { 0.3, -0.2 } };
        view->clip_from_view = nook_fixture_projection_matrix(&projection);
        if (way == 1)
            view->clip_from_view.m[5] = -view->clip_from_view.m[5];
        nook_fixture_view_clear(view);
        draw_floor(view);
        assert_alike(view, "projection");
    }
}

/** 4096 rays are more loop turns than a software driver lets an invocation take: their sum waits in an image from draw to draw. */
static void test_rays_too_many_for_one_draw_are_cut_and_none_is_lost(void **state)
{
    for (size_t kind = 0; kind < NOOK_COUNT(kinds); kind++) {
        nook_fixture_view *view = prepare(state, &scenes[0]);
        ao_view_param(view, "volume.kind", kinds[kind]);
        ao_view_param(view, "volume.rays", "2048");
        ao_view_param(view, "ao.scale", "quarter");
        assert_alike(view, kinds[kind]);
    }
}

static void test_a_part_is_the_whole_pictures_and_what_is_outside_stays(void **state)
{
    nook_fixture_view *view = prepare(state, &scenes[0]);
    float whole[PIXELS], part[PIXELS], drawn[PIXELS];
    record(view, "raster", whole);
    view->index++;
    record(view, "raster", part);
    view->index--;
    view->part = (nook_rectangle){ 21, 5, 30, 23 };
    record(view, "raster", drawn);
    for (int i = 0; i < PIXELS; i++) {
        int x = i % WIDTH - 21, y = i / WIDTH - 5;
        assert_true(drawn[i] == (x >= 0 && x < 30 && y >= 0 && y < 23 ? whole[i] : part[i]));
    }
}

static void test_union_cannot_be_blended_and_is_drawn_as_the_product(void **state)
{
    nook_fixture_view *view = prepare(state, &scenes[2]);
    float product[PIXELS], asked[PIXELS];
    record(view, "raster", product);
    ao_view_param(view, "volume.combine", "union");
    record(view, "raster", asked);
    assert_memory_equal(product, asked, sizeof product);
}

static void test_the_same_frame_is_drawn_with_the_same_bits(void **state)
{
    for (size_t kind = 0; kind < NOOK_COUNT(kinds); kind++) {
        nook_fixture_view *view = prepare(state, &scenes[2]);
        float first[PIXELS], again[PIXELS];
        ao_view_param(view, "volume.kind", kinds[kind]);
        record(view, "raster", first);
        for (int i = 0; i < 3; i++) {
            record(view, "raster", again);
            assert_memory_equal(first, again, sizeof first);
        }
    }
}

static void test_without_volumes_everything_is_open(void **state)
{
    nook_fixture_view *view = prepare(state, &scenes[0]);
    float drawn[PIXELS];
    nook_fixture_view_drop_occluders(view);
    record(view, "raster", drawn);
    for (int i = 0; i < PIXELS; i++)
        assert_true(drawn[i] == 1.0f);
}

/** @param fetches  of each pixel, in sixteenths @return of a pixel on average, as reports tell it */
static double count_fetches(nook_fixture_view *view, const char *path, uint32_t fetches[PIXELS])
{
    nook_texture image;
    nook_ao_statistics statistics;
    float drawn[PIXELS];
    memset(fetches, 0, PIXELS * sizeof *fetches);
    assert_int_equal(nook_texture_create_2d(view->gpu, GL_R32UI, WIDTH, HEIGHT, GL_NEAREST, &image), NOOK_OK);
    nook_texture_write(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, fetches, PIXELS * sizeof *fetches);
    view->fetches = (nook_ao_texture){ image.id, WIDTH, HEIGHT };
    ao_view_param(view, "ao.count", "1");
    record(view, path, drawn);
    view->fetches = (nook_ao_texture){ 0 };
    nook_ao_get_statistics(view->ao, &statistics);
    nook_texture_read(view->gpu, image, GL_RED_INTEGER, GL_UNSIGNED_INT, fetches, PIXELS * sizeof *fetches);
    nook_texture_destroy(view->gpu, &image);
    return statistics.fetches_per_pixel;
}

/** The same rays meet the same texels. Depth and normal are read once in each of the 21 boxes over a pixel and not once in all. */
static void test_fetches_are_counted_by_pixel_in_all_boxes_over_it(void **state)
{
    enum { UNIT = 16, RECEIVER = 2 * UNIT, BOXES = 21 };
    static uint32_t computed[PIXELS], drawn[PIXELS];
    nook_fixture_view *view = prepare(state, &scenes[2]);
    uint64_t sum = 0, seen = 0;
    count_fetches(view, "compute", computed);
    double mean = count_fetches(view, "raster", drawn);
    for (int i = 0; i < PIXELS; i++) {
        assert_true(drawn[i] + RECEIVER >= computed[i]);
        assert_true(drawn[i] <= computed[i] + (BOXES - 1) * RECEIVER);
        sum += drawn[i];
        seen += view->device_depth[i] > 0.0f;
    }
    assert_true(fabs((double)sum / UNIT / (double)seen - mean) < 1e-6 * mean);
}

/** What a host has set for its own draws is there after a record, whatever it is, and does not change what is drawn. */
static void test_the_hosts_state_neither_matters_nor_changes(void **state)
{
    static const GLenum switches[] = {
        GL_DEPTH_TEST,   GL_CULL_FACE,      GL_SCISSOR_TEST,      GL_BLEND,
        GL_STENCIL_TEST, GL_COLOR_LOGIC_OP, GL_PRIMITIVE_RESTART, GL_RASTERIZER_DISCARD
    };
    static const GLenum names[] = { GL_BLEND_SRC_RGB,           GL_BLEND_DST_ALPHA,
                                    GL_BLEND_EQUATION_RGB,      GL_FRONT_FACE,
                                    GL_CULL_FACE_MODE,          GL_CLIP_ORIGIN,
                                    GL_CLIP_DEPTH_MODE,         GL_LOGIC_OP_MODE,
                                    GL_VERTEX_ARRAY_BINDING,    GL_DRAW_FRAMEBUFFER_BINDING,
                                    GL_READ_FRAMEBUFFER_BINDING };
    nook_fixture_view *view = prepare(state, &scenes[0]);
    const nook_gl *gl = view->gpu->gl;
    float plain[PIXELS], drawn[PIXELS];
    GLint before[NOOK_COUNT(names)], after, box[4];
    GLboolean mask[4];
    GLuint framebuffer, vertex_array;
    record(view, "raster", plain);
    gl->CreateFramebuffers(1, &framebuffer);
    gl->CreateVertexArrays(1, &vertex_array);
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->BindVertexArray(vertex_array);
    for (size_t i = 0; i < NOOK_COUNT(switches); i++)
        gl->Enable(switches[i]);
    gl->BlendFuncSeparate(GL_DST_ALPHA, GL_ONE, GL_ONE, GL_SRC_ALPHA);
    gl->BlendEquationSeparate(GL_MAX, GL_MIN);
    gl->FrontFace(GL_CW);
    gl->CullFace(GL_FRONT_AND_BACK);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl->ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl->LogicOp(GL_CLEAR);
    gl->ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    gl->Viewport(1, 2, 3, 4);
    gl->Scissor(5, 6, 7, 8);
    for (size_t i = 0; i < NOOK_COUNT(names); i++)
        gl->GetIntegerv(names[i], &before[i]);
    record(view, "raster", drawn);
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        gl->GetIntegerv(names[i], &after);
        assert_int_equal(after, before[i]);
    }
    for (size_t i = 0; i < NOOK_COUNT(switches); i++) {
        assert_true(gl->IsEnabled(switches[i]));
        gl->Disable(switches[i]);
    }
    gl->GetIntegerv(GL_VIEWPORT, box);
    assert_memory_equal(box, ((GLint[]){ 1, 2, 3, 4 }), sizeof box);
    gl->GetIntegerv(GL_SCISSOR_BOX, box);
    assert_memory_equal(box, ((GLint[]){ 5, 6, 7, 8 }), sizeof box);
    gl->GetBooleanv(GL_COLOR_WRITEMASK, mask);
    assert_memory_equal(mask, ((GLboolean[]){ GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE }), sizeof mask);
    gl->GetIntegerv(GL_POLYGON_MODE, box);
    assert_int_equal(box[0], GL_LINE);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl->BlendFunc(GL_ONE, GL_ZERO);
    gl->BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    gl->FrontFace(GL_CCW);
    gl->CullFace(GL_BACK);
    gl->LogicOp(GL_COPY);
    gl->BindVertexArray(0);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl->DeleteVertexArrays(1, &vertex_array);
    gl->DeleteFramebuffers(1, &framebuffer);
    assert_memory_equal(plain, drawn, sizeof plain);
}

static int setup(void **state)
{
    *state = ao_view_create(WIDTH, HEIGHT);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drawn_boxes_are_what_tiles_multiply_for_every_kind_and_scale),
        cmocka_unit_test(test_filters_and_corners_take_what_was_drawn),
        cmocka_unit_test(test_the_camera_may_stand_anywhere),
        cmocka_unit_test(test_projections_that_are_flipped_or_off_centre_draw_the_same),
        cmocka_unit_test(test_rays_too_many_for_one_draw_are_cut_and_none_is_lost),
        cmocka_unit_test(test_a_part_is_the_whole_pictures_and_what_is_outside_stays),
        cmocka_unit_test(test_union_cannot_be_blended_and_is_drawn_as_the_product),
        cmocka_unit_test(test_the_same_frame_is_drawn_with_the_same_bits),
        cmocka_unit_test(test_without_volumes_everything_is_open),
        cmocka_unit_test(test_fetches_are_counted_by_pixel_in_all_boxes_over_it),
        cmocka_unit_test(test_the_hosts_state_neither_matters_nor_changes),
    };
    return cmocka_run_group_tests(tests, setup, ao_view_teardown);
}
