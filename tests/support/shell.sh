# shellcheck shell=bash
# For tests written in bash: source this, define functions test_*, end with `run_tests`. Each runs in a subshell with
# `set -e`, so the first command that fails fails it; reports look like cmocka's, which ./nook test counts.

# Fails with a message when text $1 does not hold text $2.
assert_holds() {
    if [[ $1 != *"$2"* ]]; then
        printf 'expected to find: %s\nin: %s\n' "$2" "$1"
        return 1
    fi
}

# assert_fails CODE COMMAND...: the command must end with that exit code; its output is printed for the caller to read.
assert_fails() {
    local expected=$1 code=0
    shift
    "$@" 2>&1 || code=$?
    if [ "$code" -ne "$expected" ]; then
        echo "exit code $code instead of $expected: $*" >&2
        return 1
    fi
}

# not COMMAND...: it must fail. With a ! before it, a command never ends a script that is run with set -e, whatever comes of it.
not() { ! "$@"; }
export -f not

skip_test() { # REASON
    echo "$1"
    exit 77
}

run_tests() {
    local name code failed=0
    set +e # and no || after the subshell: both would switch off its own set -e
    for name in $(declare -F | awk '{ print $3 }' | grep '^test_'); do
        echo "[ RUN      ] $name"
        (set -euo pipefail; "$name")
        code=$?
        case $code in
        0) echo "[       OK ] $name" ;;
        77) echo "[  SKIPPED ] $name" ;;
        *) echo "[  FAILED  ] $name" && failed=1 ;;
        esac
    done
    exit $failed
}
