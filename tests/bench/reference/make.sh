#!/bin/sh
# Makes the reference results again: make.sh [PROGRAM]. Needed whenever a scene or a fitting changes.
set -e
root=$(cd "$(dirname "$0")/../../.." && pwd)
program=$(realpath "${1:-$root/build/release/bin/reference_tracer}")
cd "$root"
run() {  # name of the results, scene, options
  name=$1 scene=$2
  shift 2
  nice -n 10 "$program" "$scene.zone.toml" "$scene.lights.toml" --db db --threads 2 "$@" \
    >"tests/bench/reference/$name.csv.new"
  mv "tests/bench/reference/$name.csv.new" "tests/bench/reference/$name.csv"
}
for name in ${SCENES:-cube office office-black-bodies classroom openplan corridor}; do
  case $name in
    cube) run cube examples/01-cube/cube --samples 262144 ;;
    office) run office examples/02-office/office --samples 131072 ;;
    office-black-bodies) run office-black-bodies examples/02-office/office --samples 524288 --bodies ;;
    classroom) run classroom tests/bench/scenes/classroom --samples 65536 ;;
    openplan) run openplan tests/bench/scenes/openplan --samples 49152 --strata 6 ;;
    corridor) run corridor tests/bench/scenes/corridor --samples 6000000 ;;
  esac
done
