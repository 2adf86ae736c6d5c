# What measuring points measure, task areas and maintenance factors, by the programs.
setup() {
  load common
  cd "$BATS_TEST_TMPDIR"
  cat > zone.toml <<'END'
dim = "zone/1"
[finishes]
grey = 0.5
[[room]]
name = "r"
size = [6, 5]
height = 3
floor = "grey"
walls = "grey"
ceiling = "grey"
[[plane]]
name = "flat"
vertices = [[2,2,1], [4,2,1], [4,3,1], [2,3,1]]
grid = [2, 1]
END
  cat > lights.toml <<'END'
dim = "lights/1"
[[luminaire]]
name = "L"
group = "g"
ideal = "isotropic"
intensity = 100
at = [3, 2.5, 2.5]
END
}

of() { # PLANE COLUMN
  dimout grid a.lum --stats | awk -F, -v plane="$1" -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } $1 == plane && c { print $c }'
}
solve() { dimdis zone.toml --cell 0.5 -q -o a.rays && dimray a.rays lights.toml -q -o a.lum; }

@test "each quantity of a lamp's light is its closed form; four ways face apart" {
  sed -i 's/^grey = 0.5/grey = 0.0/' zone.toml
  for quantity in cylindrical semicylindrical hemispherical scalar vertical4; do
    printf '[[sensors]]\nname = "%s"\nquantity = "%s"\npoints = [[3, 1, 1, %s]]\n' "$quantity" "$quantity" \
      "$(case $quantity in semicylindrical | vertical4) echo 0, 1, 0 ;; *) echo 0, 0, 1 ;; esac)" >> zone.toml
  done
  solve
  # 1.5 m beside and 1.5 m above: 100 cd / 4.5 m2, at 45 degrees.
  near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a / b > 0.999 && a / b < 1.001) }'; }
  near "$(of cylindrical mean_lx)" "$(awk 'BEGIN { print 100 / 4.5 * sqrt(0.5) / 3.14159265 }')"
  near "$(of semicylindrical mean_lx)" "$(awk 'BEGIN { print 100 / 4.5 * 2 * sqrt(0.5) / 3.14159265 }')"
  near "$(of hemispherical mean_lx)" "$(awk 'BEGIN { print 100 / 4.5 * (1 + sqrt(0.5)) / 4 }')"
  near "$(of scalar mean_lx)" "$(awk 'BEGIN { print 100 / 4.5 / 4 }')"
  near "$(of vertical4.front mean_lx)" "$(awk 'BEGIN { print 100 / 4.5 * sqrt(0.5) }')"
  [ "$(of vertical4.back mean_lx)" = 0.00000000 ] || [ "$(of vertical4.back mean_lx | tr -d '0.')" = "" ]
  [ "$(of scalar quantity)" = scalar ]
}

@test "a plain zone has no column of quantities; a word that is none is refused with the words" {
  solve
  [ -z "$(of flat quantity)" ]
  sed -i 's/^grid = \[2, 1\]/grid = [2, 1]\nquantity = "cylindric"/' zone.toml
  run -3 dimdis zone.toml -o b.rays
  [[ "$output" == *cylindrical* ]]
}

@test "an area has its surroundings, and nothing beyond the walls" {
  cat >> zone.toml <<'END'
[[area]]
name = "desk"
vertices = [[0.5,0.25,0.75], [2.5,0.25,0.75], [2.5,1.25,0.75], [0.5,1.25,0.75]]
END
  solve
  [ "$(dimout grid a.lum --stats | cut -d, -f1 | grep -c '^desk')" -eq 3 ]
  [ "$(of desk.surrounding left_out)" -eq 0 ]
  [ "$(of desk.background left_out)" -eq 0 ]
}

@test "maintained light stands beside the initial one, taken once" {
  sed -i 's/^group = "g"/group = "g"\nmaintenance_factor = 0.8/' lights.toml
  solve
  awk -v m="$(of flat maintained_mean_lx)" -v e="$(of flat mean_lx)" 'BEGIN { exit !(m / e > 0.7999 && m / e < 0.8001) }'
  sed -i '/^maintenance_factor/d' lights.toml
  dimray a.rays lights.toml -q -o a.lum
  [ -z "$(of flat maintained_mean_lx)" ]
}
