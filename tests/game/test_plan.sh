#!/usr/bin/env bash
# ./nook plan: what it says, and what it refuses (docs/plan.md).
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
crate=tests/game/data/crate.gltf
hall=content/hall/hall.glb

plan() { "${NOOK_PROGRAM:-build/release/bin/nook}" plan "$@"; }

# The number in front of "MiB of voxels".
planned_mib() { awk '/MiB of voxels instead of/ { print $1 }' <<<"$1"; }

test_a_crate_on_a_floor_stays() {
    local said
    said=$(plan "$crate" --plan on)
    assert_holds "$said" 'crate.gltf: 2 bodies, 2 volumes'
    assert_holds "$said" '0 bodies take too little of any surface'
    assert_holds "$said" 'no point changes by more than 0.0000'
}

test_walls_of_the_demo_level_get_volumes_of_their_own() {
    local said before after
    said=$(plan "$hall")
    assert_holds "$said" 'error that it rests on'
    assert_holds "$said" 'copy of drum_teal'
    assert_holds "$said" 'static 1 '
    after=$(planned_mib "$said")
    before=$(awk '/MiB of voxels instead of/ { print $7 + 0 }' <<<"$said")
    awk -v a="$after" -v b="$before" 'BEGIN { exit !(a > 0 && a < 0.9 * b) }'
}

test_walls_share_one_volume_when_volumes_multiply() {
    local said
    printf 'technique = volume\ncombine = multiply\n' >"$tmp/multiply.settings"
    said=$(plan "$hall" --settings "$tmp/multiply.settings")
    assert_holds "$said" ' parts in 1 volumes'
}

test_a_camera_sees_no_body_behind_it() {
    assert_holds "$(plan "$crate" --camera 2,1.6,3,2,1.6,30,40 --plan on)" 'crate                         0.00000  no surface in reach'
    assert_holds "$(plan "$crate" --camera corner --plan on)" '0 bodies have no surface in their reach'
}

test_bodies_that_will_move_are_never_left_out() {
    assert_holds "$(plan "$crate" --camera 2,1.6,3,2,1.6,30,40 --plan on --plays)" '0 bodies have no surface in their reach'
}

test_memory_is_kept_to_or_refused_with_what_would_do() {
    local said need
    said=$(plan "$hall" --memory 0.5)
    awk -v m="$(planned_mib "$said")" 'BEGIN { exit !(m > 0 && m <= 0.5) }'
    assert_holds "$said" 'for memory'
    said=$(assert_fails 1 plan "$hall" --memory 0.001)
    [ "$(wc -l <<<"$said")" -eq 1 ]
    assert_holds "$said" 'set plan.memory to that or more'
    need=$(sed -n 's/.*they take \([0-9.]*\);.*/\1/p' <<<"$said")
    plan "$hall" --memory "$need" >/dev/null # what it names is enough
    assert_holds "$(assert_fails 1 plan "$hall" --memory 0.1 --plan on)" 'or plan to measured'
}

test_wrong_questions_are_refused_in_a_line() {
    assert_holds "$(assert_fails 1 plan no/such.glb)" 'no/such.glb'
    assert_holds "$(assert_fails 2 plan "$crate" --error 2)" '--error 2'
    assert_holds "$(assert_fails 2 plan "$crate" --plan perhaps)" 'off'
    assert_holds "$(assert_fails 2 plan)" 'SCENE'
    assert_holds "$(assert_fails 1 plan "$crate" --camera nobody)" 'nobody'
}

test_settings_files_say_what_is_planned() {
    printf 'technique = volume\nplan = on\nplan.error = 0.25\nresolution = 64\n' >"$tmp/on.settings"
    assert_holds "$(plan "$hall" --settings "$tmp/on.settings")" 'error 0.25'
    assert_holds "$(plan "$hall" --settings "$tmp/on.settings")" 'static                           1     64     64'
    assert_holds "$(plan "$hall" --settings "$tmp/on.settings" --error 0.5)" 'error 0.5'
}

run_tests
