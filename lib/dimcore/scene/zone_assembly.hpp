#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/face_source.hpp"
#include "scene/zone.hpp"
#include "scene/zone_frame.hpp"

namespace dim {

/// Target cell edge where neither the file nor the command line says one: 0.25 m, or a twentieth of the
/// zone's diameter in zones smaller than 5 m.
inline constexpr double kDefaultCell_m = 0.25;

/// What a zone is made of, as its writer has it: a zone file, an importer, or another program. Lengths of faces are
/// in the writer's unit, faces name their finish.
struct ZoneParts {
  std::string name;
  double unit_m = 1.0;
  std::vector<Finish> finishes;
  std::vector<FaceSource> faces;
  double cell_m = 0.0;      ///< of surfaces without a cell of their own; 0: kDefaultCell_m, or less in small zones
  Place unit_place{};       ///< where messages about the zone's size point to
  std::vector<Place> eyes{};  ///< of views, in order: where messages about them point to
};

/// Puts planes, points, views and the site into the zone, whose surfaces are placed but not yet cut.
/// @param cell_m  spacing of planes that state none
using AddReceivers = std::function<void(const ZoneFrame& frame, double cell_m, Zone& zone)>;

/// Makes one validated zone: centred, features joined to their parents and cut out of them, overlaps resolved,
/// contacts taken off, closedness and volume told.
/// @param problems  what is wrong with single parts is added to those there are
/// @throws InputError  all problems together
Zone assemble_zone(const ZoneParts& parts, const AddReceivers& add_receivers, Problems& problems,
                   Warnings& warnings);

}  // namespace dim
