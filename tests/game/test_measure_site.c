/* A site: its truths, what they are kept as, and what a setting measures against them. */
#include "engine/core/file.h"
#include "game/compare/camera.h"
#include "game/measure/scene_hash.h"
#include "game/measure/site_time.h"
#include "game/stage.h"
#include "modules/ao/technique.h"
#include "modules/ao_reference/reference.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

#include <cmocka.h>

enum { WIDTH = 32, HEIGHT = 24, PIXELS = WIDTH * HEIGHT, PATH_CAPACITY = 4096 };

/* Of the reference's picture, see below. */
#define KNOWN_VERSION 2u
#define KNOWN_HASH UINT64_C(0xcf9dc59d616184d6)

typedef struct fixture {
    nook_stage stage;
    nook_camera camera;
    char cache[PATH_CAPACITY / 2];
} fixture;

static void remove_files(const char *folder)
{
    char path[PATH_CAPACITY];
    DIR *entries = opendir(folder);
    for (struct dirent *entry; entries && (entry = readdir(entries));)
        unlink(nook_path_join(path, sizeof path, folder, entry->d_name));
    if (entries)
        closedir(entries);
}

static int set_up(void **state)
{
    static fixture made;
    const char *root = getenv("NOOK_ROOT");
    char scene[PATH_CAPACITY], label[64];
    snprintf(scene, sizeof scene, "%s/tests/game/data/crate.gltf", root ? root : ".");
    nook_scratch_path(made.cache, sizeof made.cache, "truths");
    remove_files(made.cache);
    const nook_stage_desc desc = {
        .root = root ? root : ".", .scene_path = scene, .backend = NOOK_BACKEND_OSMESA, .width = WIDTH, .height = HEIGHT
    };
    const nook_game_world_desc world = { 16, 0.5, NULL };
    *state = &made;
    return nook_stage_open(&desc, &made.stage) != NOOK_OK ||
           nook_ao_set_param(made.stage.ao, "ao.r_max", 0.5) != NOOK_OK ||
           nook_stage_fill(&made.stage, &world) != NOOK_OK ||
           nook_camera_choose(made.stage.scene, NULL, (double)WIDTH / HEIGHT, &made.camera, label, sizeof label) !=
               NOOK_OK;
}

static int tear_down(void **state)
{
    nook_stage_close(&((fixture *)*state)->stage);
    return 0;
}

static nook_site *open_site(fixture *f, const char *cache, double noise, uint32_t rays_max, uint32_t what)
{
    const nook_site_desc desc = { f->camera, "view", noise, rays_max, cache, what, 0 };
    nook_site *site;
    assert_int_equal(nook_site_open(&f->stage, &desc, &site), NOOK_OK);
    return site;
}

static nook_sample measure(nook_site *site, const char *text, uint32_t what)
{
    nook_setting setting;
    nook_sample sample;
    assert_int_equal(nook_setting_parse("test", text, &setting), NOOK_OK);
    assert_int_equal(nook_site_measure(site, &setting, what, &sample), NOOK_OK);
    return sample;
}

static void copy_truth(const nook_site *site, float out[PIXELS])
{
    memcpy(out, nook_site_truth(site), PIXELS * sizeof *out);
}

static void test_the_truth_is_traced_until_its_noise_is_what_was_asked_for(void **state)
{
    fixture *f = *state;
    nook_site *rough = open_site(f, NULL, 1.0, 65536, 0);
    double wanted = 0.6 * nook_site_noise(rough);
    nook_site *fine = open_site(f, NULL, wanted, 65536, 0);
    assert_true(wanted > 0.0 && nook_site_noise(fine) > 0.0 && nook_site_noise(fine) <= wanted);
    assert_true(measure(fine, "ssao", 0).reference_rays > measure(rough, "ssao", 0).reference_rays);
    nook_site_close(rough);
    nook_site_close(fine);
}

/* The noise stated is that of the truth: against one with many more rays the difference is no larger than it should be. */
static void test_the_stated_noise_is_the_difference_from_a_truth_with_more_rays(void **state)
{
    fixture *f = *state;
    nook_site *rough = open_site(f, NULL, 1e-9, 64, 0), *fine = open_site(f, NULL, 1e-9, 8192, 0);
    nook_errors errors;
    assert_int_equal(
        nook_errors_measure(nook_site_truth(rough), nook_site_truth(fine), nook_site_geometry(rough), PIXELS, &errors),
        NOOK_OK);
    double expected = hypot(nook_site_noise(rough), nook_site_noise(fine));
    if (!(errors.rmse > 0.8 * expected && errors.rmse < 1.25 * expected))
        fail_msg("differs by %g, states %g", errors.rmse, expected);
    nook_site_close(rough);
    nook_site_close(fine);
}

static void test_a_kept_truth_is_read_again_and_more_rays_are_added_to_it(void **state)
{
    fixture *f = *state;
    float first[PIXELS];
    nook_site *site = open_site(f, f->cache, 1.0, 2048, 0);
    double first_noise = nook_site_noise(site);
    copy_truth(site, first);
    nook_site_close(site);
    site = open_site(f, f->cache, 1.0, 2048, 0);
    assert_memory_equal(nook_site_truth(site), first, sizeof first);
    nook_site_close(site);
    site = open_site(f, f->cache, first_noise * 0.6, 4096, 0);
    double second_noise = nook_site_noise(site);
    copy_truth(site, first);
    nook_site_close(site);
    assert_true(second_noise <= first_noise * 0.6);
    site = open_site(f, f->cache, 1.0, 4096, 0); /* asks for less than there is, and has it all */
    assert_true(nook_site_noise(site) == second_noise);
    assert_memory_equal(nook_site_truth(site), first, sizeof first);
    nook_site_close(site);
}

static void damage(const char *folder)
{
    char path[PATH_CAPACITY];
    DIR *entries = opendir(folder);
    assert_non_null(entries);
    for (struct dirent *entry; (entry = readdir(entries));) {
        nook_file file;
        nook_path_join(path, sizeof path, folder, entry->d_name);
        if (!nook_file_exists(path))
            continue;
        assert_int_equal(nook_file_read(path, &file), NOOK_OK);
        file.bytes[file.size - 1] ^= 0x40;
        assert_int_equal(nook_file_write(path, file.bytes, file.size), NOOK_OK);
        nook_file_free(&file);
    }
    closedir(entries);
}

static void test_a_damaged_truth_is_one_warning_and_traced_anew(void **state)
{
    fixture *f = *state;
    float first[PIXELS];
    nook_log_capture log;
    nook_site *site = open_site(f, f->cache, 1.0, 512, 0);
    copy_truth(site, first);
    nook_site_close(site);
    damage(f->cache);
    nook_log_capture_begin(&log);
    site = open_site(f, f->cache, 1.0, 512, 0);
    nook_log_capture_end();
    assert_int_equal(log.count, 1);
    assert_int_equal(log.errors, 0);
    assert_non_null(strstr(log.text, "damaged truth"));
    assert_memory_equal(nook_site_truth(site), first, sizeof first);
    nook_site_close(site);
    site = open_site(f, f->cache, 1.0, 512, 0); /* it was replaced */
    assert_memory_equal(nook_site_truth(site), first, sizeof first);
    nook_site_close(site);
}

static void test_the_truth_is_the_same_whatever_volumes_are_loaded(void **state)
{
    fixture *f = *state;
    float first[PIXELS];
    const nook_game_world_desc fine = { 64, 0.5, NULL };
    nook_site *site = open_site(f, NULL, 1.0, 512, 0);
    copy_truth(site, first);
    nook_site_close(site);
    assert_int_equal(nook_stage_fill(&f->stage, &fine), NOOK_OK);
    site = open_site(f, NULL, 1.0, 512, 0);
    assert_memory_equal(nook_site_truth(site), first, sizeof first);
    nook_site_close(site);
}

static void test_a_reach_of_another_length_has_a_truth_of_its_own(void **state)
{
    fixture *f = *state;
    float first[PIXELS];
    nook_site *site = open_site(f, f->cache, 1.0, 512, 0);
    copy_truth(site, first);
    nook_site_close(site);
    assert_int_equal(nook_ao_set_param(f->stage.ao, "ao.r_max", 0.1), NOOK_OK);
    site = open_site(f, f->cache, 1.0, 512, 0);
    assert_memory_not_equal(nook_site_truth(site), first, sizeof first);
    nook_site_close(site);
}

/* Kept truths outlive the program. With 4 rays a pixel the picture is made of quarters, which rounding elsewhere does not move. */
static void test_the_reference_draws_what_its_version_says(void **state)
{
    fixture *f = *state;
    nook_site *site = open_site(f, NULL, 1.0, 64, NOOK_MEASURE_PICTURE);
    nook_sample sample = measure(site, "reference rays=4", NOOK_MEASURE_PICTURE);
    uint8_t quarters[PIXELS];
    for (int i = 0; i < PIXELS; i++)
        quarters[i] = (uint8_t)lround(4.0 * (double)sample.visibility.values[i]);
    uint64_t hash = XXH3_64bits(quarters, sizeof quarters);
    nook_grey_free(&sample.visibility);
    nook_site_close(site);
    if (NOOK_REFERENCE_VERSION != KNOWN_VERSION || hash != KNOWN_HASH)
        fail_msg(
            "hash %#llx of version %u: where the rays have changed, raise NOOK_REFERENCE_VERSION, then put both here",
            (unsigned long long)hash, (unsigned)NOOK_REFERENCE_VERSION);
}

static void test_where_the_truth_is_too_noisy_for_an_error_it_is_traced_further(void **state)
{
    fixture *f = *state;
    nook_site *site = open_site(f, NULL, 1.0, 65536, 0);
    double noise = nook_site_noise(site);
    nook_sample sample = measure(site, "reference rays=256", 0); /* with noise like that of the truth */
    assert_true(sample.truth.valid);
    assert_true(noise > 0.25 * sample.truth.rmse); /* else this tests nothing */
    assert_true(sample.reference_noise <= 0.25 * sample.truth.rmse);
    assert_true(sample.reference_noise == nook_site_noise(site));
    nook_site_close(site);
}

static void test_a_setting_measures_the_same_twice_and_after_others(void **state)
{
    fixture *f = *state;
    nook_site *site = open_site(f, NULL, 0.001, 65536, NOOK_MEASURE_STEADINESS | NOOK_MEASURE_SCREEN);
    nook_sample first = measure(site, "ssao ao.scale=half", NOOK_MEASURE_STEADINESS | NOOK_MEASURE_SCREEN);
    measure(site, "volume rays=4 ao.filter=none", NOOK_MEASURE_STEADINESS);
    nook_sample again = measure(site, "ssao ao.scale=half", NOOK_MEASURE_STEADINESS | NOOK_MEASURE_SCREEN);
    assert_true(first.truth.rmse == again.truth.rmse && first.screen.rmse == again.screen.rmse);
    assert_true(first.noise == again.noise && first.flicker == again.flicker);
    assert_true(first.instability.rms == again.instability.rms && first.ssim == again.ssim);
    assert_true(first.fetches == again.fetches && first.fetches > 0.0);
    assert_true(first.outside == 0 && again.outside == 0);
    assert_true(first.truth.rmse > 0.0 && first.screen.rmse > 0.0 && first.screen.rmse != first.truth.rmse);
    nook_site_close(site);
}

static nook_result record_late_mistake(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state, (void)params;
    return nook_ao_pass_dispatch(pass, "tests/game/late_mistake.comp.glsl", 16, 8);
}

static const nook_ao_technique late_mistake = { .version = NOOK_AO_TECHNIQUE_VERSION,
                                                .name = "late_mistake",
                                                .summary = "Above 1 with any seed but the first",
                                                .record = record_late_mistake };

static void test_values_out_of_range_are_counted_in_every_frame_that_is_not_timed(void **state)
{
    fixture *f = *state;
    uint64_t pixels = 0;
    nook_sample sample;
    const nook_setting setting = nook_setting_initial(&late_mistake);
    assert_int_equal(nook_ao_add_technique(f->stage.ao, &late_mistake), NOOK_OK);
    nook_site *site = open_site(f, NULL, 1.0, 64, NOOK_MEASURE_STEADINESS);
    for (size_t i = 0; i < PIXELS; i++)
        pixels += nook_site_geometry(site)[i] != 0;
    assert_int_equal(nook_site_measure(site, &setting, 0, &sample), NOOK_OK);
    assert_int_equal(sample.outside, 0);
    assert_int_equal(nook_site_measure(site, &setting, NOOK_MEASURE_STEADINESS, &sample), NOOK_OK);
    assert_int_equal(sample.outside, pixels);
    nook_site_close(site);
}

/* Frames that take 10 ms, and a round in which the machine did something else. */
static void test_times_are_those_of_the_middle_round(void **state)
{
    (void)state;
    nook_sample sample = { 0 };
    const nook_site_times times = {
        .rounds = 5, .frames = 3, .ms = { 11, 10, 95, 12, 9 }, .gpu_ms = { 3, 1, 2, 5, 4 }
    };
    nook_site_times_put(&times, &sample);
    assert_true(sample.ms_median == 11.0 && sample.ms_min == 9.0 && sample.ms_max == 95.0);
    assert_true(sample.gpu_ms_median == 3.0);
    assert_int_equal(sample.frames, 15);
}

static void test_settings_take_turns_and_each_round_is_one_time(void **state)
{
    static const char *const texts[] = { "ssao", "volume ao.scale=half" };
    fixture *f = *state;
    nook_site *site = open_site(f, NULL, 1.0, 64, NOOK_MEASURE_TIME);
    nook_setting settings[2];
    nook_site_times times[2] = { 0 };
    for (int i = 0; i < 2; i++)
        assert_int_equal(nook_setting_parse("test", texts[i], &settings[i]), NOOK_OK);
    assert_int_equal(nook_site_show(site), NOOK_OK);
    for (int round = 0; round < NOOK_SITE_ROUNDS; round++) {
        for (int i = 0; i < 2; i++) {
            assert_int_equal(nook_site_time_round(site, &settings[i], &times[i]), NOOK_OK);
            assert_in_range(times[i].wanted, NOOK_SITE_ROUNDS_SLOW, NOOK_SITE_ROUNDS);
            assert_int_equal(times[i].rounds,
                             (uint32_t)round < times[i].wanted ? (uint32_t)round + 1 : times[i].wanted);
            assert_true(times[i].frames >= 1 && times[i].ms[times[i].rounds - 1] > 0.0);
        }
    }
    nook_site_close(site);
}

static void test_what_is_not_asked_for_is_not_a_number(void **state)
{
    fixture *f = *state;
    nook_site *site = open_site(f, NULL, 1.0, 512, NOOK_MEASURE_ALL);
    nook_sample sample = measure(site, "volume", 0);
    assert_true(isnan(sample.ms_median) && isnan(sample.noise) && isnan(sample.flicker));
    assert_true(isnan(sample.instability.rms) && isnan(sample.screen.rmse) && !sample.visibility.values);
    assert_true(isfinite(sample.truth.rmse) && isfinite(sample.fetches) && isfinite(sample.ssim));
    assert_true(sample.volume_bytes > 0.0 && sample.texture_bytes > 0.0 && sample.bake_ms > 0.0);
    nook_site_close(site);
}

static void test_all_that_is_asked_for_is_measured(void **state)
{
    fixture *f = *state;
    nook_site *site = open_site(f, NULL, 0.01, 4096, NOOK_MEASURE_ALL);
    nook_sample sample = measure(site, "ssao", NOOK_MEASURE_ALL);
    assert_true(sample.ms_min > 0.0 && sample.ms_median >= sample.ms_min && sample.ms_max >= sample.ms_median);
    assert_in_range(sample.frames, NOOK_SITE_ROUNDS_SLOW, 3 * NOOK_SITE_ROUNDS);
    assert_true(isfinite(sample.screen.rmse) && sample.noise > 0.0 && sample.flicker > 0.0);
    assert_true(sample.instability.valid && sample.ssim < 1.0);
    assert_true(sample.volume_bytes == 0.0 && sample.bake_ms == 0.0);
    assert_non_null(sample.visibility.values);
    assert_int_equal(sample.visibility.width, WIDTH);
    nook_errors errors;
    assert_int_equal(
        nook_errors_measure(sample.visibility.values, nook_site_truth(site), nook_site_geometry(site), PIXELS, &errors),
        NOOK_OK);
    assert_true(errors.rmse == sample.truth.rmse);
    nook_grey_free(&sample.visibility);
    nook_site_close(site);
}

static void test_a_camera_that_sees_nothing_is_refused(void **state)
{
    fixture *f = *state;
    const double eye[3] = { 100.0, 100.0, 100.0 }, target[3] = { 200.0, 200.0, 200.0 };
    nook_site_desc desc = { .camera_name = "away", .noise = 1.0, .rays_max = 64 };
    nook_site *site;
    nook_log_capture log;
    assert_int_equal(nook_camera_look(eye, target, 0.9, 0.01, &desc.camera), NOOK_OK);
    nook_log_capture_begin(&log);
    nook_result result = nook_site_open(&f->stage, &desc, &site);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_E_NOT_FOUND);
    assert_null(site);
    assert_int_equal(log.errors, 1);
}

static void test_scenes_are_told_apart_by_content(void **state)
{
    fixture *f = *state;
    nook_scene *scene = f->stage.scene;
    uint64_t hash = nook_scene_hash(scene);
    assert_true(hash == nook_scene_hash(scene));
    scene->vertices[0].position[1] += 0.001f;
    assert_true(hash != nook_scene_hash(scene));
    scene->vertices[0].position[1] -= 0.001f;
    scene->nodes[0].world_from_local.m[12] += 1e-9;
    assert_true(hash != nook_scene_hash(scene));
}

#define SITE_TEST(function) cmocka_unit_test_setup_teardown(function, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        SITE_TEST(test_the_truth_is_traced_until_its_noise_is_what_was_asked_for),
        SITE_TEST(test_the_stated_noise_is_the_difference_from_a_truth_with_more_rays),
        SITE_TEST(test_a_kept_truth_is_read_again_and_more_rays_are_added_to_it),
        SITE_TEST(test_a_damaged_truth_is_one_warning_and_traced_anew),
        SITE_TEST(test_the_truth_is_the_same_whatever_volumes_are_loaded),
        SITE_TEST(test_a_reach_of_another_length_has_a_truth_of_its_own),
        SITE_TEST(test_the_reference_draws_what_its_version_says),
        SITE_TEST(test_where_the_truth_is_too_noisy_for_an_error_it_is_traced_further),
        SITE_TEST(test_a_setting_measures_the_same_twice_and_after_others),
        SITE_TEST(test_values_out_of_range_are_counted_in_every_frame_that_is_not_timed),
        cmocka_unit_test(test_times_are_those_of_the_middle_round),
        SITE_TEST(test_settings_take_turns_and_each_round_is_one_time),
        SITE_TEST(test_what_is_not_asked_for_is_not_a_number),
        SITE_TEST(test_all_that_is_asked_for_is_measured),
        SITE_TEST(test_a_camera_that_sees_nothing_is_refused),
        SITE_TEST(test_scenes_are_told_apart_by_content),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
