#include "tests/support/physics_scene.h"
#include <inttypes.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

enum { BODIES = 24, STEPS = 150 };

/* A heap of crates, drums and balls that falls on a mesh: the solver's random order matters in it. */
static nook_physics *heap(uint32_t seed)
{
    nook_physics *physics;
    assert_int_equal(nook_physics_create(&(nook_physics_desc){ .seed = seed }, &physics), NOOK_OK);
    physics_scene_mesh grid = physics_scene_grid(5, 16);
    nook_body_desc ground = physics_scene_desc(&grid.shape, NOOK_BODY_STATIC, 0, 0, 0, 0);
    physics_scene_add(physics, &ground);
    physics_scene_mesh_free(&grid);
    for (int i = 0; i < BODIES; i++) {
        nook_shape shape = i % 3 == 0   ? physics_scene_box(0.25, 0.18, 0.21)
                           : i % 3 == 1 ? physics_scene_round(NOOK_SHAPE_CYLINDER, 0.25, 0.3)
                                        : physics_scene_round(NOOK_SHAPE_SPHERE, 0.2, 0);
        nook_body_desc desc =
            physics_scene_desc(&shape, NOOK_BODY_DYNAMIC, 5 + i, 0.3 * (i % 3), 0.5 + 0.4 * i, 0.21 * (i % 4));
        nook_body body = physics_scene_add(physics, &desc);
        nook_physics_set_velocity(physics, body, (double[3]){ 0.1 * i, 0, 0 }, (double[3]){ 1, 2, 0.5 * i });
    }
    return physics;
}

static uint64_t hash_of_run(uint32_t seed)
{
    nook_physics *physics = heap(seed);
    physics_scene_step(physics, STEPS);
    uint64_t hash = nook_physics_hash(physics);
    nook_physics_destroy(physics);
    return hash;
}

static void test_two_runs_are_equal_bit_for_bit(void **state)
{
    (void)state;
    assert_true(hash_of_run(7) == hash_of_run(7));
}

static void test_another_seed_is_another_run(void **state)
{
    (void)state;
    assert_true(hash_of_run(7) != hash_of_run(8));
}

static void test_worlds_side_by_side_do_not_disturb_each_other(void **state)
{
    (void)state;
    nook_physics *first = heap(7), *second = heap(99);
    for (int i = 0; i < STEPS; i++) {
        physics_scene_step(first, 1);
        physics_scene_step(second, 1);
    }
    assert_true(nook_physics_hash(first) == hash_of_run(7));
    assert_true(nook_physics_hash(second) == hash_of_run(99));
    nook_physics_destroy(first);
    nook_physics_destroy(second);
}

static void *run_heap(void *user)
{
    nook_physics *physics = *(nook_physics **)user;
    for (int i = 0; i < STEPS; i++)
        if (nook_physics_step(physics) != NOOK_OK)
            return NULL;
    return user;
}

static void test_worlds_on_two_threads_do_not_disturb_each_other(void **state)
{
    (void)state;
    nook_physics *worlds[2] = { heap(7), heap(7) };
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, run_heap, &worlds[i]), 0);
    for (int i = 0; i < 2; i++) {
        void *done;
        assert_int_equal(pthread_join(threads[i], &done), 0);
        assert_non_null(done);
    }
    assert_true(nook_physics_hash(worlds[0]) == nook_physics_hash(worlds[1]));
    assert_true(nook_physics_hash(worlds[0]) == hash_of_run(7));
    nook_physics_destroy(worlds[0]);
    nook_physics_destroy(worlds[1]);
}

static void test_questions_change_nothing(void **state)
{
    (void)state;
    nook_physics *physics = heap(7);
    const nook_body none[2] = { { 0 } };
    for (int i = 0; i < STEPS; i++) {
        nook_ray_hit hit;
        nook_physics_ray(physics, (double[3]){ 0.1, 9, 0.1 }, (double[3]){ 0, -1, 0 }, 20, none, &hit);
        nook_physics_load(physics, (nook_body){ 1 });
        physics_scene_step(physics, 1);
    }
    assert_true(nook_physics_hash(physics) == hash_of_run(7));
    nook_physics_destroy(physics);
}

static void test_hash_tells_a_body_that_moved_by_a_hair(void **state)
{
    (void)state;
    nook_physics *physics = physics_scene_create();
    nook_body crate = physics_scene_crate(physics, 0.25, 15, 0, 1, 0);
    uint64_t before = nook_physics_hash(physics);
    nook_pose pose = nook_physics_pose(physics, crate, 1.0);
    pose.position[0] += 1e-15;
    nook_physics_set_pose(physics, crate, &pose);
    assert_true(nook_physics_hash(physics) != before);
    nook_physics_destroy(physics);
}

static void test_another_process_comes_to_the_same(void **state)
{
    (void)state;
    char own[4096], command[4200];
    FILE *line = fopen("/proc/self/cmdline", "r"); /* its first string is our path */
    assert_non_null(line);
    assert_non_null(fgets(own, sizeof own, line));
    fclose(line);
    snprintf(command, sizeof command, "'%s' --hash", own);
    uint64_t theirs = 0;
    FILE *other = popen(command, "r");
    assert_non_null(other);
    assert_int_equal(fscanf(other, "%" SCNx64, &theirs), 1);
    assert_int_equal(pclose(other), 0);
    assert_true(theirs == hash_of_run(7));
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--hash") == 0) {
        printf("%016" PRIx64 "\n", hash_of_run(7));
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_runs_are_equal_bit_for_bit),
        cmocka_unit_test(test_another_seed_is_another_run),
        cmocka_unit_test(test_worlds_side_by_side_do_not_disturb_each_other),
        cmocka_unit_test(test_worlds_on_two_threads_do_not_disturb_each_other),
        cmocka_unit_test(test_questions_change_nothing),
        cmocka_unit_test(test_hash_tells_a_body_that_moved_by_a_hair),
        cmocka_unit_test(test_another_process_comes_to_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
