# Compares two tables of `dimout grid` point by point: awk -F, -v plane=NAME -f compare.awk REFERENCE.csv MINE.csv
# Points are matched by plane and place. Prints: points, mean lx, mean deviation %, RMS %, largest %.
/^#/ { next }
$1 == "plane" { file++; for (i = 1; i <= NF; i++) column[file, $i] = i; next }
{
  if (plane != "" && $column[file, "plane"] != plane) next
  key = sprintf("%s %.3f %.3f %.3f", $column[file, "plane"], $column[file, "x_m"], $column[file, "y_m"], $column[file, "z_m"])
  lx = $column[file, "illuminance_lx"]
  if (file == 1) { reference[key] = lx; next }
  if (!(key in reference) || reference[key] <= 0) next
  n++
  d = lx / reference[key] - 1
  mean += reference[key]; sum += lx; squares += d * d
  if (d < 0) d = -d
  if (d > worst) worst = d
}
END {
  if (n == 0) { print "no points in common" > "/dev/stderr"; exit 1 }
  printf "%d,%.4g,%+.3f,%.3f,%.3f\n", n, mean / n, 100 * (sum / mean - 1), 100 * sqrt(squares / n), 100 * worst
}
