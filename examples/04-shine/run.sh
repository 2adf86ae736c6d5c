#!/usr/bin/env bash
# Shine: a mirror beside the formula, a floor from mirror to rough, and a hall with all of it.
# Usage: run.sh [FOLDER for the results [WIDTHxHEIGHT of the picture]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
size=${2:-200x192}
mkdir -p "$out"

dimdis "$here/mirror.zone.toml" -o "$out/mirror.rays" --quiet
dimray "$out/mirror.rays" "$here/mirror.lights.toml" -o "$out/mirror.lum" --quiet
echo "A point source of 100 cd before a mirror (k_s F = 0.88) over a floor, and its image at the same height behind it:"
dimout grid "$out/mirror.lum" | awk -F, '
  NR == 1 { print "from mirror, m    DIM, lx    source + image, lx" }
  NR > 1 { near = ($3 - 1)^2 + 4; far = ($3 + 1)^2 + 4
           exact = 100 * 2 / near^1.5 + 0.88 * 100 * 2 / far^1.5
           printf "%14.2f %10.3f %15.3f\n", $3, $9, exact
           if ($9 / exact > 1.001 || $9 / exact < 0.999) off = 1 }
  END { exit off }'

# Beside DIM: k_s F D G / (4 cos cos) summed over the floor at the light's exact angles, plus the direct 2.91 and 1.12 lx
# (tests/bench/reference/lobe_floor.py). m = 0 is a mirror.
echo
echo "A spotlight on a floor that reflects 0.4 by shine alone: mean illuminances by the floor's roughness m, lx"
echo "     m   far wall  (quadrature)   ceiling  (quadrature)   energy balance open by, %"
while read -r m wall ceiling; do
  dimdis "$here/lobe.zone.toml" --set finishes.floor.roughness="$m" -o "$out/lobe.rays" --quiet
  dimray "$out/lobe.rays" "$here/lobe.lights.toml" -o "$out/lobe.lum" --quiet
  { dimout surfaces "$out/lobe.lum"; dimout info "$out/lobe.lum"; } | awk -F, -v m="$m" -v wall="$wall" -v ceiling="$ceiling" '
    $1 == "wall-far" { far = $3 } $1 == "ceiling" { up = $3 } /^spot/ { split($0, info, / +/); open = info[4] }
    function off(lx, exact) { return exact > 0 && (lx / exact > 1.02 || lx / exact < 0.98) }
    END { printf "%6s %10.2f %13s %9.2f %13s %27.4f\n", m, far, wall, up, ceiling, open
          exit off(far, wall) || off(up, ceiling) || open > 0.1 || open < -0.1 }'
done << ROUGHNESSES
0    -     -
0.05 32.88 5.95
0.1  31.84 6.44
0.2  28.69 7.53
0.4  20.88 8.27
ROUGHNESSES

echo
dimdis "$here/hall.zone.toml" --patches 32x64 -o "$out/hall.rays"
dimray "$out/hall.rays" "$here/hall.lights.toml" --bands 4 --combine all -o "$out/hall.lum"
dimout surfaces "$out/hall.lum" -o "$out/surfaces.csv"
dimout image "$out/hall.lum" --shade gather --size "$size" --samples 2 --white 75 -o "$out/hall.png"

echo
echo "Made in $out:"
ls -1 "$out"
