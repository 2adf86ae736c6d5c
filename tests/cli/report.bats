#!/usr/bin/env bats
# The report page: what is in it, and in a browser what it does.

setup_file() {
  load common
  make_room
  cat > room.require.toml <<'END'
dim = "requirements/1"
source = "the tests"
maintenance_factor = 0.8
[[require]]
plane = "workplane"
illuminance = 100
uniformity = 0.3
ugr = 22
[[require]]
surfaces = ["wall-n"]
illuminance = 20
END
}
setup() { load common; load browser; enter_copy; }
teardown() { stop_browser; }

# The page's data as JSON.
data() { grep '^<script type="application/json" id="data">' "$1" | sed 's/^[^>]*>//; s/<\/script>$//'; }

# near A B SHARE
near() { awk -v a="$1" -v b="$2" -v s="$3" 'BEGIN { d = a - b; exit !((d < 0 ? -d : d) <= s * (b < 0 ? -b : b)) }' || { echo "$1 is not $2"; return 1; }; }

@test "a report is one page that asks no host" {
  dimout report room.lum --require room.require.toml -o a.html
  [ "$(grep -ciE 'https?://|src="[^d]|@import|url\(' a.html)" -eq 0 ]
  grep -q "default-src 'none'" a.html
  [ "$(data a.html | jq -r .inputs.hash)" = "$(dimout info room.lum --json | jq -r .hash)" ]
  dimout report room.lum --require room.require.toml --threads 1 -o - | cmp - a.html
}

@test "a report's findings are those of check, its groups those of the lights file" {
  dimout report room.lum --require room.require.toml -o a.html
  dimout check room.lum --require room.require.toml --json -o check.json || [ $? -eq 1 ]
  data a.html | jq -c '[.requirements.findings[] | [.where, .what, (.value * 1e6 | round), .verdict]]' > page.json
  jq -c '[.[] | [.where, .requirement, (.value * 1e6 | round), .verdict]]' check.json | diff - page.json
  [ "$(data a.html | jq -c '[.groups[] | [.name, .start, .kept]]')" = '[["panels",1,0.8],["spot",1,0.8]]' ]
  dimout report room.lum --mix panels=0.5 -o b.html
  [ "$(data b.html | jq -c '[.groups[] | [.name, .start, .kept]]')" = '[["panels",0.5,1],["spot",1,1]]' ]
}

@test "names are text, whatever they hold" {
  sed 's/^name = "room"/name = "<script>alert(1)<\/script> \\"q\\" \&amp; @DATA@"/; s/^name = "workplane"/name = "<\/script><img src=x onerror=alert(1)>"/' room.zone.toml > odd.zone.toml
  dimdis odd.zone.toml -q --patches 4x8 -o odd.rays
  dimray odd.rays room.lights.toml -q -o odd.lum
  dimout report odd.lum -o a.html
  [ "$(grep -c '<script>alert\|<img' a.html)" -eq 0 ]
  [ "$(data a.html | jq -r '.targets[0].name')" = '</script><img src=x onerror=alert(1)>' ]
  missing=$(browser_missing)
  [ -z "$missing" ] || skip "$missing"
  start_browser
  open_page "$PWD/a.html"
  [ "$(ask 'return document.querySelector("h1").textContent')" = '<script>alert(1)</script> "q" &amp; @DATA@' ]
  [ "$(ask 'return document.querySelectorAll("img[src=x]").length')" -eq 0 ]
}

@test "rooms without plane, view or luminaires have a report" {
  sed '/^\[\[plane\]\]/,$d' room.zone.toml > bare.zone.toml
  dimdis bare.zone.toml -q --patches 4x8 -o bare.rays
  dimray bare.rays room.lights.toml -q -o bare.lum
  dimout report bare.lum -o a.html
  [ "$(data a.html | jq -c '[(.targets | length), (.pictures | length)]')" = '[0,0]' ]
  missing=$(browser_missing)
  [ -z "$missing" ] || skip "$missing"
  start_browser
  open_page "$PWD/a.html"
  [[ "$(ask 'return document.body.innerText')" == *"no measuring plane"* ]]
}

@test "of 500 luminaires a report says fields and few sliders" {
  printf 'dim = "lights/1"\n[[luminaire]]\nname = "F"\nideal = "isotropic"\nintensity = 1\nat = [0.1, 0.1, 2.4]\ncount = [25, 20]\npitch = [0.15, 0.14]\n' > many.lights.toml
  dimray room.rays many.lights.toml -q -o many.lum
  dimout report many.lum -o a.html
  [ "$(data a.html | jq '[(.groups | length), (.luminaires.places | length), (.luminaires.fittings | length)] == [1, 500, 1]')" = true ]
  [ "$(stat -c %s a.html)" -lt 3000000 ]
  missing=$(browser_missing)
  [ -z "$missing" ] || skip "$missing"
  start_browser
  open_page "$PWD/a.html"
  [ "$(ask 'return document.querySelectorAll("#luminaires table")[1].rows.length')" -eq 2 ]
}

@test "in a browser a slider's answer is that of --mix" {
  missing=$(browser_missing)
  [ -z "$missing" ] || skip "$missing"
  dimout report room.lum --require room.require.toml -o a.html
  start_browser
  open_page "$PWD/a.html"
  mean='return report.results[0] && figuresOf(report.results[0].target, report.factors).mean'
  shown='return document.querySelector("#results table").rows[1].cells[1].textContent'
  stats() { dimout grid room.lum --plane workplane --stats "$@" --json | jq -r ".[0].$field"; }
  field=mean_lx near "$(ask "$mean")" "$(field=mean_lx stats)" 1e-6
  ask 'document.getElementById("light-0").focus()' > /dev/null
  press E012 63
  [ "$(ask 'return document.getElementById("light-0").value')" = 37 ]
  near "$(ask "$mean")" "$(field=mean_lx stats --mix panels=0.37)" 1e-6
  near "$(ask "$shown" | sed 's/ lx//')" "$(field=mean_lx stats --mix panels=0.37)" 1e-2
  near "$(ask 'return figuresOf(report.results[0].target, report.factors).u0')" "$(field=u0 stats --mix panels=0.37)" 1e-6
  # The verdicts are those of check; each stated error is no less than what check states.
  dimout check room.lum --require room.require.toml --mix panels=0.37 --json -o check.json || [ $? -eq 1 ]
  ask 'return JSON.stringify(report.data.requirements.findings.map((f) => findingFor(f, report.data, report.factors)))' > page.json
  for row in 0 1 2 3; do
    near "$(jq ".[$row].value" page.json)" "$(jq ".[$row].value" check.json)" 1e-5
    [ "$(jq ".[$row].verdict" page.json)" = "$(jq ".[$row].verdict" check.json)" ]
    jq -e -n --slurpfile p page.json --slurpfile c check.json "\$p[0][$row].error >= \$c[0][$row].error * 0.999999"
  done
  [ "$(ask 'return performance.getEntriesByType("resource").filter((e) => !/^(data|blob):/.test(e.name)).length')" -eq 0 ]
}

@test "in a browser the picture is that of image" {
  missing=$(browser_missing)
  [ -z "$missing" ] || skip "$missing"
  dimout report room.lum -o a.html
  start_browser
  open_page "$PWD/a.html"
  ask 'report.factors[1] = 0.25; report.views[0].white = null; report.update()' > /dev/null
  dimout image room.lum --mix spot=0.25 -o a.png
  # Decoded by the browser itself and compared there: at most one step of 255 apart but for few pixels.
  png=$(base64 -w0 a.png)
  jq -n --arg png "$png" '{script: "const done = arguments[1]; const image = new Image(); image.onload = () => { const c = document.createElement(\"canvas\"); c.width = image.width; c.height = image.height; const x = c.getContext(\"2d\"); x.drawImage(image, 0, 0); const a = x.getImageData(0, 0, c.width, c.height).data, b = report.views[0].image.data; let far = 0; for (let i = 0; i < a.length; i++) if (Math.abs(a[i] - b[i]) > 1) far++; done(a.length === b.length ? far / a.length : 1); }; image.src = \"data:image/png;base64,\" + arguments[0];", args: [$png]}' > ask.json
  far=$(curl -sf "$SESSION/execute/async" -H 'Content-Type: application/json' -d @ask.json | jq .value)
  echo "share of values more than one step apart: $far"
  awk -v f="$far" 'BEGIN { exit !(f <= 0.002) }'
}

@test "a report's options are checked" {
  refused 2 "no effect without --require" dimout report room.lum --set maintenance_factor=0.7 -o x.html
  refused 3 "nowhere" dimout report room.lum --require <(sed 's/"workplane"/"nowhere"/' room.require.toml) -o x.html
}
