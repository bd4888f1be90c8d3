/* A stage whose volumes are streamed from the cache: what it shows, and a model that is saved meanwhile. */
#include "engine/core/clock.h"
#include "game/compare/camera.h"
#include "game/live/scene_reload.h"
#include "game/stage.h"
#include "game/stream_volumes.h"
#include "modules/ao/residency.h"
#include "tests/support/file_tree.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 32, RESOLUTION = 64 };

typedef uint8_t picture[WIDTH * HEIGHT * 3];

typedef struct fixture {
    file_tree tree;
    char path[1024], cache[1024];
    const char *kind; /* of volumes; NULL: as it is at first */
    nook_stage stage;
    nook_camera camera;
    nook_log_capture log;
} fixture;

static void open_stage(fixture *self, double budget)
{
    char label[64];
    const nook_stage_desc desc = { .root = test_gpu_root(),
                                   .scene_path = self->path,
                                   .backend = NOOK_BACKEND_OSMESA,
                                   .width = WIDTH,
                                   .height = HEIGHT };
    assert_int_equal(nook_stage_open(&desc, &self->stage), NOOK_OK);
    if (self->kind)
        assert_int_equal(nook_ao_parse_param(self->stage.ao, "volume.kind", self->kind), NOOK_OK);
    self->stage.stream_params = nook_stream_params_initial();
    self->stage.stream_params.budget = (float)budget;
    assert_int_equal(nook_stage_fill(&self->stage, &(nook_game_world_desc){ RESOLUTION, 0.5, self->cache }), NOOK_OK);
    assert_int_equal(nook_camera_choose(self->stage.scene, NULL, 1.5, &self->camera, label, sizeof label), NOOK_OK);
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    file_tree_begin(&self->tree, "streamed");
    file_tree_copy(&self->tree, test_gpu_root(), "tests/game/data/crate.gltf");
    file_tree_path(&self->tree, "tests/game/data/crate.gltf", self->path, sizeof self->path);
    file_tree_path(&self->tree, "cache", self->cache, sizeof self->cache);
    nook_log_capture_begin(&self->log);
    return 0;
}

static int teardown(void **state)
{
    fixture *self = *state;
    nook_stage_close(&self->stage);
    nook_log_capture_end();
    free(self);
    return 0;
}

static void draw(fixture *self, picture out)
{
    assert_int_equal(nook_stage_begin(&self->stage, &self->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(&self->stage), NOOK_OK);
    assert_int_equal(nook_stage_finish(&self->stage, true, NOOK_VIEW_VISIBILITY), NOOK_OK);
    nook_renderer_read(self->stage.renderer, out);
}

/* Draws until nothing comes any more. */
static void settle(fixture *self, picture out)
{
    const struct timespec pause = { 0, 1000 * 1000 };
    double end = nook_clock_ms() + 60000.0;
    do {
        draw(self, out);
        assert_true(nook_clock_ms() < end);
        nanosleep(&pause, NULL);
    } while (!nook_stream_is_settled(self->stage.stream));
    draw(self, out);
}

static void test_a_streamed_scene_becomes_the_picture_of_one_that_is_not(void **state)
{
    fixture *self = *state;
    picture all, streamed;
    char line[160];
    open_stage(self, 0.0);
    assert_null(self->stage.stream);
    draw(self, all);
    nook_stage_close(&self->stage);
    open_stage(self, 64.0);
    assert_non_null(self->stage.stream);
    settle(self, streamed);
    assert_memory_equal(all, streamed, sizeof all);
    assert_non_null(strstr(nook_stream_print(self->stage.stream, line, sizeof line), "of 64.00 MiB, 2 of 2 there"));
}

static void test_a_scene_with_little_memory_shows_coarser_volumes(void **state)
{
    fixture *self = *state;
    picture streamed;
    uint32_t count;
    nook_stream_status status;
    open_stage(self, 0.0);
    draw(self, streamed);
    uint64_t bytes = 0;
    const nook_world_volume *volumes = nook_game_world_volumes(self->stage.world, &count);
    for (uint32_t i = 0; i < count; i++)
        bytes += nook_world_volume_sum(&volumes[i], NOOK_WORLD_EVERY_KIND).bytes;
    nook_stage_close(&self->stage);
    double budget = (double)bytes / (1024.0 * 1024.0) * 0.75;
    open_stage(self, budget);
    settle(self, streamed);
    nook_stream_get_status(self->stage.stream, &status);
    assert_true(status.memory <= (uint64_t)(budget * 1024.0 * 1024.0));
    assert_int_equal(status.resident, 2);
    assert_true(status.resident_bytes < bytes);
}

static void exchange(fixture *self, nook_scene_reload *reload)
{
    const struct timespec pause = { 0, 1000 * 1000 };
    double end = nook_clock_ms() + 60000.0;
    picture seen;
    while (!nook_scene_reload_poll(reload)) {
        draw(self, seen);
        assert_true(nook_clock_ms() < end);
        nanosleep(&pause, NULL);
    }
    assert_int_equal(nook_scene_reload_swap(reload, NULL, NULL), NOOK_OK);
}

static void test_a_model_that_is_saved_is_exchanged_while_volumes_stream(void **state)
{
    fixture *self = *state;
    picture before, after, fresh;
    nook_scene_reload *reload;
    nook_stream_status status;
    open_stage(self, 64.0);
    assert_int_equal(nook_scene_reload_create(&self->stage, NULL, &reload), NOOK_OK);
    settle(self, before);
    nook_stream_get_status(self->stage.stream, &status);
    uint64_t loads = status.loads;
    /* Nothing that has a volume is another: the same files, which are there. */
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "    0.3,\n", "    -0.8,\n");
    exchange(self, reload);
    settle(self, after);
    nook_stream_get_status(self->stage.stream, &status);
    assert_true(status.loads == loads);
    assert_int_equal(status.volumes, 2);
    assert_memory_not_equal(before, after, sizeof before);
    /* What stands still is another mesh now. */
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "\"nook_body\": true", "\"nook_body\": false");
    exchange(self, reload);
    settle(self, after);
    nook_stream_get_status(self->stage.stream, &status);
    assert_true(status.loads > loads);
    assert_int_equal(status.volumes, 1);
    nook_scene_reload_destroy(reload);
    nook_stage_close(&self->stage);
    open_stage(self, 0.0);
    draw(self, fresh);
    uint32_t different = 0;
    for (size_t i = 0; i < sizeof fresh; i++)
        different += abs(fresh[i] - after[i]) > 2; /* its place in the atlas is another: texture coordinates round */
    assert_true(different * 50 < sizeof fresh);
}

enum { FIELD_SIDE = 12, FIELD_SAMPLES = FIELD_SIDE * FIELD_SIDE * FIELD_SIDE };

/* A field of so many samples along x, and FIELD_SIDE along the others. */
static void write_field(fixture *self, int width)
{
    static char text[256 + 8 * FIELD_SAMPLES];
    int head = snprintf(text, 256, "NRRD0004\ntype: uchar\ndimension: 3\nsizes: %d %d %d\nencoding: raw\n\n", width,
                        FIELD_SIDE, FIELD_SIDE);
    size_t samples = (size_t)width * FIELD_SIDE * FIELD_SIDE;
    memset(text + head, '@', samples);
    text[(size_t)head + samples] = '\0';
    file_tree_write(&self->tree, "tests/game/data/field.nrrd", text);
}

/* A scalar field of 1.2 m, which the crate stands in. */
static void add_field(fixture *self)
{
    write_field(self, FIELD_SIDE);
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "    2\n   ]", "    2, 3\n   ]");
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "    0.945\n   ]\n  }",
                   "    0.945\n   ]\n  },\n  { \"name\": \"field\", \"scale\": [ 0.1, 0.1, 0.1 ], \"extras\": {"
                   " \"nook_density\": { \"file\": \"field.nrrd\", \"window\": [ 0, 128 ], \"length\": 10 } } }");
}

static bool field_is_there(const fixture *self)
{
    uint32_t count, i = 0;
    const nook_world_volume *volumes = nook_game_world_volumes(self->stage.world, &count);
    while (i < count && strcmp(volumes[i].name, "field") != 0)
        i++;
    assert_true(i < count);
    return nook_ao_has_volume(self->stage.ao, volumes[i].occluder.volume, NOOK_VOLUME_DENSITY);
}

static void set_budget(fixture *self, double bytes)
{
    nook_stream_params params = *nook_stream_params_of(self->stage.stream);
    params.budget = (float)(bytes / (1024.0 * 1024.0));
    assert_int_equal(nook_stream_set_params(self->stage.stream, &params), NOOK_OK);
}

static nook_stream_status settled_with(fixture *self, double bytes)
{
    picture seen;
    nook_stream_status status;
    set_budget(self, bytes);
    settle(self, seen);
    nook_stream_get_status(self->stage.stream, &status);
    return status;
}

/* With a field of so many samples along x, and room for all. @return bytes of all */
static uint64_t open_with_field(fixture *self, int width)
{
    add_field(self);
    write_field(self, width);
    self->kind = "density";
    open_stage(self, 64.0);
    return settled_with(self, 64.0 * 1024.0 * 1024.0).memory;
}

static void test_a_scalar_field_stays_whatever_the_budget_leaves_of_volumes(void **state)
{
    fixture *self = *state;
    picture seen;
    nook_scene_reload *reload;
    nook_stream_status status;
    const uint64_t bytes = open_with_field(self, FIELD_SIDE);
    assert_true(field_is_there(self));
    for (int part = 2; part <= 3; part++) {
        set_budget(self, (double)bytes / part);
        settle(self, seen);
        for (int frame = 0; frame < 10; frame++)
            draw(self, seen);
        nook_stream_get_status(self->stage.stream, &status);
        assert_false(status.failed);
        assert_true(status.resident > 0 && status.memory <= bytes / (uint64_t)part);
        assert_true(field_is_there(self));
    }
    assert_int_equal(nook_scene_reload_create(&self->stage, NULL, &reload), NOOK_OK);
    file_tree_edit(&self->tree, "tests/game/data/crate.gltf", "    0.3,\n", "    -0.8,\n");
    exchange(self, reload);
    settle(self, seen);
    assert_true(field_is_there(self));
    nook_scene_reload_destroy(reload);
}

static void test_what_a_scalar_field_takes_is_no_room_for_what_comes_and_goes(void **state)
{
    fixture *self = *state;
    const uint64_t all = open_with_field(self, 5 * FIELD_SIDE); /* longer than most rooms would be without it */
    const double field = (double)nook_ao_kept_bytes(self->stage.ao, NOOK_VOLUME_DENSITY);
    assert_true(field == (5 * FIELD_SIDE + 2) * (FIELD_SIDE + 2) * (FIELD_SIDE + 2));
    for (int i = 1; i <= 40; i++) { /* of any shape: it holds the field, and no more than it may */
        double budget = field + ((double)all - field) * i / 41.0;
        nook_stream_status status = settled_with(self, budget);
        assert_false(status.failed);
        assert_true(field_is_there(self));
        assert_true((double)status.memory <= budget + 1.0);
        assert_true((double)status.wanted_bytes + field <= budget + 1.0);
    }
}

static void test_a_budget_below_a_scalar_field_is_one_line_that_says_what_is_needed(void **state)
{
    fixture *self = *state;
    picture seen;
    double stays = 0.0, needed = 0.0;
    open_with_field(self, FIELD_SIDE);
    int before = self->log.count;
    nook_stream_status status = settled_with(self, 1000.0);
    for (int frame = 0; frame < 5; frame++)
        draw(self, seen);
    assert_int_equal(self->log.count, before + 1);
    assert_true(status.failed && status.resident == 0);
    assert_true(field_is_there(self));
    assert_true(status.memory == nook_ao_kept_bytes(self->stage.ao, NOOK_VOLUME_DENSITY)); /* and not a byte more */
    assert_int_equal(sscanf(strstr(self->log.text, "always stay"), "always stay, %lf: nothing else comes; with %lf",
                            &stays, &needed),
                     2);
    assert_true(stays > 0.002 && stays < 0.003 && needed > stays);
    status = settled_with(self, needed * 1024.0 * 1024.0);
    assert_int_equal(self->log.count, before + 1);
    assert_false(status.failed);
    assert_true(status.resident > 0);
}

static void test_a_scalar_field_that_is_saved_larger_leaves_what_comes_and_goes_less(void **state)
{
    fixture *self = *state;
    picture seen;
    nook_scene_reload *reload;
    nook_stream_status status;
    const uint64_t all = open_with_field(self, FIELD_SIDE);
    const double budget = (double)all / 2.0;
    assert_true(settled_with(self, budget).resident > 0);
    assert_int_equal(nook_scene_reload_create(&self->stage, NULL, &reload), NOOK_OK);
    for (int width = 8 * FIELD_SIDE; width >= FIELD_SIDE; width /= 2) {
        write_field(self, width);
        exchange(self, reload);
        settle(self, seen);
        nook_stream_get_status(self->stage.stream, &status);
        assert_false(status.failed);
        assert_true(field_is_there(self));
        assert_true((double)status.memory <= budget + 1.0);
        assert_true(status.resident > 0);
    }
    nook_scene_reload_destroy(reload);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_streamed_scene_becomes_the_picture_of_one_that_is_not, setup, teardown),
        cmocka_unit_test_setup_teardown(test_a_scene_with_little_memory_shows_coarser_volumes, setup, teardown),
        cmocka_unit_test_setup_teardown(test_a_model_that_is_saved_is_exchanged_while_volumes_stream, setup, teardown),
        cmocka_unit_test_setup_teardown(test_a_scalar_field_stays_whatever_the_budget_leaves_of_volumes, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_what_a_scalar_field_takes_is_no_room_for_what_comes_and_goes, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_a_budget_below_a_scalar_field_is_one_line_that_says_what_is_needed, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(test_a_scalar_field_that_is_saved_larger_leaves_what_comes_and_goes_less, setup,
                                        teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
