#include "image/radiance_view.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dim {
namespace {

struct Opening {
  char type;
  double across, upright;  // degrees; of parallel views m
};

Opening opening_of(const View& view) {
  const double height_by_width = static_cast<double>(view.height) / view.width;
  switch (view.kind) {
    case ViewKind::plan:
    case ViewKind::elevation:
      return {'l', view.width_m, view.width_m * height_by_width};
    case ViewKind::fisheye:
      return {'a', 180.0, 180.0};
    case ViewKind::hemispherical:
      return {'h', 180.0, 180.0};
    case ViewKind::perspective:
      break;
  }
  const double upright_rad = 2.0 * std::atan(std::tan(view.fov_rad / 2.0) * height_by_width);
  return {'v', degrees(view.fov_rad), degrees(upright_rad)};
}

std::string numbers(const Vec3& v) {
  const Vec3 tidy = v + Vec3(0.0);  // no -0
  return fmt::format("{:.9g} {:.9g} {:.9g}", tidy.x, tidy.y, tidy.z);
}

}  // namespace

std::string radiance_view(const View& view, const Vec3& origin_m) {
  const Opening opening = opening_of(view);
  return fmt::format("-vt{} -vp {} -vd {} -vu {} -vh {:.9g} -vv {:.9g}", opening.type, numbers(view.eye + origin_m),
                     numbers(glm::normalize(view.focus - view.eye)), numbers(view.up), opening.across, opening.upright);
}

}  // namespace dim
