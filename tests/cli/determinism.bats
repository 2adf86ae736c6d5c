#!/usr/bin/env bats
# One room with boxes, bodies of luminaires, a mirror, a window and a sky: the same bits for any number of threads and
# in every run. Hashes are those that the programs write with --stats, of all that a file holds.

bats_require_minimum_version 1.5.0

setup_file() {
  export PATH="$DIM_BIN:$PATH"
  cd "$BATS_FILE_TMPDIR"
  cat > room.zone.toml <<'ZONE'
dim = "zone/1"
cell = 0.4
[finishes]
wall  = 0.6
wood  = 0.35
gloss = { diffuse = 0.5, specular = 0.5, roughness = 0.2, ior = 1.5 }
glass = { kind = "glazing", transmittance = 0.7 }
mirror = { diffuse = 0.0, specular = 1.0, specular_reflectance = 0.9 }
[[room]]
size = [5, 4]
height = 2.8
floor = "gloss"
walls = "wall"
ceiling = "wall"
[[surface]]
name = "window"
on = "wall-s"
finish = "glass"
vertices = [[1,0,1],[1,0,2.2],[3,0,2.2],[3,0,1]]
[[surface]]
name = "mirror"
on = "wall-n"
finish = "mirror"
vertices = [[1,4,0.5],[2.2,4,0.5],[2.2,4,2],[1,4,2]]
[[box]]
name = "desk"
finish = "wood"
corner = [1, 1, 0.7]
size = [1.6, 0.8, 0.05]
turn = 20
[[plane]]
name = "work"
vertices = [[0.5,0.5,0.9],[4.5,0.5,0.9],[4.5,3.5,0.9],[0.5,3.5,0.9]]
grid = [6, 4]
ZONE
  cat > room.lights.toml <<'LIGHTS'
dim = "lights/1"
[[luminaire]]
name = "panel"
ideal = "lambertian"
lumens = 3000
at = [1.5, 2, 2.5]
opening = [0.6, 0.6]
body = { reflectance = 0.5 }
count = [2, 1]
pitch = [2, 1]
[[luminaire]]
name = "spot"
ideal = "isotropic"
intensity = 50
at = [4, 3, 1.9]
[sky]
model = "cie-12"
horizontal = 10000
direct_normal = 50000
sun = { altitude = 35, azimuth = 160 }
LIGHTS
}

# The hashes of both files, as made by n threads.
hashes() {
  dimdis room.zone.toml -q --threads "$1" --patches 8x16 --point-patches 8x16 --stats d.json -o t.rays || [ $? -eq 1 ]
  dimray t.rays room.lights.toml -q --threads "$1" --stats r.json -o t.lum || [ $? -eq 1 ]
  jq -r .output_hash d.json r.json
  sha256sum < t.rays
  sha256sum < t.lum
}

@test "1, 2 and 3 threads and a second run give files of the same hashes" {
  cd "$BATS_FILE_TMPDIR"
  hashes 1 > one
  grep -qE '^[0-9a-f]{32}$' one
  [ "$(wc -l < one)" -eq 4 ]
  for n in 1 2 3; do
    hashes $n > more
    diff one more
  done
}
