#!/usr/bin/env bash
# The compiler lines of docs/embedding.md, as they stand there, on a host that uses what they link.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
export NOOK=$PWD

# write_host TECHNIQUE...: gets as far as one can without a GL context.
write_host() {
    local name
    {
        for name in "$@"; do printf '#include "modules/ao_%s/%s.h"\n' "$name" "$name"; done
        printf '%s\n' '#include "modules/bake/volume_file.h"' '#include <stdio.h>' 'int main(void)' '{' \
            '    nook_volume volume = { 0 };' '    nook_ao *ao = NULL;' '    nook_ao_desc desc = { .version = NOOK_AO_VERSION + 1 };'
        for name in "$@"; do printf '    printf("%%s ", nook_ao_%s_technique.name);\n' "$name"; done
        printf '%s\n' '    return nook_volume_decode("none", "", 0, &volume) < 0 && nook_ao_create(&desc, &ao) < 0 ? 0 : 1;' '}'
    } >"$tmp/my_engine.c"
}

# build_as_documented NUMBER: by that one of the documented lines.
build_as_documented() {
    local line
    [[ ${NOOK_PROGRAM:-build/release/bin/nook} == */release/* ]] || skip_test 'the documented lines are for the release build'
    line=$(grep '^cc ' docs/embedding.md | sed -n "$1p")
    [ -n "$line" ]
    (cd "$tmp" && eval "$line -o host")
}

test_the_documented_line_links_a_host() {
    write_host volume ssao
    build_as_documented 1
    [ "$("$tmp/host" 2>/dev/null)" = 'volume ssao ' ]
}

test_the_documented_line_with_the_reference_links_a_host() {
    write_host volume reference
    build_as_documented 2
    [ "$("$tmp/host" 2>/dev/null)" = 'volume reference ' ]
}

run_tests
