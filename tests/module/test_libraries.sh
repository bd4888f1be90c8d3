#!/usr/bin/env bash
# The shared libraries that ./nook watch builds, as they were built with this program: what they export, and that nothing in them can be written.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
bin=$(dirname "${NOOK_PROGRAM:-build/release/bin/nook}")

libraries() {
    local folder
    echo "$bin/game.so"
    for folder in modules/ao_*/; do echo "$bin/$(basename "$folder").so"; done
}

test_each_exports_its_entry_and_nothing_else() {
    local library symbols
    for library in $(libraries); do
        symbols=$(nm -D --defined-only "$library" | awk '{ print $3 }' | grep -v '^__\(asan\|odr_asan\|start___sanc\|stop___sanc\)' | tr '\n' ' ')
        [ "$symbols" = 'nook_module_entry ' ] || { echo "$library: exports $symbols"; return 1; }
    done
}

# Variables that a library would have of its own: each time it is loaded they would be new. What is only written when it is loaded
# stands in .data.rel.ro.
test_none_has_variables_of_its_own_but_the_list_of_techniques() {
    [[ $bin == */release/* ]] || skip_test 'the sanitizers have variables in every library'
    local library found
    for library in $(libraries); do
        found=$(objdump -t "$library" | awk '$0 ~ / O (\.data|\.bss|\.tbss|\.tdata)\t/ { print $NF }' |
            grep -v -e '^completed\.0$' -e '^__dso_handle$' -e '^__TMC_END__$' || true)
        [ "$library" != "$bin/game.so" ] || found=$(grep -v '^techniques$' <<<"$found" || true)
        [ -z "$found" ] || { echo "$library: $found"; return 1; }
    done
}

# What a library lacks is the engine's or a system library's: both are in the program.
test_what_they_lack_is_in_the_program() {
    local library missing
    for library in $(libraries); do
        missing=$(comm -23 <(nm -D --undefined-only "$library" | awk '{ print $2 }' | grep '^nook_' | sort -u) \
            <(nm -D --defined-only "$bin/nook" | awk '{ print $3 }' | sort -u))
        [ -z "$missing" ] || { echo "$library: $missing"; return 1; }
    done
}

# Who runs a technique's library must not run the one that is linked into the program.
test_a_technique_brings_its_own_code_and_the_game_none_of_theirs() {
    local name game
    game=$(nm -D --undefined-only "$bin/game.so")
    for name in modules/ao_*/; do
        name=$(basename "$name")
        [[ $(nm -D --undefined-only "$bin/$name.so") != *nook_${name}_technique* ]]
        assert_holds "$game" "nook_${name}_technique"
    done
}

run_tests
