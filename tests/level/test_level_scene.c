#include "engine/core/file.h"
#include "game/level/level_scene.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* A room with three boxes, and a library of two parts, one of them with a child. */
static nook_level *read_level(const char *entities)
{
    static char path[4096];
    char text[4096];
    nook_level *level;
    play_room_write_scene("room.glb", PLAY_BOX("crate_0", 1, 0.5, 0, 1, 1, 1, PLAY_BODY(15))
                                          PLAY_BOX("crate_1", 3, 0.5, 0, 1, 1, 1, PLAY_BODY(15))
                                              PLAY_BOX("pillar", 5, 1, 0, 1, 2, 1, "") ", { 'name': 'crate_lamp' }");
    play_room_write_scene(
        "parts.glb",
        PLAY_BOX("gate", 0, 1, 0, 1, 2, 0.1,
                 PLAY_BODY(80)) ", { 'name': 'tree', 'mesh': 0, 'children': [ 3 ] }, {  'name': 'apple', 'mesh': 0 }");
    snprintf(text, sizeof text, "scene = room.glb\nlibrary = parts parts.glb\n%s", entities);
    nook_scratch_path(path, sizeof path, "joined.level");
    assert_int_equal(nook_file_write(path, text, strlen(text)), NOOK_OK);
    assert_int_equal(nook_level_read(path, &level), NOOK_OK);
    return level;
}

static nook_scene *must_load(const char *entities)
{
    nook_scene *scene;
    nook_level *level = read_level(entities);
    assert_int_equal(nook_level_scene_load(level, NULL, &scene), NOOK_OK);
    nook_level_free(level);
    return scene;
}

static void must_refuse(const char *entities, nook_result code, const char *reason)
{
    nook_scene *scene;
    nook_log_capture log;
    nook_level *level = read_level(entities);
    nook_log_capture_begin(&log);
    nook_result result = nook_level_scene_load(level, NULL, &scene);
    nook_log_capture_end();
    if (result != code || log.errors != 1 || !strstr(log.text, reason))
        fail_msg("expected %d and '%s', got %d: %s", code, reason, result, log.text);
    assert_null(scene);
    nook_level_free(level);
}

static const nook_node *find(const nook_scene *scene, const char *name)
{
    const nook_node *found = NULL;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        if (strcmp(scene->nodes[i].name, name) == 0) {
            assert_null(found);
            found = &scene->nodes[i];
        }
    }
    if (!found)
        fail_msg("there is no %s", name);
    return found;
}

static void test_scenes_stand_and_libraries_wait_to_be_asked(void **state)
{
    (void)state;
    nook_scene *scene = must_load("");
    assert_int_equal(scene->node_count, 5);
    assert_int_equal(scene->mesh_count, 2);
    assert_true(find(scene, "crate_0")->moving && !find(scene, "floor")->moving);
    nook_scene_destroy(scene);
}

static void test_entities_of_libraries_become_nodes_where_they_are_put(void **state)
{
    (void)state;
    nook_scene *scene =
        must_load("[mover left]\nnode = parts:gate\nat = 4 1 2\nturn = 0 90 0\nswing = 0 90 0\nseconds = 1\n"
                  "[fixed right]\nnode = parts:gate\n");
    const nook_node *left = find(scene, "left"), *right = find(scene, "right");
    assert_int_equal(scene->node_count, 7);
    assert_int_equal(left->mesh, 1);
    assert_true(left->moving && !right->moving);
    assert_true(left->mass == 80.0);
    assert_true(left->world_from_local.m[12] == 4.0 && left->world_from_local.m[14] == 2.0);
    assert_true(fabs(left->world_from_local.m[2] + 1.0) < 1e-12); /* x, one metre wide, turned to -z */
    assert_true(fabs(left->world_from_local.m[5] - 2.0) < 1e-12); /* the scale stays */
    assert_true(right->world_from_local.m[13] == 1.0 && right->world_from_local.m[0] == 1.0); /* as in its file */
    nook_scene_destroy(scene);
}

static void test_entities_change_nodes_that_stand_there(void **state)
{
    (void)state;
    nook_scene *scene =
        must_load("[fixed crate_0]\n[body crate_*]\nmass = 2\n[spinner turning]\nnode = pillar\naxis = 0 1 0\nrpm = 3\n"
                  "at = 5 3 0\n");
    assert_int_equal(scene->node_count, 5);
    assert_false(find(scene, "crate_0")->moving);
    assert_true(find(scene, "crate_1")->moving);
    assert_true(find(scene, "pillar")->moving);
    assert_true(find(scene, "pillar")->world_from_local.m[13] == 3.0);
    assert_true(find(scene, "pillar")->world_from_local.m[5] == 2.0);
    assert_true(scene->bounds_max[1] == 4.0);
    nook_scene_destroy(scene);
}

static void test_patterns_look_over_nodes_that_draw_nothing(void **state)
{
    (void)state;
    nook_scene *scene = must_load("[body crate_*]\nmass = 3\n[fixed *]\n");
    assert_true(find(scene, "crate_0")->moving && find(scene, "crate_1")->moving && !find(scene, "pillar")->moving);
    nook_scene_destroy(scene);
    must_refuse("[body crate_lamp*]\n", NOOK_E_NOT_FOUND, "there is no node crate_lamp*");
    must_refuse("[body crate_lamp]\n", NOOK_E_FORMAT, "crate_lamp of ");
}

static void test_nodes_that_no_file_has_are_named_with_what_is_near(void **state)
{
    (void)state;
    must_refuse("[body crate_2]\n", NOOK_E_NOT_FOUND,
                "joined.level:3: crate_2: there is no node crate_2 in the scene; did you mean crate_0?");
    must_refuse("[body box*]\n", NOOK_E_NOT_FOUND, "joined.level:3: box*");
    must_refuse("[fixed x]\nnode = parts:gaet\n", NOOK_E_NOT_FOUND,
                "there is no node gaet in parts; did you mean gate?");
    must_refuse("[fixed x]\nnode = prats:gate\n", NOOK_E_NOT_FOUND, "there is no library prats");
}

static void test_nodes_that_cannot_be_one_body_are_refused(void **state)
{
    (void)state;
    must_refuse("[fixed x]\nnode = parts:tree\n", NOOK_E_FORMAT, "has apple below it");
    must_refuse("[fixed pillar]\nnode = parts:gate\n", NOOK_E_FORMAT, "has a node of that name");
}

static void test_a_file_that_is_missing_fails_the_level(void **state)
{
    (void)state;
    nook_scene *scene;
    nook_log_capture log;
    nook_level *level = read_level("");
    snprintf(level->files[1].path, sizeof level->files[1].path, "nowhere.glb");
    nook_log_capture_begin(&log);
    assert_int_equal(nook_level_scene_load(level, NULL, &scene), NOOK_E_NOT_FOUND);
    nook_log_capture_end();
    assert_null(scene);
    assert_int_equal(log.errors, 1);
    assert_non_null(strstr(log.text, ".level:"));
    assert_non_null(strstr(log.text, "there is no file nowhere.glb"));
    nook_level_free(level);
}

static void test_a_field_in_a_library_is_left_out_with_a_word(void **state)
{
    (void)state;
    static const char field[] = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n\1\2\3\4\5\6\7";
    char path[4096];
    nook_scene *scene;
    nook_log_capture log;
    nook_scratch_path(path, sizeof path, "cloud.nrrd");
    assert_int_equal(nook_file_write(path, field, sizeof field), NOOK_OK);
    nook_level *level = read_level("");
    play_room_write_scene("parts.glb", ", { 'name': 'cloud', 'extras': { 'nook_density': { 'file': 'cloud.nrrd', "
                                       "'window': [ 0, 8 ], 'length': 1 } } }");
    nook_log_capture_begin(&log);
    nook_result result = nook_level_scene_load(level, NULL, &scene);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_OK);
    assert_int_equal(scene->density_count, 0);
    assert_int_equal(log.count, 1);
    assert_non_null(strstr(log.text, "parts.glb: the scalar field of cloud is left out"));
    nook_scene_destroy(scene);
    nook_level_free(level);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes_stand_and_libraries_wait_to_be_asked),
        cmocka_unit_test(test_entities_of_libraries_become_nodes_where_they_are_put),
        cmocka_unit_test(test_entities_change_nodes_that_stand_there),
        cmocka_unit_test(test_patterns_look_over_nodes_that_draw_nothing),
        cmocka_unit_test(test_nodes_that_no_file_has_are_named_with_what_is_near),
        cmocka_unit_test(test_nodes_that_cannot_be_one_body_are_refused),
        cmocka_unit_test(test_a_file_that_is_missing_fails_the_level),
        cmocka_unit_test(test_a_field_in_a_library_is_left_out_with_a_word),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
