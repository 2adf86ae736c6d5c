#!/usr/bin/env bats
# Outputs appear whole or not at all, and what was there before survives a failure.

setup_file() { load common; make_room; }
setup() { load common; enter_copy; }

# Waits until the temporary of the file named holds something, or the process has ended.
await_writing() {
  while kill -0 "$2" 2> /dev/null; do
    [ -z "$(find . -name ".$1.*.tmp" -size +0 2> /dev/null)" ] || return 0
  done
  return 1
}

@test "an existing file survives a failed run" {
  echo before > kept
  for attempt in "dimdis nothing.toml -o kept" "dimdis room.lights.toml -o kept" "dimray room.lum room.lights.toml -o kept" \
    "dimray room.rays room.zone.toml -o kept" "dimout grid room.rays -o kept" "dimout grid room.lum --plane none -o kept" \
    "dimout image room.lum --view none -o kept" "dimdis areas nothing.toml -o kept"; do
    run timeout -k 1 20 $attempt
    [ "$status" -ne 0 ]
    [ "$(cat kept)" = before ]
    no_trace
  done
}

@test "an existing file keeps its permissions, a link its place" {
  echo before > target
  chmod 640 target
  ln -s target link
  dimout grid room.lum -o link
  [ -L link ]
  [ "$(stat -c %a target)" = 640 ]
  [ "$(sed -n 1p target | cut -d, -f1)" = plane ]
}

@test "an output is refused beforehand when it cannot be written" {
  mkdir folder
  for command in "dimdis room.zone.toml" "dimray room.rays room.lights.toml" "dimout grid room.lum" "dimdis areas room.zone.toml"; do
    refused 4 "x/y: cannot write: there is no folder 'x'" $command -o x/y
    refused 4 "folder: cannot write: is a directory" $command -o folder
    refused 4 "room.lum/y: cannot write" $command -o room.lum/y
  done
  refused 4 "no folder" dimdis room.zone.toml -o x.rays --stats no/s.json
  refused 4 "no folder" dimdis room.zone.toml --patches 300x1000 -o no/x.rays
  [ "$(id -u)" -ne 0 ] || skip "root may write everywhere"
  chmod 500 folder
  refused 4 "Permission denied" dimdis room.zone.toml -o folder/x
}

@test "an output that is the input is refused" {
  cp room.zone.toml zone.copy
  refused 2 "room.zone.toml' would be replaced" dimdis room.zone.toml -o room.zone.toml
  refused 2 "would be replaced" dimdis room.zone.toml -o "$PWD/room.zone.toml"
  ln -s room.zone.toml link
  refused 2 "would be replaced" dimdis room.zone.toml -o link
  refused 2 "would be replaced" dimdis room.zone.toml -o x.rays --stats room.zone.toml
  refused 2 "would be replaced" dimdis room.zone.toml -o x.rays --stats ./x.rays
  cmp room.zone.toml zone.copy
  refused 2 "room.rays' would be replaced" dimray room.rays room.lights.toml -o room.rays
  refused 2 "room.lights.toml' would be replaced" dimray room.rays room.lights.toml -o room.lights.toml
  refused 2 "room.lum' would be replaced" dimout grid room.lum -o room.lum
  refused 2 "standard output" dimout surfaces room.lum --stats -
}

@test "disk full: status 4, one line, nothing left" {
  for command in "dimdis room.zone.toml --patches 64" "dimray room.rays room.lights.toml -q" "dimout grid room.lum" "dimdis areas room.zone.toml"; do
    run --separate-stderr bash -c "$command -o - > /dev/full"
    echo "$command: $status $stderr"
    [ "$status" -eq 4 ]
    [ "${#stderr_lines[@]}" -eq 1 ]
    [[ "$stderr" == *"standard output: cannot write: No space left on device" ]]
    refused 4 "/dev/full: cannot write: No space left on device" $command -o /dev/full
  done
  for program in dimdis dimray dimout dimdbm; do
    for words in --help --version; do
      refused 4 "$program: error: standard output: cannot write: No space left on device" bash -c "$program $words > /dev/full"
    done
  done
}

@test "a full file system: status 4, one line, the previous file whole" {
  mkdir small
  mount -t tmpfs -o size=256k none small 2> /dev/null || skip "no leave to mount a small file system"
  echo before > small/kept.rays
  run --separate-stderr dimdis room.zone.toml --patches 16x32 -o small/kept.rays
  left=$(ls -A small)
  words=$(cat small/kept.rays)
  umount small
  echo "$status $stderr; left: $left"
  [ "$status" -eq 4 ]
  [ "${#stderr_lines[@]}" -eq 1 ]
  [[ "$stderr" == *"small/kept.rays: cannot write: No space left on device" ]]
  [ "$left" = kept.rays ]
  [ "$words" = before ]
}

@test "a limit on file sizes: status 4, one line, nothing left" {
  refused 4 "x.rays: cannot write: File too large" bash -c 'ulimit -f 50; exec dimdis room.zone.toml -o x.rays'
  echo before > kept
  run bash -c 'ulimit -f 50; exec dimdis room.zone.toml -o kept'
  [ "$status" -eq 4 ]
  [ "$(cat kept)" = before ]
}

@test "kill -9 during a write leaves the previous file whole" {
  dimdis room.zone.toml -q -o big.rays
  sum=$(cksum < big.rays)
  killed=0
  for attempt in 1 2 3 4 5; do
    dimdis room.zone.toml -q --cell 0.1 --patches 16x64 -o big.rays &
    await_writing big.rays $! && kill -9 $! && killed=$((killed + 1))
    wait $! || true
    # Killed in time the file is the old one; too late, the new one, whole.
    [ "$(cksum < big.rays)" = "$sum" ] || dimray big.rays room.lights.toml -q -o all.lum
    [ "$killed" -lt 2 ] || break
  done
  [ "$killed" -gt 0 ] || skip "written too quickly to be killed meanwhile"
}

# Starts a command in the background as $child and waits until the words stand in its messages, or without words
# until it answers signals.
start() {
  local words=$1
  shift
  # A shell's background job ignores SIGINT: env puts it back.
  env --default-signal=INT,TERM "$@" 2> err &
  child=$!
  while kill -0 $child 2> /dev/null; do
    if [ -n "$words" ]; then
      ! grep -q "$words" err || return 0
    elif grep -q '^SigCgt:.*[2367abef]$' /proc/$child/status 2> /dev/null; then
      return 0
    fi
    sleep 0.01
  done
  cat err
  return 1
}

# It ends with status 130 and leaves no file. Only a hang is a matter of time here; tests/bench/interrupt.sh measures.
ends_at() {
  local status=0
  kill -"$1" $child
  timeout 60 tail --pid=$child -s 0.05 -f /dev/null || kill -9 $child
  wait $child || status=$?
  echo "status $status: $(cat err)"
  [ "$status" -eq 130 ]
  grep -q "error: interrupted; nothing was written" err
  no_trace
}

@test "Ctrl-C ends a long run with status 130 and no file" {
  for signal in INT TERM; do
    start cells: dimdis room.zone.toml -v --cell 0.05 --patches 100x100 -o x.rays
    ends_at $signal
  done
}

@test "Ctrl-C while dimray solves" {
  dimdis room.zone.toml -q --cell 0.08 --patches 16x32 -o more.rays
  start read: dimray more.rays room.lights.toml -v --set 'luminaire.P.count=[20,20]' --set 'luminaire.P.pitch=[0.05,0.05]' \
    --tolerance 1e-12 -o x.lum
  ends_at INT
}

@test "Ctrl-C while dimout makes room for a picture, draws it, and codes it" {
  start read: dimout image room.lum -v --size 8000x6000 --samples 16 -o x.png
  ends_at INT
  start read: dimout image room.lum -v --size 2000x1500 --samples 16 -o x.png
  sleep 0.5
  ends_at INT
  start render: dimout image room.lum -v --size 4000x3000 --samples 1 --shade cell -o x.png
  ends_at INT
}

@test "Ctrl-C while a result is written" {
  start rays: dimdis room.zone.toml -v --cell 0.05 --patches 32x64 -o x.rays
  ends_at INT
}

@test "Ctrl-C while a pipe is awaited" {
  mkfifo pipe
  start "" dimray pipe room.lights.toml -o x.lum
  ends_at INT
  sleep 60 > pipe &
  writer=$!
  start "" dimray pipe room.lights.toml -o x.lum
  ends_at INT
  kill $writer
  start "" dimout grid room.lum -o pipe
  ends_at INT
}
