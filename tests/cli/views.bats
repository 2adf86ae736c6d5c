#!/usr/bin/env bats
# Views of every kind: pictures, line drawings, and Radiance's words for them.

setup_file() {
  load common
  make_room '
[[view]]
name = "plan"
kind = "plan"
eye = [2,1.5,2.4]
focus = [2,1.5,0]
width = 8
size = [80,60]

[[view]]
name = "level"
kind = "elevation"
eye = [2,0.2,1]
focus = [2,2,1]
size = [80,60]

[[view]]
name = "fish"
kind = "fisheye"
eye = [2,1.5,1.2]
focus = [3,1.5,1.2]
size = [64,64]

[[view]]
name = "hemi"
kind = "hemispherical"
eye = [2,1.5,1.2]
focus = [3,1.5,1.2]
size = [64,64]'
}
setup() { load common; enter_copy; }

@test "a Radiance picture says how its view is projected" {
  header() { dimout image room.lum -q --samples 1 --view "$1" -o x.hdr; sed '/^$/q' x.hdr | grep -a '^VIEW='; rm x.hdr; }
  [[ "$(header door)" == "VIEW= -vtv -vp 0.3 0.3 1.6 "*" -vh 70 -vv "* ]]
  [ "$(header plan)" = "VIEW= -vtl -vp 2 1.5 2.4 -vd 0 0 -1 -vu 0 1 0 -vh 8 -vv 6" ]
  [[ "$(header level)" == "VIEW= -vtl -vp 2 0.2 1 -vd 0 1 0 -vu 0 0 1 -vh "* ]]
  [ "$(header fish)" = "VIEW= -vta -vp 2 1.5 1.2 -vd 1 0 0 -vu 0 0 1 -vh 180 -vv 180" ]
  [ "$(header hemi)" = "VIEW= -vth -vp 2 1.5 1.2 -vd 1 0 0 -vu 0 0 1 -vh 180 -vv 180" ]
}

@test "every kind of view is drawn in light and in false colour" {
  for view in plan level fish hemi; do
    dimout image room.lum -q --view $view -o $view.png
    dimout image room.lum -q --view $view --tone falsecolour --shade gather -o $view-lux.png
    [ -s $view.png ] && [ -s $view-lux.png ]
  done
  ! cmp -s fish.png hemi.png
}

@test "a line drawing of a plan is to scale" {
  dimdis draw room.zone.toml --view plan -o plan.svg
  dimdis draw room.zone.toml --view level -o level.svg
  grep -q '<svg' plan.svg
  ! cmp -s plan.svg level.svg
}

@test "round views are not drawn in lines, and are square" {
  refused 2 "view 'fish' is of kind fisheye" dimdis draw room.zone.toml --view fish -o x.svg
  refused 2 "view 'hemi' is of kind hemispherical" dimdis draw room.zone.toml --view hemi -o x.svg
  refused 2 "view 'fish' is round" dimout image room.lum --view fish --size 64x48 -o x.png
  dimout image room.lum -q --view fish --size 32x32 -o y.png
}

@test "a kind that there is not is refused with the nearest" {
  sed -i 's/"hemispherical"/"hemisphericl"/' room.zone.toml
  refused 3 "kind must be one of.*did you mean 'hemispherical'" dimdis check room.zone.toml
}
