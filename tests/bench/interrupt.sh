#!/usr/bin/env bash
# How long Ctrl-C takes to end a program, ms, at several moments of its work, as CSV. Run by hand on a quiet machine; not a test.
set -euo pipefail
cd "$(dirname "$0")/../.."
PATH=$PWD/build/release/bin:$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp tests/data/cli/* "$work"
cd "$work"
dimdis room.zone.toml -q -o room.rays
dimray room.rays room.lights.toml -q -o room.lum
dimdis room.zone.toml -q --cell 0.08 --patches 16x32 -o more.rays

measure() { # NAME COMMAND...
  local name=$1 after child start took
  shift
  for after in 0.1 0.2 0.4 0.8 1.6 3.2 6.4; do
    env --default-signal=INT "$@" -q 2> /dev/null &
    child=$!
    sleep $after
    kill -0 $child 2> /dev/null || { rm -f x.*; break; }
    start=$(date +%s%N)
    kill -INT $child
    wait $child || true
    took=$((($(date +%s%N) - start) / 1000000))
    echo "$name,$after,$took,$(find . -name 'x.*' -o -name '.*.tmp' | wc -l)"
    rm -f x.*
  done
}

echo "command,after_s,ends_after_ms,files_left"
measure dimdis dimdis room.zone.toml --cell 0.05 --patches 32x64 -o x.rays
measure dimray dimray more.rays room.lights.toml --set 'luminaire.P.count=[20,20]' --set 'luminaire.P.pitch=[0.05,0.05]' \
  --tolerance 1e-12 -o x.lum
measure image dimout image room.lum --size 8000x6000 --samples 1 --shade cell -o x.png
measure image-exr dimout image room.lum --size 8000x6000 --samples 1 --shade cell -o x.exr
measure image-gather dimout image room.lum --size 2000x1500 --samples 4 --shade gather -o x.png
