#!/usr/bin/env bash
# ./nook soak on an open floor, for a short while: it warms up in time, counts what falls over the edge, and finds a leak.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.."
source tests/support/shell.sh
export NOOK_ROOT=$PWD
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
level=tests/play/data/crate.level

need_plain_memory() { [[ $NOOK_PROGRAM != */sanitize/* ]] || skip_test 'AddressSanitizer keeps what was freed'; }

soak() { "$NOOK_PROGRAM" soak --cache "$tmp/cache" "$@" 2>"$tmp/log"; }

test_a_short_soak_of_an_open_level_holds_and_counts_what_falls_over_its_edge() {
    need_plain_memory
    soak "$level" --frames 700 >"$tmp/said"
    assert_holds "$(tail -n 1 "$tmp/said")" "holds after 700 frames"
    grep -q '^bodies     0 went through what stands still and out of the world, [1-9][0-9]* fell over an edge; the last: ' "$tmp/said"
    grep -q ' shader reloads, .* [1-9][0-9]* resizes, [1-9][0-9]* restarts$' "$tmp/said" # once each, however short it is
}

test_a_leak_is_found() {
    need_plain_memory
    command -v cc >/dev/null || skip_test "there is no compiler"
    cat >"$tmp/leak.c" <<'C'
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

void *leaked;

/* The soak lists its open files every few frames. */
DIR *opendir(const char *name)
{
    DIR *(*listed)(const char *) = (DIR * (*)(const char *)) dlsym(RTLD_NEXT, "opendir");
    leaked = malloc(100000);
    memset(leaked, 1, 100000);
    return listed(name);
}
C
    cc -shared -fPIC -o "$tmp/leak.so" "$tmp/leak.c"
    assert_fails 1 env LD_PRELOAD="$tmp/leak.so" "$NOOK_PROGRAM" soak "$level" --frames 210 --cache "$tmp/cache" >"$tmp/said"
    assert_holds "$(cat "$tmp/said")" "does not hold after 210 frames"
    grep -q '^allocated  grew by 2\.[0-9]* MiB, 1.00 are allowed' "$tmp/said" # 24 times
}

test_a_soak_too_short_to_warm_up_in_and_a_level_that_is_not_there_are_refused() {
    assert_holds "$(assert_fails 2 "$NOOK_PROGRAM" soak "$level" --frames 100)" "--frames"
    assert_holds "$(assert_fails 1 "$NOOK_PROGRAM" soak nowhere.level)" "nowhere.level"
}

run_tests
