#include "geometry/visible_share.hpp"

#include <optional>

#include "base/low_discrepancy.hpp"
#include "geometry/spherical_triangle.hpp"

namespace dim {
namespace {

struct Line {
  Vec3 direction{0.0};
  double weight = 0.0;  // 0: does not count
};

// Where a line from a point goes, and how much light it stands for.
class Aim {
 public:
  Aim(const PairSide& from, const PairSide& to) : from_(from), to_(to) {
    constexpr double kFar = 3.0;
    far_ = glm::length(to.centre - from.centre) - from.radius_m > kFar * to.radius_m;
    if (far_) return;
    for (const auto& t : to.area->triangles())
      triangles_.push_back({to.frame->to_world(t[0]), to.frame->to_world(t[1]), to.frame->to_world(t[2])});
  }

  Line operator()(const Vec3& start, double x, double y) const {
    return far_ ? by_area(start, x, y) : by_solid_angle(start, x, y);
  }

 private:
  Line by_area(const Vec3& start, double x, double y) const {
    const Vec3 way = to_.frame->to_world(to_.area->point(x, y)) - start;
    const double r2 = glm::dot(way, way);
    const double cosines = glm::dot(way, from_.frame->n) * -glm::dot(way, to_.frame->n);
    return {way, std::max(0.0, cosines / (r2 * r2))};
  }

  // One pass over the triangles: each takes the place of those before it with its share of the total so far,
  // and the number that decides is stretched to serve again, so that the choice stays evenly spread.
  Line by_solid_angle(const Vec3& start, double x, double y) const {
    double total = 0.0;
    std::optional<SphericalTriangle> chosen;
    for (const auto& t : triangles_) {
      const SphericalTriangle seen(t[0] - start, t[1] - start, t[2] - start);
      if (!(seen.solid_angle_sr() > 0.0)) continue;
      total += seen.solid_angle_sr();
      const double share = seen.solid_angle_sr() / total;
      if (!chosen || x < share) {
        x = chosen ? x / share : x;
        chosen = seen;
      } else {
        x = (x - share) / (1.0 - share);
      }
    }
    if (!chosen) return {};
    const Vec3 direction = chosen->direction(x, y);
    return {direction, std::max(0.0, glm::dot(direction, from_.frame->n)) * total};
  }

  using Corners = std::array<Vec3, 3>;

  const PairSide& from_;
  const PairSide& to_;
  bool far_ = false;
  std::vector<Corners> triangles_;
};

}  // namespace

double visible_share(const RayCaster& caster, const PairSide& from, const PairSide& to, std::uint64_t n_probe,
                     std::uint64_t n_lines, std::uint64_t stream) {
  const Aim aim(from, to);
  const LowDiscrepancy4 points(stream);
  double all = 0.0, free = 0.0;
  bool any_blocked = false;
  for (std::uint64_t i = 0; i < n_lines; ++i) {
    if (i == n_probe && !any_blocked) return 1.0;
    const auto x = points(i);
    const Vec3 start = from.frame->to_world(from.area->point(x[0], x[1]));
    const Line line = aim(start, x[2], x[3]);
    if (!(line.weight > 0.0)) continue;
    const Hit hit = caster.nearest(start, line.direction, from.plate);
    all += line.weight;
    if (hit.plate == to.plate && !hit.back)
      free += line.weight;
    else
      any_blocked = true;
  }
  if (!any_blocked) return 1.0;
  return all > 0.0 ? free / all : 0.0;
}

}  // namespace dim
