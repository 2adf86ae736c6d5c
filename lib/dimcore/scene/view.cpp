#include "scene/view.hpp"

#include <algorithm>
#include <cmath>

namespace dim {

const std::vector<std::string>& view_kind_words() {
  static const std::vector<std::string> words{"perspective", "plan", "elevation", "fisheye", "hemispherical"};
  return words;
}

double fitting_width_m(const View& view, const std::vector<Vec3>& points) {
  constexpr double kRoom = 1.04;  // lines on the rim stay whole
  const Vec3 forward = glm::normalize(view.focus - view.eye);
  const Vec3 up = upright(forward, view.up), right = glm::cross(forward, up);
  const double width_by_height = static_cast<double>(view.width) / view.height;
  double half_m = 0.0;
  for (const Vec3& point : points) {
    const Vec3 p = point - view.eye;
    half_m = std::max({half_m, std::abs(glm::dot(p, right)), std::abs(glm::dot(p, up)) * width_by_height});
  }
  return 2.0 * kRoom * half_m;
}

Camera camera_of(const View& view) {
  Camera camera{view.eye, view.focus, view.up, view.fov_rad, view.width, view.height};
  if (view.parallel()) camera.parallel_m = view.width_m;
  return camera;
}

}  // namespace dim
