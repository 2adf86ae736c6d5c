#!/usr/bin/env bash
# Speed and accuracy of the whole chain on the bench scenes, as CSV. Run by hand on a quiet machine; not a test.
#   tests/bench/run.sh [OPTION of dimdis ...]          for example --patches 8x16
# Errors are against converged runs of DIM itself (made once, in build/bench) and, where tests/bench/reference has
# one, against the independent path tracer. Seconds are wall clock, program start-up included, best of three.
set -euo pipefail
cd "$(dirname "$0")/../.."
bin=$PWD/build/release/bin
work=build/bench
mkdir -p "$work"

. tests/bench/scenes.bash
plane_of() { case $1 in corridor) echo far ;; *) echo workplane ;; esac; }

best() { # best of three wall-clock times of a command
  local best=999 s e t
  for _ in 1 2 3; do
    s=$(date +%s.%N); "$@" >/dev/null 2>&1 || [ $? -eq 1 ]; e=$(date +%s.%N)
    t=$(awk -v a="$s" -v b="$e" 'BEGIN { printf "%.3f", b - a }')
    best=$(awk -v a="$best" -v b="$t" 'BEGIN { print (b < a ? b : a) }')
  done
  echo "$best"
}

converged() {
  local name=$1 options=()
  [ -s "$work/$name.csv" ] && return
  case $name in
    office) options=(--cell 0.1 --patches 64x128 --point-patches 128x256) ;;
    openplan) options=(--cell 0.25 --patches 16x32 --point-patches 64x128) ;;
    sidelit) options=(--cell 0.1 --patches 32x64 --point-patches 128x256) ;;
    *) options=(--cell 0.1 --patches 64x128 --point-patches 128x256) ;;
  esac
  echo "bench: converged run of $name ${options[*]}" >&2
  "$bin/dimdis" "$(zone_of "$name")" "${options[@]}" -o "$work/c.rays" --quiet
  "$bin/dimray" "$work/c.rays" "$(lights_of "$name")" --combine all --tolerance 1e-6 -o "$work/c.lum" --quiet || [ $? -eq 1 ]
  "$bin/dimout" grid "$work/c.lum" -o "$work/$name.csv"
  rm -f "$work/c.rays" "$work/c.lum"
}

echo "scene,surfaces,cells,rays,sources,dimdis_s,dimray_s,dimout_s,total_s,Mrays_per_s,peak_MB,points,mean_lx,mean_dev_%,rms_%,max_%,tracer_mean_dev_%,tracer_rms_%,tracer_max_%"
for name in ${SCENES:-office corridor classroom openplan sidelit}; do
  converged "$name"
  rays=$work/$name.rays lum=$work/$name.lum plane=$(plane_of "$name")
  d=$(best "$bin/dimdis" "$(zone_of "$name")" "$@" -o "$rays" --quiet --stats "$work/d.json")
  r=$(best "$bin/dimray" "$rays" "$(lights_of "$name")" -o "$lum" --quiet --stats "$work/r.json")
  o=$(best "$bin/dimout" grid "$lum" -o "$work/mine.csv")
  own=$(awk -F, -v plane="$plane" -f tests/bench/compare.awk "$work/$name.csv" "$work/mine.csv")
  tracer=,,
  [ ! -s "tests/bench/reference/$name.csv" ] ||
    tracer=$(awk -F, -v plane="$plane" -f tests/bench/compare.awk "tests/bench/reference/$name.csv" "$work/mine.csv" | cut -d, -f3-)
  jq -rn --slurpfile d "$work/d.json" --slurpfile r "$work/r.json" --arg name "$name" --arg t "$d $r $o" '
    ($t | split(" ") | map(tonumber)) as $s | [$name, $d[0].surfaces, $d[0].cells, $d[0].rays, ($r[0].sources | length), $s[0], $s[1], $s[2],
     (($s[0] + $s[1] + $s[2]) * 1000 | round / 1000), ($d[0].rays / $s[0] / 1e4 | round / 100),
     ([$d[0].peak_memory_bytes, $r[0].peak_memory_bytes] | max / 1e6 | round)] | map(tostring) | join(",")' | tr '\n' ','
  echo "$own,$tracer"
done
