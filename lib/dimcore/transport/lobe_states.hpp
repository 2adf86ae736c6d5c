#pragma once

#include <cstdint>
#include <vector>

#include "network/cells.hpp"
#include "network/network.hpp"
#include "transport/optics.hpp"

namespace dim {

/// Numbers of the light by direction: off-specular cell g, patch r of its lobe grid is state
/// g * n_patches + r; and how the patches of the network lie in those of the lobe grid.
class LobeStates {
 public:
  /// @param of_surface  see `shininess_of_surfaces`; must outlive this
  LobeStates(const Zone& zone, const Cells& cells, const Network& network,
             const std::vector<Shininess>& of_surface);

  const PatchGrid& grid() const { return grid_; }
  std::size_t n_patches() const { return grid_.n_patches(); }
  std::size_t size() const { return cells_with_lobe_.size() * n_patches(); }

  /// Cells with a lobe, ascending.
  const std::vector<std::uint32_t>& cells_with_lobe() const { return cells_with_lobe_; }
  /// Index into cells_with_lobe(), or -1.
  std::int32_t index_of(std::size_t cell) const { return index_of_[cell]; }

  /// Patch of the lobe grid that the middle of a network's patch lies in.
  std::uint16_t patch_of(std::size_t network_patch) const { return patch_of_[network_patch]; }
  /// What of a lobe patch's light goes down the network's ray: its weight over those of all rays there.
  double share_of(std::size_t network_patch) const { return share_of_[network_patch]; }

  /// Patch of a shiny cell's lobe grid where light that travels along `direction` (unit) comes in; 0 for
  /// other cells.
  std::uint16_t patch_in(std::size_t cell, const Vec3& direction) const;
  /// State of an off-specular cell whose light travels along -direction.
  std::uint32_t state_towards(std::size_t cell, const Vec3& direction) const {
    return static_cast<std::uint32_t>(static_cast<std::size_t>(index_of_[cell]) * n_patches() +
                                      patch_in(cell, direction));
  }
  int slice_of_state(std::size_t state) const {
    return static_cast<int>(state % n_patches() / static_cast<std::size_t>(grid_.n_sectors));
  }

 private:
  const Zone& zone_;
  const Cells& cells_;
  const std::vector<Shininess>& of_surface_;
  PatchGrid grid_;
  std::vector<std::uint32_t> cells_with_lobe_;
  std::vector<std::int32_t> index_of_;
  std::vector<std::uint16_t> patch_of_;  // [network patches]
  std::vector<double> share_of_;         // [network patches]
};

}  // namespace dim
