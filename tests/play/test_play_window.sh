#!/usr/bin/env bash
# A game in a window under Xvfb: keys, pictures, and the state that they lead to. What is done in one go is in test_play_flow.sh.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh
level=tests/play/data/crate.level

# beside_game SCRIPT [OPTION...]: beside `nook play $level`; an interrupt ends it.
beside_game() {
    local beside=$1
    shift
    in_window_of "Nook - One crate" "xdotool windowfocus --sync \$window; sleep 0.5
        $beside
        kill -INT \$program_id" \
        play "$level" --size 320x200 --cache "$tmp/cache" "$@"
}

# in_game SCRIPT [OPTION...]: the same, recorded.
in_game() { beside_game "$@" --record "$tmp/played.replay"; }

test_keys_walk_take_and_let_go_and_the_recording_replays_to_the_same_state() {
    rm -f "$tmp/played.replay"
    in_game '
        see before
        press e; wait_for 30 title_has "carrying crate"
        hold s 0.6
        press e; wait_for 30 log_has "let go of crate"
        hold w 0.3; sleep 0.5
        see after'
    not cmp -s "$tmp/before.png" "$tmp/after.png"
    grep -q 'took crate' "$tmp/log"
    grep -q '^[0-9]* 0 -127 ' "$tmp/played.replay" # walked backwards
    local in_window
    in_window=$(tail -n 1 "$tmp/table")
    assert_holds "$in_window" ", hash "
    [ "$("$program" play --headless --replay "$tmp/played.replay" | tail -n 1)" = "$in_window" ]
}

test_escape_pauses_the_menu_takes_the_mouse_and_escape_goes_on() {
    in_game '
        press Escape; wait_for 30 title_has paused
        ticks=$(date +%s); hold w 0.5
        press F1
        sleep 0.5; import -window "$window" "$tmp/menu.png"
        press Escape; wait_for 30 log_has "play: goes on"
        wait_for 30 not title_has paused'
    not grep -q '^[0-9]* 0 127 ' "$tmp/played.replay" # nothing walks while it is paused
}

test_preferences_last_from_one_game_to_the_next() {
    rm -f "$tmp/cache/preferences.txt"
    in_game 'press F11; sleep 1; press F11; press Escape; wait_for 30 title_has paused'
    grep -q '^full_screen = no' "$tmp/cache/preferences.txt" # as it was
    in_game 'press F11; wait_for 30 grep -q "^full_screen = yes" "$tmp/cache/preferences.txt"' # however the game ends
    in_game 'wait_for 30 eval "xdotool getwindowgeometry $window | grep -q 800x600"'
    rm "$tmp/cache/preferences.txt"
}

# drawn_with: takes a picture. Pixels along the first side of the frame that it was made of; 0 while it is not written.
drawn_with() {
    press F12; sleep 0.5
    [ -e "$tmp/shots/nook_0001.settings" ] || { echo 0; return; }
    sed -n 's/^# \([0-9]*\) x [0-9]* pixels.*/\1/p' "$(printf '%s\n' "$tmp"/shots/*.settings | tail -n 1)"
}
is_smaller() { local drawn; drawn=$(drawn_with); [ "$drawn" -ge 320 ] && [ "$drawn" -lt 640 ]; }
is_whole() { [ "$(drawn_with)" -eq 640 ]; }

test_the_picture_gets_smaller_for_the_rate_that_is_wanted_and_fills_the_window() {
    export -f drawn_with is_smaller is_whole
    rm -rf "$tmp/shots"
    printf 'frame_rate = 120\n' >"$tmp/cache/preferences.txt" # more than software draws of such a size
    in_game '
        wait_for 60 is_smaller
        press t; wait_for 30 title_has frozen
        press m; sleep 1; is_smaller # its truth is of these pixels' --size 640x360 --out "$tmp/shots"
    [ "$(identify -format '%wx%h\n' "$tmp"/shots/*.png | sort -u)" = 640x360 ]
    rm -rf "$tmp/shots"
    printf 'frame_rate = 0\n' >"$tmp/cache/preferences.txt"
    in_game 'sleep 3; wait_for 30 is_whole; sleep 1; is_whole' --size 640x360 --out "$tmp/shots"
    rm "$tmp/cache/preferences.txt"
}

test_a_whole_number_among_the_preferences_can_be_dragged() {
    rm -f "$tmp/cache/preferences.txt"
    in_game '
        press Escape; wait_for 30 title_has paused
        to() { xdotool mousemove --window "$window" "$1" 319; sleep 0.4; } # "frame rate"
        to 180; to 190; xdotool mousedown 1; sleep 0.4; to 231; to 247; to 253; xdotool mouseup 1; sleep 1
        not log_has "whole number"' --size 640x360
    grep -Eq '^frame_rate = ([3-9][0-9]|1[0-1][0-9])$' "$tmp/cache/preferences.txt"
    rm "$tmp/cache/preferences.txt"
}

test_preferences_that_cannot_be_kept_are_one_warning_and_the_game_ends_as_it_did() {
    echo 'no folder' >"$tmp/no_folder"
    in_game '
        press F11
        wait_for 30 eval "xdotool getwindowgeometry $window | grep -q 800x600"' --cache "$tmp/no_folder/cache"
    [ "$(grep -c 'preferences.txt: cannot write: Not a directory' "$tmp/log")" -eq 1 ]
}

# asks: below the cross, which may be of that colour too.
asks() { has_colour 'rgb(255,214,120)' 320x50+0+118; }

test_the_first_backspace_asks_and_the_second_begins_from_the_start() {
    rm -f "$tmp/played.replay"
    export -f asks
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        not asks
        press BackSpace; wait_for 30 asks
        title_has "carrying crate"
        wait_for 30 not asks # by mistake
        title_has "carrying crate"
        for _ in {1..20}; do # within 3 s
            press BackSpace; sleep 0.6
            title_has "carrying crate" || break
        done
        not title_has "carrying crate"'
    [ "$(awk 'NF == 6 && int($4 / 32) % 2 { n += $1 } END { print n + 0 }' "$tmp/played.replay")" -eq 1 ]
    [ "$("$program" play --headless --replay "$tmp/played.replay" | tail -n 1)" = "$(tail -n 1 "$tmp/table")" ]
}

test_the_button_of_the_menu_that_begins_from_the_start_asks_first() {
    in_game '
        point() { # a pointer hovers before it presses
            xdotool mousemove --window "$window" 145 91; sleep 0.3
            xdotool mousemove --window "$window" 150 92; sleep 0.5
            xdotool click 1; sleep 1
        }
        press e; wait_for 30 title_has "carrying crate"
        press Escape; wait_for 30 title_has paused
        point
        title_has "carrying crate"
        point; wait_for 30 not title_has "carrying crate"'
    [ "$(awk 'NF == 6 && int($4 / 32) % 2 { n += $1 } END { print n + 0 }' "$tmp/played.replay")" -eq 1 ]
}

# has_letters COLOUR PART: inside of a letter a colour is whole.
has_letters() { see seen && [ "$(convert "$tmp/seen.png" -crop "$2" +repage -fuzz 3% -fill black +opaque "$1" -format '%[fx:maxima > 0 ? 1 : 0]' info:)" = 1 ]; }
hint_is_above() { has_letters 'rgb(255,255,255)' 60x14+130+51; } # the cross is in the middle
hint_is_below() { has_letters 'rgb(255,255,255)' 60x14+130+135; }

test_in_a_low_window_the_hint_stands_above_the_cross_as_long_as_a_message_is_below_it() {
    export -f has_letters hint_is_above hint_is_below
    in_game '
        wait_for 30 hint_is_above
        wait_for 60 not hint_is_above
        wait_for 30 hint_is_below'
}

lists_its_own_keys() { has_letters 'rgb(255,214,120)' 130x230+0+60; } # beside the cross
lists_keys_of_views() { has_letters 'rgb(255,180,60)' 400x240+0+60; }

test_in_a_small_window_lists_of_keys_come_one_after_the_other() {
    export -f has_letters lists_its_own_keys lists_keys_of_views
    in_game '
        not lists_its_own_keys
        press F1; wait_for 30 lists_its_own_keys
        not lists_keys_of_views
        press F1; wait_for 30 lists_keys_of_views
        not lists_its_own_keys
        press F1; wait_for 30 not lists_keys_of_views
        not lists_its_own_keys' --size 400x300
}

test_a_saved_settings_file_is_used_a_wrong_one_is_said_and_the_old_one_stays() {
    printf 'technique = volume\nrays = 2\n' >"$tmp/live.settings"
    in_game '
        printf "technique = hbao\ndirections = 3\n" >"$tmp/new"
        mv "$tmp/new" "$tmp/live.settings" # as editors save
        wait_for 30 log_has "settings taken over: hbao directions=3"
        echo "directions = many" >>"$tmp/live.settings"
        wait_for 30 log_has "live.settings:3"
        wait_for 30 has_red
        printf "technique = ssao\nplan.error = 0.5\n" >"$tmp/live.settings" # of no plan
        wait_for 30 log_has "settings taken over: ssao"
        wait_for 30 has_no_red
        not log_has "next start"' --settings "$tmp/live.settings"
}

test_volumes_are_planned_anew_when_saved_settings_multiply_them_and_other_plans_wait() {
    printf 'technique = volume\nplan = measured\n' >"$tmp/plan.settings"
    beside_game '
        printf "technique = volume\nplan = measured\nrays = 3\n" >"$tmp/plan.settings"
        wait_for 30 log_has "settings taken over: volume rays=3"
        printf "technique = volume\nplan = measured\ncombine = multiply\n" >"$tmp/plan.settings"
        wait_for 60 log_has "scene: .* reloaded"
        printf "technique = volume\nplan = on\n" >"$tmp/plan.settings"
        wait_for 30 log_has "taken over with the next start"' --settings "$tmp/plan.settings"
    [ "$(grep -n 'settings taken over: volume combine=multiply' "$tmp/log" | cut -d : -f 1)" -lt "$(grep -n 'scene: .* reloaded' "$tmp/log" | head -n 1 | cut -d : -f 1)" ]
}

test_a_recording_does_not_end_for_another_plan() {
    printf 'technique = volume\nplan = measured\n' >"$tmp/plan.settings"
    in_game '
        printf "technique = volume\nplan = measured\ncombine = multiply\n" >"$tmp/plan.settings"
        wait_for 30 log_has "settings taken over: volume combine=multiply"
        sleep 2' --settings "$tmp/plan.settings"
    not grep -q 'scene: .* reloaded' "$tmp/log"
    [ "$("$program" play --headless --replay "$tmp/played.replay" | tail -n 1)" = "$(tail -n 1 "$tmp/table")" ]
}

test_a_saved_level_is_gone_on_in_a_wrong_one_is_said_and_the_old_one_stays() {
    local level=$tmp/level/crate.level
    mkdir -p "$tmp/level"
    sed 's/^scene = .*/scene = crate.gltf/' tests/play/data/crate.level >"$level"
    cp "$crate" "$tmp/level/crate.gltf"
    export level
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        press e; wait_for 30 log_has "let go of crate"
        sed "s/^task .*/task = Elsewhere/; s/^\[body crate\]/&\nat = -1 0 0/" "$level" >"$tmp/new"
        mv "$tmp/new" "$level" # as editors save
        wait_for 60 log_has "scene: .* reloaded"
        echo "[body nothing]" >>"$level"
        wait_for 60 log_has "crate.level:[0-9]*: "
        wait_for 30 has_red
        sed -i "/^\[body nothing\]/d" "$level"
        wait_for 60 has_no_red'
    [ "$(grep -c 'scene: .* reloaded' "$tmp/log")" -eq 2 ]
    grep -q 'ends here' "$tmp/log" # what follows would not play back
}

test_other_settings_that_a_saved_level_names_are_used() {
    local level=$tmp/level/settings.level
    mkdir -p "$tmp/level"
    sed 's/^scene = .*/scene = crate.gltf/' tests/play/data/crate.level >"$level"
    cp "$crate" "$tmp/level/crate.gltf"
    printf 'technique = hbao\ndirections = 3\n' >"$tmp/level/other.settings"
    export level
    in_game '
        sed "s/^scene = .*/&\nsettings = other.settings/" "$level" >"$tmp/new"
        mv "$tmp/new" "$level" # as editors save
        wait_for 60 log_has "settings taken over: hbao directions=3"
        printf "technique = ssao\n" >"$tmp/level/other.settings"
        wait_for 30 log_has "settings taken over: ssao"
        sed -i "s/^settings = .*/settings = nothing.settings/" "$level"
        wait_for 60 log_has "nothing.settings: "
        wait_for 30 has_red
        sed -i "/^settings = /d" "$level"
        wait_for 60 log_has "names no settings any more"'
}

test_undo_is_where_the_layout_has_its_letter() {
    command -v setxkbmap >/dev/null || skip_test "setxkbmap is not installed"
    rm -rf "$tmp/layout"
    mkdir "$tmp/layout"
    in_game '
        setxkbmap de
        shown() { wait_for 30 [ -s "$tmp/layout/nook_000$1.settings" ]; grep -o "view 1.*shows [a-z]*" "$tmp/layout/nook_000$1.settings"; }
        press F12; first=$(shown 1)
        press m; sleep 0.5; press F12; second=$(shown 2)
        press ctrl+z; sleep 0.5; press F12; third=$(shown 3)
        press ctrl+y; sleep 0.5; press F12; fourth=$(shown 4)
        echo "$first, $second, $third, $fourth"
        [ "$first" != "$second" ]
        [ "$first" = "$third" ]
        [ "$second" = "$fourth" ]' --out "$tmp/layout"
}

test_without_a_display_one_line_says_what_to_give() {
    local said
    said=$(unset DISPLAY WAYLAND_DISPLAY; assert_fails 1 "$program" play "$level" --cache "$tmp/cache")
    assert_holds "$said" "there is no display to play on; give --replay or --pilot"
}

run_tests
