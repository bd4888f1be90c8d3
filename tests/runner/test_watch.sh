#!/usr/bin/env bash
# ./nook watch on a small tree of its own: what it puts where a game looks, and when.
nook_root=${NOOK_ROOT:-$PWD}
cd "$nook_root" || exit 1
source tests/support/shell.sh
tree="${NOOK_TEST_TMP:-/tmp}/a tree to watch"

new_tree() {
    rm -rf "$tree"
    mkdir -p "$tree"/{engine/core,modules,game/entry,game/commands,tests/core,shaders}
    cp "$nook_root"/{nook,premake5.lua,packages.txt} "$tree"
    cp "$nook_root/game/commands/commands.def" "$tree/game/commands"
    cd "$tree"
    printf 'int helper(void);\nint helper(void) { return 1; }\n' >engine/core/helper.c
    printf 'int main(void) { return 0; }\n' >game/main.c
    write_answer 42
    printf 'int answer(void);\n__attribute__((visibility("default"))) int entry(void);\nint entry(void) { return answer(); }\n' \
        >game/entry/game_entry.c
    live=build/release/live
}

write_answer() { printf 'int answer(void);\nint answer(void) { return %s; }\n' "$1" >game/answer.c; }

test_once_puts_the_library_where_a_game_looks_and_then_says_so() {
    new_tree
    ./nook watch --once
    nm -D --defined-only $live/game.so | grep -q ' T entry$'
    [[ $(cat $live/build) =~ ^[0-9]+\ ok$ ]]
    [ ! $live/game.so -nt $live/build ]
    [ ! -e $live/game.so.new ] && [ ! -e $live/build.new ]
}

test_a_library_that_did_not_change_keeps_its_file() {
    new_tree
    ./nook watch --once
    local before said
    before=$(stat -c '%i %Y' $live/game.so)
    said=$(cat $live/build)
    touch game/answer.c
    ./nook watch --once
    [ "$(stat -c '%i %Y' $live/game.so)" = "$before" ]
    [ "$(cat $live/build)" != "$said" ]
}

test_what_does_not_compile_is_told_with_file_and_line_and_the_library_stays() {
    new_tree
    ./nook watch --once
    cp $live/game.so "$NOOK_TEST_TMP/before.so"
    write_answer undeclared_name
    local said
    said=$(assert_fails 1 ./nook watch --once)
    assert_holds "$said" undeclared_name
    cmp $live/game.so "$NOOK_TEST_TMP/before.so"
    [[ $(head -n 1 $live/build) =~ ^[0-9]+\ failed$ ]]
    assert_holds "$(tail -n +2 $live/build)" "game/answer.c:2:"
    [[ $(tail -n +2 $live/build) != ../* ]]
}

test_what_does_not_compile_is_told_in_ascii_whatever_language_the_user_has() {
    new_tree
    write_answer undeclared_name
    LC_ALL=C.UTF-8 assert_fails 1 ./nook watch --once >/dev/null
    assert_holds "$(cat $live/build)" "'undeclared_name'"
    not env LC_ALL=C grep -q '[^ -~]' $live/build
}

wait_until() { # COMMAND...
    for _ in {1..300}; do
        if "$@"; then return 0; fi
        sleep 0.1
    done
    echo "waited in vain for: $*"
    return 1
}
build_says() { [ "$(cat $live/build 2>/dev/null)" != "$1" ] && [[ $(head -n 1 $live/build 2>/dev/null) == *" $2" ]]; } # BEFORE RESULT

test_what_is_saved_is_built_until_it_is_stopped() {
    new_tree
    ./nook watch >"$NOOK_TEST_TMP/watch.log" 2>&1 &
    watch=$! # not local: the trap is run after this
    trap 'kill $watch 2>/dev/null || true; cat "$NOOK_TEST_TMP/watch.log"' EXIT
    local before
    wait_until build_says '' ok
    before=$(cat $live/build)
    cp $live/game.so "$NOOK_TEST_TMP/first.so"
    write_answer 43 # in place
    wait_until build_says "$before" ok
    not cmp -s $live/game.so "$NOOK_TEST_TMP/first.so"
    before=$(cat $live/build)
    write_answer nothing
    wait_until build_says "$before" failed
    before=$(cat $live/build)
    write_answer 44 && mv game/answer.c game/aside.c && mv game/aside.c game/answer.c # by rename
    wait_until build_says "$before" ok
    before=$(cat $live/build)
    mkdir game/deep && mv game/answer.c game/deep/answer.c # elsewhere
    wait_until build_says "$before" ok
    kill $watch
    before=$(cat $live/build)
    write_answer 45
    sleep 1
    [ "$(cat $live/build)" = "$before" ]
}

test_a_tree_without_anything_to_exchange_and_a_misspelt_option_are_refused() {
    new_tree
    assert_holds "$(assert_fails 2 ./nook watch --twice)" 'no such option'
    assert_holds "$(./nook watch --help)" 'usage: ./nook watch'
    rm -r game/entry
    assert_holds "$(assert_fails 1 ./nook watch)" 'nothing can be exchanged'
}

run_tests
