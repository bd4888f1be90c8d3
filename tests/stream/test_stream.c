/* Volumes under a budget: what is seen, what it takes, and what goes wrong with files. */
#include "engine/core/file.h"
#include "tests/support/log_capture.h"
#include "tests/support/stream_hall.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

typedef float picture[STREAM_HALL_PIXELS];

enum { STEPS = 60 };
static const double mebibyte = 1024.0 * 1024.0, hall_length = 26.0;

/* ---- Allocations of this program, but for sanitized ones, which have their own ----------------------------------------- */

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define COUNTS_ALLOCATIONS 1
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *memory, size_t size);

static _Thread_local uint64_t allocations;

void *malloc(size_t size)
{
    allocations++;
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    allocations++;
    return __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size)
{
    allocations++;
    return __libc_realloc(memory, size);
}
#else
#define COUNTS_ALLOCATIONS 0
static uint64_t allocations;
#endif

/* ---- Pictures ---------------------------------------------------------------------------------------------------------- */

static void draw_without_streaming(nook_volume_kind kind, const char *sampling, double metres, picture out)
{
    stream_hall hall;
    stream_hall_open(&hall, kind);
    ao_view_param(hall.view, "volume.sampling", sampling);
    stream_hall_add_all(&hall);
    stream_hall_look(&hall, metres, 0.0);
    stream_hall_record(&hall, out);
    stream_hall_close(&hall);
}

static void expect_the_same_picture(nook_volume_kind kind, const char *sampling)
{
    stream_hall hall;
    picture all, streamed, open;
    draw_without_streaming(kind, sampling, 2.0, all);
    stream_hall_open(&hall, kind);
    ao_view_param(hall.view, "volume.sampling", sampling);
    stream_hall_start(&hall, STREAM_HALL_LEVELS, 1.5 * (double)stream_hall_bytes(&hall) / mebibyte + 0.5);
    stream_hall_look(&hall, 2.0, 0.0);
    stream_hall_record(&hall, open); /* nothing is there yet */
    for (uint32_t i = 0; i < STREAM_HALL_PIXELS; i++)
        assert_true(open[i] == 1.0f);
    stream_hall_settle(&hall);
    assert_true(stream_hall_status(&hall).all_fit);
    assert_int_equal(stream_hall_status(&hall).resident, STREAM_HALL_BODIES);
    stream_hall_record(&hall, streamed);
    assert_memory_equal(streamed, all, sizeof all);
    assert_memory_not_equal(streamed, open, sizeof open);
    stream_hall_close(&hall);
}

static void test_with_enough_budget_the_picture_becomes_that_without_streaming_bit_for_bit(void **state)
{
    (void)state;
    expect_the_same_picture(NOOK_VOLUME_BINARY, "corners");
    expect_the_same_picture(NOOK_VOLUME_BINARY, "filter");
    expect_the_same_picture(NOOK_VOLUME_SURFEL, "filter");
    expect_the_same_picture(NOOK_VOLUME_DENSITY, "filter");
    expect_the_same_picture(NOOK_VOLUME_DISTANCE, "filter");
}

/* ---- Memory ------------------------------------------------------------------------------------------------------------ */

static void go_through(nook_volume_kind kind)
{
    stream_hall hall;
    picture seen;
    uint32_t frames_with_volumes = 0;
    stream_hall_open(&hall, kind);
    double mib = (double)stream_hall_bytes(&hall) / mebibyte / 8.0;
    stream_hall_start(&hall, STREAM_HALL_LEVELS, mib);
    const uint64_t most = (uint64_t)((double)nook_stream_params_of(hall.stream)->upload * mebibyte);
    for (int i = 0; i < STEPS; i++) { /* there and back, looking around */
        double part = 1.0 - fabs(2.0 * i / STEPS - 1.0);
        const struct timespec frame = { 0, 4 * 1000 * 1000 };
        stream_hall_look(&hall, hall_length * part, 50.0 * sin(0.3 * i));
        stream_hall_update(&hall);
        nook_stream_status status = stream_hall_status(&hall);
        assert_true(status.memory <= (uint64_t)(mib * mebibyte));
        assert_true(status.resident_bytes <= status.memory);
        assert_true(status.frame_upload <= most);
        assert_false(status.all_fit);
        frames_with_volumes += status.resident > 0;
        if (i % 10 == 0)
            stream_hall_record(&hall, seen);
        nanosleep(&frame, NULL);
    }
    nook_stream_status status = stream_hall_status(&hall);
    assert_true(status.loads > STREAM_HALL_BODIES / 2 && status.evictions > 0);
    assert_true(frames_with_volumes > STEPS / 2);
    stream_hall_close(&hall);
}

static void test_an_eighth_of_the_memory_is_never_exceeded_on_the_way_through_a_hall(void **state)
{
    (void)state;
    go_through(NOOK_VOLUME_BINARY);
    go_through(NOOK_VOLUME_SURFEL);
}

static void test_what_is_seen_has_its_volumes_where_memory_is_short(void **state)
{
    (void)state;
    stream_hall hall;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, 1, (double)stream_hall_bytes(&hall) / mebibyte / 2.0);
    for (int turn = 0; turn < 2; turn++) {
        uint32_t near = turn ? 14 : 0, there = 0; /* pillars 14 to 17 are 1 m behind and 1.5 m before the camera */
        stream_hall_look(&hall, turn ? 21.0 : 0.0, 0.0);
        stream_hall_settle(&hall);
        for (uint32_t i = near; i < near + 4; i++)
            there += nook_ao_has_volume(hall.view->ao, hall.volumes[i], NOOK_VOLUME_BINARY);
        assert_int_equal(there, 4);
    }
    assert_false(nook_ao_has_volume(hall.view->ao, hall.volumes[0], NOOK_VOLUME_BINARY)); /* far behind by now */
    stream_hall_close(&hall);
}

static void test_a_smaller_budget_gives_memory_back_and_a_larger_one_brings_everything(void **state)
{
    (void)state;
    stream_hall hall;
    picture before, after;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    double all = (double)stream_hall_bytes(&hall) / mebibyte;
    stream_hall_start(&hall, STREAM_HALL_LEVELS, 0.0);
    stream_hall_settle(&hall);
    stream_hall_record(&hall, before);
    uint64_t memory = stream_hall_status(&hall).memory;
    nook_stream_params params = *nook_stream_params_of(hall.stream);
    params.budget = (float)(all / 5.0);
    assert_int_equal(nook_stream_set_params(hall.stream, &params), NOOK_OK);
    stream_hall_update(&hall);
    assert_true(stream_hall_status(&hall).memory <= (uint64_t)(all / 5.0 * mebibyte));
    assert_true(stream_hall_status(&hall).resident > 0); /* what fits stayed, without being read again */
    stream_hall_record(&hall, after);
    stream_hall_settle(&hall);
    assert_true(stream_hall_status(&hall).memory < memory / 4);
    params.budget = (float)(4.0 * all);
    assert_int_equal(nook_stream_set_params(hall.stream, &params), NOOK_OK);
    stream_hall_settle(&hall);
    assert_int_equal(stream_hall_status(&hall).resident, STREAM_HALL_BODIES);
    assert_int_equal(stream_hall_status(&hall).waiting, 0);
    stream_hall_record(&hall, after);
    assert_memory_equal(before, after, sizeof before);
    stream_hall_close(&hall);
}

static void test_uploads_of_a_frame_are_bounded_and_volumes_come_in_parts(void **state)
{
    (void)state;
    stream_hall hall;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, 1, 0.0);
    nook_stream_params params = *nook_stream_params_of(hall.stream);
    params.upload = 0.26f;
    assert_int_equal(nook_stream_set_params(hall.stream, &params), NOOK_OK);
    stream_hall_settle(&hall);
    nook_stream_status status = stream_hall_status(&hall);
    assert_true(status.largest_upload > 0 && status.largest_upload <= (uint64_t)(0.26 * mebibyte) + 1);
    assert_int_equal(status.resident, STREAM_HALL_BODIES);
    stream_hall_close(&hall);
}

/* ---- Rest -------------------------------------------------------------------------------------------------------------- */

/* Nothing would ever come, and nobody would know why. */
static void test_parameters_outside_of_their_ranges_are_refused(void **state)
{
    (void)state;
    static const struct {
        float budget, upload;
        const char *name;
    } wrong[] = { { 0.0f, 0.0f, "volumes.upload" },     { 0.0f, INFINITY, "volumes.upload" },
                  { 0.0f, NAN, "volumes.upload" },      { -1.0f, 1.0f, "volumes.budget" },
                  { INFINITY, 1.0f, "volumes.budget" }, { NAN, 1.0f, "volumes.budget" } };
    stream_hall hall;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, STREAM_HALL_LEVELS, 0.0);
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++) {
        nook_stream *none = hall.stream;
        nook_stream_params params = nook_stream_params_initial();
        nook_log_capture log;
        params.budget = wrong[i].budget;
        params.upload = wrong[i].upload;
        nook_log_capture_begin(&log);
        assert_int_equal(nook_stream_create(hall.view->ao, &params, &none), NOOK_E_RANGE);
        assert_int_equal(nook_stream_set_params(hall.stream, &params), NOOK_E_RANGE);
        nook_log_capture_end();
        assert_null(none);
        assert_int_equal(log.count, 2);
        assert_non_null(strstr(log.text, wrong[i].name));
    }
    stream_hall_settle(&hall); /* by the parameters that it had */
    assert_int_equal(stream_hall_status(&hall).resident, STREAM_HALL_BODIES);
    stream_hall_close(&hall);
}

static void test_a_camera_that_sways_makes_nothing_come_and_go(void **state)
{
    (void)state;
    stream_hall hall;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, STREAM_HALL_LEVELS, (double)stream_hall_bytes(&hall) / mebibyte / 6.0);
    stream_hall_look(&hall, 9.0, 0.0);
    stream_hall_settle(&hall);
    stream_hall_look(&hall, 9.2, 1.0);
    stream_hall_settle(&hall);
    nook_stream_status before = stream_hall_status(&hall);
    for (int i = 0; i < 20; i++) {
        stream_hall_look(&hall, 9.0 + 0.2 * (i % 2), i % 2);
        stream_hall_settle(&hall);
    }
    nook_stream_status after = stream_hall_status(&hall);
    assert_true(after.loads - before.loads <= 2);
    assert_true(after.evictions - before.evictions <= 2);
    stream_hall_close(&hall);
}

static void test_frames_in_which_nothing_comes_allocate_nothing(void **state)
{
    (void)state;
    stream_hall hall;
    if (!COUNTS_ALLOCATIONS) {
        print_message("allocations of a sanitized program are not counted\n");
        skip();
    }
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    uint64_t before = allocations;
    stream_hall_start(&hall, STREAM_HALL_LEVELS, (double)stream_hall_bytes(&hall) / mebibyte / 6.0);
    assert_true(allocations > before); /* they are counted */
    stream_hall_settle(&hall);
    before = allocations;
    for (int i = 0; i < 50; i++)
        stream_hall_update(&hall);
    assert_true(allocations == before);
    stream_hall_close(&hall);
}

/* ---- Files ------------------------------------------------------------------------------------------------------------- */

static void damage(const char *path)
{
    nook_file file;
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    file.bytes[file.size / 2] ^= 0x40;
    assert_int_equal(nook_file_write(path, file.bytes, file.size), NOOK_OK);
    nook_file_free(&file);
}

/* Bodies 0, 1 and 2 cannot be read. */
static void spoil(const stream_hall *hall)
{
    damage(hall->paths[0][0]);
    assert_int_equal(remove(hall->paths[1][0]), 0);
    assert_int_equal(nook_file_copy(hall->paths[3][0], hall->paths[2][0]), NOOK_OK);
}

static void test_a_broken_file_is_one_line_and_its_body_does_without(void **state)
{
    (void)state;
    stream_hall hall;
    nook_log_capture lines;
    picture all, without;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_add_all(&hall);
    for (uint32_t i = 0; i < 3; i++)
        hall.view->occluders[i].volume = (nook_ao_volume){ 0 };
    stream_hall_record(&hall, all);
    stream_hall_close(&hall);

    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, 1, 0.0);
    spoil(&hall);
    nook_log_capture_begin(&lines);
    stream_hall_settle(&hall);
    for (int i = 0; i < 5; i++)
        stream_hall_update(&hall);
    nook_log_capture_end();
    assert_int_equal(lines.count, 3);
    assert_int_equal(stream_hall_status(&hall).refused, 3);
    assert_int_equal(stream_hall_status(&hall).resident, STREAM_HALL_BODIES - 3);
    assert_int_equal(stream_hall_status(&hall).waiting, 0);
    stream_hall_record(&hall, without);
    assert_memory_equal(all, without, sizeof all);
    stream_hall_close(&hall);
}

static void test_a_body_whose_finest_file_is_broken_shows_a_coarser_one(void **state)
{
    (void)state;
    nook_log_capture lines;
    for (int tight = 0; tight < 2; tight++) {
        stream_hall hall;
        stream_hall_open(&hall, NOOK_VOLUME_BINARY);
        stream_hall_start(&hall, STREAM_HALL_LEVELS, tight ? (double)stream_hall_bytes(&hall) / mebibyte / 2.0 : 0.0);
        spoil(&hall);
        nook_log_capture_begin(&lines);
        stream_hall_settle(&hall);
        nook_log_capture_end();
        assert_int_equal(lines.count, 3);
        for (uint32_t i = 0; i < 3; i++)
            assert_true(nook_ao_has_volume(hall.view->ao, hall.volumes[i], NOOK_VOLUME_BINARY));
        stream_hall_close(&hall);
    }
}

/* A folder in the place of a body's file, which is kept beside it; or the file again. */
static void hide(const stream_hall *hall, uint32_t body, bool hidden)
{
    char beside[4096];
    const char *path = hall->paths[body][0];
    snprintf(beside, sizeof beside, "%s.beside", path);
    if (hidden) {
        assert_int_equal(rename(path, beside), 0);
        assert_int_equal(nook_directory_make(path), NOOK_OK);
    } else {
        assert_int_equal(remove(path), 0);
        assert_int_equal(rename(beside, path), 0);
    }
}

static void test_what_may_pass_is_asked_for_again_after_pauses_that_grow(void **state)
{
    enum { FIRST_PAUSE = 60 };
    (void)state;
    stream_hall hall;
    nook_log_capture lines;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, 1, 0.0);
    hide(&hall, 1, true);
    nook_log_capture_begin(&lines);
    stream_hall_settle(&hall);
    for (int i = 0; i < FIRST_PAUSE / 2; i++)
        stream_hall_update(&hall);
    assert_int_equal(lines.count, 1);
    assert_int_equal(stream_hall_status(&hall).refused, 1);
    for (int i = 0; i < FIRST_PAUSE; i++)
        stream_hall_update(&hall);
    stream_hall_settle(&hall);
    assert_int_equal(lines.count, 2); /* still so */
    hide(&hall, 1, false);
    for (int i = 0; i < FIRST_PAUSE; i++)
        stream_hall_update(&hall);
    assert_int_equal(stream_hall_status(&hall).refused, 1); /* twice as long */
    for (int i = 0; i < FIRST_PAUSE; i++)
        stream_hall_update(&hall);
    stream_hall_settle(&hall);
    nook_log_capture_end();
    assert_int_equal(lines.count, 2);
    assert_int_equal(stream_hall_status(&hall).refused, 0);
    assert_int_equal(stream_hall_status(&hall).resident, STREAM_HALL_BODIES);
    stream_hall_close(&hall);
}

/* ---- Coming and going of bodies ---------------------------------------------------------------------------------------- */

static void test_bodies_are_removed_while_they_are_read(void **state)
{
    (void)state;
    stream_hall hall;
    picture seen;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    for (int tight = 0; tight < 2; tight++) {
        stream_hall_start(&hall, STREAM_HALL_LEVELS, tight ? (double)stream_hall_bytes(&hall) / mebibyte / 4.0 : 0.0);
        for (uint32_t i = 0; i < STREAM_HALL_BODIES; i++) {
            stream_hall_update(&hall);
            stream_hall_remove(&hall, i);
            if (i % 3 == 0)
                stream_hall_add(&hall, i, STREAM_HALL_LEVELS);
        }
        stream_hall_settle(&hall);
        stream_hall_record(&hall, seen);
        assert_int_equal(stream_hall_status(&hall).volumes, (STREAM_HALL_BODIES + 2) / 3);
        assert_true(stream_hall_status(&hall).resident > 0);
        for (uint32_t i = 0; i < STREAM_HALL_BODIES; i += 3)
            stream_hall_remove(&hall, i);
        stream_hall_update(&hall);
        assert_true(stream_hall_status(&hall).memory == 0); /* given back */
        nook_stream_destroy(hall.stream);
        hall.stream = NULL;
    }
    stream_hall_close(&hall);
}

static void test_the_stream_ends_while_files_are_read(void **state)
{
    (void)state;
    stream_hall hall;
    stream_hall_open(&hall, NOOK_VOLUME_SURFEL);
    for (int i = 0; i < 8; i++) {
        stream_hall_start(&hall, STREAM_HALL_LEVELS, i % 2 ? (double)stream_hall_bytes(&hall) / mebibyte / 4.0 : 0.0);
        for (int frame = 0; frame < i; frame++)
            stream_hall_update(&hall);
        nook_stream_destroy(hall.stream);
        hall.stream = NULL;
    }
    stream_hall_close(&hall);
}

static void test_bodies_of_the_same_files_share_a_volume(void **state)
{
    (void)state;
    stream_hall hall;
    stream_hall_open(&hall, NOOK_VOLUME_BINARY);
    stream_hall_start(&hall, STREAM_HALL_LEVELS, 0.0);
    stream_hall_settle(&hall);
    uint64_t loads = stream_hall_status(&hall).loads;
    nook_ao_volume before = hall.volumes[4];
    stream_hall_add(&hall, 4, STREAM_HALL_LEVELS); /* as a scene that is read again */
    assert_int_equal(hall.volumes[4].id, before.id);
    nook_stream_remove(hall.stream, before); /* the scene of before */
    stream_hall_settle(&hall);
    assert_true(nook_ao_has_volume(hall.view->ao, hall.volumes[4], NOOK_VOLUME_BINARY));
    assert_true(stream_hall_status(&hall).loads == loads);
    nook_stream_remove(hall.stream, before);
    assert_false(nook_ao_has_volume(hall.view->ao, before, NOOK_VOLUME_BINARY));
    hall.view->occluders[4].volume = (nook_ao_volume){ 0 };
    stream_hall_settle(&hall);
    assert_int_equal(stream_hall_status(&hall).volumes, STREAM_HALL_BODIES - 1);
    stream_hall_close(&hall);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_with_enough_budget_the_picture_becomes_that_without_streaming_bit_for_bit),
        cmocka_unit_test(test_an_eighth_of_the_memory_is_never_exceeded_on_the_way_through_a_hall),
        cmocka_unit_test(test_what_is_seen_has_its_volumes_where_memory_is_short),
        cmocka_unit_test(test_a_smaller_budget_gives_memory_back_and_a_larger_one_brings_everything),
        cmocka_unit_test(test_uploads_of_a_frame_are_bounded_and_volumes_come_in_parts),
        cmocka_unit_test(test_parameters_outside_of_their_ranges_are_refused),
        cmocka_unit_test(test_a_camera_that_sways_makes_nothing_come_and_go),
        cmocka_unit_test(test_frames_in_which_nothing_comes_allocate_nothing),
        cmocka_unit_test(test_a_broken_file_is_one_line_and_its_body_does_without),
        cmocka_unit_test(test_a_body_whose_finest_file_is_broken_shows_a_coarser_one),
        cmocka_unit_test(test_what_may_pass_is_asked_for_again_after_pauses_that_grow),
        cmocka_unit_test(test_bodies_are_removed_while_they_are_read),
        cmocka_unit_test(test_the_stream_ends_while_files_are_read),
        cmocka_unit_test(test_bodies_of_the_same_files_share_a_volume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
