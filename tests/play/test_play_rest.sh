#!/usr/bin/env bash
# What a game in a window leaves to others while nothing moves.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh

# The game's processor time in two seconds, in hundredths of a second of all threads.
cat >"$tmp/spent.sh" <<'END'
spent() {
    local before
    before=$(awk '{ print $14 + $15 }' "/proc/$program_id/stat")
    sleep 2
    echo $(($(awk '{ print $14 + $15 }' "/proc/$program_id/stat") - before))
}
END

test_a_game_that_is_paused_rests_and_what_is_changed_in_its_menu_is_seen() {
    in_window_of "Nook - One crate" '
        source "$tmp/spent.sh"
        xdotool windowfocus --sync $window; sleep 0.5
        press Escape; wait_for 30 title_has paused
        sleep 1
        hundredths=$(spent)
        echo "paused: $hundredths hundredths of a second in two seconds"
        [ $hundredths -lt 100 ]
        import -window "$window" "$tmp/paused.png"
        press F1; sleep 1
        differs() { import -window "$window" "$tmp/help.png"; ! cmp -s "$tmp/paused.png" "$tmp/help.png"; }
        wait_for 30 differs
        press Escape; wait_for 30 log_has "play: goes on"
        import -window "$window" "$tmp/before.png"
        hold w 0.5
        walked() { import -window "$window" "$tmp/after.png"; ! cmp -s "$tmp/before.png" "$tmp/after.png"; }
        wait_for 30 walked
        kill -INT $program_id' \
        play tests/play/data/crate.level --size 320x200 --cache "$tmp/cache"
}

run_tests
