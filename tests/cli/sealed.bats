#!/usr/bin/env bats
# Spaces that no light reaches read exactly 0 through the whole chain, and what lies outside the room spoils no figure.

setup_file() { load common; }
setup() { load common; cd "$BATS_TEST_TMPDIR"; lights; }

lights() {
  cat > lights.toml <<'END'
dim = "lights/1"
[[luminaire]]
name = "A"
ideal = "isotropic"
lumens = 10000
at = [0.5, 0.4, 2.1]
END
}

surface() { # NAME SIDES CORNERS
  printf '[[surface]]\nname = "%s"\nfinish = "grey"\nsides = %s\nvertices = [%s]\n' "$@"
}

room() {
  printf 'dim = "zone/1"\nname = "room"\ncell = 0.5\n[finishes]\ngrey = 0.8\n'
  surface floor 1 '[0,0,0],[4,0,0],[4,3,0],[0,3,0]'
  surface ceiling 1 '[0,0,2.5],[0,3,2.5],[4,3,2.5],[4,0,2.5]'
  surface south 1 '[0,0,0],[0,0,2.5],[4,0,2.5],[4,0,0]'
  surface north 1 '[0,3,0],[4,3,0],[4,3,2.5],[0,3,2.5]'
  surface west 1 '[0,0,0],[0,3,0],[0,3,2.5],[0,0,2.5]'
  surface east 1 '[4,0,0],[4,0,2.5],[4,3,2.5],[4,3,0]'
}

points() { printf '[[sensors]]\nname = "in"\npoints = [%s]\n' "$1"; }

# All corners and points turned about the vertical, degrees.
turned() {
  awk -v a="$1" '
    BEGIN { a *= atan2(0, -1) / 180; c = cos(a); s = sin(a) }
    { out = ""
      while (match($0, /\[-?[0-9.]+,-?[0-9.]+,/)) {
        split(substr($0, RSTART + 1, RLENGTH - 2), p, ",")
        out = out substr($0, 1, RSTART) sprintf("%.17g,%.17g,", c * p[1] - s * p[2], s * p[1] + c * p[2])
        $0 = substr($0, RSTART + RLENGTH)
      }
      print out $0 }'
}

# Every reading of the zone file on stdin is 0, at several cell sizes.
dark() {
  cat > zone.toml
  for cell in 0.5 0.25 0.13; do
    dimdis zone.toml --cell $cell --patches 8x16 --point-patches 16x32 -q -o a.rays
    dimray a.rays lights.toml -q -o a.lum
    readings=$(dimout grid a.lum | sed 1d | sed 's/.*,//' | sort -u)
    echo "cell $cell: $readings"
    [ "$readings" = 0 ]
  done
}

@test "inside a box of thin panels" {
  for turn in 0 17.3 30; do
    { room
      surface s 2 '[1,1,0],[2.2,1,0],[2.2,1,1.3],[1,1,1.3]'
      surface n 2 '[1,2,0],[2.2,2,0],[2.2,2,1.3],[1,2,1.3]'
      surface w 2 '[1,1,0],[1,2,0],[1,2,1.3],[1,1,1.3]'
      surface e 2 '[2.2,1,0],[2.2,2,0],[2.2,2,1.3],[2.2,1,1.3]'
      surface lid1 2 '[1,1,1.3],[2.2,1,1.3],[2.2,1.55,1.3],[1,1.55,1.3]'
      surface lid2 2 '[1,1.55,1.3],[1.45,1.55,1.3],[1.45,2,1.3],[1,2,1.3]'
      surface lid3 2 '[1.45,1.55,1.3],[2.2,1.55,1.3],[2.2,2,1.3],[1.45,2,1.3]'
      points '[1.6,1.5,0.3,0,0,1],[1.001,1.001,0.001,0,0,1],[2.1999,1.9999,1.2999,0,0,1],[1.000001,1.5,0.000001,0,0,1]'
    } | turned $turn | sed "s/\[-0,/[0,/" > box.toml
    sed "s/at = .*/at = $(echo '[0.5,0.4,2.1]' | turned $turn)/" -i lights.toml
    dark < box.toml
    lights
  done
}

@test "behind a partition, thin or solid, and in the next room" {
  in='[3.4,1.5,0.8,0,0,1],[2.9001,1.5,0.01,0,0,1],[3.9,1.5,1,0,0,1]'
  { room; surface partition 2 '[2.8,0,0],[2.8,3,0],[2.8,3,2.5],[2.8,0,2.5]'; points "$in"; } | dark
  { room; printf '[[box]]\nname = "wall"\nfinish = "grey"\ncorner = [2.8,0,0]\nsize = [0.1,3,2.5]\n'; points "$in"; } | dark
}

@test "round the end of a panel there is light" {
  { room; surface panel 2 '[2.8,0,0],[2.8,1.7,0],[2.8,1.7,2.5],[2.8,0,2.5]'; points '[3.4,1,0.8,0,0,1]'; } > zone.toml
  dimdis zone.toml --patches 8x16 -q -o a.rays
  dimray a.rays lights.toml -q -o a.lum
  dimout grid a.lum | awk -F, 'NR == 2 { exit !($9 > 10) }'
}

@test "points outside the room are named and left out of the figures" {
  { room; printf '[[plane]]\nname = "over"\nvertices = [[-0.5,-0.5,0.8],[4.5,-0.5,0.8],[4.5,3.5,0.8],[-0.5,3.5,0.8]]\ngrid = [10,8]\n'
    printf '[[plane]]\nname = "away"\nvertices = [[9,0,0.8],[12,0,0.8],[12,3,0.8],[9,3,0.8]]\ngrid = [2,2]\n'
    printf '[[plane]]\nname = "flush"\nvertices = [[0,0,0.8],[4,0,0.8],[4,3,0.8],[0,3,0.8]]\ngrid = [8,6]\n'; } > zone.toml
  run --separate-stderr dimdis zone.toml --patches 8x16 -o a.rays
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"zone.toml:"[0-9]*": 'over': 32 of 80 points lie outside the zone"*"(-0.25, -0.25, 0.8)"* ]]
  [[ "$stderr" == *"zone.toml:"[0-9]*": 'away': 4 of 4 points"* ]]
  [[ "$stderr" != *flush* ]]
  dimray a.rays lights.toml -q -o a.lum
  [ "$(dimout grid a.lum --plane over | wc -l)" -eq 81 ]
  dimout grid a.lum --stats > stats.csv
  cat stats.csv
  grep -q '^away,4,,,,,,4,$' stats.csv
  # The points inside are those of the plane that is flush with the walls.
  [ "$(sed -n 's/^over,80,\(.*\),32$/\1/p' stats.csv)" = "$(sed -n 's/^flush,48,\(.*\),0$/\1/p' stats.csv)" ]
}
