#include "light/sun_sight.hpp"

#include "light/obstructions.hpp"
#include "network/cells.hpp"
#include "sky/direction.hpp"
#include "validation/daylight_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

/// A room with a window, a shelf inside and a mast before the window.
Zone shaded_room() {
  return read(box_text({4, 6, 3}, 0.5,
                       "[[surface]]\nname = \"w\"\non = \"wall-s\"\nfinish = \"pane\"\n"
                       "vertices = [[0.5,0,0.9],[0.5,0,2.7],[3.5,0,2.7],[3.5,0,0.9]]\n"
                       "[[box]]\nname = \"shelf\"\nfinish = \"grey\"\ncorner = [0.2,1,1.2]\nsize = [3.4,0.3,0.05]\n"
                       "[[surface]]\nname = \"mast\"\nfinish = \"grey\"\noutside = true\n"
                       "vertices = [[2.1,-3,0],[1.9,-3,0],[1.9,-3,9],[2.1,-3,9]]\n"));
}

/// Share of the disc that rays reach, times cosine: 6,400 of them, of the receiver's points and the disc's.
double by_rays(const Zone& zone, const Windows& windows, const RayCaster& caster, const ConvexRing& ring,
               const Vec3& normal, int skip, const Vec3& towards) {
  const SunDisc disc({towards, 1.0});
  constexpr int kSide = 80;
  double sum = 0.0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double a = (i / kSide + 0.5) / kSide, b = (i % kSide + 0.5) / kSide;
    const double c = std::fmod(i * 0.754877666, 1.0), d = std::fmod(i * 0.569840291, 1.0);
    const Vec3 from = ring.size() == 1 ? ring[0] : ring.sample(c, d);
    const Vec3 direction = disc.direction(a, b);
    const double cosine = glm::dot(normal, direction);
    for (const auto& window : windows.windows) {
      const double incidence = -glm::dot(window.frame().n, direction);
      if (!(cosine > 0.0) || !(incidence > 0.0)) continue;
      const Vec3 on_glass = from + window.frame().height(from) / incidence * direction;
      if (!window.polygon.contains(window.frame().to_local(on_glass)) || caster.blocked(from, on_glass, skip)) continue;
      if (caster.nearest(on_glass, direction, window.plate).plate < 0) sum += cosine;
    }
  }
  (void)zone;
  return sum / (kSide * kSide);
}

}  // namespace

TEST_CASE("What points and cells see of the sun is what many rays find", "[daylight][sun][validation]") {
  const Zone zone = shaded_room();
  const Windows windows = find_windows(zone);
  const Obstructions obstructions(zone, Lights{});
  const SunSight sight(zone, windows, plates_of(zone), obstructions.shadows());
  std::vector<SunSight::Seen> seen;
  const auto found = [&](const ConvexRing& ring, const Vec3& normal, int skip, const Vec3& towards) {
    sight.seen(ring, {normal}, skip, sight.obstacles(ring, {normal}, skip), towards, seen);
    double sum = 0.0;
    for (const auto& part : seen) sum += part.factor;
    return sum;
  };
  int n_partly = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3 towards =
        to_zone(sky_direction(radians(25.0 + 0.37 * k), radians(160.0 + 0.7 * k)), 0.0);
    // Across the edges of the sun patch: sill, head, jambs, shelf and mast.
    const ConvexRing point(Vec3(0.4 + 0.053 * k, 0.9 + 0.06 * k, 0.8) - zone.origin_m);
    const double exact = found(point, {0, 0, 1}, -1, towards);
    const double rays = by_rays(zone, windows, obstructions.caster(), point, {0, 0, 1}, -1, towards);
    CAPTURE(k);
    CHECK(std::abs(exact - rays) < 0.01 * towards.z);
    n_partly += rays > 0.02 && rays < 0.98 * towards.z;
  }
  CHECK(n_partly > 2);
  int n_cells = 0;
  const Cells cells(zone);
  const Vec3 towards = to_zone(sky_direction(radians(33.0), radians(170.0)), 0.0);
  for (std::size_t i = cells.first(0); i < cells.first(1); i += 2) {
    Ring2 corners;
    cells.outline(i, corners);
    ConvexRing ring;
    const Frame& frame = zone.surfaces[0].polygon.frame();
    for (const Vec2& p : corners) ring.add(frame.to_world(p));
    const double exact = found(ring, frame.n, 0, towards);
    const double rays = by_rays(zone, windows, obstructions.caster(), ring, frame.n, 0, towards);
    CHECK(std::abs(exact - rays) < 0.01 * towards.z);
    n_cells += rays > 0.0;
  }
  CHECK(n_cells > 3);
}
