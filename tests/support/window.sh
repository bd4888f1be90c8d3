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

# in_window_of TITLE SCRIPT OPTION...: runs the script beside `nook OPTION...`, with its window, whose title begins with TITLE, in
# $window and the program in $program_id; the program must end with exit code 0 when the script has ended.
in_window_of() {
    need_display
    export title=$1 script=$2
    shift 2
    with_display bash -Eeuc '
        trap "echo \"failed: \$BASH_COMMAND\"" ERR
        NOOK_ROOT=$root "$program" "$@" >"$tmp/table" 2>"$tmp/log" &
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
        find_window() { window=$(xdotool search --onlyvisible --name "^$title" 2>/dev/null | head -n 1) && [ -n "$window" ]; }
        title_has() { xdotool getwindowname "$window" | grep -q -- "$1"; }
        log_has() { grep -q -- "$1" "$tmp/log"; }
        pixel() { import -window "$window" png:- | convert png:- -crop 1x1+"$1"+"$2" -format "%[hex:u.p{0,0}]" info:; } # X Y: its colour
        has_pixel() { [ "$(pixel "$1" "$2")" = "$3" ]; }
        see() { import -window "$window" "$tmp/$1.png"; } # NAME
        looks_like() { see seen && cmp -s "$tmp/seen.png" "$tmp/$1.png"; } # NAME
        has_colour() { # COLOUR [PART]: about that; letters are smoothed
            see seen && [ "$(convert "$tmp/seen.png" -crop "${2:-0x0}" +repage -fuzz 15% -fill black +opaque "$1" -format "%[fx:mean > 0 ? 1 : 0]" info:)" = 1 ]
        }
        has_red() { has_colour "rgb(255,110,100)"; } # that of messages
        has_no_red() { not has_red; }
        hold() { xdotool keydown --window "$window" "$1"; sleep "${2:-0.4}"; xdotool keyup --window "$window" "$1"; } # KEY [SECONDS]
        hold_until() { # KEY COMMAND...
            xdotool keydown --window "$window" "$1"
            wait_for 30 "${@:2}"
            xdotool keyup --window "$window" "$1"
        }
        step_until() { # KEY COMMAND...: in short steps, however slow frames are
            local steps=0
            until "${@:2}"; do
                [ $((steps += 1)) -le 100 ] || { echo "walked in vain by $1 for: ${*:2}"; return 1; }
                hold "$1" 0.1
            done
        }
        press() { xdotool key --window "$window" "$1"; }
        wait_for 120 find_window
        eval "$script"
        wait $program_id
    ' in_window_of "$@"
}

# in_window SCRIPT [OPTION...]: beside `nook compare $crate`; Escape ends it.
in_window() {
    local beside=$1
    shift
    in_window_of "Nook - crate" "$beside
        xdotool keydown --window \$window Escape # no release: the window is gone by then" \
        compare "$crate" --size 320x200 --frames 1 --reference-rays 4 --cache "$tmp/cache" --out "$tmp/out" "$@"
}

# A copy of what the program reads while it runs, for tests that edit it: never that of the sources.
copy_root() {
    rm -rf "$tmp/root"
    mkdir -p "$tmp/root/modules"
    cp -r shaders "$tmp/root/"
    cp -r modules/ao_* "$tmp/root/modules/"
    export root=$tmp/root
}
