#include "transport/optics.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

Shininess shininess(const Finish& finish, std::size_t index, const ReflectanceClasses& classes,
                    const PatchGrid& grid) {
  const bool any = std::any_of(classes.of_finish.begin(), classes.of_finish.end(), [&](const auto& finishes) {
    const BandReflection& reflection = finishes[index];
    return reflection.fresnel(1.0) > 0.0 || reflection.fresnel(0.0) > 0.0;
  });
  if (!any) return Shininess::diffusing;
  const double patch_radius_rad = std::sqrt(grid.solid_angle_sr() / kPi);
  return lobe_half_width_rad(finish.roughness) < patch_radius_rad ? Shininess::mirror
                                                                  : Shininess::off_specular;
}

}  // namespace

ReflectanceClasses classify(const Zone& zone, const Bands& bands, bool apart, const LatticeValues* luminous) {
  ReflectanceClasses classes;
  if (luminous && bands.size() == 1) {
    classes = classify(zone, bands, apart, nullptr);
    std::vector<BandReflection> seen;
    for (const auto& finish : zone.finishes) seen.push_back(weighted_reflection(finish, *luminous));
    classes.luminous = seen != classes.of_finish.front();
    classes.of_finish.front() = std::move(seen);
    return classes;
  }
  for (std::size_t b = 0; b < bands.size(); ++b) {
    std::vector<BandReflection> finishes;
    for (const auto& finish : zone.finishes)
      finishes.push_back(band_reflection(finish, bands.low_nm(b), bands.high_nm(b)));
    const auto first = apart ? classes.of_finish.end() : classes.of_finish.begin();
    const auto known = std::find(first, classes.of_finish.end(), finishes);
    classes.of_band.push_back(static_cast<std::size_t>(known - classes.of_finish.begin()));
    if (known == classes.of_finish.end()) classes.of_finish.push_back(std::move(finishes));
  }
  return classes;
}

PatchGrid lobe_grid(const PatchGrid& network) {
  PatchGrid grid = network;
  while (grid.n_patches() > kMostLobePatches) {
    grid.n_slices = (grid.n_slices + 1) / 2;
    grid.n_sectors = (grid.n_sectors + 1) / 2;
  }
  return grid;
}

std::vector<Shininess> shininess_of_surfaces(const Zone& zone, const ReflectanceClasses& classes,
                                             const PatchGrid& grid) {
  std::vector<Shininess> of_finish, of_surface;
  for (std::size_t f = 0; f < zone.finishes.size(); ++f)
    of_finish.push_back(shininess(zone.finishes[f], f, classes, grid));
  for (const auto& surface : zone.surfaces)
    of_surface.push_back(surface.outside ? Shininess::diffusing
                                         : of_finish[static_cast<std::size_t>(surface.finish)]);
  return of_surface;
}

}  // namespace dim
