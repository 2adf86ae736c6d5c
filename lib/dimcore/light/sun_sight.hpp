#pragma once

#include <functional>
#include <vector>

#include "geometry/shadow_plates.hpp"
#include "hemisphere/response.hpp"
#include "light/sun_disc.hpp"
#include "light/uncovered_area.hpp"
#include "light/window.hpp"

namespace dim {

/// How much of the sun's disc receivers see through each window, past everything that stands in the way: polygons cut
/// by polygons, no rays. At points the disc is cut; on cells the cell is, for a few directions of the disc each.
class SunSight {
 public:
  /// All must outlive this, but the list of plates. @param plates  what stops light, as in `shadows`
  SunSight(const Zone& zone, const Windows& windows, std::vector<Plate> plates, const ShadowPlates& shadows);

  /// What can stand between a receiver and the sun, by window. [n_windows]
  using Obstacles = std::vector<std::vector<int>>;
  /// @param receiver  a cell or a point (a ring of one); @param skip  plate that it lies on, or -1
  Obstacles obstacles(const ConvexRing& receiver, const Response& response, int skip) const;

  /// `kNoWindow`: through what is open in ways that only rays know.
  static constexpr std::size_t kNoWindow = static_cast<std::size_t>(-1);
  struct Seen {
    std::size_t window;
    double factor;     ///< visible share times the receiver's response
    double incidence;  ///< cosine on the pane
  };
  /// @param towards   the sun, unit vector
  /// @param receiver  with its obstacles; of a cell the mean over it
  void seen(const ConvexRing& receiver, const Response& response, int skip, const Obstacles& obstacles,
            const Vec3& towards, std::vector<Seen>& result) const;

 private:
  struct Ball {
    Vec3 middle;
    double radius_m;
  };
  static Ball ball_of(const Polygon& polygon);
  void seen_by_point(const Vec3& point, const Response& response, const Obstacles& obstacles, const Vec3& towards,
                     std::vector<Seen>& result) const;
  void seen_by_cell(const ConvexRing& cell, const Vec3& normal, int skip, const Obstacles& obstacles,
                    const Vec3& towards, std::vector<Seen>& result) const;
  /// What can stand in the way of what comes through no window.
  std::vector<int> in_the_open(const ConvexRing& receiver, int skip, const Vec3& towards) const;
  CoverRings flat(int plate, const Vec3& normal, double least_height,
                  const std::function<Vec2(const Vec3&)>& projected) const;

  const Zone& zone_;
  const Windows& windows_;
  std::vector<Plate> plates_;
  const ShadowPlates& shadows_;
  std::vector<Ball> ball_, window_ball_;
  std::vector<std::vector<int>> outside_of_;  // [n_windows] plates behind it
};

}  // namespace dim
