#include "transport/shine.hpp"

#include <algorithm>

namespace dim {

Shine::Shine(const Zone& zone, const Cells& cells, const Network& network, const ReflectanceClasses& classes,
             const RayCaster& caster, const MirrorRayOptions& mirror_rays, const Job& job)
    : cells_(cells),
      of_surface_(shininess_of_surfaces(zone, classes, lobe_grid(network.patches))),
      states_(zone, cells, network, of_surface_),
      optics_(zone, classes, of_surface_, states_.grid()),
      mirror_rays_(zone, cells, classes, of_surface_, caster, mirror_rays) {
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    if (of_surface(s) == Shininess::mirror) mirrors_.push_back(static_cast<int>(s));
  }
  if (any())
    links_ = link_shine(zone, cells, network, classes.size(), of_surface_, states_, mirror_rays_, job);
}

double Shine::cut_off() const {
  return links_.cut_off.empty() ? 0.0 : *std::max_element(links_.cut_off.begin(), links_.cut_off.end());
}

}  // namespace dim
