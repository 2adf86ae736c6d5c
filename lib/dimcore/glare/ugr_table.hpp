#pragma once

#include <array>
#include <vector>

#include "photometry/intensity.hpp"
#include "photometry/opening.hpp"

namespace dim {

/// A room of CIE 190, in units of the height H of the luminaires above the eye: x across the line of sight, y
/// along.
struct UgrRoom {
  int x_h = 2, y_h = 2;
};
inline constexpr std::array<UgrRoom, 19> kUgrRooms = {{{2, 2},
                                                       {2, 3},
                                                       {2, 4},
                                                       {2, 6},
                                                       {2, 8},
                                                       {2, 12},
                                                       {4, 2},
                                                       {4, 3},
                                                       {4, 4},
                                                       {4, 6},
                                                       {4, 8},
                                                       {4, 12},
                                                       {8, 4},
                                                       {8, 6},
                                                       {8, 8},
                                                       {8, 12},
                                                       {12, 4},
                                                       {12, 6},
                                                       {12, 8}}};

struct UgrReflectances {
  double ceiling = 0.7, walls = 0.5, floor = 0.2;
};
inline constexpr std::array<UgrReflectances, 5> kUgrReflectances = {
    {{0.7, 0.5, 0.2}, {0.7, 0.3, 0.2}, {0.5, 0.5, 0.2}, {0.5, 0.3, 0.2}, {0.3, 0.3, 0.2}}};

/// UGR of one room of the table, the luminaire at its own flux.
struct UgrEntry {
  UgrRoom room;
  UgrReflectances reflectances;
  double crosswise =
      0.0;  ///< line of sight across the longer side of the opening; of square ones along C0-C180
  double endwise = 0.0;  ///< along it
};

/// Tabular UGR of a luminaire after CIE 190:2010: luminaires a constant spacing apart all over the room, the
/// outer ones half of it from the walls, the eye at the middle of the wall looking level across the room. The
/// background is the indirect illuminance of the walls between the planes of eye and luminaires over pi, by
/// exchange between ceiling, walls and floor of uniform exitance; what of the flux meets the floor directly
/// is that of evenly spread luminaires.
/// @param spacing_h  over H: 0.25 or 1
/// @returns [19 x 5], rooms as in kUgrRooms, for each the reflectances as in kUgrReflectances
std::vector<UgrEntry> ugr_table(const IntensityTable& intensity, const LuminousOpening& opening,
                                double spacing_h);

}  // namespace dim
