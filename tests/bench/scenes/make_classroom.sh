#!/bin/sh
# Writes classroom.zone.toml: a room of 9.6 x 7.2 x 3.0 m, forty desks in five rows of eight, each with a chair.
# Usage: make_classroom.sh > classroom.zone.toml
awk '
function list(kind, first_name, i, s) {       # names and displacements of all desks but the first
  s = ""
  for (i = 2; i <= n; i++) s = s (i > 2 ? ((i % 8 == 2) ? ",\n         " : ", ") : "") sprintf("\"%s%02d\"", kind, i)
  printf "names = [%s]\n", s
  s = ""
  for (i = 2; i <= n; i++) s = s (i > 2 ? ((i % 8 == 2) ? ",\n      " : ", ") : "") sprintf("[%g,%g,0]", x[i] - x[1], y[i] - y[1])
  printf "by = [%s]\n\n", s
}
function box(kind, finish, dx, dy, z, sx, sy, sz) {
  printf "[[box]]\nname = \"%s01\"\nfinish = \"%s\"\ncorner = [%g, %g, %g]\nsize = [%g, %g, %g]\n\n", \
         kind, finish, x[1] + dx, y[1] + dy, z, sx, sy, sz
  printf "[[copy]]\nof = \"%s01\"\n", kind
  list(kind)
}
function panel_x(kind, finish, dx, dy, z, sy, sz, a, b) {   # two-sided panel in a plane x = constant
  a = x[1] + dx; b = y[1] + dy
  printf "[[surface]]\nname = \"%s01\"\nfinish = \"%s\"\nsides = 2\n", kind, finish
  printf "vertices = [[%g,%g,%g], [%g,%g,%g], [%g,%g,%g], [%g,%g,%g]]\n\n", \
         a, b, z, a, b + sy, z, a, b + sy, z + sz, a, b, z + sz
  printf "[[copy]]\nof = \"%s01\"\n", kind
  list(kind)
}
function wall(name, finish, extra, v) {
  printf "[[surface]]\nname = \"%s\"\nfinish = \"%s\"\n%svertices = %s\n\n", name, finish, extra, v
}
BEGIN {
  n = 0
  for (row = 0; row < 5; row++)
    for (pair = 0; pair < 4; pair++)
      for (seat = 0; seat < 2; seat++) {
        n++
        x[n] = 0.5 + 2.25 * pair + 0.72 * seat
        y[n] = 1.7 + 1.0 * row
      }
  print "# A classroom of 9.6 x 7.2 x 3.0 m with forty desks and chairs; written by make_classroom.sh. 1,047 polygons."
  print "# The teacher and the board are at y = 0. Furniture stands 5 mm clear of the floor."
  print "dim = \"zone/1\"\nname = \"classroom\"\nunit = \"m\"\ncell = 0.25\n"
  print "[finishes]\nceiling = { diffuse = 0.80 }\nwall = { diffuse = 0.55 }\nfloor = { diffuse = 0.20 }"
  print "board = { diffuse = 0.85 }\ndesk = { diffuse = 0.40 }\nmetal = { diffuse = 0.30 }\nchair = { diffuse = 0.35 }\n"
  wall("floor", "floor", "", "[[0,0,0], [9.6,0,0], [9.6,7.2,0], [0,7.2,0]]")
  wall("ceiling", "ceiling", "", "[[0,0,3], [0,7.2,3], [9.6,7.2,3], [9.6,0,3]]")
  wall("wall-s", "wall", "", "[[0,0,0], [0,0,3], [9.6,0,3], [9.6,0,0]]")
  wall("wall-n", "wall", "", "[[0,7.2,0], [9.6,7.2,0], [9.6,7.2,3], [0,7.2,3]]")
  wall("wall-w", "wall", "", "[[0,0,0], [0,7.2,0], [0,7.2,3], [0,0,3]]")
  wall("wall-e", "wall", "", "[[9.6,0,0], [9.6,0,3], [9.6,7.2,3], [9.6,7.2,0]]")
  wall("board", "board", "on = \"wall-s\"\n", "[[3.0,0,0.9], [3.0,0,2.1], [6.6,0,2.1], [6.6,0,0.9]]")
  box("top", "desk", 0, 0, 0.720, 0.70, 0.50, 0.025)
  panel_x("leg-w", "metal", 0.03, 0.04, 0.005, 0.42, 0.71)
  panel_x("leg-e", "metal", 0.67, 0.04, 0.005, 0.42, 0.71)
  box("seat", "chair", 0.14, 0.46, 0.440, 0.42, 0.42, 0.020)
  box("back", "chair", 0.14, 0.86, 0.470, 0.42, 0.02, 0.300)
  box("post", "metal", 0.32, 0.64, 0.005, 0.06, 0.06, 0.430)
  print "[[plane]]                       # 11 x 8 points\nname = \"workplane\""
  print "vertices = [[0.5,0.5,0.8], [9.1,0.5,0.8], [9.1,6.7,0.8], [0.5,6.7,0.8]]\nspacing = 0.8\n"
  print "[[sensors]]                     # on the board, 1 mm in front of it\nname = \"board\""
  print "points = [[3.6,0.001,1.5, 0,1,0], [4.8,0.001,1.5, 0,1,0], [6.0,0.001,1.5, 0,1,0]]\n"
  print "[[view]]\nname = \"back\"\neye = [0.4, 6.8, 1.7]\nfocus = [5.6, 1.0, 0.9]\nfov = 75"
}' </dev/null
