#pragma once

#include <string>
#include <vector>

#include "geometry/perspective.hpp"

namespace dim {

enum class ViewKind {
  perspective,
  plan,           ///< parallel projection to scale, straight down or up
  elevation,      ///< parallel projection to scale, level
  fisheye,        ///< 180 degrees, angular: see FisheyeLaw
  hemispherical,  ///< 180 degrees, as the hemisphere looks from above
};

/// Words of the kinds in files, in their order.
const std::vector<std::string>& view_kind_words();

struct View {
  std::string name;
  Vec3 eye{0.0};
  Vec3 focus{1, 0, 0};
  Vec3 up{0, 0, 1};
  double fov_rad = 1.2;  ///< horizontal, of a perspective
  int width = 1280;
  int height = 960;  ///< of a fisheye and a hemispherical view the width: they are square
  ViewKind kind = ViewKind::perspective;
  double width_m = 0.0;  ///< of what a plan or an elevation shows; 0 for the others

  bool parallel() const { return kind == ViewKind::plan || kind == ViewKind::elevation; }
  bool round() const { return kind == ViewKind::fisheye || kind == ViewKind::hemispherical; }
};

/// Width of a parallel view's picture that has all the points in it, and a little room round them, m.
/// @param points  any number; with none, or all on the line of sight, the width is 0
double fitting_width_m(const View& view, const std::vector<Vec3>& points);

/// The camera of a view that is not round; of a round one, its axes.
Camera camera_of(const View& view);

}  // namespace dim
