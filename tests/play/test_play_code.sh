#!/usr/bin/env bash
# Code that is exchanged under a game in a window: what is seen of it, what of the state stays, what happens to code that is broken.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh
source tests/support/exchange.sh
level=tests/play/data/crate.level

# in_game SCRIPT [OPTION...]: beside `nook play $level`; an interrupt ends it.
in_game() {
    local beside=$1
    shift
    rm -rf "$NOOK_LIVE"
    mkdir -p "$NOOK_LIVE"
    in_window_of "Nook - One crate" "source tests/support/exchange.sh
        xdotool windowfocus --sync \$window; sleep 0.5
        $beside
        kill -INT \$program_id" \
        play "$level" --size 320x200 --cache "$tmp/cache" --record "$tmp/played.replay" "$@"
}

# The state of the game is as if nothing had happened: its recording ends in the same one without any exchange.
is_replayed() { [ "$("$program" play --headless --replay "$tmp/played.replay" | tail -n 1)" = "$(tail -n 1 "$tmp/table")" ]; }

test_saved_code_is_seen_and_the_game_goes_on_where_it_was() {
    rm -f "$tmp/played.replay"
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        make_game game/play/play_tell.c "s/Nook - %s/Mook - %s/"
        wait_for 30 title_has "^Mook - One crate.*carrying crate"
        log_has "new code runs: game (state kept"
        hold s 0.5
        press e; wait_for 30 log_has "let go of crate"
        cp "$bin/ao_volume.so" "$NOOK_LIVE/"
        put_built_game
        wait_for 30 title_has "^Nook - "
        wait_for 30 log_has "new code runs: game, ao_volume (state kept"
        [ "$(find "$NOOK_LIVE" -name "*.*.*.so" | wc -l)" = 2 ]'
    [ -z "$(find "$NOOK_LIVE" -name '*.*.*.so')" ]
    is_replayed
}

test_a_technique_with_a_new_parameter_is_exchanged_alone_and_the_game_goes_on() {
    copy_root
    echo 'technique = gtao' >"$tmp/gtao.settings"
    rm -f "$tmp/played.replay"
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        echo "NOOK_INT(extra, 3, 1, 9, NOOK_UNIT_COUNT, of a test)" >>"$root/modules/ao_gtao/params.def"
        wait_for 30 log_has "modules/ao_gtao/params.def.*build the code anew"
        wait_for 30 has_red
        make_technique gtao
        wait_for 60 log_has "new code runs: ao_gtao (state kept"
        printf "technique = gtao\nextra = 7\n" >"$tmp/gtao.settings"
        wait_for 30 log_has "settings taken over: gtao extra=7"
        wait_for 30 has_no_red
        title_has "carrying crate"
        not log_has "new code runs: game"' --settings "$tmp/gtao.settings"
    is_replayed
}

test_code_that_crashes_is_put_back_said_on_the_screen_and_mended() {
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        make_game game/play/play_tell.c "s/^    char title\[512\]/    abort();\n&/; 1i #include <stdlib.h>"
        wait_for 30 log_has "game: crashed in its first frame (SIGABRT)"
        wait_for 30 has_red
        title_has "carrying crate"
        see crashed
        publish "failed
game/play/play_tell.c:7:1: error: nothing fits"
        wait_for 30 not looks_like crashed
        has_red
        make_game game/play/play_tell.c "s/Nook - %s/Mook - %s/"
        wait_for 30 title_has "^Mook - One crate.*carrying crate"
        wait_for 30 has_no_red'
}

test_code_that_lays_its_state_out_otherwise_begins_anew() {
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        make_game game/world.c "s/^struct nook_game_world {/&\n    double one_more;/"
        wait_for 60 log_has "new code runs: game (state made anew"
        log_has "game: nook_game_world is laid out otherwise"
        find_window; not title_has carrying
        xdotool windowfocus --sync $window; sleep 0.5
        press e; wait_for 30 title_has "carrying crate"'
}

run_tests
