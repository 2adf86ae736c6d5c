#!/usr/bin/env bash
# A maker sends a photometric file: look at it, put it into a database, and see what the office gains by it.
# panel-4200.ldt is written as such files are (EULUMDAT, decimal commas, Windows text) but is no product.
# Usage: run.sh [FOLDER for the results]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
office=$here/../02-office
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
mkdir -p "$out"

echo "The file as it came:"
dimdbm show "$here/panel-4200.ldt"

# A database of our own; what the file does not say is said here: the spectrum. --force: again is no error.
dimdbm add "$here/panel-4200.ldt" --db "$out/db" --spectrum led-4000 --licence CC0-1.0 --force
dimdbm check --db "$out/db"
dimdbm plot panel-4200 --db "$out/db" -o "$out/panel-4200.svg"
dimdbm plot troffer-3600 -o "$out/troffer-3600.svg"
dimdbm export panel-4200 --db "$out/db" -o "$out/panel-4200.ies"   # for programs that read only IES

# The same six places in the office with one fitting and with the other.
dimdis "$office/office.zone.toml" -o "$out/office.rays" --quiet
for fitting in troffer-3600 panel-4200; do
  dimray "$out/office.rays" "$office/office.lights.toml" --db "$out/db" \
    --set "luminaire.A.fitting=$fitting" -o "$out/$fitting.lum" --quiet
  dimout grid "$out/$fitting.lum" --plane workplane --stats -o "$out/$fitting.csv"
done

echo
echo "fitting        mean lx   min lx      U0      lm     W  lx per W/m2"
for fitting in troffer-3600 panel-4200; do
  dimdbm show "$fitting" --db "$out/db" --json > "$out/$fitting.json"
  flux=$(sed -n 's/^ "flux_lm": \(.*\),/\1/p' "$out/$fitting.json")
  watts=$(sed -n 's/^ "watts": \(.*\),/\1/p' "$out/$fitting.json")
  awk -F, -v name=$fitting -v flux="$flux" -v watts="$watts" 'NR == 2 {
    printf "%-13s %8.1f %8.1f %7.3f %7.0f %5.1f %12.2f\n", name, $4, $3, $6, flux, watts, $4 / (6 * watts / (7.2 * 4.8))
  }' "$out/$fitting.csv"
done
