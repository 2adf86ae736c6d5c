#!/usr/bin/env bats
# Contours, glare, requirements.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

plane() { awk -F'"' '/^\[\[plane\]\]/ { on = 1 } on && /^name/ { print $2; exit }' room.zone.toml; }

@test "contours come as SVG, PNG and on standard output" {
  dimout contour room.lum -o a.svg
  dimout contour room.lum --plane "$(plane)" -o - | cmp - a.svg
  grep -q '<polyline' a.svg
  dimout contour room.lum --filled --values -o a.png
  [ "$(head -c 4 a.png | tail -c 3)" = PNG ]
  dimout contour room.lum --threads 1 -o b.svg
  cmp a.svg b.svg
}

@test "levels asked for are those on the lines" {
  dimout contour room.lum --filled --levels 30,10,20,20 -o a.svg
  [ "$(grep -c '>10 - 20<' a.svg)" -eq 1 ]
  [ "$(grep -c '>> 30<\|>&gt; 30<' a.svg)" -eq 1 ]
  refused 2 "levels '10,x'" dimout contour room.lum --levels 10,x -o x.svg
}

@test "a surface has contours from its cells" {
  dimout contour room.lum --surface floor -o a.svg
  grep -q 'illuminance on floor' a.svg
  refused 3 "no surface 'flor'" dimout contour room.lum --surface flor -o x.svg
}

@test "contours of what is none are refused" {
  refused 3 "no measuring plane or sensors 'nowhere'" dimout contour room.lum --plane nowhere -o x.svg
  refused 2 "must end in .svg or .png" dimout contour room.lum -o x.txt
  refused 3 "holds no daylight" dimout contour room.lum --daylight-factor -o x.svg
}

@test "a plane of one point or one row is drawn" {
  for grid in '[1, 1]' '[5, 1]' '[1, 5]'; do
    sed "/^name = \"$(plane)\"/,/^spacing/ s/^spacing.*/grid = $grid/" room.zone.toml > one.zone.toml
    dimdis one.zone.toml -q --patches 4x8 -o one.rays
    dimray one.rays room.lights.toml -q -o one.lum
    dimout contour one.lum --filled --values -o a.svg
  done
}

@test "glare of a view and of eyes over a plane" {
  dimout glare room.lum -o view.csv
  head -1 view.csv | grep -q '^view,ugr,background_cd_m2,sources,large_sources$'
  dimout glare room.lum --observers "$(plane)" --directions 4 -o all.csv
  dimout glare room.lum --observers "$(plane)" --directions 4 --worst -o worst.csv
  [ "$(wc -l < worst.csv)" -eq 2 ]
  awk -F, 'FNR == 2 && FILENAME == "worst.csv" { most = $7 } FNR > 1 && FILENAME == "all.csv" && $7 > most + 1e-9 { bad = 1 }
           END { exit bad }' worst.csv all.csv
  refused 2 "height" dimout glare room.lum --height 1.2
  refused 3 "nowhere" dimout glare room.lum --observers nowhere
}

# A room of 4 x 4 x 3 m with a window to the south, and an eye in its middle that looks at it.
side_room() {
  side_zone 0.5 0.5 > side.zone.toml
  cat >> side.zone.toml << 'EOF'
[[sensors]]
name = "eye"
points = [[2, 2, 1.5, 0, -1, 0], [2, 2, 1.5, 0, 1, 0]]
[[view]]
name = "window"
eye = [2, 2, 1.5]
focus = [2, 0, 1.5]
[[view]]
name = "back"
eye = [2, 2, 1.5]
focus = [2, 4, 1.5]
EOF
  printf 'dim = "lights/1"\n[sky]\nmodel = "tregenza"\n' > side.lights.toml
  dimdis side.zone.toml -q --patches 16x32 --point-patches 32x64 -o side.rays
  dimray side.rays side.lights.toml -q -o side.lum
}

@test "daylight glare: the picture's vertical illuminance is that of a sensor at the eye" {
  side_room
  for sky in uniform:15000 cie-overcast:20000 cie-12:30000@40,150; do
    dimout grid side.lum --sky $sky -o eye.csv
    for view in window back; do
      dimout glare side.lum --view $view --daylight --sky $sky --json -o dgp.json
      lx=$(awk -F, -v row=$([ $view = window ] && echo 2 || echo 3) 'NR == row { print $9 }' eye.csv)
      echo "$sky $view: $(jq -c '.[0]' dgp.json), a sensor there $lx lx"
      jq -e --argjson lx "$lx" '.[0].vertical_lx / $lx | . > 0.97 and . < 1.03' dgp.json
    done
  done
}

@test "daylight glare: a window under a bright sky is one source, and DGP its formula" {
  side_room
  dimout glare side.lum --view window --daylight --sky uniform:40000 --json -o dgp.json
  jq -e '.[0] | .sources == 1 and .dgp > 5.87e-5 * .vertical_lx + 0.16 and ((.dgps - (6.22e-5 * .vertical_lx + 0.184)) | fabs) < 1e-6' dgp.json
}

@test "daylight glare is refused where it is not known" {
  side_room
  refused 2 "needs a sky" dimout glare side.lum --daylight
  refused 3 "no daylight" dimout glare room.lum --daylight
  refused 3 "window 'window' scatters" dimout glare side.lum --daylight --sky uniform:10000 --state window=drawn
}

@test "a glare table has 95 rows, and only of fittings" {
  run --separate-stderr dimdbm ugr troffer-3600
  [ "$status" -eq 0 ]
  [ "${#lines[@]}" -eq 96 ]
  refused 3 "no fitting" dimdbm ugr paint-white-matt
  refused 2 "spacing" dimdbm ugr troffer-3600 --spacing 0.5
}

@test "requirements decide the exit status" {
  printf 'dim = "requirements/1"\nsource = "us"\n[[require]]\nplane = "%s"\nilluminance = 1e-3\n' "$(plane)" > easy.toml
  run --separate-stderr dimout check room.lum --require easy.toml
  [ "$status" -eq 0 ]
  [[ "${lines[1]}" == *",met" ]]
  [[ "$stderr" == *"1 met, 0 not met, 0 undecided"* ]]
  sed -i 's/1e-3/1e6/' easy.toml
  run --separate-stderr dimout check room.lum --require easy.toml
  [ "$status" -eq 1 ]
  [[ "${lines[1]}" == *",not met" ]]
  sed -i 's/plane = .*/plane = "nowhere"/' easy.toml
  refused 3 "easy.toml:3:.*nowhere" dimout check room.lum --require easy.toml
}

@test "--accuracy is reached, said, and kept in the network" {
  share() { dimout grid "$1" | awk -F, 'NR > 1 && $9 > 0 { n++; bad += $NF > s * $9 } END { exit !(n > 0 && bad <= 0.05 * n) }' s="$2"; }
  dimray room.rays room.lights.toml --accuracy 0.2% -o fine.lum 2> said
  grep -E "accuracy: 0\.[0-9]+ % stated at 95 % of the points, 0.2 % asked for" said
  share fine.lum 0.002
  run ! share room.lum 0.0001
  dimdis room.zone.toml --accuracy 0.2% -o asked.rays
  dimray asked.rays room.lights.toml -o asked.lum 2> said
  grep "0.2 % asked for" said
  share asked.lum 0.002
}

@test "--budget refines within a time and says what came of it" {
  dimdis room.zone.toml --cell 1 --patches 4x8 -o coarse.rays
  dimray coarse.rays room.lights.toml --budget 1ms -o little.lum 2> said
  grep -E "accuracy: [0-9.]+ % stated at 95 % of the points, 1ms asked for; cells 1.00 times" said
  dimray coarse.rays room.lights.toml --budget 60 -o more.lum --stats more.json 2> said
  grep -E "accuracy: [0-9.]+ % stated at 95 % of the points, 60 asked for; cells 0\.[0-9]+ times" said
  jq -e '.budget_s == 60 and .accuracy_networks > 0 and .seconds.total < 120' more.json
  for wrong in 0 -1 soon 3days 10sec; do
    refused 2 "not a time above 0" dimray room.rays room.lights.toml --budget "$wrong" -o x.lum
  done
  refused 2 "excludes" dimray room.rays room.lights.toml --budget 1s --accuracy 1% -o x.lum
}

@test "long work is predicted before it begins" {
  run --separate-stderr dimdis "$DIM_SOURCE/examples/02-office/office.zone.toml" --patches 64x64 -j 1 -o long.rays
  [[ "$stderr" == *"cells, "*" million rays: about "*" s on 1 thread, "*" GB"* ]]
  run --separate-stderr dimdis room.zone.toml -o short.rays
  [[ "$stderr" != *"million rays"* ]]
}

@test "info says what each plane's stated error consists of" {
  run --separate-stderr dimout info room.lum
  [[ "$output" == *"stated at 95 % of the points"*"workplane"*"bound: light between surfaces left out"* ]]
  dimout info room.lum --json | jq -e '.planes[0] | .error >= .bound and .error >= .estimate_cells and .estimate_rays > 0'
}

@test "--accuracy that is no share, or of light whose error is not known, is refused" {
  for wrong in 0 -1% 60% x 2%%; do
    refused 2 "not a share of at most 50 %" dimray room.rays room.lights.toml --accuracy "$wrong" -o x.lum
    refused 2 "not a share of at most 50 %" dimdis room.zone.toml --accuracy "$wrong" -o x.rays
  done
  refused 2 "no effect with --solver track" dimray room.rays room.lights.toml --accuracy 1% --solver track -o x.lum
  sed '/^\[\[luminaire\]\]/,$d' room.lights.toml > dark.lights.toml
  printf '[[luminaire]]\nname = "in the floor"\nideal = "isotropic"\nintensity = 0\nat = [1, 1, 1]\n' >> dark.lights.toml
  run --separate-stderr dimray room.rays dark.lights.toml --accuracy 1% -o x.lum
  [ "$status" -eq 3 ]
  [[ "$stderr" == *"no measuring point is lit"* ]]
}
