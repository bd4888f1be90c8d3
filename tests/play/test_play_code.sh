#!/usr/bin/env bash
# Code that is exchanged under a game in a window: what is seen of it, what of the state stays, what happens to code that is broken.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/window.sh
level=tests/play/data/crate.level
export NOOK_LIVE=$tmp/live
bin=$(dirname "$program")
export bin

# Code as somebody saved it: make_game SOURCE SED compiles one source with a change and makes game.so of it and all others as they are.
cat >"$tmp/make_game.sh" <<'END'
make_game() {
    local flags=(-std=c11 -g -O1 -fPIC -D_DEFAULT_SOURCE -DCGLM_ALL_UNALIGNED -I. -pthread)
    [[ $bin != */sanitize/* ]] || flags+=(-fsanitize=address,undefined -fno-sanitize-recover=all)
    sed "$2" "$1" >"$tmp/$(basename "$1")"
    ! cmp -s "$1" "$tmp/$(basename "$1")" || { echo "make_game: nothing was changed by $2"; return 1; }
    "${CC:-cc}" "${flags[@]}" -shared -o "$NOOK_LIVE/game.so.new" -Wl,-Bsymbolic -Wl,--exclude-libs,ALL game/entry/game_entry.c \
        "$tmp/$(basename "$1")" -Wl,--start-group "$bin"/libnook_{game,measure,fixture,ao,ao_*,bake}.a -Wl,--end-group
    mv "$NOOK_LIVE/game.so.new" "$NOOK_LIVE/game.so"
    publish ok
}
put_built_game() { cp "$bin/game.so" "$NOOK_LIVE/game.so.new"; mv "$NOOK_LIVE/game.so.new" "$NOOK_LIVE/game.so"; publish ok; }
publish() { printf '%s %s' "$(date +%s%N)" "$1" >"$NOOK_LIVE/build.new"; mv "$NOOK_LIVE/build.new" "$NOOK_LIVE/build"; }
red_letters() { # PICTURE: whether there are any
    [ "$(convert "$1" -fuzz 15% -fill black +opaque 'rgb(255,110,100)' -format '%[fx:mean > 0 ? 1 : 0]' info:)" = 1 ]
}
END

# in_game SCRIPT: beside `nook play $level`; an interrupt ends it.
in_game() {
    rm -rf "$NOOK_LIVE"
    mkdir -p "$NOOK_LIVE"
    in_window_of "Nook - One crate" "source \"\$tmp/make_game.sh\"
        xdotool windowfocus --sync \$window; sleep 0.5
        $1
        kill -INT \$program_id" \
        play "$level" --size 320x200 --cache "$tmp/cache" --record "$tmp/played.replay"
}

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
    # The state was the same as if nothing had happened: the recording ends in the same one without any exchange.
    [ "$("$program" play --headless --replay "$tmp/played.replay" | tail -n 1)" = "$(tail -n 1 "$tmp/table")" ]
}

test_code_that_crashes_is_put_back_said_on_the_screen_and_mended() {
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        make_game game/play/play_tell.c "s/^    char title\[512\]/    abort();\n&/; 1i #include <stdlib.h>"
        wait_for 30 log_has "game: crashed in its first frame (SIGABRT)"
        sleep 1
        title_has "carrying crate"
        import -window "$window" "$tmp/crashed.png"; red_letters "$tmp/crashed.png"
        publish "failed
game/play/play_tell.c:7:1: error: nothing fits"
        sleep 1; import -window "$window" "$tmp/failed.png"; red_letters "$tmp/failed.png"
        make_game game/play/play_tell.c "s/Nook - %s/Mook - %s/"
        wait_for 30 title_has "^Mook - One crate.*carrying crate"
        sleep 1; import -window "$window" "$tmp/mended.png"; ! red_letters "$tmp/mended.png"'
}

test_code_that_lays_its_state_out_otherwise_begins_anew() {
    in_game '
        press e; wait_for 30 title_has "carrying crate"
        make_game game/world.c "s/^struct nook_game_world {/&\n    double one_more;/"
        wait_for 60 log_has "new code runs: game (state made anew"
        log_has "game: nook_game_world is laid out otherwise"
        find_window; ! title_has carrying
        xdotool windowfocus --sync $window; sleep 0.5
        press e; wait_for 30 title_has "carrying crate"'
}

run_tests
