#include "geometry/bridge.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "geometry/segment.hpp"

namespace dim {
namespace {

/// Whether the edges cross or touch elsewhere than in a common end.
bool blocks(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  if (p == a || p == b || q == a || q == b) return false;
  const double pa = cross(b - a, p - a), qa = cross(b - a, q - a);
  const double ap = cross(q - p, a - p), bp = cross(q - p, b - p);
  return pa * qa <= 0.0 && ap * bp <= 0.0 && !(pa == 0.0 && qa == 0.0 && ap != bp);
}

/// Whether the direction leaves corner i of a counter-clockwise ring towards its inside.
bool leaves_inwards(const Ring2& ring, std::size_t i, const Vec2& direction) {
  const Vec2 next = ring[(i + 1) % ring.size()] - ring[i];
  const Vec2 before = ring[(i + ring.size() - 1) % ring.size()] - ring[i];
  const bool left_of_next = cross(next, direction) >= 0.0, right_of_before = cross(direction, before) >= 0.0;
  return cross(next, before) > 0.0 ? left_of_next && right_of_before : left_of_next || right_of_before;
}

struct Bridge {
  std::size_t outer = 0, hole = 0;      ///< which rings
  std::size_t outer_corner = 0, hole_corner = 0;
  double length2 = std::numeric_limits<double>::infinity();
};

class Bridging {
 public:
  explicit Bridging(const Polygon& polygon) : polygon_(polygon) {
    for (const Ring2& ring : polygon.rings()) (signed_area(ring) > 0.0 ? outers_ : holes_).push_back(ring);
  }

  std::vector<Ring2> run() {
    while (!holes_.empty()) {
      const Bridge bridge = shortest();
      if (bridge.length2 == std::numeric_limits<double>::infinity())
        throw InternalError("a hole of a polygon sees no corner around it");
      build(bridge);
    }
    return std::move(outers_);
  }

 private:
  Bridge shortest() const {
    Bridge best;
    for (std::size_t o = 0; o < outers_.size(); ++o)
      for (std::size_t h = 0; h < holes_.size(); ++h)
        for (std::size_t i = 0; i < outers_[o].size(); ++i)
          for (std::size_t k = 0; k < holes_[h].size(); ++k) {
            const Vec2 way = holes_[h][k] - outers_[o][i];
            const double length2 = glm::dot(way, way);
            if (length2 < best.length2 && leaves_inwards(outers_[o], i, way) &&
                is_free(outers_[o][i], holes_[h][k]))
              best = {o, h, i, k, length2};
          }
    return best;
  }

  bool is_free(const Vec2& a, const Vec2& b) const {
    if (!polygon_.contains((a + b) / 2.0, 1e-12)) return false;
    return std::none_of(polygon_.rings().begin(), polygon_.rings().end(), [&](const Ring2& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (blocks(a, b, ring[i], ring[(i + 1) % ring.size()])) return true;
      return false;
    });
  }

  void build(const Bridge& bridge) {
    Ring2& outer = outers_[bridge.outer];
    Ring2 way = holes_[bridge.hole];
    std::rotate(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(bridge.hole_corner), way.end());
    way.push_back(way.front());
    way.push_back(outer[bridge.outer_corner]);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(bridge.outer_corner) + 1, way.begin(), way.end());
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(bridge.hole));
  }

  const Polygon& polygon_;
  std::vector<Ring2> outers_, holes_;
};

}  // namespace

std::vector<Ring2> bridged_rings(const Polygon& polygon) { return Bridging(polygon).run(); }

}  // namespace dim
