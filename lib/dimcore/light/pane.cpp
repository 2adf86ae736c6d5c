#include "light/pane.hpp"

#include <algorithm>

namespace dim {
namespace {

std::vector<double> reflectance_outside(const Zone& zone, const std::vector<BandReflection>& of_finish) {
  std::vector<double> reflectance;
  for (const auto& surface : zone.surfaces) {
    const BandReflection& finish = of_finish[static_cast<std::size_t>(surface.finish)];
    // What outside surfaces reflect like a mirror they are taken to reflect evenly.
    const double specular = finish.fresnel(1.0);
    reflectance.push_back(surface.outside ? std::min(0.999, finish.diffuse + specular) : 0.0);
  }
  return reflectance;
}

}  // namespace

Panes::Panes(const Zone& zone, const Windows& windows, const std::vector<std::vector<BandReflection>>& of_finish) {
  std::vector<std::size_t> outside_class;
  for (const auto& finishes : of_finish) {
    auto reflectance = reflectance_outside(zone, finishes);
    const auto known = std::find(outside_reflectance_.begin(), outside_reflectance_.end(), reflectance);
    outside_class.push_back(static_cast<std::size_t>(known - outside_reflectance_.begin()));
    if (known == outside_reflectance_.end()) outside_reflectance_.push_back(std::move(reflectance));
  }
  for (std::size_t g = 0; g < windows.groups.size(); ++g) {
    const WindowGroup& group = windows.groups[g];
    first_of_group_.push_back(slots_.size());
    slot_of_.emplace_back(group.states.size());
    for (std::size_t s = 0; s < group.states.size(); ++s) {
      const std::size_t first = slots_.size();
      for (std::size_t q = 0; q < of_finish.size(); ++q) {
        PaneSlot slot{g, s, outside_class[q], {}};
        for (const std::size_t w : group.windows) {
          const int finish = windows.windows[w].finish_of_state[s];
          slot.panes.push_back(finish < 0 ? Pane{} : pane(zone, finish, of_finish[q][static_cast<std::size_t>(finish)]));
        }
        const auto same = std::find_if(slots_.begin() + static_cast<std::ptrdiff_t>(first), slots_.end(),
                                       [&](const PaneSlot& known) {
                                         return known.outside_class == slot.outside_class && known.panes == slot.panes;
                                       });
        slot_of_[g][s].push_back(static_cast<std::size_t>(same - slots_.begin()));
        if (same == slots_.end()) slots_.push_back(std::move(slot));
      }
      tinted_ = tinted_ || slots_.size() - first > 1;
    }
  }
  first_of_group_.push_back(slots_.size());
}

Pane Panes::pane(const Zone& zone, int finish, const BandReflection& reflection) {
  const Finish& glass = zone.finishes[static_cast<std::size_t>(finish)];
  const double normal = reflection.transmittance;
  auto law = std::find_if(laws_.begin(), laws_.end(),
                          [&](const Law& known) { return known.finish == finish && known.normal == normal; });
  if (law == laws_.end()) {
    laws_.push_back({finish, normal, std::make_unique<const Transmission>(glass, normal)});
    law = std::prev(laws_.end());
  }
  Pane result;
  result.straight = law->straight.get();
  if (glass.angular_law == "bsdf" || glass.angular_law == "diffusing") result.scattering = &glass;
  if (glass.angular_law == "diffusing") result.diffuse = (1.0 - glass.direct) * normal;
  return result;
}

}  // namespace dim
