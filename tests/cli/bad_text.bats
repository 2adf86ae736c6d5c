#!/usr/bin/env bats
# Text inputs that are missing, damaged, of another kind or absurd: zone, lights, photometry, database entries.

setup_file() {
  load common
  make_room
  cd "$ROOM"
  printf '\211PNG\r\n\032\n' > picture.png
  head -c 3000 /dev/urandom >> picture.png
  # Beside the lights: a database of its own, to be damaged.
  mkdir -p "$BATS_FILE_TMPDIR/db/fittings" "$BATS_FILE_TMPDIR/db/surfaces"
  cp "$DIM_SOURCE"/db/fittings/troffer-3600.* "$BATS_FILE_TMPDIR/db/fittings"
  cp "$DIM_SOURCE"/db/surfaces/*.toml "$BATS_FILE_TMPDIR/db/surfaces"
}

setup() {
  load common
  enter_copy
  cp -r "$BATS_FILE_TMPDIR/db" .
}

zone() { refused "$1" "$2" dimdis "$3" -o x.rays; }
lights() { refused "$1" "$2" dimray room.rays "$3" -o x.lum; }

@test "zone and lights: missing, a folder, empty, another kind, a newer version, a picture" {
  mkdir folder
  : > empty
  echo 'just text' > text
  for kind in zone lights; do
    $kind 4 "nothing.toml: cannot read: No such file" nothing.toml
    $kind 4 "folder: is a directory" folder
    $kind 3 "empty:1:1: not a DIM file.*dim = \"$kind/1\"" empty
    $kind 3 "picture.png:1:1: .*UTF-8" picture.png
    $kind 3 "text:1:" text
    $kind 3 "room.rays: is a ray network, not a $kind" room.rays
    sed "s|^dim .*|dim = \"$kind/2\"|" room.$kind.toml > newer.toml
    $kind 3 "newer.toml:[0-9]+:[0-9]+: '$kind/2' is newer" newer.toml
    sed "s|^dim .*|dim = \"$kind/x\"|" room.$kind.toml > odd.toml
    $kind 3 "odd.toml:[0-9]+:[0-9]+: " odd.toml
  done
  zone 3 "room.lights.toml:1:7: 'lights/1' is not a zone file" room.lights.toml
  lights 3 "'zone/1' is not a lights file" room.zone.toml
}

@test "zone and lights: not readable" {
  [ "$(id -u)" -ne 0 ] || skip "root may read everything"
  chmod 0 room.zone.toml room.lights.toml
  zone 4 "Permission denied" room.zone.toml
  lights 4 "Permission denied" room.lights.toml
}

@test "zone and lights: bytes that are not UTF-8, zero bytes, a byte-order mark" {
  for kind in zone lights; do
    sed 's/^# .*//; s/"spot"\|"floor"/"\xe9t\xe9"/' room.$kind.toml > latin.toml
    $kind 3 "latin.toml:[0-9]+:[0-9]+: .*UTF-8" latin.toml
    sed '3s/$/\x00/' room.$kind.toml > zero.toml
    $kind 3 "zero.toml:[0-9]+:[0-9]+: " zero.toml
  done
  printf '\xef\xbb\xbf' | cat - room.zone.toml > bom.toml
  dimdis check bom.toml -q
}

# Cut at any byte a file is either refused with a place or, cut between entries, still a file.
cut_everywhere() {
  local kind=$1 file=$2 size at
  size=$(stat -c %s "$file")
  for at in 1 7 $(seq 20 $((size / 15)) "$size"); do
    head -c "$at" "$file" > cut.toml
    if [ "$kind" = zone ]; then
      run --separate-stderr timeout -k 1 20 dimdis check cut.toml
    else
      run --separate-stderr timeout -k 1 20 dimray room.rays cut.toml -o x.lum
    fi
    echo "cut at $at: $status $stderr"
    rm -f x.lum
    [ "$status" -eq 0 ] || [ "$status" -eq 1 ] || { [ "$status" -eq 3 ] && [[ "$stderr" == *"cut.toml:"[0-9]* ]]; }
    no_trace
  done
}

@test "zone and lights: cut anywhere" {
  cut_everywhere zone room.zone.toml
  cut_everywhere lights room.lights.toml
}

@test "zone and lights: any byte changed ends without a crash" {
  for file in room.zone.toml room.lights.toml; do
    size=$(stat -c %s "$file")
    for at in $(seq 3 $((size / 16)) $((size - 1))); do
      cp "$file" flipped.toml
      flip flipped.toml "$at"
      if [ "$file" = room.zone.toml ]; then
        run --separate-stderr timeout -k 1 20 dimdis check flipped.toml
      else
        run --separate-stderr timeout -k 1 20 dimray room.rays flipped.toml -o x.lum
      fi
      echo "byte $at of $file: $status $stderr"
      ! crashed "$status"
      rm -f x.lum
      no_trace
    done
  done
}

@test "a line of 1 GiB is refused by its size, at once and without the memory" {
  truncate -s 1G big.toml
  ulimit -v 400000
  zone 4 "big.toml: is 1 GiB; at most 64 MiB" big.toml
  lights 4 "big.toml: is 1 GiB; at most 64 MiB" big.toml
  mv big.toml big.ies
  sed 's/"troffer-3600"/"big.ies"/' room.lights.toml > l.toml
  lights 3 "l.toml:6:11: .*big.ies: is 1 GiB; at most" l.toml
  refused 4 "standard input: is more than 64 MiB" bash -c 'head -c 1G /dev/zero | tr "\0" a | dimdis - -o x.rays'
  refused 4 "/dev/zero: is more than 64 MiB" dimdis /dev/zero -o x.rays
}

@test "all problems of a zone are reported together, each with place and cure" {
  cat > many.toml <<'Z'
dim = "zone/1"
cell = -0.25
unit = "metre"
[finishes]
wall = { diffuse = 1.4 }
[[surface]]
name = "floor"
finish = "wal"
vertices = [[0,0,0], [4,0,0], [4,3,0.5], [0,3,0]]
[[surface]]
name = "ceiling"
vertices = [[0,0,2], [4,0,2]]
[[surface]]
name = "floor"
finish = "wall"
vertices = [[0,0,nan], [4,0,0], [4,3,0]]
[[copy]]
of = "desk"
names = ["a", "b"]
by = [[1,0,0]]
[[box]]
name = "desk"
finish = "wall"
corner = [1,1]
sise = [1,1,1]
Z
  zone 3 "many.toml:2:8: " many.toml
  for place in 2:8 3:8 5:20 8:10 9:12 10:1 16:18 21:1 24:10 25:1; do
    [[ "$stderr" == *"dimdis: error: many.toml:$place"* ]] || { echo "no problem reported at $place"; false; }
  done
  # In the order of the file.
  diff <(grep -o 'many.toml:[0-9]*' <<< "$stderr") <(grep -o 'many.toml:[0-9]*' <<< "$stderr" | sort -t: -k2n)
  [[ "$stderr" == *"diffuse must be at least 0 and less than 1, not 1.4"* ]]
  [[ "$stderr" == *"unknown key 'sise'"*"did you mean 'size'"* ]]
}

@test "at most 20 problems are shown and the rest counted" {
  { cat room.zone.toml; for i in $(seq 30); do printf '[[plane]]\nname = "p%d"\n' "$i"; done; } > many.toml
  zone 3 "and 10 more" many.toml
  [ "${#stderr_lines[@]}" -le 45 ]
}

@test "all problems of a lights file are reported together" {
  cat > many.toml <<'Z'
dim = "lights/1"
[[luminaire]]
name = "A"
fitting = "trofer-3600"
at = [1,1,2]
[[luminaire]]
name = "B"
fitting = "nothing.ies"
at = [1,1,2]
[[luminaire]]
name = "C"
ideal = "isotropic"
intensity = -5
at = [1,1,2]
[[luminaire]]
name = "D"
ideal = "isotropic"
intensity = 5
at = [1,1,200]
aim = [0,0,0]
Z
  lights 3 "many.toml:4:11: .*no fitting 'trofer-3600'" many.toml
  [[ "$stderr" == *"did you mean 'troffer-3600'?"* ]]
  for place in 4:11 8:11 13:13 20:7; do
    [[ "$stderr" == *"dimray: error: many.toml:$place"* ]] || { echo "no problem reported at $place"; false; }
  done
  # What only a whole entry shows comes once the rest is right.
  sed -i 's/trofer/troffer/; s/nothing.ies/troffer-3600/; s/-5/5/; s/^aim.*//' many.toml
  lights 3 "many.toml:19:6: luminaire 'D' at .*outside the zone" many.toml
}

fitting() {
  sed 's|"troffer-3600"|"f.ies"|' room.lights.toml > f.toml
  lights 3 "$1" f.toml
}

@test "photometry: missing, a folder, empty, a picture, text, no light" {
  fitting "f.toml:6:11: luminaire 'P': f.ies: cannot read: No such file"
  mkdir f.ies
  fitting "f.ies: is a directory"
  rmdir f.ies
  : > f.ies
  fitting "f.ies:1: the file is empty"
  cp picture.png f.ies
  fitting "f.ies:[0-9]+"
  cp room.zone.toml f.ies
  fitting "f.ies:[0-9]+.*TILT"
  cp room.rays f.ies
  fitting "f.ies:[0-9]+"
  sed 's/"troffer-3600"/"troffer.ldt"/' room.lights.toml > f.toml
  lights 3 "f.toml:6:11: .*no" f.toml
}

@test "photometry: cut anywhere, any byte changed, absurd counts" {
  source_file=db/fittings/troffer-3600.ies
  size=$(stat -c %s "$source_file")
  sed 's|"troffer-3600"|"f.ies"|' room.lights.toml > f.toml
  for at in $(seq 1 $((size / 12)) $((size - 20))); do
    head -c "$at" "$source_file" > f.ies
    lights 3 "f.ies:[0-9]+" f.toml
  done
  for at in $(seq 5 $((size / 16)) $((size - 1))); do
    cp "$source_file" f.ies
    flip f.ies "$at"
    run --separate-stderr timeout -k 1 20 dimray room.rays f.toml -o x.lum
    echo "byte $at: $status $stderr"
    ! crashed "$status"
    rm -f x.lum
    no_trace
  done
  printf 'IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 1000000000 1000000000 1 2 0 0 0\n1 1 10\n0 90\n0\n1 1\n' > f.ies
  fitting "f.ies:3"
  printf 'IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\nnan 1\n' > f.ies
  fitting "f.ies:7"
  printf 'IESNA:LM-63-2099\nTILT=NONE\n' > f.ies
  fitting "f.ies:[0-9]+"
}

@test "database entries: a folder, empty, a picture, damaged, newer, without its file" {
  entry=db/fittings/troffer-3600.toml
  use() { refused 3 "$1" dimray room.rays room.lights.toml -o x.lum --db db; }
  : > $entry
  use "troffer-3600.toml:1:1: .*file"
  cp picture.png $entry
  use "troffer-3600.toml:1:1: .*UTF-8"
  echo 'dim = "fitting/2"' > $entry
  use "troffer-3600.toml:1:7: .*newer"
  echo 'dim = "surface/1"' > $entry
  use "troffer-3600.toml:1:7: .*not a fitting file"
  printf 'file = "nothing.ies"\nwats = 3\n' > $entry
  use "troffer-3600.toml:2:1: unknown key 'wats'"
  printf 'file = "nothing.ies"\n' > $entry
  use "troffer-3600.toml:1:8: .*nothing.ies: cannot read"
  printf 'file = "../../picture.png"\n' > $entry
  use "troffer-3600.toml:1:8: .*not an .ies, .ldt or .xml file"
  truncate -s 1G $entry
  use "troffer-3600.toml: .*1 GiB"
  surface=db/surfaces/paint-white-matt.toml
  use() { refused 3 "$1" dimdis room.zone.toml -o x.rays --db db; }
  : > $surface
  use "paint-white-matt.toml"
  cp picture.png $surface
  use "paint-white-matt.toml:1:1: .*UTF-8"
  printf 'kind = "opaque"\ndiffuse = 2\n' > $surface
  use "paint-white-matt.toml:2:11: .*2"
  printf 'kind = "shiny"\ndiffuse = 0.2\n' > $surface
  use "paint-white-matt.toml:1:8: "
}

@test "an unknown entry is reported at its place with the nearest name" {
  refused 3 "room.zone.toml|--set finishes.dark" dimdis room.zone.toml -o x.rays --set 'finishes.dark="wood-beach"'
  [[ "$stderr" == *"did you mean 'wood-beech'?"* ]]
  sed 's/"wood-beech"/"wood-beach"/' room.zone.toml > z.toml
  zone 3 "z.toml:9:9: .*wood-beach.*did you mean 'wood-beech'" z.toml
}
