#include "scene/zone_starter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/vec.hpp"
#include "scene/point_grid.hpp"

namespace dim {
namespace {

double narrowest_m(const StarterRoom& room) {
  const double side_m = std::min(room.along_x_m, room.along_y_m);
  return room.leg ? std::min({side_m, room.leg->along_x_m, room.leg->along_y_m}) : side_m;
}

double work_plane_height_m(const StarterRoom& room) { return std::min(0.8, room.height_m / 2.0); }

/// To two digits, which are enough for a figure that nobody asked for, towards 0.
double two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / unit + 1e-9) * unit;
}

/// Corners of the plan, `inset_m` within the walls, counter-clockwise seen from above.
std::vector<Vec2> plan(const StarterRoom& room, double inset_m) {
  const double west = inset_m, south = inset_m, east = room.along_x_m - inset_m,
               north = room.along_y_m - inset_m;
  if (!room.leg) return {{west, south}, {east, south}, {east, north}, {west, north}};
  const double leg_east = room.leg->along_x_m - inset_m, leg_north = north + room.leg->along_y_m;
  return {{west, south},     {east, south},         {east, north},
          {leg_east, north}, {leg_east, leg_north}, {west, leg_north}};
}

double plan_area_m2(const StarterRoom& room) {
  return room.along_x_m * room.along_y_m + (room.leg ? room.leg->along_x_m * room.leg->along_y_m : 0.0);
}

double cell_m(const StarterRoom& room) {
  constexpr double kMaxCells = 5000.0;
  const double leg_y_m = room.leg ? room.leg->along_y_m : 0.0;
  const double around_m = 2.0 * (room.along_x_m + room.along_y_m + leg_y_m);
  const double area_m2 = 2.0 * plan_area_m2(room) + around_m * room.height_m;
  const double diagonal_m = std::hypot(room.along_x_m, room.along_y_m + leg_y_m, room.height_m);
  return std::max(std::min(0.25, two_digits(diagonal_m / 20.0)), two_digits(std::sqrt(area_m2 / kMaxCells)));
}

double spacing_m(const StarterRoom& room, double inset_m) {
  const double leg_y_m = room.leg ? room.leg->along_y_m : 0.0;
  return two_digits(
      spacing_en12464_m({room.along_x_m - 2.0 * inset_m, room.along_y_m + leg_y_m - 2.0 * inset_m}));
}

std::string vertices(const std::vector<Vec2>& corners, double height_m) {
  std::string text;
  for (const Vec2& corner : corners)
    text += fmt::format("{}[{:.9g}, {:.9g}, {:.9g}]", text.empty() ? "" : ", ", corner.x, corner.y, height_m);
  return "[" + text + "]";
}

std::string surface(const std::string& name, const std::string& finish, const std::string& outline) {
  return fmt::format("[[surface]]\nname = \"{}\"\nfinish = \"{}\"\nvertices = {}\n\n", name, finish, outline);
}

std::string box_shell(const StarterRoom& room) {
  return fmt::format(
      R"([[room]]                        # the surfaces floor, ceiling, wall-s, wall-n, wall-w and wall-e
size = [{:.9g}, {:.9g}]
height = {:.9g}
floor = "floor"
walls = "wall"                  # wall-e = "…" beside it: a finish of that wall's own
ceiling = "ceiling"

)",
      room.along_x_m, room.along_y_m, room.height_m);
}

/// Walls are named by where they stand, the two at the inner corner by the leg whose end or side they are.
std::string l_shell(const StarterRoom& room) {
  const char* const names[] = {"wall-s", "wall-e", "wall-n", "leg-wall-e", "leg-wall-n", "wall-w"};
  const auto corners = plan(room, 0.0);
  const std::vector<Vec2> seen_from_below(corners.rbegin(), corners.rend());
  std::string text = "# Corners run counter-clockwise seen from inside the room.\n\n";
  text += surface("floor", "floor", vertices(corners, 0.0));
  text += surface("ceiling", "ceiling", vertices(seen_from_below, room.height_m));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &from = corners[i], &to = corners[(i + 1) % corners.size()];
    text += surface(names[i], "wall",
                    fmt::format("[[{0:.9g}, {1:.9g}, 0], [{0:.9g}, {1:.9g}, {4:.9g}], [{2:.9g}, {3:.9g}, "
                                "{4:.9g}], [{2:.9g}, {3:.9g}, 0]]",
                                from.x, from.y, to.x, to.y, room.height_m));
  }
  return text;
}

/// Lumens on the work plane for each lumen of Lambertian luminaires in the ceiling, by the room index: fitted
/// to solved rooms of these finishes, to 15 % of them at indices from 0.7 to 6.5.
double utilisation(const StarterRoom& room) {
  const double leg_y_m = room.leg ? room.leg->along_y_m : 0.0;
  const double half_around_m = room.along_x_m + room.along_y_m + leg_y_m;
  const double index = plan_area_m2(room) / (half_around_m * (room.height_m - work_plane_height_m(room)));
  return 1.2 * index / (index + 0.75);
}

/// The grid over one rectangle of the plan.
std::string panels(const StarterRoom& room, const std::string& name, const Vec2& corner, const Vec2& size) {
  constexpr double kWanted_lx = 500.0, kBelowCeiling_m = 0.01;
  const double reach_m = 1.2 * (room.height_m - work_plane_height_m(room));
  const auto count = [&](double side_m) { return std::clamp(std::ceil(side_m / reach_m), 1.0, 20.0); };
  const double nx = count(size.x), ny = count(size.y);
  const Vec2 pitch(size.x / nx, size.y / ny), first = corner + pitch / 2.0;
  const double opening_m = std::min(0.6, two_digits(std::min(pitch.x, pitch.y) / 2.0));
  const double flux_lm = kWanted_lx * pitch.x * pitch.y / utilisation(room);
  return fmt::format(R"([[luminaire]]                   # {0}[0,0] … {0}[{1},{2}]: {3} along x, {4} along y
name = "{0}"
ideal = "lambertian"            # or, in place of this line: fitting = "…", a file or a name of `dimdbm list`
lumens = {5:.9g}
opening = [{6:.9g}, {6:.9g}]
at = [{7:.9g}, {8:.9g}, {9:.9g}]
count = [{3}, {4}]
pitch = [{10:.9g}, {11:.9g}]

)",
                     name, nx - 1, ny - 1, nx, ny, std::round(flux_lm), opening_m, first.x, first.y,
                     room.height_m - kBelowCeiling_m, pitch.x, pitch.y);
}

std::string heading(const StarterRoom& room, const std::string& what) {
  return fmt::format(
      "# {}, made by `{}` and meant to be changed.\n# Lengths are in metres; x runs east, y north, z up. "
      "All that can be said here: docs/zone-and-lights.md\n",
      what, room.command);
}

}  // namespace

std::string starter_zone(const StarterRoom& room) {
  const double inset_m = std::min(0.5, narrowest_m(room) / 4.0), work_m = work_plane_height_m(room);
  const double eye_m = std::min(0.3, inset_m), eye_height_m = std::min(1.6, 0.8 * room.height_m);
  // Past an L's inner corner both legs are seen.
  const Vec2 focus =
      room.leg ? Vec2(room.leg->along_x_m, room.along_y_m) : Vec2(room.along_x_m, room.along_y_m) * 0.7;
  return heading(room, "A bare room") +
         fmt::format(R"(dim = "zone/1"
name = "room"
unit = "m"
cell = {:.9g}                     # target edge of the cells that surfaces are divided into

[finishes]                      # reflectances; or names of the database: dimdbm list
floor = 0.2
wall = 0.5
ceiling = 0.7

)",
                     cell_m(room)) +
         (room.leg ? l_shell(room) : box_shell(room)) +
         fmt::format(R"([[plane]]                       # where light is measured; it obstructs none
name = "workplane"
vertices = {}
spacing = {:.9g}

[[view]]                        # for dimout image --view corner
name = "corner"
eye = [{:.9g}, {:.9g}, {:.9g}]
focus = [{:.9g}, {:.9g}, {:.9g}]
fov = {}
)",
                     vertices(plan(room, inset_m), work_m), spacing_m(room, inset_m), eye_m, eye_m,
                     eye_height_m, focus.x, focus.y, room.height_m * 0.4, room.leg ? 90 : 75);
}

std::string starter_lights(const StarterRoom& room) {
  std::string text =
      heading(room, "Panels just below the ceiling, for about 500 lx") + "dim = \"lights/1\"\n\n";
  text += panels(room, "A", Vec2(0.0), {room.along_x_m, room.along_y_m});
  if (room.leg) text += panels(room, "B", {0.0, room.along_y_m}, {room.leg->along_x_m, room.leg->along_y_m});
  text.pop_back();
  return text;
}

}  // namespace dim
