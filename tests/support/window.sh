# shellcheck shell=bash
# For tests of the program in a window under Xvfb, steered with xdotool. Source it after shell.sh, in the folder of the sources.

tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
crate=tests/game/data/crate.gltf # the scene to open
root=$PWD                        # where the program finds its shaders
program=${NOOK_PROGRAM:-build/release/bin/nook}
export tmp crate root program

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

# in_window SCRIPT [OPTION...]: runs it beside `nook compare $crate`, with its window in $window; the program must end with exit code 0.
in_window() {
    need_display
    export script=$1
    shift
    with_display bash -euc '
        NOOK_ROOT=$root "$program" compare "$crate" --size 320x200 --frames 1 --reference-rays 4 --cache "$tmp/cache" --out "$tmp/out" "$@" \
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
        pixel() { import -window "$window" png:- | convert png:- -crop 1x1+"$1"+"$2" -format "%[hex:u.p{0,0}]" info:; } # X Y: its colour
        has_pixel() { [ "$(pixel "$1" "$2")" = "$3" ]; }
        hold() { xdotool keydown --window "$window" "$1"; sleep 0.4; xdotool keyup --window "$window" "$1"; }
        press() { xdotool key --window "$window" "$1"; }
        wait_for 120 find_window
        eval "$script"
        xdotool keydown --window "$window" Escape # no release: the window is gone by then
        wait $program_id
    ' in_window "$@"
}
