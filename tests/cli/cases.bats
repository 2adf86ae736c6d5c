#!/usr/bin/env bats
# The small inputs that failed in the first build, each with its right answer. They lie outside the repository, in
# $DIM_SHARED_CASES or ../shared/cases; where they are absent these tests are skipped by name. The kinds that they
# stand for are tested on inputs of our own beside the code concerned.

setup() {
  load common
  local cases=${DIM_SHARED_CASES:-$DIM_SOURCE/../shared/cases}
  [ -d "$cases" ] || skip "no $cases"
  cd "$BATS_TEST_TMPDIR"
  cp -r "$cases"/. .
}

# `solve ZONE LIGHTS OPTIONS...`: a.rays and a.lum, messages to `said`, the status of dimray.
solve() {
  dimdis "$1" -o a.rays 2> said
  dimray a.rays "${@:2}" -o a.lum 2>> said
}

# Figures of a table: `column NAME` of the CSV on stdin.
column() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i; next } { print $at }'; }

# `near TOLERANCE WANTED...`: the numbers on stdin are those, each within that part of it.
near() {
  local tolerance=$1
  shift
  paste - <(printf '%s\n' "$@") | awk -v tolerance="$tolerance" '
    { d = $1 - $2; if (d < 0) d = -d; print $1, "wanted", $2; if (NF != 2 || d > tolerance * $2) bad = 1 }
    END { exit bad || NR == 0 }'
}

all_dark() { awk '$1 != 0 { bad = 1 } END { exit bad || NR == 0 }'; }

# Mean illuminance over all surfaces.
mean_lx() { dimout surfaces a.lum -q | awk -F, 'NR > 1 { flux += $2 * $3; area += $2 } END { print flux / area }'; }

@test "light-tight-box: nothing gets into a box of thin panels" {
  cd light-tight-box
  for turn in 0 17.3 30; do
    solve zone$turn.toml lights.toml
    dimout grid a.lum | column illuminance_lx | all_dark
    dimout surfaces a.lum | grep '\.back,' | cut -d, -f3 | all_dark
  done
}

@test "partition-leak, recessed-and-plenum-leak, dark-room-not-zero: closed off is dark" {
  cd partition-leak
  for zone in part solid-wall; do
    solve $zone.zone.toml base.lights.toml --set 'luminaire.A.at=[1.5,1.5,2.69]'
    dimout grid a.lum --plane behind | column illuminance_lx | all_dark
  done
  cd ../recessed-and-plenum-leak
  for at in 10.0 10.1; do
    solve zone$at.toml l.toml
    dimout grid a.lum | column illuminance_lx | all_dark
  done
  cd ../dark-room-not-zero
  for tolerance in 0.0003 0.003 1e-6; do
    solve zone.toml lights.toml --tolerance $tolerance
    [ "$(dimout grid a.lum | column illuminance_lx | tail -1)" = 0 ]
  done
}

@test "slats-thin-shadows: what slats take does not depend on what else shines" {
  cd slats-thin-shadows
  solve slats-5-percent.zone.toml one.lights.toml
  dimout surfaces a.lum > one.csv
  grep '^floor,' one.csv | cut -d, -f3 | near 0.001 65.47
  dimray a.rays with-thirty-faint.lights.toml -q -o a.lum
  dimout surfaces a.lum | grep '^floor,' | cut -d, -f3 | near 1e-7 "$(grep '^floor,' one.csv | cut -d, -f3)"
}

@test "weak-source-beside-bright-ones: a source is lit alone as in company" {
  cd weak-source-beside-bright-ones
  for room in black_1.0 office_1.0; do
    solve zone_$room.toml alone.toml
    dimout surfaces a.lum --by source > alone.surfaces
    dimout grid a.lum --by source > alone.points
    dimray a.rays both.toml --combine each -q -o a.lum
    dimout surfaces a.lum --by source | grep -e '^source' -e '^E,' | cmp - alone.surfaces
    dimout grid a.lum --by source | grep -e '^source' -e '^E,' | cmp - alone.points
  done
}

@test "horizon-panel: half a panel over the horizon, by Lambert's edges" {
  cd horizon-panel
  solve pan.zone.toml pan.lights.toml
  # L (atan(w/d) - d/r atan(w/r)) with r = sqrt(d^2 + h^2), w = h = 1 m, L = 25 cd/m2.
  dimout grid a.lum | column illuminance_lx | near 1e-4 $(awk 'BEGIN {
    for (i = 0; i < 40; ++i) { d = 10 + i / 10; r = sqrt(d * d + 1); print 25 * (atan2(1, d) - d / r * atan2(1, r)) } }')
}

@test "narrow-spot: a beam of half a degree keeps its flux" {
  cd narrow-spot
  for beam in 05 2 5; do
    sed "s/spot05/spot$beam/" sp05.lights.toml > l.toml
    solve open.zone.toml l.toml
    [[ "$(cat said)" != *'never reaches'* ]]
    awk '/imbalance/ { sub(/.*imbalance /, ""); d = $1 + 0; if (d < 0) d = -d; exit d > 0.1 }' said
  done
}

@test "mirror-facing-mirror: the infinite sum of images" {
  cd mirror-facing-mirror
  solve zone.toml lights.toml
  dimout grid a.lum | column illuminance_lx | near 2e-5 13.9225 33.7504 6.4383 23.4293
  run --separate-stderr dimray a.rays lights.toml --mirror-depth 3 -o a.lum
  [ "$status" -eq 1 ]
  [[ "$stderr" == *'images in mirrors deeper than those made'*'the accuracy asked for was not reached'* ]]
  dimout grid a.lum | column illuminance_lx | near 2e-5 13.8179 33.6498 5.6844 23.3021
}

@test "mirrors-four: images and rays followed agree" {
  cd mirrors-four
  solve mir0.zone.toml iso.lights.toml
  dimout surfaces a.lum > by-default
  dimray a.rays iso.lights.toml --mirror-depth 1 -q -o a.lum
  dimout surfaces a.lum | grep -e floor -e ceiling | cut -d, -f3 | near 0.001 $(grep -e floor -e ceiling by-default | cut -d, -f3)
}

@test "mirrors-bound: the error is within what is said" {
  cd mirrors-bound
  solve mirx.zone.toml iso.lights.toml
  bound=$(sed -n 's/.*error at most \([^ ]*\) %.*/\1/p' said)
  dimout cells a.lum | column illuminance_lx > found
  dimray a.rays iso.lights.toml --tolerance 1e-9 -q -o a.lum
  dimout cells a.lum | column illuminance_lx > right
  paste found right | awk -v bound="$bound" '
    { d = $1 - $2; if (d < 0) d = -d; if (d > worst) worst = d; sum += $2 }
    END { print "error", 100 * worst / (sum / NR), "bound", bound; exit !(100 * worst / (sum / NR) <= bound) }'
}

@test "coloured-room-one-band, one-band-reflectance: colour in few bands" {
  cd coloured-room-one-band
  solve zone_red.toml l.toml
  mean_lx | near 0.0031 29.54
  solve zone_blue.toml l.toml
  mean_lx | near 0.0031 23.022
  cd ../one-band-reflectance
  solve r.zone.toml r.lights.toml --set luminaire.A.spectrum=d65 --bands 1
  for pair in floor:linoleum-brown south:paint-red; do
    dimout surfaces a.lum -q | awk -F, -v s=${pair%:*} '$1 == s { print atan2(0, -1) * $6 / $3 }' \
      | near 0.002 "$(dimdbm show ${pair#*:} | awk '$1 == "luminous_reflectance" { print $2 }')"
  done
}

@test "two-lamps, ldt-no-spectrum: colour only of what is known" {
  cd two-lamps
  solve c.zone.toml c.lights.toml
  dimout colour a.lum 2>&1 | column cct_K | awk '!($1 > 2500 && $1 < 7000) { bad = 1 } END { exit bad || NR == 0 }'
  dimray a.rays c.lights.toml --bands 1 -q -o a.lum
  run --separate-stderr dimout colour a.lum
  [[ "$stderr" == *warning* ]]
  [ -z "$(column cct_K <<< "$output" | tr -d '\n')" ]
  cd ../ldt-no-spectrum
  solve base.zone.toml ldt.lights.toml
  run --separate-stderr dimout colour a.lum
  [[ "$stderr" == *"source 'A': no spectrum is stated"* ]]
  for name in cct_K ra melanopic_edi_lx; do [ -z "$(column $name <<< "$output" | tr -d '\n')" ]; done
}

@test "plane-over-walls-statistics, plane-outside: points outside are named and left out" {
  cd plane-over-walls-statistics
  solve zone.toml lights.toml
  grep "36 of 96 points lie outside" said
  dimout grid a.lum --stats | grep '^over' | cut -d, -f3,6 | tr , '\n' | awk '!($1 > 0) { bad = 1 } END { exit bad }'
  cd ../plane-outside
  solve plane-outside.zone.toml base.lights.toml
  grep "96 of 96 points lie outside" said
  [ "$(dimout grid a.lum --stats | tail -1)" = work,96,,,,,,96, ]
}

@test "furniture-outside, eye-in-desk, wrong-unit, unit-mistakes: each said with its cure" {
  warned() { # WORDS COMMAND...
    run --separate-stderr "${@:2}"
    echo "$stderr"
    [[ "$stderr" == *warning:*$'\n        '* && "$stderr" == *"$1"* ]]
  }
  cd furniture-outside
  warned "box 'desk' goes through" dimdis check base.zone.toml --set 'box.desk.size=[140,70,72]'
  warned "box 'desk' lies outside" dimdis check base.zone.toml --set 'box.desk.corner=[10,10,0]'
  warned 'lies outside the zone' dimdis check base.zone.toml --set 'view.door.eye=[30,30,160]'
  warned "inside box 'desk'" dimdis check base.zone.toml --set 'view.door.eye=[1.2,1.2,0.4]'
  warned '96 of 96 points lie outside' dimdis check base.zone.toml \
    --set 'plane.work.vertices=[[10.5,0.5,0.75],[13.5,0.5,0.75],[13.5,2.5,0.75],[10.5,2.5,0.75]]'
  warned 'is it unit = "m"' dimdis check base.zone.toml --set 'unit=mm'
  warned "inside box 'desk'" dimdis check ../eye-in-desk/eye-in-desk.zone.toml
  warned 'is it unit = "m"' dimdis check ../wrong-unit/unit.zone.toml
  warned 'is it unit = "m"' dimdis check ../unit-mistakes/m_as_mm.toml
  warned 'is it unit = "m"' dimdis check ../unit-mistakes/nocell_mm.toml
  warned 'is it unit = "mm"' dimdis check ../unit-mistakes/mm_as_m.toml
  warned 'is it unit = "mm"' dimdis check ../unit-mistakes/nocell.toml
  cd ../eye-in-desk
  dimdis eye-in-desk.zone.toml -q -o a.rays
  dimray a.rays base.lights.toml -q -o a.lum
  warned 'shows no light at all' dimout image a.lum --size 40x30 -o a.png
  warned 'shows no light at all' dimout image a.lum --size 40x30 --tone falsecolour -o a.png
}

@test "box-through-wall: what lies outside is not counted" {
  cd box-through-wall
  solve boxgoesthrough.zone.toml base.lights.toml
  grep "box 'desk' goes through the zone's surfaces: the part outside is cut off" said
  run ! grep 'seen from behind' said
  dimout surfaces a.lum > through
  # The same room with a desk that ends at the wall.
  corner=$(awk -F'[][,]' '/^\[\[box/ { box = 1 } box && /^corner/ { print 4 - $2; exit }' boxgoesthrough.zone.toml)
  sed "/^\[\[box\]\]/,/^\[\[plane/s/^size = \[[^,]*/size = [$corner/" boxgoesthrough.zone.toml > ends.zone.toml
  solve ends.zone.toml base.lights.toml
  run ! grep 'goes through' said
  dimout surfaces a.lum | cut -d, -f1 | cmp - <(cut -d, -f1 through)
  dimout surfaces a.lum | sed 1d | cut -d, -f2 > areas
  sed 1d through | cut -d, -f2 | near 1e-9 $(cat areas)
  # Beneath it there are 5 mm: what little light gets in differs with the cells, which begin elsewhere.
  dimout surfaces a.lum | sed '1d; /bottom/d' | cut -d, -f3 > lux
  sed '1d; /bottom/d' through | cut -d, -f3 | near 0.005 $(cat lux)
}

@test "percent-dim: 30 times the flux is said" {
  cd percent-dim
  solve base.zone.toml dim30.lights.toml
  grep 'dim30.lights.toml:7:.*dim = 30 is 30 times the full flux' said
  grep 'in percent? write dim = 0.3' said
}

@test "overlaps-and-near-coplanar: the smaller lies on top, once said" {
  cd overlaps-and-near-coplanar
  for height in 0 1e-09 1e-07; do
    solve z$height.toml lights.toml
    [ "$(grep -c "'rug' lies on top" said)" -eq 1 ]
    [ "$(dimout surfaces a.lum | grep '^floor,' | cut -d, -f2)" = 12 ]
  done
  run dimdis check --strict z0.toml
  [ "$status" -eq 3 ]
  for height in 1e-05 0.001; do
    solve z$height.toml lights.toml
    [ "$(dimout surfaces a.lum | grep '^floor,' | cut -d, -f4)" = 0 ]
  done
}

@test "gamma-not-from-0: the nearest value is carried on, and said" {
  cd gamma-not-from-0
  for lights in l l2; do
    solve zone.toml $lights.toml || [ $? -eq 1 ]
    grep 'vertical angles begin at 2.5 with light left' said
    # 1000 cd cos(2.5 degrees) from 3 m.
    dimout grid a.lum | column illuminance_lx | head -1 | near 1e-4 "$(awk 'BEGIN { print 1000 * cos(atan2(0, -1) / 72) / 9 }')"
  done
}

@test "eulumdat-surplus-planes: planes that Isym does not ask for are said" {
  cd eulumdat-surplus-planes
  for isym in 1 2 4; do
    run --separate-stderr dimdbm show isym$isym.ldt
    [[ "$stderr" == *"isym$isym.ldt:"*"more numbers after the intensities"* ]]
  done
  run --separate-stderr dimdbm show isym0.ldt
  [ -z "$stderr" ]
}

@test "tilt-line-forms, tilt-path: understood or refused at the line" {
  cd tilt-line-forms
  dimdbm show semicolon.ies
  for name in file-word missing-file sameline; do
    run --separate-stderr dimdbm show $name.ies
    [ "$status" -eq 3 ]
    [[ "$stderr" == *"$name.ies:3:1: TILT="* ]]
  done
  run --separate-stderr dimdbm show ../tilt-path/abs.ies
  [ "$status" -eq 3 ]
  [[ "$stderr" == *'names another folder'* && "$stderr" != *root:* ]]
}

@test "header-variants: the edition decides what the third number is" {
  cd header-variants
  candela() { # HEADER
    { echo "$1"; tail -n +2 h.ies; } > k.ies
    dimdbm show k.ies 2> /dev/null | awk '$1 == "max_intensity_cd" { print $2 }'
  }
  for header in 'IESNA: LM-63-1991' 'IESNA 91' IESNA91; do [ "$(candela "$header")" = 110 ]; done
  for header in 'IESNA: LM-63-2002' 'ANSI/IES LM-63-19' IES:LM-63-2019; do [ "$(candela "$header")" = 100 ]; done
}

@test "overwrite-ldt: a file that the lights file reads is not overwritten" {
  cd classroom
  dimdis class.zone.toml -q -o a.rays
  cp ../overwrite-ldt/panel-4200.ldt .
  run --separate-stderr dimray a.rays class.lights.toml -o panel-4200.ldt
  [ "$status" -eq 2 ]
  [[ "$stderr" == *"'panel-4200.ldt' would be replaced"* ]]
  cmp panel-4200.ldt ../overwrite-ldt/panel-4200.ldt
}

@test "classroom: runs and keeps its energy" {
  cd classroom
  solve class.zone.toml class.lights.toml
  run ! grep -i error: said
}

@test "crafted-files: refused in one line" {
  cd crafted-files
  cp "$DIM_SOURCE"/tests/data/cli/room.lights.toml .
  gunzip *.gz
  for file in *.rays *.lum; do
    if [[ $file == *.rays ]]; then refused 4 "$file" dimray "$file" room.lights.toml -o x.lum
    else refused 4 "$file" dimout surfaces "$file"; fi
    [ "${#stderr_lines[@]}" -eq 1 ]
  done
}

@test "show-json-utf8: a name that is no UTF-8 becomes valid JSON" {
  cd show-json-utf8
  cp latin1-name.ies $'g\xff.ies'
  dimdbm show $'g\xff.ies' --json > out.json
  iconv -f UTF-8 -t UTF-8 out.json > /dev/null
  grep -q $'g\xef\xbf\xbd' out.json
}
