/* The program's own shaders, in a copy of them, edited while pictures are made. */
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "game/compare/camera.h"
#include "game/live/live.h"
#include "game/live/shader_reload.h"
#include "game/stage.h"
#include "game/techniques.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h> /* wants those above first */

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };

typedef uint8_t picture[PIXELS * 3];

typedef struct fixture {
    file_tree tree;
    nook_stage stage;
    nook_camera camera;
    nook_shader_reload *reload;
    nook_log_capture log;
} fixture;

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    char scene[4096], label[64];
    if (!self)
        return -1;
    *state = self;
    file_tree_begin(&self->tree, "root");
    file_tree_copy(&self->tree, test_gpu_root(), "shaders");
    file_tree_copy(&self->tree, test_gpu_root(), "modules");
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", test_gpu_root());
    const nook_stage_desc desc = {
        .root = self->tree.root, .scene_path = scene, .backend = NOOK_BACKEND_OSMESA, .width = WIDTH, .height = HEIGHT
    };
    nook_log_capture_begin(&self->log);
    return nook_stage_open(&desc, &self->stage) != NOOK_OK ||
           nook_stage_fill(&self->stage, &(nook_game_world_desc){ 16, 0.5, NULL }) != NOOK_OK ||
           nook_camera_choose(self->stage.scene, NULL, 1.5, &self->camera, label, sizeof label) != NOOK_OK ||
           nook_ao_set_technique(self->stage.ao, "volume") != NOOK_OK ||
           nook_shader_reload_create(self->stage.gpu, &self->reload) != NOOK_OK;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_shader_reload_destroy(self->reload);
    nook_stage_close(&self->stage);
    nook_log_capture_end();
    free(self);
    return 0;
}

static void draw(fixture *self, nook_view view, picture out)
{
    assert_int_equal(nook_stage_begin(&self->stage, &self->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&self->stage), NOOK_OK);
    assert_int_equal(nook_stage_finish(&self->stage, true, view), NOOK_OK);
    nook_renderer_read(self->stage.renderer, out);
}

/* Polls as frames would, until there is something new to draw. */
static const nook_shader_status *wait_for_news(fixture *self)
{
    const struct timespec pause = { 0, 5 * 1000 * 1000 };
    double end = nook_clock_ms() + 20000;
    while (!nook_shader_reload_poll(self->reload)) {
        assert_true(nook_clock_ms() < end);
        nanosleep(&pause, NULL);
    }
    return nook_shader_reload_status(self->reload);
}

static bool same(const picture a, const picture b)
{
    return memcmp(a, b, sizeof(picture)) == 0;
}

static void test_every_shader_of_ours_can_be_reloaded_and_pictures_stay(void **state)
{
    fixture *self = *state;
    picture before, after;
    nook_shader_report report;
    static const char *const names[] = { "volume", "ssao", "hsao", "hbao", "gtao", "hao" };
    for (size_t i = 0; i < NOOK_COUNT(names); i++) {
        assert_int_equal(nook_ao_set_technique(self->stage.ao, names[i]), NOOK_OK);
        draw(self, NOOK_VIEW_LIT, before);
        nook_gpu_reload_shaders(self->stage.gpu, NULL, 0, &report);
        assert_string_equal(report.text, "");
        assert_true(report.reloaded >= 9);
        draw(self, NOOK_VIEW_LIT, after);
        assert_true(same(before, after));
    }
}

static void test_saved_shader_is_seen(void **state)
{
    fixture *self = *state;
    picture out;
    draw(self, NOOK_VIEW_LIT, out);
    assert_false(nook_shader_reload_poll(self->reload));
    file_tree_edit(&self->tree, "shaders/render/tone.glsl", "vec3 srgb_encode(vec3 c)\n{",
                   "vec3 srgb_encode(vec3 c)\n{\n    return vec3(1.0, 0.0, 1.0);");
    const nook_shader_status *status = wait_for_news(self);
    assert_string_equal(status->error, "");
    assert_true(status->reloads >= 1);
    assert_int_equal(status->failures, 0);
    assert_true(status->last_ms >= status->building_ms && status->building_ms > 0.0);
    draw(self, NOOK_VIEW_LIT, out);
    for (size_t i = 0; i < PIXELS; i++)
        assert_true(out[3 * i] == 255 && out[3 * i + 1] == 0 && out[3 * i + 2] == 255);
}

static void test_what_is_saved_before_a_picture_is_in_that_picture(void **state)
{
    fixture *self = *state;
    picture before, after;
    draw(self, NOOK_VIEW_LIT, before);
    file_tree_edit(&self->tree, "shaders/render/tone.glsl", "vec3 srgb_encode(vec3 c)\n{",
                   "vec3 srgb_encode(vec3 c)\n{\n    return vec3(1.0, 0.0, 1.0);");
    assert_true(nook_shader_reload_poll(self->reload));
    draw(self, NOOK_VIEW_LIT, after);
    assert_false(same(before, after));
}

static void test_a_picture_that_stands_and_is_traced_no_more_is_traced_by_a_reloaded_shader(void **state)
{
    fixture *self = *state;
    nook_ao_statistics statistics;
    picture before, after;
    assert_int_equal(nook_ao_set_param(self->stage.ao, "ao.accumulate", 2.0), NOOK_OK);
    for (int i = 0; i < 3; i++)
        draw(self, NOOK_VIEW_LIT, before);
    nook_ao_get_statistics(self->stage.ao, &statistics);
    assert_int_equal(statistics.traced, 0);
    file_tree_edit(&self->tree, "shaders/ao/volume_main.glsl", "bounded(result)", "bounded(0.25 * result)");
    wait_for_news(self);
    draw(self, NOOK_VIEW_LIT, after);
    assert_false(same(before, after));
    nook_ao_get_statistics(self->stage.ao, &statistics);
    assert_true(statistics.traced > 0);
}

static void test_broken_include_keeps_the_picture_and_says_where_until_it_is_mended(void **state)
{
    fixture *self = *state;
    picture before, after;
    draw(self, NOOK_VIEW_LIT, before);
    file_tree_edit(&self->tree, "shaders/ao/falloff.glsl", "float falloff(", "float no_such_type x;\nfloat falloff(");
    const nook_shader_status *status = wait_for_news(self);
    assert_non_null(strstr(status->error, "shaders/ao/falloff.glsl:"));
    assert_true(status->failed >= 1);
    assert_int_equal(status->failures, 1);
    assert_int_equal(status->reloads, 0);
    draw(self, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
    file_tree_edit(&self->tree, "shaders/ao/falloff.glsl", "float no_such_type x;\n", "");
    status = wait_for_news(self);
    assert_string_equal(status->error, "");
    assert_int_equal(status->failed, 0);
    draw(self, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
}

static void test_shadow_map_that_was_kept_is_drawn_anew_by_a_reloaded_shader(void **state)
{
    fixture *self = *state;
    picture before, after;
    draw(self, NOOK_VIEW_SHADOW_MAP, before);
    file_tree_edit(&self->tree, "shaders/render/shadow.vert.glsl", "view_from_mesh * vec4(position, 1.0)",
                   "view_from_mesh * vec4(position, 1.0) + vec4(0.0, 0.0, 0.1, 0.0)");
    wait_for_news(self);
    draw(self, NOOK_VIEW_SHADOW_MAP, after);
    assert_false(same(before, after));
}

static void test_technique_whose_shader_never_was_good_works_once_it_is_mended(void **state)
{
    fixture *self = *state;
    picture out;
    file_tree_edit(&self->tree, "shaders/ao/ssao.comp.glsl", "} params;", "} params");
    nook_shader_reload_poll(self->reload);
    assert_int_equal(nook_ao_set_technique(self->stage.ao, "ssao"), NOOK_OK);
    assert_int_equal(nook_stage_begin(&self->stage, &self->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&self->stage), NOOK_E_DEVICE);
    const nook_shader_status *status = wait_for_news(self);
    assert_non_null(strstr(status->error, "shaders/ao/ssao.comp.glsl:"));
    int lines = self->log.count;
    assert_int_equal(nook_stage_occlude(&self->stage), NOOK_E_DEVICE); /* frame after frame, said once */
    assert_int_equal(self->log.count, lines);
    file_tree_edit(&self->tree, "shaders/ao/ssao.comp.glsl", "} params", "} params;");
    while (nook_shader_reload_status(self->reload)->failed > 0)
        wait_for_news(self);
    draw(self, NOOK_VIEW_LIT, out);
}

static void test_view_whose_shaders_do_not_build_goes_without_them_where_they_may_be_mended(void **state)
{
    fixture *self = *state;
    nook_live_desc desc = { .stage = &self->stage, .shaders_reload = true };
    const nook_setting ssao = nook_setting_initial(nook_technique_find("ssao"));
    nook_live *live;
    picture open, broken, mended;
    assert_int_equal(nook_live_create(&desc, &live), NOOK_OK);
    nook_live_state(live)->views[0].open = true;
    assert_int_equal(nook_live_draw(live, &self->camera), NOOK_OK);
    nook_renderer_read(self->stage.renderer, open);
    file_tree_edit(&self->tree, "shaders/ao/ssao.comp.glsl", "} params;", "} params");
    nook_setting_print(&ssao, nook_live_state(live)->views[0].setting);
    nook_live_state(live)->views[0].open = false;
    assert_int_equal(nook_live_draw(live, &self->camera), NOOK_OK);
    nook_renderer_read(self->stage.renderer, broken);
    assert_true(same(open, broken));
    nook_live_destroy(live);
    desc.shaders_reload = false;
    assert_int_equal(nook_live_create(&desc, &live), NOOK_OK);
    nook_setting_print(&ssao, nook_live_state(live)->views[0].setting);
    assert_int_equal(nook_live_draw(live, &self->camera), NOOK_E_DEVICE);
    file_tree_edit(&self->tree, "shaders/ao/ssao.comp.glsl", "} params", "} params;");
    nook_shader_reload_poll(self->reload);
    while (nook_shader_reload_status(self->reload)->failed > 0)
        wait_for_news(self);
    nook_live_suspend(live);
    assert_int_equal(nook_live_draw(live, &self->camera), NOOK_OK);
    nook_renderer_read(self->stage.renderer, mended);
    assert_false(same(open, mended));
    nook_live_destroy(live);
}

static void test_params_with_a_row_more_are_refused_by_the_running_code(void **state)
{
    fixture *self = *state;
    picture before, after;
    draw(self, NOOK_VIEW_LIT, before);
    file_tree_edit(&self->tree, "modules/ao_volume/params.def", "NOOK_INT(rays,",
                   "NOOK_INT(fresh, 1, 0, 1, NOOK_UNIT_NONE, a row that the code does not have)\nNOOK_INT(rays,");
    const nook_shader_status *status = wait_for_news(self);
    assert_non_null(strstr(status->error, "modules/ao_volume/params.def: "));
    assert_non_null(strstr(status->error, "./nook watch"));
    draw(self, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
}

static void test_many_saves_leak_nothing(void **state)
{
    enum { SAVES = 40, WARM = 10 };
    fixture *self = *state;
    picture out;
    long resident = 0;
    draw(self, NOOK_VIEW_LIT, out);
    int open_files = file_tree_open_files();
    for (int i = 0; i < SAVES; i++) {
        if (i % 2 == 0)
            file_tree_edit(&self->tree, "shaders/render/view.frag.glsl", "void main()", "void main(");
        else
            file_tree_edit(&self->tree, "shaders/render/view.frag.glsl", "void main(", "void main()");
        wait_for_news(self);
        if (i == WARM)
            resident = file_tree_resident_kb();
    }
    assert_int_equal(file_tree_open_files(), open_files);
    assert_true(file_tree_resident_kb() - resident < 2048);
    assert_int_equal(nook_shader_reload_status(self->reload)->reloads, SAVES / 2);
}

static void test_root_without_shaders_is_refused(void **state)
{
    fixture *self = *state;
    nook_shader_reload *other = self->reload;
    file_tree_remove(&self->tree, "shaders");
    assert_int_equal(nook_shader_reload_create(self->stage.gpu, &other), NOOK_E_NOT_FOUND);
    assert_null(other);
    assert_non_null(strstr(self->log.text, "shaders: no such folder to watch"));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_every_shader_of_ours_can_be_reloaded_and_pictures_stay),
        TEST(test_saved_shader_is_seen),
        TEST(test_what_is_saved_before_a_picture_is_in_that_picture),
        TEST(test_a_picture_that_stands_and_is_traced_no_more_is_traced_by_a_reloaded_shader),
        TEST(test_broken_include_keeps_the_picture_and_says_where_until_it_is_mended),
        TEST(test_shadow_map_that_was_kept_is_drawn_anew_by_a_reloaded_shader),
        TEST(test_technique_whose_shader_never_was_good_works_once_it_is_mended),
        TEST(test_view_whose_shaders_do_not_build_goes_without_them_where_they_may_be_mended),
        TEST(test_params_with_a_row_more_are_refused_by_the_running_code),
        TEST(test_many_saves_leak_nothing),
        TEST(test_root_without_shaders_is_refused),
    };
    return cmocka_run_group_tests_name("shaders reloaded in a stage", tests, NULL, NULL);
}
