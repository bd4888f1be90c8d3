#!/usr/bin/env bash
# One game in a window from its start to its end, and all that can be done to it while it runs, one after the other in the same
# process. Every step is asserted by what is seen and by what the program says of its state.
# shellcheck disable=SC2154 # window is that of in_window_of
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh
source tests/support/exchange.sh
level=tests/play/data/crate.level

# Of a window of 480x300 with two views, beside names, hints and notes: the first view, and the second.
first=200x180+10+60 second=200x180+270+60
export first second

# is PICTURE PART EXPRESSION: whether that holds of a part of it, in hue, saturation, lightness as r, g, b.
is() { [ "$(convert "$tmp/$1.png" -crop "$2" +repage -colorspace HSL -format "%[fx:$3 ? 1 : 0]" info:)" = 1 ]; }
# same PICTURE OTHER PART: to the last bit.
same() { [ "$(convert "$tmp/$1.png" "$tmp/$2.png" -crop "$3" +repage -compose difference -composite -format '%[fx:maxima == 0 ? 1 : 0]' info:)" = 1 ]; }
second_is() { see seen && is seen "$second" "$1"; }
# ticks_of LINE: of the log's last line with that.
ticks_of() { grep -- "$1" "$tmp/log" | tail -n 1 | sed 's/.* after \([0-9]*\) ticks$/\1/'; }

it_starts() {
    xdotool windowfocus --sync "$window"
    sleep 0.5
    see started
    [ "$(identify -format %wx%h "$tmp/started.png")" = 480x300 ]
    is started 480x300+0+0 'standard_deviation.b > 0.05'
    log_has 'is taken over'
}

within_reach() { has_colour 'rgb(255,214,120)' 20x20+230+140; } # the cross is gold
out_of_reach() { not within_reach; }

elsewhere() { see seen && not same taken seen "$first"; }

keys_walk() {
    wait_for 10 within_reach
    step_until d out_of_reach
    see walked
    not same started walked "$first"
    step_until a within_reach
}

the_crate_is_taken() {
    press e
    wait_for 10 title_has 'carrying crate'
    log_has 'play: took crate'
    see taken
    step_until d elsewhere
    within_reach # it came along
}

the_view_is_split() {
    press plus
    wait_for 10 has_pixel 240 100 141414
    press Tab
    wait_for 10 has_colour 'rgb(255,180,60)' 60x20+420+0 # the name of the second view
    press m
    wait_for 10 second_is 'mean.g == 0' # visibility is grey
    is seen "$first" 'mean.g > 0.02'
}

a_saved_shader_is_seen() {
    shader=$root/shaders/render/tone.glsl
    cp "$shader" "$tmp/tone.glsl"
    before=$(pixel 20 280)
    sed -i '/^vec3 srgb_encode/,/{/ s/{/{ return vec3(1.0, 0.0, 1.0);/' "$shader"
    wait_for 10 has_pixel 20 280 FF00FF
    log_has 'shaders: .* reloaded, .* (shaders/render/tone.glsl'
}

a_broken_one_is_said_and_the_last_good_stays() {
    echo 'float broken = no_such_name;' >>"$shader"
    wait_for 10 log_has "shaders/render/tone.glsl:$(wc -l <"$shader"): error: .*no_such_name"
    wait_for 10 has_red
    has_pixel 20 280 FF00FF
    title_has 'carrying crate'
}

the_mended_one_is_seen() {
    cp "$tmp/tone.glsl" "$tmp/new"
    mv "$tmp/new" "$shader" # as editors save
    wait_for 10 has_pixel 20 280 "$before"
    wait_for 10 has_no_red
}

new_code_runs() {
    not has_colour 'rgb(0,255,255)'
    make_game game/play/play_panels.c 's/gold = { 255, 214, 120, 255 }/gold = { 0, 255, 255, 255 }/'
    wait_for 10 has_colour 'rgb(0,255,255)' # of the cross
    wait_for 10 log_has 'new code runs: game (state kept'
    title_has 'carrying crate'
    second_is 'mean.g == 0'
}

more_rays() { see still && not same frozen still 200x30+0+250; }

it_freezes_for_the_truth() {
    press t
    wait_for 10 title_has frozen
    press m # the error, which nobody knows without the truth
    wait_for 60 second_is 'mean.g > 0.02' # traced when nobody else wants a core
    see frozen
    hold_until s more_rays
    same frozen still "$first"
}

a_picture_is_taken() {
    press F12
    wait_for 10 log_has 'picture: .*nook_0001.png'
    [ "$(identify -format %wx%h "$tmp/nook_0001.png")" = 480x300 ]
    same still nook_0001 "$first"
    grep -q '^# truth by [0-9]* rays' "$tmp/nook_0001.settings"
    grep -q '^# view 2 (below): volume; shows error; .*RMSE' "$tmp/nook_0001.settings"
}

it_goes_on_where_it_stood() {
    press t
    wait_for 10 log_has 'play: goes on'
    wait_for 10 not title_has frozen
    [ "$(ticks_of 'play: frozen')" = "$(ticks_of 'play: goes on')" ]
}

it_is_quit_from_the_menu() {
    press Escape
    wait_for 10 title_has paused
    xdotool mousemove --window "$window" 271 93 # "Quit"
    sleep 0.3
    xdotool click 1
    wait_for 10 not find_window
}
export -f is same second_is ticks_of within_reach out_of_reach elsewhere more_rays
export -f it_starts keys_walk the_crate_is_taken the_view_is_split a_saved_shader_is_seen a_broken_one_is_said_and_the_last_good_stays
export -f the_mended_one_is_seen new_code_runs it_freezes_for_the_truth a_picture_is_taken it_goes_on_where_it_stood it_is_quit_from_the_menu

test_all_that_can_be_done_is_done_in_one_game_and_the_recording_replays_to_its_state() {
    copy_root
    rm -rf "$NOOK_LIVE" "$tmp"/nook_* "$tmp/played.replay"
    mkdir -p "$NOOK_LIVE"
    in_window_of "Nook - One crate" '
        source tests/support/exchange.sh
        for step in it_starts keys_walk the_crate_is_taken the_view_is_split a_saved_shader_is_seen \
            a_broken_one_is_said_and_the_last_good_stays the_mended_one_is_seen new_code_runs it_freezes_for_the_truth \
            a_picture_is_taken it_goes_on_where_it_stood it_is_quit_from_the_menu; do
            echo "$SECONDS s: $step"
            $step
        done' \
        play "$level" --size 480x300 --cache "$tmp/cache" --out "$tmp" --record "$tmp/played.replay"
    grep -q '^[0-9]* 127 0 ' "$tmp/played.replay"
    not grep -q '^[0-9]* 0 -127 ' "$tmp/played.replay" # while it was frozen
    [ "$("$program" play --headless --replay "$tmp/played.replay" | tail -n 1)" = "$(tail -n 1 "$tmp/table")" ]
}

run_tests
