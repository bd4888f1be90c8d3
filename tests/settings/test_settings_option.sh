#!/usr/bin/env bash
# --settings FILE on the commands that take it, on a crate that stands on a floor.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
crate=tests/game/data/crate.gltf
unset DISPLAY WAYLAND_DISPLAY

nook() { "${NOOK_PROGRAM:-build/release/bin/nook}" "$@"; }

compare() {
    nook compare "$crate" --backend osmesa --cache "$tmp/cache" --size 48x32 --frames 1 --reference-rays 4 --no-instability "$@"
}

write_setting() {
    printf '# for the test\ntechnique = volume\nresolution = 24\nrays = 3\nao.filter = none\nr_max = 0.625\nfalloff = linear\n' >"$tmp/setting.txt"
}

# json_line FILE KEY: the first line with that key, without its blanks and comma.
json_line() { grep -m 1 "\"$2\":" "$1" | sed 's/^ *//; s/,$//'; }

test_compare_shows_the_setting_of_the_file_beside_the_reference() {
    write_setting
    compare --settings "$tmp/setting.txt" --out "$tmp/out" --json >"$tmp/printed"
    [ "$(grep -c '"name": "[a-z]*",' "$tmp/printed")" -ge 2 ]
    [ -e "$tmp/out/volume.png" ] && [ -e "$tmp/out/reference.png" ] && [ ! -e "$tmp/out/ssao.png" ]
    [ "$(json_line "$tmp/printed" r_max)" = '"r_max": 0.625' ]
    [ "$(json_line "$tmp/printed" falloff)" = '"falloff": "linear"' ]
    [ "$(json_line "$tmp/printed" filter)" = '"filter": "none"' ]
    assert_holds "$(grep '"rays":' "$tmp/printed")" '"rays": 3'
    # the static body takes the whole resolution: 24 voxels and an empty border
    assert_holds "$(grep -A 3 -m 1 '"dimensions"' "$tmp/printed")" 26
}

test_compare_says_that_a_budget_is_for_play() {
    write_setting
    printf 'volumes.budget = 0.0001\n' >>"$tmp/setting.txt"
    compare --settings "$tmp/setting.txt" --out "$tmp/budget" >/dev/null 2>"$tmp/said"
    assert_holds "$(cat "$tmp/said")" 'volumes.budget is for ./nook play'
}

test_options_on_the_command_line_count_more() {
    write_setting
    compare --settings "$tmp/setting.txt" --out "$tmp/more" --json --r-max 0.5 --falloff hard --ao-scale half \
        --param volume.rays=2 --param ao.filter=tile --techniques volume,ssao --resolution 40 >"$tmp/printed"
    [ -e "$tmp/more/ssao.png" ]
    [ "$(json_line "$tmp/printed" r_max)" = '"r_max": 0.5' ]
    [ "$(json_line "$tmp/printed" falloff)" = '"falloff": "hard"' ]
    [ "$(json_line "$tmp/printed" filter)" = '"filter": "tile"' ]
    [ "$(json_line "$tmp/printed" scale)" = '"scale": "half"' ]
    assert_holds "$(grep '"rays":' "$tmp/printed")" '"rays": 2'
    assert_holds "$(grep -A 3 -m 1 '"dimensions"' "$tmp/printed")" 42
    compare --settings "$tmp/setting.txt" --out "$tmp/more" --json --param ao.r_max=0.25 >"$tmp/printed"
    [ "$(json_line "$tmp/printed" r_max)" = '"r_max": 0.25' ]
}

test_bake_makes_the_volumes_of_the_file() {
    write_setting
    nook bake "$crate" --settings "$tmp/setting.txt" --cache "$tmp/baked" >"$tmp/printed" 2>/dev/null
    assert_holds "$(cat "$tmp/printed")" 'r_max 0.625 m'
    assert_holds "$(cat "$tmp/printed")" 26x
    nook bake "$crate" --settings "$tmp/setting.txt" --cache "$tmp/baked" --resolution 40 --r-max 0.5 >"$tmp/printed" 2>/dev/null
    assert_holds "$(cat "$tmp/printed")" 'r_max 0.5 m'
    assert_holds "$(cat "$tmp/printed")" 42x
}

test_measure_takes_the_setting_beside_the_sweep() {
    write_setting
    printf 'size = 24x16\nr_max = 0.1\nnoise = 0.05\nrays_max = 16384\n[ssao]\nsamples = 4\n' >"$tmp/sweep.txt"
    nook measure "$crate" --backend osmesa --cache "$tmp/cache" --sweep "$tmp/sweep.txt" --settings "$tmp/setting.txt" \
        --out "$tmp/measured" >/dev/null 2>&1
    assert_holds "$(cat "$tmp/measured/measure.csv")" 'volume rays=3 ao.filter=none resolution=24'
    assert_holds "$(cat "$tmp/measured/measure.csv")" 'ssao samples=4'
}

# refused TEXT COMMAND...: one line with that text, exit code 1, nothing written.
refused() {
    local text=$1 said
    shift
    said=$(assert_fails 1 "$@")
    assert_holds "$said" "$text"
    [ "$(wc -l <<<"$said")" -eq 1 ]
    [ ! -e "$tmp/refused" ]
}

test_a_wrong_file_is_one_line_and_nothing_is_done() {
    refused 'no such file' compare --settings "$tmp/missing.txt" --out "$tmp/refused"
    printf 'technique = volume\nrayz = 3\n' >"$tmp/wrong.txt"
    refused 'wrong.txt:2: volume has no parameter rayz; did you mean rays?' compare --settings "$tmp/wrong.txt" --out "$tmp/refused"
    refused 'wrong.txt:2' nook measure "$crate" --settings "$tmp/wrong.txt" --out "$tmp/refused"
    refused 'wrong.txt:2' nook bake "$crate" --settings "$tmp/wrong.txt" --cache "$tmp/refused"
    printf 'technique\0= volume' >"$tmp/bytes.txt"
    refused 'no settings file' compare --settings "$tmp/bytes.txt" --out "$tmp/refused"
    refused 'directory' compare --settings "$tmp" --out "$tmp/refused"
}

test_bake_says_that_it_leaves_out_plans_and_live_volumes() {
    local entry
    for entry in 'volumes = live' 'plan = on'; do
        printf 'technique = volume\nresolution = 16\n%s\n' "$entry" >"$tmp/more.txt"
        assert_holds "$(nook bake "$crate" --settings "$tmp/more.txt" --cache "$tmp/cache" 2>&1)" 'its plan and live volumes are left out'
    done
}

test_misspelt_names_on_the_command_line_get_a_suggestion() {
    assert_holds "$(assert_fails 2 compare --techniques volume,sao --out "$tmp/refused")" 'did you mean ssao?'
    assert_holds "$(assert_fails 2 compare --param volume.ray=3 --out "$tmp/refused")" 'did you mean volume.rays?'
    assert_holds "$(assert_fails 2 compare --param volum.rays=3 --out "$tmp/refused")" 'did you mean volume?'
    assert_holds "$(assert_fails 1 compare --camera cornr --out "$tmp/refused")" "did you mean 'corner'?"
    [ ! -e "$tmp/refused" ]
}

run_tests
