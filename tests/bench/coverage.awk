# How often the error that `dimout grid` states covers the difference from a reference:
# awk -F, -f coverage.awk REFERENCE.csv MINE.csv. The reference's own error counts twice its standard error.
# Prints: points, share covered %, median of the stated error %, median of stated over true error.
/^#/ { next }
$1 == "plane" { file++; for (i = 1; i <= NF; i++) column[file, $i] = i; next }
{
  key = sprintf("%s %.3f %.3f %.3f", $column[file, "plane"], $column[file, "x_m"], $column[file, "y_m"], $column[file, "z_m"])
  lx = $column[file, "illuminance_lx"]
  if (file == 1) { reference[key] = lx; noise[key] = 2 * $column[file, "std_error_lx"]; next }
  if (!(key in reference) || reference[key] <= 0) next
  d = lx - reference[key]; if (d < 0) d = -d
  e = $column[file, "error_lx"]
  covered += d <= e + noise[key]
  stated[++n] = 100 * e / lx
  over[n] = d > 0 ? e / d : 1e9
}
function median(values,   i, j, x) {
  for (i = 2; i <= n; i++) {
    x = values[i]
    for (j = i - 1; j > 0 && values[j] > x; j--) values[j + 1] = values[j]
    values[j + 1] = x
  }
  return values[int((n + 1) / 2)]
}
END {
  if (n == 0) { print "no points in common" > "/dev/stderr"; exit 1 }
  printf "%d,%.1f,%.3f,%.2f\n", n, 100 * covered / n, median(stated), median(over)
}
