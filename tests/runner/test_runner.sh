#!/usr/bin/env bash
# ./nook on a small tree of its own, in a folder whose name has spaces: what is built after what was changed.
nook_root=${NOOK_ROOT:-$PWD}
cd "$nook_root" || exit 1
source tests/support/shell.sh
tree="${NOOK_TEST_TMP:-/tmp}/a tree of its own"
unset NOOK_SHARED

new_tree() {
    rm -rf "$tree"
    mkdir -p "$tree"/{engine/core/deep,modules,game/commands,tests/core,shaders}
    cp "$nook_root"/{nook,premake5.lua,packages.txt} "$tree"
    cp "$nook_root/game/commands/commands.def" "$tree/game/commands"
    cp "$nook_root/tests/leaks.txt" "$tree/tests"
    cd "$tree"
    echo 'int answer(void);' >engine/core/answer.h
    write_answer engine/core/answer.c 42
    printf '#include "engine/core/answer.h"\n#include <stdio.h>\nint main(void) { printf("%%d\\n", answer()); return 0; }\n' >game/main.c
}

write_answer() { # FILE EXPRESSION
    printf '#include "engine/core/answer.h"\nint answer(void) { return %s; }\n' "$2" >"$1"
}

write_test() { # SUBJECT CHECK: a program of two test functions, the check in the second
    printf '%s\n' '#include "engine/core/answer.h"' '#include <stdarg.h>' '#include <stddef.h>' '#include <stdlib.h>' \
        '#include <setjmp.h>' '#include <stdint.h>' '#include <cmocka.h>' \
        'static void test_answer(void **state) { (void)state; '"$2"'; }' \
        'static void test_other(void **state) { (void)state; }' \
        'int main(void) { const struct CMUnitTest tests[] = { cmocka_unit_test(test_other), cmocka_unit_test(test_answer) };' \
        '  return cmocka_run_group_tests(tests, NULL, NULL); }' >"tests/core/test_$1.c"
}

test_first_run_builds_and_runs_the_program_from_any_folder() {
    new_tree
    cd /
    [ "$("$tree/nook" 2>/dev/null)" = 42 ]
}

test_a_changed_source_and_a_changed_header_are_rebuilt() {
    new_tree
    [ "$(./nook)" = 42 ]
    write_answer engine/core/answer.c 43
    [ "$(./nook)" = 43 ]
    printf '#define ANSWER 44\nint answer(void);\n' >engine/core/answer.h
    write_answer engine/core/answer.c ANSWER
    [ "$(./nook)" = 44 ]
    printf '#define ANSWER 45\nint answer(void);\n' >engine/core/answer.h
    [ "$(./nook)" = 45 ]
}

test_the_game_and_benches_of_its_frames_ask_for_huge_pages_and_other_commands_do_not() {
    new_tree
    unset GLIBC_TUNABLES
    printf '%s\n' '#include <stdio.h>' '#include <stdlib.h>' \
        'int main(void) { const char *text = getenv("GLIBC_TUNABLES"); puts(text ? text : "none"); return 0; }' >game/main.c
    [ "$(./nook play)" = glibc.malloc.hugetlb=1 ]
    [ "$(./nook bench frame)" = glibc.malloc.hugetlb=1 ]
    [ "$(./nook bench play)" = glibc.malloc.hugetlb=1 ]
    [ "$(./nook bench ecs)" = none ]
    [ "$(./nook)" = none ]
    [ "$(GLIBC_TUNABLES=glibc.malloc.hugetlb=0 ./nook play)" = glibc.malloc.hugetlb=1:glibc.malloc.hugetlb=0 ]
}

test_a_second_run_builds_nothing() {
    new_tree
    ./nook
    touch "$NOOK_TEST_TMP/between"
    [ -z "$(./nook 2>&1 >/dev/null)" ]
    [ -z "$(find build -name '*.[oa]' -newer "$NOOK_TEST_TMP/between")" ]
}

test_a_removed_source_is_gone_from_the_program() {
    new_tree
    printf 'int extra(void);\nint extra(void) { return 1; }\n' >engine/core/extra.c
    printf 'int extra(void);\nint main(void) { return extra() - 1; }\n' >game/main.c
    ./nook
    rm engine/core/extra.c
    assert_holds "$(assert_fails 1 ./nook)" 'undefined reference'
}

test_an_added_and_a_moved_source_are_built() {
    new_tree
    ./nook
    mv engine/core/answer.c engine/core/deep/answer.c
    [ "$(./nook)" = 42 ]
    rm engine/core/deep/answer.c
    write_answer engine/core/other.c 7
    [ "$(./nook)" = 7 ]
}

test_changed_flags_rebuild_every_object() {
    new_tree
    write_answer engine/core/answer.c 'sizeof(ANSWER)'
    sed -i 's/defines { /&"ANSWER=char", /' premake5.lua
    [ "$(./nook)" = 1 ]
    sed -i 's/ANSWER=char/ANSWER=int/' premake5.lua
    [ "$(./nook)" = 4 ]
}

test_a_compiler_error_is_shown_and_stops() {
    new_tree
    write_answer engine/core/answer.c 'undeclared_name'
    local said
    said=$(assert_fails 1 ./nook)
    assert_holds "$said" 'answer.c:2:'
    assert_holds "$said" 'undeclared_name'
    assert_holds "$said" 'nook: the build failed'
    write_answer engine/core/answer.c 42
    [ "$(./nook)" = 42 ]
}

test_two_sources_of_one_name_in_one_library_are_refused() {
    new_tree
    printf 'int twin(void);\nint twin(void) { return 1; }\n' >engine/core/deep/answer.c
    assert_holds "$(assert_fails 1 ./nook)" 'need different names'
}

test_compile_commands_list_every_source_once() {
    new_tree
    ./nook
    [ "$(grep -c '"file"' compile_commands.json)" = 2 ]
    assert_holds "$(cat compile_commands.json)" "\"directory\": \"$tree/build/release\""
}

test_a_passing_run_of_tests_ends_with_its_counts() {
    new_tree
    write_test good 'assert_int_equal(answer(), 42)'
    [ "$(./nook test 2>/dev/null | tail -n 1)" = '2 passed, 0 failed' ]
}

test_a_failing_test_is_shown_and_counted() {
    new_tree
    write_test good 'assert_int_equal(answer(), 42)'
    write_test bad 'assert_int_equal(answer(), 43)'
    local said
    said=$(assert_fails 1 ./nook test)
    assert_holds "$said" '0x2a != 0x2b'
    [ "$(tail -n 1 <<<"$said")" = '3 passed, 1 failed' ]
}

test_a_program_that_stops_early_is_a_failure() {
    new_tree
    write_test quits 'if (answer() == 42) exit(0)' # says success in the middle of a test
    write_test dies 'if (answer() == 42) _Exit(3)'
    local said
    said=$(assert_fails 1 ./nook test)
    assert_holds "$said" 'FAILED  tests/core/test_dies.c'
    assert_holds "$said" 'FAILED  tests/core/test_quits.c'
}

test_skipped_tests_are_counted_apart() {
    new_tree
    write_test skips 'if (answer() == 42) { print_message("no moon tonight\n"); skip(); }'
    local said
    said=$(./nook test 2>/dev/null)
    assert_holds "$said" '[  SKIPPED ] test_answer: no moon tonight'
    [ "$(tail -n 1 <<<"$said")" = '1 passed, 0 failed, 1 skipped' ]
}

# write_meeting SUBJECT OTHER: a test that passes when the other runs at the same time.
write_meeting() {
    printf '%s\n' 'cd "$NOOK_TEST_TMP/.."' 'echo "[==========] Running"' "touch met_$1" \
        "for _ in {1..$meeting_looks}; do [ -e met_$2 ] && echo '[       OK ] met' && break; sleep 0.1; done" \
        "[ -e met_$2 ] || echo '[  FAILED  ] met nobody'" "[ -z '$3' ] || sleep $3" 'echo "[==========] 1 run."' \
        >"tests/core/test_$1.sh"
}

test_programs_run_at_once_and_are_reported_in_order() {
    new_tree
    meeting_looks=600
    write_meeting a b 1
    write_meeting b a ''
    local said
    said=$(./nook test --jobs 2 2>/dev/null)
    [ "$(awk '{ print $1, $2 }' <<<"$said")" = $'ok tests/core/test_a.sh:\nok tests/core/test_b.sh:\n2 passed,' ]
    meeting_looks=2
    write_meeting a b ''
    assert_holds "$(assert_fails 1 ./nook test --jobs 1)" '1 passed, 1 failed'
    assert_holds "$(assert_fails 2 ./nook test --jobs 0)" '--jobs wants a number'
    assert_holds "$(assert_fails 2 ./nook test --jobs)" '--jobs wants a number'
}

test_a_run_that_is_stopped_stops_its_programs() {
    new_tree
    printf '%s\n' 'echo $$ >"$NOOK_TEST_TMP/id"' 'for _ in {1..600}; do sleep 0.1; done' >tests/core/test_long.sh
    ./nook test --jobs 2 >/dev/null 2>&1 &
    local run=$! id=$tree/build/test_tmp/test_core_long/id code=0
    for _ in {1..600}; do [ ! -s "$id" ] || break; sleep 0.1; done
    kill $run
    wait $run || code=$?
    [ $code -eq 130 ]
    not kill -0 "$(cat "$id")"
}

test_two_tests_of_one_name_are_refused() {
    new_tree
    write_test answer 'assert_int_equal(answer(), 42);'
    echo exit 1 >tests/core/test_answer.sh
    assert_holds "$(assert_fails 1 ./nook test)" "tests/core/test_answer.c and tests/core/test_answer.sh have one name"
}

test_no_matching_test_is_a_failure() {
    new_tree
    write_test good 'assert_int_equal(answer(), 42)'
    assert_holds "$(assert_fails 1 ./nook test nothing_like_it)" "no test matches 'nothing_like_it'"
}

test_the_sanitizers_catch_what_they_are_for() {
    new_tree
    write_test overflow 'volatile int most = 2147483647; most = most + answer(); assert_true(most != 0)'
    ./nook test
    assert_holds "$(assert_fails 1 ./nook test --sanitize)" 'signed integer overflow'
    write_test overflow 'char *volatile leak = malloc((size_t)answer()); assert_non_null(leak); leak = NULL'
    assert_holds "$(assert_fails 1 ./nook test --sanitize)" 'LeakSanitizer'
}

test_missing_packages_are_named_and_refused_on_request() {
    new_tree
    command -v dpkg-query >/dev/null || skip_test 'not a Debian system'
    sed -i '/^\[build\]/a nook-package-that-does-not-exist # for the test' packages.txt
    local said
    said=$(assert_fails 1 ./nook --no-install)
    [ "$said" = 'nook: these Debian packages are missing: nook-package-that-does-not-exist' ]
    [ ! -e build ]
}

# as_reader COMMAND...: as somebody who may not write in the tree.
as_reader() {
    if [ "$(id -u)" -eq 0 ]; then setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; else "$@"; fi
}

test_a_tree_that_cannot_be_written_runs_what_is_up_to_date_and_else_says_one_line() {
    new_tree
    trap 'chmod -R u+w "$tree"' EXIT
    as_reader test -r "$PWD/nook" || skip_test 'this folder is closed to other users'
    chmod -R go-w,a-w "$tree"
    local said
    said=$(assert_fails 1 as_reader ./nook)
    assert_holds "$said" 'cannot be written'
    [ "$(wc -l <<<"$said")" -eq 1 ]
    chmod -R u+w "$tree"
    ./nook
    chmod -R a-w "$tree"
    [ "$(as_reader ./nook 2>&1)" = 42 ]
    said=$(assert_fails 1 as_reader ./nook test)
    [ "$(wc -l <<<"$said")" -eq 1 ]
    chmod -R u+w "$tree"
    touch -d '+1 minute' engine/core/answer.h
    chmod -R a-w "$tree"
    assert_holds "$(assert_fails 1 as_reader ./nook)" 'up to date'
}

test_help_lists_commands_without_building() {
    new_tree
    assert_holds "$(./nook help)" 'test '
    assert_holds "$(./nook --help)" "$(sed -n 's/^NOOK_COMMAND([a-z]*, "\(.*\)")/\1/p' game/commands/commands.def | head -n 1)"
    local command
    for command in test format lint clean; do
        assert_holds "$(./nook $command --help)" "usage: ./nook $command"
        assert_holds "$(./nook help $command)" "usage: ./nook $command"
        assert_holds "$(assert_fails 2 ./nook $command --nonsense)" 'no such option'
    done
    [ ! -e build ]
}

test_clean_removes_what_was_built() {
    new_tree
    ./nook
    ./nook clean
    [ ! -e build ] && [ ! -e compile_commands.json ]
}

run_tests
