#!/usr/bin/env bats
# Colour of the light: published figures of the lamps in a grey room, and what a red wall does to them.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

# All lamps of the room with one spectrum: `lit SPECTRUM OPTION...` makes lit.lum.
lit() {
  local spectrum=$1
  shift
  dimray room.rays room.lights.toml -q -o lit.lum --set "luminaire.P.spectrum=$spectrum" --set "luminaire.spot.spectrum=$spectrum" "$@"
}

# Column NAME of every row of a table on standard input lies within LOW..HIGH.
within() {
  awk -F, -v name="$1" -v low="$2" -v high="$3" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
    NR > 1 && !($column >= low && $column <= high && $column != "") { print name " " $column ": " $0; bad = 1 }
    END { exit bad || !column || NR < 2 }'
}

@test "a grey room shows each lamp's published colour, temperature and Ra" {
  # CIE 15: chromaticities, temperatures and Ra of illuminants.
  while read -r spectrum x y cct ra; do
    lit "$spectrum"
    for table in "colour lit.lum" "colour lit.lum --surfaces" "colour lit.lum --by source --plane workplane"; do
      dimout $table | sed 's/"[^"]*"/quoted/' > t.csv
      within cie_x "$(echo "$x - 0.0002" | bc)" "$(echo "$x + 0.0002" | bc)" < t.csv
      within cie_y "$(echo "$y - 0.0002" | bc)" "$(echo "$y + 0.0002" | bc)" < t.csv
      within cct_K $((cct - 3)) $((cct + 3)) < t.csv
      within ra "$(echo "$ra - 0.6" | bc)" "$(echo "$ra + 0.6" | bc)" < t.csv
    done
  done << LAMPS
cie-a 0.4476 0.4074 2856 100
d65 0.3127 0.3290 6504 100
fl-2 0.3721 0.3751 4225 64
fl-7 0.3129 0.3292 6497 90
fl-11 0.3805 0.3769 3999 83
LAMPS
}

@test "melanopic EDI of daylight is its illuminance, of incandescent light about half" {
  lit d65
  dimout colour lit.lum | awk -F, 'NR > 1 && ($NF / $6 - 1) ^ 2 > 1e-10 { print; bad = 1 } END { exit bad || NR < 2 }'
  # CIE S 026: melanopic daylight efficacy ratio of A 0.496.
  lit cie-a
  dimout colour lit.lum | awk -F, 'NR > 1 && ($NF / $6 - 0.496) ^ 2 > 1e-6 { print; bad = 1 } END { exit bad || NR < 2 }'
}

@test "the illuminance is that of the grid, and mixes add" {
  lit led-4000 --bands 7
  paste -d, <(dimout grid lit.lum) <(dimout colour lit.lum) | awk -F, 'NR > 1 && ($9 / $16 - 1) ^ 2 > 1e-12 { print; bad = 1 } END { exit bad || NR < 2 }'
  dimray room.rays room.lights.toml -q -o two.lum --set luminaire.P.spectrum=cie-a --set luminaire.spot.spectrum=d65
  dimout colour two.lum --mix spot=0 | within cct_K 2853 2859
  dimout colour two.lum --mix panels=0 | within cct_K 6500 6506
  dimout colour two.lum | within cct_K 2860 6500
}

@test "red walls warm the light; bands follow" {
  dimdis room.zone.toml -q --patches 64 --set 'finishes.light={diffuse=[[380,0.1],[560,0.1],[620,0.7],[780,0.8]]}' -o red.rays
  dimray red.rays room.lights.toml -q -o lit.lum --bands auto --set luminaire.P.spectrum=led-4000 --set luminaire.spot.spectrum=led-4000 || [ $? -eq 1 ]
  dimout colour lit.lum --plane workplane | within cct_K 2500 3950
  # Far from white there is no temperature and no Ra: empty, not a number out of nothing.
  dimray red.rays room.lights.toml -q -o red.lum --set luminaire.P.spectrum='[[600,0],[640,1],[680,0]]' --set luminaire.spot.spectrum='[[600,0],[640,1],[680,0]]' || [ $? -eq 1 ]
  [[ "$(dimout colour red.lum | sed -n 2p)" =~ ,,[-0-9.]+,,[0-9.e-]+$ ]]
  dimout colour red.lum --json | jq -e '.[0].cct_K == null and .[0].ra == null' > /dev/null
}

@test "darkness has no colour" {
  dimout colour room.lum --mix panels=0 --mix spot=0 | awk -F, 'NR > 1 && ($6 != 0 || $7 != "" || $11 != "" || $13 != "" || $14 != 0) { print; bad = 1 } END { exit bad || NR < 2 }'
}

@test "as many wavebands as colours need; too few are said with their estimate" {
  dimdis room.zone.toml -q --patches 64 --set 'finishes.light={diffuse=[[380,0.1],[560,0.1],[620,0.7],[780,0.8]]}' -o red.rays
  run --separate-stderr dimray red.rays room.lights.toml -o x.lum
  [[ "$stderr" =~ "dimray: "[0-9]+" wavebands: colours within dE00 0."[0-9]+", luminances within 0."[0-9]+" %" ]]
  [[ ! "$stderr" =~ "dE00 "[1-9] ]]
  for bands in 1 2 380,500,780; do
    run --separate-stderr dimray red.rays room.lights.toml -o x.lum --bands $bands --explain
    [[ "$stderr" =~ "warning: "[0-9]+" waveband"s?": colours within dE00 "[0-9.]+", luminances within "[0-9.]+" %" ]]
    [[ "$stderr" =~ "--bands auto" ]]
    [[ "$stderr" =~ "explain: "[0-9]+" waveband"s?": colours within dE00 " ]]
  done
  # Grey: one band, and nothing to say about it.
  dimdis room.zone.toml -q --patches 64 --set finishes.light=0.7 --set finishes.wood=0.3 -o grey.rays
  run --separate-stderr dimray grey.rays room.lights.toml -o x.lum
  [[ ! "$stderr" =~ waveband ]]
  dimout info x.lum --json | jq -e '.bands_nm == [380, 780]' > /dev/null
  rm x.lum
}

@test "temperature, Ra and melanopic EDI only of spectra that somebody stated" {
  cp "$DIM_SOURCE/examples/05-photometry/panel-4200.ldt" .
  printf 'dim = "lights/1"\n[[luminaire]]\nname = "A"\nfitting = "panel-4200.ldt"\nat = [2,1.5,2.4]\n' > ldt.toml
  printf '[[luminaire]]\nname = "B"\nideal = "isotropic"\nintensity = 50\nat = [1,1,1]\nspectrum = "led-4000"\n' >> ldt.toml
  dimray room.rays ldt.toml -q -o ldt.lum
  for mix in "" "--mix B=0"; do
    run --separate-stderr dimout colour ldt.lum $mix
    [ "$status" -eq 0 ]
    [[ "$stderr" =~ "warning: source 'A': no spectrum is stated" ]]
    awk -F, 'NR > 1 && ($11 != "" || $12 != "" || $13 != "" || $14 != "" || $6 == "") { bad = 1 } END { exit bad || NR < 2 }' <<< "$output"
  done
  run --separate-stderr dimout colour ldt.lum --mix A=0
  [ -z "$stderr" ]
  within cct_K 3900 4100 <<< "$output"
  run --separate-stderr dimout colour ldt.lum --by source --plane workplane
  awk -F, '$1 == "A" && $12 != "" || $1 == "B" && $12 == "" { bad = 1 } END { exit bad || NR < 2 }' <<< "$output"
  dimout colour ldt.lum --spectrum A=led-3000 --mix B=0 2> err | within cct_K 2900 3100
  [ ! -s err ]
}

@test "of few bands in a coloured room they are left empty" {
  dimdis room.zone.toml -q --patches 64 --set 'finishes.light={diffuse=[[380,0.1],[560,0.1],[620,0.7],[780,0.8]]}' -o red.rays
  dimray red.rays room.lights.toml -q -o few.lum --bands 1 --set luminaire.P.spectrum=led-2800 || [ $? -eq 1 ]
  run --separate-stderr dimout colour few.lum --json
  [[ "$stderr" =~ "1 waveband: colours within dE00 "[0-9.]+", luminances within "[0-9.]+" %: too few for colour temperature" ]]
  jq -e 'all(.cct_K == null and .ra == null and .melanopic_edi_lx == null and .illuminance_lx > 0)' <<< "$output" > /dev/null
  refused 3 "few.lum: source 'spot' cannot be given another spectrum: .* one waveband" dimout grid few.lum --spectrum spot=d65
  rm few.lum
}

@test "another spectrum needs no new solution" {
  lit cie-a --bands 9
  cp lit.lum before.lum
  lit fl-2 --bands 9
  for table in "grid" "surfaces" "colour --surfaces"; do
    dimout $table lit.lum > a
    dimout $table before.lum --spectrum panels=fl-2 --spectrum spot=fl-2 > b
    paste -d, a b | awk -F, '{ n = NF / 2; for (i = 1; i <= n; ++i) if ($i != $(i + n) && ($i / $(i + n) - 1) ^ 2 > 1e-12) { print; bad = 1 } } END { exit bad }'
  done
  printf '# lamp\nnm,power\n400,0\n500,20\n600,150\n700,40\n' > lamp.csv
  dimout grid before.lum --spectrum spot=lamp.csv | cmp - <(dimout grid before.lum --spectrum 'spot=[[400,0],[500,2],[600,15],[700,4]]')
  refused 3 "no source or group 'P' for --spectrum" dimout grid lit.lum --spectrum P=d65
  refused 3 "did you mean 'd5" dimout grid lit.lum --spectrum spot=d56
  refused 2 "NAME=SPECTRUM" dimout grid lit.lum --spectrum spot
  refused 4 "nothing.csv: cannot read" dimout grid lit.lum --spectrum spot=nothing.csv
}

@test "wrong options are refused" {
  refused 2 "surfaces|plane" dimout colour room.lum --surfaces --plane workplane
  refused 3 "did you mean 'workplane'" dimout colour room.lum --plane workplan
  refused 3 "no source or group" dimout colour room.lum --mix nobody=1
  refused 4 "ray network" dimout colour room.rays
}
