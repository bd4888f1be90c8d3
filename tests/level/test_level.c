#include "engine/core/file.h"
#include "game/level/body.h"
#include "game/level/level.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { PATH_BYTES = 4096 };

static const char *write_bytes(const void *text, size_t size)
{
    static char path[PATH_BYTES];
    nook_scratch_path(path, sizeof path, "a.level");
    assert_int_equal(nook_file_write(path, text, size), NOOK_OK);
    return path;
}

static nook_level *must_read(const char *text)
{
    nook_level *level;
    assert_int_equal(nook_level_read(write_bytes(text, strlen(text)), &level), NOOK_OK);
    return level;
}

static void must_refuse_bytes(const void *text, size_t size, const char *line, const char *reason)
{
    nook_level *level;
    nook_log_capture log;
    char place[64];
    const char *path = write_bytes(text, size);
    nook_log_capture_begin(&log);
    nook_result result = nook_level_read(path, &level);
    nook_log_capture_end();
    snprintf(place, sizeof place, "a.level:%s:", line);
    if (result != NOOK_E_FORMAT || log.count != 1 || !strstr(log.text, place) || !strstr(log.text, reason))
        fail_msg("expected %s and '%s', got %d: %s", place, reason, result, log.text);
    assert_null(level);
}

static void must_refuse(const char *text, const char *line, const char *reason)
{
    must_refuse_bytes(text, strlen(text), line, reason);
}

/* ---- What is right ----------------------------------------------------------------------------------------------- */

static void test_the_top_of_a_level_is_read(void **state)
{
    (void)state;
    nook_level *level = must_read("# a level\n\n title = The  house # here\r\ntask=Go\nwon = W\nlost = L\n"
                                  "scene = ../hall.glb\nscene = /tmp/other.glb\nlibrary = parts sub/my parts.glb\n"
                                  "settings = a.settings\nstart = -10.5 0 1.5\nlook = -90 12.5\nseconds = 360");
    char folder[PATH_BYTES], expected[PATH_BYTES + 32];
    snprintf(folder, sizeof folder, "%.*s", (int)(strlen(level->path) - strlen("a.level")), level->path);
    assert_string_equal(level->title, "The  house");
    assert_string_equal(level->task, "Go");
    assert_string_equal(level->won, "W");
    assert_string_equal(level->lost, "L");
    assert_int_equal(level->file_count, 3);
    snprintf(expected, sizeof expected, "%s../hall.glb", folder);
    assert_string_equal(level->files[0].path, expected);
    assert_string_equal(level->files[0].name, "");
    assert_string_equal(level->files[1].path, "/tmp/other.glb");
    snprintf(expected, sizeof expected, "%ssub/my parts.glb", folder);
    assert_string_equal(level->files[2].path, expected);
    assert_string_equal(level->files[2].name, "parts");
    snprintf(expected, sizeof expected, "%sa.settings", folder);
    assert_string_equal(level->settings, expected);
    assert_true(level->start[0] == -10.5 && level->start[2] == 1.5);
    assert_true(level->yaw == -90.0 && level->pitch == 12.5 && level->seconds == 360.0);
    assert_int_equal(level->entity_count, 0);
    nook_level_free(level);
}

static void test_every_kind_of_entity_is_read(void **state)
{
    (void)state;
    nook_level *level =
        must_read("scene = a.glb\n[body crate_*]\nmass = 15\nshape = box\nfriction = 0.9\nrestitution = 0.5\n"
                  "[fixed post left]\nnode = parts:post\nat = 1 2 3\nturn = 0 90 -45\n"
                  "[plate p]\nweight = 14\naccepts = gear\nseconds = 0.5\n"
                  "[shade s]\nvisibility = 0.4\nreach = 1.5\n"
                  "[mover m]\nswing = 0 -100 0\nslide = 1 0 0\nseconds = 4\nneeds = p s\n"
                  "[spinner w]\naxis = 0 0 -2\nrpm = -40\nlatch = yes\n"
                  "[goal g]\nat = 10 3 0\nsize = 1 2 3\nneeds = m w\n");
    static const nook_level_kind kinds[] = { NOOK_LEVEL_BODY,  NOOK_LEVEL_FIXED,   NOOK_LEVEL_PLATE, NOOK_LEVEL_SHADE,
                                             NOOK_LEVEL_MOVER, NOOK_LEVEL_SPINNER, NOOK_LEVEL_GOAL };
    static const unsigned lines[] = { 2, 7, 11, 15, 18, 23, 27 };
    const nook_level_entity *e = level->entities;
    assert_int_equal(level->entity_count, 7);
    for (uint32_t i = 0; i < 7; i++) {
        assert_int_equal(e[i].kind, kinds[i]);
        assert_int_equal(e[i].line, lines[i]);
    }
    assert_true(e[0].mass == 15.0 && e[0].shape == NOOK_LEVEL_SHAPE_BOX && e[0].friction == 0.9 &&
                e[0].restitution == 0.5);
    assert_false(e[0].placed);
    assert_string_equal(e[0].node, "crate_*");
    assert_string_equal(e[1].name, "post left");
    assert_string_equal(e[1].node, "parts:post");
    assert_true(e[1].placed && e[1].at[2] == 3.0 && e[1].turn[2] == -45.0);
    assert_true(e[1].friction == (double)nook_body_defaults_initial().friction);
    assert_true(e[2].weight == 14.0 && e[2].seconds == 0.5);
    assert_string_equal(e[2].accepts, "gear");
    assert_true(e[3].visibility == 0.4 && e[3].reach == 1.5 && e[3].seconds == 0.0);
    assert_true(e[4].swing[1] == -100.0 && e[4].slide[0] == 1.0 && e[4].seconds == 4.0);
    assert_int_equal(e[4].need_count, 2);
    assert_string_equal(e[4].needs[1], "s");
    assert_true(e[5].axis[2] == -1.0 && e[5].rpm == -40.0); /* of length one */
    assert_true(e[5].latch && !e[4].latch);
    assert_true(e[6].size[2] == 3.0 && e[6].at[1] == 3.0);
    assert_string_equal(e[6].node, "");
    nook_level_free(level);
}

static void test_names_count_more_than_patterns(void **state)
{
    (void)state;
    nook_level *level =
        must_read("scene = a.glb\n[body crate_*]\nmass = 1\n[body crate_7]\nmass = 2\n[body cr*]\nmass = 3\n"
                  "[plate here]\nnode = slab\nweight = 1\n");
    assert_true(nook_level_find_node(level, "crate_7")->mass == 2.0);
    assert_true(nook_level_find_node(level, "crate_70")->mass == 1.0);
    assert_true(nook_level_find_node(level, "crab")->mass == 3.0);
    assert_null(nook_level_find_node(level, "barrel"));
    assert_string_equal(nook_level_find_node(level, "slab")->name, "here");
    assert_null(nook_level_find_node(level, "here"));
    assert_int_equal(nook_level_find(level, "here")->kind, NOOK_LEVEL_PLATE);
    assert_null(nook_level_find(level, "slab"));
    nook_level_free(level);
}

static void test_patterns_match_beginnings(void **state)
{
    (void)state;
    assert_true(nook_level_name_matches("crate_*", "crate_"));
    assert_true(nook_level_name_matches("crate_*", "crate_large_0"));
    assert_false(nook_level_name_matches("crate_*", "crate"));
    assert_false(nook_level_name_matches("crate_", "crate_0"));
    assert_true(nook_level_name_matches("*", "anything"));
    assert_false(nook_level_name_matches("", "anything"));
}

/* ---- What is wrong ----------------------------------------------------------------------------------------------- */

static void test_lines_at_the_top_that_are_wrong_are_named(void **state)
{
    (void)state;
    must_refuse("title = x\nscene\n", "2", "give name = value, or [kind name]");
    must_refuse("scene = a.glb\nstrat = 0 0 0\n", "2", "no level has a strat; did you mean start?");
    must_refuse("scene = a.glb\nqwertz = 1\n", "2", "no level has a qwertz");
    must_refuse("scene = a.glb\ntitle = a\ntitle = b\n", "3", "title stands there twice");
    must_refuse("scene = a.glb\nstart = 1 2\n", "2", "give three numbers");
    must_refuse("scene = a.glb\nstart = 1 2 3 4\n", "2", "give three numbers");
    must_refuse("scene = a.glb\nstart = 1 b 3\n", "2", "give three numbers");
    must_refuse("scene = a.glb\nstart = 1 nan 3\n", "2", "give three numbers");
    must_refuse("scene = a.glb\nstart = 1 2000000 3\n", "2", "not within");
    must_refuse("scene = a.glb\nlook = 0 91\n", "2", "beyond 90 degrees");
    must_refuse("scene = a.glb\nlook = 0\n", "2", "give two numbers");
    must_refuse("scene = a.glb\nseconds = -1\n", "2", "not within");
    must_refuse("scene = a.glb\nseconds = soon\n", "2", "give a number");
    must_refuse("scene = a.glb\nlibrary = parts\n", "2", "give library = NAME PATH");
    must_refuse("scene = a.glb\nlibrary = a:b c.glb\n", "2", "without a colon");
    must_refuse("scene = a.glb\nlibrary = p a.glb\nlibrary = p b.glb\n", "3", "two libraries of the name p");
    must_refuse("title = no scene\n[goal g]\nat = 0 0 0\nsize = 1 1 1\n", "4", "no scene to stand in");
    must_refuse("", "0", "no scene to stand in");
}

static void test_texts_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    char text[4096], word[2048];
    memset(word, 'a', sizeof word);
    snprintf(text, sizeof text, "title = %.256s\nscene = a.glb\n", word);
    must_refuse(text, "1", "longer than 255 bytes");
    snprintf(text, sizeof text, "scene = a.glb\n[body %.64s]\n", word);
    must_refuse(text, "2", "longer than 63 bytes");
    snprintf(text, sizeof text, "scene = %.1100s\n", word);
    must_refuse(text, "1", "no text or too long");
    snprintf(text, sizeof text, "scene = a.glb\n[fixed x]\nnode = %.64s\n", word);
    must_refuse(text, "3", "longer than 63 bytes");
    must_refuse_bytes("scene = a\0b.glb\n", 16, "1", "no text or too long");
}

static void test_too_many_files_are_refused(void **state)
{
    (void)state;
    char text[1024] = "";
    for (int i = 0; i <= NOOK_LEVEL_FILES_MAX; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "scene = %d.glb\n", i);
    must_refuse(text, "17", "more than 16 files");
}

static void test_headers_of_entities_that_are_wrong_are_named(void **state)
{
    (void)state;
    must_refuse("scene = a.glb\n[body x\n", "2", "give [kind name]");
    must_refuse("scene = a.glb\n[body]\n", "2", "give [kind name]");
    must_refuse("scene = a.glb\n[]\n", "2", "give [kind name]");
    must_refuse("scene = a.glb\n[bdy x]\n", "2", "there is no kind bdy; did you mean body?");
    must_refuse("scene = a.glb\n[body x]\n[fixed x]\n", "3", "x stands there already, in line 2");
}

static void test_lines_of_entities_that_are_wrong_are_named(void **state)
{
    (void)state;
#define BODY "scene = a.glb\n[body x]\n"
    must_refuse(BODY "mas = 1\n", "3", "a body has no mas; did you mean mass?");
    must_refuse(BODY "weight = 1\n", "3", "a body has no weight");
    must_refuse(BODY "title = x\n", "3", "a body has no title");
    must_refuse(BODY "mass = 1\nmass = 2\n", "4", "mass stands there twice");
    must_refuse(BODY "mass = 0\n", "3", "not within");
    must_refuse(BODY "mass = heavy\n", "3", "give a number");
    must_refuse(BODY "restitution = 1.1\n", "3", "not within");
    must_refuse(BODY "shape = bax\n", "3", "there is no shape bax; did you mean box?");
    must_refuse(BODY "shape = mesh\n", "2", "bodies cannot have the shape mesh");
    must_refuse(BODY "at = 1 2\n", "3", "give three numbers");
    must_refuse(BODY "at =\n", "3", "give name = value");
    must_refuse(BODY "latch = yes\n", "3", "a body has no latch");
    must_refuse("scene = a.glb\n[plate p]\nlatch = 1\n", "3", "latch is 1; give yes or no");
#undef BODY
}

static void test_entities_that_lack_something_are_named(void **state)
{
    (void)state;
    must_refuse("scene = a.glb\n[plate p]\n[body x]\n", "2", "the plate p has no weight");
    must_refuse("scene = a.glb\n[shade s]\nreach = 1\n", "2", "the shade s has no visibility");
    must_refuse("scene = a.glb\n[shade s]\nvisibility = 1\n", "2", "the shade s has no reach");
    must_refuse("scene = a.glb\n[spinner s]\nrpm = 1\n", "2", "the spinner s has no axis");
    must_refuse("scene = a.glb\n[spinner s]\nrpm = 1\naxis = 0 0 0\n", "2", "an axis of no length");
    must_refuse("scene = a.glb\n[mover m]\nslide = 1 0 0\n", "2", "the mover m has no seconds");
    must_refuse("scene = a.glb\n[mover m]\nseconds = 1\n", "2", "m goes nowhere");
    must_refuse("scene = a.glb\n[mover m]\nslide = 1 0 0\nseconds = 0\n", "2", "more than 0 seconds");
    must_refuse("scene = a.glb\n[goal g]\nat = 0 0 0\n", "2", "the goal g has no size");
    must_refuse("scene = a.glb\n[goal g]\nsize = 1 1 1\n", "2", "the goal g has no at");
}

static void test_needs_that_cannot_be_are_named(void **state)
{
    (void)state;
#define MOVER "scene = a.glb\n[plate plate_0]\nweight = 1\n[body b]\n[mover m]\nslide = 1 0 0\nseconds = 1\n"
    must_refuse(MOVER "needs = plaet_0\n", "8", "m needs plaet_0, which is not there; did you mean plate_0?");
    must_refuse(MOVER "needs = plate_0 b\n", "8", "m needs b, and a body is never open");
    must_refuse(MOVER "needs = m\n", "8", "m needs itself");
    must_refuse(MOVER "needs = a a a a a a a a a\n", "8", "m needs more than 8");
#undef MOVER
}

static void test_needs_that_go_round_in_a_circle_are_named(void **state)
{
    (void)state;
#define MOVER(name) "[mover " name "]\nslide = 1 0 0\nseconds = 1\n"
    must_refuse("scene = a.glb\n" MOVER("a") "needs = b\n" MOVER("b") "needs = a\n", "5",
                "a needs b, which waits for a");
    must_refuse("scene = a.glb\n[goal g]\nat = 0 0 0\nsize = 1 1 1\nneeds = a\n" MOVER("a") "needs = b\n" MOVER(
                    "b") "needs = c\n" MOVER("c") "needs = b\n",
                "13", "b needs c, which waits for b");
    nook_level_free(must_read("scene = a.glb\n" MOVER("a") "needs = b c\n" MOVER("b") "needs = c\n" MOVER("c")));
#undef MOVER
}

static void test_too_many_entities_are_refused(void **state)
{
    (void)state;
    static char text[NOOK_LEVEL_ENTITIES_MAX * 24];
    size_t size = (size_t)snprintf(text, sizeof text, "scene = a.glb\n");
    for (int i = 0; i < NOOK_LEVEL_ENTITIES_MAX; i++)
        size += (size_t)snprintf(text + size, sizeof text - size, "[body b%d]\n", i);
    nook_level_free(must_read(text));
    snprintf(text + size, sizeof text - size, "[body one_more]\n");
    must_refuse(text, "4098", "more than 4096 entities");
}

static void test_the_mark_of_utf8_is_looked_over(void **state)
{
    (void)state;
    nook_level *level = must_read("\xef\xbb\xbftitle = Stra\xc3\x9f"
                                  "e\nscene = a.glb\n");
    assert_string_equal(level->title, "Stra\xc3\x9f"
                                      "e");
    nook_level_free(level);
}

static void test_stars_stand_only_where_they_can(void **state)
{
    (void)state;
    must_refuse("scene = a.glb\n[body a*b]\n", "2", "a * stands at the end");
    must_refuse("scene = a.glb\n[body a*]\nat = 0 0 0\n", "2", "a * stands at the end");
    must_refuse("scene = a.glb\n[body a]\nnode = b*\n", "2", "a * stands at the end");
    must_refuse("scene = a.glb\n[plate a*]\nweight = 1\n", "2", "a * stands at the end");
    nook_level_free(must_read("scene = a.glb\n[fixed wall*]\n"));
}

static void test_half_a_file_is_refused_wherever_it_is_cut_or_is_a_level(void **state)
{
    (void)state;
    static const char whole[] = "title = t\nscene = a.glb\nstart = 1 2 3\n[plate p]\nweight = 14\n[spinner s]\n"
                                "axis = 0 1 0\nrpm = 5\nneeds = p\n[goal g]\nat = 1 2 3\nsize = 1 1 1\nneeds = s\n";
    nook_log_capture log;
    uint32_t read = 0;
    for (size_t size = 0; size < sizeof whole; size++) {
        nook_level *level;
        const char *path = write_bytes(whole, size);
        nook_log_capture_begin(&log);
        nook_result result = nook_level_read(path, &level);
        nook_log_capture_end();
        assert_true(result == NOOK_OK ? log.count == 0 : result == NOOK_E_FORMAT && log.count == 1);
        assert_true((result == NOOK_OK) == (level != NULL));
        read += result == NOOK_OK;
        nook_level_free(level);
    }
    assert_in_range(read, 10, 90);
}

static void test_files_that_cannot_be_read_are_said(void **state)
{
    (void)state;
    nook_level *level;
    nook_log_capture log;
    char long_path[2048];
    memset(long_path, 'a', sizeof long_path - 1);
    long_path[sizeof long_path - 1] = '\0';
    nook_log_capture_begin(&log);
    assert_int_equal(nook_level_read("nowhere/no.level", &level), NOOK_E_NOT_FOUND);
    assert_null(level);
    assert_int_equal(nook_level_read(long_path, &level), NOOK_E_NOT_FOUND);
    assert_null(level);
    assert_int_equal(nook_level_read("nowhere/no.glb", &level), NOOK_E_NOT_FOUND);
    assert_null(level);
    nook_log_capture_end();
    assert_int_equal(log.errors, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_top_of_a_level_is_read),
        cmocka_unit_test(test_every_kind_of_entity_is_read),
        cmocka_unit_test(test_names_count_more_than_patterns),
        cmocka_unit_test(test_patterns_match_beginnings),
        cmocka_unit_test(test_lines_at_the_top_that_are_wrong_are_named),
        cmocka_unit_test(test_texts_that_do_not_fit_are_refused),
        cmocka_unit_test(test_too_many_files_are_refused),
        cmocka_unit_test(test_headers_of_entities_that_are_wrong_are_named),
        cmocka_unit_test(test_lines_of_entities_that_are_wrong_are_named),
        cmocka_unit_test(test_entities_that_lack_something_are_named),
        cmocka_unit_test(test_needs_that_cannot_be_are_named),
        cmocka_unit_test(test_needs_that_go_round_in_a_circle_are_named),
        cmocka_unit_test(test_too_many_entities_are_refused),
        cmocka_unit_test(test_the_mark_of_utf8_is_looked_over),
        cmocka_unit_test(test_stars_stand_only_where_they_can),
        cmocka_unit_test(test_half_a_file_is_refused_wherever_it_is_cut_or_is_a_level),
        cmocka_unit_test(test_files_that_cannot_be_read_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
