# Files of the bench scenes by name; from the repository's folder.
zone_of() {
  case $1 in
    office) echo examples/02-office/office.zone.toml ;;
    sidelit) echo examples/06-daylight-factor/room.zone.toml ;;
    coloured) echo examples/03-coloured-room/room.zone.toml ;;
    lobe) echo examples/04-shine/lobe.zone.toml ;;
    *) echo "tests/bench/scenes/$1.zone.toml" ;;
  esac
}
lights_of() {
  local z; z=$(zone_of "$1")
  case $1 in
    sidelit) echo "${z%/*}/overcast.lights.toml" ;;
    *) echo "${z%.zone.toml}.lights.toml" ;;
  esac
}
