#pragma once

#include <memory>
#include <vector>

#include "geometry/polygon.hpp"

namespace dim {

/// A polygon that stops light.
struct Plate {
  const Polygon* polygon = nullptr;  ///< must outlive the caster
  /// What a ray meets that comes from behind: false stops it (a closed body's inside), true lets it pass (the
  /// other side is a plate of its own).
  bool open_back = false;
  /// Its holes cannot be reached from the front (furniture stands in them): only the bounding rectangle is
  /// tested.
  bool fills_rectangle = false;
};

/// Where a ray ends.
struct Hit {
  int plate = -1;     ///< -1: nothing in the way
  bool back = false;  ///< came from behind the plate
  double t = 0.0;     ///< in units of the direction's length
  Vec2 local{0.0};    ///< on the plate's polygon
};

/// Finds what rays meet. The boxes around plates are searched in single precision, every hit is computed in
/// double on the exact polygon with its holes; polygons are widened by `tolerance_m`, so that no ray slips
/// through between two that share an edge. Safe to use from many threads at once.
class RayCaster {
 public:
  /// @param plates      geometry near the origin (the zone is moved to its own centre)
  /// @param diameter_m  size of the zone: tolerances are 1e-9 of it, hits nearer than that are ignored
  RayCaster(std::vector<Plate> plates, double diameter_m);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// Nearest plate along origin + t * direction, t > tolerance. Where two are equally near, the lower index.
  /// @param direction  of unit length
  /// @param skip  a plate that is not looked at (the one the ray starts on), or -1
  Hit nearest(const Vec3& origin, const Vec3& direction, int skip = -1) const;

  /// Whether anything lies strictly between `from` and `to`, the plate `skip` left out.
  bool blocked(const Vec3& from, const Vec3& to, int skip = -1) const;

  double tolerance_m() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace dim
