#include "light/window_light.hpp"

#include <algorithm>
#include <cmath>

#include "light/visible_part.hpp"
#include "network/stream_key.hpp"

namespace dim {
namespace {

// Paths of a window: where nothing can hide a part of it or of what is seen through it, and else. Those of points are
// Fibonacci numbers.
struct PathCounts {
  int free, mixed;
};
constexpr PathCounts kOnPoint{1597, 17711};
constexpr PathCounts kOnCell{64, 128};
// Rays in each of 145 parts of the sky, and over the ground, where only rays know what is open.
constexpr PathCounts kDomeOnPoint{34, 987};
constexpr PathCounts kDomeOnCell{2, 64};

// Points of the unit square of a window, and of the receiver. A measuring point takes the lattice of least discrepancy in
// two dimensions (Fibonacci's), folded where what it sees is smooth; cells one in four.
class PathPoints {
 public:
  PathPoints(const ReceiverArea& receiver, PathCounts counts, bool smooth, std::uint64_t stream)
      : shift_(LowDiscrepancy4(stream)(0)),
        in_four_(receiver.is_point() ? 1 : (smooth ? counts.free : counts.mixed), shift_),
        two_dimensional_(receiver.is_point()),
        fold_(smooth),
        n_(two_dimensional_ ? static_cast<std::uint64_t>(smooth ? counts.free : counts.mixed) : in_four_.size()),
        step_(static_cast<std::uint64_t>(std::llround(static_cast<double>(n_) / kGolden))) {}
  std::uint64_t size() const { return n_; }
  std::array<double, 4> operator()(std::uint64_t i) const {
    if (!two_dimensional_) return in_four_(i);
    const auto n = static_cast<double>(n_);
    return {place(static_cast<double>(i) / n + shift_[0]), place(static_cast<double>(i * step_ % n_) / n + shift_[1]),
            shift_[2], shift_[3]};
  }

 private:
  static constexpr double kGolden = 1.6180339887498949;
  double place(double x) const {
    x -= std::floor(x);
    return fold_ ? 1.0 - std::abs(2.0 * x - 1.0) : x;
  }
  std::array<double, 4> shift_;
  FoldedLattice4 in_four_;
  bool two_dimensional_, fold_;
  std::uint64_t n_, step_;
};

}  // namespace

// A receiver and a window.
struct WindowLight::Sight {
  const ReceiverArea& receiver;
  std::size_t window;
  bool test_inside;
};

WindowLight::WindowLight(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
                         const RayCaster& caster, const ShadowPlates& plates)
    : zone_(zone),
      windows_(windows),
      panes_(panes),
      outside_(outside),
      caster_(caster),
      plates_(plates),
      place_in_group_(windows.windows.size()),
      scatters_(windows.windows.size(), 0),
      tolerance_m_(1e-8 * zone.diameter_m) {
  for (const auto& window : windows.windows) {
    stream_.push_back(mix(place_key(window.polygon.centroid(), window.frame().n, zone.diameter_m)));
    klems_frame_.push_back(klems_frame(window));
  }
  for (const auto& group : windows.groups)
    for (std::size_t k = 0; k < group.windows.size(); ++k) place_in_group_[group.windows[k]] = k;
  for (const auto& slot : panes.slots())
    for (std::size_t k = 0; k < slot.panes.size(); ++k)
      if (slot.panes[k].scattering) scatters_[windows.groups[slot.group].windows[k]] = 1;
}

void WindowLight::add(const ReceiverArea& receiver, SlotSums& sums) const {
  for (std::size_t w = 0; w < windows_.windows.size(); ++w) add(receiver, w, sums);
  if (windows_.dome) add_dome(receiver, sums);
}

void WindowLight::add(const ReceiverArea& receiver, std::size_t window, SlotSums& sums) const {
  const Window& glass = windows_.windows[window];
  const Vec3& n = receiver.response.normal;
  const bool is_planar = receiver.response.is_planar();
  const double offset = glm::dot(n, receiver.ring[0]);
  // The part of the window before the receiver's plane; receivers behind the window's own plane see it from outside.
  std::vector<ConvexRing> parts;
  ConvexRing bounds;
  std::vector<int> between;
  for (const auto& part : glass.parts) {
    const ConvexRing front = is_planar ? part.front_of(n, offset) : part;
    if (front.empty()) continue;
    const bool above = std::any_of(front.begin(), front.end(),
                                   [&](const Vec3& p) { return glm::dot(n, p) - offset > tolerance_m_; });
    if (is_planar && !above) continue;
    parts.push_back(front);
    Shaft shaft(receiver.ring, front, receiver.skip);
    if (is_planar) shaft.add_limit(n, offset);
    plates_.candidates(shaft, between);
  }
  std::erase(between, glass.plate);
  const Frame& plane = glass.frame();
  const bool behind = std::none_of(receiver.ring.begin(), receiver.ring.end(),
                                   [&](const Vec3& p) { return plane.height(p) > tolerance_m_; });
  if (parts.empty() || behind) return;

  const Sight sight{receiver, window, !between.empty()};
  const PathCounts counts = receiver.is_point() ? kOnPoint : kOnCell;
  const PathPoints points(receiver, counts, !sight.test_inside && glass.open_outside,
                          mix(receiver.stream ^ stream_[window]));
  const auto fans_at = [&](const Vec3& eye) {
    std::array<SolidAngleFan, 2> fans{SolidAngleFan(eye), SolidAngleFan(eye)};
    for (const auto& part : parts) {
      fans[0].add(part.front_of({0, 0, 1}, eye.z));
      fans[1].add(part.front_of({0, 0, -1}, -eye.z));
    }
    return fans;
  };
  std::optional<std::array<SolidAngleFan, 2>> fans;
  if (receiver.is_point()) fans = fans_at(receiver.ring[0]);
  for (std::uint64_t i = 0; i < points.size(); ++i) {
    const auto x = points(i);
    const Vec3 from = receiver.at(x[2], x[3]);
    if (!(plane.height(from) > tolerance_m_)) continue;
    if (!receiver.is_point()) fans = fans_at(from);
    for (const auto& fan : *fans) {
      if (!(fan.solid_angle_sr() > 0.0)) continue;
      add_path(sight, from, fan.direction(x[0], x[1]), fan.solid_angle_sr() / static_cast<double>(points.size()), sums);
    }
  }
}

void WindowLight::add_path(const Sight& sight, const Vec3& from, const Vec3& direction, double weight,
                           SlotSums& sums) const {
  const Window& window = windows_.windows[sight.window];
  const Frame& plane = window.frame();
  const double response = sight.receiver.response.of(direction), incidence = -glm::dot(plane.n, direction);
  if (!(response > 0.0) || !(incidence > 0.0)) return;
  const Vec3 on_glass = from + (plane.height(from) / incidence) * direction;
  if (sight.test_inside && caster_.blocked(from, on_glass, sight.receiver.skip)) return;
  const OutsideSeen seen = window.open_outside ? outside_.light().open(direction)
                                               : outside_.seen(on_glass, direction, window.plate);
  const std::size_t place = place_in_group_[sight.window];
  for (std::size_t s = panes_.first_of_group(window.group); s < panes_.last_of_group(window.group); ++s)
    sums.add(s, place, seen, incidence, weight * response);
  if (scatters_[sight.window])
    sums.add_glow(sight.window, klems::patch_of(-klems_frame_[sight.window].direction_to_local(direction)),
                  weight * response);
}

void WindowLight::add_dome(const ReceiverArea& receiver, SlotSums& sums) const {
  const OutsideLight& light = outside_.light();
  const std::size_t slot = panes_.first_of_group(windows_.groups.size() - 1);
  const PathCounts counts = receiver.is_point() ? kDomeOnPoint : kDomeOnCell;
  const SkyPatches& vault = light.patches();
  for (std::size_t patch = 0; patch <= vault.ground(); ++patch) {
    const PathPoints points(receiver, counts, patch != vault.ground(), mix(receiver.stream ^ patch));
    const double weight = vault.solid_angle_sr(patch) / static_cast<double>(points.size());
    for (std::uint64_t i = 0; i < points.size(); ++i) {
      const auto x = points(i);
      const Vec3 direction = light.direction(patch, x[0], x[1]);
      const double response = receiver.response.of(direction);
      if (!(response > 0.0)) continue;
      const Vec3 from = receiver.at(x[2], x[3]);
      const Hit hit = caster_.nearest(from, direction, receiver.skip);
      const bool leaves = hit.plate < 0 || static_cast<std::size_t>(hit.plate) >= zone_.surfaces.size() ||
                          zone_.surfaces[static_cast<std::size_t>(hit.plate)].outside;
      if (leaves) sums.add_seen(slot, outside_.seen(from, direction, hit), weight * response);
    }
  }
}

}  // namespace dim
