#!/usr/bin/env bats
# What daylight refuses: weather, skies, sites, sensors, circuits, panes, ESP-r's limits, each with its place.

setup_file() {
  load common
  export ROOM="$BATS_FILE_TMPDIR/room"
  mkdir "$ROOM"
  cd "$ROOM"
  cat > room.zone.toml << 'EOF'
dim = "zone/1"
name = "side"
cell = 2
[finishes]
wall = 0.5
glass = { kind = "glazing", transmittance = 0.7, ior = 1.52 }
[[room]]
size = [4, 4]
height = 3
floor = "wall"
walls = "wall"
ceiling = "wall"
[[surface]]
name = "window"
on = "wall-s"
finish = "glass"
vertices = [[3.5,0,1],[0.5,0,1],[0.5,0,2.5],[3.5,0,2.5]]
[[plane]]
name = "workplane"
vertices = [[0.5,0.5,0.8],[3.5,0.5,0.8],[3.5,3.5,0.8],[0.5,3.5,0.8]]
grid = [4, 3]
[[sensors]]
name = "desks"
points = [[2,1,0.8, 0,0,1],[2,-1,0.8, 0,0,1]]
[site]
latitude = 52
longitude = 0
time_zone = 0
EOF
  printf 'dim = "lights/1"\n[sky]\nmodel = "tregenza"\n' > room.lights.toml
  # One day, 500 W/m2 direct and 100 diffuse from 8 to 16 h.
  {
    echo "LOCATION,Place,-,LAND,made,1,52,0,0,10"
    for line in "DESIGN CONDITIONS,0" "TYPICAL/EXTREME PERIODS,0" "GROUND TEMPERATURES,0" \
      "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0" "COMMENTS 1," "COMMENTS 2," "DATA PERIODS,1,1,Data,Monday,6/21,6/21"; do
      echo "$line"
    done
    awk 'BEGIN { for (h = 1; h <= 24; ++h) {
        lit = h > 8 && h <= 16
        printf "2001,6,21,%d,60,f,10,5,80,101325,0,0,300,%d,%d,%d", h, 300 * lit, 500 * lit, 100 * lit
        print ",999900,999900,999900,9999,0,0,0,0,9,77777,9,999999999,0,0,0,88,0,0,0" } }'
  } > day.epw
  dimdis room.zone.toml --patches 4x8 --point-patches 4x8 -o room.rays --quiet
  dimray room.rays room.lights.toml -o room.lum --quiet
}
setup() { load common; enter_copy; }

# A control file of one circuit, its law and sensors as text.
control() { printf 'dim = "control/1"\n[[circuit]]\nname = "a"\n%s\n' "$1" > control.toml; }
year() { refused 3 "$1" dimout annual room.lum --weather "$2"; }
levels() { refused 3 "$1" dimout levels room.lum --weather day.epw --control control.toml "${@:2}"; }

@test "the room and its day are right" {
  dimout annual room.lum --weather day.epw --stats -o annual.csv
  control $'watts = 5\nlaw = "dimming"\nsensors = ["desks[0]"]'
  dimout levels room.lum --weather day.epw --control control.toml -o levels.csv --quiet
}

@test "weather files cut short, with columns missing or numbers that cannot be" {
  head -20 day.epw > short.epw
  year 'short.epw:20: the last row is of 6/21 hour 12.*cut short' short.epw
  awk -F, 'BEGIN { OFS = "," } NR == 15 { NF = 12 } { print }' day.epw > columns.epw
  year 'columns.epw:15: 12 fields, 32 to 35 are right' columns.epw
  awk -F, 'BEGIN { OFS = "," } NR == 11 { $15 = "-50" } NR == 12 { $2 = 13 } NR == 13 { $15 = 5000 }
    NR == 14 { $16 = "abc" } { print }' day.epw > wrong.epw
  year 'wrong.epw:11: direct normal radiation -50 is outside 0..2000' wrong.epw
  [[ "$stderr" == *"wrong.epw:12: month 13 is outside 1..12"* ]]
  [[ "$stderr" == *"wrong.epw:13: direct normal radiation 5000 is outside 0..2000"* ]]
  [[ "$stderr" == *"wrong.epw:14: diffuse horizontal radiation 'abc' is not a number"* ]]
}

@test "a beam from below the horizon" {
  perez() {
    printf 'dim = "lights/1"\n[sky]\nmodel = "perez"\ndirect_normal = 500\ndiffuse_horizontal = 100\nsun = { %s }\n' "$1" > sun.toml
    refused 3 "$2" dimray room.rays sun.toml -o x.lum
  }
  perez 'altitude = -5, azimuth = 150' 'sun.toml:6:.*the sun stands -5 degrees above the horizon'
  perez 'time = "2001-12-21T02:00"' 'sun.toml:6:.*the sun stands -[0-9.]+ degrees above the horizon'
  perez 'time = "2001-02-30T12:00"' "sun.toml:6:.*'2001-02-30T12:00' is no time"
  refused 3 'altitude of the sun -5 is outside 0..90' dimout grid room.lum --sky perez:-5,150,500,100
}

@test "a time without a site is refused, a year without north warned of" {
  sed '/^\[site\]/,$d' room.zone.toml > nowhere.zone.toml
  dimdis nowhere.zone.toml --patches 4x8 --point-patches 4x8 -o nowhere.rays --quiet
  printf 'dim = "lights/1"\n[sky]\nmodel = "cie-12"\nhorizontal = 9000\nsun = { time = "2001-06-21T12:00" }\n' > noon.toml
  refused 3 'noon.toml:5:.*the zone file has no \[site\]' dimray nowhere.rays noon.toml -o x.lum
  dimray nowhere.rays room.lights.toml -o nowhere.lum --quiet
  run --separate-stderr dimout annual nowhere.lum --weather day.epw --stats
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"nowhere.lum: its zone file has no [site]: +y counts as true north"* ]]
}

@test "the sun of a time is that of its angles" {
  # 90 - 52 + 23.44 degrees high; on that day the sun is 1.8 minutes behind the clock, which turn it by 0.45 degrees
  # times cos 23.44 / cos 61.44.
  for sun in 'time = "2001-06-21T12:00"' 'altitude = 61.44, azimuth = 179.14'; do
    printf 'dim = "lights/1"\n[sky]\nmodel = "cie-12"\nhorizontal = 9000\nsun = { %s }\n' "$sun" > sun.toml
    # In so coarse a room the energy of the beam stays open by more than dimray lets pass.
    dimray room.rays sun.toml -o sun.lum --quiet || [ $? -eq 1 ]
    dimout grid sun.lum --plane workplane -o "${sun%% *}.csv"
  done
  paste -d, time.csv altitude.csv | awk -F, 'NR > 1 { r = $9 / $(NF / 2 + 9) - 1; if (r > 2e-3 || r < -2e-3) exit 1 }'
}

@test "sensors and circuits that name nothing, or stand where no light comes" {
  control $'watts = 5\nlaw = "dimming"\nsensors = ["desk"]'
  levels "control.toml:2:1: circuit 'a': no sensors or measuring plane 'desk'.*did you mean 'desks'"
  control $'watts = 5\nlaw = "dimming"\nsensors = ["desks[1]"]'
  levels "control.toml:2:1: circuit 'a': sensor 'desks\[1\]' lies where no light comes"
  control $'watts = 5\nlaw = "dimming"\nsensors = ["desks[7]"]'
  levels "control.toml:2:1: circuit 'a': .*desks"
  control $'law = "on"\nluminaires = ["row"]'
  levels "control.toml:2:1: circuit 'a': no luminaire or group 'row'"
}

@test "glass that has the zone on both sides is refused by name" {
  with() { { cat room.zone.toml; printf "$1"; } > inside.toml; refused 3 "inside.toml:[0-9:]* surface $2" dimdis inside.toml -o x.rays; }
  local box='[[box]]\nname = "b"\ncorner = [1,1,0.5]\nsize = [1,1,1]\n'
  local lid='[[surface]]\nname = "lid"\non = "b.top"\nfinish = "glass"\nvertices = [[1.2,1.2,1.5],[1.8,1.2,1.5],[1.8,1.8,1.5],[1.2,1.8,1.5]]\n'
  local screen='[[surface]]\nname = "screen"\nfinish = "glass"\nvertices = [[1,3,0.1],[3,3,0.1],[3,3,2],[1,3,2]]\n'
  with "${box}finish = \"wall\"\n$lid" "'lid' is glazed, but not part of the zone's shell"
  with "${box}finish = \"glass\"\n" "'b.top' is glazed"
  with "$screen" "'screen' is glazed and has the zone on both sides"
  with "${screen}sides = 2\n" "'screen' is glazed"
}

@test "BSDFs of another basis, negative, of more than all light or cut short" {
  # bsdf BASIS N FIRST OTHERS [WORDS]: a file of N values; refused with these words.
  bsdf() {
    awk -v basis="$1" -v n="$2" -v first="$3" -v value="$4" 'BEGIN {
      print "<?xml version=\"1.0\"?><WindowElement><Optical><Layer><WavelengthData><Wavelength>Visible</Wavelength>"
      print "<WavelengthDataBlock><WavelengthDataDirection>Transmission Front</WavelengthDataDirection>"
      print "<ColumnAngleBasis>" basis "</ColumnAngleBasis><RowAngleBasis>" basis "</RowAngleBasis><ScatteringData>"
      for (i = 0; i < n; ++i) printf "%s, ", i == 0 ? first : value
      print "</ScatteringData></WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>" }' > pane.xml
    [ $# -lt 5 ] || refused 3 "pane.xml:$5" dimdis pane.toml -o x.rays
  }
  sed 's/^glass = .*/glass = { kind = "glazing", bsdf = "pane.xml" }/' room.zone.toml > pane.toml
  bsdf "LBNL/Klems Full" 21025 0.1 0.1
  dimdis pane.toml --patches 4x8 --point-patches 4x8 -o pane.rays --quiet
  bsdf "LBNL/Klems Quarter" 21025 0.1 0.1 "[0-9:]* its ColumnAngleBasis is 'LBNL/Klems Quarter'"
  bsdf "LBNL/Klems Full" 21025 -0.2 0.1 "[0-9:]* value 1 of the scattering data is no number of at least 0"
  bsdf "LBNL/Klems Full" 21025 0.5 0.5 "[0-9:]* light from Klems patch 1 is passed by 1.57"
  bsdf "LBNL/Klems Full" 2000 0.1 0.1 "[0-9:]* 2000 scattering data, expected 145 x 145"
}

@test "what ESP-r has no room for is said with the circuit's place and the limit" {
  # one LAW WORDS FORMAT
  one() { control "$1"; levels "control.toml:2:1: circuit 'a': .*$2" --format cgc -o x.cgc; }
  one $'watts = 5\nlaw = "dimming"\nsensors = ["workplane"]' '12 sensors in a lighting zone, ESP-r takes 1..9'
  one $'watts = 5\nlaw = "dimming"\nsensors = ["desks[0]"]\ndelay = 7' 'a delay of 7 steps, ESP-r takes 0..6'
  one $'watts = 5\nlaw = "dimming"\nsensors = ["desks[0]"]\nswitch_off = 4' 'a switch-off factor of 4, ESP-r takes 1..3'
  one $'watts = 5\nlaw = "occupancy"' "ESP-r has no control law 'occupancy'"
  control $'watts = 5e5\nlaw = "on"'
  refused 4 "200000 W of 'Lights convec gain .W.:', ESP-r takes -10000..100000" \
    dimout levels room.lum --weather day.epw --control control.toml --format tdf -o x.tdfa --quiet
  { printf 'dim = "control/1"\n'; for n in 1 2 3 4 5; do
    printf '[[circuit]]\nname = "c%s"\nwatts = 5\nlaw = "dimming"\nsensors = ["desks[0]"]\n' $n; done; } > control.toml
  levels "control.toml:22:1: circuit 'c5': .*5 lighting zones, ESP-r takes 1..4" --format cgc -o x.cgc
}

@test "files beyond ESP-r's limits are told by line" {
  control $'watts = 5\nlaw = "dimming"\nsensors = ["desks[0]"]'
  for format in tdf cgc; do
    dimout levels room.lum --weather day.epw --control control.toml --format $format -o day.$format --quiet
    dimout levels --check day.$format
  done
  # spoiled FORMAT SED WORDS
  spoiled() {
    sed "$2" day.$1 > bad.$1
    run cmp -s day.$1 bad.$1
    [ "$status" -eq 1 ]
    refused 3 "bad.$1:$3" dimout levels --check bad.$1
  }
  spoiled tdf '3s/^   20    1    1/   20    1   61/' '3: steps an hour 61 is outside 1..60'
  spoiled tdf '3s/^   20/   19/' '3: record width 19 is outside 20'
  spoiled cgc 's/^  1  # lighting zones/  5  # lighting zones/' '5: number of lighting zones 5 is outside 1..4'
  spoiled cgc '6s/ 0  # setpoint/ 7  # setpoint/' '6: switch-off delay 7 is outside 0..6'
  spoiled cgc '7s/ 1 5 / 10 5 /' '7: number of sensors 10 is outside 1..9'
}
