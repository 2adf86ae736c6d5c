#!/usr/bin/env bash
# A year of daylight in an office in Denver, and what two rows of dimmed lamps make of it: zone lighting levels, heat
# map, files for ESP-r. Usage: run.sh [FOLDER for the results]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
mkdir -p "$out"
cd "$here"

dimdis office.zone.toml -o "$out/office.rays" --quiet
dimray "$out/office.rays" office.lights.toml -o "$out/office.lum" --quiet

echo "A year of daylight on the work plane:"
dimout annual "$out/office.lum" --weather denver.epw --plane workplane --stats -o "$out/annual.csv" \
  --heat-map "$out/desk.svg" --point "desks[1]" --map "$out/autonomy.svg" --metric da_percent --hourly "$out/year.h5"
awk -F, 'NR == 1 { split($0, name) } NR == 2 { for (i = 1; i <= NF; ++i) printf "  %-32s %s\n", name[i], $i }' "$out/annual.csv"

for state in glass blind; do
  echo "Lamps, window as $state:"
  dimout levels "$out/office.lum" --weather denver.epw --control control.toml --state "window=$state" \
    -o "$out/office-$state.levels.csv"
done

echo "Lamps, blind drawn against the sun by the rule of LM-83:"
cat control.toml blind.toml > "$out/control.toml"
dimout levels "$out/office.lum" --weather denver.epw --control "$out/control.toml" -o "$out/office-rule.levels.csv"

echo "Files for ESP-r:"
dimout levels "$out/office.lum" --weather denver.epw --control control.toml --format tdf -o "$out/office.tdfa"
dimout levels "$out/office.lum" --weather denver.epw --control control.toml --format cgc \
  --second-state window=blind -o "$out/office.cgc"
dimout levels --check "$out/office.tdfa"
dimout levels --check "$out/office.cgc"

# Energy by row, kWh: glass front < glass back < blind back <= full; with the rule between glass and blind.
awk -F, '/^year/ { for (i = 1; i <= NF; ++i) { if ($i == "front row:watts") f = i; if ($i == "back row:watts") b = i } }
  /^[0-9]/ { if (FILENAME ~ /glass/) { gf += $f; gb += $b } else if (FILENAME ~ /rule/) rb += $b; else bb += $b }
  END { printf "kWh: front %.0f, back %.0f, back behind the blind %.0f, by the rule %.0f\n", gf / 1000, gb / 1000, bb / 1000, rb / 1000
        exit !(gf < gb && gb < rb && rb < bb && bb / 1000 <= 99 * 2.61 + 0.1) }' "$out/office-glass.levels.csv" "$out/office-blind.levels.csv" \
  "$out/office-rule.levels.csv"
