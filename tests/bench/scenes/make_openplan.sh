#!/bin/sh
# Writes openplan.zone.toml: an office floor of 39.6 x 30.0 x 3.0 m (1,188 m2), forty islands of four desks,
# partitions, columns and cabinets.  Usage: make_openplan.sh > openplan.zone.toml
awk '
function add(px, py) { m++; X[m] = px; Y[m] = py }
function copies(kind, i, s) {                 # of item 1 at all of X, Y
  printf "[[copy]]\nof = \"%s1\"\n", kind
  s = ""
  for (i = 2; i <= m; i++) s = s (i > 2 ? ((i % 10 == 2) ? ",\n         " : ", ") : "") sprintf("\"%s%d\"", kind, i)
  printf "names = [%s]\n", s
  s = ""
  for (i = 2; i <= m; i++) s = s (i > 2 ? ((i % 10 == 2) ? ",\n      " : ", ") : "") sprintf("[%g,%g,0]", X[i] - X[1], Y[i] - Y[1])
  printf "by = [%s]\n\n", s
  m = 0
}
function box(kind, finish, z, sx, sy, sz) {
  printf "[[box]]\nname = \"%s1\"\nfinish = \"%s\"\ncorner = [%g, %g, %g]\nsize = [%g, %g, %g]\n\n", \
         kind, finish, X[1], Y[1], z, sx, sy, sz
  copies(kind)
}
function panel(kind, finish, z, sx, sy, sz, a, b) {   # two-sided vertical panel along x (sy = 0) or y (sx = 0)
  a = X[1]; b = Y[1]
  printf "[[surface]]\nname = \"%s1\"\nfinish = \"%s\"\nsides = 2\n", kind, finish
  printf "vertices = [[%g,%g,%g], [%g,%g,%g], [%g,%g,%g], [%g,%g,%g]]\n\n", \
         a, b, z, a + sx, b + sy, z, a + sx, b + sy, z + sz, a, b, z + sz
  copies(kind)
}
function wall(name, finish, v) {
  printf "[[surface]]\nname = \"%s\"\nfinish = \"%s\"\nvertices = %s\n\n", name, finish, v
}
# Calls for every desk: the item at (dx, dy) from the own corner, seen by the person sitting at it; a desk of
# the north side is that of the south side turned by 180 degrees. sx, sy: the size of the item.
function at_desks(dx, dy, sx, sy, i) {
  for (i = 1; i <= nd; i++)
    if (south[i]) add(dxs[i] + dx, dys[i] + dy); else add(dxs[i] + 1.6 - dx - sx, dys[i] + 0.8 - dy - sy)
}
BEGIN {
  m = 0; nd = 0; ni = 0
  for (row = 0; row < 5; row++)
    for (col = 0; col < 8; col++) {
      ni++; ix[ni] = 0.7 + 4.95 * col; iy[ni] = 3.0 + 6.0 * row     # west end, middle line
      for (k = 0; k < 4; k++) {
        nd++
        dxs[nd] = ix[ni] + 1.61 * (k % 2)
        south[nd] = (k < 2)
        dys[nd] = south[nd] ? iy[ni] - 0.82 : iy[ni] + 0.02
      }
    }
  print "# An open-plan office floor of 39.6 x 30.0 x 3.0 m with 160 desks; written by make_openplan.sh. 4,250 polygons."
  print "# Furniture and columns stand 5 mm clear of floor and ceiling."
  print "dim = \"zone/1\"\nname = \"openplan\"\nunit = \"m\"\ncell = 0.5\n"
  print "[finishes]\nceiling = { diffuse = 0.80 }\nwall = { diffuse = 0.50 }\nfloor = { diffuse = 0.20 }\ndesk = { diffuse = 0.45 }"
  print "panel = { diffuse = 0.50 }\nscreen = { diffuse = 0.35 }\nchair = { diffuse = 0.15 }\ncabinet = { diffuse = 0.55 }\nconcrete = { diffuse = 0.45 }\n"
  wall("floor", "floor", "[[0,0,0], [39.6,0,0], [39.6,30,0], [0,30,0]]")
  wall("ceiling", "ceiling", "[[0,0,3], [0,30,3], [39.6,30,3], [39.6,0,3]]")
  wall("wall-s", "wall", "[[0,0,0], [0,0,3], [39.6,0,3], [39.6,0,0]]")
  wall("wall-n", "wall", "[[0,30,0], [39.6,30,0], [39.6,30,3], [0,30,3]]")
  wall("wall-w", "wall", "[[0,0,0], [0,30,0], [0,30,3], [0,0,3]]")
  wall("wall-e", "wall", "[[39.6,0,0], [39.6,0,3], [39.6,30,3], [39.6,30,0]]")
  # each desk: the person sits to the south of it (dy < 0)
  at_desks(0, 0, 1.6, 0.8);             box("desk", "desk", 0.720, 1.60, 0.80, 0.025)
  at_desks(0.03, 0.05, 0, 0.7);         panel("leg-a-", "panel", 0.005, 0, 0.70, 0.71)
  at_desks(1.57, 0.05, 0, 0.7);         panel("leg-b-", "panel", 0.005, 0, 0.70, 0.71)
  at_desks(1.10, 0.08, 0.42, 0.6);      box("drawers", "cabinet", 0.005, 0.42, 0.60, 0.60)
  at_desks(0.50, -0.40, 0.48, 0.46);    box("seat", "chair", 0.450, 0.48, 0.46, 0.04)
  at_desks(0.52, -0.43, 0.44, 0);       panel("back", "chair", 0.500, 0.44, 0, 0.27)
  at_desks(0.59, -0.17, 0.30, 0);       panel("post", "panel", 0.005, 0.30, 0, 0.43)
  for (i = 1; i <= ni; i++) add(ix[i], iy[i]);           panel("screen", "screen", 0.730, 3.21, 0, 0.42)
  for (i = 1; i <= ni; i++) add(ix[i] + 3.23, iy[i] - 0.6); box("cabinet", "cabinet", 0.005, 0.45, 1.20, 1.15)
  for (row = 0; row < 4; row++)
    for (col = 0; col < 8; col++) add(0.7 + 4.95 * col, 5.975 + 6 * row)
  box("partition", "screen", 0.005, 3.20, 0.05, 1.60)
  for (row = 0; row < 4; row++)
    for (col = 0; col < 4; col++) add(4.79 + 9.9 * col, 5.775 + 6 * row)
  box("column", "concrete", 0.005, 0.45, 0.45, 2.99)
  for (i = 0; i < 13; i++) { add(0.9 + 3 * i, 0.01); add(0.9 + 3 * i, 29.54) }
  box("store", "cabinet", 0.005, 1.20, 0.45, 1.80)
  print "[[plane]]                       # 18 x 14 points\nname = \"workplane\""
  print "vertices = [[0.6,0.6,0.8], [39.0,0.6,0.8], [39.0,29.4,0.8], [0.6,29.4,0.8]]\nspacing = 2.2\n"
  print "[[view]]\nname = \"corner\"\neye = [0.3, 1.2, 1.9]\nfocus = [20, 14, 0.6]\nfov = 75"
}' </dev/null
