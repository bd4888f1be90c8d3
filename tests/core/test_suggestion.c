#include "engine/core/suggestion.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static void test_text_distance_counts_edits(void **state)
{
    (void)state;
    assert_int_equal(nook_text_distance("size", "size"), 0);
    assert_int_equal(nook_text_distance("size", "sise"), 1);
    assert_int_equal(nook_text_distance("", "abc"), 3);
    assert_int_equal(nook_text_distance("kitten", "sitting"), 3);
    assert_int_equal(nook_text_distance("sitting", "kitten"), 3);
    assert_int_equal(nook_text_distance("a", "0123456789012345678901234567890123456789"), 1000);
}

static void test_the_nearest_of_several_names_is_suggested_and_nothing_far_off(void **state)
{
    (void)state;
    nook_suggestion suggestion = nook_suggestion_for("lenght");
    nook_suggestion_offer(&suggestion, "window");
    assert_null(suggestion.nearest);
    nook_suggestion_offer(&suggestion, "length");
    nook_suggestion_offer(&suggestion, "width");
    assert_string_equal(suggestion.nearest, "length");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_distance_counts_edits),
        cmocka_unit_test(test_the_nearest_of_several_names_is_suggested_and_nothing_far_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
