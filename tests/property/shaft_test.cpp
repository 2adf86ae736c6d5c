// A shaft may keep what is not in the way, and must not lose what is.
#include "geometry/shaft.hpp"

#include <algorithm>
#include <random>

#include "catch.hpp"

using namespace dim;

TEST_CASE("No box that a line from one end of a shaft to the other meets is culled", "[geometry][property]") {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto any = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  const auto quadrilateral = [&] {
    const Vec3 corner = 4.0 * any(), u = any() - 0.5, v = any() - 0.5;
    ConvexRing ring;
    for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v}) ring.add(p);
    return ring;
  };
  std::size_t n_culled = 0, n_boxes = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexRing a = quadrilateral(), b = quadrilateral();
    const Shaft shaft(a, b, -1);
    for (int k = 0; k < 100; ++k) {
      // A box round a point of a line between the two, and one anywhere.
      const Vec3 p = a.sample(unit(random), unit(random)), q = b.sample(unit(random), unit(random));
      const Vec3 on_line = p + unit(random) * (q - p), half = 0.1 * unit(random) * any();
      REQUIRE_FALSE(shaft.misses(on_line - half, on_line + half, 1e-9));
      const Vec3 anywhere = 5.0 * any() - 0.5;
      n_culled += shaft.misses(anywhere - half, anywhere + half, 1e-9);
      ++n_boxes;
    }
  }
  CHECK(2 * n_culled > n_boxes);
}
