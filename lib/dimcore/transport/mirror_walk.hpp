#pragma once

#include <vector>

#include "geometry/ray_caster.hpp"
#include "network/cells.hpp"
#include "reflection/mirror.hpp"
#include "transport/shine.hpp"

namespace dim {

/// What became of light that mirrors reflect, by class, lm.
struct MirrorFate {
  std::vector<double> reflected;  ///< by mirrors, all that is sent on
  std::vector<double> escaped;    ///< of that, out of the zone or onto backs
  std::vector<double>
      not_followed;  ///< reflected, too, but given up: next to nothing was left, or no end seen

  explicit MirrorFate(std::size_t n_classes = 0)
      : reflected(n_classes, 0.0), escaped(n_classes, 0.0), not_followed(n_classes, 0.0) {}
};

/// Follows light from mirror to mirror until it comes down elsewhere or leaves.
class MirrorWalk {
 public:
  MirrorWalk(const Zone& zone, const Cells& cells, const ReflectanceClasses& classes, const Shine& shine,
             const RayCaster& caster)
      : zone_(zone), cells_(cells), classes_(classes), shine_(shine), caster_(caster) {}

  /// @param at, direction  where, and along which unit vector, light comes in on surface `mirror`
  /// @param flux           [n_classes] that comes in there, lm; used up
  /// @param on_landing     (cell, direction, flux) wherever it comes in next, mirrors included
  template <class OnLanding>
  void follow(Vec3 at, Vec3 direction, int mirror, std::vector<double>& flux, MirrorFate& fate,
              OnLanding&& on_landing) const {
    const double least = kNothingLeft * *std::max_element(flux.begin(), flux.end());
    for (int met = 1;; ++met) {
      const Surface& surface = zone_.surfaces[static_cast<std::size_t>(mirror)];
      const double left =
          meet_mirror(surface.polygon.frame().n, direction, flux,
                      [&](std::size_t q) -> const BandReflection& { return classes_.at(q, surface.finish); });
      if (met > kMostMirrors || !(left > least)) return add(fate.not_followed, flux);
      add(fate.reflected, flux);
      const Hit hit = caster_.nearest(at, direction, mirror);
      const auto s = static_cast<std::size_t>(hit.plate);
      if (hit.plate < 0 || hit.back || s >= zone_.surfaces.size() || zone_.surfaces[s].outside)
        return add(fate.escaped, flux);
      on_landing(cells_.cell_hit(s, hit.local, direction), direction,
                 flux);
      if (shine_.of_surface(s) != Shininess::mirror) return;
      at += hit.t * direction;
      mirror = hit.plate;
    }
  }

 private:
  static constexpr double kNothingLeft = 1e-4;  // of the light that was sent on its way
  static constexpr int kMostMirrors = 1000;

  static void add(std::vector<double>& sum, const std::vector<double>& flux) {
    for (std::size_t q = 0; q < flux.size(); ++q) sum[q] += flux[q];
  }

  const Zone& zone_;
  const Cells& cells_;
  const ReflectanceClasses& classes_;
  const Shine& shine_;
  const RayCaster& caster_;
};

}  // namespace dim
