#include "engine/core/file.h"
#include "game/components.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define STILL ", 'extras': { 'nook_body': false }"
#define ROOM                                                        \
    PLAY_BOX("plate", 0, 0.025, -2, 1, 0.05, 1, STILL)              \
    PLAY_BOX("wheel", 3, 1, -2, 1, 1, 0.1, "")                      \
    PLAY_BOX("stone", -2, 0.1, -2, 0.2, 0.2, 0.2, STILL)            \
    PLAY_BOX("crate_0", 2, 0.2, -1.2, 0.4, 0.4, 0.4, PLAY_BODY(15)) \
    PLAY_BOX("crate_1", 2, 0.6, -1.2, 0.4, 0.4, 0.4, PLAY_BODY(15))
static const char entities[] = "task = Play\nseconds = 60\n[plate plate]\nweight = 70\nseconds = 0.2\n"
                               "[spinner wheel]\naxis = 0 0 1\nrpm = 10\n[shade stone]\nvisibility = 0.3\nreach = 2\n"
                               "[goal end]\nat = 0 1 -4\nsize = 1 2 1\nneeds = plate\n";
static const nook_play_input restart = { .buttons = NOOK_PLAY_RESTART };

/* Everything that can be changed is. */
static const char stir[] =
    "take crate_1\nwalk_to -1 -1\nthrow\nwalk_to 0 -2\njump\nwait 0.4\ncrouch\nwalk_to 1.5 -1\ntake crate_0\n"
    "wait 0.5\n";

static uint64_t fresh_hash(void)
{
    play_room room = play_room_open(ROOM, entities);
    uint64_t hash = nook_session_hash(room.session);
    play_room_close(&room);
    return hash;
}

static void test_a_restart_from_any_state_is_a_fresh_start(void **state)
{
    (void)state;
    play_room room = play_room_open(ROOM, entities);
    play_room_pilot(&room, stir);
    assert_true(nook_session_hash(room.session) != fresh_hash());
    play_room_tick(&room, &restart, 1);
    assert_true(nook_session_hash(room.session) == fresh_hash());
    assert_true(play_room_look(&room).ticks == 0);
    assert_string_equal(play_room_look(&room).message, "Play");
    assert_int_equal(nook_session_restart(room.session), NOOK_OK);
    assert_true(nook_session_hash(room.session) == fresh_hash());
    play_room_close(&room);
}

static void test_a_restart_after_the_end_is_a_fresh_start(void **state)
{
    (void)state;
    play_room room = play_room_open(ROOM, entities);
    play_room_wait(&room, 61.0);
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_LOST);
    play_room_tick(&room, &restart, 1);
    assert_int_equal(play_room_look(&room).status, NOOK_SESSION_PLAYING);
    assert_true(nook_session_hash(room.session) == fresh_hash());
    play_room_close(&room);
}

static void test_the_same_inputs_end_in_the_same_state_however_often_it_is_drawn(void **state)
{
    (void)state;
    play_room once = play_room_open(ROOM, entities), again = play_room_open(ROOM, entities);
    const nook_play_input nothing = { 0 };
    for (int i = 0; i < 100; i++) {
        play_room_tick(&once, &nothing, 1);
        play_room_tick(&again, &nothing, 1);
        nook_session_place(again.session, 0.3);
    }
    play_room_pilot(&once, stir);
    play_room_pilot(&again, stir);
    assert_true(nook_session_hash(once.session) == nook_session_hash(again.session));
    play_room_close(&once);
    play_room_close(&again);
}

static void test_a_changed_level_goes_on_where_the_old_one_was(void **state)
{
    (void)state;
    const nook_play_input creep = { .forward = 40, .buttons = NOOK_PLAY_CROUCH };
    play_room room = play_room_open(ROOM, entities);
    play_room_pilot(&room, "take crate_1\nplace_at -1 0.2 1\nwalk_to 0 -2\nwait 1\n");
    play_room_tick(&room, &creep, 20);
    assert_true(nook_session_state_of(room.session, "plate") == 1.0);
    nook_session_view before = play_room_look(&room);
    double crate[2][3], stays[3];
    play_room_middle(&room, "crate_1", crate[0]);

    /* Another crate was moved by the author, the wheel turns faster, and the goal lies elsewhere. */
    char changed[1024];
    snprintf(changed, sizeof changed, "%s[body crate_0]\nat = 4 0.2 3\n", entities);
    play_room next = play_room_open(ROOM, changed);
    assert_int_equal(nook_session_carry_over(next.session, room.session), NOOK_OK);
    nook_session_view after = play_room_look(&next);
    assert_true(after.ticks == before.ticks && after.crouched && after.yaw == before.yaw && after.open == before.open);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(after.feet[k] - before.feet[k]) < 1e-12);
    play_room_middle(&next, "crate_1", crate[1]);
    assert_memory_equal(crate[0], crate[1], sizeof crate[0]);
    play_room_middle(&next, "crate_0", stays);
    assert_true(fabs(stays[0] - 4.0) < 0.001 && fabs(stays[2] - 3.0) < 0.001);
    assert_true(nook_session_state_of(next.session, "plate") == 1.0);
    assert_true(nook_session_state_of(next.session, "wheel") == nook_session_state_of(room.session, "wheel"));
    play_room_close(&room); /* nothing of it is needed any more */
    play_room_tick(&next, &creep, 60);
    assert_true(nook_session_state_of(next.session, "plate") == 1.0);
    play_room_middle(&next, "crate_1", stays);
    assert_true(hypot(stays[0] - crate[1][0], stays[2] - crate[1][2]) < 0.001);
    play_room_close(&next);
}

static nook_matrix transform_of(const play_room *room, const char *name)
{
    nook_matrix out = { { 0 } };
    for (uint32_t i = 0; i < room->scene->node_count; i++) {
        if (strcmp(room->scene->nodes[i].name, name) != 0)
            continue;
        const nook_transform *t =
            nook_entity_find(nook_game_world_entities(room->world), nook_game_world_entity_of_node(room->world, i),
                             nook_game_world_components(room->world)->transform);
        memcpy(out.m, t->world_from_local, sizeof out.m);
        return out;
    }
    fail_msg("there is no %s", name);
    return out;
}

static void test_place_puts_entities_between_the_last_two_ticks_with_their_scale(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("crate", 0, 3, -2, 0.5, 0.25, 0.75, PLAY_BODY(15)), "");
    const nook_play_input nothing = { 0 };
    double middle[2][3];
    play_room_tick(&room, &nothing, 10);
    play_room_middle(&room, "crate", middle[0]);
    play_room_tick(&room, &nothing, 1);
    play_room_middle(&room, "crate", middle[1]);
    assert_true(middle[1][1] < middle[0][1] - 0.01);
    for (int i = 0; i <= 4; i++) {
        double alpha = i / 4.0;
        nook_session_place(room.session, alpha);
        nook_matrix m = transform_of(&room, "crate");
        assert_true(fabs(m.m[13] - (middle[0][1] + alpha * (middle[1][1] - middle[0][1]))) < 1e-12);
        assert_true(fabs(m.m[0] - 0.5) < 1e-6 && fabs(m.m[5] - 0.25) < 1e-6 && fabs(m.m[10] - 0.75) < 1e-6);
    }
    nook_session_place(room.session, 1.0);
    nook_matrix floor = transform_of(&room, "floor");
    assert_true(floor.m[0] == 40.0 && floor.m[13] == -0.5);
    play_room_close(&room);
}

static void test_the_camera_looks_from_the_eyes_between_the_ticks(void **state)
{
    (void)state;
    play_room room = play_room_open("", "start = 1 0 2\nlook = 90 0\n");
    const double origin[3] = { 0, 0, 0 }, ahead[3] = { 0, 0, -1 };
    const nook_play_input forward = { .forward = 127 };
    double eye[3][3], direction[3];
    play_room_tick(&room, &forward, 30);
    for (int i = 0; i < 3; i++) {
        nook_matrix world_from_view;
        nook_camera camera = nook_session_camera(room.session, i / 2.0, 1.1);
        assert_true(camera.fov_y_radians == 1.1);
        nook_matrix_inverse_affine(&camera.view_from_world, &world_from_view);
        nook_matrix_apply_point(&world_from_view, origin, eye[i]);
        nook_matrix_apply_vector(&world_from_view, ahead, direction);
        assert_true(fabs(direction[0] + 1.0) < 1e-9);
    }
    assert_true(eye[2][0] < eye[0][0]);
    assert_true(fabs(eye[1][0] - 0.5 * (eye[0][0] + eye[2][0])) < 1e-9);
    assert_true(fabs(eye[2][1] - 1.62) < 1e-3);
    play_room_close(&room);
}

static void test_bodies_of_a_file_lie_still_until_they_are_touched(void **state)
{
    (void)state;
    play_room room = play_room_open(ROOM, entities);
    nook_physics_statistics statistics;
    double before[3], after[3];
    play_room_middle(&room, "crate_1", before);
    play_room_wait(&room, 1.0);
    play_room_middle(&room, "crate_1", after);
    assert_memory_equal(before, after, sizeof before);
    nook_physics_get_statistics(nook_session_physics(room.session), &statistics);
    assert_int_equal(statistics.awake, 1); /* the player */
    play_room_close(&room);
}

static void test_bodies_that_hang_in_the_air_fall(void **state)
{
    (void)state;
    play_room room = play_room_open(
        PLAY_BOX("crate", 0, 1, -2, 0.4, 0.4, 0.4, PLAY_BODY(15))
            PLAY_BOX("hung", 2, 1, -2, 0.4, 0.4, 0.4, ", 'extras': { 'nook_body': true, 'nook_hung': true }"),
        "");
    double middle[3];
    play_room_wait(&room, 2.0);
    play_room_middle(&room, "crate", middle);
    assert_true(fabs(middle[1] - 0.2) < 0.005);
    play_room_middle(&room, "hung", middle);
    assert_true(middle[1] == 1.0);
    play_room_close(&room);
}

static void test_seeds_scatter_bodies_by_half_a_millimetre_at_most(void **state)
{
    (void)state;
    play_room room = play_room_open(ROOM, entities);
    char path[1024];
    snprintf(path, sizeof path, "%s", room.level->path);
    play_room other = play_room_open_level(path, 7), same = play_room_open_level(path, 7);
    double a[3], b[3];
    play_room_middle(&room, "crate_0", a);
    play_room_middle(&other, "crate_0", b);
    double way = hypot(a[0] - b[0], a[2] - b[2]);
    assert_true(way > 1e-6 && way < 0.0015 && a[1] == b[1]);
    assert_true(nook_session_hash(other.session) == nook_session_hash(same.session));
    assert_true(nook_session_hash(other.session) != nook_session_hash(room.session));
    play_room_close(&room);
    play_room_close(&other);
    play_room_close(&same);
}

static void test_masses_are_those_of_level_file_or_box_in_this_order(void **state)
{
    (void)state;
    play_room room = play_room_open(PLAY_BOX("a", 0, 0.5, -3, 1, 1, 1, PLAY_BODY(15))
                                        PLAY_BOX("b", 2, 0.5, -3, 1, 1, 1, PLAY_BODY(15))
                                            PLAY_BOX("c", 4, 0.5, -3, 1, 1, 0.5, ", 'extras': { 'nook_body': true }"),
                                    "[body a]\nmass = 7\n");
    const nook_physics *physics = nook_session_physics(room.session);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "a")) == 7.0);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "b")) == 15.0);
    assert_true(fabs(nook_physics_mass(physics, nook_session_body_of(room.session, "c")) - 250.0) < 1e-3);
    assert_true(nook_physics_mass(physics, nook_session_body_of(room.session, "floor")) == 0.0);
    assert_int_equal(nook_session_body_of(room.session, "nothing").id, 0);
    play_room_close(&room);
}

static void test_states_are_asked_for_by_name(void **state)
{
    (void)state;
    play_room room = play_room_open(ROOM, entities);
    assert_true(nook_session_state_of(room.session, "plate") == 0.0);
    assert_true(nook_session_state_of(room.session, "end") == 0.0);
    assert_true(nook_session_state_of(room.session, "crate_0") == -1.0);
    assert_true(nook_session_state_of(room.session, "nothing") == -1.0);
    assert_true(nook_session_measure_of(room.session, "wheel") == -1.0);
    play_room_close(&room);
}

static void test_a_level_whose_scene_lacks_a_node_is_refused_with_its_line(void **state)
{
    (void)state;
    play_room room = play_room_open(ROOM, entities);
    nook_session *session;
    nook_log_capture log;
    snprintf(room.level->entities[0].node, sizeof room.level->entities[0].node, "plaet");
    snprintf(room.level->entities[0].name, sizeof room.level->entities[0].name, "plaet");
    const nook_session_desc desc = { room.level, room.scene, room.world, 0 };
    nook_log_capture_begin(&log);
    nook_result result = nook_session_create(&desc, &session);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_null(session);
    assert_int_equal(log.errors, 1);
    assert_non_null(strstr(log.text, "room.level:4: plaet"));
    play_room_close(&room);
}

/* A level of two files, of which the second draws only triangles that are lines. */
static play_room open_room_with_wires(void)
{
    play_room room = { 0 };
    char path[1024];
    const char text[] = "scene = solid.glb\nscene = wires.glb\n";
    play_room_write_scene("solid.glb", "");
    play_room_write_scene("wires.glb", PLAY_BOX("wire", 0, 0.5, -1, 1, 1, 1, ""));
    nook_scratch_path(path, sizeof path, "wires.level");
    assert_int_equal(nook_file_write(path, text, sizeof text - 1), NOOK_OK);
    assert_int_equal(nook_level_read(path, &room.level), NOOK_OK);
    assert_int_equal(nook_level_scene_load(room.level, NULL, &room.scene), NOOK_OK);
    assert_int_equal(room.scene->mesh_count, 2);
    const nook_primitive *lines = &room.scene->primitives[room.scene->meshes[1].first_primitive];
    for (uint32_t i = 0; i < lines->index_count; i++)
        room.scene->indices[lines->first_index + i] = i % 3 == 0;
    assert_int_equal(nook_game_world_create(room.scene, &room.world), NOOK_OK);
    return room;
}

static void test_what_has_no_surface_has_no_body_and_harms_nothing(void **state)
{
    (void)state;
    const nook_play_input forward = { .forward = 127 };
    play_room room = open_room_with_wires();
    const nook_session_desc desc = { room.level, room.scene, room.world, 1 };
    assert_int_equal(nook_session_create(&desc, &room.session), NOOK_OK);
    assert_int_equal(nook_session_body_of(room.session, "wire").id, 0);
    play_room_tick(&room, &forward, 60);
    assert_true(play_room_look(&room).grounded && play_room_look(&room).feet[2] < -1.0);
    play_room_close(&room);
}

static void test_a_start_far_from_everything_is_refused(void **state)
{
    (void)state;
    static const double starts[][3] = { { 1000, 0, 0 }, { 0, -500, 0 }, { 0, 0, -1e6 } };
    play_room room = play_room_open("", "");
    nook_session *session;
    nook_log_capture log;
    const nook_session_desc desc = { room.level, room.scene, room.world, 0 };
    for (size_t i = 0; i < NOOK_COUNT(starts); i++) {
        memcpy(room.level->start, starts[i], sizeof starts[i]);
        nook_log_capture_begin(&log);
        assert_int_equal(nook_session_create(&desc, &session), NOOK_E_FORMAT);
        nook_log_capture_end();
        assert_null(session);
        assert_true(log.errors == 1 && strstr(log.text, "there is nothing near it to stand on"));
    }
    play_room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_restart_from_any_state_is_a_fresh_start),
        cmocka_unit_test(test_a_restart_after_the_end_is_a_fresh_start),
        cmocka_unit_test(test_the_same_inputs_end_in_the_same_state_however_often_it_is_drawn),
        cmocka_unit_test(test_a_changed_level_goes_on_where_the_old_one_was),
        cmocka_unit_test(test_place_puts_entities_between_the_last_two_ticks_with_their_scale),
        cmocka_unit_test(test_the_camera_looks_from_the_eyes_between_the_ticks),
        cmocka_unit_test(test_bodies_of_a_file_lie_still_until_they_are_touched),
        cmocka_unit_test(test_bodies_that_hang_in_the_air_fall),
        cmocka_unit_test(test_seeds_scatter_bodies_by_half_a_millimetre_at_most),
        cmocka_unit_test(test_masses_are_those_of_level_file_or_box_in_this_order),
        cmocka_unit_test(test_states_are_asked_for_by_name),
        cmocka_unit_test(test_a_level_whose_scene_lacks_a_node_is_refused_with_its_line),
        cmocka_unit_test(test_what_has_no_surface_has_no_body_and_harms_nothing),
        cmocka_unit_test(test_a_start_far_from_everything_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
