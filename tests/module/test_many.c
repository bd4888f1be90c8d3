/* A thousand exchanges of a main module and a part: nothing is left of them. */
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/module/host.h"
#include "tests/module/counter.inl"
#include "tests/support/module_build.h"
#include "tests/support/scratch.h"
#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#ifdef __SANITIZE_ADDRESS__
enum { RELOADS = 100, WARM_UP = 20 }; /* its quarantine keeps what was freed: memory says nothing */
#else
enum { RELOADS = 1000, WARM_UP = 100 };
#endif

static const char *const folders[] = { "tests/module/", NULL };

static int32_t add_nothing(int32_t value)
{
    return value;
}

static const counter_adder adder = { add_nothing };
static const nook_module adder_module = {
    .version = NOOK_MODULE_VERSION, .name = "adder_a", .kind = "test.adder", .interface = &adder
};
static const nook_module_builtin parts[] = { { &adder_module, folders, NULL } };

/** What a process has of everything that an exchange might leave behind. */
typedef struct belongings {
    long resident_pages, mappings, descriptors, files;
} belongings;

static long count_lines(const char *path)
{
    long lines = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (int c = fgetc(file); c != EOF; c = fgetc(file))
        lines += c == '\n';
    fclose(file);
    return lines;
}

static belongings look(const char *folder)
{
    belongings have = { .mappings = count_lines("/proc/self/maps"),
                        .descriptors = module_count_files("/proc/self/fd", ""),
                        .files = module_count_files(folder, "") };
    long total;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%ld %ld", &total, &have.resident_pages), 2);
    fclose(file);
    return have;
}

static void build_variants(const char *folder, char paths[4][4200])
{
    for (int i = 0; i < 2; i++) {
        char name[32], options[128];
        snprintf(name, sizeof name, "counter_%d", i);
        snprintf(options, sizeof options, "-DCOUNTER_STEP=%d -DCOUNTER_VERSION=%d", 10 + i, i + 1);
        module_build(folder, name, "tests/module/counter_library.c", options);
        snprintf(paths[i], 4200, "%s/%s.so", folder, name);
        snprintf(name, sizeof name, "adder_%d", i);
        snprintf(options, sizeof options, "'-DADDER_NAME=\"adder_a\"' -DADDER_STEP=%d", 100 + i);
        module_build(folder, name, "tests/module/adder_library.c", options);
        snprintf(paths[2 + i], 4200, "%s/%s.so", folder, name);
    }
}

static void say_nothing(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)user, (void)level, (void)file, (void)line, (void)text;
}

/** One of three: the main module, with a state made anew as its version is another; a part; both. */
static void exchange(nook_module_host *host, const char *folder, char paths[4][4200], int i)
{
    bool running;
    if (i % 3 != 1)
        module_put(folder, "counter", paths[i & 1]);
    if (i % 3 != 0)
        module_put(folder, "adder_a", paths[2 + (i & 1)]);
    module_publish(folder, "ok");
    assert_int_equal(nook_module_host_frame(host, &running), NOOK_OK);
    assert_int_equal(nook_module_host_look(host).swaps, i + 1);
}

static void test_a_thousand_exchanges_leave_no_memory_mapping_descriptor_or_file(void **state)
{
    (void)state;
    char folder[4096], paths[4][4200], remove[8192];
    int32_t alive = 0;
    counter_arguments arguments = { 0, &alive };
    nook_module_host *host;
    nook_scratch_path(folder, sizeof folder, "live");
    snprintf(remove, sizeof remove, "rm -rf '%s'", folder);
    assert_int_equal(system(remove), 0);
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    const nook_module_host_desc desc = { .folder = folder,
                                         .main = { &counter_module, folders, NULL },
                                         .parts = parts,
                                         .part_count = NOOK_COUNT(parts),
                                         .arguments = { .user = &arguments } };
    assert_int_equal(nook_module_host_create(&desc, &host), NOOK_OK);
    build_variants(folder, paths);
    nook_log_set_sink(say_nothing, NULL);
    belongings warm = { 0 };
    for (int i = 0; i < RELOADS; i++) {
        exchange(host, folder, paths, i);
        if (i == WARM_UP)
            warm = look(folder);
    }
    belongings end = look(folder);
    nook_log_set_sink(NULL, NULL);
    printf("after %d and %d exchanges: %ld and %ld resident pages, %ld and %ld mappings, %ld and %ld descriptors, "
           "%ld and %ld files\n",
           WARM_UP + 1, RELOADS, warm.resident_pages, end.resident_pages, warm.mappings, end.mappings, warm.descriptors,
           end.descriptors, warm.files, end.files);
    assert_int_equal(end.descriptors, warm.descriptors);
    assert_int_equal(end.files, warm.files);
#ifndef __SANITIZE_ADDRESS__
    assert_in_range(end.mappings, 0, warm.mappings + 4); /* malloc's own may come and go */
    assert_in_range(end.resident_pages, 0, warm.resident_pages + 256 * 1024 / sysconf(_SC_PAGESIZE));
#endif
    assert_int_equal(alive, 1 + nook_module_host_look(host).made);
    nook_module_host_destroy(host);
    assert_int_equal(module_count_files(folder, ""), end.files - 2); /* less the copies that ran */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_thousand_exchanges_leave_no_memory_mapping_descriptor_or_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
