#!/usr/bin/env bats
# What cmake --install brings, and that it works from where it is put.

setup() { load common; cd "$BATS_TEST_TMPDIR"; }

@test "an installed tree holds programs, database, documents and examples, and can be moved" {
  cmake --install "$DIM_BIN/.." --prefix "$PWD/there" > log
  mv there "here it is"
  export PATH="$PWD/here it is/bin:$PATH"
  [ "$(command -v dimdbm)" = "$PWD/here it is/bin/dimdbm" ]
  for file in README.md LICENSES.md docs/zone-and-lights.md docs/office.png db/fittings/troffer-3600.toml examples/01-cube/run.sh; do
    [ -e "here it is/share/dim/$file" ]
  done
  dimdbm show troffer-3600 --json > /dev/null
  dimdbm plot troffer-3600 -o t.png --quiet   # the picture module
  dimdis --help | grep -q "File formats: .*here it is/share/dim/docs"
  [ -d "$(dimdis --help | sed -n 's/.*formats.md in //p')" ]
  "here it is/share/dim/examples/01-cube/run.sh" out | grep -q "rho 0.5"
}

@test "an example writes where it can when its own folder is read-only" {
  [ "$(id -u)" -ne 0 ] || skip "root may write everywhere"
  cp -r "$DIM_SOURCE/examples/01-cube" .
  chmod 500 01-cube
  01-cube/run.sh
  [ -e dim-01-cube/cube.lum ]
}

@test "every licence of what is linked is listed" {
  for package in $(sed -n '/^packages=(/,/^)/p' "$DIM_SOURCE/tools/setup" | tr ' ' '\n' | grep -E '^lib|json3|fonts'); do
    grep -q "$package" "$DIM_SOURCE/LICENSES.md" || { echo "$package"; false; }
  done
}
