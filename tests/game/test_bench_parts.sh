#!/usr/bin/env bash
# Benches from their command line.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
source tests/support/shell.sh
export NOOK_ROOT=$PWD
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}

bench() { "$NOOK_PROGRAM" bench "$@"; }

test_a_character_that_walks_is_posed_and_voxelised_in_every_frame() {
    [ -n "${NOOK_SHARED-}" ] || skip_test "NOOK_SHARED names no folder with characters"
    local said
    said=$(bench character "$NOOK_SHARED/scenes/characters/CesiumMan.glb" --backend osmesa --size 64x36 --frames 3 --cache "$tmp/cache")
    assert_holds "$said" "1 of 1 live volumes made anew in the last frame"
    [[ $(tail -n 1 <<<"$said") =~ ^(\ +[0-9]+\.[0-9]+){5}$ ]]
}

test_a_scene_in_which_nothing_bends_is_no_character() {
    local said
    said=$(bench character tests/game/data/crate.gltf --backend osmesa --size 64x36 --cache "$tmp/cache" 2>&1 >/dev/null) && return 1
    assert_holds "$said" "crate.gltf: nothing in it bends by a clip"
    [ "$(wc -l <<<"$said")" -eq 1 ]
}

test_a_part_that_is_not_there_is_said_in_one_line() {
    local said
    said=$(bench nothing 2>&1 >/dev/null) && return 1
    [ "$said" = "nook: bench nothing: there is no such part; ./nook bench --help lists them" ]
}

run_tests
