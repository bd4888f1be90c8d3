/* The reference in the background: what it comes to, what it tells of itself, and that it stops. */
#include "engine/core/clock.h"
#include "modules/trace/refine.h"
#include "tests/support/ao_screen.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { SIDE = 48, PIXELS = SIDE * SIDE };

typedef struct fixture {
    nook_fixture_view *view;
    nook_refine *refine;
    float mean[PIXELS];
    double noise;
} fixture;

/** A floor and a box on it, two occluders; a part of the picture sees nothing. */
static int make(void **state, uint32_t side)
{
    fixture *f = calloc(1, sizeof *f);
    assert_non_null(f);
    f->view = ao_view_create(side, side);
    ao_screen_look(f->view, (double[]){ 0.8, -2, 1.2 }, (double[]){ 0, 0, 0.1 }, 1.2, 0.7);
    for (int i = 0; i < 2; i++) {
        nook_fixture_mesh mesh = { 0 };
        if (i == 0)
            nook_fixture_add_quad(&mesh, (double[]){ -1, -1, 0 }, (double[]){ 2, 0, 0 }, (double[]){ 0, 2, 0 });
        else
            nook_fixture_add_box(&mesh, (double[]){ -0.3, -0.3, 0.0 }, (double[]){ 0.3, 0.3, 0.5 }, 63);
        ao_view_draw(f->view, &mesh);
        ao_view_add(f->view, &mesh, 0);
        nook_fixture_mesh_free(&mesh);
    }
    ao_view_record(f->view, "probe");
    assert_int_equal(nook_refine_create(&f->refine), NOOK_OK);
    *state = f;
    return 0;
}

static int setup(void **state)
{
    return make(state, SIDE);
}

static int setup_large(void **state)
{
    return make(state, 2 * SIDE);
}

static int teardown(void **state)
{
    fixture *f = *state;
    nook_refine_destroy(f->refine);
    ao_view_destroy(f->view);
    free(f);
    return 0;
}

static void start(fixture *f, uint32_t rays_max, unsigned threads)
{
    nook_fixture_view *view = f->view;
    nook_ao_snapshot snapshot;
    nook_ao_frame frame = { .depth = { view->depth.id, view->width, view->height },
                            .normal = { view->normal.id, view->width, view->height } };
    const nook_refine_desc desc = { rays_max, threads };
    memcpy(frame.view_from_world, view->view_from_world.m, sizeof frame.view_from_world);
    memcpy(frame.clip_from_view, view->clip_from_view.m, sizeof frame.clip_from_view);
    assert_int_equal(nook_ao_snapshot_take(view->ao, &frame, &snapshot), NOOK_OK);
    assert_int_equal(nook_refine_start(f->refine, &desc, &snapshot), NOOK_OK);
    assert_null(snapshot.depth);
}

static void wait_for_end(fixture *f)
{
    for (int i = 0; nook_refine_look(f->refine).running; i++) {
        assert_true(i < 20000);
        usleep(1000);
    }
}

static double rms_difference(const fixture *f, const float *a, const float *b)
{
    double sum = 0.0, count = 0.0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (f->view->device_depth[i] > 0.0f)
            sum += pow((double)(a[i] - b[i]), 2.0), count += 1.0;
    }
    assert_true(count > 100.0);
    return sqrt(sum / count);
}

static void test_refinement_comes_to_the_reference_s_own_picture_within_its_noise(void **state)
{
    fixture *f = *state;
    ao_view_param(f->view, "reference.rays", "8192");
    ao_view_param(f->view, "ao.filter", "none");
    ao_view_record(f->view, "reference");
    start(f, 1024, 2);
    wait_for_end(f);
    uint32_t rays = nook_refine_read(f->refine, f->mean, &f->noise);
    assert_in_range(rays, 700, 1024);
    double apart = rms_difference(f, f->mean, f->view->visibility);
    if (!(f->noise > 1e-4 && f->noise < 0.01 && apart < 1.5 * f->noise && apart > 0.3 * f->noise))
        fail_msg("noise %.5f, difference %.5f", f->noise, apart);
    for (uint32_t i = 0; i < PIXELS; i++)
        assert_true(f->view->device_depth[i] > 0.0f || f->mean[i] == 1.0f);
}

static void test_more_rays_are_less_noise(void **state)
{
    fixture *f = *state;
    double before = INFINITY;
    static const uint32_t rays_max[] = { 8, 56, 504 };
    for (size_t i = 0; i < NOOK_COUNT(rays_max); i++) {
        start(f, rays_max[i], 1);
        wait_for_end(f);
        assert_int_equal(nook_refine_read(f->refine, f->mean, &f->noise), rays_max[i]);
        if (!(f->noise < 0.6 * before))
            fail_msg("%u rays: noise %.5f, before %.5f", rays_max[i], f->noise, before);
        before = f->noise;
    }
}

static void test_same_rays_are_the_same_picture_with_any_number_of_threads(void **state)
{
    fixture *f = *state;
    static float first[PIXELS];
    start(f, 120, 1);
    wait_for_end(f);
    nook_refine_read(f->refine, first, &f->noise);
    start(f, 120, 3);
    wait_for_end(f);
    nook_refine_read(f->refine, f->mean, &f->noise);
    assert_memory_equal(first, f->mean, sizeof first);
}

static void test_what_is_there_can_be_read_while_it_goes_on(void **state)
{
    fixture *f = *state;
    start(f, 1000000, 1);
    uint32_t seen = 0, changes = 0;
    double begin = nook_clock_ms();
    while (changes < 4 && nook_clock_ms() - begin < 20000.0) {
        uint32_t rays = nook_refine_look(f->refine).rays;
        if (rays > seen) {
            assert_int_equal(nook_refine_read(f->refine, f->mean, &f->noise) >= rays, true);
            assert_true(f->noise > 0.0);
            seen = rays, changes++;
        }
        usleep(500);
    }
    assert_int_equal(changes, 4);
    assert_true(nook_refine_look(f->refine).running);
}

/* Pictures of few rays come to 248 of them; all that follow have 128. */
enum { RAYS_OF_SMALL_PICTURES = 248, RAYS_OF_PICTURE = 128 };

/* From the start until so many rays are there, without looking so often that looking takes long. */
static double cpu_ms_of(fixture *f, uint32_t rays)
{
    double begin = nook_clock_cpu_ms();
    start(f, rays, 2);
    while (nook_refine_look(f->refine).running)
        usleep(50000);
    assert_int_equal(nook_refine_look(f->refine).rays, rays);
    return nook_clock_cpu_ms() - begin;
}

/* Of a large picture, in processor time, which no other program takes: wall time says how busy the machine is. */
static void test_stopping_leaves_a_picture_of_many_rays_after_few_of_them(void **state)
{
    enum { PICTURES = 16 };
    fixture *f = *state;
    cpu_ms_of(f, RAYS_OF_SMALL_PICTURES); /* the first time takes longer */
    double few = cpu_ms_of(f, RAYS_OF_SMALL_PICTURES);
    double many = cpu_ms_of(f, RAYS_OF_SMALL_PICTURES + PICTURES * RAYS_OF_PICTURE);
    double picture = (many - few) / PICTURES, least = INFINITY;
    for (int i = 0; i < 4; i++) { /* in one of which nobody takes the core away while this thread stops them */
        start(f, 1000000, 2);
        while (nook_refine_look(f->refine).rays < RAYS_OF_SMALL_PICTURES)
            usleep(200);
        double begin = nook_clock_cpu_ms();
        nook_refine_stop(f->refine);
        least = fmin(least, nook_clock_cpu_ms() - begin);
        assert_false(nook_refine_look(f->refine).running);
    }
    if (!(least < 0.25 * picture)) /* each of both threads ends 32 pixels of 9216 */
        fail_msg("%.2f ms of a picture's %.2f", least, picture);
    nook_refine_stop(f->refine); /* again */
}

static void test_what_was_traced_can_be_read_after_the_stop(void **state)
{
    fixture *f = *state;
    start(f, 1000000, 1);
    while (nook_refine_look(f->refine).rays == 0)
        usleep(500);
    nook_refine_stop(f->refine);
    assert_true(nook_refine_read(f->refine, f->mean, &f->noise) >= 8);
}

static void test_nothing_is_read_before_the_first_start(void **state)
{
    fixture *f = *state;
    uint32_t width, height;
    nook_refine_probe_result probe;
    f->noise = 7.0;
    assert_int_equal(nook_refine_read(f->refine, f->mean, &f->noise), 0);
    assert_true(f->noise == 7.0);
    assert_null(nook_refine_depth(f->refine, &width, &height));
    assert_false(nook_refine_probe(f->refine, 0, 0, &probe));
    nook_refine_stop(f->refine);
}

static void test_probe_tells_whose_triangles_hide_the_sky(void **state)
{
    fixture *f = *state;
    nook_refine_probe_result probe;
    start(f, 504, 1);
    wait_for_end(f);
    nook_refine_read(f->refine, f->mean, &f->noise);
    uint32_t on_floor = 0, asked = 0;
    for (uint32_t y = 0; y < SIDE; y++) {
        for (uint32_t x = 0; x < SIDE; x++) {
            bool seen = f->view->device_depth[y * SIDE + x] > 0.0f;
            assert_int_equal(nook_refine_probe(f->refine, x, y, &probe), seen);
            if (!seen)
                continue;
            double sum = 0.0;
            for (uint32_t i = 0; i < probe.count; i++) {
                assert_true(i == 0 || probe.shares[i] <= probe.shares[i - 1]);
                sum += probe.shares[i];
            }
            assert_true(fabs(sum - (1.0 - probe.visibility)) < 1e-9);
            assert_true(fabs(probe.visibility - (double)f->mean[y * SIDE + x]) < 0.08);
            /* Flat floor: only the box hides it. The box is convex: only the floor hides it. */
            if (probe.count > 0 && sum > 0.05) {
                assert_int_equal(probe.count, 1);
                on_floor += probe.occluders[0] == 1;
                asked++;
            }
        }
    }
    assert_true(on_floor > 50 && asked > on_floor + 50);
    assert_false(nook_refine_probe(f->refine, SIDE, 0, &probe));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_is_read_before_the_first_start),
        cmocka_unit_test(test_refinement_comes_to_the_reference_s_own_picture_within_its_noise),
        cmocka_unit_test(test_more_rays_are_less_noise),
        cmocka_unit_test(test_same_rays_are_the_same_picture_with_any_number_of_threads),
        cmocka_unit_test(test_what_is_there_can_be_read_while_it_goes_on),
        cmocka_unit_test(test_what_was_traced_can_be_read_after_the_stop),
        cmocka_unit_test(test_probe_tells_whose_triangles_hide_the_sky),
    };
    const struct CMUnitTest large[] = {
        cmocka_unit_test(test_stopping_leaves_a_picture_of_many_rays_after_few_of_them),
    };
    return cmocka_run_group_tests(tests, setup, teardown) + cmocka_run_group_tests(large, setup_large, teardown);
}
