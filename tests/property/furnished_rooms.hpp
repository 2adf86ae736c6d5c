#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hemisphere/patches.hpp"
#include "scene/zone.hpp"

/// Random furnished rooms as the files a user would write, and what they are lit to.
namespace dim::test {

struct RoomFace {
  std::string name;
  std::string finish;
  Ring3 ring;
  bool two_sided = false;
};

struct RoomBox {
  std::string name;
  std::string finish;
  Vec3 corner{0.0};
  Vec3 size{0.0};
  double turn_deg = 0.0;
};

struct RoomLamp {
  std::string name;
  std::string group;
  std::string fitting;  ///< "isotropic", "lambertian" or a photometric file
  double lumens = 0.0;
  Vec3 at{0.0};
  Vec3 aim{0, 0, -1};
  Vec3 c0{1, 0, 0};
  Vec2 opening_m{0.0};  ///< along c0 and c90; 0: what the fitting has
  bool body = false;
};

/// A room with an irregular quadrilateral or L for a floor, a partition that stands out from a wall, boxes
/// and thin panels at odd angles, two to four luminaires of different kinds, a plane of points and odd
/// points; some with a mirror wall, some with luminaires that have bodies. Metres, the floor at z = 0.
struct RandomRoom {
  std::uint64_t seed = 0;
  std::vector<RoomFace> faces;
  std::vector<RoomBox> boxes;
  std::vector<RoomLamp> lamps;
  Ring3 plane;
  std::vector<MeasuringPoint> sensors;
  bool has_mirror = false;
};

RandomRoom random_room(std::uint64_t seed);

/// How a room is written down; nothing of it is to change its light but by the square of the scale.
struct Writing {
  Vec3 offset_m{0.0};
  double scale = 1.0;
  int quarter_turns = 0;  ///< about the vertical, before scale and offset
  bool backwards =
      false;  ///< surfaces, boxes and luminaires listed the other way round, outlines begun elsewhere
  bool renamed = false;
};

struct RoomRun {
  double cell_m = 0.5;  ///< times the scale
  PatchGrid patches{12, 24};
  PatchGrid point_patches{32, 64};
  std::uint64_t seed = 1;
};

/// Of one source: illuminances, lx, of the points that are in the room, and means of surfaces.
struct SourceAnswer {
  std::vector<double> point_lx, point_direct_lx;
  std::map<std::string, double> surface_lx;  ///< by the surface's name as `random_room` gives it
};

using RoomAnswer = std::map<std::string, SourceAnswer>;  ///< by group

/// Reads, discretises and lights the room, luminaires in groups.
RoomAnswer answer(const RandomRoom& room, const Writing& writing = {}, const RoomRun& run = {});

}  // namespace dim::test
