// See README.md beside this file.
#include <array>
#include <limits>

#include "catch.hpp"
#include "property/transport_support.hpp"

using namespace dim;
using namespace dim::test;

namespace {

struct Slabs {
  Vec3 lo, hi;
};

// Faces in the order of add_box: floor (low z), ceiling, y0, y1, x0, x1.
int face(std::size_t axis, bool high) {
  constexpr std::array<int, 3> first = {4, 2, 0};
  return first[axis] + (high ? 1 : 0);
}

struct End {
  double t = std::numeric_limits<double>::infinity();
  int surface = -1;
};

// Where a ray leaves the room it is in, or enters the first of the boxes.
End end_of(const Vec3& o, const Vec3& d, const Slabs& room, const std::vector<Slabs>& boxes) {
  End end;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) continue;
    const bool high = d[axis] > 0.0;
    const double t = ((high ? room.hi : room.lo)[axis] - o[axis]) / d[axis];
    if (t < end.t) end = {t, face(static_cast<std::size_t>(axis), high)};
  }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    double enter = 0.0, leave = std::numeric_limits<double>::infinity();
    int entered = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1.0 / d[axis];
      const double t0 = (boxes[b].lo[axis] - o[axis]) * inverse, t1 = (boxes[b].hi[axis] - o[axis]) * inverse;
      if (std::min(t0, t1) > enter) {
        enter = std::min(t0, t1);
        entered = face(static_cast<std::size_t>(axis), t1 < t0);
      }
      leave = std::min(leave, std::max(t0, t1));
    }
    if (entered >= 0 && enter < leave && enter < end.t)
      end = {enter, 6 * (static_cast<int>(b) + 1) + entered};
  }
  return end;
}

}  // namespace

TEST_CASE("Furnished room: direct flux of each surface equals a count of rays", "[transport][validation]") {
  const Zone zone = furnished_room(0.0, 0.25);
  const Slabs room{{-3, -2, -1.4}, {3, 2, 1.4}};
  const std::vector<Slabs> boxes = {{{-1, -1, -0.7}, {0.6, -0.2, -0.65}},
                                    {{2.2, 0.5, -1.2}, {2.8, 1.9, 0.4}}};
  Lights lights;
  add_lamp(lights, "point", {-1.8, 1.1, 0.9}, IntensityTable::isotropic(100.0));
  add_lamp(lights, "panel", {0.5, 0.2, 1.35}, IntensityTable::lambertian(400.0),
           {.opening = rectangle(1.2, 0.3)});
  add_lamp(lights, "lamp", {-0.3, -0.6, -0.2}, IntensityTable::lambertian(50.0),
           {.aim = {0.2, 0.1, -1}, .opening = {OpeningShape::kEllipse, 0.2, 0.2, 0.0}});
  const Cells cells(zone);
  const auto light = test::direct(zone, lights);
  constexpr int kRays = 1 << 20;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t l = 0; l < lights.luminaires.size(); ++l) {
    const auto& lamp = lights.luminaires[l];
    const bool lambertian = l > 0;
    const double flux_lm = lambertian ? kPi * (l == 1 ? 400.0 : 50.0) : 400.0 * kPi;
    std::vector<double> share(18, 0.0);
    for (int i = 0; i < kRays; ++i) {
      // Lambertian: cos^2 uniform; isotropic: cos uniform.
      const double a = unit(random), turn = 2 * kPi * unit(random);
      const double cosine = lambertian ? std::sqrt(a) : 2 * a - 1, sine = std::sqrt(1 - cosine * cosine);
      const Vec3 d = lamp.to_world({sine * std::cos(turn), sine * std::sin(turn), cosine});
      Vec2 q(unit(random) - 0.5, unit(random) - 0.5);
      while (l == 2 && glm::dot(q, q) > 0.25) q = {unit(random) - 0.5, unit(random) - 0.5};
      const Vec3 from =
          lamp.at + lamp.c0 * q.x * lamp.opening.length_m + lamp.c90 * q.y * lamp.opening.width_m;
      share[static_cast<std::size_t>(end_of(from, d, room, boxes).surface)] += 1.0 / kRays;
    }
    double sum_lm = 0.0;
    for (std::size_t s = 0; s < share.size(); ++s) {
      double lm = 0.0;
      for (std::size_t i = cells.first(s); i < cells.first(s + 1); ++i)
        lm += cells.area_m2(i) * light.cell_lx[i * lights.luminaires.size() + l];
      sum_lm += lm;
      const double sigma = std::sqrt(share[s] * (1 - share[s]) / kRays);
      CAPTURE(lamp.name, zone.surfaces[s].name);
      CHECK(lm / flux_lm == Approx(share[s]).margin(4 * sigma + 1e-2 * share[s]));
    }
    CHECK(sum_lm == Approx(flux_lm).epsilon(2e-3));
  }
}
