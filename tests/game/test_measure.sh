#!/usr/bin/env bash
# The command `measure` from end to end, on a crate that stands on a floor.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
crate=tests/game/data/crate.gltf
unset DISPLAY WAYLAND_DISPLAY

cat >"$tmp/sweep.txt" <<'END'
size = 48x27
r_max = 0.1
noise = 0.05
pictures = all
[volume]
resolution = 32
[ssao]
samples = 4
[reference]
sees = screen
END

measure() { "${NOOK_PROGRAM:-build/release/bin/nook}" measure --backend osmesa --cache "$tmp/cache" "$@"; }
measure_crate() { measure "$crate" --sweep "$tmp/sweep.txt" "$@" 2>"$tmp/said"; }

# column CSV NAME: its values, one a line. No text of these scenes has a comma.
column() {
    tr -d '\r' <"$1" | awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) n = i; next } { print $n }'
}

test_measure_writes_tables_report_and_pictures() {
    local name
    assert_holds "$(measure_crate --out "$tmp/all")" '5 rows measured, 0 reused, 1 sites; noise of the truth at most 0.'
    [ "$(column "$tmp/all/measure.csv" setting | tr '\n' ' ')" = 'volume ssao ssao samples=4 reference sees=screen volume resolution=32 ' ]
    for name in ms_median rmse bias ssim fetches_per_pixel screen_rmse noise flicker instability texture_bytes reference_noise; do
        [ "$(column "$tmp/all/measure.csv" $name | sed 4d | grep -c '^-\?[0-9.e-]\+$')" -eq 4 ] || { echo "$name"; return 1; }
    done
    [ "$(column "$tmp/all/measure.csv" bake_ms | sed -n 1p)" != 0 ]
    [ "$(column "$tmp/all/measure.csv" bake_ms | sed -n 3p)" = 0 ]
    [ "$(find "$tmp/all/pictures" -name '*.png' | wc -l)" -eq 9 ]
    while read -r name; do
        [ "$(identify -format '%w x %h' "$tmp/all/$name")" = '48 x 27' ]
    done < <(column "$tmp/all/measure.csv" picture)
    [ "$(grep -c '"setting":' "$tmp/all/measure.json")" -eq 5 ]
    assert_holds "$(tail -c 100 "$tmp/all/report.html")" '</html>'
    assert_holds "$(cat "$tmp/said")" 'nook: 5 of 5: crate.gltf'
}

test_nothing_is_measured_twice() {
    measure_crate --out "$tmp/twice" >"$tmp/first"
    cp "$tmp/twice/measure.csv" "$tmp/before.csv"
    cp "$tmp/twice/journal.jsonl" "$tmp/before.jsonl"
    assert_holds "$(measure_crate --out "$tmp/twice")" '0 rows measured, 5 reused, 1 sites'
    cmp "$tmp/twice/measure.csv" "$tmp/before.csv"
    cmp "$tmp/twice/journal.jsonl" "$tmp/before.jsonl"
}

test_a_wider_sweep_measures_what_is_new() {
    measure_crate --out "$tmp/wider" >"$tmp/first"
    { cat "$tmp/sweep.txt"; printf '[hbao]\n'; } >"$tmp/wider.txt"
    assert_holds "$(measure "$crate" --sweep "$tmp/wider.txt" --out "$tmp/wider" 2>&1)" '1 rows measured, 5 reused'
}

# A sweep of many rows, so that there is time to stop it.
many_rows() {
    sed 's/samples = .*/samples = 4 5 6 7 8 9 10 11 12 13 14 15/' "$tmp/sweep.txt" >"$tmp/many.txt"
    measure "$crate" --sweep "$tmp/many.txt" --out "$1"
}

rows_in() { if [ -e "$1/journal.jsonl" ]; then grep -c '^{"row"' "$1/journal.jsonl" || true; else echo 0; fi; }

# stop_after ROWS SIGNAL FOLDER: starts the sweep and stops it; the exit code of that.
stop_after() {
    local pid code=0
    (exec 2>"$tmp/stopped"; sed 's/samples = .*/samples = 4 5 6 7 8 9 10 11 12 13 14 15/' "$tmp/sweep.txt" >"$tmp/many.txt"
        exec "${NOOK_PROGRAM:-build/release/bin/nook}" measure "$crate" --backend osmesa --cache "$tmp/cache" --sweep "$tmp/many.txt" --out "$3") >"$tmp/stopped_out" &
    pid=$!
    while [ "$(rows_in "$3")" -lt "$1" ] && kill -0 $pid 2>/dev/null; do sleep 0.02; done
    kill "-$2" $pid
    wait $pid || code=$?
    return $code
}

test_interrupted_it_says_how_to_go_on_and_goes_on() {
    local code=0 rows
    stop_after 2 TERM "$tmp/stop" || code=$?
    rows=$(rows_in "$tmp/stop")
    [ $code -eq 1 ]
    [ "$rows" -ge 2 ]
    [ "$rows" -lt 16 ]
    assert_holds "$(cat "$tmp/stopped")" 'the same command goes on'
    [ "$(column "$tmp/stop/measure.csv" setting | wc -l)" -eq "$rows" ]
    assert_holds "$(many_rows "$tmp/stop" 2>/dev/null)" "$((16 - rows)) rows measured, $rows reused"
    [ "$(rows_in "$tmp/stop")" -eq 16 ]
    [ "$(column "$tmp/stop/measure.csv" setting | sort -u | wc -l)" -eq 16 ]
}

test_killed_it_goes_on_and_comes_to_the_same_errors() {
    local rows
    not stop_after 2 KILL "$tmp/kill" 2>/dev/null
    printf '{"row": {"scene": "cut sh' >>"$tmp/kill/journal.jsonl"
    rows=$(rows_in "$tmp/kill")
    rows=$((rows - 1)) # the one cut short
    many_rows "$tmp/kill" >"$tmp/resumed" 2>"$tmp/resumed_said"
    assert_holds "$(cat "$tmp/resumed")" "$((16 - rows)) rows measured, $rows reused"
    assert_holds "$(cat "$tmp/resumed_said")" 'cut short'
    many_rows "$tmp/whole" >"$tmp/whole_out" 2>/dev/null
    for name in setting rmse bias ssim screen_rmse noise flicker instability fetches_per_pixel; do
        diff <(paste <(column "$tmp/kill/measure.csv" setting) <(column "$tmp/kill/measure.csv" $name) | sort) \
            <(paste <(column "$tmp/whole/measure.csv" setting) <(column "$tmp/whole/measure.csv" $name) | sort)
    done
}

test_rows_of_another_build_are_measured_anew_unless_kept() {
    measure_crate --out "$tmp/build" >"$tmp/first"
    sed -i 's/"build": "[0-9a-f]*"/"build": "0000000000000000"/' "$tmp/build/journal.jsonl"
    assert_holds "$(measure_crate --out "$tmp/build" --keep)" '0 rows measured, 5 reused'
    assert_holds "$(measure_crate --out "$tmp/build")" '5 rows measured, 0 reused'
    assert_holds "$(cat "$tmp/said")" '5 rows were measured by another build'
    assert_holds "$(measure_crate --out "$tmp/build")" '0 rows measured, 5 reused'
}

test_results_of_several_folders_are_joined_without_measuring() {
    printf 'size = 48x27\nnoise = 0.05\n[ssao]\n' >"$tmp/one.txt"
    printf 'size = 48x27\nnoise = 0.05\n[hbao]\n' >"$tmp/two.txt"
    measure "$crate" --sweep "$tmp/one.txt" --out "$tmp/one" >"$tmp/first" 2>&1
    measure "$crate" --sweep "$tmp/two.txt" --out "$tmp/two" >"$tmp/first" 2>&1
    assert_holds "$(measure --tables --merge "$tmp/one" --merge "$tmp/two" --out "$tmp/joined" 2>&1)" '0 rows measured'
    [ "$(column "$tmp/joined/measure.csv" setting | tr '\n' ' ')" = 'ssao hbao ' ]
    while read -r name; do [ -s "$tmp/joined/$name" ]; done < <(column "$tmp/joined/measure.csv" picture)
}

test_tables_of_nothing_are_refused_and_a_report_is_named() {
    assert_holds "$(assert_fails 1 measure --tables --out "$tmp/nothing")" "$tmp/nothing: nothing was measured into it yet"
    printf 'size = 32x18\nnoise = 0.05\n[ssao]\n' >"$tmp/one.txt"
    assert_holds "$(measure "$crate" --sweep "$tmp/one.txt" --out "$tmp/named" 2>/dev/null)" "Report: $tmp/named/report.html"
    [ -s "$tmp/named/report.html" ]
}

test_every_scene_of_a_folder_is_measured_and_one_that_fails_is_counted() {
    mkdir -p "$tmp/scenes/inner"
    cp "$crate" "$tmp/scenes/inner/a.gltf"
    printf 'size = 32x18\nnoise = 0.05\n[ssao]\n' >"$tmp/one.txt"
    assert_holds "$(measure --scenes "$tmp/scenes" --sweep "$tmp/one.txt" --out "$tmp/folder" 2>/dev/null)" '1 rows measured'
    echo 'not a scene' >"$tmp/scenes/b.glb"
    assert_holds "$(assert_fails 1 measure --scenes "$tmp/scenes" --sweep "$tmp/one.txt" --out "$tmp/folder" 2>/dev/null)" '0 rows measured, 1 reused, 1 sites; noise'
    assert_holds "$(assert_fails 1 measure --scenes "$tmp/scenes" --sweep "$tmp/one.txt" --out "$tmp/folder")" '1 scenes failed'
}

# A front is of times, which no test can foretell; but not all of these are on one, whose errors go up and down with the samples.
test_pictures_that_nobody_looks_for_go_when_a_site_is_done() {
    local setting picture
    printf 'size = 48x27\nnoise = 0.05\n[ssao]\nsamples = 4 5 7 9 11 15\n' >"$tmp/front.txt"
    measure "$crate" --sweep "$tmp/front.txt" --out "$tmp/front" >"$tmp/first" 2>&1
    [ "$(column "$tmp/front/measure.csv" setting | wc -l)" -eq 7 ]
    [ "$(find "$tmp/front/pictures" -name 'ssao*.png' | wc -l)" -eq "$(column "$tmp/front/measure.csv" picture | grep -c png)" ]
    [ "$(column "$tmp/front/measure.csv" picture | grep -c png)" -lt 7 ]
    while IFS=$'\t' read -r setting picture; do
        [ "$setting" != ssao ] || [ -n "$picture" ] # as it comes it always has one
    done < <(paste <(column "$tmp/front/measure.csv" setting) <(column "$tmp/front/measure.csv" picture))
    [ "$(find "$tmp/front/pictures" -name '*.png' | grep -c 'truth\|screen\|geometry\|lit')" -eq 4 ]
    cp "$tmp/front/measure.csv" "$tmp/before.csv"
    measure "$crate" --sweep "$tmp/front.txt" --out "$tmp/front" >"$tmp/first" 2>&1
    cmp "$tmp/front/measure.csv" "$tmp/before.csv"
}

test_sampled_cameras_are_measured_by_their_number() {
    printf 'size = 32x18\nnoise = 0.05\ncameras = sampled 2\nr_max = 0.05 0.25m\nfalloff = hard linear\n[ssao]\n' >"$tmp/views.txt"
    assert_holds "$(measure "$crate" --sweep "$tmp/views.txt" --out "$tmp/views" 2>/dev/null)" '8 rows measured, 0 reused, 8 sites'
    [ "$(column "$tmp/views/measure.csv" camera | sort | uniq -c | tr -s ' ' | tr '\n' ';')" = ' 4 sample 1; 4 sample 2;' ]
    [ "$(column "$tmp/views/measure.csv" rmse | sort -u | wc -l)" -eq 8 ]
}

test_tables_go_into_a_document() {
    printf 'before\n<!-- measured: begin -->\nold\n<!-- measured: end -->\nafter\n' >"$tmp/document.md"
    measure_crate --out "$tmp/all" --document "$tmp/document.md" >"$tmp/first"
    assert_holds "$(cat "$tmp/document.md")" 'before'
    assert_holds "$(cat "$tmp/document.md")" 'crate.gltf'
    not grep -q old "$tmp/document.md"
}

test_what_is_wrong_is_one_line() {
    local said
    said=$(assert_fails 2 measure --suite slow)
    [ "$(wc -l <<<"$said")" -le 2 ]
    assert_holds "$said" 'quick'
    printf 'size = 48x27\n[ssoa]\n' >"$tmp/wrong.txt"
    said=$(assert_fails 1 measure "$crate" --sweep "$tmp/wrong.txt" --out "$tmp/wrong")
    assert_holds "$said" 'wrong.txt:2:'
    assert_holds "$said" 'ssao'
    said=$(assert_fails 1 measure "$crate" --sweep "$tmp/none.txt" --out "$tmp/wrong")
    assert_holds "$said" 'none.txt'
    said=$(assert_fails 1 measure --tables --merge "$tmp/none" --out "$tmp/wrong")
    assert_holds "$said" 'journal.jsonl'
    said=$(assert_fails 1 measure "$crate" --sweep "$tmp/sweep.txt" --out "$tmp/sweep.txt")
    [ "$(wc -l <<<"$said")" -eq 1 ]
}

# untouched OPTIONS...: refused in one line, before the first row and before there is a folder.
untouched() {
    said=$(assert_fails "$@" --out "$tmp/untouched")
    [ "$(wc -l <<<"$said")" -eq 1 ] && [ ! -e "$tmp/untouched" ]
}

test_paths_are_looked_at_before_the_work() {
    local said
    untouched 1 measure "$crate" "$tmp/missing.glb" --sweep "$tmp/sweep.txt"
    assert_holds "$said" 'missing.glb: no such file'
    untouched 1 measure "$crate" --sweep "$tmp/sweep.txt" --document "$tmp/no.md"
    assert_holds "$said" 'no.md'
    echo 'no marks' >"$tmp/unmarked.md"
    untouched 1 measure "$crate" --sweep "$tmp/sweep.txt" --document "$tmp/unmarked.md"
    assert_holds "$said" 'measured: begin'
    untouched 1 measure "$crate" --sweep "$tmp/none.txt"
    untouched 1 measure "$crate" --sweep "$tmp/sweep.txt" --settings "$tmp/none.txt"
    untouched 1 measure --scenes "$tmp/nowhere" --sweep "$tmp/sweep.txt"
}

test_what_tables_would_ignore_is_refused() {
    local said
    untouched 2 measure --tables "$crate"
    assert_holds "$said" '--tables measures nothing, so that a scene is of no use'
    untouched 2 measure --tables --sweep "$tmp/sweep.txt"
    untouched 2 measure --tables --scenes "$tmp"
    untouched 2 measure --tables --settings "$tmp/sweep.txt"
}

run_tests
