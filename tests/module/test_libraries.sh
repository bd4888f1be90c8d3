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
        [ "$library" != "$bin/game.so" ] || found=$(grep -v '^nook_listed_techniques$' <<<"$found" || true)
        [ -z "$found" ] || { echo "$library: $found"; return 1; }
    done
}

defined_in() { nm --defined-only "$@" 2>/dev/null | awk 'NF == 3 { print $3 }' | sort -u; }

# What a library lacks is the engine's or a system library's. What it calls of game/ and modules/ it brings along: the program's
# may be older, and nobody compares them.
test_what_they_lack_is_the_engine_of_the_program() {
    local library wanted
    for library in $(libraries); do
        wanted=$(nm -D --undefined-only "$library" | awk '{ print $2 }' | grep '^nook_' | sort -u)
        [ -n "$wanted" ]
        [ -z "$(comm -23 <(echo "$wanted") <(defined_in -D "$bin/nook"))" ] || { echo "$library: not in the program"; return 1; }
        [ -z "$(comm -12 <(echo "$wanted") <(defined_in "$bin"/libnook_{game,ao,ao_ecs,ao_*,trace,bake,measure,fixture,plan,stream}.a))" ] ||
            { echo "$library: takes the program's code"; return 1; }
    done
}

sources_in() { objdump --dwarf=info --dwarf-depth=1 "$1" 2>/dev/null | awk '/DW_AT_name/ { print $NF }' | sed 's|^\(\.\./\)*||'; }

# Else a technique that changes would change the game.
test_the_game_holds_the_code_of_no_technique_and_a_technique_that_of_no_other() {
    local library found name
    for library in $(libraries); do
        name=$(basename "$library" .so)
        found=$(sources_in "$library" | grep '^modules/ao_' || true)
        if [ "$name" = game ]; then
            sources_in "$library" | grep -q '^game/play/play_module\.c$'
            [ -z "$found" ] || { echo "game.so: $found"; return 1; }
        else
            [ -n "$found" ]
            not grep -v "^modules/$name/" <<<"$found"
        fi
    done
}

# All that the engine has can be found in the program, what it does not use itself too.
test_the_program_exports_the_whole_engine() {
    local archive
    for archive in "$bin"/libnook_{core,platform,module,gpu,ecs,physics,asset,overlay,render}.a; do
        [ -z "$(comm -23 <(defined_in -g "$archive" | grep '^nook_') <(defined_in -D "$bin/nook"))" ] || { echo "$archive"; return 1; }
    done
}

run_tests
