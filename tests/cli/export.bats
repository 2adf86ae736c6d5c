#!/usr/bin/env bats
# Zones for other programs: what is written has the areas that `dimdis areas` gives, by name, worked out from the
# text alone; names occur once.

setup() { load common; cd "$BATS_TEST_TMPDIR"; }

# Areas of the polygons of a Radiance file, one line a name. Half the vector sum of corner cross products, whose
# length counts edges that run to and fro to a hole as nothing.
radiance_areas() {
  awk '
    function add(name, n,   i, k, ax, ay, az) {
      for (i = 0; i < n; ++i) {
        k = (i + 1) % n
        ax += y[i] * z[k] - z[i] * y[k]; ay += z[i] * x[k] - x[i] * z[k]; az += x[i] * y[k] - y[i] * x[k]
      }
      area[name] += sqrt(ax * ax + ay * ay + az * az) / 2
    }
    $2 == "polygon" { name = $3; getline; getline; getline; n = $1 / 3
      for (c = 0; c < n; ++c) { getline; x[c] = $1; y[c] = $2; z[c] = $3 }
      add(name, n) }
    END { for (name in area) printf "%s %.12g\n", name, area[name] }' "$1" | sort
}

obj_areas() {
  awk '
    $1 == "v" { ++v; x[v] = $2; y[v] = $3; z[v] = $4 }
    $1 == "g" { name = $2 }
    $1 == "f" { ax = ay = az = 0
      for (i = 2; i <= NF; ++i) { a = $i; b = i < NF ? $(i + 1) : $2
        ax += y[a] * z[b] - z[a] * y[b]; ay += z[a] * x[b] - x[a] * z[b]; az += x[a] * y[b] - y[a] * x[b] }
      area[name] += sqrt(ax * ax + ay * ay + az * az) / 2 }
    END { for (name in area) printf "%s %.12g\n", name, area[name] }' "$1" | sort
}

# `areas_agree WRITTEN AREAS.csv MAY-LACK`: the same names, but those that match MAY-LACK, each with the same area.
areas_agree() {
  awk -v may_lack="$3" '
    FNR == NR { written[$1] = $2; next }
    FNR > 1 { split($0, column, ","); name = column[1]; gsub(/[ "]/, "_", name)
      if (!(name in written)) { if (name !~ may_lack) { print "lacks", name; bad = 1 } next }
      off = written[name] / column[2] - 1
      if (off * off > 1e-12) { print name, written[name], "for", column[2]; bad = 1 }
      delete written[name] }
    END { for (name in written) { print "nobody knows", name; bad = 1 } exit bad }' "$1" "$2"
}

# `export_agrees ZONE`
export_agrees() {
  dimdis areas --quiet "$1" -o areas.csv
  dimdis export --quiet "$1" --to radiance --points z.pts -o z.rad
  dimdis export --quiet "$1" --to obj -o z.obj
  radiance_areas z.rad > rad.txt
  obj_areas z.obj > obj.txt
  # Radiance's surfaces have two sides: a panel is written once.
  areas_agree rad.txt areas.csv '[.]back$'
  areas_agree obj.txt areas.csv '^$'
  # Three numbers a corner, and finite.
  run ! grep -iE 'nan|inf' z.rad z.obj
  [ -z "$(awk '$1 == "g" { print $2 }' z.obj | sort | uniq -d)" ]
}

@test "areas of the office and of the hall with its shine" {
  export_agrees "$DIM_SOURCE"/examples/02-office/office.zone.toml
  # As many points as the zone has, a position and a unit normal each.
  awk 'NF != 6 || ($4 ^ 2 + $5 ^ 2 + $6 ^ 2 - 1) ^ 2 > 1e-20 { exit 1 } END { exit NR != 113 }' z.pts
  export_agrees "$DIM_SOURCE"/examples/04-shine/hall.zone.toml
}

@test "areas of polygons with holes" {
  dimdis new box --size 6x4x2.8 -o z.toml
  cat >> z.toml <<'Z'

[[surface]]
name = "grille"
finish = "wall"
sides = 2
vertices = [[1, 1, 1.5], [4, 1, 1.5], [4, 3, 1.9], [1, 3, 1.9]]
holes = [[[1.5, 1.5, 1.6], [2, 1.5, 1.6], [2, 2.5, 1.8], [1.5, 2.5, 1.8]], [[2.5, 1.5, 1.6], [3.5, 1.5, 1.6], [3, 2.5, 1.8]]]

[[surface]]
name = "picture"
on = "wall-n"
finish = "floor"
vertices = [[2, 4, 1], [3, 4, 1], [3, 4, 2], [2, 4, 2]]
Z
  export_agrees z.toml
  # By hand: sqrt(2^2 + 0.4^2) / 2 = 1.0198 slopes the plan's areas 6 - 0.5 - 0.5; 16.8 - 1 of the wall is left.
  awk '$1 == "grille" { n += ($2 - 5 * sqrt(1.04)) ^ 2 < 1e-18 } $1 == "wall-n" { n += ($2 - 15.8) ^ 2 < 1e-18 } END { exit n != 2 }' rad.txt
}

@test "names stay apart, and none is read as a command or a comment" {
  dimdis new box --size 6x4x2.8 -o z.toml
  sed -i 's/^floor = 0.2/"!echo no" = 0.2\n"a b" = 0.3\na_b = 0.4\nvoid = 0.1/; s/^floor = "floor"/floor = "!echo no"/' z.toml
  for name in 'table top' 'table_top' '#table'; do
    printf '\n[[surface]]\nname = "%s"\nfinish = "a b"\nsides = 2\nvertices = [[%d, 1, 0.7], [%d.5, 1, 0.7], [%d.5, 2, 0.7]]\n' "$name" $((++n)) $n $n >> z.toml
  done
  dimdis export --quiet z.toml --to radiance -o z.rad
  dimdis export --quiet z.toml --to obj -o z.obj
  [ -z "$(awk '$2 == "polygon" { print $3 }' z.rad | sort | uniq -d)" ]
  [ -z "$(awk '$1 == "void" { print $3 }' z.rad | sort | uniq -d)" ]
  [ -z "$(awk '$1 == "g" { print $2 }' z.obj | sort | uniq -d)" ]
  run ! grep -E '^!|^void [a-z]+ void$' z.rad
  [ "$(grep -c '^#' z.rad)" -eq 1 ]
}

@test "the zone and its points do not mix on standard output" {
  dimdis new box --size 6x4x2.8 -o z.toml
  refused 2 'cannot both go to standard output' dimdis export z.toml --to obj --points -
}
