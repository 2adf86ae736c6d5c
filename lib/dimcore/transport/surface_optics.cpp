#include "transport/surface_optics.hpp"

namespace dim {

SurfaceOptics::SurfaceOptics(const Zone& zone, const ReflectanceClasses& classes,
                             const std::vector<Shininess>& of_surface, const PatchGrid& lobe_grid)
    : facets_(zone.finishes.size()),
      in_class_(classes.size(), std::vector<std::shared_ptr<const InClass>>(zone.finishes.size())) {
  for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
    const auto f = static_cast<std::size_t>(zone.surfaces[s].finish);
    if (of_surface[s] != Shininess::diffusing && !in_class_[0][f])
      add_finish(zone.finishes[f], f, of_surface[s], classes, lobe_grid);
  }
}

void SurfaceOptics::add_finish(const Finish& finish, std::size_t index, Shininess kind,
                               const ReflectanceClasses& classes, const PatchGrid& grid) {
  LobeShape shape;
  if (kind == Shininess::off_specular) {
    facets_[index] = std::make_unique<Facets>(facet_distribution(finish), finish.roughness);
    shape = lobe_shape(grid, *facets_[index]);
  }
  for (std::size_t q = 0; q < classes.size(); ++q) {
    const BandReflection& reflection = classes.of_finish[q][index];
    std::size_t same = 0;
    while (!(classes.of_finish[same][index] == reflection)) ++same;
    if (same < q) {
      in_class_[q][index] = in_class_[same][index];
      continue;
    }
    InClass optics;
    optics.albedo = AlbedoTable(reflection, facets_[index].get());
    optics.slice_albedo = optics.albedo.of_slices(grid);
    if (facets_[index]) {
      optics.lobe = std::make_unique<const LobeMatrix>(shape, reflection, optics.slice_albedo);
      optics.kernel = std::make_unique<const LobeKernel>(*optics.lobe, grid);
    }
    in_class_[q][index] = std::make_shared<const InClass>(std::move(optics));
  }
}

}  // namespace dim
