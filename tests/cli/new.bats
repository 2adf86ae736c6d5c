#!/usr/bin/env bats
# A zone to begin with: solved at once and without a warning; areas and volume by hand; what is refused.

setup() { load common; cd "$BATS_TEST_TMPDIR"; }

# Runs a program that must succeed and say nothing.
silent() {
  run --separate-stderr "$@"
  echo "\$ $*: status $status, stderr: $stderr"
  [ "$status" -eq 0 ]
  [ -z "$stderr" ]
}

# `solved VOLUME NEW-ARGUMENTS...`: what is written is the room of that volume, and goes through all three programs.
solved() {
  local volume=$1
  shift
  rm -f room.*
  silent dimdis new "$@" -o room.zone.toml --lights-out room.lights.toml
  silent dimdis --strict --quiet --patches 8x16 room.zone.toml -o room.rays
  silent dimray --quiet room.rays room.lights.toml --combine all -o room.lum
  silent dimout grid room.lum --stats
  [[ "${lines[1]}" == *workplane,* ]]
  run --separate-stderr dimdis areas room.zone.toml -o room.csv
  echo "$stderr"
  [[ "$stderr" == "dimdis: volume $volume m3" ]]
}

# `areas_are TABLE NAME=AREA...`: these surfaces and no others.
areas_are() {
  cat "$1"
  awk -F, -v wanted="${*:2}" '
    BEGIN { n = split(wanted, pairs, " "); for (i = 1; i <= n; ++i) { split(pairs[i], pair, "="); area[pair[1]] = pair[2] } }
    NR > 1 && ($1 in area) && ($2 - area[$1]) ^ 2 < 1e-16 { ++good }
    END { exit !(good == n && NR == n + 1) }' "$1"
}

@test "a box is solved at once" {
  solved 67.2 box --size 6x4x2.8
  areas_are room.csv floor=24 ceiling=24 wall-s=16.8 wall-n=16.8 wall-w=11.2 wall-e=11.2
  # What the lights file says it is for: 500 lx, within the 15 % of the utilisation factor's fit.
  dimout grid room.lum --stats > stats.csv
  cat stats.csv
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i } NR == 2 { exit !($column["mean_lx"] > 425 && $column["mean_lx"] < 575) }' stats.csv
}

@test "a room like an L is solved at once" {
  solved 92.4 l --size 6x4x2.8 --leg 3x3
  areas_are room.csv floor=33 ceiling=33 wall-s=16.8 wall-e=11.2 wall-n=8.4 leg-wall-e=8.4 leg-wall-n=8.4 wall-w=19.6
}

@test "the smallest, low, narrow and large rooms are solved without a warning" {
  solved 0.125 box --size 0.5x0.5x0.5
  solved 120 box --size 1.2x40x2.5
  solved 57.888 l --size 4x3.3x2.4 --leg 3.9x2.8
  solved 4900 l --size 40x30x3.5 --leg 20x10
}

@test "the zone goes to standard output, and into a pipe" {
  run --separate-stderr bash -c "dimdis new box --size 3x3x2.5 | dimdis areas --quiet - | wc -l"
  [ "$output" -eq 7 ]
}

@test "sizes that cannot be meant are refused with what to write" {
  refused 2 "'6x4' does not read like 6x4x2.8.*lengths in metres" dimdis new box --size 6x4 -o x.toml
  refused 2 'decimals take a point' dimdis new box --size 6,5x4x2.8 -o x.toml
  refused 2 'no units' dimdis new box --size 6mx4mx2.8m -o x.toml
  refused 2 'does not read like' dimdis new box --size nanx4x3 -o x.toml
  refused 2 'does not read like' dimdis new box --size 6x4x2.8x -o x.toml
  refused 2 'does not read like' dimdis new box --size '' -o x.toml
  refused 2 '0 m is no length of a room' dimdis new box --size 0x4x2.8 -o x.toml
  refused 2 '-2.8 m is no height of a room.*up to 100' dimdis new box --size 6x4x-2.8 -o x.toml
  refused 2 '6000 m is no length.*write --size 6x4x2.8' dimdis new box --size 6000x4000x2800 -o x.toml
  refused 2 '600 m is no length.*write --size 6x4x2.8' dimdis new box --size 600x400x280 -o x.toml
  refused 2 '1e.300 m is no length' dimdis new box --size 1e300x4x3 -o x.toml
  refused 2 'round' dimdis new round --size 6x4x2.8 -o x.toml
  refused 2 '--size' dimdis new box -o x.toml
  refused 2 'needs --leg' dimdis new l --size 6x4x2.8 -o x.toml
  refused 2 'leg.*has no effect on a box' dimdis new box --size 6x4x2.8 --leg 3x3 -o x.toml
  refused 2 'narrower' dimdis new l --size 6x4x2.8 --leg 6x3 -o x.toml
  refused 2 'does not read like 3x3' dimdis new l --size 6x4x2.8 --leg 3 -o x.toml
}

@test "nothing that is there is replaced, and nothing half written" {
  echo mine > mine.toml
  refused 2 "'mine.toml' is there already.*another name" dimdis new box --size 6x4x2.8 -o mine.toml
  refused 2 "'mine.toml' is there already" dimdis new box --size 6x4x2.8 -o x.toml --lights-out mine.toml
  [ "$(cat mine.toml)" = mine ]
  refused 2 'would be replaced' dimdis new box --size 6x4x2.8 -o x.toml --lights-out ./x.toml
  refused 2 'cannot both go to standard output' dimdis new box --size 6x4x2.8 --lights-out -
  refused 4 'x.toml' dimdis new box --size 6x4x2.8 -o no/such/x.toml
}
