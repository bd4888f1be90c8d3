/* Files that are read on a thread: what they give, and those who do not wait for them. */
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "modules/bake/voxelize.h"
#include "modules/stream/loader.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

enum { FILES = 6 };

typedef struct fixture {
    char paths[FILES][256];
    nook_volume_info infos[FILES];
    stream_loader *loader;
} fixture;

/* A triangle of another length each. */
static void write_file(fixture *self, int number)
{
    const float positions[9] = { 0.0f, 0.0f, 0.0f, 1.0f + (float)number, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f };
    const uint32_t indices[3] = { 0, 1, 2 };
    const nook_triangles triangles = {
        .positions = positions, .vertex_count = 3, .indices = indices, .index_count = 3
    };
    nook_volume volume;
    void *bytes;
    size_t size;
    char name[32];
    snprintf(name, sizeof name, "loader_%d.nkv", number);
    nook_scratch_path(self->paths[number], sizeof self->paths[number], name);
    assert_int_equal(nook_voxelize(&triangles, &(nook_voxelize_desc){ .resolution = 96, .threads = 1 }, &volume),
                     NOOK_OK);
    self->infos[number] = volume.info;
    assert_int_equal(nook_volume_encode(&volume, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_file_write(self->paths[number], bytes, size), NOOK_OK);
    free(bytes);
    nook_volume_free(&volume);
}

static int setup(void **state)
{
    fixture *self = calloc(1, sizeof *self);
    if (!self)
        return -1;
    *state = self;
    for (int i = 0; i < FILES; i++)
        write_file(self, i);
    return stream_loader_create(&self->loader) != NOOK_OK;
}

static int teardown(void **state)
{
    fixture *self = *state;
    stream_loader_destroy(self->loader);
    free(self);
    return 0;
}

static nook_result wait_for(stream_loader *loader, int job, nook_volume **out_contents)
{
    const struct timespec pause = { 0, 500 * 1000 };
    nook_result result = NOOK_OK;
    double end = nook_clock_ms() + 60000.0;
    while (!stream_loader_is_done(loader, job, &result, out_contents)) {
        assert_true(nook_clock_ms() < end);
        nanosleep(&pause, NULL);
    }
    return result;
}

static void test_files_come_decoded_and_no_more_than_a_few_at_once(void **state)
{
    fixture *self = *state;
    int jobs[LOADER_JOBS];
    for (int i = 0; i < LOADER_JOBS; i++) {
        assert_true(stream_loader_has_room(self->loader));
        jobs[i] = stream_loader_start(self->loader, self->paths[i], &self->infos[i]);
        assert_true(jobs[i] != LOADER_NONE);
    }
    assert_false(stream_loader_has_room(self->loader));
    assert_int_equal(stream_loader_start(self->loader, self->paths[4], &self->infos[4]), LOADER_NONE);
    for (int i = 0; i < LOADER_JOBS; i++) {
        nook_volume *contents;
        assert_int_equal(wait_for(self->loader, jobs[i], &contents), NOOK_OK);
        assert_true(contents->info.content_hash == self->infos[i].content_hash);
        uint64_t full = 0, voxels = (uint64_t)contents->info.width * contents->info.height * contents->info.depth;
        for (uint64_t v = 0; v < voxels; v++)
            full += contents->voxels[v] != 0;
        assert_true(full == self->infos[i].occupied);
        stream_loader_free(self->loader, jobs[i]);
    }
    assert_true(stream_loader_has_room(self->loader));
}

static void test_a_job_that_nobody_waits_for_makes_room_for_another(void **state)
{
    fixture *self = *state;
    nook_volume *contents;
    for (int round = 0; round < 60; round++) {
        int job = stream_loader_start(self->loader, self->paths[round % FILES], &self->infos[round % FILES]);
        if (job != LOADER_NONE && round % 3 == 0)
            assert_int_equal(wait_for(self->loader, job, &contents), NOOK_OK);
        if (job != LOADER_NONE)
            stream_loader_free(self->loader, job); /* before, while, or after it is read */
    }
    double end = nook_clock_ms() + 60000.0;
    int job;
    while ((job = stream_loader_start(self->loader, self->paths[1], &self->infos[1])) == LOADER_NONE)
        assert_true(nook_clock_ms() < end);
    assert_int_equal(wait_for(self->loader, job, &contents), NOOK_OK);
    assert_true(contents->info.content_hash == self->infos[1].content_hash);
}

static void test_a_file_that_is_not_what_it_was_is_refused_with_one_line(void **state)
{
    fixture *self = *state;
    nook_volume *contents;
    nook_log_capture line;
    nook_log_capture_begin(&line);
    int other = stream_loader_start(self->loader, self->paths[0], &self->infos[1]);
    assert_int_equal(wait_for(self->loader, other, &contents), NOOK_E_FORMAT);
    assert_int_equal(line.count, 1);
    assert_non_null(strstr(line.text, "another volume"));
    int missing = stream_loader_start(self->loader, "/no such folder/volume.nkv", &self->infos[1]);
    assert_int_equal(wait_for(self->loader, missing, &contents), NOOK_E_NOT_FOUND);
    assert_int_equal(line.count, 2);
    assert_null(contents->voxels);
    nook_log_capture_end();
}

static void test_a_loader_that_rests_goes_on_where_it_was(void **state)
{
    fixture *self = *state;
    nook_volume *contents;
    stream_loader_rest(self->loader);
    int job = stream_loader_start(self->loader, self->paths[2], &self->infos[2]);
    nook_result result;
    assert_false(stream_loader_is_done(self->loader, job, &result, &contents)); /* nobody reads it */
    stream_loader_rest(self->loader);
    assert_int_equal(stream_loader_wake(self->loader), NOOK_OK);
    assert_int_equal(stream_loader_wake(self->loader), NOOK_OK);
    assert_int_equal(wait_for(self->loader, job, &contents), NOOK_OK);
    assert_true(contents->info.content_hash == self->infos[2].content_hash);
}

static void test_the_loader_ends_while_it_reads(void **state)
{
    fixture *self = *state;
    for (int round = 0; round < 10; round++) {
        stream_loader *loader;
        assert_int_equal(stream_loader_create(&loader), NOOK_OK);
        for (int i = 0; i < round % (LOADER_JOBS + 1); i++)
            assert_true(stream_loader_start(loader, self->paths[i], &self->infos[i]) != LOADER_NONE);
        stream_loader_destroy(loader);
    }
    stream_loader_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files_come_decoded_and_no_more_than_a_few_at_once),
        cmocka_unit_test(test_a_job_that_nobody_waits_for_makes_room_for_another),
        cmocka_unit_test(test_a_file_that_is_not_what_it_was_is_refused_with_one_line),
        cmocka_unit_test(test_a_loader_that_rests_goes_on_where_it_was),
        cmocka_unit_test(test_the_loader_ends_while_it_reads),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
