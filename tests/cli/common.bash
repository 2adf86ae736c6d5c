# Loaded by every test of the programs. DIM_BIN: folder of the programs; DIM_SOURCE: the repository.
bats_require_minimum_version 1.5.0

# The tests call the programs as a user does, by name.
PATH="$DIM_BIN:$PATH"
export LC_ALL=C.UTF-8

# Once a file: the room, its network and its luminance database, to be copied from $ROOM. `make_room [MORE]`: MORE is
# added to the zone file.
make_room() {
  export ROOM="$BATS_FILE_TMPDIR/room"
  mkdir -p "$ROOM"
  cp "$DIM_SOURCE"/tests/data/cli/* "$ROOM"
  cd "$ROOM"
  [ $# -eq 0 ] || printf '%s\n' "$1" >> room.zone.toml
  dimdis room.zone.toml --patches 8x16 --point-patches 16x32 -o room.rays
  dimray room.rays room.lights.toml --quiet -o room.lum
}

# Prints a zone without points: a room of 4 x 4 x 3 m with a window to the south that can be drawn, its glass then
# diffusing. `side_zone CELL TRANSMITTANCE_WHEN_DRAWN`
side_zone() {
  cat << EOF
dim = "zone/1"
name = "side"
cell = $1
[finishes]
wall = { diffuse = 0.5 }
glass = { kind = "glazing", transmittance = 0.7, ior = 1.52 }
drawn = { kind = "glazing", transmittance = $2, angular_law = "diffusing" }
[[surface]]
name = "floor"
finish = "wall"
vertices = [[0,0,0],[4,0,0],[4,4,0],[0,4,0]]
[[surface]]
name = "ceiling"
finish = "wall"
vertices = [[0,0,3],[0,4,3],[4,4,3],[4,0,3]]
[[surface]]
name = "south"
finish = "wall"
vertices = [[0,0,0],[0,0,3],[4,0,3],[4,0,0]]
[[surface]]
name = "window"
on = "south"
finish = "glass"
states = { drawn = "drawn" }
vertices = [[0.5,0,1],[0.5,0,2.5],[3.5,0,2.5],[3.5,0,1]]
[[surface]]
name = "north"
finish = "wall"
vertices = [[0,4,0],[4,4,0],[4,4,3],[0,4,3]]
[[surface]]
name = "west"
finish = "wall"
vertices = [[0,0,0],[0,4,0],[0,4,3],[0,0,3]]
[[surface]]
name = "east"
finish = "wall"
vertices = [[4,0,0],[4,0,3],[4,4,3],[4,4,0]]
EOF
}

# Before each test: a folder of its own with copies of those files.
enter_copy() {
  cd "$BATS_TEST_TMPDIR"
  cp "$ROOM"/* .
}

# Runs a command line that must fail: `refused STATUS WORDS COMMAND...`. Asks for that exit status, for WORDS (a
# regular expression) in the messages, for every message to say which program speaks, for nothing on stdout, and
# that none of the files it might have written (x.*) nor a temporary is left.
refused() {
  local status_wanted=$1 words=$2
  shift 2
  run --separate-stderr timeout -k 1 20 "$@"
  echo "\$ $*"
  echo "exit status $status, wanted $status_wanted; stdout: ${output:0:200}"
  echo "stderr: $stderr"
  [ "$status" -eq "$status_wanted" ]
  [[ "$stderr" =~ $words ]]
  [ -z "$output" ]
  local line
  for line in "${stderr_lines[@]}"; do
    [[ "$line" == dim*": error: "* || "$line" == dim*": warning: "* || "$line" == "        "* ]]
  done
  no_trace
}

# Nothing half written in this folder.
no_trace() {
  local left
  left=$(find . -maxdepth 1 \( -name 'x.*' -o -name '.*.tmp' \))
  echo "left behind: $left"
  [ -z "$left" ]
}

# A program killed by a signal, by a timeout or by a broken invariant of its own.
crashed() {
  [ "$1" -eq 5 ] || [ "$1" -ge 124 ]
}

# A damaged copy: `flip FILE OFFSET` inverts the byte there.
flip() {
  local byte
  byte=$(od -An -tu1 -j "$2" -N 1 "$1")
  printf "\\x$(printf %02x $((255 - byte)))" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}
