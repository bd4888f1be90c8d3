/* Models, textures and levels, in copies of them, edited while pictures are made. */
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "game/compare/camera.h"
#include "game/live/scene_loading.h"
#include "game/live/scene_reload.h"
#include "game/play/play.h"
#include "modules/measure/picture.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include "tests/support/play_room.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h> /* wants those above first */

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };

typedef uint8_t picture[PIXELS * 3];

typedef struct fixture {
    file_tree tree;
    char path[1024], cache[1024];
    nook_stage stage;
    nook_camera camera;
    nook_scene_reload *reload;
    nook_log_capture log;
} fixture;

static void write_colour(const fixture *self, uint8_t red, uint8_t green, uint8_t blue)
{
    nook_rgb pixels[4 * 4];
    char path[1024];
    for (size_t i = 0; i < NOOK_COUNT(pixels); i++)
        pixels[i] = (nook_rgb){ red, green, blue };
    const nook_picture square = { .pixels = pixels, .width = 4, .height = 4 };
    assert_int_equal(
        nook_picture_write_png(&square, file_tree_path(&self->tree, "textures/colour.png", path, sizeof path)),
        NOOK_OK);
}

/* The crate of the other tests, with a texture in a folder beside it. */
static void write_crate(fixture *self)
{
    file_tree_begin(&self->tree, "model");
    file_tree_copy(&self->tree, test_gpu_root(), "tests/game/data/crate.gltf");
    file_tree_write(&self->tree, "textures/readme.txt", "");
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "\"indices\": 3", "\"indices\": 3, \"material\": 0");
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "\"cameras\": [",
                   "\"images\": [ { \"uri\": \"textures/colour.png\" } ], \"textures\": [ { \"source\": 0 } ],\n"
                   "\"materials\": [ { \"pbrMetallicRoughness\": { \"baseColorTexture\": { \"index\": 0 } } } ],\n"
                   "\"cameras\": [");
    char from[1024];
    file_tree_path(&self->tree, "tests/game/data/crate.gltf", from, sizeof from);
    file_tree_path(&self->tree, "crate.gltf", self->path, sizeof self->path);
    assert_int_equal(rename(from, self->path), 0);
    file_tree_path(&self->tree, "cache", self->cache, sizeof self->cache);
    write_colour(self, 255, 0, 0);
}

static int open_stage(fixture *self, nook_scene *scene)
{
    char label[64];
    const nook_stage_desc desc = { .root = test_gpu_root(),
                                   .scene_path = self->path,
                                   .scene = scene,
                                   .backend = NOOK_BACKEND_OSMESA,
                                   .width = WIDTH,
                                   .height = HEIGHT };
    return nook_stage_open(&desc, &self->stage) != NOOK_OK ||
           nook_stage_fill(&self->stage, &(nook_game_world_desc){ 16, 0.5, self->cache }) != NOOK_OK ||
           nook_camera_choose(self->stage.scene, NULL, 1.5, &self->camera, label, sizeof label) != NOOK_OK;
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    write_crate(self);
    nook_log_capture_begin(&self->log);
    return open_stage(self, NULL) || nook_scene_reload_create(&self->stage, NULL, &self->reload) != NOOK_OK;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_scene_reload_destroy(self->reload);
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

static bool same(const picture a, const picture b)
{
    return memcmp(a, b, sizeof(picture)) == 0;
}

/* Pixels of about this colour. */
static int count_colour(const picture p, int red, int green, int blue)
{
    int count = 0;
    for (size_t i = 0; i < PIXELS; i++)
        count += abs(p[3 * i] - red) < 8 && abs(p[3 * i + 1] - green) < 8 && abs(p[3 * i + 2] - blue) < 8;
    return count;
}

/* Polls as frames would, until a scene waits or one has failed. @return whether one waits */
static bool wait_for_news(fixture *self)
{
    const struct timespec pause = { 0, 2 * 1000 * 1000 };
    double end = nook_clock_ms() + 30000;
    uint32_t failures = nook_scene_reload_status_of(self->reload)->failures;
    while (!nook_scene_reload_poll(self->reload)) {
        if (nook_scene_reload_status_of(self->reload)->failures != failures)
            return false;
        assert_true(nook_clock_ms() < end);
        nanosleep(&pause, NULL);
    }
    return true;
}

static nook_result go_on(void *game, nook_level *level, const nook_scene *scene, nook_game_world *world)
{
    return nook_play_go_on(game, level, scene, world);
}

static void reload(fixture *self, nook_play *play)
{
    if (!wait_for_news(self))
        fail_msg("%s", nook_scene_reload_status_of(self->reload)->error);
    assert_int_equal(nook_scene_reload_swap(self->reload, play ? go_on : NULL, play), NOOK_OK);
    assert_string_equal(nook_scene_reload_status_of(self->reload)->error, "");
}

static void assert_fails(fixture *self, const char *why)
{
    assert_false(wait_for_news(self));
    const char *error = nook_scene_reload_status_of(self->reload)->error;
    if (!strstr(error, why))
        fail_msg("expected '%s' in: %s", why, error);
}

static void test_changed_texture_is_shown(void **state)
{
    fixture *self = *state;
    picture p;
    draw(self, NOOK_VIEW_BASE_COLOUR, p);
    assert_true(count_colour(p, 255, 0, 0) > 20);
    write_colour(self, 0, 255, 0);
    reload(self, NULL);
    draw(self, NOOK_VIEW_BASE_COLOUR, p);
    assert_int_equal(count_colour(p, 255, 0, 0), 0);
    assert_true(count_colour(p, 0, 255, 0) > 20);
    const nook_scene_reload_status *status = nook_scene_reload_status_of(self->reload);
    assert_true(status->reloads == 1 && status->failures == 0 && status->last_ms >= status->swap_ms);
}

static void test_broken_texture_keeps_the_picture_until_it_is_mended(void **state)
{
    fixture *self = *state;
    picture before, after;
    draw(self, NOOK_VIEW_BASE_COLOUR, before);
    file_tree_replace(&self->tree, "textures/colour.png", "this is no picture");
    assert_fails(self, "images[0]");
    draw(self, NOOK_VIEW_BASE_COLOUR, after);
    assert_true(same(before, after));
    write_colour(self, 0, 0, 255);
    reload(self, NULL);
    draw(self, NOOK_VIEW_BASE_COLOUR, after);
    assert_true(count_colour(after, 0, 0, 255) > 20);
}

static void test_changed_model_is_shown_and_darkens_with_a_new_volume(void **state)
{
    fixture *self = *state;
    picture before, after, meanwhile;
    uint32_t count;
    nook_game_world_volumes(self->stage.world, &count);
    assert_int_equal(count, 2);
    draw(self, NOOK_VIEW_VISIBILITY, before);
    file_tree_edit(&self->tree, "crate.gltf", "\"nook_body\": true", "\"nook_body\": false");
    file_tree_edit(&self->tree, "crate.gltf", "    0.3,\n", "    -0.8,\n");
    while (!nook_scene_reload_status_of(self->reload)->loading)
        nook_scene_reload_poll(self->reload);
    draw(self, NOOK_VIEW_VISIBILITY, meanwhile); /* baked in the background: the old ones are in use */
    assert_true(same(before, meanwhile));
    reload(self, NULL);
    draw(self, NOOK_VIEW_VISIBILITY, after);
    assert_false(same(before, after));
    nook_game_world_volumes(self->stage.world, &count);
    assert_int_equal(count, 1); /* all of it stands still now */
    file_tree_edit(&self->tree, "crate.gltf", "\"nook_body\": false", "\"nook_body\": true");
    file_tree_edit(&self->tree, "crate.gltf", "    -0.8,\n", "    0.3,\n");
    reload(self, NULL);
    draw(self, NOOK_VIEW_VISIBILITY, after);
    assert_true(same(before, after));
    assert_true(nook_game_world_volumes(self->stage.world, &count)
                    ->bakes[NOOK_VOLUME_BINARY]
                    .cached); /* what is as it was is not baked again */
}

/* The scene that is shown is the file's, but for one corner of the crate. */
static void test_surfels_are_made_anew_where_a_model_differs_from_the_shown_one(void **state)
{
    fixture *self = *state;
    nook_scene *shown;
    nook_scene_volumes volumes;
    nook_scene_loading *load;
    nook_loaded_scene loaded;
    char why[256];
    assert_int_equal(nook_scene_load(self->path, NULL, &shown), NOOK_OK);
    uint32_t crate = shown->primitives[shown->meshes[1].first_primitive].first_vertex;
    for (int i = 0; i < 3; i++)
        shown->vertices[crate].position[i] *= 0.9f;
    const nook_volumes_desc desc = {
        .resolution = 128, .r_max = 0.5, .cache_dir = self->cache, .kinds = NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL)
    };
    assert_int_equal(nook_volumes_bake(shown, &desc, &volumes), NOOK_OK);
    const nook_scene_loading_desc again = { .path = self->path,
                                            .resolution = desc.resolution,
                                            .r_max = desc.r_max,
                                            .kinds = desc.kinds,
                                            .cache = self->cache,
                                            .shown = shown };
    assert_int_equal(nook_scene_loading_start(&again, &load), NOOK_OK);
    assert_int_equal(nook_scene_loading_finish(load, &loaded, why, sizeof why), NOOK_OK);
    assert_int_equal(loaded.volumes.volume_count, 2);
    int made_in_part = 0;
    for (uint32_t i = 0; i < 2; i++) {
        const nook_bake *bake = &loaded.volumes.volumes[i].bakes[NOOK_VOLUME_SURFEL];
        made_in_part += bake->bricks > 0;
        assert_true(bake->bricks > 0 || bake->cache_hit); /* the floor is as it was */
    }
    assert_int_equal(made_in_part, 1);
    nook_loaded_scene_free(&loaded);
    nook_volumes_free(&volumes);
    nook_scene_destroy(shown);
}

static void test_broken_model_keeps_the_picture_and_says_why(void **state)
{
    fixture *self = *state;
    picture before, after;
    draw(self, NOOK_VIEW_LIT, before);
    file_tree_edit(&self->tree, "crate.gltf", "\"asset\"", "\"asset");
    assert_fails(self, "crate.gltf: ");
    draw(self, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
    file_tree_edit(&self->tree, "crate.gltf", "\"asset", "\"asset\"");
    reload(self, NULL);
    draw(self, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
}

static void test_deleted_model_keeps_the_picture_until_it_is_back(void **state)
{
    fixture *self = *state;
    char away[1100];
    picture out;
    snprintf(away, sizeof away, "%s.away", self->path);
    assert_int_equal(rename(self->path, away), 0);
    assert_fails(self, "no such file");
    draw(self, NOOK_VIEW_LIT, out);
    assert_int_equal(rename(away, self->path), 0);
    reload(self, NULL);
}

static void test_other_files_beside_it_are_nothing(void **state)
{
    fixture *self = *state;
    file_tree_write(&self->tree, "notes.txt", "x");
    file_tree_write(&self->tree, "textures/other.png", "x");
    double end = nook_clock_ms() + 200;
    while (nook_clock_ms() < end) {
        assert_false(nook_scene_reload_poll(self->reload));
        assert_false(nook_scene_reload_status_of(self->reload)->loading);
    }
}

static void test_texture_in_a_folder_that_was_not_watched_is_followed(void **state)
{
    fixture *self = *state;
    picture p;
    file_tree_write(&self->tree, "others/readme.txt", "");
    char from[1024], to[1024];
    file_tree_path(&self->tree, "textures/colour.png", from, sizeof from);
    file_tree_path(&self->tree, "others/colour.png", to, sizeof to);
    assert_int_equal(rename(from, to), 0);
    file_tree_edit(&self->tree, "crate.gltf", "textures/colour.png", "others/colour.png");
    reload(self, NULL);
    write_colour(self, 255, 255, 0);
    assert_int_equal(rename(from, to), 0);
    reload(self, NULL);
    draw(self, NOOK_VIEW_BASE_COLOUR, p);
    while (count_colour(p, 255, 255, 0) == 0) { /* the new folder counts as changed once */
        reload(self, NULL);
        draw(self, NOOK_VIEW_BASE_COLOUR, p);
    }
}

/* What a process can leak. */
typedef struct holdings {
    long resident_kb;
    int open_files, objects;
    uint64_t volume_bytes;
} holdings;

static holdings count_held(const fixture *self)
{
    const nook_gl *gl = self->stage.gpu->gl;
    nook_ao_statistics statistics;
    nook_ao_get_statistics(self->stage.ao, &statistics);
    holdings held = { file_tree_resident_kb(), file_tree_open_files(), 0, statistics.volume_bytes };
    for (GLuint name = 1; name < 100000; name++)
        held.objects += gl->IsTexture(name) + gl->IsBuffer(name) + gl->IsProgram(name);
    return held;
}

static void assert_holds_no_more(const fixture *self, const holdings *before)
{
    holdings now = count_held(self);
    assert_int_equal(now.open_files, before->open_files);
    assert_int_equal(now.objects, before->objects);
    assert_true(now.volume_bytes == before->volume_bytes);
    if (now.resident_kb - before->resident_kb > 2048)
        fail_msg("%ld kB more", now.resident_kb - before->resident_kb);
}

static void test_saves_in_a_row_leak_nothing(void **state)
{
    enum { SAVES = 20, WARM = 5 };
    fixture *self = *state;
    holdings held = { 0 };
    picture p;
    for (int i = 0; i < SAVES; i++) {
        write_colour(self, (uint8_t)(i % 2 ? 255 : 0), 0, 0);
        reload(self, NULL);
        draw(self, NOOK_VIEW_LIT, p);
        if (i == WARM)
            held = count_held(self);
    }
    assert_holds_no_more(self, &held);
}

/* Without the files' time to settle, which would take minutes: what a reload does after it. */
static void test_a_thousand_exchanges_leak_nothing(void **state)
{
    enum { EXCHANGES = 1000, WARM = 100 };
    fixture *self = *state;
    const nook_scene_loading_desc desc = { .path = self->path, .resolution = 16, .r_max = 0.5, .cache = self->cache };
    char why[256];
    holdings held = { 0 };
    picture p;
    for (int i = 0; i < EXCHANGES; i++) {
        nook_scene_loading *loading;
        nook_loaded_scene loaded;
        nook_stage_scene made, before;
        assert_int_equal(nook_scene_loading_start(&desc, &loading), NOOK_OK);
        assert_int_equal(nook_scene_loading_finish(loading, &loaded, why, sizeof why), NOOK_OK);
        assert_int_equal(nook_stage_scene_upload(&self->stage, loaded.scene, &loaded.volumes, &made), NOOK_OK);
        before = nook_stage_exchange_scene(&self->stage, &made);
        nook_stage_scene_destroy(&before);
        if (i % 50 == 0)
            draw(self, NOOK_VIEW_LIT, p);
        if (i == WARM)
            held = count_held(self);
    }
    draw(self, NOOK_VIEW_LIT, p);
    assert_holds_no_more(self, &held);
}

static void test_destroying_waits_for_the_background(void **state)
{
    fixture *self = *state;
    write_colour(self, 1, 2, 3);
    while (!nook_scene_reload_status_of(self->reload)->loading)
        nook_scene_reload_poll(self->reload);
    nook_scene_reload_destroy(self->reload);
    assert_int_equal(nook_scene_reload_create(&self->stage, NULL, &self->reload), NOOK_OK);
    write_colour(self, 1, 2, 4);
    while (!nook_scene_reload_status_of(self->reload)->loading)
        nook_scene_reload_poll(self->reload);
    nook_scene_reload_wait(self->reload);
    assert_false(nook_scene_reload_status_of(self->reload)->loading);
    reload(self, NULL); /* it begins again */
}

static void test_a_scene_with_a_live_volume_is_reloaded_without_a_bake(void **state)
{
    fixture *self = *state;
    picture before, after;
    self->stage.live_scene = true;
    assert_int_equal(nook_stage_fill(&self->stage, &(nook_game_world_desc){ 16, 0.5, self->cache }), NOOK_OK);
    draw(self, NOOK_VIEW_VISIBILITY, before);
    file_tree_remove(&self->tree, "cache");
    write_colour(self, 0, 255, 0);
    reload(self, NULL);
    assert_int_not_equal(access(self->cache, F_OK), 0);
    assert_true(nook_game_world_live_scene(self->stage.world)->volume.id > 0);
    draw(self, NOOK_VIEW_VISIBILITY, after);
    assert_true(same(before, after));
}

/* ---- played -------------------------------------------------------------------------------------------------------- */

#define CRATES PLAY_BOX("crate_0", 0, 0.2, -2, 0.4, 0.4, 0.4, PLAY_BODY(15))
#define STILL ", 'extras': { 'nook_body': false }"
#define MORE_CRATES CRATES PLAY_BOX("crate_1", 1, 0.2, -2, 0.4, 0.4, 0.4, PLAY_BODY(15))

typedef struct played {
    fixture f;
    nook_play play;
    char level[1024];
} played;

static void write_level(const played *self, const char *title)
{
    char text[256];
    int size = snprintf(text, sizeof text, "title = %s\nscene = played.glb\nstart = 0 0 2\n", title);
    assert_int_equal(nook_file_write(self->level, text, (size_t)size), NOOK_OK);
}

static int setup_played(void **state)
{
    played *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    const char *scene = play_room_write_scene("played.glb", CRATES);
    snprintf(self->level, sizeof self->level, "%.*splayed.level", (int)(nook_path_name(scene) - scene), scene);
    snprintf(self->f.path, sizeof self->f.path, "%s", self->level);
    write_level(self, "First");
    nook_log_capture_begin(&self->f.log);
    const nook_play_desc desc = { .root = test_gpu_root(), .level = self->level };
    return nook_play_open(&desc, &self->play) != NOOK_OK || open_stage(&self->f, nook_play_take_scene(&self->play)) ||
           nook_play_begin(&self->play, self->f.stage.scene, self->f.stage.world) != NOOK_OK ||
           nook_scene_reload_create(&self->f.stage, self->level, &self->f.reload) != NOOK_OK;
}

static int teardown_played(void **state)
{
    played *self = *state;
    nook_scene_reload_destroy(self->f.reload);
    nook_play_close(&self->play);
    nook_stage_close(&self->f.stage);
    nook_log_capture_end();
    free(self);
    return 0;
}

static void tick(played *self, int count)
{
    const nook_play_input nothing = { .buttons = 0 };
    for (int i = 0; i < count; i++)
        assert_int_equal(nook_play_tick(&self->play, &nothing), NOOK_OK);
}

static void test_a_game_goes_on_in_a_changed_model(void **state)
{
    played *self = *state;
    double middle[3];
    picture p;
    tick(self, 30);
    play_room_write_scene("played.glb", MORE_CRATES);
    reload(&self->f, &self->play);
    assert_true(nook_session_look(self->play.session).ticks == 30);
    tick(self, 30);
    nook_session_place(self->play.session, 1.0);
    draw(&self->f, NOOK_VIEW_LIT, p);
    assert_true(nook_session_middle_of(self->play.session, "crate_1", middle));
    assert_string_equal(self->play.level->title, "First");
}

static void test_a_game_goes_on_in_a_changed_level(void **state)
{
    played *self = *state;
    picture p;
    tick(self, 30);
    write_level(self, "Second");
    reload(&self->f, &self->play);
    assert_string_equal(self->play.level->title, "Second");
    assert_true(nook_session_look(self->play.session).ticks == 30);
    tick(self, 3);
    draw(&self->f, NOOK_VIEW_LIT, p);
}

static void test_a_level_that_is_wrong_is_refused_and_the_old_one_goes_on(void **state)
{
    played *self = *state;
    picture before, after;
    tick(self, 30);
    nook_session_place(self->play.session, 1.0);
    draw(&self->f, NOOK_VIEW_LIT, before);
    uint64_t hash = nook_session_hash(self->play.session);
    write_level(self, "Second\n[body nothing]");
    assert_fails(&self->f, "played.level:");
    draw(&self->f, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
    assert_true(nook_session_hash(self->play.session) == hash);
    write_level(self, "Third");
    reload(&self->f, &self->play);
    assert_string_equal(self->play.level->title, "Third");
}

static void test_more_bodies_than_there_is_room_for_are_refused(void **state)
{
    played *self = *state;
    picture before, after;
    draw(&self->f, NOOK_VIEW_LIT, before);
    self->f.stage.occluder_max = 2;
    play_room_write_scene("played.glb", MORE_CRATES);
    assert_true(wait_for_news(&self->f));
    assert_int_equal(nook_scene_reload_swap(self->f.reload, go_on, &self->play), NOOK_E_RANGE);
    assert_non_null(strstr(nook_scene_reload_status_of(self->f.reload)->error, "3 bodies, there is room for 2"));
    draw(&self->f, NOOK_VIEW_LIT, after);
    assert_true(same(before, after));
    assert_false(nook_scene_reload_poll(self->f.reload)); /* not tried again until it changes */
}

static uint32_t count_volumes(const played *self)
{
    uint32_t count;
    nook_game_world_volumes(self->f.stage.world, &count);
    return count;
}

/* A post in a corner of the floor: apart, both have less air in their volumes. */
static void test_volumes_are_planned_anew_when_their_visibilities_are_joined_otherwise(void **state)
{
    played *self = *state;
    self->f.stage.plan = nook_plan_params_initial();
    self->f.stage.plan.mode = NOOK_PLAN_MEASURED;
    self->f.stage.plan.split = 0.0f;
    nook_scene_reload_plan_for(self->f.reload, true);
    play_room_write_scene("played.glb", CRATES PLAY_BOX("post", 15, 5, 15, 0.5, 10, 0.5, STILL));
    reload(&self->f, &self->play);
    uint32_t together = count_volumes(self);
    nook_scene_reload_plan_for(self->f.reload, false);
    reload(&self->f, &self->play);
    assert_true(count_volumes(self) > together);
    nook_scene_reload_plan_for(self->f.reload, true);
    reload(&self->f, &self->play);
    assert_int_equal(count_volumes(self), together);
    nook_scene_reload_plan_for(self->f.reload, true);
    assert_false(nook_scene_reload_poll(self->f.reload) || nook_scene_reload_status_of(self->f.reload)->loading);
    self->f.stage.plan.mode = NOOK_PLAN_ON; /* what is proven holds for both */
    nook_scene_reload_plan_for(self->f.reload, false);
    assert_false(nook_scene_reload_poll(self->f.reload) || nook_scene_reload_status_of(self->f.reload)->loading);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
#define PLAYED(name) cmocka_unit_test_setup_teardown(name, setup_played, teardown_played)
    const struct CMUnitTest tests[] = {
        TEST(test_changed_texture_is_shown),
        TEST(test_broken_texture_keeps_the_picture_until_it_is_mended),
        TEST(test_changed_model_is_shown_and_darkens_with_a_new_volume),
        TEST(test_surfels_are_made_anew_where_a_model_differs_from_the_shown_one),
        TEST(test_broken_model_keeps_the_picture_and_says_why),
        TEST(test_deleted_model_keeps_the_picture_until_it_is_back),
        TEST(test_other_files_beside_it_are_nothing),
        TEST(test_texture_in_a_folder_that_was_not_watched_is_followed),
        TEST(test_saves_in_a_row_leak_nothing),
        TEST(test_a_thousand_exchanges_leak_nothing),
        TEST(test_destroying_waits_for_the_background),
        TEST(test_a_scene_with_a_live_volume_is_reloaded_without_a_bake),
        PLAYED(test_a_game_goes_on_in_a_changed_model),
        PLAYED(test_a_game_goes_on_in_a_changed_level),
        PLAYED(test_a_level_that_is_wrong_is_refused_and_the_old_one_goes_on),
        PLAYED(test_more_bodies_than_there_is_room_for_are_refused),
        PLAYED(test_volumes_are_planned_anew_when_their_visibilities_are_joined_otherwise),
    };
    return cmocka_run_group_tests_name("scenes reloaded in a stage", tests, NULL, NULL);
}
