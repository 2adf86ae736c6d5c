#!/usr/bin/env bash
# Coloured light: what a red and a green wall do to the light on a white floor, and how many wavebands it takes.
# Usage: run.sh [FOLDER for the results [WIDTHxHEIGHT of the picture]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
size=${2:-480x440}
mkdir -p "$out"

dimdis "$here/room.zone.toml" --patches 32x64 -o "$out/room.rays"
for bands in auto 1 80; do                        # 80: every 5 nm, all that the tables hold
  dimray "$out/room.rays" "$here/room.lights.toml" --bands $bands -o "$out/room-$bands.lum"
  dimout colour "$out/room-$bands.lum" -o "$out/colour-$bands.csv"
done
dimout surfaces "$out/room-auto.lum" -o "$out/surfaces.csv"
# White is set: found by itself it would follow the lamp, and two pictures could not be compared.
dimout image "$out/room-auto.lum" --shade gather --size "$size" --samples 2 --white 95 -o "$out/room.png"

echo
echo "Light falling on the floor, from the red wall (x = 0) to the green one (2.8 m); the lamp has x 0.3756 y 0.3723:"
paste -d, "$out/colour-auto.csv" "$out/colour-80.csv" "$out/colour-1.csv" | awk -F, '
  NR == 1 { print "   x, m       lx       x       y   CCT, K     Ra | x, y of 80 bands | of one band" }
  function apart(a, b) { return a - b > 1e-3 || b - a > 1e-3 }
  NR > 1 { printf "%7.2f %8.1f  %.4f  %.4f %8.0f %6.0f |  %.4f  %.4f  | %.4f  %.4f\n",
           $3, $6, $7, $8, $11, $13, $21, $22, $35, $36
           if (apart($7, $21) || apart($8, $22) || !apart($7, $35)) off = 1 }
  END { exit off }'
echo "The floor is redder towards the red wall and greener towards the green one. One waveband shows the illuminance"
echo "alone: within a band light keeps the lamp's spectrum."
echo
echo "Made in $out:"
ls -1 "$out"
