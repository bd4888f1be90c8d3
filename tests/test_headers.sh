#!/usr/bin/env bash
# Headers that a host may include: each compiles alone, as C11 and as C++17.
cd "${NOOK_ROOT:-.}" || exit 1
source tests/support/shell.sh

# compile_each COMPILER...: every header on its own; all that fail are reported.
compile_each() {
    local header headers failed=0
    mapfile -t headers < <(find engine modules -name '*.h' | LC_ALL=C sort)
    [ ${#headers[@]} -gt 0 ]
    for header in "${headers[@]}"; do
        printf '#include "%s"\nextern int nook_after_header;\n' "$header" | # C knows no empty text, and a header may be macros alone
            "$@" -I. -Wall -Wextra -Wpedantic -Werror -fsyntax-only -D_DEFAULT_SOURCE - || failed=1
    done
    return $failed
}

test_every_header_compiles_alone_as_c11() { compile_each "${CC:-cc}" -std=c11 -x c; }

test_every_header_compiles_alone_as_cpp17() { compile_each "${CXX:-c++}" -std=c++17 -x c++; }

# Without it a C++ host looks for C++ names, and does not link.
test_every_header_with_functions_is_extern_c() {
    local header headers failed=0
    mapfile -t headers < <(find engine modules -name '*.h' ! -name '*internal.h')
    for header in "${headers[@]}"; do
        if grep -E '^[a-z][a-z0-9_ *]*nook_[a-z0-9_]+\(' "$header" | grep -qv '^static ' && ! grep -q 'extern "C"' "$header"; then
            echo "$header: declares functions without extern \"C\" for C++"
            failed=1
        fi
    done
    return $failed
}

run_tests
