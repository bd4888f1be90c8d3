/* Undo and redo lie where the layout has their letters. */
#include "engine/platform/key_label_internal.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void test_undo_and_redo_are_where_the_layout_has_their_letters(void **state)
{
    (void)state;
    assert_int_equal(nook_key_by_label(NOOK_KEY_Z, true, "z"), NOOK_KEY_Z);
    assert_int_equal(nook_key_by_label(NOOK_KEY_Y, true, "z"), NOOK_KEY_Z); /* German */
    assert_int_equal(nook_key_by_label(NOOK_KEY_Z, true, "y"), NOOK_KEY_Y);
    assert_int_equal(nook_key_by_label(NOOK_KEY_W, true, "z"), NOOK_KEY_Z); /* French */
    assert_int_equal(nook_key_by_label(NOOK_KEY_Z, true, "w"), NOOK_KEY_COUNT);
    assert_int_equal(nook_key_by_label(NOOK_KEY_Y, true, "Z"), NOOK_KEY_Z);
}

static void test_keys_are_places_without_control_and_with_it_all_others(void **state)
{
    (void)state;
    assert_int_equal(nook_key_by_label(NOOK_KEY_Y, false, "z"), NOOK_KEY_Y);
    assert_int_equal(nook_key_by_label(NOOK_KEY_W, false, "z"), NOOK_KEY_W);
    assert_int_equal(nook_key_by_label(NOOK_KEY_Q, true, "a"), NOOK_KEY_Q); /* crouching, one throws */
    assert_int_equal(nook_key_by_label(NOOK_KEY_F12, true, NULL), NOOK_KEY_F12);
}

static void test_layouts_without_latin_letters_have_places(void **state)
{
    (void)state;
    assert_int_equal(nook_key_by_label(NOOK_KEY_Z, true, "\xd1\x8f"), NOOK_KEY_Z);
    assert_int_equal(nook_key_by_label(NOOK_KEY_Y, true, NULL), NOOK_KEY_Y);
    assert_int_equal(nook_key_by_label(NOOK_KEY_Z, true, ";"), NOOK_KEY_Z);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_undo_and_redo_are_where_the_layout_has_their_letters),
        cmocka_unit_test(test_keys_are_places_without_control_and_with_it_all_others),
        cmocka_unit_test(test_layouts_without_latin_letters_have_places),
    };
    return cmocka_run_group_tests_name("labels of keys", tests, NULL, NULL);
}
