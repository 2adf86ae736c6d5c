#!/bin/sh
# The reference tracer against closed forms.  Usage: validate.sh [PROGRAM]
set -e
root=$(cd "$(dirname "$0")/../../.." && pwd)
program=${1:-$root/build/release/bin/reference_tracer}
out=$(mktemp)
trap 'rm -f "$out"' EXIT

for case in inverse_square lambert_rectangle; do
  folder=$root/tests/validation/$case
  "$program" "$folder/zone.toml" "$folder/lights.toml" --samples 64 --strata 64 2>/dev/null >"$out"
  awk -F, -v name=$case '
    /^#/ || /^plane/ { next }
    NR == FNR { expected[$1 "," $2] = $9; next }
    { e = expected[$1 "," $2]; d = e > 0 ? $9 / e - 1 : $9; d = d < 0 ? -d : d; n++
      if (d > worst) worst = d
      if (e > 0 && $10 / e > error) error = $10 / e }
    END { printf "%s: %d points, largest difference %.2g %%, largest standard error %.2g %%\n", name, n, 100 * worst, 100 * error }
  ' "$folder/expected.csv" "$out"
done

for rho in 0.2 0.5 0.8; do
  "$program" "$root/examples/01-cube/cube.zone.toml" "$root/examples/01-cube/cube.lights.toml" --surfaces \
    --samples 1000000 --threads 2 --set finishes.grey.diffuse=$rho 2>/dev/null >"$out"
  awk -F, -v rho=$rho '
    /^#/ || /^surface/ { next }
    { sum += $2 * $4; area += $2; square += ($2 * $5) ^ 2 }
    END { exact = 16 * atan2(1, 1) * 100 / 24 / (1 - rho)
          printf "closed_cube: reflectance %s, mean %.4f lx, exact %.4f lx, difference %.3f %%, standard error %.3f %%\n",
                 rho, sum / area, exact, 100 * (sum / area / exact - 1), 100 * sqrt(square) / area / exact }' "$out"
done
