#!/usr/bin/env bats
# Ray networks and luminance databases that are missing, damaged, of another kind or newer. Programs refuse them with
# one line and status 4 (error.hpp: a file that is not one of ours), and write nothing.

setup_file() {
  load common
  make_room
  cd "$ROOM"
  printf '\211PNG\r\n\032\n' > picture.png
  head -c 3000 /dev/urandom >> picture.png
}
setup() { load common; enter_copy; }

# `each WORDS FILE`: both programs refuse FILE in place of their own.
rays() { refused 4 "$1" dimray "$2" room.lights.toml -o x.lum; one_line; }
lum() { refused 4 "$1" dimout grid "$2" -o x.csv; one_line; }
one_line() { [ "${#stderr_lines[@]}" -eq 1 ]; }

@test "missing, a folder, empty, text, a picture" {
  mkdir folder
  : > empty
  for kind in rays lum; do
    $kind "nothing: cannot read: No such file" nothing
    $kind "folder: is a directory" folder
    $kind "empty: is empty; expected a .*\(.$kind\)" empty
    $kind "room.zone.toml: is a text file; expected a .*\(.$kind\)" room.zone.toml
    $kind "picture.png: is not a DIM file; expected a .*\(.$kind\)" picture.png
  done
}

@test "not readable" {
  [ "$(id -u)" -ne 0 ] || skip "root may read everything"
  chmod 0 room.rays room.lum
  rays "Permission denied" room.rays
  lum "Permission denied" room.lum
}

@test "one of our files for the other" {
  rays "room.lum: is a luminance database \(.lum\); expected a ray network" room.lum
  lum "room.rays: is a ray network \(.rays\); expected a luminance database" room.rays
}

@test "cut short anywhere" {
  for kind in rays lum; do
    size=$(stat -c %s room.$kind)
    for at in 1 9 10 100 511 512 513 600 2048 $(seq 3000 $((size / 8)) $((size - 1))) $((size - 1)); do
      head -c "$at" room.$kind > cut
      $kind "cut: is cut short: holds $at of " cut
    done
  done
}

@test "longer than it should be" {
  for kind in rays lum; do
    cp room.$kind long
    echo >> long
    $kind "long: is altered" long
  done
}

@test "any byte changed" {
  for kind in rays lum; do
    size=$(stat -c %s room.$kind)
    for at in 0 5 12 30 60 100 513 520 600 $(seq 1000 $((size / 8)) $((size - 1))) $((size - 1)); do
      cp room.$kind flipped
      flip flipped "$at"
      $kind "flipped: is (altered|not a DIM file|a text file)" flipped
    done
  done
}

# The header of a file with another line in place of one, its own checksum put right.
with_header() {
  local file=$1 edit=$2 text
  text=$(head -c 512 "$file" | tr -d '\0' | grep -av '^head ' | sed "$edit")$'\n'
  {
    printf '%s' "$text"
    printf 'head %s\n' "$(printf '%s' "$text" | xxhsum -H3 - | awk '{ print $NF }' | sed 's/^XXH3_//')"
  } > header
  truncate -s 512 header
  { cat header; tail -c +513 "$file"; } > edited
}

@test "a newer version, another kind, absurd sizes, with a header that is otherwise right" {
  command -v xxhsum > /dev/null || skip "no xxhsum to sign a header with"
  [ "$(head -c 512 room.rays | tr -d '\0' | sed -n 's/^size //p')" -eq "$(stat -c %s room.rays)" ] || skip "another header"
  for kind in rays lum; do
    with_header room.$kind 's/^kind/kind/'
    cmp room.$kind edited || skip "xxhsum signs differently here"
    with_header room.$kind 's/^version .*/version 9/'
    $kind "edited: written by DIM [0-9.]+ in format 9, this program reads 2; use" edited
    with_header room.$kind 's/^version .*/version 1/;/^program/d'
    $kind "edited: written in format 1, this program reads 2; make it again with this dim(dis|ray)$" edited
    with_header room.$kind 's/^kind .*/kind other/'
    $kind "edited: is a DIM file of kind 'other'; expected" edited
    with_header room.$kind 's/^size .*/size 9000000000000000000/'
    $kind "edited: is cut short" edited
    $kind "standard input: is cut short" - < edited
    with_header room.$kind 's/^size .*/size -5/'
    $kind "edited: is altered" edited
  done
}

@test "1 GiB of zeros or of one line is refused at once" {
  truncate -s 1G big
  for kind in rays lum; do $kind "big: is not a DIM file" big; done
  refused 4 "standard input: is a text file" bash -c 'head -c 1G /dev/zero | tr "\0" a | dimray - room.lights.toml -o x.lum'
}
