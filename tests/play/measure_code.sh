#!/usr/bin/env bash
# How long it takes from saving a source of game/ to the first frame that a running game has drawn with it: ./nook watch beside a
# game without a window (640x360, software GL, steered by the pilot of the engine house), in a clone of what is committed.
# usage: tests/play/measure_code.sh [TIMES]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
times=${1-20}
work=$(mktemp -d)
game='' watch=''
trap 'kill $game $watch 2>/dev/null || true; wait; rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
git clone -q . "$work/nook"
cd "$work/nook"
./nook build
CCACHE_DISABLE=1 ./nook watch >"$work/watch.log" 2>&1 & # the compiler is timed, not a cache that never hits
watch=$!

# wait_for FILE LINES TEXT: until so many lines of a file hold the text.
wait_for() {
    until [ "$(grep -c -- "$3" "$1" 2>/dev/null || true)" -ge "$2" ]; do sleep 0.005; done
}

wait_for "$work/watch.log" 1 'built in'
env -u DISPLAY build/release/bin/nook play --pilot content/engine_house/engine_house.pilot --backend osmesa --size 640x360 \
    >"$work/game.out" 2>"$work/game.log" &
game=$!
wait_for "$work/game.log" 1 'is taken over'
sleep 2
for ((i = 1; i <= times; i++)); do
    sed -i "s/locks open[^\"]*\"/locks open $i\"/" game/play/play_panels.c
    saved=${EPOCHREALTIME/./}
    wait_for "$work/game.log" "$i" 'new code runs'
    seen=${EPOCHREALTIME/./}
    exchange=$(grep 'new code runs' "$work/game.log" | tail -n 1 | sed 's/.* \([0-9]*\) ms.*/\1/')
    echo "$(((seen - saved) / 1000)) $exchange"
    sleep 0.5
done | sort -n >"$work/times"
awk '{ all[NR] = $1; swaps += $2 } END { printf "%d saves: %d ms from save to frame (median; %d to %d), of which the exchange with its frame %d ms (mean)\n",
    NR, all[int((NR + 1) / 2)], all[1], all[NR], swaps / NR }' "$work/times"
