#!/usr/bin/env bash
# `compare` with a display: a window under Xvfb, steered with xdotool.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh

test_the_window_opens_after_the_comparison_and_escape_closes_it() {
    rm -rf "$tmp/out"
    in_window 'title_has "1 volume"; [ -s "$tmp/out/compare.json" ]'
    grep -q '^hsao' "$tmp/table"
}

test_number_keys_choose_the_technique() {
    in_window '
        press 2; wait_for 30 title_has "2 ssao"
        press 6; wait_for 30 title_has "6 hao"
        press 7; wait_for 30 title_has "7 reference"
        press 0; wait_for 30 title_has "0 none"
        press 9; press 3; wait_for 30 title_has "3 hsao"'
    [ "$(grep -c 'view: technique' "$tmp/log")" -eq 6 ] # 9 is nobody
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
    not grep -q 'technique volume\|technique ssao' "$tmp/log"
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
        differs() { import -window root "$tmp/after.png"; not cmp -s "$tmp/before.png" "$tmp/after.png"; }
        wait_for 30 differs
        xdotool windowsize "$window" 500 300
        filled() { import -window "$window" "$tmp/resized.png"; [ "$(convert "$tmp/resized.png" -crop 40x40+450+10 -format "%[fx:mean>0.2]" info:)" = 1 ]; }
        wait_for 30 filled
        [ "$(identify -format %wx%h "$tmp/resized.png")" = 500x300 ]'
}

test_f1_lists_the_keys_of_the_window_too() {
    in_window '
        press 0; wait_for 30 title_has "0 none"
        xdotool windowsize "$window" 720 400
        # gold is the colour of the names of keys; those of the window itself stand on the left
        gold() { import -window "$window" png:- | convert png:- -crop 300x400+0+0 +repage -fuzz 12% -fill black +opaque "#ffd678" -format "%[fx:mean>0.001]" info:; }
        is_gold() { [ "$(gold)" = "$1" ]; }
        is_gold 0
        press F1; wait_for 30 is_gold 1
        press F1; wait_for 30 is_gold 0'
}

test_no_window_is_opened_when_none_is_wanted() {
    need_display
    with_display "$program" compare "$crate" --size 64x64 --frames 1 --reference-rays 4 --cache "$tmp/cache" \
        --out "$tmp/out" --techniques ssao --no-window
}

run_tests
