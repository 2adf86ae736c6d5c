#!/usr/bin/env bash
# The main job: a furnished office with six luminaires, from zone file to illuminances and pictures.
# Usage: run.sh [FOLDER for the results]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
mkdir -p "$out"

dimdis "$here/office.zone.toml" -o "$out/office.rays"
dimray "$out/office.rays" "$here/office.lights.toml" -o "$out/office.lum"

dimout grid "$out/office.lum" -o "$out/illuminance.csv"
dimout grid "$out/office.lum" --stats -o "$out/illuminance-stats.csv"
dimout grid "$out/office.lum" --stats --by source --plane workplane -o "$out/illuminance-by-luminaire.csv"
dimout surfaces "$out/office.lum" -o "$out/surfaces.csv"
dimout image "$out/office.lum" --view door -o "$out/door.png"
dimout image "$out/office.lum" --view plan --tone falsecolour -o "$out/plan-lux.png"
dimout contour "$out/office.lum" --plane workplane --filled --values -o "$out/workplane.svg"
dimout contour "$out/office.lum" --surface wall-n -o "$out/wall-n.svg"
dimout glare "$out/office.lum" --observers workplane --worst -o "$out/glare-worst.csv"
dimout check "$out/office.lum" --require "$here/office.require.toml" -o "$out/requirements.csv" || [ $? -eq 1 ]
dimdis draw "$here/office.zone.toml" --view door -o "$out/door.svg"

echo
echo "Illuminance, lx:"
cat "$out/illuminance-stats.csv"
echo
echo "Requirements:"
cat "$out/requirements.csv"
echo
echo "Made in $out:"
ls -1 "$out"
