#include "image/lens.hpp"

#include "catch.hpp"
#include "image/radiance_view.hpp"

using namespace dim;

namespace {

View view_of(ViewKind kind, int width, int height) {
  View view{"v", {0, 0, 2}, {0, 3, 2}};
  view.kind = kind;
  view.width = width;
  view.height = height;
  return view;
}

}  // namespace

TEST_CASE("The pixels of an elevation are metres apart as its width says", "[image][lens][unit]") {
  View view = view_of(ViewKind::elevation, 200, 100);
  view.width_m = 8.0;
  const Lens lens(view);
  for (const auto& [x, y] : {std::pair{100.0, 50.0}, {0.0, 0.0}, {150.5, 99.5}}) {
    const auto sight = lens.sight(x, y);
    REQUIRE(sight);
    CHECK(sight->direction == Vec3(0, 1, 0));
    CHECK(glm::length(sight->origin - Vec3((x - 100.0) * 0.04, 0, 2.0 + (50.0 - y) * 0.04)) < 1e-12);
  }
}

TEST_CASE("A width that fits has every corner inside the picture, one of them near its rim", "[image][lens][unit]") {
  View view = view_of(ViewKind::elevation, 200, 100);
  const std::vector<Vec3> corners{{-1, 0, 0}, {3, 5, 0}, {-1, 5, 2.8}, {3, 0, 2.8}};
  CHECK(fitting_width_m(view, corners) == Approx(1.04 * 2.0 * 4.0));  // 2 m down to the floor, twice as wide as high
  view.height = 200;
  CHECK(fitting_width_m(view, corners) == Approx(1.04 * 2.0 * 3.0));
}

TEST_CASE("Every pixel that a fisheye shows an edge in is marked, few others are", "[image][lens][unit]") {
  const auto kind = GENERATE(ViewKind::fisheye, ViewKind::hemispherical);
  const View view = view_of(kind, 300, 300);
  const Lens lens(view);
  const auto law = kind == ViewKind::fisheye ? FisheyeLaw::angular : FisheyeLaw::hemispherical;
  const Fisheye fisheye(view.eye, {0, 1, 0}, {0, 0, 1}, law, 300);
  const Vec3 a(-4, -1, 2.5), b(6, 3, 0.1);  // begins behind the eye
  EdgeMask mask(300, 300);
  lens.mark_edge(a, b, 1e-6, mask);
  constexpr int kPlaces = 100000;
  for (int k = 0; k <= kPlaces; ++k) {
    const auto place = fisheye.project(a + static_cast<double>(k) / kPlaces * (b - a));
    if (!place) continue;
    const int x = std::clamp(static_cast<int>(place->x), 0, 299), y = std::clamp(static_cast<int>(place->y), 0, 299);
    if (!mask.at(x, y)) FAIL("place " << k << " of the edge is not marked");
  }
  int n_marked = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) n_marked += mask.at(x, y);
  CHECK(n_marked > 200);
  CHECK(n_marked < 900);
}

TEST_CASE("A view has the line by which Radiance's programs know it", "[image][lens][unit]") {
  const Vec3 origin(10, 20, 0);
  View view = view_of(ViewKind::perspective, 200, 100);
  view.fov_rad = radians(90.0);
  CHECK(radiance_view(view, origin) == "-vtv -vp 10 20 2 -vd 0 1 0 -vu 0 0 1 -vh 90 -vv 53.1301024");
  view.kind = ViewKind::elevation;
  view.width_m = 8.0;
  CHECK(radiance_view(view, origin) == "-vtl -vp 10 20 2 -vd 0 1 0 -vu 0 0 1 -vh 8 -vv 4");
  CHECK(radiance_view(view_of(ViewKind::fisheye, 64, 64), origin) ==
        "-vta -vp 10 20 2 -vd 0 1 0 -vu 0 0 1 -vh 180 -vv 180");
  CHECK(radiance_view(view_of(ViewKind::hemispherical, 64, 64), origin) ==
        "-vth -vp 10 20 2 -vd 0 1 0 -vu 0 0 1 -vh 180 -vv 180");
}
