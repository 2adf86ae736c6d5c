#include "light/sun_light.hpp"

#include <algorithm>

#include "base/low_discrepancy.hpp"
#include "light/sun_disc.hpp"

namespace dim {
namespace {

constexpr std::uint64_t kRays = 256;

}  // namespace

SunLight::SunLight(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
                   const RayCaster& caster)
    : zone_(zone), windows_(windows), panes_(panes), outside_(outside), caster_(caster) {}

void SunLight::add(const ReceiverArea& receiver, SlotSums& sums) const {
  const OutsideLight& light = outside_.light();
  if (!light.sun() || !(glm::dot(receiver.normal, light.sun()->towards) > -0.5 * kSunDiameter_rad)) return;
  const SunDisc disc(*light.sun());
  const LowDiscrepancy4 points(mix(~receiver.stream));
  const double lx = light.sun()->normal_lx / static_cast<double>(kRays);
  for (std::uint64_t i = 0; i < kRays; ++i) {
    const auto x = points(i);
    const Vec3 direction = disc.direction(x[0], x[1]);
    const double cosine = glm::dot(receiver.normal, direction);
    if (!(cosine > 0.0) || !(direction.z > 0.0)) continue;
    const Vec3 from = receiver.at(x[2], x[3]);
    const bool bare = windows_.dome && caster_.nearest(from, direction, receiver.skip).plate < 0;
    if (bare)
      sums.add_column(panes_.first_of_group(windows_.groups.size() - 1), light.sun_column(), lx * cosine);
    for (std::size_t g = 0; g < windows_.groups.size() && !bare; ++g) {
      const auto& members = windows_.groups[g].windows;
      for (std::size_t k = 0; k < members.size(); ++k) {
        const Window& window = windows_.windows[members[k]];
        const double height_m = window.frame().height(from), incidence = -glm::dot(window.frame().n, direction);
        if (!(height_m > 0.0) || !(incidence > 0.0)) continue;
        const Vec3 on_glass = from + (height_m / incidence) * direction;
        if (!window.polygon.contains(window.frame().to_local(on_glass)) ||
            caster_.blocked(from, on_glass, receiver.skip))
          continue;
        if (!window.open_outside && caster_.nearest(on_glass, direction, window.plate).plate >= 0) continue;
        for (std::size_t s = panes_.first_of_group(g); s < panes_.last_of_group(g); ++s)
          sums.add_column(s, light.sun_column(), lx * cosine * panes_.slots()[s].panes[k].straight_at(incidence));
      }
    }
  }
}

}  // namespace dim
