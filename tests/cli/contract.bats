#!/usr/bin/env bats
# Names, flags, exit status, columns: what users' scripts rely on.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

@test "every program and command has help with an example and the exit status" {
  for command in dimdis "dimdis check" "dimdis areas" "dimdis viewfactors" "dimdis draw" dimray dimout \
    "dimout info" "dimout surfaces" "dimout cells" "dimout grid" "dimout colour" "dimout image" "dimout report" dimdbm "dimdbm list" \
    "dimdbm show" "dimdbm plot" "dimdbm add" "dimdbm remove" "dimdbm check" "dimdbm export"; do
    run --separate-stderr $command --help
    echo "$command: $output $stderr"
    [ "$status" -eq 0 ]
    [ -z "$stderr" ]
    [[ "$output" == *"Example:"*"${command%% *} "* ]]
    [[ "$output" == *"Exit status: 0 done"*"130 interrupted"* ]]
    [[ "$output" != *"=[]"* ]]
  done
}

@test "every program and command says its version and file formats" {
  for command in dimdis dimray dimout dimdbm "dimdis areas" "dimout grid" "dimdbm add"; do
    run --separate-stderr $command --version
    [ "$status" -eq 0 ]
    [[ "$output" == "${command%% *} "[0-9]*"file formats:"* ]]
  done
}

@test "the columns of the tables are those of the contract" {
  head1() { "$@" | sed -n 1p; }
  [ "$(head1 dimout surfaces room.lum)" = surface,area_m2,illuminance_mean_lx,illuminance_min_lx,illuminance_max_lx,luminance_mean_cd_m2,cie_x,cie_y,error_lx ]
  [ "$(head1 dimout surfaces room.lum --by source)" = source,surface,area_m2,illuminance_mean_lx,illuminance_min_lx,illuminance_max_lx,luminance_mean_cd_m2,cie_x,cie_y,error_lx ]
  [ "$(head1 dimout cells room.lum)" = surface,cell,x_m,y_m,z_m,area_m2,illuminance_lx,luminance_cd_m2 ]
  [ "$(head1 dimout cells room.lum --by source)" = source,surface,cell,x_m,y_m,z_m,area_m2,illuminance_lx,luminance_cd_m2 ]
  [ "$(head1 dimout grid room.lum)" = plane,point,x_m,y_m,z_m,nx,ny,nz,illuminance_lx,error_lx ]
  [ "$(head1 dimout grid room.lum --by source)" = source,plane,point,x_m,y_m,z_m,nx,ny,nz,illuminance_lx,error_lx ]
  [ "$(head1 dimout grid room.lum --stats)" = plane,points,min_lx,mean_lx,max_lx,u0,ud,left_out,error_lx ]
  [ "$(head1 dimout grid room.lum --stats --by source)" = source,plane,points,min_lx,mean_lx,max_lx,u0,ud,left_out,error_lx ]
  [ "$(head1 dimout colour room.lum)" = plane,point,x_m,y_m,z_m,illuminance_lx,cie_x,cie_y,cie_u_prime,cie_v_prime,cct_K,duv,ra,melanopic_edi_lx ]
  [ "$(head1 dimout colour room.lum --surfaces --by source)" = source,surface,illuminance_mean_lx,cie_x,cie_y,cie_u_prime,cie_v_prime,cct_K,duv,ra,melanopic_edi_lx ]
  [ "$(head1 dimdis areas room.zone.toml)" = surface,area_m2,cells ]
  [ "$(head1 dimdis viewfactors room.zone.toml --rays 1000)" = from,to,view_factor ]
}

@test "the tables hold every surface, cell and point in the user's coordinates" {
  [ "$(dimout surfaces room.lum | wc -l)" -eq 13 ]
  [ "$(dimout surfaces room.lum --by source | wc -l)" -eq 37 ]
  [ "$(dimout grid room.lum | wc -l)" -eq 27 ]
  [ "$(dimout grid room.lum --plane 'desk points' | wc -l)" -eq 3 ]
  cells=$(dimdis areas room.zone.toml 2>/dev/null | awk -F, 'NR > 1 { n += $3 } END { print n }')
  [ "$(dimout cells room.lum | wc -l)" -eq $((cells + 1)) ]
  [[ "$(dimout grid room.lum | sed -n 2p)" == workplane,0,0.75,0.75,0.75,0,0,1,* ]]
  [[ "$(dimout grid room.lum --plane 'desk points' | sed -n 2p)" == "desk points,0,1.6,1.1,0.75,0,0,1,"* ]]
  [[ "$(dimout surfaces room.lum | sed -n 2p)" == floor,12,* ]]
}

@test "cells by source add up to the cells" {
  dimout cells room.lum | cut -d, -f7 | sed 1d > all
  for source in 'P\[0,0\]' 'P\[1,0\]' spot; do
    dimout cells room.lum --by source | tr -d '"' | sed -n "s/^$source,//p" | cut -d, -f7 > "$source"
  done
  paste all P* spot | awk '{ d = $2 + $3 + $4 - $1; if (d > 1e-5 * $1 || -d > 1e-5 * $1) bad = 1 } END { exit bad || NR < 100 }'
}

@test "--plane takes several, in the order asked" {
  [ "$(dimout grid room.lum --stats --plane 'desk points' --plane workplane | cut -d, -f1 | paste -s)" = $'plane\tdesk points\tworkplane' ]
  cmp <(dimout colour room.lum --plane workplane --plane 'desk points') <(dimout colour room.lum)
}

@test "--direct leaves reflections out" {
  # 50 cd in all directions, 1.25 m above the point and sqrt(1.1^2 + 0.6^2) m aside.
  dimout grid room.lum --direct --plane 'desk points' --mix panels=0 | awk -F, 'NR == 2 {
    wanted = 50 * 1.25 / (1.1 ^ 2 + 0.6 ^ 2 + 1.25 ^ 2) ^ 1.5; print $9, wanted; d = $9 / wanted - 1; exit !(d < 1e-6 && d > -1e-6) }'
  paste -d, <(dimout grid room.lum --direct) <(dimout grid room.lum) | awk -F, 'NR > 1 && !($9 > 0 && $9 < $19) { exit 1 }'
}

@test "areas end with the volume on stderr" {
  run --separate-stderr dimdis areas room.zone.toml
  [ "$status" -eq 0 ]
  [[ "${stderr_lines[-1]}" == *"volume 30 m3"* ]]
}

@test "numbers carry at least six significant digits and a decimal point" {
  export LC_ALL=de_DE.UTF-8 LC_NUMERIC=de_DE.UTF-8
  run dimout grid room.lum --plane workplane
  [[ "${lines[1]##*,}" =~ ^[0-9]+\.[0-9]+$ ]]
  digits=${lines[1]##*,}
  digits=${digits//./}
  [ ${#digits} -ge 6 ]
}

@test "JSON holds the same columns and figures as CSV" {
  for table in "surfaces room.lum" "surfaces room.lum --by source" "cells room.lum" "grid room.lum" "grid room.lum --stats" "colour room.lum" "colour room.lum --surfaces"; do
    dimout $table > t.csv
    dimout $table --json > t.json
    diff <(sed -n 1p t.csv) <(jq -r '.[0] | keys_unsorted | join(",")' t.json)
    # CSV has nine digits.
    paste -d, <(sed 1d t.csv | tr -d '"') <(jq -r '.[] | [.[]] | map(tostring) | join(",")' t.json) | awk -F, '
      { for (i = 1; i <= NF / 2; ++i) {
          a = $i; b = $(i + NF / 2)
          if (a != b && !(a ~ /^[-+0-9.e]+$/ && (a - b)^2 <= 1e-16 * b^2)) { print "CSV " a ", JSON " b; bad = 1 } } }
      END { exit bad || NR == 0 }'
  done
  dimout info room.lum --json | jq -e '.zone == "room" and .sources[2].name == "spot" and (.sources | length) == 3' > /dev/null
}

# Mean illuminance on the work plane.
mean() { dimout grid "$@" --plane workplane --stats | awk -F, 'NR == 2 { print $4 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= 2e-6 * b) }'; }

@test "sources add up, and --mix scales a source, a group, a luminaire" {
  all=$(mean room.lum)
  by=$(dimout grid room.lum --plane workplane --stats --by source | awk -F, 'NR > 1 { s += $(NF - 5) } END { printf "%.9g", s }')
  near "$by" "$all"
  spot=$(mean room.lum --mix panels=0)
  panels=$(mean room.lum --mix spot=0)
  near "$(echo "$spot $panels" | awk '{ printf "%.9g", $1 + $2 }')" "$all"
  one=$(mean room.lum --mix spot=0 --mix 'P[0,0]=0')
  two=$(mean room.lum --mix spot=0 --mix 'P[1,0]=0')
  near "$(echo "$one $two" | awk '{ printf "%.9g", $1 + $2 }')" "$panels"
  near "$(mean room.lum --mix spot=0 --mix panels=0.5)" "$(awk -v p="$panels" 'BEGIN { printf "%.9g", p / 2 }')"
  [ "$(mean room.lum --mix spot=0 --mix panels=0)" = 0 ]
}

@test "--mix refuses what is no mix, and names the nearest source" {
  refused 3 "room.lum: no source or group 'panel'.*did you mean 'panels'" dimout grid room.lum --mix panel=1
  refused 3 "there is 'P\[0,0\]'" dimout grid room.lum --mix somethingelse=1
  for wrong in panels panels= =1 panels=-1 panels=x panels=nan panels=inf; do
    refused 2 "NAME=FACTOR" dimout grid room.lum --mix "$wrong"
  done
}

@test "--combine each, group and all give the same sums" {
  dimray room.rays room.lights.toml -q -o each.lum --combine each
  dimray room.rays room.lights.toml -q -o group.lum --combine group
  dimray room.rays room.lights.toml -q -o all.lum --combine all
  [ "$(dimout info each.lum --json | jq '.sources | length')" -eq 3 ]
  [ "$(dimout info group.lum --json | jq -c '[.sources[].name]')" = '["panels","spot"]' ]
  [ "$(dimout info all.lum --json | jq '.sources | length')" -eq 1 ]
  # Each column stops at its own tolerance of 1e-4.
  for other in group all; do
    paste -d, <(dimout grid each.lum) <(dimout grid $other.lum) |
      awk -F, 'NR > 1 { d = $9 / $19 - 1; if (d < -3e-4 || d > 3e-4) { print; bad = 1 } } END { exit bad }'
  done
  cmp each.lum room.lum
}

@test "--bands takes a number, edges, or finds the fewest" {
  dimray room.rays room.lights.toml -q -o b.lum --bands 380,480,580,780
  [ "$(dimout info b.lum --json | jq -c .bands_nm)" = "[380,480,580,780]" ]
  # The room is grey: one band, and the very same file.
  run --separate-stderr dimray room.rays room.lights.toml -o auto.lum --bands auto
  [ "$status" -eq 0 ]
  [ "$(dimout info auto.lum --json | jq '.bands_nm | length')" -eq 2 ]
  dimray room.rays room.lights.toml -q -o one.lum --bands 1
  cmp auto.lum one.lum
  dimdis room.zone.toml -q --patches 64 --set 'finishes.dark={diffuse=[[380,0.05],[580,0.06],[620,0.6],[780,0.7]]}' -o red.rays
  dimray red.rays room.lights.toml -q -o red.lum --bands auto --stats s.json || [ $? -eq 1 ]
  dimray red.rays room.lights.toml -q -o coarse.lum --bands auto:2 || [ $? -eq 1 ]
  [ "$(dimout info coarse.lum --json | jq '.bands_nm | length')" -lt "$(dimout info red.lum --json | jq '.bands_nm | length')" ]
  jq -e '.bands > 2 and .bands < 40 and .band_edges_nm[0] == 380 and .band_edges_nm[-1] == 780' s.json > /dev/null
}

@test "a spectrum by name colours the light; an unknown one is refused" {
  dimray room.rays room.lights.toml -q -o a.lum --set luminaire.P.spectrum=cie-a --set luminaire.spot.spectrum=cie-a
  # Grey surfaces show the light's own chromaticity: CIE 15, x 0.4476, y 0.4074.
  dimout surfaces a.lum | awk -F, 'NR > 1 && (($7 - 0.44758) ^ 2 + ($8 - 0.40745) ^ 2 > 1e-9) { print; bad = 1 } END { exit bad || NR < 2 }'
  refused 3 "no spectrum is called 'led-b9'.*did you mean 'led-b1'" dimray room.rays room.lights.toml -o x.lum --set luminaire.spot.spectrum=led-b9
  refused 3 "led-9000': 9000 K is outside 2733 to 6597 K" dimray room.rays room.lights.toml -o x.lum --set luminaire.spot.spectrum=led-9000
}

@test "--set overrides the zone and the lights" {
  dimdis room.zone.toml -q --patches 64 --set finishes.dark.diffuse=0.5 --set cell=0.6 --set 'plane.workplane.spacing=1' -o other.rays
  dimray other.rays room.lights.toml -q -o other.lum --set luminaire.spot.intensity=500 || [ $? -eq 1 ]
  dimout info other.lum --json | jq -e '.points == 8 and .sources[2].flux_lm > 6283 and .sources[2].flux_lm < 6284' > /dev/null
  [ "$(dimdis areas room.zone.toml -q --set surface.floor.cell=1 | sed -n 2p)" = floor,12,12 ]
}

@test "--set says what it does not find" {
  refused 2 "'cell' is not KEY=VALUE" dimdis room.zone.toml -o x.rays --set cell
  refused 3 "\-\-set foo=1: unknown key 'foo'" dimdis room.zone.toml -o x.rays --set foo=1
  refused 3 "did you mean 'floor'" dimdis room.zone.toml -o x.rays --set surface.flor.finish=light
  refused 3 "did you mean 'light'" dimdis room.zone.toml -o x.rays --set finishes.ligth=0.5
  refused 3 "cell must be" dimdis room.zone.toml -o x.rays --set cell=-1
  refused 3 "did you mean 'spot'" dimray room.rays room.lights.toml -o x.lum --set luminaire.spt.intensity=1
}

@test "--finish replaces a finish by an entry or a grey" {
  dimray room.rays room.lights.toml -q -o dark.lum --finish light=0.1
  dimray room.rays room.lights.toml -q -o light.lum --finish dark=paint-white-matt
  [ "$(mean dark.lum | cut -d. -f1)" -lt "$(mean room.lum | cut -d. -f1)" ]
  [ "$(mean light.lum | cut -d. -f1)" -gt "$(mean room.lum | cut -d. -f1)" ]
  refused 2 "NAME=ENTRY" dimray room.rays room.lights.toml -o x.lum --finish dark
  refused 2 "0\.\.1" dimray room.rays room.lights.toml -o x.lum --finish dark=1.5
  refused 3 "no finish 'drak'.*did you mean 'dark'" dimray room.rays room.lights.toml -o x.lum --finish drak=0.5
  refused 3 "room.rays: finish 'dark'.*less than 1" dimray room.rays room.lights.toml -o x.lum --finish dark=1
  refused 3 "did you mean 'paint-white-matt'" dimray room.rays room.lights.toml -o x.lum --finish dark=paint-white-mat
}

@test "--cell, --patches and --sampling do what they say" {
  [ "$(dimdis areas room.zone.toml -q --cell 1 | sed -n 2p)" = floor,12,12 ]
  dimdis room.zone.toml -q --patches 4x10 --point-patches 60 --sampling centre --seed 7 --stats s.json -o a.rays
  jq -e '.patches == 40 and .point_patches == 60 and .points == 26' s.json > /dev/null
  for wrong in 0 -1 x 4x 4x0 1e9 1.5 99999999999999999999; do
    refused 2 "16x32" dimdis room.zone.toml -o x.rays "--patches=$wrong"
  done
  for wrong in 0 -1 nan inf x ''; do
    refused 2 "cell" dimdis room.zone.toml -o x.rays "--cell=$wrong"
  done
}

@test "the number of threads changes no byte" {
  for n in 1 2 5; do
    dimdis room.zone.toml -q --threads $n --patches 8x16 --point-patches 16x32 -o $n.rays
    dimray $n.rays room.lights.toml -q --threads $n -o $n.lum
    cmp room.rays $n.rays
    cmp room.lum $n.lum
  done
}

@test "--quiet is silent, --verbose talks, data stays off stderr" {
  run --separate-stderr dimdis room.zone.toml --quiet --patches 8x16 -o q.rays
  [ "$status" -eq 0 ] && [ -z "$output$stderr" ]
  run --separate-stderr dimray room.rays room.lights.toml -q -o q.lum
  [ "$status" -eq 0 ] && [ -z "$output$stderr" ]
  run --separate-stderr dimdis room.zone.toml --verbose --patches 8x16 -o q.rays
  [ -z "$output" ] && [[ "$stderr" == *rays* ]]
  for command in "dimout grid room.lum" "dimout --quiet --threads 1 grid room.lum" "dimout grid room.lum --quiet"; do
    run --separate-stderr $command
    [ "$status" -eq 0 ] && [ -z "$stderr" ] && [ -n "$output" ]
  done
  run --separate-stderr dimout grid room.lum
  [ -z "$stderr" ] && [ -n "$output" ]
}

@test "--stats writes counts, seconds, memory, energy and hashes as JSON" {
  dimdis room.zone.toml -q --patches 8x16 --stats d.json -o s.rays
  jq -e '.program == "dimdis" and (.version | length) > 0 and .surfaces == 12 and .points == 26 and .patches == 128
    and .rays == .cells * .patches + .points * .point_patches and .seconds.total > 0 and .peak_memory_bytes > 1e6
    and (.output_hash | test("^[0-9a-f]{32}$"))' d.json > /dev/null
  dimray s.rays room.lights.toml -q --stats r.json -o s.lum
  jq -e --slurpfile d d.json '.input_hash == $d[0].output_hash and .energy.emitted_W > 0
    and (.energy.imbalance | fabs) < 2e-3 and (.sources | length) == 3 and .seconds.total > 0
    and .peak_memory_bytes > 1e6 and (.output_hash | test("^[0-9a-f]{32}$"))' r.json > /dev/null
  [ "$(dimout info s.lum --json | jq -r .hash)" = "$(jq -r .output_hash r.json)" ]
  dimout grid s.lum --stats --run-stats o.json > /dev/null
  jq -e '.program == "dimout" and .seconds.total > 0 and .peak_memory_bytes > 1e6' o.json > /dev/null
  dimout surfaces s.lum --stats o.json > /dev/null
  jq -e '.program == "dimout"' o.json > /dev/null
}

@test "a wrong command line ends with status 2, one problem and where to look" {
  refused 2 "no zone file" dimdis
  refused 2 "no output" dimdis room.zone.toml
  refused 2 "did you mean '--patches'" dimdis room.zone.toml -o x.rays --patchs=3
  refused 2 "did you mean 'areas'" dimdis arease room.zone.toml
  refused 2 "ZONE is required" dimdis areas
  refused 2 "LIGHTS.toml is required" dimray room.rays
  refused 2 "output is required" dimray room.rays room.lights.toml
  refused 2 "each,group,all" dimray room.rays room.lights.toml -o x.lum --combine some
  refused 2 "tolerance" dimray room.rays room.lights.toml -o x.lum --tolerance nan
  refused 2 "tolerance" dimray room.rays room.lights.toml -o x.lum --tolerance 0
  refused 2 "bands" dimray room.rays room.lights.toml -o x.lum --bands 0
  for bands in -1 401 2.5 many 380,780,500 400,780 380,380,780 380,x,780 , auto: auto:0 auto:x automatic; do
    refused 2 "auto, auto:DE00 within 0.01..10, a number of bands within 1..400, or ascending edges from 380 to 780" dimray room.rays room.lights.toml -o x.lum --bands=$bands
  done
  refused 2 "threads" dimray room.rays room.lights.toml -o x.lum --threads -1
  refused 2 "db" dimray room.rays room.lights.toml -o x.lum --db nowhere
  refused 2 "subcommand" dimout
  refused 2 "ROOM.lum is required" dimout grid
  refused 2 "source" dimout grid room.lum --by luminaire
  refused 2 "\.png, \.hdr or \.exr" dimout image room.lum -o x.gif
  refused 2 "WIDTHxHEIGHT" dimout image room.lum -o x.png --size 99999999x3
  refused 2 "LOW:HIGH" dimout image room.lum -o x.png --tone falsecolour --range 1:nan
  refused 2 "only one" dimray - - -o x.lum
}

@test "a name that the input does not have ends with status 3, the file and the nearest name" {
  refused 3 "room.lum: no measuring plane or sensors 'workplan'.*did you mean 'workplane'" dimout grid room.lum --plane workplan
  refused 3 "there is 'workplane', 'desk points'" dimout grid room.lum --plane zzz
  refused 3 "room.lum: no view 'dor'.*did you mean 'door'" dimout image room.lum --view dor -o x.png
  refused 3 "room.zone.toml: no view 'dor'.*did you mean 'door'" dimdis draw room.zone.toml --view dor
}

@test "an open energy balance or a missed tolerance writes the result and ends with status 1" {
  # One cell a wall and a lamp close to one: the direct light of a cell's points misses much of it.
  dimdis room.zone.toml -q --cell 5 --patches 4x4 -o coarse.rays
  run --separate-stderr dimray coarse.rays room.lights.toml -o coarse.lum
  echo "$stderr"
  [ "$status" -eq 1 ]
  [[ "$stderr" == *"the energy balance of source "*" is open by "* ]]
  dimout info coarse.lum > /dev/null
}

@test "a wide bound of the error ends with status 1 and its cure" {
  sed 's/{ diffuse = 0.2 }/0.99/; s/"paint-white-matt"/0.99/; s/"wood-beech"/0.99/' room.zone.toml > bright.zone.toml
  dimdis bright.zone.toml -q -o bright.rays
  run --separate-stderr dimray bright.rays room.lights.toml -o bright.lum
  echo "$stderr"
  [ "$status" -eq 1 ]
  [[ "$stderr" == *"that is more than 1 %: surfaces reflect nearly all light; use a smaller --tolerance"* ]]
  dimray bright.rays room.lights.toml -q --tolerance 1e-5 -o bright.lum
}

@test "check says what is in a zone and where it is not closed" {
  run --separate-stderr dimdis check room.zone.toml
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"zone 'room' is good"*"30 m3"* ]]
  # Without its south wall the room is open: a warning, not an error.
  sed -z 's/\[\[surface\]\]\nname = "wall-s"\n[^\n]*\n[^\n]*\n//' room.zone.toml > open.zone.toml
  run --separate-stderr dimdis check open.zone.toml
  echo "$stderr"
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"warning"*"not closed"* ]]
}

@test "draw and image write what their names say" {
  dimdis draw room.zone.toml --view door -o d.svg
  [[ "$(head -c 300 d.svg)" == *"<svg"* ]]
  for ending in png hdr exr; do
    dimout image room.lum -q --samples 1 -o p.$ending
  done
  [ "$(head -c 4 p.png | od -An -tx1)" = " 89 50 4e 47" ]
  [ "$(head -c 2 p.hdr)" = "#?" ]
  [ "$(head -c 4 p.exr | od -An -tx1)" = " 76 2f 31 01" ]
}

@test "luminaires with bodies go through all programs, and take light where they are black" {
  floor() { dimout surfaces "$1" | awk -F, '$1 == "floor" { print $3 }'; }
  sed 's/^fitting = .*/&\nbody = true/' room.lights.toml > black.lights.toml
  sed 's/^body = .*/body = { reflectance = 0.9 }/' black.lights.toml > white.lights.toml
  sed '/^body = /d' black.lights.toml > none.lights.toml
  for body in black white none; do
    dimray room.rays $body.lights.toml -o $body.lum
    dimout grid $body.lum > $body.csv
  done
  [ "$(wc -l < black.csv)" = "$(wc -l < none.csv)" ]
  awk -v b="$(floor black.lum)" -v w="$(floor white.lum)" -v n="$(floor none.lum)" 'BEGIN { exit !(b < 0.999 * w && b < 0.999 * n) }'
}
