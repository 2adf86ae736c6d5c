# tests/bench/tradeoff's CSV as a table: a row a setting, a pair of RMS error and seconds for each scene; then the order
# of convergence of the cells.
NR == 1 { next }
{
  scene = $1; setting = $2
  if (!(scene in seen)) { seen[scene] = 1; scenes[++n_scenes] = scene }
  if (!(setting in known)) { known[setting] = 1; settings[++n_settings] = setting }
  rms[scene, setting] = $11; s[scene, setting] = $5 + $6; mb[scene, setting] = $7
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
  printf "| order of convergence, cells 1 to 0.25 m"
  for (i = 1; i <= n_scenes; i++) {
    coarse = rms[scenes[i], "--cell 1"]; fine = rms[scenes[i], "--cell 0.25"]
    printf " | %s", (coarse > 0 && fine > 0 ? sprintf("%.1f", log(coarse / fine) / log(4)) : "")
  }
  print " |"
}
