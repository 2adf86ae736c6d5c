# tests/bench/tradeoff's CSV as a table: a row a setting, a pair of RMS error and seconds for each scene; then the order
# of convergence of each series.
function field(line, n,    rest, i, value) {  # mawk has no FPAT: commas within quotes stay
  rest = line
  for (i = 1; i <= n; i++) {
    if (substr(rest, 1, 1) == "\"") { match(rest, /^"[^"]*"/); value = substr(rest, 2, RLENGTH - 2); rest = substr(rest, RLENGTH + 2) }
    else { match(rest, /^[^,]*/); value = substr(rest, 1, RLENGTH); rest = substr(rest, RLENGTH + 2) }
  }
  return value
}
NR == 1 { next }
{
  scene = field($0, 1); setting = field($0, 2)
  if (!(scene in seen)) { seen[scene] = 1; scenes[++n_scenes] = scene }
  if (!(setting in known)) { known[setting] = 1; settings[++n_settings] = setting }
  rms[scene, setting] = field($0, 11); s[scene, setting] = field($0, 5) + field($0, 6); mb[scene, setting] = field($0, 7)
}
function series(prefix, finer,    i, line, first, last) {  # halvings between first and last that are there
  for (i = 1; i <= n_scenes; i++) {
    first = rms[scenes[i], prefix finer[1]]; last = rms[scenes[i], prefix finer[2]]
    line = line " | " (first > 0 && last > 0 ? sprintf("%.1f", log(first / last) / log(finer[3])) : "")
  }
  return line
}
END {
  printf "| setting"; for (i = 1; i <= n_scenes; i++) printf " | %s: RMS %%, CPU s, MB", scenes[i]; print " |"
  printf "|---"; for (i = 1; i <= n_scenes; i++) printf "|---"; print "|"
  for (k = 1; k <= n_settings; k++) {
    printf "| `%s`", settings[k]
    for (i = 1; i <= n_scenes; i++)
      if ((scenes[i], settings[k]) in rms) printf " | %.3f, %.2f, %d", rms[scenes[i], settings[k]], s[scenes[i], settings[k]], mb[scenes[i], settings[k]]
      else printf " | "
    print " |"
  }
  finer[1] = "1"; finer[2] = "0.25"; finer[3] = 4
  print "| order of convergence, cells 1 to 0.25 m" series("--cell ", finer) " |"
}
