#!/usr/bin/env bash
# The command `verify` from end to end: every technique on closed forms, at few points of their parameters.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
unset DISPLAY WAYLAND_DISPLAY

verify() { "${NOOK_PROGRAM:-build/release/bin/nook}" verify --backend osmesa "$@"; }

# rows TECHNIQUE TEXT: the rows of a technique that hold a text, from the table.
rows() { grep "  $1 .*$2" "$tmp/table"; }

# near VALUE BOUND: every row on standard input has its "measured", the number before the signed error, within BOUND of VALUE.
near() {
    awk -v value="$1" -v bound="$2" '
        { for (i = 2; i <= NF; i++) if ($i ~ /^[-+][0-9]/) { n++; d = $(i - 1) - value; if (d < 0) d = -d; if (d > bound) bad++; break } }
        END { exit n == 0 || bad > 0 }'
}

test_what_techniques_claim_holds_on_planes_pits_walls_and_ceilings() {
    local name
    verify --quick --fixtures plane,pit,wall,ceiling,low_wall >"$tmp/table"
    assert_holds "$(tail -n 1 "$tmp/table")" ' checks hold; '
    assert_holds "$(tail -n 1 "$tmp/table")" ' 0 visibilities outside [0, 1]'
    # The pit tells the families apart: 0.5 by equation 1, 0.7071 by the solid angle (erratum C18).
    rows gtao 'above  *Eq. 1  *0.5000' | near 0.5 0.03
    rows hbao 'above  *own: solid angle  *0.7071' | near 0.7071 0.03
    # A ceiling is behind every camera that sees what is below it: said, not skipped.
    assert_holds "$(rows gtao 'below it')" 'unseen: the depth buffer lacks 0.8'
    # As it comes the volume technique reads less of a pit; it is judged at the settings of a named exception, which shows both.
    assert_holds "$(cat "$tmp/table")" 'volume, pit, radius 1, depth 1: 0.50'
    assert_holds "$(cat "$tmp/table")" 'initial: bias'
    # From above, the wall at a tenth of r_max is a pixel wide: whoever looks, no more can be asked.
    [ "$(rows '[a-z]*' 'above .* unresolved: pixels leave 0' | wc -l)" -eq 5 ]
    # The open plane is 0 for all.
    for name in reference volume ssao hsao hbao gtao hao; do
        sed -n '/^1 plane/,/^4 /p' "$tmp/table" | grep "^  .*  $name " | near 0 0.01
    done
}

# rows_of TECHNIQUE POINT: how many it has there, of the JSON.
rows_of() { tr -d '\n' <"$tmp/all.json" | sed 's/"row":/\n&/g' | grep "\"point\": \"$2\".*\"technique\": \"$1\"" | wc -l; }

test_every_point_of_a_fixture_goes_to_every_technique() {
    local point
    verify --fixtures wall --techniques gtao --json >"$tmp/all.json"
    for point in 'k 0.3, hard' 'k 0.1, quadratic' 'k 0.3, wendland' 'k 0.6, wendland' 'x 0.25, r_max beyond all'; do
        [ "$(rows_of gtao "$point")" -eq 2 ] # from above and oblique
    done
}

test_the_volumes_own_checks_and_the_filter_hold() {
    verify --quick --techniques volume,filter --fixtures 19,20 >"$tmp/own"
    assert_holds "$(cat "$tmp/own")" 'C9: steps beside a thin layer'
    assert_holds "$(tail -n 1 "$tmp/own")" '; 0 unseen, 0 unresolved, 0 not claimed;'
}

test_too_few_rays_are_off_and_fail_the_command() {
    local said
    said=$(assert_fails 1 verify --quick --techniques reference --fixtures pit,disc --rays 1)
    assert_holds "$said" '  off'
}

test_json_is_all_that_is_printed_and_equals_the_file() {
    verify --quick --techniques reference --fixtures disc --json --out "$tmp/disc.json" >"$tmp/printed"
    cmp "$tmp/printed" "$tmp/disc.json"
    assert_holds "$(cat "$tmp/printed")" '"verdict": "ok"'
    assert_holds "$(cat "$tmp/printed")" '"initial": 0.'
    assert_holds "$(cat "$tmp/printed")" '"initial_rmse": '
    assert_holds "$(cat "$tmp/printed")" '"unresolved": 0'
}

test_wrong_names_are_refused_in_one_line() {
    local said
    said=$(assert_fails 2 verify --fixtures nonsense)
    assert_holds "$said" "there is no 'nonsense'"
    [ "$(wc -l <<<"$said")" -eq 1 ]
    said=$(assert_fails 2 verify --techniques hbaoo)
    assert_holds "$said" 'hbao'
    said=$(assert_fails 2 verify --rays 0)
    assert_holds "$said" '--rays'
    said=$(assert_fails 1 verify --quick --techniques reference --fixtures disc --out /nowhere/verify.json)
    assert_holds "$said" '/nowhere'
    [ "$(wc -l <<<"$said")" -eq 1 ] # before any work
}

run_tests
