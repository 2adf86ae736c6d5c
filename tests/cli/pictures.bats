#!/usr/bin/env bats
# Pictures of the room: tones, what is said of them, and files that other programs read.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

@test "Stevens' tone says what the eye is adapted to, and shows more light brighter" {
  run --separate-stderr dimout image room.lum --samples 1 --tone stevens -o p.png
  echo "$stderr"
  [[ "$stderr" =~ "eye adapted to "([0-9.]+)" cd/m2, screen of 100 cd/m2; 0 pixels brighter" ]]
  adapted=${BASH_REMATCH[1]}
  run --separate-stderr dimout image room.lum --samples 1 --tone stevens --mix panels=1000 --mix spot=1000 -o q.png
  echo "$stderr"
  [[ "$stderr" =~ "eye adapted to "([0-9.e+]+)" cd/m2, screen of 100 cd/m2; "[1-9][0-9]*" pixels brighter" ]]
  awk "BEGIN { exit !(($adapted * 1000 / ${BASH_REMATCH[1]} - 1)^2 < 0.0001) }"
  ! cmp -s p.png q.png
  dimout image room.lum -q --samples 1 --tone stevens --screen-white 1000 -o q.png
  ! cmp -s p.png q.png
}

@test "a screen without light is refused" {
  refused 2 "screen-white.*greater than 0" dimout image room.lum --tone stevens --screen-white 0 -o x.png
  refused 2 "screen-white" dimout image room.lum --tone stevens --screen-white nan -o x.png
  refused 2 "tone" dimout image room.lum --tone steven -o x.png
}

@test "colours that the display does not have are counted, greys are not" {
  dimout image room.lum -q --samples 1 -o p.png
  for tone in linear stevens; do
    run --separate-stderr dimout image room.lum --samples 1 --tone $tone -o p.png
    echo "$stderr"
    [[ "$stderr" == *" 0 outside the display's colours"* ]]
  done
  # Light of almost one wavelength beside white light.
  dimray room.rays room.lights.toml -q -o lit.lum --set 'luminaire.spot.spectrum=[[515,0],[520,1],[525,0]]'
  for tone in linear stevens; do
    run --separate-stderr dimout image lit.lum --samples 1 --tone $tone --mix spot=20 -o p.png
    echo "$stderr"
    [[ "$stderr" =~ " "([1-9][0-9]*)" outside the display's colours" ]]
    [ "${BASH_REMATCH[1]}" -le $((64 * 48)) ]
  done
}

@test "a room under sodium light has a picture in every format" {
  sodium='[[579,0],[589,1],[599,0]]'
  dimray room.rays room.lights.toml -q -o lit.lum --set "luminaire.P.spectrum=$sodium" --set "luminaire.spot.spectrum=$sodium"
  for file in p.png p.exr; do
    run --separate-stderr dimout image lit.lum --samples 1 -o $file
    echo "$stderr"
    [ "$status" -eq 0 ]
    [[ "$stderr" == *"too strongly coloured to be shown as white"* ]]
  done
  dimout image lit.lum --samples 1 --tone stevens -o p.png
  dimout image lit.lum --samples 1 -o p.hdr
}

@test "spectra are refused for files that cannot hold them" {
  refused 2 "spectral.*must end in .exr" dimout image room.lum --spectral -o x.png
  refused 2 "spectral.*must end in .exr" dimout image room.lum --spectral -o x.hdr
}

@test "OpenEXR's own program reads the pictures" {
  command -v exrheader > /dev/null || skip "exrheader is not installed (Debian: openexr)"
  dimout image room.lum -q --samples 1 -o p.exr
  exrheader p.exr > header
  cat header
  for line in '    R, 32-bit floating-point' '    luminance.Y, 32-bit floating-point' 'unit (type string): "cd/m2"' \
    'whiteLuminance (type float): 1' 'dataWindow (type box2i): (0 0) - (63 47)'; do
    grep -qF "$line" header
  done
}
