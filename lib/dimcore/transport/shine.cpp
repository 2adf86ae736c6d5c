#include "transport/shine.hpp"

#include <algorithm>

namespace dim {

Shine::Shine(const Zone& zone, const Cells& cells, const Network& network, const ReflectanceClasses& classes,
             const RayCaster& caster, const MirrorRayOptions& mirror_rays, const Job& job)
    : cells_(cells),
      optics_(zone, classes, lobe_grid(network.patches)),
      states_(zone, cells, network, optics_),
      mirror_rays_(zone, cells, optics_, caster, mirror_rays) {
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    if (of_surface(s) == Shininess::mirror) mirrors_.push_back(static_cast<int>(s));
  }
  if (any()) links_ = link_shine(zone, cells, network, states_, optics_, mirror_rays_, has_mirrors(), job);
}

double Shine::cut_off() const {
  return links_.cut_off.empty() ? 0.0 : *std::max_element(links_.cut_off.begin(), links_.cut_off.end());
}

}  // namespace dim
