#include "transport/lobe_states.hpp"

#include <algorithm>

namespace dim {

LobeStates::LobeStates(const Zone& zone, const Cells& cells, const Network& network,
                       const std::vector<Shininess>& of_surface)
    : zone_(zone),
      cells_(cells),
      of_surface_(of_surface),
      grid_(lobe_grid(network.patches)),
      index_of_(cells.size(), -1) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (of_surface[cells.surface_of(i)] != Shininess::off_specular) continue;
    index_of_[i] = static_cast<std::int32_t>(cells_with_lobe_.size());
    cells_with_lobe_.push_back(static_cast<std::uint32_t>(i));
  }
  const PatchGrid& fine = network.patches;
  // Middles in whole numbers: (k + 1/2) n_coarse / n_fine, rounded down.
  const auto coarse = [](std::int64_t k, std::int64_t n_fine, std::int64_t n_coarse) {
    return (2 * k + 1) * n_coarse / (2 * n_fine);
  };
  std::vector<double> weight_sr(n_patches(), 0.0);
  for (int slice = 0; slice < fine.n_slices; ++slice) {
    for (int sector = 0; sector < fine.n_sectors; ++sector) {
      const auto patch = coarse(slice, fine.n_slices, grid_.n_slices) * grid_.n_sectors +
                         coarse(sector, fine.n_sectors, grid_.n_sectors);
      patch_of_.push_back(static_cast<std::uint16_t>(patch));
      share_of_.push_back(fine.weight_sr(slice));
      weight_sr[patch_of_.back()] += share_of_.back();
    }
  }
  for (std::size_t k = 0; k < share_of_.size(); ++k) share_of_[k] /= weight_sr[patch_of_[k]];
}

std::uint16_t LobeStates::patch_in(std::size_t cell, const Vec3& direction) const {
  const std::size_t surface = cells_.surface_of(cell);
  if (of_surface_[surface] == Shininess::diffusing) return 0;
  Vec3 local = -zone_.surfaces[surface].polygon.frame().direction_to_local(direction);
  local.z = std::max(local.z, 1e-9);
  return static_cast<std::uint16_t>(grid_.patch_of(local));
}

}  // namespace dim
