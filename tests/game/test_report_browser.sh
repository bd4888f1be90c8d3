#!/usr/bin/env bash
# report.html in a headless Chromium, from file:// and without a network: the reports are those that the program of
# tests/game/test_report_html.c leaves.
cd "${NOOK_ROOT:-$PWD}" || exit 1
source tests/support/shell.sh
source tests/support/browser.sh
tmp=${NOOK_TEST_TMP:-$(mktemp -d)}
program=${NOOK_PROGRAM:-build/release/bin/nook}
maker=$(dirname "$(dirname "$program")")/tests/test_game_report_html

arrow_left=$'\ue012' arrow_right=$'\ue014' enter=$'\ue007'

# with_report FOLDER: opens that report; all tests share one browser and one set of reports.
with_report() {
    browser_need
    browser_open "$(realpath "$tmp")/$1/report.html"
}

# equals FOUND EXPECTED
equals() { [ "$1" = "$2" ] || { printf 'found: %s\nexpected: %s\n' "$1" "$2"; return 1; }; }

# The cells of a column from top to bottom, by the key of its header; those without a number are left out.
cells() {
    browser_run "
        const headers = [...document.querySelectorAll('#table tr.columns th')];
        const index = headers.findIndex(header => header.dataset.key === '$1');
        return [...document.querySelectorAll('#table tbody tr')].map(row => row.children[index].textContent).filter(text => text !== '-').join('\\n');"
}

loads_without_complaints() {
    equals "$(browser_complaints)" ''
    equals "$(browser_run 'return document.title')" 'Nook measurements: hall, </script><b>&"'
    equals "$(browser_run "return performance.getEntriesByType('resource').filter(entry => !entry.name.startsWith('data:')).length")" 0
}

shows_all_rows() {
    equals "$(browser_run "return document.querySelectorAll('#table tbody tr').length + ' ' + document.querySelector('#table_count').textContent")" \
        '76 76 of 76 rows'
}

# The table's default order is neither.
sorts_by_a_header_and_back() {
    browser_click '#table th[data-key="rmse"] button'
    equals "$(cells rmse)" "$(cells rmse | sort -g)"
    [ "$(cells rmse | sort -u | wc -l)" -gt 30 ]
    equals "$(browser_run "return document.querySelector('#table th[data-key=\"rmse\"]').ariaSort")" ascending
    browser_click '#table th[data-key="rmse"] button'
    equals "$(cells rmse)" "$(cells rmse | sort -gr)"
    equals "$(browser_run "return document.querySelector('#table th[data-key=\"rmse\"]').ariaSort")" descending
    browser_keys '#table th[data-key="setting"] button' "$enter" # the keyboard, and text
    equals "$(cells setting | sed 's/as it comes//' | head -n 4 | sort -u)" gtao
    equals "$(browser_run "return document.querySelectorAll('#table [aria-sort]').length")" 1
}

# Where the right picture begins, in percent from the left, by computed style.
clip() { browser_run "return getComputedStyle(document.querySelector('#plate_right')).clipPath.match(/([0-9.]+)%\)\$/)[1]"; }

wipes() {
    local width before
    browser_run "await settled(); document.querySelector('#stage').scrollIntoView({ block: 'center' });" >/dev/null
    width=$(browser_run "return document.querySelector('#plates').clientWidth")
    equals "$(clip)" 50
    browser_drag '#wipe' $((width / 4))
    awk -v at="$(clip)" 'BEGIN { exit !(at > 73 && at < 77) }'
    browser_drag '#wipe' $((-width / 2)) touch
    awk -v at="$(clip)" 'BEGIN { exit !(at > 23 && at < 27) }'
    before=$(clip)
    browser_keys '#wipe' "$arrow_right$arrow_right"
    awk -v before="$before" -v at="$(clip)" 'BEGIN { exit !(at > before + 1.9 && at < before + 2.1) }'
    browser_keys '#wipe' "$arrow_left"
    awk -v before="$before" -v at="$(clip)" 'BEGIN { exit !(at > before + 0.9 && at < before + 1.1) }'
    equals "$(browser_run "return document.querySelector('#wipe').getAttribute('aria-valuenow')")" "$(printf %.0f "$(clip)")"
}

# The colours in the middle of each map: many, with blue and red among them, and the grey of no geometry above.
draws_error_maps() {
    browser_run "
        await settled();
        const maps = [...document.querySelectorAll('#maps canvas')];
        const found = maps.map(canvas => {
            const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            const colours = new Set();
            let blue = 0, red = 0;
            for (let i = 0; i < data.length; i += 4) {
                colours.add(data.slice(i, i + 3).join());
                blue += data[i + 2] > data[i] + 20;
                red += data[i] > data[i + 2] + 20;
            }
            return colours.size > 20 && blue > 100 && red > 100 && colours.has('200,200,200');
        });
        return found.length + ' ' + found.every(Boolean);" >"$tmp/maps"
    equals "$(cat "$tmp/maps")" '3 true'
}

checks=(loads_without_complaints shows_all_rows sorts_by_a_header_and_back wipes draws_error_maps)

# Pictures are drawn a little later than the page: a function of the page that waits for them.
wait_for_pictures='window.settled = async () => {
    for (let tries = 0; tries < 100; tries++) {
        const maps = [...document.querySelectorAll("#maps canvas, #plate_right")];
        if (maps.length > 1 && maps.every(canvas => canvas.width > 1)) return;
        await new Promise(done => setTimeout(done, 50));
    }
    throw new Error("the pictures were not drawn in 5 s");
};'

test_error_colours_are_those_of_the_sheets() {
    with_report pages
    browser_run "
        const colours = [];
        for (let difference = -255; difference <= 255; difference += 15) colours.push([difference, ...error_colour(difference / 255, 0.25)].join(' '));
        return colours.join('\n');" >"$tmp/colours_found"
    # Floats there, doubles here: a channel may round the other way.
    paste -d ' ' "$tmp/colours" "$tmp/colours_found" | awk '
        { for (i = 2; i <= 4; i++) if ($i - $(i + 4) > 1 || $(i + 4) - $i > 1) bad++; if ($1 != $5) bad++ }
        END { exit !(NR == 35 && !bad) }'
}

# count SELECTOR
count() { browser_run "return document.querySelectorAll(\`$1\`).length"; }

choose() { # ID VALUE: of a select
    browser_run "const select = document.getElementById('$1'); select.value = \`$2\`; select.dispatchEvent(new Event('change'));" >/dev/null
}

test_charts_show_all_settings_and_pin_by_mouse_and_keyboard() {
    with_report pages
    equals "$(count '#chart_ms .sign') $(count '#chart_fetches .sign') $(count '#chart_ms .front')" '18 18 1'
    assert_holds "$(browser_run "return document.querySelector('#front_note').textContent")" '18 settings' # truths are none
    equals "$(count '#pinned tbody tr') $(count '#chart_ms .ring')" '3 3' # as they come
    browser_keys '#chart_ms' "$arrow_left" # the dearest one
    assert_holds "$(browser_run "return document.querySelector('#tooltip').textContent")" 'volume rays=5'
    assert_holds "$(browser_run "return document.querySelector('#spoken').textContent")" 'volume rays=5: ms '
    browser_keys '#chart_ms' "$enter"
    equals "$(browser_run "return [...document.querySelectorAll('#pinned tbody code')].pop().textContent")" 'volume rays=5'
    equals "$(browser_run "return document.querySelector('#right_picture').value")" 'setting volume rays=5'
    browser_run "
        const svg = document.querySelector('#chart_fetches'), frame = svg.getBoundingClientRect();
        const point = charts.chart_fetches.points.find(point => point.row.setting === 'ssao rays=5');
        svg.dispatchEvent(new MouseEvent('click', { clientX: frame.left + point.x + 3, clientY: frame.top + point.y - 3 }));" >/dev/null
    equals "$(count '#pinned tbody tr')" 5
    browser_click '#pinned tbody tr:last-child button'
    equals "$(count '#pinned tbody tr')" 4
    browser_click '#techniques button[aria-pressed=true]'
    equals "$(count '#chart_ms .sign')" 12
    equals "$(browser_complaints)" ''
}

test_choices_hold_for_all_that_is_shown() {
    with_report pages
    choose scene '</script><b>&"'
    choose camera 'camera 2'
    assert_holds "$(browser_run "return document.querySelector('#pictures_of').textContent")" 'camera 2'
    choose table_scope view
    equals "$(browser_run "return document.querySelector('#table_count').textContent")" '19 of 76 rows'
    equals "$(count '#table th[data-key=scene], #table th[data-key=camera]')" 0 # they say nothing here
    choose error ssim
    assert_holds "$(browser_run "return document.querySelector('#chart_ms').textContent")" '1 - SSIM'
    equals "$(count '#extremes tbody tr') $(count '#screen_errors tbody tr')" '3 2'
    choose right_picture truth
    choose camera 'camera 1'
    browser_click '#extremes tbody tr:first-child button' # goes to where that was measured: further cameras are worse
    equals "$(browser_run "return document.querySelector('#right_picture').value + ' ' + document.querySelector('#camera').value")" 'setting volume camera 2'
    equals "$(browser_complaints)" ''
}

test_thousands_of_rows_are_drawn_as_they_are_scrolled_to() {
    with_report large
    equals "$(browser_run "return document.querySelector('#table_count').textContent")" '3010 of 3010 rows'
    local drawn more
    drawn=$(browser_run "return document.querySelectorAll('#table tbody tr').length")
    [ "$drawn" -lt 400 ]
    browser_click '#table th[data-key="ms"] button'
    browser_run "const scroll = document.querySelector('#table_scroll'); scroll.scrollTop = scroll.scrollHeight;
        await new Promise(done => setTimeout(done, 300));" >/dev/null
    more=$(browser_run "return document.querySelectorAll('#table tbody tr').length")
    [ "$more" -gt "$drawn" ]
    equals "$(cells ms)" "$(cells ms | sort -g)" # what came later goes on where it stopped
    browser_keys '#table_text' 'RAYS=7 camera'
    equals "$(browser_run "return document.querySelector('#table_count').textContent")" '330 of 3010 rows'
    equals "$(browser_complaints)" ''
}

test_empty_results_are_said_to_be_empty() {
    with_report empty
    equals "$(browser_complaints)" ''
    equals "$(browser_run "return [document.querySelector('#empty').hidden, document.querySelector('#main').hidden].join()")" false,true
    browser_open "$(realpath "$tmp")/missing/report.html"
    equals "$(browser_complaints)" ''
    equals "$(browser_run "return document.querySelectorAll('#table tbody tr').length")" 10
}

test_report_loads_sorts_wipes_and_draws_errors() {
    with_report pages
    browser_run "$wait_for_pictures" >/dev/null
    local check
    for check in "${checks[@]}"; do "$check"; done
    equals "$(browser_complaints)" '' # nor afterwards
}

test_report_of_a_real_measurement_loads_and_shows_it() {
    browser_need
    mkdir -p "$tmp/real"
    printf 'size = 64x40\nr_max = 0.1\nnoise = 0.05\n[volume]\nresolution = 32\n[ssao]\nsamples = 4\n[reference]\nsees = screen\n' >"$tmp/sweep.txt"
    "$program" measure tests/game/data/crate.gltf --backend osmesa --cache "$tmp/cache" --sweep "$tmp/sweep.txt" --out "$tmp/real" \
        >"$tmp/real.log" 2>&1 || { cat "$tmp/real.log"; return 1; }
    with_report real
    browser_run "$wait_for_pictures" >/dev/null
    browser_run 'await settled();' >/dev/null
    equals "$(count '#table tbody tr') $(count '#chart_ms .sign') $(count '#chart_ms .screen_line') $(count '#maps canvas') $(count '#screen_errors tbody tr')" '5 4 1 2 1'
    browser_run "return [...document.querySelectorAll('#left_picture option')].map(option => option.value).join()" >"$tmp/sources"
    assert_holds "$(cat "$tmp/sources")" 'truth,screen,lit,geometry,setting volume,' # kept always; others when they are on a front
    assert_holds "$(cat "$tmp/sources")" ',setting ssao,'
    browser_run "return document.querySelector('#pinned').textContent" >"$tmp/pinned"
    not grep -q 'NaN\|undefined' "$tmp/pinned"
    equals "$(browser_complaints)" ''
}

# Test of the test: a report without its script must pass none of it.
test_a_report_without_its_script_fails_each_check() {
    with_report pages
    mkdir -p "$tmp/broken"
    sed '/^<script>$/,/^<\/script>$/d' "$tmp/pages/report.html" >"$tmp/broken/report.html"
    [ "$(wc -c <"$tmp/broken/report.html")" -lt "$(wc -c <"$tmp/pages/report.html")" ]
    browser_open "$(realpath "$tmp")/broken/report.html"
    browser_run "window.settled = async () => {}" >/dev/null
    local check code
    for check in shows_all_rows sorts_by_a_header_and_back wipes draws_error_maps; do
        set +e # and no if around the subshell: both would switch off its own set -e
        (set -e; "$check") >"$tmp/broken.log" 2>&1
        code=$?
        set -e
        [ $code -ne 0 ] || { echo "$check holds for a report without its script"; return 1; }
    done
    sed 's/^start();$/nonsense();/' "$tmp/pages/report.html" >"$tmp/broken/report.html"
    browser_open "$(realpath "$tmp")/broken/report.html"
    assert_holds "$(browser_complaints)" nonsense
}

if (browser_need) >/dev/null; then
    NOOK_ROOT=$PWD NOOK_TEST_TMP=$tmp "$maker" >"$tmp/maker.log" 2>&1
    browser_start "$tmp/browser"
fi
run_tests
