#!/usr/bin/env bash
# The command `extremes`: what it lists, runs, writes and returns.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}

extremes() { "${NOOK_PROGRAM:-build/release/bin/nook}" extremes --backend osmesa "$@"; }

test_list_names_every_case_and_runs_nothing() {
    local list
    list=$(extremes --list)
    assert_holds "$list" transforms
    assert_holds "$list" 'M_B^-1 M_A'
    [[ $(tail -n 1 <<<"$list") =~ ^[0-9]+\ cases$ ]]
}

test_readme_states_every_limit() {
    local limit limits missing=0
    limits=$(extremes --list | sed -n 's/^ *limit: //p')
    [ -n "$limits" ]
    while IFS= read -r limit; do
        grep -qxF -- "- $limit" README.md || { echo "README.md, Limits: add the line \"- $limit\"" && missing=1; }
    done <<<"$limits"
    [ $missing -eq 0 ]
}

test_only_runs_what_matches_and_ends_with_the_summary() {
    local table
    table=$(extremes --quick --only 'm_b^-1 m_a')
    assert_holds "$table" 'voxels of 256'
    assert_holds "$table" holds
    assert_holds "$(tail -n 1 <<<"$table")" '1 cases in 1 groups: 1 hold, 0 do not'
}

test_json_is_printed_and_written_with_why_and_limit() {
    extremes --quick --only 'm_b^-1 m_a' --json --out "$tmp/extremes.json" >"$tmp/printed.json"
    cmp "$tmp/printed.json" "$tmp/extremes.json"
    assert_holds "$(cat "$tmp/extremes.json")" '"why": '
    assert_holds "$(cat "$tmp/extremes.json")" '"limit": null'
    assert_holds "$(cat "$tmp/extremes.json")" '"failing": 0'
}

test_text_that_no_case_holds_is_refused_in_one_line() {
    local line
    line=$(assert_fails 2 extremes --only nowhere)
    assert_holds "$line" 'no case'
    [ "$(wc -l <<<"$line")" -eq 1 ]
}

test_file_that_cannot_be_written_is_refused_before_the_work() {
    local said
    said=$(assert_fails 1 extremes --quick --only 'm_b^-1' --out "$tmp/no/such/folder/x.json")
    assert_holds "$said" 'no/such/folder'
    [ "$(wc -l <<<"$said")" -eq 1 ]
}

# There is room for the empty file that is tried first, and for no byte more.
test_summary_is_printed_though_the_file_cannot_be_written() {
    local said
    said=$( (trap '' XFSZ; ulimit -f 0; extremes --quick --only 'm_b^-1' --out "$tmp/full.json") 2>&1 || echo "code $?")
    assert_holds "$said" 'full.json: cannot write'
    assert_holds "$(tail -n 2 <<<"$said")" '1 hold, 0 do not'
    assert_holds "$(tail -n 1 <<<"$said")" 'code 1'
    [ ! -e "$tmp/full.json" ]
}

test_no_scratch_folder_is_left() {
    mkdir -p "$tmp/scratch"
    TMPDIR=$tmp/scratch extremes --quick --only 'm_b^-1' >/dev/null
    [ -z "$(ls "$tmp/scratch")" ]
}

run_tests
