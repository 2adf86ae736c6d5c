#!/usr/bin/env bats
# A year of daylight and of lamps in a side-lit room: tables, ESP-r's files and their strict check.

setup_file() {
  load common
  cd "$BATS_FILE_TMPDIR"
  side_zone 1 0.1 > side.zone.toml
  cat >> side.zone.toml << 'EOF'
[[plane]]
name = "workplane"
vertices = [[0.5,0.5,0.8],[3.5,0.5,0.8],[3.5,3.5,0.8],[0.5,3.5,0.8]]
grid = [3, 3]
[site]
latitude = 52
longitude = 0
time_zone = 0
EOF
  printf 'dim = "lights/1"\n[sky]\nmodel = "tregenza"\n' > side.lights.toml
  cat > control.toml << 'EOF'
dim = "control/1"
[occupancy]
hours = "08:00-18:00"
[[circuit]]
name = "front"
watts = 100
sensors = ["workplane[1]"]
law = "dimming"
[[circuit]]
name = "back"
watts = 300
sensors = ["workplane[6]", "workplane[8]"]
law = "on-off"
delay = 1
EOF
  # The sun of a year at 52 N with 500 W/m2 direct and 100 diffuse from 8 to 16 h.
  {
    echo "LOCATION,Place,-,LAND,made,1,52,0,0,10"
    for line in "DESIGN CONDITIONS,0" "TYPICAL/EXTREME PERIODS,0" "GROUND TEMPERATURES,0" \
      "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0" "COMMENTS 1," "COMMENTS 2," "DATA PERIODS,1,1,Data,Monday,1/1,12/31"; do
      echo "$line"
    done
    awk 'BEGIN {
      split("31 28 31 30 31 30 31 31 30 31 30 31", days)
      for (m = 1; m <= 12; ++m) for (d = 1; d <= days[m]; ++d) for (h = 1; h <= 24; ++h) {
        lit = h > 8 && h <= 16
        printf "2001,%d,%d,%d,60,f,10,5,80,101325,0,0,300,%d,%d,%d", m, d, h, 300 * lit, 500 * lit, 100 * lit
        print ",999900,999900,999900,9999,0,0,0,0,9,77777,9,999999999,0,0,0,88,0,0,0"
      }
    }'
  } > site.epw
  dimdis side.zone.toml -o side.rays --quiet
  dimray side.rays side.lights.toml -o side.lum --quiet
}
setup() { load common; cd "$BATS_FILE_TMPDIR"; }

@test "annual gives metrics for every point and plane" {
  run --separate-stderr dimout annual side.lum --weather site.epw
  [ "$status" -eq 0 ]
  [ "${#lines[@]}" -eq 10 ]
  [[ "${lines[0]}" == plane,point,x_m,y_m,z_m,nx,ny,nz,daylight_factor_percent,da_percent,* ]]
  run --separate-stderr dimout annual side.lum --weather site.epw --stats
  [ "$status" -eq 0 ]
  [ "${#lines[@]}" -eq 2 ]
}

@test "autonomy is the share of occupied hours that the levels reach" {
  dimout annual side.lum --weather site.epw -o annual.csv
  dimout levels side.lum --weather site.epw --control control.toml -o levels.csv --quiet
  awk -F, 'NR == FNR { if ($2 == 1) da = $10; next }
    /^[0-9]/ && $4 > 8 && $4 <= 18 { n++; above += $11 >= 300 }
    END { exit !(n == 3650 && da - 100 * above / n < 0.01 && 100 * above / n - da < 0.01) }' annual.csv levels.csv
}

@test "levels say watts by circuit, kWh and LENI" {
  run --separate-stderr dimout levels side.lum --weather site.epw --control control.toml
  [ "$status" -eq 0 ]
  [[ "$output" == *"# weather: site.epw (Place, LAND)"* ]]
  [[ "$output" == *",workplane[1]:sun_lx,workplane[1]:sky_lx,workplane[1]:total_lx,"*",back:watts,watts"* ]]
  [[ "$stderr" == *"circuit front: "*" kWh, "* ]]
  [[ "$stderr" == *"LENI: "*" on 16.0 m2"* ]]
  awk -F, '/^[0-9]/ { n++; if ($NF > 400.001 || ($4 <= 8 && $NF > 0)) exit 1 } END { exit n != 8760 }' <<< "$output"
}

@test "ESP-r's files pass the strict check, spoiled ones do not" {
  dimout levels side.lum --weather site.epw --control control.toml --format tdf -o room.tdfa --quiet
  dimout levels --check room.tdfa
  for type in 2 5; do
    dimout levels side.lum --weather site.epw --control control.toml --format cgc --sensor-type $type \
      --esp-surface window=7 -o room.cgc
    dimout levels --check room.cgc
  done
  sed 's/^  2  # lighting zones/  5  # lighting zones/' room.cgc > bad.cgc
  run dimout levels --check bad.cgc
  [ "$status" -eq 3 ]
  [[ "$output" == *"bad.cgc:5: number of lighting zones 5 is outside 1..4"* ]]
}

@test "one moment by --at is the step of a year with the same light" {
  run --separate-stderr dimout levels side.lum --control control.toml --at 40 180 500 100
  [ "$status" -eq 0 ]
  [ "${lines[0]}" = "circuit,sensor,sun_lx,sky_lx,total_lx" ]
  [ "${#lines[@]}" -eq 4 ]
  awk -F, 'NR > 1 && !($5 > 100 && $5 - $3 - $4 < 0.01 && $3 + $4 - $5 < 0.01) { exit 1 }' <<< "$output"
}

@test "e2r adds a line a sensor of the first circuit and leaves line 1" {
  PATH="$DIM_SOURCE/examples/esp-r:$PATH"
  echo '     40.0      0.0    500.0    100.0  NO' > act
  DIM_LUM=side.lum DIM_CONTROL=control.toml e2r -file m.cfg -purpose Coupling -zone 1 -act Calculate -actf act -mode text
  [ "$(wc -l < act)" -eq 2 ]
  [ "$(head -1 act)" = '     40.0      0.0    500.0    100.0  NO' ]
  lx=$(dimout levels side.lum --control control.toml --at 40 180 500 100 | awk -F, 'NR == 2 { printf "%.2f", $5 }')
  [ "$(tail -1 act)" = "$lx" ]
}

@test "what is wrong is said: weather, control, states, coefficients" {
  head -5000 site.epw > short.epw
  run dimout annual side.lum --weather short.epw
  [ "$status" -eq 3 ]
  [[ "$output" == *"short.epw:5000: the last row is of "*"cut short"* ]]
  run dimout levels side.lum --weather site.epw --control control.toml --set 'circuit.front.sensors=["desk"]'
  [ "$status" -eq 3 ]
  [[ "$output" == *"circuit 'front': no sensors or measuring plane 'desk'"* ]]
  run dimout levels side.lum --weather site.epw --control control.toml --set 'circuit.front.luminaires=["row"]'
  [ "$status" -eq 3 ]
  [[ "$output" == *"no luminaire or group 'row'"* ]]
  run dimout annual side.lum --weather site.epw --state window=shut
  [ "$status" -eq 3 ]
  [[ "$output" == *"have no state 'shut'"* ]]
  printf 'dim = "lights/1"\n[sky]\nmodel = "cie-overcast"\nhorizontal = 10000\n' > one.lights.toml
  dimray side.rays one.lights.toml -o one.lum --quiet
  run dimout annual one.lum --weather site.epw
  [ "$status" -eq 3 ]
  [[ "$output" == *"holds no daylight coefficients"* ]]
}

@test "a heat map is drawn for a point" {
  dimout annual side.lum --weather site.epw --heat-map map.svg --point "workplane[4]" -o /dev/null
  grep -q "workplane\[4\]" map.svg
}

@test "every step of the year goes into an HDF5 file" {
  dimout annual side.lum --weather site.epw --hourly year.h5 -o annual.csv
  [[ "$(h5dump -H year.h5)" == *'DATASET "illuminance"'*'SIMPLE { ( 8760, 9 ) / ( 8760, 9 ) }'*DIMENSION_LIST* ]]
  dimout levels side.lum --weather site.epw --control control.toml -o levels.csv --quiet
  # Row of 12:00 on 21 June, sensor workplane[1].
  lx=$(h5dump -d illuminance -s 4115,1 -c 1,1 -y year.h5 | awk '/^ *[0-9.]+$/ { print $1 }')
  awk -F, -v lx="$lx" '/^2001,6,21,12,/ { d = $11 / lx - 1; exit !(d < 1e-5 && d > -1e-5) }' levels.csv
  run dimout annual side.lum --weather site.epw --hourly -
  [ "$status" -eq 2 ]
}

@test "any metric is drawn over the plane" {
  dimout annual side.lum --weather site.epw --map plan.svg --metric udi_high_percent -o /dev/null
  grep -q "workplane: Occupied time above 3,000 lx" plan.svg
  dimout annual side.lum --weather site.epw --map plan.png -o /dev/null
  [ "$(head -c 4 plan.png | tail -c 3)" = PNG ]
  run dimout annual side.lum --weather site.epw --map plan.pdf
  [ "$status" -eq 2 ]
  run dimout annual side.lum --weather site.epw --map plan.svg --metric glare
  [ "$status" -eq 2 ]
}

@test "blinds are drawn against the sun, step by step" {
  cat control.toml - > blinds.toml << 'EOF'
[[blind]]
windows = "window"
closed = "drawn"
law = "direct-sun"
EOF
  dimout levels side.lum --weather site.epw --control control.toml -o open.csv --quiet
  dimout levels side.lum --weather site.epw --control control.toml --state window=drawn -o drawn.csv --quiet
  run --separate-stderr dimout levels side.lum --weather site.epw --control blinds.toml -o blinds.csv
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"windows 'window': 'drawn' for "*" h of light"* ]]
  # Every step is that of one of the two states, and says which.
  for file in open drawn blinds; do grep ^2001 $file.csv > $file.rows; done
  paste -d, open.rows drawn.rows blinds.rows | awk -F, '{
      n = int(NF / 3); closed = $NF; lx = $(2 * n + 11); want = closed ? $(n + 11) : $11
      if (lx != want) { wrong = 1; exit }; sum += closed } END { exit !(!wrong && sum > 200 && sum < 2920) }'
  dimout annual side.lum --weather site.epw --stats -o open.csv
  dimout annual side.lum --weather site.epw --stats --control blinds.toml -o blinds.csv
  # Direct sun and daylight factors are those of windows as they stand; light is less.
  awk -F, 'FNR == 2 { if (NR == 2) { df = $3; ase = $12; da = $5 } else exit !($3 == df && $12 == ase && $5 < da) }' open.csv blinds.csv
  run dimout levels side.lum --weather site.epw --control blinds.toml --method paper
  [ "$status" -eq 2 ]
  sed 's/"drawn"/"shut"/' blinds.toml > bad.toml
  run dimout levels side.lum --weather site.epw --control bad.toml
  [ "$status" -eq 3 ]
  [[ "$output" == *"bad.toml:15:"*"have no state 'shut'"* ]]
}

@test "limits of ESP-r are said with the place in the control file" {
  { cat control.toml; printf '[[circuit]]\nname = "slow"\nwatts = 10\nsensors = ["workplane[0]"]\nlaw = "dimming"\ndelay = 9\n'; } > slow.toml
  run dimout levels side.lum --weather site.epw --control slow.toml --format cgc -o slow.cgc
  [ "$status" -eq 3 ]
  [[ "$output" == *"slow.toml:15:"*"circuit 'slow': "*"a delay of 9 steps, ESP-r takes 0..6"* ]]
  { cat control.toml; for n in 3 4 5; do
    printf '[[circuit]]\nname = "c%s"\nwatts = 10\nsensors = ["workplane[0]"]\nlaw = "dimming"\n' $n; done; } > five.toml
  run dimout levels side.lum --weather site.epw --control five.toml --format cgc -o five.cgc
  [ "$status" -eq 3 ]
  [[ "$output" == *"five.toml:25:"*"5 lighting zones, ESP-r takes 1..4"* ]]
  [ ! -e five.cgc ]
}

@test "a beam without sun is left out and said" {
  sed 's/^\(2001,1,1,2,.*,300,\)0,0,0,/\10,500,0,/' site.epw > night.epw
  run --separate-stderr dimout annual side.lum --weather night.epw --stats
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"night.epw: 1 of 8760 steps have direct radiation with the sun below the horizon"* ]]
  run --separate-stderr dimout levels side.lum --control control.toml --at -5 150 500 100
  [ "$status" -eq 0 ]
  [[ "$stderr" == *"beam is left out"* ]]
}
