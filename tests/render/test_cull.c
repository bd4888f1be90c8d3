/* Quick frames leave out triangles that show nothing: what is left must be the same picture, bit for bit, whatever moves, and little. */
#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include "tests/support/test_gpu.h"
#include "tests/support/test_render.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 96, WIDTH = 320, HEIGHT = 180, TARGETS = 6 };

/** Two renderers: one that leaves out what it can, one that draws all. */
typedef struct both {
    nook_gpu *gpu;
    nook_renderer *culled, *whole;
    uint8_t *pixels[2];
} both;

static void both_create(both *b, nook_gpu *gpu, uint32_t width, uint32_t height)
{
    b->gpu = gpu;
    assert_int_equal(nook_renderer_create(gpu, width, height, &b->culled), NOOK_OK);
    assert_int_equal(nook_renderer_create(gpu, width, height, &b->whole), NOOK_OK);
    b->whole->draws_hidden = true;
    for (int i = 0; i < 2; i++)
        assert_non_null(b->pixels[i] = malloc((size_t)width * height * 4));
}

static void both_destroy(both *b)
{
    nook_renderer_destroy(b->culled);
    nook_renderer_destroy(b->whole);
    free(b->pixels[0]);
    free(b->pixels[1]);
}

static void read_target(both *b, const nook_renderer *renderer, int target, uint8_t *out)
{
    static const struct {
        uint32_t format, type;
    } kinds[TARGETS] = { { GL_DEPTH_COMPONENT, GL_FLOAT }, { GL_RG, GL_UNSIGNED_SHORT },
                         { GL_RG, GL_UNSIGNED_SHORT },     { GL_RGBA, GL_UNSIGNED_BYTE },
                         { GL_RGBA, GL_UNSIGNED_BYTE },    { GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV } };
    nook_gbuffer g = nook_renderer_gbuffer(renderer);
    const nook_texture textures[TARGETS] = { g.depth,       g.normal,   g.geometric_normal,
                                             g.base_colour, g.material, g.emissive };
    nook_texture_read(b->gpu, textures[target], kinds[target].format, kinds[target].type, out,
                      (size_t)renderer->width * renderer->height * 4);
}

/** Draws a frame with both. @return pixels of the G-buffer that differ in something */
static uint32_t count_different(both *b, nook_frame *frame)
{
    size_t size = (size_t)b->whole->width * b->whole->height * 4;
    uint32_t different = 0;
    frame->quick = true;
    assert_int_equal(nook_frame_begin(b->whole, frame), NOOK_OK);
    assert_int_equal(nook_frame_begin(b->culled, frame), NOOK_OK);
    assert_false(b->whole->cull.on);
    assert_true(b->culled->cull.on == b->gpu->software);
    for (int target = 0; target < TARGETS; target++) {
        read_target(b, b->whole, target, b->pixels[0]);
        read_target(b, b->culled, target, b->pixels[1]);
        for (size_t i = 0; i < size; i += 4)
            different += memcmp(b->pixels[0] + i, b->pixels[1] + i, 4) != 0;
    }
    assert_false(nook_gpu_check(b->gpu, "culling"));
    return different;
}

/** The next number in [0, 1) of a fixed sequence. */
static double next_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static nook_matrix random_place(uint64_t *seed)
{
    double place[3], turn[4], scale[3];
    for (int k = 0; k < 3; k++) {
        place[k] = 6.0 * next_random(seed) - 3.0;
        turn[k] = next_random(seed) - 0.5;
        scale[k] = (0.2 + 2.0 * next_random(seed)) * (next_random(seed) < 0.3 ? -1.0 : 1.0);
    }
    turn[3] = next_random(seed) + 0.1;
    double length = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
    for (int k = 0; k < 4; k++)
        turn[k] /= length;
    return nook_matrix_compose(place, turn, scale);
}

static nook_camera random_camera(uint64_t *seed)
{
    const double up[3] = { 0.0, 1.0, 0.0 };
    double eye[3], target[3];
    for (int k = 0; k < 3; k++) {
        eye[k] = 8.0 * next_random(seed) - 4.0;
        target[k] = 2.0 * next_random(seed) - 1.0;
    }
    return (nook_camera){ nook_matrix_look_at(eye, target, up), 0.5 + next_random(seed), 0.1 };
}

static void test_what_is_left_out_shows_nothing_whatever_moves(void **state)
{
    enum { FRAMES = 150 };
    test_scene scene;
    test_picture picture;
    both b;
    uint64_t seed = 7;
    test_scene_init(&scene);
    for (int i = 0; i < TEST_SCENE_MESHES; i++)
        test_scene_add_facing(&scene, 1.0f, 0.0f);
    scene.materials[1].double_sided = true;
    scene.materials[2].emissive[0] = 2.0f;
    scene.materials[3].alpha_mode = NOOK_ALPHA_MASK;
    scene.materials[4].alpha_mode = NOOK_ALPHA_BLEND;
    test_picture_create(&picture, test_gpu_of(state), &scene, SIZE, SIZE);
    both_create(&b, test_gpu_of(state), SIZE, SIZE);
    for (int i = 0; i < FRAMES; i++) {
        if (i % 3 == 0) { /* in between all stands still, or one moves */
            picture.frame.camera = random_camera(&seed);
            picture.frame.draw_count = 1 + (size_t)(next_random(&seed) * TEST_SCENE_MESHES);
        }
        for (uint32_t k = 0; k < TEST_SCENE_MESHES; k++) {
            if (i % 3 == 0 || (i % 3 == 1 && k == 0))
                picture.draws[k].world_from_local = random_place(&seed);
            if (i % 5 == 0)
                picture.draws[k].mesh = (uint32_t)(next_random(&seed) * TEST_SCENE_MESHES);
        }
        picture.frame.cull_back_faces = i % 2 == 0;
        assert_int_equal(count_different(&b, &picture.frame), 0);
    }
    both_destroy(&b);
    test_picture_destroy(&picture);
}

/** A rotation about the origin. */
static nook_matrix random_turn(uint64_t *seed)
{
    nook_matrix place = random_place(seed);
    for (int k = 0; k < 3; k++) {
        double *column = place.m + 4 * k;
        double length = nook_vector_length(column);
        for (int i = 0; i < 3; i++)
            column[i] /= length;
        place.m[12 + k] = 0.0;
    }
    return place;
}

/** Sheets of a pixel or two, a hair before a wall. Their vertices are kilometres from the origin of their mesh and are seen from half a
    metre: what the driver rounds in adding up is millimetres. */
static void test_meshes_far_from_their_own_origin_lose_nothing(void **state)
{
    enum { FRAMES = 150 };
    static const float away[3] = { 20000.0f, -12000.0f, 15000.0f }, side = 0x1p-6f;
    test_scene scene;
    test_picture picture;
    both b;
    uint64_t seed = 11;
    uint32_t different = 0;
    test_scene_init(&scene);
    test_scene_add_quad(&scene, away, (float[]){ 0.5f, 0, 0 }, (float[]){ 0, 0.5f, 0 });
    for (int i = 1; i < TEST_SCENE_MESHES; i++) {
        const float corner[3] = { away[0] + 0x1p-4f * (float)i, away[1] + 0x1p-3f * (float)(i % 3), away[2] + 0x1p-7f };
        test_scene_add_quad(&scene, corner, (float[]){ side, 0, 0 }, (float[]){ 0, side, 0 });
    }
    test_picture_create(&picture, test_gpu_of(state), &scene, SIZE, SIZE);
    both_create(&b, test_gpu_of(state), SIZE, SIZE);
    picture.frame.camera.fov_y_radians = 1.1; /* x and y are multiplied by what is no power of 2 */
    nook_matrix back = nook_matrix_translation(-(double)away[0] - 0.25, -(double)away[1] - 0.25, -(double)away[2]);
    for (int i = 0; i < FRAMES; i++) {
        nook_matrix turn = random_turn(&seed), there = nook_matrix_translation(0.0, 0.0, -0.3 - next_random(&seed));
        nook_matrix place = nook_matrix_multiply(&turn, &back);
        for (uint32_t k = 0; k < TEST_SCENE_MESHES; k++)
            picture.draws[k].world_from_local = nook_matrix_multiply(&there, &place);
        picture.frame.cull_back_faces = i % 2 == 0;
        for (int again = 0; again < 3; again++) /* all of it; what showed; what that leaves */
            different += count_different(&b, &picture.frame);
    }
    assert_int_equal(different, 0);
    both_destroy(&b);
    test_picture_destroy(&picture);
}

/** A wall of 2 x 2 at z = -2, and something half as large a metre behind it. */
static void make_wall(void **state, test_scene *scene, test_picture *picture, uint32_t *out_wall, uint32_t *out_behind)
{
    test_scene_init(scene);
    *out_wall = test_scene_add_facing(scene, 1.0f, -2.0f);
    *out_behind = test_scene_add_facing(scene, 0.5f, -3.0f);
    test_picture_create(picture, test_gpu_of(state), scene, SIZE, SIZE);
}

static void test_what_a_wall_hides_is_not_drawn_and_shows_in_the_frame_in_which_the_wall_goes(void **state)
{
    test_scene scene;
    test_picture picture;
    both b;
    uint32_t wall, behind;
    make_wall(state, &scene, &picture, &wall, &behind);
    both_create(&b, test_gpu_of(state), SIZE, SIZE);
    if (!b.gpu->software) {
        print_message("only software GL culls triangles\n");
        skip();
    }
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 12); /* nothing was known */
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 6);
    assert_int_equal(b.culled->cull.rest.count, 0);
    picture.draws[wall].world_from_local = nook_matrix_translation(1.2, 0.0, 0.0);
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 12);
    assert_int_equal(b.culled->cull.rest.count, 6);
    both_destroy(&b);
    test_picture_destroy(&picture);
}

static void test_what_comes_before_a_lamp_takes_its_light_from_the_picture(void **state)
{
    test_scene scene;
    test_picture picture;
    both b;
    uint32_t wall, lamp;
    make_wall(state, &scene, &picture, &wall, &lamp);
    test_picture_destroy(&picture);
    scene.materials[lamp].emissive[1] = 3.0f;
    test_picture_create(&picture, test_gpu_of(state), &scene, SIZE, SIZE);
    both_create(&b, test_gpu_of(state), SIZE, SIZE);
    picture.draws[wall].world_from_local = nook_matrix_translation(0.0, 0.0, -3.0); /* behind the lamp */
    for (int i = 0; i < 2; i++)
        assert_int_equal(count_different(&b, &picture.frame), 0);
    picture.draws[wall].world_from_local = nook_matrix_translation(0.9, 0.0, 0.0);
    assert_int_equal(count_different(&b, &picture.frame), 0);
    both_destroy(&b);
    test_picture_destroy(&picture);
}

static void test_triangles_that_face_away_or_miss_all_pixels_are_not_drawn(void **state)
{
    test_scene scene;
    test_picture picture;
    both b;
    test_scene_init(&scene);
    uint32_t away = test_scene_add_facing(&scene, 1.0f, -2.0f);
    uint32_t tiny = test_scene_add_facing(&scene, 1e-4f, -1.0f); /* between the centres of four pixels */
    test_picture_create(&picture, test_gpu_of(state), &scene, SIZE, SIZE);
    both_create(&b, test_gpu_of(state), SIZE, SIZE);
    if (!b.gpu->software) {
        print_message("only software GL culls triangles\n");
        skip();
    }
    picture.draws[away].world_from_local.m[0] = -1.0; /* mirrored, so that its front is still on this side */
    picture.frame.cull_back_faces = true;
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 6);
    picture.draws[away].world_from_local = nook_matrix_translation(0.0, 0.0, -4.0);
    picture.draws[away].world_from_local.m[0] = -1.0;
    picture.draws[away].world_from_local.m[10] = -1.0; /* half a turn around y: away */
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 0);
    picture.frame.cull_back_faces = false;
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 6);
    picture.draws[tiny].world_from_local = nook_matrix_translation(1.0 / SIZE, 1.0 / SIZE, 0.0); /* on a centre */
    assert_int_equal(count_different(&b, &picture.frame), 0);
    assert_int_equal(b.culled->cull.kept.count, 12);
    both_destroy(&b);
    test_picture_destroy(&picture);
}

/** From one of the hall's cameras to the next, a part of the way. */
static nook_camera between(const nook_scene *scene, uint32_t from, double way)
{
    nook_camera a = nook_camera_from_scene(&scene->cameras[from]);
    nook_camera b = nook_camera_from_scene(&scene->cameras[(from + 1) % scene->camera_count]);
    nook_matrix world_from_a, world_from_b;
    double eye[3], target[3];
    const double up[3] = { 0.0, 1.0, 0.0 };
    assert_true(nook_matrix_inverse_affine(&a.view_from_world, &world_from_a));
    assert_true(nook_matrix_inverse_affine(&b.view_from_world, &world_from_b));
    for (int k = 0; k < 3; k++) {
        eye[k] = world_from_a.m[12 + k] * (1.0 - way) + world_from_b.m[12 + k] * way;
        target[k] = eye[k] - world_from_a.m[8 + k] * (1.0 - way) - world_from_b.m[8 + k] * way;
    }
    a.view_from_world = nook_matrix_look_at(eye, target, up);
    return a;
}

/** Of the triangles of all instances in view. */
static size_t count_indices(const nook_scene *scene, const draw_set *set)
{
    const batch *batches = set->batches.items;
    size_t count = 0;
    for (uint32_t i = 0; i < set->batch_count; i++) {
        const nook_mesh *mesh = &scene->meshes[batches[i].mesh];
        for (uint32_t k = 0; k < mesh->primitive_count; k++)
            count += (size_t)scene->primitives[mesh->first_primitive + k].index_count * batches[i].instance_count;
    }
    return count;
}

static void test_a_walk_through_the_hall_is_the_same_with_a_third_of_its_triangles(void **state)
{
    char path[512];
    nook_scene *scene = NULL;
    nook_render_scene *uploaded = NULL;
    both b;
    snprintf(path, sizeof path, "%s/content/hall/hall.glb", test_gpu_root());
    assert_int_equal(nook_scene_load(path, NULL, &scene), NOOK_OK);
    assert_int_equal(nook_render_scene_create(test_gpu_of(state), scene, &uploaded), NOOK_OK);
    size_t count = nook_scene_draws(scene, NULL);
    nook_draw *draws = calloc(count, sizeof *draws);
    assert_non_null(draws);
    nook_scene_draws(scene, draws);
    nook_lights lights = nook_lights_from_scene(scene);
    nook_frame frame = {
        .scene = uploaded, .draws = draws, .draw_count = count, .lights = &lights, .cull_back_faces = true
    };
    both_create(&b, test_gpu_of(state), WIDTH, HEIGHT);
    for (uint32_t i = 0; i < scene->camera_count * 8; i++) {
        frame.camera = between(scene, i / 8, i % 8 < 2 ? 0.0 : 0.02 * (i % 8));
        assert_int_equal(count_different(&b, &frame), 0);
        if (b.gpu->software && i % 8 == 1) /* the second frame of a camera that stands still */
            assert_true(b.culled->cull.kept.count * 3 < count_indices(scene, &b.whole->visible));
    }
    both_destroy(&b);
    nook_render_scene_destroy(uploaded);
    nook_scene_destroy(scene);
    free(draws);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_left_out_shows_nothing_whatever_moves),
        cmocka_unit_test(test_meshes_far_from_their_own_origin_lose_nothing),
        cmocka_unit_test(test_what_a_wall_hides_is_not_drawn_and_shows_in_the_frame_in_which_the_wall_goes),
        cmocka_unit_test(test_what_comes_before_a_lamp_takes_its_light_from_the_picture),
        cmocka_unit_test(test_triangles_that_face_away_or_miss_all_pixels_are_not_drawn),
        cmocka_unit_test(test_a_walk_through_the_hall_is_the_same_with_a_third_of_its_triangles),
    };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
