#!/usr/bin/env bash
# Whose the mouse is: the game's while it is captured, else a pointer.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh

# in_game SCRIPT: beside a game whose inputs are recorded; an interrupt ends it.
in_game() {
    in_window_of "Nook - One crate" "xdotool windowfocus --sync \$window; sleep 0.5
        $1
        sleep 0.5
        kill -INT \$program_id" \
        play tests/play/data/crate.level --size 640x360 --cache "$tmp/cache" --record "$tmp/pointed.replay"
}

# Whether a recording has a line of inputs of which that is true; $4 are buttons, $5 yaw, $6 pitch.
recorded() { [ -n "$(awk "NR > 3 && /^[0-9]/ && ($1)" "$tmp/pointed.replay")" ]; }

test_a_captured_mouse_looks_around_and_takes() {
    in_game 'xdotool mousemove_relative 60 20; sleep 0.5; xdotool mousemove_relative -- -60 -20; sleep 0.5
        xdotool click 1; wait_for 30 title_has "carrying crate"'
    recorded '$5 != 0'
    recorded '$4 ~ /8/' # takes
}

test_a_pointer_on_its_way_to_a_panel_neither_looks_around_nor_takes() {
    in_game 'press F2; sleep 1
        for x in 40 80 120 160 120; do xdotool mousemove --window "$window" $x $((x + 40)); sleep 0.2; done
        xdotool click 1; sleep 0.5
        press F2; sleep 0.5
        press e; wait_for 30 title_has "carrying crate"'
    not recorded '$5 != 0 || $6 != 0'
    [ "$(grep -c ' 0x8 ' "$tmp/pointed.replay")" -eq 1 ] # the key alone
}

run_tests
