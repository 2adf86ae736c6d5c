#!/usr/bin/env bats
# The database program: what it adds it shows, what is there it does not replace unasked.

setup() {
  load common
  cd "$BATS_TEST_TMPDIR"
  cp "$DIM_SOURCE"/tests/data/photometry/{axial.ies,quadrilateral.ies,ldt_isym2.ldt,tilt_file.ies,lamp.tlt,bad_truncated_candelas.ies,bad_ldt_nan.ldt} .
  printf 'wavelength_nm,R\n400,12\n550,35\n700,60\n' > wood.csv
}

@test "list shows every entry, as text, CSV and JSON" {
  run -0 dimdbm list
  [[ "${lines[0]}" == name*kind*lm*source ]]
  [[ "$output" == *troffer-3600*fitting*3600* ]]
  [[ "$output" == *paint-white-matt*opaque*0.84* ]]
  run -0 dimdbm list --csv --kind fittings
  [ "${lines[0]}" = "name,kind,flux_lm,max_intensity_cd,watts,reflectance_or_transmittance,cct_K,colour,source" ]
  [ "$(dimdbm list --json | grep -c '"name":')" -ge 27 ]
}

@test "show --json has the keys that scripts rely on" {
  dimdbm show troffer-3600 --json > f.json
  for key in flux_lm declared_flux_lm max_intensity_cd photometric_type symmetry opening_m watts spectrum; do
    grep -q "\"$key\":" f.json
  done
  dimdbm show paint-white-matt --json > s.json
  for key in kind luminous_reflectance specular roughness cie_x cie_y; do grep -q "\"$key\":" s.json; done
  dimdbm show ldt_isym2.ldt --json | grep -q '"symmetry": "bilateral 0-180"'
  dimdbm show - --json < axial.ies | grep -q '"photometric_type": "C"'
}

@test "what is added is found, and not replaced without --force" {
  dimdbm add axial.ies --db mine --name lamp --spectrum led-4000 --watts 21 --quiet
  [ -z "$(find mine -name '.*.tmp')" ]
  cmp axial.ies mine/fittings/lamp.ies
  dimdbm show lamp --db mine --json | grep -q '"watts": 21.0'
  cp mine/fittings/lamp.toml before
  refused 3 "lamp.ies: exists already: nothing was added" dimdbm add axial.ies --db mine --name lamp --watts 30
  cmp before mine/fittings/lamp.toml
  dimdbm add axial.ies --db mine --name lamp --watts 30 --force --quiet
  dimdbm show lamp --db mine --json | grep -q '"watts": 30.0'
  dimdbm add ldt_isym2.ldt --db mine --name lamp --force --quiet
  [ "$(ls mine/fittings | tr '\n' ' ')" = "lamp.ldt lamp.toml " ]
  dimdbm remove lamp --db mine --quiet
  [ -z "$(ls mine/fittings)" ]
}

@test "a spectrum becomes a surface, per cent and nm found" {
  dimdbm add wood.csv --db mine --quiet
  grep -q 'diffuse = \[' mine/surfaces/wood.toml
  dimdbm show wood --db mine --json | grep -q '"luminous_reflectance": 0.3[3-9]'
  dimdbm check --db mine
  dimdbm export wood --db mine --format toml | cmp - mine/surfaces/wood.toml
}

@test "an entry is added with the file it names, under another name too" {
  printf 'file = "ldt_isym2.ldt"\nwatts = 12\nsource = "s"\n' > e.toml
  dimdbm add e.toml --db mine --name other --quiet
  cmp ldt_isym2.ldt mine/fittings/other.ldt
  dimdbm show other --db mine --json | grep -q '"watts": 12.0'
}

@test "lamp tilt in another file comes along" {
  dimdbm add tilt_file.ies --db mine --quiet
  grep -q TILT=INCLUDE mine/fittings/tilt_file.ies
  dimdbm check --db mine
}

@test "export goes round: ies to ldt and back" {
  dimdbm export quadrilateral.ies -o a.ldt --quiet
  dimdbm export a.ldt -o b.ies --quiet
  dimdbm export b.ies -o b.ldt --quiet
  a=$(dimdbm show quadrilateral.ies --json --quiet | grep -E '"(flux_lm|max_intensity_cd)"')
  b=$(dimdbm show b.ldt --json --quiet | grep -E '"(flux_lm|max_intensity_cd)"')
  paste <(tr -dc '0-9.\n' <<< "$a") <(tr -dc '0-9.\n' <<< "$b") | awk '{ if ($1 / $2 > 1.000001 || $1 / $2 < 0.999999) exit 1 }'
}

@test "plots are SVG or PNG" {
  dimdbm plot troffer-3600 -o t.svg
  grep -q '</svg>' t.svg
  dimdbm plot paint-white-matt -o - | grep -q '</svg>'
  dimdbm plot ldt_isym2.ldt -o t.png
  [ "$(head -c 4 t.png | tail -c 3)" = PNG ]
  refused 2 "must end in .svg or .png" dimdbm plot troffer-3600 -o x.jpg
}

@test "check says what is wrong and ends with 1" {
  mkdir -p mine/fittings
  printf 'file = "gone.ies"\nsource = "s"\n' > mine/fittings/a.toml
  cp axial.ies mine/fittings
  printf 'file = "axial.ies"\n' > mine/fittings/b.toml
  printf 'file = "axial.ies"\nsource = "s"\nspectrum = "led-40000"\n' > mine/fittings/c.toml
  run -1 dimdbm check --db mine
  echo "$output"
  [[ "$output" == *"a: mine/fittings/a.toml:1:8: "*gone.ies* ]]
  [[ "$output" == *"b: no source is named"* ]]
  [[ "$output" == *"c: "*led-40000* ]]
  [[ "$output" == *"3 entries, 3 with a problem"* ]]
}

@test "damaged files and unknown names are refused in a line" {
  refused 3 "bad_truncated_candelas.ies:11: the file ends after 6 of 12" dimdbm add bad_truncated_candelas.ies --db mine
  refused 3 "bad_ldt_nan.ldt:51:1: intensity 4 of 4: 'nan'" dimdbm show bad_ldt_nan.ldt
  refused 3 "no entry 'trofer-3600'" dimdbm show trofer-3600
  refused 3 "did you mean 'troffer-3600'" dimdbm plot trofer-3600 -o x.svg
  refused 3 "no entry 'none'" dimdbm remove none --db .
  refused 4 "gone.ies" dimdbm show gone.ies
  refused 2 "not a safe file name" dimdbm add axial.ies --db mine --name ../x
  refused 3 "led-4OOO" dimdbm add axial.ies --db mine --spectrum led-4OOO
  refused 3 "no intensities" dimdbm export paint-white-matt -o x.ies
  [ ! -e mine ] || [ -z "$(find mine -type f)" ]
}

@test "a lamp's spectrum is added, shown, plotted, listed and lights a luminaire" {
  printf 'nm;W\n380;-0,1\n480;40\n580;90\n680;30\n780;0\n' > own.csv
  dimdbm add own.csv --kind lamp --db mine --quiet
  grep -q '^power = \[' mine/spectra/own.toml
  [ "$(dimdbm show own --db mine --json | jq '.kind == "spectrum" and .peak_nm == 580')" = true ]
  dimdbm list --db mine --kind spectra | grep -q '^own .*spectrum'
  dimdbm plot own --db mine -o own.svg --quiet
  grep -q 'relative power' own.svg
  dimdbm add axial.ies --db mine --spectrum own --quiet
  dimdbm check --db mine
  # To 2 K: a lamp's figures come from sums every 5 nm, a fitting's from the whole curve.
  jq -n --argjson a "$(dimdbm show axial --db mine --json | jq .cct_K)" --argjson b "$(dimdbm show own --db mine --json | jq .cct_K)" \
    -e '$a - $b | . * . < 4' > /dev/null
  dimdbm export own --db mine --format toml | cmp - mine/spectra/own.toml
  refused 3 "'led-4000' is a spectrum that DIM knows by itself" dimdbm add own.csv --kind lamp --name led-4000 --db mine
  refused 3 "no visible light" dimdbm add <(printf '380 0\n780 0\n') --kind lamp --name dark --db mine
  dimdbm remove own --db mine --quiet
  refused 1 "" dimdbm check --db mine -o y.txt
}

@test "spectra that DIM knows are listed, shown and plotted" {
  [ "$(dimdbm list --kind spectra --json | jq 'map(select(.name == "cie-a")) | .[0].cct_K | round')" = 2856 ]
  dimdbm show fl-11 --json | jq -e '.ra > 82 and .ra < 84 and .kind == "spectrum"'
  dimdbm plot led-4000 -o - | grep -q '4000 K'
}

@test "spectra in XML: TM-27, and that of a TM-33 file" {
  printf '<IESTM2714><Header><Description>lamp</Description></Header><SpectralDistribution>
    <SpectralData wavelength="400">1</SpectralData><SpectralData wavelength="500">3</SpectralData>
    <SpectralData wavelength="600">2</SpectralData></SpectralDistribution></IESTM2714>' > lamp.spdx
  dimdbm add lamp.spdx --db mine --quiet
  dimdbm show lamp --db mine --json | jq -e '.title == "lamp" and .peak_nm == 500'
  dimdbm add "$DIM_SOURCE/tests/data/photometry/tm33_18.xml" --kind lamp --name own --db mine --quiet
  dimdbm show own --db mine --json | jq -e '.peak_nm == 500'
}

@test "a TM-33 file is shown and added with its spectrum, and exported" {
  cp "$DIM_SOURCE/tests/data/photometry/tm33_18.xml" panel.xml
  dimdbm show panel.xml --json | jq -e '.format == "TM-33-18" and .watts == 9.5 and .spectrum == "table" and (.flux_lm | round) == 785'
  dimdbm add panel.xml --db mine --quiet
  cmp panel.xml mine/fittings/panel.xml
  dimdbm show panel --db mine --json | jq -e '.cct_K > 1000'
  run --separate-stderr dimdbm export panel --db mine -o panel.ies
  [[ "$stderr" == *"the spectrum is not written"* ]]
  dimdbm show panel.ies --json | jq -e '(.flux_lm | round) == 785 and .manufacturer == "Wörk & Söhne"'
}

@test "a fitting is exported as new, its factors as keywords; --as-used multiplies them in" {
  dimdbm add axial.ies --db mine --lumens 1000 --lamp-factor 0.9 --maintenance-factor 0.8 --quiet
  dimdbm show axial --db mine --json | jq -e '(.flux_lm - 720) | fabs < 1e-9'
  dimdbm export axial --db mine -o new.ies
  grep -q '^\[_LAMP_FACTOR\] 0.9' new.ies
  grep -q '^\[_MAINTENANCE_FACTOR\] 0.8' new.ies
  dimdbm show new.ies --json | jq -e '(.flux_lm - 1000) | fabs < 1e-6'
  dimdbm export axial --db mine --as-used -o used.ies
  grep -q '^\[_APPLIED_MAINTENANCE_FACTOR\] 0.8' used.ies
  dimdbm show used.ies --json | jq -e '(.flux_lm - 720) | fabs < 1e-6'
  run --separate-stderr dimdbm export axial --db mine -o new.ldt
  [[ "$stderr" == *"EULUMDAT has no place for the lamp and maintenance factors of 0.72: written as new"* ]]
  dimdbm show new.ldt --quiet --json | jq -e '(.flux_lm - 1000) | fabs < 1e-6'
  refused 2 "would be replaced" dimdbm export axial --db mine -o mine/fittings/axial.ies
}

@test "names and texts that are no UTF-8 become valid JSON" {
  name=$(printf 'g\xff.ies')
  cp axial.ies "$name"
  dimdbm show "$name" --json | iconv -f UTF-8 -t UTF-8 > s.json
  jq -e '.name | startswith("g")' s.json
}

@test "a list without a database says so" {
  mkdir -p alone/bin
  cp "$DIM_BIN/dimdbm" alone/bin
  if [ -d /usr/local/share/dim/db ]; then skip "a database is installed"; fi
  refused 3 "there is no database: neither a folder db/ here nor an installed one" alone/bin/dimdbm list
  alone/bin/dimdbm list --kind spectra | grep -q cie-a
}

@test "options that change nothing are refused" {
  refused 2 "watts has no effect with a spectrum" dimdbm add wood.csv --watts 3 --db mine
  refused 2 "column has no effect with a photometric file" dimdbm add axial.ies --column 2 --db mine
  printf 'file = "axial.ies"\nsource = "s"\n' > e.toml
  refused 2 "title has no effect with an entry" dimdbm add e.toml --title x --db mine
  refused 2 "as-used has no effect" dimdbm export axial.ies --as-used --format toml
}

@test "two processes at once lose nothing" {
  for i in $(seq 1 12); do
    dimdbm add axial.ies --db mine --name "lamp-$i" --quiet &
    dimdbm add axial.ies --db mine --name same --watts "$i" --quiet 2> /dev/null &
  done
  wait
  [ "$(ls mine/fittings/*.toml | wc -l)" -eq 13 ]
  [ "$(ls mine/fittings/*.ies | wc -l)" -eq 13 ]
  dimdbm check --db mine
}
