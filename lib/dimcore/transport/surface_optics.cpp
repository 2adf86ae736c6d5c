#include "transport/surface_optics.hpp"

namespace dim {

SurfaceOptics::SurfaceOptics(const Zone& zone, const ReflectanceClasses& classes, const PatchGrid& lobe_grid)
    : classes_(classes),
      grid_(lobe_grid),
      facets_(zone.finishes.size()),
      in_class_(classes.size(), std::vector<std::shared_ptr<const InClass>>(zone.finishes.size())) {
  const auto of_finish = shininess_of_finishes(zone, classes, grid_);
  std::vector<bool> seen(zone.finishes.size(), false);
  for (const auto& surface : zone.surfaces) {
    const auto f = static_cast<std::size_t>(surface.finish);
    of_surface_.push_back(surface.outside ? Shininess::diffusing : of_finish[f]);
    if (of_surface_.back() != Shininess::diffusing) seen[f] = true;
  }
  for (std::size_t f = 0; f < seen.size(); ++f) {
    if (seen[f]) add_finish(zone.finishes[f], f, of_finish[f]);
  }
}

void SurfaceOptics::add_finish(const Finish& finish, std::size_t index, Shininess kind) {
  LobeShape shape;
  if (kind == Shininess::off_specular) {
    facets_[index] = std::make_unique<Facets>(facet_distribution(finish), finish.roughness);
    shape = lobe_shape(grid_, *facets_[index]);
  }
  for (std::size_t q = 0; q < n_classes(); ++q) {
    const BandReflection& reflection = classes_.of_finish[q][index];
    std::size_t same = 0;
    while (!(classes_.of_finish[same][index] == reflection)) ++same;
    if (same < q) {
      in_class_[q][index] = in_class_[same][index];
      continue;
    }
    InClass optics;
    optics.albedo = AlbedoTable(reflection, facets_[index].get());
    optics.slice_albedo = optics.albedo.of_slices(grid_);
    if (facets_[index]) {
      optics.lobe = std::make_unique<const LobeMatrix>(shape, reflection, optics.slice_albedo);
      optics.kernel = std::make_unique<const LobeKernel>(*optics.lobe, grid_);
    }
    in_class_[q][index] = std::make_shared<const InClass>(std::move(optics));
  }
}

}  // namespace dim
