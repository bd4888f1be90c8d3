#!/usr/bin/env bash
# Who may use whom: the table "Folders" of docs/architecture.md, held against every #include of engine/, modules/ and game/.
cd "${NOOK_ROOT:-.}" || exit 1
source tests/support/shell.sh
table=docs/architecture.md

# rows FILE: of each row of the table, from top to bottom, its folders and what it uses: "modules/ao_*<tab>modules/ao/technique.h, gpu".
rows() {
    awk -F'|' '/^## /{ inside = /^## Folders/ } inside && /^\| `/ {
        gsub(/`/, "", $2); gsub(/`/, "", $4); gsub(/<[a-z]*>/, "*", $2); gsub(/\/( |,|$)/, " ", $2); gsub(/,/, " ", $2)
        count = split($2, name, " ")
        for (i = 1; i <= count; i++) {
            if (name[i] !~ /\//) name[i] = (name[1] ~ /\// ? substr(name[1], 1, index(name[1], "/")) : "") name[i]
            printf "%s\t%s\n", name[i], $4
        }
    }' "$1"
}

# includes FOLDER...: "file included" of every #include by path, but of a folder's own.
includes() {
    grep -rnoE --include='*.[ch]' --include='*.cpp' --include='*.inl' --include='*.def' '^ *# *include "(engine|modules|game)/[^"]*' "$@" |
        sed -E 's/:[0-9]+: *# *include "/ /'
}

# wrong_includes TABLE: reads what `includes` prints; says each that the table does not allow, and why.
wrong_includes() {
    awk -F'\t' '
        FNR == NR { folder[++rows] = $1; uses[rows] = $2; next }
        function row_of(path,    i, name, best) { # the longest name that the path begins with; * stands for one technique
            best = 0
            for (i = 1; i <= rows; i++) {
                name = folder[i]; gsub(/\*/, "[a-z0-9]*", name)
                if (path ~ "^" name "/" && (!best || length(folder[i]) > length(folder[best]))) best = i
            }
            return best
        }
        function is_named(cell, path, row,    word, count, i, last, short) { # by its file, its folder, or the last part of that
            last = folder[row]; sub(/.*\//, "", last)
            count = split(cell, word, /[ ,()]+/)
            for (i = 1; i <= count; i++) {
                sub(/\/$/, "", word[i]); short = word[i]; sub(/^platform.s$/, "platform", short)
                if (short == last || short == folder[row] || path == word[i] || path == "engine/" word[i]) return 1
            }
            return 0
        }
        {
            split($0, part, " ")
            inner = part[2]; sub(/\/[^\/]*$/, "/", inner)
            if (part[2] ~ /internal\.h$/ && index(part[1], inner) != 1) print part[1] ": " part[2] ": inner to its folder"
            from = row_of(part[1]); to = row_of(part[2])
            if (!from || !to) { print part[1] ": " part[2] ": a folder that the table does not have"; next }
            if (from == to && folder[to] ~ /\*/ && sub(/\/[^\/]*$/, "", part[1]) + sub(/\/[^\/]*$/, "", part[2]) && part[1] != part[2])
                print part[1] ": " part[2] ": techniques do not know each other"
            if (from == to || part[1] ~ /^game\/[^\/]*$/ || folder[from] == "game") next
            if (folder[to] == "game") next # what stands in game/ itself belongs to all of its rooms
            if (to < from) print part[1] ": " part[2] ": it stands above"
            else if (folder[from] !~ /^game/ && !is_named(uses[from], part[2], to)) print part[1] ": " part[2] ": not named in its row"
        }' <(rows "$1") -
}

test_no_folder_includes_what_the_table_does_not_allow_it() {
    local wrong
    wrong=$(includes engine modules game | wrong_includes "$table")
    [ -z "$wrong" ] || { echo "$wrong"; return 1; }
    [ "$(includes engine modules game | wc -l)" -gt 1000 ]
}

test_what_stands_above_or_is_not_named_is_found() {
    local wrong
    wrong=$(printf '%s\n' 'engine/core/a.c engine/ecs/world.h' 'modules/ao/a.c engine/ecs/world.h' 'modules/ao/a.c engine/core/log.h' \
        'engine/render/a.c modules/bake/voxelize.h' 'game/live/a.c game/play/play.h' 'game/play/a.c game/live/live.h' \
        'modules/ao_ssao/a.c modules/ao_hao/hao.h' 'modules/ao_ssao/a.c modules/ao/technique.h' \
        'modules/ao_ssao/a.c modules/ao/ao_internal.h' 'elsewhere/a.c engine/core/log.h' |
        wrong_includes "$table")
    [ "$(wc -l <<<"$wrong")" -eq 7 ]
    assert_holds "$wrong" 'engine/core/a.c: engine/ecs/world.h: it stands above'
    assert_holds "$wrong" 'modules/ao/a.c: engine/ecs/world.h: not named'
    assert_holds "$wrong" 'engine/render/a.c: modules/bake/voxelize.h: not named'
    assert_holds "$wrong" 'game/live/a.c: game/play/play.h: it stands above'
    assert_holds "$wrong" 'modules/ao_ssao: modules/ao_hao: techniques do not know'
    assert_holds "$wrong" 'modules/ao_ssao/a.c: modules/ao/ao_internal.h: inner'
    assert_holds "$wrong" 'elsewhere/a.c: engine/core/log.h: a folder'
}

run_tests
