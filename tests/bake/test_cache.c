#include "engine/core/file.h"
#include "engine/core/log.h"
#include "modules/bake/cache.h"
#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct lines {
    int warnings, errors;
} lines;

static void count_lines(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    lines *l = user;
    (void)file, (void)line, (void)text;
    l->warnings += level == NOOK_LOG_WARNING;
    l->errors += level == NOOK_LOG_ERROR;
}

static const float points[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
static const uint32_t indices[12] = { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
static const nook_triangles tetrahedron = { points[0], 0, 4, indices, 12 };
static const nook_voxelize_desc desc = { .resolution = 24, .threads = 1 };

typedef struct folder {
    char path[64], file[128]; /* of the cache, and of the tetrahedron's volume in it */
    lines said;
} folder;

static int set_up(void **state)
{
    folder *f = calloc(1, sizeof *f);
    snprintf(f->path, sizeof f->path, "/tmp/nook_test_cache_XXXXXX");
    if (!mkdtemp(f->path))
        return -1;
    snprintf(f->file, sizeof f->file, "%s/%016" PRIx64 ".nkv", f->path, nook_voxelize_hash(&tetrahedron, &desc));
    nook_log_set_sink(count_lines, &f->said);
    *state = f;
    return 0;
}

/* Empties the folder. @return how many entries it had */
static int empty_folder(const char *path)
{
    int count = 0;
    DIR *directory = opendir(path);
    for (struct dirent *entry; directory && (entry = readdir(directory));) {
        char name[512];
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        remove(name);
        count++;
    }
    if (directory)
        closedir(directory);
    return count;
}

static int tear_down(void **state)
{
    folder *f = *state;
    nook_log_set_sink(NULL, NULL);
    chmod(f->path, 0700);
    empty_folder(f->path);
    rmdir(f->path);
    free(f);
    return 0;
}

static nook_bake bake(const char *cache)
{
    nook_bake result = { 0 };
    assert_int_equal(nook_bake_cached(cache, "tetrahedron", &tetrahedron, &desc, &result), NOOK_OK);
    assert_true(result.ms >= 0.0);
    nook_volume volume;
    assert_int_equal(nook_volume_decode("tetrahedron", result.bytes, result.size, &volume), NOOK_OK);
    assert_memory_equal(&volume.info, &result.info, sizeof volume.info);
    nook_volume_free(&volume);
    return result;
}

/* Bakes, expects whether that is a hit, and that the bytes are those of a bake without a cache. */
static void assert_bake(const char *cache, bool hit)
{
    nook_bake plain = bake(NULL), cached = bake(cache);
    assert_false(plain.cache_hit);
    assert_int_equal(cached.cache_hit, hit);
    assert_int_equal(cached.keep_error, 0);
    assert_int_equal(cached.size, plain.size);
    assert_memory_equal(cached.bytes, plain.bytes, plain.size);
    nook_bake_free(&plain);
    nook_bake_free(&cached);
}

static void test_second_bake_is_a_cache_hit(void **state)
{
    folder *f = *state;
    assert_bake(f->path, false);
    assert_true(nook_file_exists(f->file));
    assert_bake(f->path, true);
    assert_int_equal(f->said.warnings + f->said.errors, 0);
    assert_int_equal(empty_folder(f->path), 1);
}

static void test_cache_folder_is_made(void **state)
{
    folder *f = *state;
    char deep[96];
    snprintf(deep, sizeof deep, "%s/a", f->path);
    assert_bake(deep, false);
    assert_bake(deep, true);
    assert_int_equal(empty_folder(deep), 1);
}

static void test_other_resolution_is_another_file(void **state)
{
    folder *f = *state;
    assert_bake(f->path, false);
    nook_voxelize_desc finer = { .resolution = 25, .threads = 1 };
    nook_bake other;
    assert_int_equal(nook_bake_cached(f->path, "finer", &tetrahedron, &finer, &other), NOOK_OK);
    assert_false(other.cache_hit);
    assert_int_equal(other.info.width, 27);
    nook_bake_free(&other);
    assert_int_equal(empty_folder(f->path), 2);
}

static void write_instead(const folder *f, const void *bytes, size_t size)
{
    assert_int_equal(nook_file_write(f->file, bytes, size), NOOK_OK);
}

static void test_truncated_file_is_baked_again(void **state)
{
    folder *f = *state;
    nook_bake sound = bake(f->path);
    const size_t sizes[] = { 0, 1, 50, 96, sound.size / 2, sound.size - 1 };
    for (size_t i = 0; i < NOOK_COUNT(sizes); i++) {
        write_instead(f, sound.bytes, sizes[i]);
        f->said = (lines){ 0 };
        assert_bake(f->path, false);
        assert_int_equal(f->said.warnings, 1);
        assert_int_equal(f->said.errors, 1);
        assert_bake(f->path, true);
    }
    nook_bake_free(&sound);
}

static void test_damaged_file_is_baked_again(void **state)
{
    folder *f = *state;
    nook_bake sound = bake(f->path);
    ((uint8_t *)sound.bytes)[sound.size - 3] ^= 0x10;
    write_instead(f, sound.bytes, sound.size);
    nook_bake_free(&sound);
    assert_bake(f->path, false);
    assert_int_equal(f->said.warnings, 1);
    assert_bake(f->path, true);
}

static void test_other_meshs_volume_under_this_name_is_baked_again(void **state)
{
    folder *f = *state;
    nook_triangles less = tetrahedron;
    less.index_count = 9;
    nook_bake stale;
    assert_int_equal(nook_bake_cached(NULL, "stale", &less, &desc, &stale), NOOK_OK);
    write_instead(f, stale.bytes, stale.size);
    nook_bake_free(&stale);
    assert_bake(f->path, false);
    assert_int_equal(f->said.warnings, 1);
    assert_bake(f->path, true);
}

static void assert_not_kept(const char *cache, int reason)
{
    nook_bake made = bake(cache);
    assert_false(made.cache_hit);
    assert_int_equal(made.keep_error, reason);
    nook_bake_free(&made);
}

static void test_cache_that_cannot_be_written_is_done_without(void **state)
{
    folder *f = *state;
    char a_file[96], inside_a_file[128];
    snprintf(a_file, sizeof a_file, "%s/file", f->path);
    snprintf(inside_a_file, sizeof inside_a_file, "%s/cache", a_file);
    assert_int_equal(nook_file_write(a_file, "x", 1), NOOK_OK);
    assert_not_kept(inside_a_file, ENOTDIR);

    /* A directory where the file should be. */
    assert_int_equal(mkdir(f->file, 0700), 0);
    assert_not_kept(f->path, EISDIR);
    assert_int_equal(f->said.warnings + f->said.errors, 0); /* one line for all is the caller's to say */
}

static void test_processes_that_bake_at_once_do_no_harm(void **state)
{
    folder *f = *state;
    pid_t children[4];
    for (size_t i = 0; i < NOOK_COUNT(children); i++) {
        children[i] = fork();
        if (children[i] == 0) {
            for (uint32_t turn = 0; turn < 20; turn++) {
                nook_voxelize_desc shared = { .resolution = desc.resolution + turn, .threads = 1 };
                nook_bake result;
                if (nook_bake_cached(f->path, "child", &tetrahedron, &shared, &result) != NOOK_OK)
                    _exit(1);
                nook_bake_free(&result);
            }
            _exit(f->said.errors + f->said.warnings > 0 ? 2 : 0);
        }
        assert_true(children[i] > 0);
    }
    for (size_t i = 0; i < NOOK_COUNT(children); i++) {
        int status;
        assert_int_equal(waitpid(children[i], &status, 0), children[i]);
        assert_int_equal(status, 0);
    }
    assert_bake(f->path, true);
    assert_int_equal(empty_folder(f->path), 20);
}

static void test_failing_bake_fails_and_leaves_nothing(void **state)
{
    folder *f = *state;
    const nook_voxelize_desc wrong = { .resolution = 100000 };
    nook_bake untouched = { .bytes = f };
    assert_int_equal(nook_bake_cached(f->path, "wrong", &tetrahedron, &wrong, &untouched), NOOK_E_RANGE);
    nook_triangles broken = tetrahedron;
    broken.positions = NULL;
    assert_int_equal(nook_bake_cached(f->path, "broken", &broken, &desc, &untouched), NOOK_E_ARG);
    assert_ptr_equal(untouched.bytes, f);
    assert_int_equal(f->said.errors, 2);
    assert_int_equal(empty_folder(f->path), 0);
    nook_bake_free(NULL);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

static void test_both_kinds_of_a_mesh_stand_side_by_side(void **state)
{
    const folder *f = *state;
    nook_voxelize_desc surfels = desc;
    surfels.kind = NOOK_VOLUME_SURFEL;
    assert_true(nook_voxelize_hash(&tetrahedron, &surfels) != nook_voxelize_hash(&tetrahedron, &desc));
    for (int round = 0; round < 2; round++) {
        nook_bake binary = { 0 }, bricks = { 0 };
        assert_int_equal(nook_bake_cached(f->path, "tetrahedron", &tetrahedron, &desc, &binary), NOOK_OK);
        assert_int_equal(nook_bake_cached(f->path, "tetrahedron", &tetrahedron, &surfels, &bricks), NOOK_OK);
        assert_int_equal(binary.info.kind, NOOK_VOLUME_BINARY);
        assert_int_equal(bricks.info.kind, NOOK_VOLUME_SURFEL);
        assert_int_equal(binary.cache_hit, round == 1);
        assert_int_equal(bricks.cache_hit, round == 1);
        nook_bake_free(&binary);
        nook_bake_free(&bricks);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(test_second_bake_is_a_cache_hit),
        IN_FOLDER(test_cache_folder_is_made),
        IN_FOLDER(test_other_resolution_is_another_file),
        IN_FOLDER(test_both_kinds_of_a_mesh_stand_side_by_side),
        IN_FOLDER(test_truncated_file_is_baked_again),
        IN_FOLDER(test_damaged_file_is_baked_again),
        IN_FOLDER(test_other_meshs_volume_under_this_name_is_baked_again),
        IN_FOLDER(test_cache_that_cannot_be_written_is_done_without),
        IN_FOLDER(test_processes_that_bake_at_once_do_no_harm),
        IN_FOLDER(test_failing_bake_fails_and_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
