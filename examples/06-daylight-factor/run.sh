#!/usr/bin/env bash
# Daylight factors of a side-lit room, once under an overcast sky and once from daylight coefficients, which then
# show the same room under a clear sky without another solution.
# Usage: run.sh [FOLDER for the results]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
mkdir -p "$out"

dimdis "$here/room.zone.toml" -o "$out/room.rays"
dimray "$out/room.rays" "$here/overcast.lights.toml" -o "$out/overcast.lum" --explain
dimout grid "$out/overcast.lum" --daylight-factor -o "$out/daylight-factor.csv"
dimout contour "$out/overcast.lum" --daylight-factor --filled -o "$out/daylight-factor.svg"
dimray "$out/room.rays" "$here/coefficients.lights.toml" -o "$out/coefficients.lum"
dimout grid "$out/coefficients.lum" --daylight-factor -o "$out/daylight-factor-145.csv"
dimout grid "$out/coefficients.lum" --sky cie-12:15000@40,150 -o "$out/clear.csv"

echo
echo "Daylight factor along the middle of the room, from the window (y = 0) to the back:"
paste -d, "$out/daylight-factor.csv" "$out/daylight-factor-145.csv" "$out/clear.csv" | awk -F, '
  NR == 1 { print "   y, m   overcast sky, %   from 145 patches, %   clear sky, lx" }
  NR > 1 && $3 > 1.9 && $3 < 2.1 { printf "%7.2f %12.2f %18.2f %18.0f\n", $4, $10, $20, $29 }'
echo
echo "Made in $out:"
ls -1 "$out"
