#!/usr/bin/env bash
# The command `compare` from end to end, without a window, on a crate that stands on a floor.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
crate=tests/game/data/crate.gltf
unset DISPLAY WAYLAND_DISPLAY

compare() { "${NOOK_PROGRAM:-build/release/bin/nook}" compare --backend osmesa --cache "$tmp/cache" "$@"; }

compare_crate() { compare "$crate" --size 96x64 --frames 1 --reference-rays 16 "$@"; }

png_size() { identify -format '%w x %h' "$1"; }

# json_number FILE KEY: the first one of that name.
json_number() { grep -m 1 "\"$2\"" "$1" | sed 's/.*: //; s/,.*//'; }

test_compare_writes_every_file_of_the_report() {
    local name file
    compare_crate --out "$tmp/all" >"$tmp/table"
    for name in reference volume ssao hsao hbao gtao hao; do
        for file in "$name.png" "lit_$name.png"; do
            [ "$(png_size "$tmp/all/$file")" = '96 x 64' ]
        done
        [ "$(head -c 14 "$tmp/all/$name.pfm" | tr '\n' ' ')" = 'Pf 96 64 -1.0 ' ]
        [ "$(stat -c %s "$tmp/all/$name.pfm")" -eq $((14 + 96 * 64 * 4)) ]
        assert_holds "$(cat "$tmp/table")" "$name"
    done
    for name in volume ssao hsao hbao gtao hao; do
        [ "$(png_size "$tmp/all/error_$name.png")" = '96 x 64' ]
    done
    [ "$(identify -format '%w' "$tmp/all/compare.png")" -gt 800 ]
    [ ! -e "$tmp/all/error_reference.png" ]
    [ "$(find "$tmp/all" -type f | wc -l)" -eq $((7 * 3 + 6 + 2)) ] # nothing temporary is left
}

test_views_are_written_when_asked_for_and_go_with_the_next_run() {
    local name
    compare_crate --out "$tmp/views" --techniques ssao --view depth,shadow_map,light >"$tmp/table"
    for name in depth shadow_map light; do
        [ "$(png_size "$tmp/views/view_$name.png")" = '96 x 64' ]
    done
    not cmp -s "$tmp/views/view_light.png" "$tmp/views/lit_ssao.png"
    compare_crate --out "$tmp/views" --techniques ssao --view lit >"$tmp/table"
    cmp "$tmp/views/view_lit.png" "$tmp/views/lit_ssao.png"
    [ "$(find "$tmp/views" -name 'view_*' | wc -l)" -eq 1 ]
}

test_compare_json_holds_what_was_measured() {
    compare_crate --out "$tmp/json" --techniques volume --camera corner --r-max 0.75 --falloff linear --json >"$tmp/printed"
    cmp "$tmp/printed" "$tmp/json/compare.json"
    local key
    for key in scene size camera r_max falloff renderer volumes dimensions bytes bake_ms name ms_median ms_min ms_max rmse mae \
        bias p99 max texture_fetches_per_pixel params; do
        assert_holds "$(cat "$tmp/printed")" "\"$key\":"
    done
    [ "$(json_number "$tmp/printed" r_max)" = 0.75 ]
    [ "$(json_number "$tmp/printed" size)" = '[96' ]
    [ "$(json_number "$tmp/printed" falloff)" = '"linear"' ]
    # Near the truth, but not the truth itself.
    awk -v rmse="$(json_number "$tmp/printed" rmse)" 'BEGIN { exit !(rmse > 0 && rmse < 0.15) }'
    awk -v fetches="$(json_number "$tmp/printed" texture_fetches_per_pixel)" 'BEGIN { exit !(fetches > 1 && fetches < 5000) }'
}

test_instability_is_measured_from_a_second_camera() {
    compare_crate --out "$tmp/unsteady" --techniques volume,ssao --json >"$tmp/printed"
    assert_holds "$(cat "$tmp/printed")" '"second_camera":'
    [ "$(grep -c '"instability":' "$tmp/printed")" -eq 3 ] # the reference's own is the floor
    local turn pixels geometry
    turn=$(json_number "$tmp/printed" turn_degrees)
    pixels=$(json_number "$tmp/printed" instability_pixels)
    geometry=$(json_number "$tmp/printed" pixels_with_geometry)
    [ "$turn" = 20 ] || [ "$turn" = -20 ]
    [ "$pixels" -ge $((geometry / 4)) ]
    [ "$pixels" -lt "$geometry" ] # it does not see the crate's other side
    awk -v floor="$(json_number "$tmp/printed" instability)" 'BEGIN { exit !(floor > 0 && floor < 0.1) }'
}

test_instability_can_be_left_out_and_changes_nothing_else() {
    compare_crate --out "$tmp/steady" --techniques volume >"$tmp/table"
    assert_holds "$(cat "$tmp/table")" unsteady
    compare_crate --out "$tmp/plain" --techniques volume --no-instability >"$tmp/table"
    not grep -qi unsteady "$tmp/table"
    not grep -q 'instability\|second_camera' "$tmp/plain/compare.json"
    cmp "$tmp/steady/volume.pfm" "$tmp/plain/volume.pfm"
    # The camera of the report is the first one, whoever looked last.
    [ "$(grep -m 1 view_from_world "$tmp/steady/compare.json")" = "$(grep -m 1 view_from_world "$tmp/plain/compare.json")" ]
    [ "$(json_number "$tmp/steady/compare.json" rmse)" = "$(json_number "$tmp/plain/compare.json" rmse)" ]
}

test_compare_gives_the_same_picture_twice() {
    compare_crate --out "$tmp/once" --techniques volume,ssao
    compare_crate --out "$tmp/twice" --techniques volume,ssao
    local name
    for name in reference volume ssao; do
        cmp "$tmp/once/$name.pfm" "$tmp/twice/$name.pfm"
    done
}

test_a_second_run_reads_volumes_from_the_cache() {
    rm -rf "$tmp/cache of its own"
    compare_crate --cache "$tmp/cache of its own" --out "$tmp/cached" --techniques ssao --json | grep -q '"cached": false'
    compare_crate --cache "$tmp/cache of its own" --out "$tmp/cached" --techniques ssao --json >"$tmp/printed"
    not grep -q '"cached": false' "$tmp/printed"
    grep -q '"cached": true' "$tmp/printed"
}

test_parameters_are_applied_and_reported() {
    compare_crate --out "$tmp/params" --techniques volume --param volume.rays=3 --param volume.combine=multiply \
        --param ao.filter=none --ao-scale 1/2 --json >"$tmp/printed"
    assert_holds "$(cat "$tmp/printed")" '"rays": 3'
    assert_holds "$(cat "$tmp/printed")" '"combine": "multiply"'
    assert_holds "$(cat "$tmp/printed")" '"filter": "none"'
    assert_holds "$(cat "$tmp/printed")" '"scale": "half"'
}

test_every_parameter_of_the_tables_is_listed_and_can_be_set_to_its_initial_value() {
    compare --list-params >"$tmp/listed"
    local file owner row name initial count=0
    for file in modules/ao/params.def modules/ao_*/params.def modules/plan/params.def; do
        owner=$(basename "$(dirname "$file")")
        while IFS= read -r row; do
            name=${owner#ao_}.$row
            grep -q "^$name  *[^ ]" "$tmp/listed" || { echo "$name is not listed"; return 1; }
            count=$((count + 1))
        done < <(sed -n 's/^NOOK_[A-Z]*(\([a-z0-9_]*\),.*/\1/p' "$file")
    done
    [ "$(grep -c '^[a-z]*\.[a-z0-9_]* ' "$tmp/listed")" -eq "$count" ]
    while read -r name initial _; do # past the parameters, the scene that is none stops it
        refused 1 'no such file' "$tmp/missing.glb" --param "$name=$initial"
    done < <(grep '^[a-z]*\.' "$tmp/listed")
}

# refused CODE TEXT ARGUMENT...: that exit code, one line that holds TEXT, and no files.
refused() {
    local code=$1 text=$2 said
    shift 2
    rm -rf "$tmp/refused"
    said=$(assert_fails "$code" compare --size 96x64 --frames 1 --out "$tmp/refused" "$@")
    assert_holds "$said" "$text"
    [ "$(wc -l <<<"$said")" -eq 1 ]
    [ ! -e "$tmp/refused" ]
}

test_bad_input_is_one_line_and_leaves_nothing_behind() {
    refused 1 'no such file' "$tmp/missing.glb"
    refused 1 'directory' "$tmp"
    printf 'glTF is not what this is' >"$tmp/broken.glb"
    refused 1 'broken.glb' "$tmp/broken.glb"
    refused 2 "choose from volume, ssao, hsao, hbao, gtao, hao, reference" "$crate" --techniques volume,magic
    refused 1 "'corner'" "$crate" --camera nowhere
    refused 2 'shadow_map' "$crate" --view shadows
    refused 2 'field of view' "$crate" --camera 1,1,1,0,0,0,179
    refused 2 'seven numbers' "$crate" --camera 1,1,1,0,0,0
    refused 2 'two points' "$crate" --camera 1,1,1,1,1,1,60
    refused 2 'falloff' "$crate" --falloff sudden
    refused 2 'rays' "$crate" --param volume.rays=0
    refused 2 'nonsense' "$crate" --param volume.nonsense=1
    refused 2 'magic' "$crate" --param magic.rays=1
    refused 2 'technique.name=value' "$crate" --param volume.rays
    refused 2 'no such parameter' "$crate" --param volume=3
    refused 2 '--r-max sets the same' "$crate" --r-max 1 --param ao.r_max=2
    refused 2 '--falloff sets the same' "$crate" --param ao.falloff=hard --falloff linear
    refused 2 '--ao-scale sets the same' "$crate" --param ao.scale=half --ao-scale half
    refused 2 '--reference-rays sets the same' "$crate" --param reference.rays=4 --reference-rays 4
    refused 2 'magic' "$tmp/missing.glb" --techniques magic # before the scene is looked for
}

test_a_camera_that_sees_nothing_is_refused() {
    assert_holds "$(assert_fails 1 compare_crate --out "$tmp/nothing" --camera 0,5,0,0,9,0,40)" 'sees nothing'
}

test_an_output_folder_that_cannot_be_written_is_refused_before_the_work() {
    printf 'a file' >"$tmp/in the way"
    assert_holds "$(assert_fails 1 compare_crate --out "$tmp/in the way")" 'in the way'
    assert_holds "$(assert_fails 1 compare_crate --out "$tmp/in the way/deeper")" 'in the way'
    assert_holds "$(assert_fails 1 compare_crate --out /proc/nook)" '/proc/nook'
    [ "$(cat "$tmp/in the way")" = 'a file' ]
}

test_a_cache_that_cannot_be_written_is_one_warning() {
    compare_crate --out "$tmp/uncached" --techniques volume --cache /proc/nook >/dev/null 2>"$tmp/said"
    [ "$(grep -c /proc/nook "$tmp/said")" -eq 1 ]
}

# add_crates COUNT: the scene with that many crates more, in rows far away.
add_crates() {
    awk -v count="$1" '
        / "cameras": \[/ {
            for (i = 0; i < count; i++)
                printf ", { \"mesh\": 1, \"translation\": [%d, 0, %d], \"extras\": { \"nook_body\": true } }", 10 + i % 70 * 2, 10 + i / 70 * 2
        }
        NR > 1 { print last }
        { last = $0 }
        /^    2$/ && !listed { for (i = 0; i < count; i++) last = last ", " i + 3; listed = 1 }
        END { print last }' "$crate"
}

test_thousands_of_bodies_are_compared() {
    add_crates 4200 >"$tmp/crates.gltf"
    compare "$tmp/crates.gltf" --size 24x16 --frames 1 --reference-rays 1 --no-instability --techniques volume --r-max 0.5 \
        --out "$tmp/crates" --json >"$tmp/printed"
    assert_holds "$(cat "$tmp/printed")" '"instances": 4201'
}

test_a_second_run_replaces_the_first_one_whole() {
    compare_crate --out "$tmp/again" --techniques volume,ssao
    printf 'mine' >"$tmp/again/notes.png"
    compare "$crate" --size 48x32 --frames 1 --reference-rays 4 --out "$tmp/again" --techniques hsao
    [ "$(png_size "$tmp/again/hsao.png")" = '48 x 32' ]
    [ -z "$(find "$tmp/again" -name '*volume*' -o -name '*ssao*')" ]
    [ "$(cat "$tmp/again/notes.png")" = mine ]
    [ "$(find "$tmp/again" -mindepth 1 | wc -l)" -eq $((1 + 2 * 3 + 1 + 2)) ]
}

test_a_run_that_fails_leaves_the_files_of_the_one_before() {
    compare_crate --out "$tmp/kept" --techniques ssao
    local before
    before=$(cd "$tmp/kept" && sha256sum ./*)
    mkdir "$tmp/kept/hsao.pfm"
    assert_holds "$(assert_fails 1 compare_crate --out "$tmp/kept" --techniques hsao)" hsao.pfm
    rmdir "$tmp/kept/hsao.pfm"
    [ "$(cd "$tmp/kept" && sha256sum ./*)" = "$before" ]
    [ -z "$(find "$tmp/kept" -name '.*' -type d)" ]
}

test_one_pixel_is_a_picture() {
    compare "$crate" --size 1x1 --frames 1 --reference-rays 4 --camera 1,2,3,0,0,0,40 --out "$tmp/one"
    [ "$(png_size "$tmp/one/volume.png")" = '1 x 1' ]
}

run_tests
