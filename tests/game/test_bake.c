#include "engine/core/file.h"
#include "game/commands/commands.h"
#include "game/volume_levels.h"
#include "tests/support/log_capture.h"
#include "tests/support/scratch.h"
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

/* One triangle, (0,0,0) (1,0,0) (0,1,0), drawn by one node. */
static const char scene_text[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,"
    "1,0]}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

typedef struct bench {
    char scene[512], cache[512];
    nook_log_capture log;
} bench;

/* Visits the cache's entries. @return how many there were */
static int count_cache(const bench *b, bool remove_them)
{
    int count = 0;
    DIR *directory = opendir(b->cache);
    for (struct dirent *entry; directory && (entry = readdir(directory));) {
        char path[1024];
        if (entry->d_name[0] == '.')
            continue;
        count++;
        if (remove_them)
            remove(nook_path_join(path, sizeof path, b->cache, entry->d_name));
    }
    if (directory)
        closedir(directory);
    return count;
}

static void prepare(bench *b)
{
    nook_scratch_path(b->scene, sizeof b->scene, "bake.gltf");
    nook_scratch_path(b->cache, sizeof b->cache, "bake_cache");
    count_cache(b, true);
    assert_int_equal(nook_file_write(b->scene, scene_text, sizeof scene_text - 1), NOOK_OK);
}

static void clear(bench *b)
{
    count_cache(b, true);
    rmdir(b->cache);
    remove(b->scene);
}

static int run(bench *b, int argc, char **argv)
{
    const nook_app app = { .root = "." };
    nook_log_capture_begin(&b->log);
    int exit_code = nook_command_bake(&app, argc, argv);
    nook_log_capture_end();
    return exit_code;
}

static void test_bake_fills_the_cache_and_finds_it_again(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    char *argv[] = { "bake", b.scene, "--cache", b.cache, "--resolution", "20", "--threads", "1", NULL };
    assert_int_equal(run(&b, 8, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 1);
    assert_null(strstr(b.log.text, "from the cache"));
    assert_int_equal(run(&b, 8, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 1);
    assert_non_null(strstr(b.log.text, "20 voxels a side"));
    assert_non_null(strstr(b.log.text, "from the cache"));
    clear(&b);
}

static void test_bake_makes_the_kinds_that_are_asked_for(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    char kinds[32] = "surfel", *argv[] = { "bake", b.scene, "--cache", b.cache, "--kinds", kinds, NULL };
    assert_int_equal(run(&b, 6, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 1);
    snprintf(kinds, sizeof kinds, "binary,surfel");
    assert_int_equal(run(&b, 6, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 2);
    assert_null(strstr(b.log.text, "from the cache")); /* not all of it */
    const char *wrong[] = { "binary,voxel", "binaries", "bin", ",", "" };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        snprintf(kinds, sizeof kinds, "%s", wrong[i]);
        assert_int_equal(run(&b, 6, argv), NOOK_EXIT_USAGE);
    }
    clear(&b);
}

static void test_several_resolutions_are_levels_of_the_largest(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    char numbers[64] = "64", *argv[] = { "bake",      b.scene, "--cache",      b.cache, "--kinds", "surfel,binary",
                                         "--threads", "1",     "--resolution", numbers, NULL };
    assert_int_equal(run(&b, 10, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 2);
    snprintf(numbers, sizeof numbers, "32,64,16");
    assert_int_equal(run(&b, 10, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 6); /* the finest are those that were there */
    assert_int_equal(run(&b, 10, argv), NOOK_EXIT_OK);
    snprintf(numbers, sizeof numbers, "64,16,8"); /* of 8 voxels nobody has a use */
    assert_int_equal(run(&b, 10, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 6);
    snprintf(numbers, sizeof numbers, "32"); /* a surfel volume of its own is another one than a level */
    assert_int_equal(run(&b, 10, argv), NOOK_EXIT_OK);
    assert_int_equal(count_cache(&b, false), 7);
    clear(&b);
}

static void test_resolutions_that_do_not_nest_are_refused(void **state)
{
    (void)state;
    nook_resolutions levels = { 7, 7 };
    static const char *const wrong[] = { "64,33", "64,64",  "64,4",     "512,256,128,64,32",
                                         "64,",   ",64",    "64,32,64", "1024,512",
                                         "64 32", "64,-32", "64,0",     "" };
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++)
        assert_false(nook_resolutions_read(wrong[i], &levels));
    assert_true(levels.resolution == 7 && levels.levels == 7);
    static const struct {
        const char *text;
        uint32_t resolution, levels;
    } right[] = {
        { "512,256,128,64", 512, 15 }, { "64,512", 512, 9 }, { "37,19", 37, 3 }, { "5,37,10", 37, 13 }, { "1", 1, 1 }
    };
    for (size_t i = 0; i < NOOK_COUNT(right); i++) {
        assert_true(nook_resolutions_read(right[i].text, &levels));
        assert_int_equal(levels.resolution, right[i].resolution);
        assert_int_equal(levels.levels, right[i].levels);
    }
}

static void test_bake_fails_when_its_volumes_cannot_be_kept(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    char inside_a_file[600], *cannot_be_made[] = { "bake", b.scene, "--cache", inside_a_file, NULL };
    nook_path_join(inside_a_file, sizeof inside_a_file, b.scene, "cache");
    assert_int_equal(run(&b, 4, cannot_be_made), NOOK_EXIT_FAILED);
    assert_int_equal(b.log.count, 1);
    assert_non_null(strstr(b.log.text, inside_a_file));
    char *levels_cannot[] = { "bake", b.scene, "--cache", inside_a_file, "--resolution", "32,16", NULL };
    assert_int_equal(run(&b, 6, levels_cannot), NOOK_EXIT_FAILED);
    assert_int_equal(b.log.count, 1);
    clear(&b);
}

static void test_bake_fails_when_a_directory_stands_where_a_volume_belongs(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    char *argv[] = { "bake", b.scene, "--cache", b.cache, "--resolution", "20", NULL }, volume[1024] = "";
    assert_int_equal(run(&b, 6, argv), NOOK_EXIT_OK);
    DIR *directory = opendir(b.cache);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (entry->d_name[0] != '.')
            nook_path_join(volume, sizeof volume, b.cache, entry->d_name);
    }
    closedir(directory);
    assert_int_equal(remove(volume), 0);
    assert_int_equal(mkdir(volume, 0700), 0);
    assert_int_equal(run(&b, 6, argv), NOOK_EXIT_FAILED);
    assert_int_equal(b.log.count, 1);
    assert_int_equal(b.log.errors, 1);
    assert_non_null(strstr(b.log.text, b.cache));
    clear(&b);
}

static void test_scene_without_area_has_nothing_to_bake(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    char line[sizeof scene_text], *corner = memcpy(line, scene_text, sizeof line);
    while ((corner = strstr(corner, "gD8")))
        memcpy(corner, "AAA", 3); /* its coordinates of 1 become 0 */
    assert_int_equal(nook_file_write(b.scene, line, sizeof line - 1), NOOK_OK);
    assert_int_equal(run(&b, 4, (char *[]){ "bake", b.scene, "--cache", b.cache, NULL }), NOOK_EXIT_OK);
    assert_non_null(strstr(b.log.text, "there is nothing to bake"));
    assert_int_equal(count_cache(&b, false), 0);
    clear(&b);
}

static void test_bake_fails_on_a_scene_that_does_not_load(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    assert_int_equal(run(&b, 4, (char *[]){ "bake", "no such scene.glb", "--cache", b.cache, NULL }), NOOK_EXIT_FAILED);
    assert_int_equal(b.log.count, 1);
    assert_int_equal(run(&b, 4, (char *[]){ "bake", ".", "--cache", b.cache, NULL }), NOOK_EXIT_FAILED);
    assert_int_equal(count_cache(&b, false), 0);
    clear(&b);
}

static void test_bake_refuses_absurd_options(void **state)
{
    (void)state;
    bench b;
    prepare(&b);
    static char *const wrong[][2] = { { "--resolution", "0" },    { "--resolution", "513" },   { "--resolution", "-5" },
                                      { "--resolution", "many" }, { "--resolution", "64,40" }, { "--r-max", "0" },
                                      { "--r-max", "-1" },        { "--r-max", "nan" },        { "--threads", "-1" },
                                      { "--cache", "" } };
    for (size_t i = 0; i < NOOK_COUNT(wrong); i++)
        assert_int_equal(run(&b, 4, (char *[]){ "bake", b.scene, wrong[i][0], wrong[i][1], NULL }), NOOK_EXIT_USAGE);
    assert_int_equal(run(&b, 1, (char *[]){ "bake", NULL }), NOOK_EXIT_USAGE);
    assert_int_equal(run(&b, 3, (char *[]){ "bake", b.scene, b.scene, NULL }), NOOK_EXIT_USAGE);
    clear(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bake_fills_the_cache_and_finds_it_again),
        cmocka_unit_test(test_bake_makes_the_kinds_that_are_asked_for),
        cmocka_unit_test(test_several_resolutions_are_levels_of_the_largest),
        cmocka_unit_test(test_resolutions_that_do_not_nest_are_refused),
        cmocka_unit_test(test_bake_fails_when_its_volumes_cannot_be_kept),
        cmocka_unit_test(test_bake_fails_when_a_directory_stands_where_a_volume_belongs),
        cmocka_unit_test(test_scene_without_area_has_nothing_to_bake),
        cmocka_unit_test(test_bake_fails_on_a_scene_that_does_not_load),
        cmocka_unit_test(test_bake_refuses_absurd_options),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
