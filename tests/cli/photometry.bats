#!/usr/bin/env bats
# Photometric files by way of the lights file: lux at points against E = I cos / r2 worked out by hand.

setup() {
  load common
  cd "$BATS_TEST_TMPDIR"
  cp "$DIM_SOURCE"/tests/data/photometry/*.{ies,ldt,tlt} .
}

# `lux LUMINAIRE_KEYS X Y Z NX NY NZ` in a black cube of 4 m.
lux() {
  cat > zone.toml <<ZONE
dim = "zone/1"
name = "black cube"
cell = 1.0
[finishes]
black = { diffuse = 0.0 }
$(awk 'BEGIN {
  split("0,0,0|4,0,0|4,4,0|0,4,0;0,0,4|0,4,4|4,4,4|4,0,4;0,0,0|0,0,4|4,0,4|4,0,0;0,4,0|4,4,0|4,4,4|0,4,4;0,0,0|0,4,0|0,4,4|0,0,4;4,0,0|4,0,4|4,4,4|4,4,0", faces, ";")
  for (i = 1; i <= 6; i++) {
    n = split(faces[i], v, "|"); text = ""
    for (j = 1; j <= n; j++) text = text (j > 1 ? "," : "") "[" v[j] "]"
    printf "[[surface]]\nname = \"face %d\"\nfinish = \"black\"\nvertices = [%s]\n", i, text
  }
}')
[[sensors]]
name = "point"
points = [[$2, $3, $4, $5, $6, $7]]
ZONE
  printf 'dim = "lights/1"\n[[luminaire]]\nname = "L"\nopening = "point"\n%b\n' "$1" > lights.toml
  dimdis zone.toml --patches 2x4 -o - --quiet | dimray - lights.toml --quiet -o - | dimout grid - | awk -F, 'NR == 2 { print $9 }'
}

is() {
  echo "found $1, wanted $2"
  awk -v a="$1" -v b="$2" 'BEGIN { exit !(a / b > 0.99999 && a / b < 1.00001) }'
}

@test "aimed down, C0 is +x and C90 +y" {
  # 70, 90, 110, 130 cd in C0, C90, C180, C270; 1 m aside and 2 m below: E = I 2 / 5^1.5
  keys='fitting = "ldt_isym0.ldt"\nat = [2, 2, 2.5]'
  is "$(lux "$keys" 3 2 0.5 0 0 1)" 12.521981
  is "$(lux "$keys" 2 3 0.5 0 0 1)" 16.099689
  is "$(lux "$keys" 1 2 0.5 0 0 1)" 19.677398
  is "$(lux "$keys" 2 1 0.5 0 0 1)" 23.255107
}

@test "aimed aside, c0 and C90 = c0 x aim follow" {
  # Aim +x: c0 is +y, C90 down. 1 m aside and 3 m on: E = I 3 / 10^1.5
  keys='fitting = "ldt_isym0.ldt"\nat = [0.5, 2, 2]\naim = [1, 0, 0]'
  is "$(lux "$keys" 3.5 3 2 -1 0 0)" 6.6407831
  is "$(lux "$keys" 3.5 2 1 -1 0 0)" 8.5381497
  is "$(lux "$keys" 3.5 1 2 -1 0 0)" 10.435516
  is "$(lux "$keys" 3.5 2 3 -1 0 0)" 12.332883
}

@test "turn takes c0 towards C90" {
  keys='fitting = "ldt_isym0.ldt"\nat = [2, 2, 2.5]\nturn = 90'
  is "$(lux "$keys" 2 3 0.5 0 0 1)" 12.521981
  is "$(lux "$keys" 1 2 0.5 0 0 1)" 16.099689
}

@test "type B: H to the right, V upwards" {
  # H 45: 65 cd, H -45: 35 cd, V 45: 55 cd, V -45: 45 cd; 1 m aside and 1 m on: E = I / 2^1.5
  keys='fitting = "type_b_whole.ies"\nat = [2, 1, 2]\naim = [0, 1, 0]'
  is "$(lux "$keys" 3 2 2 0 -1 0)" 22.980970
  is "$(lux "$keys" 1 2 2 0 -1 0)" 12.374369
  is "$(lux "$keys" 2 2 3 0 -1 0)" 19.445436
  is "$(lux "$keys" 2 2 1 0 -1 0)" 15.909903
}

@test "an EULUMDAT and an LM-63 file of the same luminaire give the same lux" {
  is "$(lux 'fitting = "ldt_isym1.ldt"\nat = [2, 2, 2.5]' 2 2 0.5 0 0 1)" 25
  is "$(lux 'fitting = "axial.ies"\nat = [2, 2, 2.5]' 2 2 0.5 0 0 1)" 25
}

@test "lamp tilt factors follow the aim" {
  sed -n '/TILT/,+4p' tilt_include.ies
  down=$(lux 'fitting = "tilt_include.ies"\nat = [2, 2, 2.5]' 2 2 0.5 0 0 1)
  is "$down" 25
  # At 90 degrees factor 0.9 in the file, 0.8 in the one beside it; 2 m on.
  is "$(lux 'fitting = "tilt_include.ies"\nat = [1, 2, 2]\naim = [1, 0, 0]' 3 2 2 -1 0 0)" "$(awk 'BEGIN { print 25 * 0.9 }')"
  is "$(lux 'fitting = "tilt_file.ies"\nat = [1, 2, 2]\naim = [1, 0, 0]' 3 2 2 -1 0 0)" 20
}

@test "a table that begins at half a step lights what is below" {
  # 100 cd from 2.5 to 87.5 degrees: straight below E = I / r2 = 25 lx.
  printf 'IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n2.5 45 87.5\n0\n100 100 100\n' > half.ies
  is "$(lux 'fitting = "half.ies"\nat = [2, 2, 2.5]' 2 2 0.5 0 0 1)" 25
}

@test "a TM-33 file lights as its table says, Length along C90" {
  # C0 100 cd and C90 150 cd at 45 degrees; 1 m aside and 1 m below: E = I / 2^1.5. Without its opening.
  keys='fitting = "tm33_18.xml"\nat = [2, 2, 2.5]'
  cp "$DIM_SOURCE"/tests/data/photometry/tm33_18.xml .
  is "$(lux "$keys" 3 2 1.5 0 0 1)" 35.355339
  is "$(lux "$keys" 2 3 1.5 0 0 1)" 53.033009
}

@test "lumens of the lights file are those of the fitting as new" {
  mkdir -p db/fittings
  cp ldt_isym1.ldt db/fittings
  printf 'file = "ldt_isym1.ldt"\nlamp_factor = 0.9\nmaintenance_factor = 0.8\n' > db/fittings/aged.toml
  is "$(lux 'fitting = "aged"\nlumens = 1256.6370614\nat = [2, 2, 2.5]' 2 2 0.5 0 0 1)" 36
}

@test "an entry's lumens, lamp and maintenance factors multiply" {
  mkdir -p db/fittings
  cp ldt_isym1.ldt db/fittings
  printf 'file = "ldt_isym1.ldt"\nlumens = 1256.6370614\nlamp_factor = 0.9\nmaintenance_factor = 0.8\n' > db/fittings/aged.toml
  is "$(lux 'fitting = "aged"\nat = [2, 2, 2.5]' 2 2 0.5 0 0 1)" 36
}
