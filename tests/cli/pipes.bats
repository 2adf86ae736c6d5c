#!/usr/bin/env bats
# Standard input and output in place of files, in every combination.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

fast="--patches 8x16 --point-patches 16x32 --quiet"

@test "dimdis: file or pipe in, file or pipe out, the same bytes" {
  dimdis room.zone.toml $fast -o - > b.rays
  dimdis - $fast -o c.rays < room.zone.toml
  cat room.zone.toml | dimdis - $fast -o - | cat > d.rays
  for f in b c d; do cmp room.rays $f.rays; done
}

@test "dimray: file or pipe in, file or pipe out, the same bytes" {
  dimray room.rays room.lights.toml -q -o - > b.lum
  cat room.rays | dimray - room.lights.toml -q -o c.lum
  cat room.rays | dimray - room.lights.toml -q -o - | cat > d.lum
  dimray room.rays - -q -o e.lum < room.lights.toml
  for f in b c d e; do cmp room.lum $f.lum; done
}

@test "dimout: file or pipe in, file or pipe out, the same bytes" {
  dimout grid room.lum > a.csv
  dimout grid room.lum -o b.csv
  cat room.lum | dimout grid - > c.csv
  dimout grid - -o d.csv < room.lum
  for f in b c d; do cmp a.csv $f.csv; done
  cat room.lum | dimout image - -q --samples 1 -o p.png
  dimout image room.lum -q --samples 1 -o q.png
  cmp p.png q.png
}

@test "the whole pipeline equals the three steps" {
  dimdis room.zone.toml $fast -o - | dimray - room.lights.toml -q -o - | dimout grid - > pipe.csv
  dimout grid room.lum | cmp - pipe.csv
}

@test "paths may hold spaces, letters beyond ASCII and a leading dash" {
  mkdir -p "bureau près de l'été"
  mv room.zone.toml room.lights.toml "bureau près de l'été"
  cd "bureau près de l'été"
  dimdis room.zone.toml $fast -o "réseau un.rays"
  dimray "réseau un.rays" room.lights.toml -q -o "é ü.lum"
  cmp ../room.lum "é ü.lum"
  dimout grid "é ü.lum" -o "grille 1.csv"
  [ -s "grille 1.csv" ]
  cd ..
  dimdis "bureau près de l'été/room.zone.toml" $fast -o ./-dash.rays
  cmp room.rays ./-dash.rays
}

@test "a fitting by path is looked for beside the lights file, in any folder" {
  mkdir -p "a b/dé"
  cp "$DIM_SOURCE/db/fittings/troffer-3600.ies" "a b/dé/trôffer 1.ies"
  # The entry names a spectrum, which the file cannot.
  sed 's|"troffer-3600"|"dé/trôffer 1.ies"\nspectrum = "led-4000"|' room.lights.toml > "a b/l.toml"
  dimray room.rays "a b/l.toml" -q -o p.lum
  diff <(dimout grid room.lum) <(dimout grid p.lum)
}

@test "binary is not written to a terminal" {
  command -v script > /dev/null || skip "no script(1) to make a terminal"
  run script -qec "dimdis room.zone.toml $fast -o -" /dev/null
  [ "$status" -eq 2 ]
  [[ "$output" == *"will not write a ray network to a terminal"* ]]
  run script -qec "dimray room.rays room.lights.toml -o -" /dev/null
  [ "$status" -eq 2 ]
  [[ "$output" == *"will not write a luminance database to a terminal"* ]]
  run script -qec "dimout grid room.lum --stats" /dev/null
  [ "$status" -eq 0 ]
  [[ "$output" == *"plane,points"* ]]
}

@test "a reader that goes away ends the program with one line at most" {
  bash -c "dimdis room.zone.toml $fast --cell 0.1 -o - 2> err | head -c 1 > /dev/null"
  [ "$(wc -l < err)" -le 1 ]
  bash -c 'dimout cells room.lum 2> err | head -1 > one'
  [ "$(wc -l < err)" -le 1 ]
  [ "$(wc -l < one)" -eq 1 ]
  run bash -c "set -o pipefail; dimdis room.zone.toml $fast --cell 0.1 -o - | true"
  [ "$status" -eq 4 ]
  [[ "$output" == "dimdis: error: standard output: cannot write: Broken pipe" ]]
}

@test "a pipe that ends early, or holds something else, is refused" {
  refused 4 "standard input: is cut short" bash -c 'head -c 5000 room.rays | dimray - room.lights.toml -o x.lum'
  refused 4 "standard input: is empty" bash -c 'true | dimray - room.lights.toml -o x.lum'
  refused 4 "standard input: is a text file" bash -c 'cat room.zone.toml | dimray - room.lights.toml -o x.lum'
  refused 4 "standard input: is altered" bash -c '(cat room.lum; echo more) | dimout grid -'
  refused 3 "<stdin>:1:1" bash -c 'true | dimdis - -o x.rays'
  refused 4 "standard input: cannot read" bash -c 'dimdis - -o x.rays <&-'
}

@test "a failed first step makes the whole pipeline fail" {
  run bash -c "set -o pipefail; dimdis nothing.toml -o - | dimray - room.lights.toml -o - | dimout grid - > x.csv"
  [ "$status" -eq 4 ]
  [[ "$output" == *"nothing.toml: cannot read"* ]]
  [ ! -s x.csv ]
}
