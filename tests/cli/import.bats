#!/usr/bin/env bats
# Models of other programs: there and back, what is said, what is refused.

setup() { load common; cd "$BATS_TEST_TMPDIR"; }

# Areas by name, with 9 digits.
areas() { dimdis areas --quiet "$1" | awk -F, '{ printf "%s %.6f\n", $1, $2 }' | sort; }

@test "the office comes back from OBJ and Radiance with every area" {
  cp "$DIM_SOURCE"/examples/02-office/office.zone.toml .
  for to in obj radiance; do
    ending=${to/radiance/rad}
    dimdis export --quiet office.zone.toml --to $to -o model.$ending
    run --separate-stderr dimdis import model.$ending -o back.zone.toml
    [ "$status" -eq 0 ]
    [[ "$stderr" == *"89 surfaces of 182.74 m2 written"* ]]
    [[ "$stderr" == *"96.768 m3 after"* ]]
    diff <(areas office.zone.toml) <(areas back.zone.toml)
  done
}

@test "what cannot be read is refused, and nothing is left" {
  printf '!xform desk.rad\n' > a.rad
  refused 3 "a.rad:1: the command '!xform desk.rad' is not run" dimdis import a.rad -o x.zone.toml
  printf 'v 0 0 0\nf 1 2 3\n' > a.obj
  refused 3 "a.obj:2: corner '2' of a face is none of the 1" dimdis import a.obj -o x.zone.toml
  refused 2 "give --format" dimdis import a.model -o x.zone.toml
  refused 2 "does not read like" dimdis import a.obj --inside 1,2 -o x.zone.toml
}
