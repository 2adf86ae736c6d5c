#include "image/lens.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr double kFlat_px = 0.01;  // a curve so near to its chord is one: well within the mask's slack
constexpr int kPieces = 8;         // at least: the middle of a whole curve may lie on its chord by chance
constexpr int kMostHalvings = 20;

// The part of a great circle between two directions, as chords of its image.
void mark_arc(const Fisheye& fisheye, const Vec3& a, const Vec3& b, int halvings, EdgeMask& mask) {
  const auto p = fisheye.project(fisheye.eye() + a), q = fisheye.project(fisheye.eye() + b);
  if (!p || !q) return;
  const Vec3 middle = glm::normalize(a + b);
  const auto m = fisheye.project(fisheye.eye() + middle);
  if (!m) return;
  if (glm::length(*m - 0.5 * (*p + *q)) <= kFlat_px || halvings == 0) return mask.add(*p, *q);
  mark_arc(fisheye, a, middle, halvings - 1, mask);
  mark_arc(fisheye, middle, b, halvings - 1, mask);
}

}  // namespace

Lens::Lens(const View& view) : perspective_(camera_of(view)) {
  if (!view.round()) return;
  const auto law = view.kind == ViewKind::fisheye ? FisheyeLaw::angular : FisheyeLaw::hemispherical;
  fisheye_.emplace(view.eye, perspective_.forward(), perspective_.up(), law, view.width);
}

std::optional<Sight> Lens::sight(double px, double py) const {
  if (!fisheye_) return Sight{perspective_.origin(px, py), perspective_.direction(px, py)};
  const auto direction = fisheye_->direction(px, py);
  if (!direction) return {};
  return Sight{fisheye_->eye(), *direction};
}

void Lens::mark_edge(const Vec3& a, const Vec3& b, double near_m, EdgeMask& mask) const {
  if (fisheye_) return mark_curved(a, b, near_m, mask);
  const auto part = perspective_.clip(a, b, near_m);
  if (!part) return;
  const auto from = perspective_.project(a + part->first * (b - a)),
             to = perspective_.project(a + part->second * (b - a));
  if (from && to) mask.add(*from, *to);
}

void Lens::mark_curved(const Vec3& a, const Vec3& b, double near_m, EdgeMask& mask) const {
  const double depth_a = perspective_.depth_m(a), depth_b = perspective_.depth_m(b);
  if (depth_a < 0.0 && depth_b < 0.0) return;
  const double crossing = depth_a / (depth_a - depth_b);
  const double start = depth_a < 0.0 ? crossing : 0.0, end = depth_b < 0.0 ? crossing : 1.0;
  Vec3 from(0.0);
  for (int k = 0; k <= kPieces; ++k) {
    Vec3 to = a + (start + (end - start) * k / kPieces) * (b - a) - fisheye_->eye();
    to -= std::min(0.0, glm::dot(to, perspective_.forward())) * perspective_.forward();  // rounding on the rim
    if (!(glm::length(to) > near_m)) continue;
    to = glm::normalize(to);
    if (from != Vec3(0.0)) mark_arc(*fisheye_, from, to, kMostHalvings, mask);
    from = to;
  }
}

void Lens::mark_rim(EdgeMask& mask) const {
  if (!fisheye_) return;
  const double radius = fisheye_->radius_px();
  const int n = 8 * static_cast<int>(std::ceil(radius));
  const auto on_rim = [&](int k) {
    return radius * Vec2(1.0 + std::cos(2.0 * kPi * k / n), 1.0 + std::sin(2.0 * kPi * k / n));
  };
  for (int k = 0; k < n; ++k) mask.add(on_rim(k), on_rim(k + 1));
}

}  // namespace dim
