#!/bin/sh
# Makes the reference results again: make.sh [PROGRAM]. Needed whenever a scene or a fitting changes.
set -e
root=$(cd "$(dirname "$0")/../../.." && pwd)
program=$(realpath "${1:-$root/build/release/bin/reference_tracer}")
cd "$root"
run() {  # name, folder, options
  name=$1 folder=$2
  shift 2
  nice -n 10 "$program" "$folder/$name.zone.toml" "$folder/$name.lights.toml" --db db --threads 2 "$@" \
    >"tests/bench/reference/$name.csv.new"
  mv "tests/bench/reference/$name.csv.new" "tests/bench/reference/$name.csv"
}
for name in ${SCENES:-cube office classroom openplan corridor}; do
  case $name in
    cube) run cube examples/01-cube --samples 262144 ;;
    office) run office examples/02-office --samples 131072 ;;
    classroom) run classroom tests/bench/scenes --samples 65536 ;;
    openplan) run openplan tests/bench/scenes --samples 49152 --strata 6 ;;
    corridor) run corridor tests/bench/scenes --samples 6000000 ;;
  esac
done
