/* What two builds know of each other's types and functions, as their debug information tells. */
#include "engine/core/file.h"
#include "engine/module/interface.h"
#include "tests/support/log_capture.h"
#include "tests/support/module_build.h"
#include "tests/support/scratch.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static const char *folder(void)
{
    static char path[4096];
    return nook_scratch_path(path, sizeof path, "interfaces");
}

static void built_path(char out[8192], const char *name)
{
    snprintf(out, 8192, "%s/%s.so", folder(), name);
}

/** Compiles a source of these declarations and reads it. */
static nook_interface *interface_of(const char *name, const char *text, const char *options)
{
    char path[8192];
    nook_interface *interface;
    assert_int_equal(nook_directory_make(folder()), NOOK_OK);
    snprintf(path, sizeof path, "%s/%s.c", folder(), name);
    assert_int_equal(nook_file_write(path, text, strlen(text)), NOOK_OK);
    module_build(folder(), name, path, options);
    built_path(path, name);
    assert_int_equal(nook_interface_read(path, &interface), NOOK_OK);
    return interface;
}

static const char plain[] =
    "struct nook_inner { int a; float b[3]; };"
    "enum nook_kind { ONE, TWO };"
    "typedef struct nook_thing { struct nook_inner inner; struct nook_inner *link; enum nook_kind kind;"
    "    int (*call)(struct nook_inner *, long); unsigned flag : 3; } nook_thing;"
    "typedef struct { int x; } nook_nameless;"
    "double nook_helper(const nook_thing *thing, int count);"
    "nook_nameless nameless; struct local { int a; } one; nook_thing all;"
    "double use(void) { return nook_helper(&all, 1) + all.link->b[1]; }";

/** The plain text with one part of it written otherwise; the name that differs then, or NULL. */
static const char *difference(const char *part, const char *otherwise, unsigned scope)
{
    static char name[64];
    char text[2048];
    const char *at = strstr(plain, part);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - plain), plain, otherwise, at + strlen(part));
    nook_interface *before = interface_of("before", plain, ""), *after = interface_of("after", text, "");
    const nook_interface_view earlier = { before, NULL, NULL }, later = { after, NULL, NULL };
    const char *found = nook_interface_difference(&earlier, &later, scope);
    snprintf(name, sizeof name, "%s", found ? found : "");
    nook_interface_free(before);
    nook_interface_free(after);
    return found ? name : NULL;
}

enum {
    TYPES = NOOK_INTERFACE_PUBLIC_TYPES,
    ALL = NOOK_INTERFACE_ALL_TYPES | NOOK_INTERFACE_FUNCTIONS,
    FUNCTIONS = NOOK_INTERFACE_FUNCTIONS
};

static void test_the_same_text_has_no_difference(void **state)
{
    (void)state;
    assert_null(difference("int a;", "int a;", ALL));
    assert_null(
        difference("const nook_thing *thing, int count", "const struct nook_thing *other, const int number", ALL));
    assert_null(difference("double use", "static int more; extern int *where; int *where = &more; double use", ALL));
}

static void test_what_lies_otherwise_in_memory_differs(void **state)
{
    (void)state;
    assert_string_equal(difference("enum nook_kind kind;", "enum nook_kind kind; char more;", TYPES), "nook_thing");
    assert_string_equal(difference("struct nook_inner *link; enum nook_kind kind;",
                                   "enum nook_kind kind; struct nook_inner *link;", TYPES),
                        "nook_thing"); /* of the same size */
    assert_string_equal(difference("flag : 3", "flag : 4", TYPES), "nook_thing");
    assert_string_equal(difference("int x;", "float x;", TYPES), "nook_nameless");
    assert_non_null(difference("ONE, TWO", "TWO, ONE", TYPES)); /* nook_kind, or the thing that is of one */
    assert_string_equal(difference("*, long)", "*, int)", TYPES), "nook_thing");
    assert_non_null(difference("float b[3]", "float b[4]", TYPES)); /* nook_inner, or the thing that holds one */
}

static void test_a_function_that_takes_or_gives_something_else_differs(void **state)
{
    (void)state;
    assert_string_equal(difference("int count)", "long count)", FUNCTIONS), "nook_helper");
    assert_string_equal(difference("const nook_thing *thing", "const void *thing", FUNCTIONS), "nook_helper");
    assert_string_equal(difference("double nook_helper", "float nook_helper", FUNCTIONS), "nook_helper");
    assert_string_equal(difference("int count)", "int count, ...)", FUNCTIONS), "nook_helper");
    assert_null(difference("int a; } one", "long a; } one", FUNCTIONS));
}

static void test_types_of_one_file_count_only_when_all_are_asked_for(void **state)
{
    (void)state;
    assert_null(difference("int a; } one", "long a; } one", TYPES));
    assert_string_equal(difference("int a; } one", "long a; } one", ALL), "local");
}

static void test_a_name_that_only_one_knows_is_no_difference(void **state)
{
    (void)state;
    assert_null(difference("nook_nameless;", "nook_other; typedef nook_other nook_nameless;", TYPES));
}

static void test_dwarf_4_tells_the_same_as_dwarf_5(void **state)
{
    (void)state;
    static const char text[] =
        "struct nook_inner { int a; float b[3]; } inner; enum nook_kind { ONE, TWO } kind;"
        "double nook_helper(struct nook_inner *, long); double use(void) { return nook_helper(&inner, kind); }";
    nook_interface *four = interface_of("four", text, "-gdwarf-4"), *five = interface_of("five", text, "-gdwarf-5");
    const nook_interface_view earlier = { four, NULL, NULL }, later = { five, NULL, NULL };
    assert_null(nook_interface_difference(&earlier, &later, ALL));
    assert_null(nook_interface_difference(&later, &earlier, ALL));
    nook_interface_free(four);
    nook_interface_free(five);
}

static void test_a_view_sees_the_folders_it_was_given(void **state)
{
    (void)state;
    static const char *const engine[] = { "engine/", NULL }, *const core[] = { "engine/core/", NULL };
    nook_interface *program,
        *other = interface_of("view", "struct nook_file { int size; } f; struct nook_dwarf_unit { int a; } u;", "");
    assert_int_equal(nook_interface_read("/proc/self/exe", &program), NOOK_OK);
    const nook_interface_view all = { other, NULL, NULL };
    const nook_interface_view views[] = { { program, engine, NULL },
                                          { program, core, NULL },
                                          { program, engine, core } };
    assert_non_null(nook_interface_difference(&views[0], &all, TYPES));
    assert_string_equal(nook_interface_difference(&views[1], &all, TYPES), "nook_file");
    nook_interface_free(other);
    other = interface_of("view", "struct nook_dwarf_unit { int a; } u;", "");
    const nook_interface_view unit = { other, NULL, NULL };
    assert_null(nook_interface_difference(&views[1], &unit, TYPES));
    assert_string_equal(nook_interface_difference(&views[2], &unit, TYPES), "nook_dwarf_unit");
    nook_interface_free(other);
    nook_interface_free(program);
}

static void test_files_that_tell_nothing_are_refused(void **state)
{
    (void)state;
    nook_log_capture log;
    char path[8192];
    nook_interface *interface;
    assert_int_equal(nook_directory_make(folder()), NOOK_OK);
    module_build(folder(), "silent", "tests/module/adder_library.c", "-g0 '-DADDER_NAME=\"a\"' -DADDER_STEP=1");
    nook_log_capture_begin(&log);
    built_path(path, "silent");
    assert_int_equal(nook_interface_read(path, &interface), NOOK_E_VERSION);
    assert_non_null(strstr(log.text, "build it with -g"));
    assert_null(interface);
    built_path(path, "missing");
    assert_int_equal(nook_interface_read(path, &interface), NOOK_E_NOT_FOUND);
    snprintf(path, sizeof path, "%s/silent.txt", folder());
    assert_int_equal(nook_file_write(path, "\177ELF and so on", 13), NOOK_OK);
    assert_int_equal(nook_interface_read(path, &interface), NOOK_E_FORMAT);
    nook_log_capture_end();
}

/** Damaged as a disk or a linker that was stopped may leave them: refused or read, never read outside. */
static void test_damaged_files_are_refused_or_read_but_do_no_harm(void **state)
{
    (void)state;
    nook_log_capture log;
    char path[8192];
    nook_file file;
    uint32_t random = 1;
    int refused = 0;
    nook_interface_free(interface_of("whole", plain, ""));
    built_path(path, "whole");
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    built_path(path, "damaged");
    nook_log_capture_begin(&log);
    for (int i = 0; i < 300; i++) {
        uint8_t *bytes = malloc(file.size);
        nook_interface *interface;
        size_t size = i % 3 == 0 ? file.size * (size_t)i / 300 : file.size;
        assert_non_null(bytes);
        memcpy(bytes, file.bytes, file.size);
        for (int k = 0; k < 200 && i % 3 != 0; k++) {
            random = random * 1664525u + 1013904223u;
            bytes[random % (i % 3 == 1 ? 64 : size)] = (uint8_t)(random >> 24);
        }
        assert_int_equal(nook_file_write(path, bytes, size), NOOK_OK);
        refused += nook_interface_read(path, &interface) != NOOK_OK;
        nook_interface_free(interface);
        free(bytes);
    }
    nook_log_capture_end();
    nook_file_free(&file);
    assert_true(refused > 150);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_same_text_has_no_difference),
        cmocka_unit_test(test_what_lies_otherwise_in_memory_differs),
        cmocka_unit_test(test_a_function_that_takes_or_gives_something_else_differs),
        cmocka_unit_test(test_types_of_one_file_count_only_when_all_are_asked_for),
        cmocka_unit_test(test_a_name_that_only_one_knows_is_no_difference),
        cmocka_unit_test(test_dwarf_4_tells_the_same_as_dwarf_5),
        cmocka_unit_test(test_a_view_sees_the_folders_it_was_given),
        cmocka_unit_test(test_files_that_tell_nothing_are_refused),
        cmocka_unit_test(test_damaged_files_are_refused_or_read_but_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
