#!/usr/bin/env bats
# What people get wrong, and what they are told: in every case the place, what is wrong and the cure; nothing is
# computed in silence from a slip. Each line of a test is one mistake.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; cp "$DIM_SOURCE"/tests/data/photometry/ldt_isym0.ldt "$DIM_SOURCE"/tests/data/photometry/axial.ies .; }

# `mistake STATUS PLACE-AND-WORDS CURE COMMAND...`: the command ends with that status, and a message that has the words
# (a regular expression, the place before them) is followed by a cure that has those words.
mistake() {
  local wanted=$1 words=$2 cure=$3
  shift 3
  run --separate-stderr timeout -k 1 60 "$@"
  echo "\$ $*"
  echo "status $status, wanted $wanted: $stderr"
  [ "$status" -eq "$wanted" ]
  words=$words cure=$cure awk '
    /^dim[a-z]+: (error|warning): / { said = $0 ~ ENVIRON["words"] }
    /^        / { if (said && $0 ~ ENVIRON["cure"]) found = 1 }
    END { exit !found }' <<< "$stderr"
}

# A zone or lights file with one line changed: `zone SED-COMMAND` makes z.toml, `lights SED-COMMAND` l.toml.
zone() { sed "$1" room.zone.toml > z.toml; }
lights() { sed "$1" room.lights.toml > l.toml; }
check() { zone "$1"; mistake "$2" "$3" "$4" dimdis check z.toml; }
solve() { lights "$1"; mistake "$2" "$3" "$4" dimray room.rays l.toml -o y.lum; }

@test "slips of the pen in a file's text" {
  check 's/^name = "floor"/name = “floor”/' 3 'z.toml:12:' 'typographic quotes'
  check "s/^name = \"floor\"/name = floor/" 3 'z.toml:12:' 'text stands in quotes: write name = "floor"'
  check 's/^cell = .*/cell = 0,25/' 3 'z.toml:4:' 'decimals take a point: write 0.25'
  check 's/^cell = .*/cell = 0.25 m/' 3 'z.toml:4:' 'numbers stand without a unit: write 0.25'
  check 's/diffuse = 0.2 /diffuse = 20 % /' 3 'z.toml:8:' 'per cent: write a fraction'
  check 's/^cell = .*/cell = 25%/' 3 'z.toml:4:' 'per cent: write a fraction'
  check 's/^name = "floor"/name = "floor/' 3 'z.toml:12:' 'the closing " is missing'
  check 's/^cell = .*/cell =/' 3 'z.toml:4:' 'a value is missing behind cell ='
  check 's/^cell = .*/cell 0.25/' 3 'z.toml:4:' 'a line reads KEY = VALUE'
  check 's/\[4,0,0\], \[4,3,0\]/[4,0,0] [4,3,0]/' 3 'z.toml:14:' 'a comma is missing between \] and \['
  check 's/^\[\[box\]\]/[[box]/' 3 'z.toml:' 'with two brackets on both sides'
  lights 's|^fitting = .*|fitting = "C:\\lamps\\a.ldt"|'
  mistake 3 'l.toml:6:' 'write paths with / or in' dimray room.rays l.toml -o y.lum
}

@test "keys, names and values of a zone" {
  check 's/^vertices = \[\[0,0,0\], \[4,0,0\], \[4,3/vertics = [[0,0,0], [4,0,0], [4,3/' 3 "z.toml:.*'vertics'" "did you mean 'vertices'"
  check 's/^finish = "dark"/finish = "drak"/' 3 "z.toml:13:10: .*no finish 'drak'" "did you mean 'dark'"
  check 's/"paint-white-matt"/"paint-wite-matt"/' 3 "z.toml:7:.*no surface 'paint-wite-matt'" "did you mean 'paint-white-matt'"
  check 's/diffuse = 0.2/diffuse = 20/' 3 'z.toml:8:.*not 20' 'in percent. write 0.2'
  check 's/diffuse = 0.2/diffuse = [[0.4,0.2],[0.7,0.3]]/' 3 'z.toml:8:' 'micro|nm'
  check 's/^unit.*//; s/^name = "room"/name = "room"\nunit = "mmm"/' 3 'z.toml:4:.*unit must be one of' "did you mean"
  check 's/^name = "ceiling"/name = "floor"/' 3 "z.toml:17:.*'floor' is used twice, first at line 12" 'its own name'
  check 's/^finish = "wood"/finish = "wood"\nturm = 30/' 3 "z.toml:.*'turm'" "did you mean 'turn'"
  zone 's/^\[\[box\]\]/[[copy]]\nof = "dexk"\nnames = ["d2"]\nby = [[1,0,0]]\n[[box]]/'
  mistake 3 "z.toml:.*no surface or box of that name above" "did you mean 'desk'" dimdis check z.toml
  zone 's/^\[\[plane\]\]/[[copy]]\nof = "desk"\nnames = ["d2","d3"]\nby = [[1,0,0]]\n[[plane]]/'
  mistake 3 "z.toml:.*2 names but 1 displacement" 'one \[x, y, z\] for each name' dimdis check z.toml
  zone 's/^\[\[box\]\]/[[surface]]\nname = "door"\nfinish = "wood"\non = "wall-x"\nvertices = [[1,0,0],[1,0,2],[2,0,2],[2,0,0]]\n[[box]]/'
  mistake 3 "z.toml:.*no surface 'wall-x' to lie on" "did you mean 'wall-" dimdis check z.toml
  zone 's/^\[\[box\]\]/[[surface]]\nname = "door"\nfinish = "wood"\non = "wall-s"\nvertices = [[1,0,0],[1,0,3],[2,0,3],[2,0,0]]\n[[box]]/'
  mistake 3 "z.toml:.*beyond its parent 'wall-s'" '.' dimdis check z.toml
}

@test "geometry that cannot be meant" {
  check 's/\[\[4,0,0\], \[4,0,2.5\], \[4,3,2.5\], \[4,3,0\]\]/[[4,0,0], [4,3,0], [4,3,2.5], [4,0,2.5]]/' 3 "z.toml:.*'wall-e' faces out of the zone" 'the other way round'
  check 's/^vertices = \[\[4,0,0\].*/vertices = [[4,0,0], [4,0,2.5], [4,2.9,2.5], [4,2.9,0]]/' 0 'z.toml:.*not closed: the edge of' 'escaped'
  check 's/^vertices = \[\[4,0,0\].*/vertices = [[4,0,0], [4.1,0,2.5], [4,3,2.5], [4,3,0]]/' 3 'z.toml:.*out of one plane' 'triangles'
  check 's/^vertices = \[\[4,0,0\].*/vertices = [[4,0,0], [4,3,2.5], [4,0,2.5], [4,3,0]]/' 3 'z.toml:.*crosses' '.'
  check 's/^corner = .*/corner = [10, 0.8, 0.6]/' 0 "z.toml:.*'desk' lies outside the zone" 'every length is in m'
  check 's/^size = \[1.2.*/size = [3.4, 0.6, 0.05]/' 0 "z.toml:.*'desk' goes through the zone's surfaces" 'end it at the wall'
  check 's/^size = \[1.2.*/size = [120, 60, 5]/' 0 "z.toml:.*'desk' goes through" 'the size'
  check 's/^eye = .*/eye = [1.2, 1, 0.62]/' 0 "z.toml:.*view 'door': its eye .* lies inside box 'desk'" 'move the eye'
  check 's/^eye = .*/eye = [30, 30, 160]/' 0 "z.toml:.*view 'door': its eye .* outside the zone" 'check the position and the unit'
  check 's/^name = "room"/name = "room"\nunit = "mm"/' 0 'z.toml:4:.*measures 0.004 x 0.003 x 0.0025 m' 'is it unit = "m"'
  awk '/vertices|corner|size = \[1.2|points|eye|focus/ { while (match($0, /[0-9.]+/)) { printf "%s%g", substr($0, 1, RSTART - 1), substr($0, RSTART, RLENGTH) * 1000; $0 = substr($0, RSTART + RLENGTH) } } { print }' \
    room.zone.toml | sed 's/spacing = .*/spacing = 500/; s/^cell = .*/cell = 250/' > z.toml
  mistake 0 'z.toml:1:.*measures 4000 x 3000 x 2500 m' 'is it unit = "mm"' dimdis check z.toml
  printf 'dim = "zone/1"\n' > z.toml
  mistake 3 'z.toml:1:1: the zone has no surface' 'at least one' dimdis check z.toml
}

@test "points and eyes from which nothing is to be had" {
  check 's/0\.75/7.5/g' 0 "z.toml:.*'workplane': 24 of 24 points lie outside the zone" 'move it into the zone'
  check 's/\[\[1.6,1.1,0.75/[[1.6,1.1,0.62/' 0 "z.toml:.*'desk points': 1 of 2 points lie outside the zone or inside something" 'move or shrink'
  mistake 0 "view 'door' shows no light at all" 'and --mix' dimout image room.lum --mix panels=0 --mix spot=0 -o y.png
  mistake 0 "view 'door' shows no light at all" 'and --mix' dimout image room.lum --mix panels=0 --mix spot=0 --tone falsecolour -o y.png
}

@test "surfaces that claim the same place" {
  printf '[[surface]]\nname = "rug"\nfinish = "wood"\nvertices = [[1,1,0],[2,1,0],[2,2,0],[1,2,0]]\n' | cat room.zone.toml - > z.toml
  mistake 0 "z.toml:.*'rug' and surface 'floor' \(line 14\) overlap in one plane by 1 m2: 'rug' lies on top" 'on = "floor"' dimdis check z.toml
  mistake 3 "z.toml:.*'rug' and surface 'floor'" 'on = "floor"' dimdis check --strict z.toml
  mistake 3 "'rug' and surface 'floor'" 'on = "floor"' dimdis --strict z.toml -o x.rays
  no_trace
  printf '[[surface]]\nname = "screen"\nfinish = "wood"\nsides = 2\nvertices = [[0.9,0.8,0.5],[2.5,0.8,0.5],[2.5,0.8,1.1],[0.9,0.8,1.1]]\n' | cat room.zone.toml - > z.toml
  mistake 0 "z.toml:.*'desk.south' and surface 'screen' .*: 'desk.south' lies on top" 'move or shorten' dimdis check z.toml
}

@test "panels lit on one side only" {
  printf '[[surface]]\nname = "shelf"\nfinish = "wood"\nvertices = [[0.2,2,1],[1.4,2,1],[1.4,2.6,1],[0.2,2.6,1]]\n' | cat room.zone.toml - > z.toml
  mistake 0 "z.toml:.*'shelf' is seen from behind inside the zone.*swallows [0-9.]+ % of the light" 'sides = 2' dimdis z.toml --patches 8x16 -o y.rays
  mistake 3 "'shelf' is seen from behind" 'sides = 2' dimdis --strict z.toml --patches 8x16 -o x.rays
  no_trace
  sed -i 's/^name = "shelf"/&\nsides = 2/' z.toml
  run --separate-stderr dimdis z.toml --patches 8x16 -o y.rays
  [[ "$stderr" != *behind* ]]
}

@test "a luminaire on a measuring point" {
  lights 's/^at = \[0.5.*/at = [1.6, 1.1, 0.75]/'
  mistake 0 "l.toml:.*luminaire 'spot' stands on point 1 of 'desk points': its direct light there is left out" 'apart' dimray room.rays l.toml -o y.lum
}

@test "the wrong file" {
  mistake 3 'room.lights.toml:1:.*is not a zone file' 'begins with dim = "zone/1"' dimdis check room.lights.toml
  mistake 3 'room.rays: is a ray network, not a zone file' 'dimray reads it' dimdis room.rays -o y.rays
  mistake 3 'room.lum: is a luminance database, not a zone file' 'dimout reads it' dimdis check room.lum
  mistake 3 'room.zone.toml:2:.*is not a lights file' 'begins with dim = "lights/1"' dimray room.rays room.zone.toml -o y.lum
  mistake 3 'room.lum: is a luminance database, not a lights file' 'dimout reads it' dimray room.rays room.lum -o y.lum
}

@test "lights" {
  solve 's/"troffer-3600"/"trofer-3600"/' 3 "l.toml:6:11: .*no fitting 'trofer-3600'" "did you mean 'troffer-3600'"
  solve 's/"troffer-3600"/"lamp.gldf"/' 3 "l.toml:6:.*'lamp.gldf' is a GLDF container" 'take the .ldt, .ies'
  solve 's/"troffer-3600"/"lamp.uld"/' 3 "l.toml:6:.*'lamp.uld' is a DIALux luminaire" 'get the .ldt'
  solve 's/^aim = .*/dim = 30/' 0 "l.toml:10:.*dim = 30 is 30 times the full flux" 'in percent. write dim = 0.3'
  solve 's/^at = \[1.2.*/at = [1200, 1500, 2490]/' 3 "l.toml:7:.*is outside the zone" "the zone file's unit"
  solve 's/^pitch = .*//' 3 'l.toml:8:.*needs both count and pitch' 'write pitch = '
  solve 's/^spectrum = .*/spectrum = "led-400O"/' 3 "l.toml:.*no spectrum is called 'led-400O'" 'did you mean|led-'
  solve 's/^intensity = 50/intensity = 50\nlumens = 3/' 3 'l.toml:.*both intensity and lumens' 'leave one out'
  solve 's/^ideal = .*//; s/^intensity.*//' 3 "l.toml:.*'fitting' is missing" 'give a fitting, or ideal'
  solve 's/^at = \[0.5.*/at = [1.6, 1.1, 0.62]/' 0 "l.toml:.*'spot'.*of its light never reaches" 'check'
  printf 'dim = "lights/1"\n' > l.toml
  mistake 3 'l.toml:1:1: the file has no light source' 'at least one' dimray room.rays l.toml -o y.lum
}

@test "photometric files" {
  sed 's/TILT=NONE/TILT=lamp.tlt/' axial.ies > a.ies
  mistake 3 'a.ies:[0-9]+:.*TILT=lamp.tlt: there is no such file' 'TILT=NONE' dimdbm show a.ies
  sed 's|TILT=NONE|TILT=/etc/passwd|' axial.ies > a.ies
  mistake 3 'a.ies:[0-9]+:.*names another folder' 'beside the photometric file only' dimdbm show a.ies
  [[ "$stderr" != *root* ]]
  sed '7s/.*/2.5 30 60 87.5/' axial.ies > a.ies
  mistake 0 'a.ies:7:.*begin at 2.5 with light left' 'carried on' dimdbm show a.ies
  sed '3s/0/1/' ldt_isym0.ldt > a.ldt
  mistake 0 'a.ldt:.*more numbers after the intensities' 'Isym' dimdbm show a.ldt
  head -8 axial.ies > a.ies
  mistake 3 'a.ies:.*the file ends' 'incomplete' dimdbm show a.ies
  mistake 3 'x.rolf: is a Relux luminaire' 'get the .ldt' dimdbm show x.rolf
}

@test "options set for the wrong program" {
  mistake 3 "finishes.light.diffuse=0.3: finishes belong to the zone" '--finish light=ENTRY' dimray room.rays room.lights.toml --set finishes.light.diffuse=0.3 -o y.lum
  mistake 3 "cell=0.3: 'cell' belongs to the zone file" 'dimdis --set cell=0.3' dimray room.rays room.lights.toml --set cell=0.3 -o y.lum
  mistake 3 "luminaire.P.dim=0.3: luminaires belong to the lights file" 'dimray --set' dimdis check room.zone.toml --set luminaire.P.dim=0.3
  mistake 3 "finishes.lihgt=0.3: no 'lihgt'" "did you mean 'light'" dimdis check room.zone.toml --set finishes.lihgt=0.3
  mistake 3 "the zone has no finish 'lihgt'" "did you mean 'light'" dimray room.rays room.lights.toml --finish lihgt=0.3 -o y.lum
}

@test "the command line" {
  mistake 2 "there is no command 'aress'" "did you mean 'areas'" dimdis aress room.zone.toml
  mistake 2 "there is no command 'chek'" "did you mean 'check'" dimdis chek
  mistake 2 "there is no command 'grd'" "did you mean 'grid'" dimout grd room.lum
  mistake 2 "there is no command 'lst'" "did you mean 'list'" dimdbm lst
  mistake 2 "there is no command 'room.lum'" 'the commands are' dimout room.lum
  mistake 2 'patchs' "did you mean '--patches'" dimdis room.zone.toml --patchs 4 -o y.rays
  mistake 2 'range has no effect without --tone falsecolour' 'leave it out' dimout image room.lum --range 0:100 -o y.png
  mistake 3 "no view 'dor'" "did you mean 'door'" dimout image room.lum --view dor -o y.png
  mistake 3 "no measuring plane or sensors 'workplan'" "did you mean 'workplane'" dimout grid room.lum --plane workplan
  mistake 3 "panles" "did you mean 'panels'" dimout grid room.lum --mix panles=0
  mistake 3 "no entry 'led-400O'" 'did you mean' dimdbm show led-400O
  mistake 2 "'room.lights.toml' would be replaced" '.' dimray room.rays room.lights.toml -o room.lights.toml
  cp axial.ies lamp.ies; lights 's/"troffer-3600"/"lamp.ies"/'
  mistake 2 "'./lamp.ies' would be replaced|lamp.ies' would be replaced" '.' dimray room.rays l.toml -o lamp.ies
  cmp lamp.ies axial.ies
}
