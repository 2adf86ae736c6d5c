#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/vec.hpp"
#include "geometry/polygon.hpp"
#include "hemisphere/response.hpp"
#include "reflection/finish.hpp"
#include "scene/view.hpp"

/// The validated model of a zone: what the zone file says, in metres, with boxes and copies expanded,
/// features cut out of their parents, and everything moved so that the zone's own centre is the origin.
namespace dim {

/// What a window can be besides its own finish: a blind drawn, another pane.
struct WindowState {
  std::string name;
  int finish = 0;  ///< a glazing; index into Zone::finishes
};

/// One lit side of a polygon. A two-sided panel is two surfaces that name each other as `twin`.
struct Surface {
  std::string name;
  Polygon polygon;  ///< features and touching faces already cut out
  int finish = 0;   ///< index into Zone::finishes
  double cell_m = 0.0;
  std::optional<std::pair<int, int>> grid;  ///< nu x nv asked for instead of a cell size
  int parent = -1;                          ///< surface that this feature lies on
  int twin = -1;                            ///< other side of a two-sided panel
  bool bounding =
      true;  ///< from [[surface]], one-sided, not outside; false for boxes, panels, external obstructions
  bool outside = false;  ///< external obstruction
  std::string group;     ///< of a window: windows of one group are lit and switched together
  std::vector<WindowState> states;
  /// What the polygon lacks of its bounding rectangle is covered by faces that touch it (furniture standing
  /// on a floor): no ray gets there, so a hit may be tested against the rectangle alone.
  bool fills_rectangle = false;
  Place place;
};

/// Measuring plane: receives light, does not obstruct. Points are the middles of an nu x nv grid on the
/// polygon's rectangle that lie inside the polygon, numbered along u first.
struct MeasuringPlane {
  std::string name;
  Polygon polygon;
  int nu = 1;
  int nv = 1;
  Place place;
};

struct MeasuringPoint {
  Vec3 position{0.0};
  Vec3 normal{0, 0, 1};  ///< or axis, or the way it faces: see Response
  /// False where no light of the zone comes: outside it, inside something. Statistics leave the point out.
  bool valid = true;
  Quantity quantity = Quantity::planar;
  Response response() const { return {normal, quantity}; }
};

/// Frame with its origin at the point and n its normal; v is up where it is semicylindrical.
inline Frame frame_at(const MeasuringPoint& point) {
  Frame frame;
  frame.origin = point.position;
  frame.n = point.normal;
  frame.u = point.quantity == Quantity::semicylindrical ? glm::cross(Vec3(0, 0, 1), point.normal)
                                                        : perpendicular(point.normal);
  frame.v = glm::cross(frame.n, frame.u);
  return frame;
}

/// Measuring points of one plane or one [[sensors]] entry: [first, first + count) of Zone::points.
struct PointSet {
  std::string name;
  std::size_t first = 0;
  std::size_t count = 0;
  Place place{};
};

struct Site {
  double latitude_deg = 0.0;   ///< north positive
  double longitude_deg = 0.0;  ///< east positive
  double time_zone_h = 0.0;
  double north_deg = 0.0;  ///< true north, from +y, clockwise seen from above
  std::optional<double> ground_m;  ///< level of the ground, zone-centred; lowest corner where not said
};

struct Zone {
  std::string name;
  Vec3 origin_m{0.0};       ///< add to any position here to get the user's coordinates
  double unit_m = 1.0;      ///< length of the file's unit: lights are placed in the same unit
  double diameter_m = 0.0;  ///< diagonal of the bounding box of all surfaces
  double volume_m3 =
      0.0;              ///< enclosed by the bounding surfaces (divergence theorem); meaningful where `closed`
  bool closed = false;  ///< every edge of the bounding surfaces is met by another
  /// What would close it, facing into the zone; empty where it is closed or no flat polygons would.
  std::vector<Polygon> openings;
  std::vector<Finish> finishes;
  std::vector<Surface> surfaces;
  std::vector<MeasuringPlane> planes;
  std::vector<MeasuringPoint> points;
  std::vector<PointSet> point_sets;  ///< planes in order, then sensors
  std::vector<View> views;
  std::optional<Site> site;
};

/// Whether light of the outside comes in through the surface: a glazed part of the shell.
bool is_window(const Zone& zone, const Surface& surface);

/// What the points of a set measure: all the same.
inline Quantity quantity_of(const Zone& zone, const PointSet& set) {
  return set.count > 0 ? zone.points[set.first].quantity : Quantity::planar;
}
/// Whether any point measures something else than planar illuminance.
bool any_bodies_measure(const Zone& zone);

/// The view of that name, the first one for an empty name.
/// @throws InputError  no such view, or a zone without views
const View& find_view(const Zone& zone, const std::string& name);

/// Refuses a zone whose cells alone would not fit, before they are made.
/// @throws LimitError  with the number of cells and the memory they need
void check_cells_fit(const Zone& zone, std::size_t memory_limit_bytes);

}  // namespace dim
