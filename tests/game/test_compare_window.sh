#!/usr/bin/env bash
# `compare` with a display: a window under Xvfb, steered with xdotool.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
crate=tests/game/data/crate.gltf
export tmp crate program=${NOOK_PROGRAM:-build/release/bin/nook}

need_display() {
    local tool
    for tool in Xvfb xdotool import; do
        command -v $tool >/dev/null || skip_test "$tool is not installed"
    done
}

# with_display COMMAND...: under an X server of its own, which finds itself a free display (xvfb-run only guesses) and does not
# start over whenever nobody is connected, as between two calls of xdotool.
with_display() {
    local server code=0
    rm -f "$tmp/display"
    Xvfb -displayfd 1 -screen 0 800x600x24 -nolisten tcp -noreset >"$tmp/display" 2>"$tmp/xvfb.log" &
    server=$!
    for _ in {1..100}; do
        [ ! -s "$tmp/display" ] || break
        sleep 0.1
    done
    DISPLAY=:$(cat "$tmp/display") timeout 200 "$@" || code=$?
    kill $server
    wait $server || true
    return $code
}

# in_window SCRIPT [OPTION...]: runs it beside the program, with its window in $window; the program must end with exit code 0.
in_window() {
    need_display
    export script=$1
    shift
    with_display bash -euc '
        "$program" compare "$crate" --size 320x200 --frames 1 --reference-rays 4 --cache "$tmp/cache" --out "$tmp/out" "$@" \
            >"$tmp/table" 2>"$tmp/log" &
        program_id=$!
        wait_for() { # SECONDS COMMAND...
            local tries=$(($1 * 5))
            shift
            until "$@"; do
                tries=$((tries - 1))
                [ $tries -gt 0 ] && kill -0 $program_id || { echo "waited in vain for: $*"; cat "$tmp/log"; kill $program_id 2>/dev/null || true; wait $program_id || echo "exit code $?"; exit 1; }
                sleep 0.2
            done
        }
        find_window() { window=$(xdotool search --onlyvisible --name "^Nook - crate" 2>/dev/null | head -n 1) && [ -n "$window" ]; }
        title_has() { xdotool getwindowname "$window" | grep -q -- "$1"; }
        press() { xdotool key --window "$window" "$1"; }
        wait_for 120 find_window
        eval "$script"
        xdotool keydown --window "$window" Escape # no release: the window is gone by then
        wait $program_id
    ' in_window "$@"
}

test_the_window_opens_after_the_comparison_and_escape_closes_it() {
    rm -rf "$tmp/out"
    in_window 'title_has "1 volume"; [ -s "$tmp/out/compare.json" ]'
    grep -q '^hsao' "$tmp/table"
}

test_number_keys_choose_the_technique() {
    in_window '
        press 2; wait_for 30 title_has "2 ssao"
        press 6; wait_for 30 title_has "6 reference"
        press 0; wait_for 30 title_has "0 none"
        press 9; press 3; wait_for 30 title_has "3 hsao"'
    [ "$(grep -c 'view: technique' "$tmp/log")" -eq 5 ] # 9 is nobody
}

test_keys_choose_the_view_and_the_camera() {
    in_window '
        press v; wait_for 30 title_has "visibility"
        press v; wait_for 30 title_has "base_colour"
        press c; wait_for 30 grep -q "view: camera corner" "$tmp/log"'
}

test_c_goes_to_the_next_camera_and_number_keys_only_to_chosen_techniques() {
    sed -z 's/    2\n/    2, 3\n/; s/\n \],\n "cameras"/, { "name": "above", "camera": 0, "translation": [2.2, 2, 3.2] }&/' "$crate" >"$tmp/crates.gltf"
    export crate=$tmp/crates.gltf
    in_window '
        title_has "1 hsao"
        press c; wait_for 30 grep -q "view: camera" "$tmp/log"
        press 3; press 2; wait_for 30 title_has "2 reference"' --techniques hsao
    [ "$(grep -m 1 'view: camera' "$tmp/log" | sed 's/.* //')" = above ]
    ! grep -q 'technique volume\|technique ssao' "$tmp/log"
}

test_dragging_turns_the_picture_and_a_new_size_is_filled() {
    in_window '
        press 0; wait_for 30 title_has "0 none"
        import -window root "$tmp/before.png"
        xdotool mousemove --window "$window" 200 100 mousedown 1
        sleep 0.3
        xdotool mousemove --window "$window" 100 110
        sleep 0.3
        xdotool mouseup 1
        differs() { import -window root "$tmp/after.png"; ! cmp -s "$tmp/before.png" "$tmp/after.png"; }
        wait_for 30 differs
        xdotool windowsize "$window" 500 300
        filled() { import -window "$window" "$tmp/resized.png"; [ "$(convert "$tmp/resized.png" -crop 40x40+450+10 -format "%[fx:mean>0.2]" info:)" = 1 ]; }
        wait_for 30 filled
        [ "$(identify -format %wx%h "$tmp/resized.png")" = 500x300 ]'
}

test_no_window_is_opened_when_none_is_wanted() {
    need_display
    with_display "$program" compare "$crate" --size 64x64 --frames 1 --reference-rays 4 --cache "$tmp/cache" \
        --out "$tmp/out" --techniques ssao --no-window
}

run_tests
