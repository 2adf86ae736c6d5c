#include "light/sun_light.hpp"

namespace dim {

SunLight::SunLight(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
                   const Obstructions& obstructions)
    : windows_(windows), panes_(panes), light_(outside.light()), place_in_group_(windows.windows.size()) {
  for (const auto& group : windows.groups)
    for (std::size_t k = 0; k < group.windows.size(); ++k) place_in_group_[group.windows[k]] = k;
  if (light_.sun()) sight_.emplace(zone, windows, plates_of(zone), obstructions.shadows());
}

void SunLight::add(const ReceiverArea& receiver, SlotSums& sums) const {
  if (!sight_) return;
  const Vec3& towards = light_.sun()->towards;
  const Response& response = receiver.response;
  if (response.is_planar() && !(glm::dot(response.normal, towards) > -0.5 * kSunDiameter_rad)) return;
  std::vector<SunSight::Seen> seen;
  sight_->seen(receiver.ring, response, receiver.skip, sight_->obstacles(receiver.ring, response, receiver.skip),
               towards, seen);
  for (const auto& part : seen) {
    const double lx = light_.sun()->normal_lx * part.factor;
    if (part.window == SunSight::kNoWindow) {
      sums.add_column(panes_.first_of_group(windows_.groups.size() - 1), light_.sun_column(), lx);
      continue;
    }
    const std::size_t group = windows_.windows[part.window].group;
    for (std::size_t s = panes_.first_of_group(group); s < panes_.last_of_group(group); ++s) {
      const Pane& pane = panes_.slots()[s].panes[place_in_group_[part.window]];
      sums.add_column(s, light_.sun_column(), lx * pane.straight_at(part.incidence));
    }
  }
}

}  // namespace dim
