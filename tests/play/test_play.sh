#!/usr/bin/env bash
# The game without a window: what ships wins, replays are the same bit for bit, and all ends in order.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
source tests/support/shell.sh
export NOOK_ROOT=$PWD
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
house=content/engine_house/engine_house

play() { "$NOOK_PROGRAM" play --headless "$@"; }

# Whether a line of an ending says that, and what hash it has.
ends_with() { [[ $1 =~ ^$2\ after\ [0-9]+\ ticks\ \([0-9]+\.[0-9]\ s\),\ hash\ [0-9a-f]{16}$ ]] && hash=${1##* }; }

# The last line of what ships, played once for all that ask; its own recording is "$tmp/again.replay".
shipped() {
    [ -s "$tmp/shipped" ] || play --replay $house.replay --record "$tmp/again.replay" | tail -n 1 >"$tmp/shipped"
    cat "$tmp/shipped"
}

test_the_recording_that_ships_wins_in_two_to_four_minutes() {
    ends_with "$(shipped)" won
    [[ $(shipped) =~ \(([0-9]+)\. ]]
    [ "${BASH_REMATCH[1]}" -ge 120 ] && [ "${BASH_REMATCH[1]}" -le 240 ]
    [ "$(wc -c <$house.replay)" -lt 200000 ]
}

test_the_recording_that_ships_was_made_in_the_level_that_ships() {
    local said
    said=$(play --replay $house.replay 2>&1 >"$tmp/ending")
    [ -z "$said" ]
    sed 's/^origin ..../origin 0000/' $house.replay >"$tmp/other.replay"
    said=$(play --replay "$tmp/other.replay" 2>&1 >"$tmp/ending")
    assert_holds "$said" "engine_house.level: is not as it was when the replay was recorded"
    ends_with "$(tail -n 1 "$tmp/ending")" won # it is played all the same
}

test_recordings_of_the_same_inputs_are_the_same_and_end_in_the_same_state() {
    local first second shared
    first=$(shipped)
    second=$(play --replay "$tmp/again.replay" | tail -n 1)
    [ "$first" = "$second" ]
    shared=$(($(wc -l <$house.replay) - 1)) # the last run of inputs may go on after the win
    cmp <(head -n $shared $house.replay) <(head -n $shared "$tmp/again.replay")
}

test_the_line_of_a_win_is_that_of_its_tick_however_long_the_world_goes_on() {
    [[ $(shipped) =~ after\ ([0-9]+)\ ticks ]]
    awk -v left="${BASH_REMATCH[1]}" 'NR <= 4 { print; next } left > 0 { $1 = $1 < left ? $1 : left; left -= $1; print }' \
        $house.replay >"$tmp/to_the_win.replay"
    [ "$(play --replay "$tmp/to_the_win.replay" | tail -n 1)" = "$(shipped)" ]
}

test_on_another_seed_it_goes_otherwise() {
    local last
    ends_with "$(shipped)" won
    local own=$hash
    last=$(play --replay $house.replay --seed 4242 | tail -n 1)
    ends_with "$last" '(won|lost|undecided)'
    [ "$hash" != "$own" ]
}

test_a_recording_that_breaks_off_ends_where_it_ends() {
    local last again
    head -n 100 $house.replay >"$tmp/half.replay"
    last=$(play --replay "$tmp/half.replay" --record "$tmp/half_again.replay" | tail -n 1)
    ends_with "$last" undecided
    assert_holds "$last" "undecided after $(awk 'NR > 4 { n += $1 } END { print n }' "$tmp/half.replay") ticks"
    again=$(play --replay "$tmp/half_again.replay" | tail -n 1)
    [ "$again" = "$last" ]
}

test_with_nobody_to_play_a_level_is_lost_in_time() {
    local last
    sed "s|\.\./hall|$PWD/content/hall|; s|parts\.glb|$PWD/content/engine_house/parts.glb|; s/^seconds .*= 300/seconds = 20/" \
        $house.level >"$tmp/short.level"
    last=$(play "$tmp/short.level" | tail -n 1)
    ends_with "$last" lost
    assert_holds "$last" "after 1200 ticks (20.0 s)"
}

test_the_pilot_wins_and_what_it_did_can_be_replayed() {
    local last again
    last=$(play --pilot $house.pilot --record "$tmp/pilot.replay" --seed 5 | tail -n 1)
    ends_with "$last" won
    assert_holds "$(head -n 3 "$tmp/pilot.replay")" "level $house.level"$'\n'"seed 5"
    again=$(play --replay "$tmp/pilot.replay" | tail -n 1)
    [ "$again" = "$last" ]
}

# Beyond the gates there is no other way out: who passed them must not be shut in.
test_the_gates_that_opened_stay_open_when_a_part_is_taken_off_its_plate() {
    sed 's/^wait_for gate_left$/&\nwalk_to 1.2 -0.9\ntake loose_gear\nwait_for gear_plate 0\nturn_to 0 -20\ndrop\nwait 6/' \
        $house.pilot >"$tmp/greedy.pilot"
    [ "$(wc -l <"$tmp/greedy.pilot")" -eq $(($(wc -l <$house.pilot) + 6)) ]
    ends_with "$(play --pilot "$tmp/greedy.pilot" | tail -n 1)" won
}

test_a_pilot_that_fails_is_said_and_is_a_failure() {
    local said
    printf 'within 1\nwalk_to 100 0\n' >"$tmp/lost.pilot"
    said=$(assert_fails 1 play --pilot "$tmp/lost.pilot")
    assert_holds "$said" "lost.pilot:2: walk_to 100 0: not done within 1 s"
    assert_holds "$said" "undecided after"
}

test_a_model_is_played_to_the_end_of_what_drives_it() {
    local last
    printf 'wait 1\n' >"$tmp/wait.pilot"
    last=$(play content/hall/hall.glb --pilot "$tmp/wait.pilot" | tail -n 1)
    ends_with "$last" ended
}

test_a_replay_of_another_level_or_version_is_refused_in_one_line() {
    local said
    said=$(assert_fails 1 play content/hall/hall.glb --replay $house.replay)
    assert_holds "$said" "was recorded in $house.level, not in content/hall/hall.glb"
    [ "$(wc -l <<<"$said")" -eq 1 ]
    sed '1s/1/9/' $house.replay >"$tmp/new.replay"
    said=$(assert_fails 1 play --replay "$tmp/new.replay")
    assert_holds "$said" "a recording of version 9, this build plays 1"
    [ "$(wc -l <<<"$said")" -eq 1 ]
}

test_headless_captures_pictures_without_a_display_and_ends_in_the_same_state() {
    local drawn
    printf 'nook recording 1\nlevel %s\nseed 1\n30 0 127 0 20 -50\n' tests/play/data/crate.level >"$tmp/short.replay"
    drawn=$(unset DISPLAY WAYLAND_DISPLAY; play --replay "$tmp/short.replay" --capture "$tmp/pictures" --size 64x36 --cache "$tmp/cache" | tail -n 1)
    [ "$drawn" = "$(play --replay "$tmp/short.replay" | tail -n 1)" ]
    [ "$(find "$tmp/pictures" -name 'frame_*.png' | wc -l)" -eq 15 ] # of 1/30 s
}

test_headless_ends_and_fails_when_a_picture_cannot_be_written() {
    printf 'nook recording 1\nlevel %s\nseed 1\n30 0 127 0 20 -50\n' tests/play/data/crate.level >"$tmp/short.replay"
    mkdir -p "$tmp/taken/frame_000002.png" # a folder
    assert_holds "$(assert_fails 1 play --replay "$tmp/short.replay" --capture "$tmp/taken" --size 64x36 --cache "$tmp/cache")" \
        "taken/frame_000002.png: "
    [ -e "$tmp/taken/frame_000001.png" ]
    [ ! -e "$tmp/taken/frame_000003.png" ]
}

test_a_picture_of_what_stands_still_stands_still() {
    printf 'nook recording 1\nlevel %s\nseed 1\n30 0 0 0 0 0\n' tests/play/data/crate.level >"$tmp/still.replay"
    play --replay "$tmp/still.replay" --capture "$tmp/still" --size 160x90 --cache "$tmp/cache" >/dev/null
    cmp "$tmp/still/frame_000010.png" "$tmp/still/frame_000015.png"
    [ "$(wc -c <"$tmp/still/frame_000015.png")" -gt 4000 ] # something is seen
}

# Whether a process holds the end that SIGTERM asks for.
holds_end() { (((0x$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status") >> 14) & 1)); }

test_a_bench_of_a_recorded_game_draws_its_frames_and_ends_with_it() {
    local said
    head -n 12 $house.replay >"$tmp/short.replay"
    said=$("$NOOK_PROGRAM" bench play --backend osmesa --size 64x36 --from 1 --frames 5 --replay "$tmp/short.replay" 2>/dev/null)
    [[ $said =~ \ all\ +5(\ +[0-9]+\.[0-9]+){5}\ +[0-9.]+\ %$ ]]
    said=$("$NOOK_PROGRAM" bench play --backend osmesa --size 64x36 --from 9000 --replay "$tmp/short.replay" 2>&1 >/dev/null) &&
        return 1
    assert_holds "$said" "is over before the first frame"
    said=$("$NOOK_PROGRAM" bench play --replay "$tmp/nothing.replay" 2>&1 >/dev/null) && return 1
    assert_holds "$said" "$tmp/nothing.replay"
}

test_a_bench_of_a_game_with_a_rate_says_how_large_its_pictures_were() {
    local said
    head -n 12 $house.replay >"$tmp/rate.replay"
    said=$("$NOOK_PROGRAM" bench play --backend osmesa --size 320x180 --frames 30 --frame-rate 1000 \
        --replay "$tmp/rate.replay" 2>/dev/null)
    grep -Eq '^size of the picture for 1000 frames a second, along each side: 1\.0 .* 0\.5 [1-9][0-9.]* %; [1-9] changes$' <<<"$said"
    grep -q '320 x 180' <<<"$said"
}

test_an_interrupted_game_writes_its_recording_and_says_how_far_it_came() {
    local id code=0 tries=600
    printf 'wait 1e9\n' >"$tmp/long.pilot"
    "$NOOK_PROGRAM" play --headless tests/play/data/crate.level --pilot "$tmp/long.pilot" --record "$tmp/stopped.replay" >"$tmp/stopped" &
    id=$!
    until holds_end $id || [ $((tries--)) -eq 0 ]; do sleep 0.1; done
    kill -TERM $id
    wait $id || code=$?
    [ $code -eq 143 ] # by that signal, so that scripts around it end too
    ends_with "$(tail -n 1 "$tmp/stopped")" ended
    [ "$(play --replay "$tmp/stopped.replay" | tail -n 1)" = "$(tail -n 1 "$tmp/stopped")" ]
}

test_films_of_formats_that_are_not_made_are_refused() {
    local name said
    for name in film.mov shot.PNG; do
        said=$(assert_fails 2 play --replay $house.replay --capture "$tmp/$name")
        assert_holds "$said" "--capture $tmp/$name: give a folder, or a video ending in .mp4"
        [ ! -e "$tmp/$name" ]
    done
}

# film NAME SIZE: a few frames of the house's game by the real ffmpeg.
film() {
    play --replay $house.replay --from 20 --frames 12 --size "$2" --capture "$tmp/$1" --cache "$tmp/cache"
}

test_a_film_has_every_picture_and_even_sides() {
    command -v ffprobe >/dev/null || skip_test "ffmpeg is not installed"
    film house.mp4 161x91 >/dev/null
    [ "$(ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames \
        -of csv=p=0 "$tmp/house.mp4")" = h264,162,92,yuv420p,30/1,12 ]
}

test_a_film_that_finds_no_room_is_a_failure() {
    command -v ffprobe >/dev/null || skip_test "ffmpeg is not installed"
    film enough.mp4 160x90 >/dev/null # what is baked is in the cache now
    local said
    said=$(trap '' XFSZ; ulimit -f 4; assert_fails 1 film short.mp4 160x90)
    assert_holds "$said" "short.mp4"
}

test_pictures_of_a_game_that_nobody_plays_are_refused() {
    assert_holds "$(assert_fails 1 play --capture "$tmp/idle" --size 64x36 --cache "$tmp/cache")" \
        "play: nobody plays without a window; give --replay or --pilot"
}

test_options_of_pictures_that_nobody_draws_are_refused() {
    local option said
    for option in --settings=none.settings --from=1 --frames=3; do
        said=$(assert_fails 2 play --replay $house.replay "$option")
        assert_holds "$said" "nook play: ${option%%=*}: with --headless nothing is drawn"
        [ "$(wc -l <<<"$said")" -eq 1 ]
    done
}

test_a_recording_that_cannot_be_written_is_refused_before_the_game() {
    local said
    said=$(assert_fails 1 play --replay $house.replay --record "$tmp/nowhere/a.replay")
    assert_holds "$said" "a.replay: cannot write"
    [ "$(wc -l <<<"$said")" -eq 1 ]
}

test_levels_and_files_that_are_not_there_are_said_in_one_line() {
    local said
    said=$(assert_fails 1 play nowhere.level)
    assert_holds "$said" "nowhere.level"
    [ "$(wc -l <<<"$said")" -eq 1 ]
    said=$(assert_fails 1 play --replay nowhere.replay)
    [ "$(wc -l <<<"$said")" -eq 1 ]
    said=$(assert_fails 1 play content/hall/hall.glb)
    assert_holds "$said" "give --replay or --pilot"
    said=$(assert_fails 2 play --seed -1)
    assert_holds "$said" "--seed"
}

test_a_level_that_is_wrong_is_not_played() {
    local said
    printf 'scene = %s/content/hall/hall.glb\n[body crate_large_0]\nmas = 3\n' "$PWD" >"$tmp/wrong.level"
    said=$(assert_fails 1 play "$tmp/wrong.level")
    assert_holds "$said" "wrong.level:3: a body has no mas; did you mean mass?"
    [ "$(wc -l <<<"$said")" -eq 1 ]
}

test_a_plate_that_waits_for_what_is_not_there_is_refused() {
    local said
    printf 'scene = %s/tests/game/data/crate.gltf\nseconds = 1\n[body crate]\n[plate floor]\nweight = 5\naccepts = craet\n' \
        "$PWD" >"$tmp/plate.level"
    said=$(assert_fails 1 play "$tmp/plate.level")
    assert_holds "$said" "plate.level:4: floor accepts craet, and no body has that name; did you mean crate?"
    [ "$(wc -l <<<"$said")" -eq 1 ]
    sed -i 's/craet/crat*/' "$tmp/plate.level"
    ends_with "$(play "$tmp/plate.level" | tail -n 1)" lost
}

run_tests
