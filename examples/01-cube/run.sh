#!/usr/bin/env bash
# A closed cube with a point source in the middle has a closed form: mean illuminance 4 pi I / A / (1 - rho).
# Prints DIM's answer beside it. Usage: run.sh [FOLDER for the results]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/out}
# Installed, this folder may not be writable.
[ $# -gt 0 ] || { mkdir -p "$out" 2> /dev/null && [ -w "$out" ]; } || out=$PWD/dim-$(basename "$here")
mkdir -p "$out"

for rho in 0.2 0.5 0.8; do
  dimdis "$here/cube.zone.toml" --set finishes.grey.diffuse=$rho -o "$out/cube.rays" --quiet
  dimray "$out/cube.rays" "$here/cube.lights.toml" -o "$out/cube.lum" --quiet
  dimout surfaces "$out/cube.lum" -o "$out/cube-$rho.csv"
  awk -F, -v rho=$rho '
    NR > 1 { area += $2; flux += $2 * $3 }
    END {
      exact = 4 * atan2(0, -1) * 100 / area / (1 - rho)
      printf "rho %.1f: mean illuminance %8.3f lx, exact %8.3f lx, difference %+.4f %%\n",
             rho, flux / area, exact, 100 * (flux / area / exact - 1)
      if (flux / area / exact > 1.003 || flux / area / exact < 0.997) exit 1
    }' "$out/cube-$rho.csv"
done
