/* Shared libraries of code. */
#include "engine/core/file.h"
#include "engine/platform/library.h"
#include "tests/support/module_build.h"
#include "tests/support/scratch.h"
#include <stdio.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

typedef int (*answer_function)(void);

/** A library whose function `answer` returns that expression. */
static void build(char path[8192], const char *name, const char *expression)
{
    char folder[4096], source[8192], text[512];
    nook_scratch_path(folder, sizeof folder, "libraries");
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
    snprintf(source, sizeof source, "%s/%s.c", folder, name);
    int length = snprintf(text, sizeof text,
                          "int elsewhere(void);\nint answer(void);\nint answer(void) { return %s; }\n", expression);
    assert_int_equal(nook_file_write(source, text, (size_t)length), NOOK_OK);
    module_build(folder, name, source, "");
    snprintf(path, 8192, "%s/%s.so", folder, name);
}

static void test_a_function_of_a_library_can_be_called(void **state)
{
    (void)state;
    char path[8192];
    nook_library_reason reason;
    nook_library *library;
    build(path, "good", "42");
    assert_int_equal(nook_library_open(path, &reason, &library), NOOK_OK);
    nook_library_function found = nook_library_find(library, "answer");
    assert_non_null(found);
    assert_int_equal(((answer_function)found)(), 42);
    const void *address;
    memcpy(&address, &found, sizeof address);
    assert_true(nook_library_holds(library, address));
    assert_false(nook_library_holds(library, &reason));
    assert_false(nook_library_holds(library, NULL));
    assert_true(nook_library_find(library, "question") == NULL);
    nook_library_close(library);
    nook_library_close(NULL);
}

static void test_what_cannot_be_loaded_says_why(void **state)
{
    (void)state;
    char path[8192];
    nook_library_reason reason;
    nook_library *library = (nook_library *)&reason;
    assert_int_equal(nook_library_open("nowhere/at_all.so", &reason, &library), NOOK_E_NOT_FOUND);
    assert_string_equal(reason.text, "nowhere/at_all.so: no such file");
    assert_null(library);
    build(path, "lacks", "elsewhere()");
    assert_int_equal(nook_library_open(path, &reason, &library), NOOK_E_FORMAT);
    assert_non_null(strstr(reason.text, "elsewhere"));
    nook_scratch_path(path, sizeof path, "text.so");
    assert_int_equal(nook_file_write(path, "text", 4), NOOK_OK);
    assert_int_equal(nook_library_open(path, &reason, &library), NOOK_E_FORMAT);
    assert_null(library);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_function_of_a_library_can_be_called),
        cmocka_unit_test(test_what_cannot_be_loaded_says_why),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
