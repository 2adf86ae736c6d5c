# A real browser for tests of pages: Chromium without a window, driven by the W3C WebDriver protocol.

browser_missing() {
  local program
  for program in chromium chromedriver curl jq; do
    command -v "$program" > /dev/null || { echo "no $program"; return; }
  done
}

start_browser() {
  chromedriver --port=0 > driver.log 2>&1 &
  DRIVER_PID=$!
  local port i
  for ((i = 0; i < 100; i++)); do
    port=$(sed -n 's/.*on port \([0-9]*\)\.*$/\1/p' driver.log | tail -1)
    [ -n "$port" ] && [ "$port" != 0 ] && break
    sleep 0.1
  done
  DRIVER="http://127.0.0.1:$port"
  local session
  session=$(curl -sf "$DRIVER/session" -H 'Content-Type: application/json' -d '{"capabilities": {"alwaysMatch": {"browserName": "chrome",
    "goog:chromeOptions": {"binary": "'"$(command -v chromium)"'",
    "args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,1000", "--user-data-dir='"$PWD"'/profile"]}}}}' | jq -r .value.sessionId)
  SESSION="$DRIVER/session/$session"
}

stop_browser() {
  [ -n "${DRIVER_PID-}" ] || return 0
  curl -s -X DELETE "$SESSION" > /dev/null || true
  kill "$DRIVER_PID" 2> /dev/null || true
  wait "$DRIVER_PID" 2> /dev/null || true
}

# tell PATH JSON
tell() { curl -sf "$SESSION/$1" -H 'Content-Type: application/json' -d "$2"; }

# Value of a script, as text: ask 'return document.title'
ask() { jq -n --arg script "$1" '{script: $script, args: []}' | curl -sf "$SESSION/execute/sync" -H 'Content-Type: application/json' -d @- | jq -r .value; }

open_page() {
  tell url "{\"url\": \"file://$1\"}" > /dev/null
  local i
  for ((i = 0; i < 200; i++)); do
    [ "$(ask 'return document.documentElement.dataset.ready')" = yes ] && return
    sleep 0.1
  done
  echo "the page never got ready: $(ask 'return document.body.innerText')"
  return 1
}

# press KEY TIMES, a code point of WebDriver's keys: E012 left, E014 right, E010 end, E011 home
press() {
  local i keys=()
  for ((i = 0; i < $2; i++)); do keys+=("{\"type\": \"keyDown\", \"value\": \"\\u$1\"}, {\"type\": \"keyUp\", \"value\": \"\\u$1\"}"); done
  local IFS=,
  tell actions "{\"actions\": [{\"type\": \"key\", \"id\": \"keyboard\", \"actions\": [${keys[*]}]}]}" > /dev/null
  sleep 0.3
}

screenshot() { curl -sf "$SESSION/screenshot" | jq -r .value | base64 -d > "$1"; }
