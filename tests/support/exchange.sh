# shellcheck shell=bash
# For tests of code that is exchanged under a game in a window. Source it after window.sh, and again in the script beside the window.
# shellcheck disable=SC2154 # tmp, root and program are window.sh's

export NOOK_LIVE=$tmp/live # where games look for code
bin=$(dirname "$program")
export bin

link_library() { # NAME ARGUMENT...
    local flags=(-std=c11 -g -O1 -fPIC -D_DEFAULT_SOURCE -DCGLM_ALL_UNALIGNED -I"$root" -I. -pthread) name=$1
    [[ $bin != */sanitize/* ]] || flags+=("-fsanitize=address,undefined" -fno-sanitize-recover=all)
    "${CC:-cc}" "${flags[@]}" -shared -o "$NOOK_LIVE/$name.so.new" -Wl,-Bsymbolic -Wl,--exclude-libs,ALL "${@:2}"
    mv "$NOOK_LIVE/$name.so.new" "$NOOK_LIVE/$name.so"
    publish ok
}

# make_game SOURCE SED: code as somebody saved it: compiles one source with a change and makes game.so of it and all others as they are.
make_game() {
    sed "$2" "$1" >"$tmp/$(basename "$1")"
    ! cmp -s "$1" "$tmp/$(basename "$1")" || { echo "make_game: nothing was changed by $2"; return 1; }
    link_library game game/entry/game_entry.c "$tmp/$(basename "$1")" \
        -Wl,--start-group "$bin"/libnook_{game,plan,measure,fixture,ao_ecs,stream,ao,trace,bake}.a -Wl,--end-group
}

# make_technique NAME: the library of a technique, of its sources under $root (window.sh: copy_root).
make_technique() {
    link_library "ao_$1" -DNOOK_TECHNIQUE="$1" modules/ao/entry/technique_entry.c "$root/modules/ao_$1"/*.c "$bin"/libnook_{trace,ao}.a
}

# Code as it was built.
put_built_game() {
    cp "$bin/game.so" "$NOOK_LIVE/game.so.new"
    mv "$NOOK_LIVE/game.so.new" "$NOOK_LIVE/game.so"
    publish ok
}

# publish TEXT: says that there is a new build: "ok", or "failed" and what the compiler said.
publish() {
    printf '%s %s' "$(date +%s%N)" "$1" >"$NOOK_LIVE/build.new"
    mv "$NOOK_LIVE/build.new" "$NOOK_LIVE/build"
}
