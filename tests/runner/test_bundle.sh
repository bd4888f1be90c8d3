#!/usr/bin/env bash
# ./nook bundle: the folder that it makes runs without the sources.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
bundle="$tmp/a bundle"

only_in_release() { [[ ${NOOK_PROGRAM:-build/release/bin/nook} == */release/* ]] || skip_test 'bundles are of the release build'; }

# alone COMMAND...: as somebody who has nothing but the bundle.
alone() { (cd "$tmp" && env -i HOME="$tmp" PATH=/usr/bin:/bin "$bundle/nook" "$@"); }

test_a_bundle_draws_and_plays_without_the_sources() {
    only_in_release
    ./nook bundle "$bundle"
    alone version | grep -q '^nook '
    alone compare --backend osmesa --no-window --size 48x32 --techniques volume,ssao --frames 1 --no-instability --out "$tmp/compared" >/dev/null
    [ -s "$tmp/compared/compare.png" ]
    [ -d "$bundle/cache" ] # its own
    local recording
    recording=$(cd content && find . -name '*.replay' | head -n 1)
    [ -z "$recording" ] || alone play --headless --replay "$bundle/content/$recording" | tail -n 1 | grep -q '^won after'
}

test_its_libraries_are_its_own_but_for_those_of_the_system() {
    only_in_release
    [ -x "$bundle/nook" ] || ./nook bundle "$bundle"
    local elsewhere
    elsewhere=$(env -i ldd "$bundle/nook" | grep '=>' | grep -v -F "=> $bundle/lib/" |
        grep -v -E '^\s*lib(c|m|dl|rt|pthread|resolv|stdc\+\+|gcc_s|z|X11|xcb|Xau|Xdmcp|bsd|md)\.so' || true)
    [ -z "$elsewhere" ] || { echo "$elsewhere"; return 1; }
    [[ $(env -i ldd "$bundle/nook") != *'not found'* ]]
    [ -z "$(find "$bundle" -type l)" ]
}

test_without_its_shaders_it_says_what_is_missing() {
    only_in_release
    [ -x "$bundle/nook" ] || ./nook bundle "$bundle"
    mv "$bundle/shaders" "$tmp/shaders aside"
    assert_holds "$(assert_fails 1 alone version)" 'no shaders/ found'
    mv "$tmp/shaders aside" "$bundle/shaders"
}

test_a_folder_that_is_no_bundle_is_left_alone() {
    mkdir -p "$tmp/precious"
    echo mine >"$tmp/precious/file"
    assert_holds "$(assert_fails 1 ./nook bundle "$tmp/precious")" 'is no bundle'
    [ "$(cat "$tmp/precious/file")" = mine ]
    assert_holds "$(assert_fails 2 ./nook bundle --nonsense)" 'no such option'
    assert_holds "$(./nook bundle --help)" 'usage: ./nook bundle'
    assert_holds "$(./nook build --bundle --help)" 'usage: ./nook bundle'
    assert_holds "$(assert_fails 2 ./nook build --nonsense)" 'no such option'
}

test_a_folder_of_sources_is_left_alone() {
    local tree="$tmp/sources" before
    mkdir -p "$tree"/{shaders,modules,content,lib}
    cp nook premake5.lua packages.txt "$tree"
    echo mine | tee "$tree"/{shaders,modules,content,lib}/file >/dev/null
    before=$(cd "$tree" && find . -type f -exec cksum {} + | sort)
    assert_holds "$(assert_fails 1 ./nook bundle "$tree")" 'is no bundle'
    assert_holds "$(cd "$tree" && assert_fails 1 ./nook bundle .)" 'is no bundle'
    [ "$(cd "$tree" && find . -type f -exec cksum {} + | sort)" = "$before" ]
}

test_a_bundle_is_replaced_by_a_new_one() {
    only_in_release
    [ -x "$bundle/nook" ] || ./nook bundle "$bundle"
    echo old >"$bundle/shaders/old"
    ./nook bundle "$bundle"
    [ ! -e "$bundle/shaders/old" ]
    alone version | grep -q '^nook '
}

test_a_bundle_that_cannot_be_written_is_refused_in_one_line() {
    local said
    only_in_release
    echo mine >"$tmp/file"
    said=$(assert_fails 1 ./nook bundle "$tmp/file/bundle")
    [ "$said" = "nook: bundle: $(realpath "$tmp")/file/bundle cannot be made (Not a directory); name another folder" ]
    mkdir -p "$tmp/blocked/.nook_bundle" # a folder where the mark belongs
    said=$(assert_fails 1 ./nook bundle "$tmp/blocked" | grep -v 'waiting for another') # that builds
    [ "$said" = "nook: bundle: $(realpath "$tmp")/blocked cannot be written (Is a directory); make room there or name another folder" ]
    [ ! -e "$tmp/blocked/nook" ]
    assert_holds "$(assert_fails 2 ./nook bundle '')" "bundle: '': give a folder"
}

run_tests
