# tests/bench/tradeoff's CSV as SVG: RMS error against processor seconds of dimdis and dimray, both logarithmic, a line a scene
# along the sizes of cells, a dot a setting.
function x(seconds) { return 70 + 600 * (log(seconds) - log(0.05)) / (log(200) - log(0.05)) }
function y(percent) { return 30 + 380 * (log(50) - log(percent)) / (log(50) - log(0.02)) }
BEGIN {
  split("#1f5fa8 #c2410c #15803d #7e22ce #a16207 #0e7490 #be123c", colour, " ")
  print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 820 470\" font-family=\"sans-serif\" font-size=\"12\">"
  print "<rect width=\"820\" height=\"470\" fill=\"white\"/>"
  n = split("0.05 0.1 0.2 0.5 1 2 5 10 20 50 100 200", tick, " ")
  for (i = 1; i <= n; i++) printf "<path d=\"M%.1f 30V410\" stroke=\"#ddd\"/><text x=\"%.1f\" y=\"428\" text-anchor=\"middle\">%s</text>\n", x(tick[i]), x(tick[i]), tick[i]
  n = split("0.02 0.05 0.1 0.2 0.5 1 2 5 10 20 50", tick, " ")
  for (i = 1; i <= n; i++) printf "<path d=\"M70 %.1fH670\" stroke=\"#ddd\"/><text x=\"62\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", y(tick[i]), y(tick[i]) + 4, tick[i]
  print "<text x=\"370\" y=\"455\" text-anchor=\"middle\">processor seconds of dimdis and dimray</text>"
  print "<text transform=\"translate(20 220) rotate(-90)\" text-anchor=\"middle\">RMS error of points, %</text>"
}
NR == 1 { next }
{
  scene = $1; setting = $2; s = $5 + $6; e = $11
  if (!(scene in number)) { number[scene] = ++n_scenes; name[n_scenes] = scene }
  if (e < 0.02) e = 0.02
  if (e > 50) e = 50
  if (s < 0.05) s = 0.05
  k = number[scene]
  printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\"><title>%s: %s</title></circle>\n", x(s), y(e), setting == "defaults" ? 6 : 3, colour[k], scene, setting
  if (setting ~ /^--cell/) path[k] = path[k] sprintf("%s%.1f %.1f", path[k] == "" ? "M" : "L", x(s), y(e))
}
END {
  for (k = 1; k <= n_scenes; k++) {
    printf "<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", path[k], colour[k]
    printf "<circle cx=\"690\" cy=\"%d\" r=\"4\" fill=\"%s\"/><text x=\"702\" y=\"%d\">%s</text>\n", 30 + 20 * k, colour[k], 34 + 20 * k, name[k]
  }
  print "<text x=\"684\" y=\"" (50 + 20 * (n_scenes + 1)) "\">line: --cell 1 to 0.125</text><text x=\"684\" y=\"" (68 + 20 * (n_scenes + 1)) "\">large dot: defaults</text></svg>"
}
