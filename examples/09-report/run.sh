#!/usr/bin/env bash
# The office of example 02, its six panels in three rows that can be dimmed apart, as a page for whoever decides:
# plan, figures with their errors, requirements, luminaires, glare, pictures, and a slider for each row.
# Usage: run.sh [FOLDER for the results]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
mkdir -p "$out"
office=$here/../02-office

dimdis "$office/office.zone.toml" -o "$out/office.rays"
dimray "$out/office.rays" "$here/rows.lights.toml" -o "$out/office.lum"
dimout report "$out/office.lum" --require "$office/office.require.toml" -o "$out/office.html"

echo
echo "Open in a browser: $out/office.html"
