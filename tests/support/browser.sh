# shellcheck shell=bash
# A headless Chromium for tests written in bash, driven over WebDriver's HTTP: source this after support/shell.sh. Needs the Debian
# packages chromium, chromium-driver, curl and jq. Nothing is reached but the driver on this machine.

# browser_need: skips the test where something is not installed; fails it there when NOOK_NEED_BROWSER is set, as .ci/run does.
browser_need() {
    local tool
    for tool in chromium chromedriver curl jq; do
        command -v $tool >/dev/null && continue
        [ -z "${NOOK_NEED_BROWSER:-}" ] || { echo "$tool is not installed, and NOOK_NEED_BROWSER is set"; exit 1; }
        skip_test "$tool is not installed: the report was opened in no browser"
    done
}

# browser_start FOLDER: driver and browser, with their files in FOLDER; they end with the shell that called.
browser_start() {
    browser_folder=$1 browser_session='' browser_port=''
    rm -rf "$browser_folder"
    mkdir -p "$browser_folder/profile"
    # --no-sandbox: root has none to give; --disable-dev-shm-usage: containers have little of it.
    HOME=$browser_folder chromedriver --port=0 >"$browser_folder/driver.log" 2>&1 &
    browser_driver=$!
    trap browser_stop EXIT
    for _ in {1..100}; do
        sleep 0.1
        browser_port=$(sed -n 's/.*started successfully on port \([0-9]*\).*/\1/p' "$browser_folder/driver.log")
        [ -z "$browser_port" ] || break
    done
    browser_session=$(jq -n --arg binary "$(command -v chromium)" --arg profile "--user-data-dir=$browser_folder/profile" '
        { capabilities: { alwaysMatch: { browserName: "chrome", "goog:loggingPrefs": { browser: "ALL" },
          "goog:chromeOptions": { binary: $binary, args: [$profile, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
            "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-sync", "--disable-extensions",
            "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1200,900"] } } } }' |
        browser_call POST /session - | jq -r .sessionId)
}

browser_stop() {
    [ -z "$browser_session" ] || browser_call DELETE "/session/$browser_session" >/dev/null || true
    kill "$browser_driver" 2>/dev/null || true
    wait "$browser_driver" 2>/dev/null || true
}

# browser_call METHOD PATH [BODY]: the value of the driver's answer as JSON; - reads the body. Fails with the driver's message.
browser_call() {
    local answer
    answer=$(curl --silent --show-error --max-time 60 --request "$1" --header 'Content-Type: application/json' ${3+--data "${3/#-/@-}"} \
        "http://127.0.0.1:$browser_port$2")
    if jq -e '.value | type == "object" and has("error")' <<<"$answer" >/dev/null; then
        jq -r '.value.message' <<<"$answer" >&2
        return 1
    fi
    jq '.value' <<<"$answer"
}

browser_session_call() { browser_call "$1" "/session/$browser_session$2" "${@:3}"; }

browser_open() { # FILE
    browser_session_call POST /url "$(jq -n --arg url "file://$1" '{ url: $url }')" >/dev/null
}

# browser_run SCRIPT: runs the body of an asynchronous function in the page; prints what it returns, texts without quotes.
browser_run() {
    jq -n --arg script "const done = arguments[arguments.length - 1];
        (async () => { $1 })().then(value => done({ value }), error => done({ failed: String(error && error.stack || error) }));" \
        '{ script: $script, args: [] }' | browser_session_call POST /execute/async - |
        jq -r 'if has("failed") then error(.failed) else .value end'
}

# browser_complaints: what the page said on the console, one line each: errors, exceptions, refused requests. Empties the log.
browser_complaints() {
    browser_session_call POST /se/log '{ "type": "browser" }' | jq -r '.[] | select(.level != "DEBUG") | .level + " " + .message'
}

browser_element() { # SELECTOR: its reference
    browser_session_call POST /element "$(jq -n --arg selector "$1" '{ using: "css selector", value: $selector }')" | jq -r '.[]'
}

browser_click() { # SELECTOR: as a person does, after it was scrolled into view
    browser_session_call POST "/element/$(browser_element "$1")/click" '{}' >/dev/null
}

browser_keys() { # SELECTOR KEYS: keys by WebDriver's code points, such as $'\ue014'
    browser_session_call POST "/element/$(browser_element "$1")/value" "$(jq -n --arg keys "$2" '{ text: $keys }')" >/dev/null
}

# browser_drag SELECTOR X [TYPE]: presses at the element's middle, moves by X pixels, lets go. TYPE: mouse or touch.
browser_drag() {
    local element
    element=$(browser_element "$1")
    jq -n --arg element "$element" --argjson x "$2" --arg type "${3-mouse}" '
        { "element-6066-11e4-a52e-4f735466cecf": $element } as $origin |
        { actions: [{ type: "pointer", id: $type, parameters: { pointerType: $type }, actions: [
            { type: "pointerMove", duration: 0, x: 0, y: 0, origin: $origin }, { type: "pointerDown", button: 0 },
            { type: "pointerMove", duration: 100, x: $x, y: 0, origin: "pointer" }, { type: "pointerUp", button: 0 }] }] }' |
        browser_session_call POST /actions - >/dev/null
}

browser_screenshot() { # FILE
    browser_session_call GET /screenshot | jq -r . | base64 -d >"$1"
}

# browser_resize WIDTH HEIGHT: of the page itself, whatever frame the browser has.
browser_resize() {
    browser_devtools Emulation.setDeviceMetricsOverride "{ \"width\": $1, \"height\": $2, \"deviceScaleFactor\": 1, \"mobile\": false }"
}

browser_prefer() { # light or dark
    browser_devtools Emulation.setEmulatedMedia "{ \"features\": [{ \"name\": \"prefers-color-scheme\", \"value\": \"$1\" }] }"
}

browser_devtools() { # COMMAND PARAMETERS
    jq -n --arg command "$1" --argjson parameters "$2" '{ cmd: $command, params: $parameters }' |
        browser_session_call POST /goog/cdp/execute - >/dev/null
}
