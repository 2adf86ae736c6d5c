#pragma once

#include <optional>
#include <string>

/// Files to begin with: a bare room as a commented zone file and a regular grid of luminaires for it, both
/// meant to be changed by hand.
namespace dim {

/// Inner measures of a room, m, all above 0. The floor's south-west corner is the origin; x runs along the
/// length, y along the width.
struct StarterRoom {
  /// A second leg of the same height, which makes the plan an L: it begins at the west end of the north
  /// wall, `along_x_m` (less than the room's) wide, and reaches `along_y_m` further north.
  struct Leg {
    double along_x_m = 0.0;
    double along_y_m = 0.0;
  };

  double along_x_m = 0.0;
  double along_y_m = 0.0;
  double height_m = 0.0;
  std::optional<Leg> leg;
  std::string command;  ///< that asked for it, for the first line of both files
};

/// Zone file: finishes of reflectance 0.2 (floor), 0.5 (walls) and 0.7 (ceiling), as EN 12464-1 takes them
/// for granted; a work plane at 0.8 m, 0.5 m off the walls (in low and narrow rooms half the height and a
/// quarter of the narrowest side), its points as far apart as EN 12464-1 allows; a view from the south-west
/// corner. Cells are at most 0.25 m and a twentieth of the diagonal, larger where the room would have over
/// 5000.
std::string starter_zone(const StarterRoom& room);

/// Lights file: Lambertian panels in a grid over each part of the plan, at most 1.2 times their height above
/// the work plane apart (and at most 20 in a row), of the flux that gives about 500 lx on the work plane.
std::string starter_lights(const StarterRoom& room);

}  // namespace dim
