#!/usr/bin/env bats
# Requests that no machine, or not this one, can do: refused before any work, with the size and the cure.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

zone() { refused "$@" -o x.rays; }

@test "absurd cells" {
  for cell in 1e-9 1e-300 1e-4; do
    for command in "dimdis room.zone.toml" "dimdis areas room.zone.toml" "dimdis check room.zone.toml"; do
      output_option=""
      [[ "$command" == *check* ]] || output_option="-o x.rays"
      refused 4 "cells.*surface '.*GiB.*use a larger --cell" $command --cell $cell $output_option
    done
    zone 4 "use a larger --cell" dimdis room.zone.toml --set cell=$cell
    zone 4 "surface 'wall-s'.*use a larger --cell" dimdis room.zone.toml --set surface.wall-s.cell=$cell
  done
  zone 3 "grid must be" dimdis room.zone.toml --set 'surface.wall-s.grid=[1000000000, 2]'
  zone 3 "cell must be" dimdis room.zone.toml --set cell=0
}

@test "absurd patches" {
  zone 2 "patches.*16x32" dimdis room.zone.toml --patches 1000000000
  zone 2 "patches.*16x32" dimdis room.zone.toml --patches 100000x100000
  zone 4 "GiB.*fewer --patches" dimdis room.zone.toml --cell 0.01 --patches 10000000
  # Told from the surfaces' areas, before any cell is made.
  zone 4 "ray network of [0-9]+ cells x 1000000 patches.*fewer --patches" dimdis room.zone.toml --cell 0.005 --patches 1000x1000
  zone 4 "GiB.*--point-patches" dimdis room.zone.toml --set plane.workplane.spacing=0.005 --point-patches 10000000
}

@test "absurd measuring points" {
  zone 3 "spacing.*points.*give a larger spacing" dimdis room.zone.toml --set plane.workplane.spacing=1e-9
  zone 3 "grid must be" dimdis room.zone.toml --set 'plane.workplane.grid=[100000000,3]'
  zone 3 "points, at most" dimdis room.zone.toml --set 'plane.workplane.grid=[10000,10000]'
}

@test "absurd arrays of luminaires" {
  refused 3 "count must be 1 to 10000, not 100000" dimray room.rays room.lights.toml -o x.lum --set 'luminaire.P.count=[100000,100000]'
  refused 3 "makes 100000000 luminaires; a file has at most" dimray room.rays room.lights.toml -o x.lum --set 'luminaire.P.count=[10000,10000]'
  refused 3 "count must be" dimray room.rays room.lights.toml -o x.lum --set 'luminaire.P.count=[0,1]'
  refused 3 "count must be" dimray room.rays room.lights.toml -o x.lum --set 'luminaire.P.count=[-1,1]'
  refused 3 "count" dimray room.rays room.lights.toml -o x.lum --set 'luminaire.P.count=[1.5,1]'
}

@test "absurd pictures" {
  refused 2 "WIDTHxHEIGHT within 1\.\.32768" dimout image room.lum -o x.png --size 1000000x1000000
  refused 2 "samples" dimout image room.lum -o x.png --samples 1000
  # Within the format's limits and beyond this process's memory.
  (ulimit -v 4000000; refused 4 "a picture of 32768 x 32768 pixels needs .* GiB.*use a smaller --size" dimout image room.lum -o x.png --size 32768x32768)
}

@test "a million copies" {
  {
    cat room.zone.toml
    printf '[[copy]]\nof = "desk"\nnames = ['
    seq -f '"d%.0f",' 1000000 | tr -d '\n'
    printf ']\nby = ['
    yes '[0.1,0,0],' 2> /dev/null | head -1000000 | tr -d '\n'
    printf ']\n'
  } > million.toml
  zone 3 "million.toml:[0-9]+:[0-9]+: 'd[0-9]+' is one too many: a zone has at most 100000 surfaces" dimdis million.toml
}

@test "ten thousand copies at one place" {
  {
    cat room.zone.toml
    printf '[[copy]]\nof = "desk"\nnames = ['
    seq -f '"d%.0f",' 10000 | tr -d '\n'
    printf ']\nby = ['
    yes '[0.1,0,0],' 2> /dev/null | head -10000 | tr -d '\n'
    printf ']\n'
  } > pile.toml
  zone 3 "pile.toml:[0-9]+:[0-9]+: .*lie on top of each other" dimdis pile.toml
}

@test "tables nested a million deep" {
  { printf 'dim = "zone/1"\na'; yes '.a' 2> /dev/null | head -1000000 | tr -d '\n'; printf ' = 1\n'; } > deep.toml
  zone 3 "deep.toml:2:[0-9]+: key nested" dimdis deep.toml
  { printf 'dim = "zone/1"\na = '; head -c 1000000 /dev/zero | tr '\0' '['; } > deep.toml
  zone 3 "deep.toml:2:[0-9]+" dimdis deep.toml
}

@test "little memory: refused beforehand with the size needed and the option that helps" {
  refused 4 "needs [0-9.]+ GiB, [0-9.]+ GiB are free; use a larger --cell or fewer --patches" \
    bash -c 'ulimit -v 300000; exec dimdis room.zone.toml --cell 0.02 -o x.rays'
  refused 4 "need [0-9.]+ GiB .* free; use a larger --cell" \
    bash -c 'ulimit -v 300000; exec dimdis room.zone.toml --cell 0.002 -o x.rays'
  refused 4 "need [0-9.]+ GiB, [0-9.]+ GiB are free; use --combine group" \
    bash -c 'ulimit -v 300000; exec dimray room.rays room.lights.toml --set "luminaire.P.count=[100,100]" --set "luminaire.P.pitch=[0.02,0.01]" -o x.lum'
}

@test "too little memory even to start the work: status 4, one line, no crash" {
  for kib in 60000 80000 100000 130000 160000 200000; do
    status=0
    bash -c "ulimit -v $kib; exec timeout -k 1 20 dimdis room.zone.toml --cell 0.05 --patches 32x64 -o x.rays" 2> err || status=$?
    echo "$kib KiB: $status $(cat err)"
    # Below what the shared libraries need the loader refuses with 127.
    [ "$status" -eq 4 ] || [ "$status" -eq 127 ] || { [ "$status" -eq 0 ] && rm x.rays; }
    no_trace
  done
}
