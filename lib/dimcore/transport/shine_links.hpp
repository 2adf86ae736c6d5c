#pragma once

#include <cstdint>
#include <vector>

#include "base/job.hpp"
#include "network/network.hpp"
#include "transport/lobe_states.hpp"
#include "transport/mirror_rays.hpp"

namespace dim {

/// What light by direction adds to the links of a network: geometry and mirrors' colours only, whatever the
/// light. Receivers are the cells, then the measuring points.
///
/// Lobes send: psi of a state goes down the rays of its cell's own row, on at mirrors, and all of it arrives
/// somewhere, leaves the zone, or is cut off after many mirrors. Measuring points look along their own rays.
///
/// Mirrors are looked into: a receiver's ray that meets one goes on and sees the diffuse light of what it
/// comes down on, times the k_s F of all mirrors met. What cell j's light then brings to all receivers
/// differs by the sampling from what j's own rays say that mirrors pass on; `mirror_scale` makes the two
/// equal, as the network's column scales do for what is seen without mirrors.
struct ShineLinks {
  /// A cell that a receiver sees by way of mirrors.
  struct Mirror {
    std::uint32_t cell;
    float share;          ///< of the receiver's hemisphere
    std::uint16_t patch;  ///< of the receiver's lobe grid
  };
  /// Of psi[state], what arrives per area of the receiver (at a measuring point: its irradiance).
  struct Lobe {
    std::uint32_t state;
    float weight;
    std::uint16_t patch_in;  ///< of the receiver's lobe grid
  };
  /// What of psi[state] leaves the zone after a mirror, or is cut off; m2.
  struct LobeLoss {
    std::uint32_t state;
    float weight_m2;
    bool escaped;
  };
  /// Of a cell's diffuse light what mirrors pass on, in one class, shares of all it sends: to cells (once for
  /// each that it comes down on), out of the zone, or cut off.
  struct Passed {
    double landed = 0.0, escaped = 0.0, cut = 0.0;
  };

  std::size_t n_classes = 1;
  std::vector<std::uint64_t> mirror_first;  ///< [n_receivers + 1]
  std::vector<Mirror> mirror;
  std::vector<float> mirror_tint;    ///< [n mirror links, n_classes]
  std::vector<double> mirror_scale;  ///< [n_cells, n_classes], on exitances with the network's column scale
  std::vector<Passed> passed;        ///< [n_cells, n_classes]

  std::vector<std::uint64_t> lobe_first;  ///< [n_receivers + 1]
  std::vector<Lobe> lobe;                 ///< with no mirror on the way
  std::vector<std::uint64_t> lobe_by_mirror_first;
  std::vector<Lobe> lobe_by_mirror;
  std::vector<float> lobe_tint;  ///< [n links by mirrors, n_classes]
  std::vector<LobeLoss> lobe_loss;
  std::vector<float> lobe_loss_tint;  ///< [n losses, n_classes]
  std::vector<double> cut_off;        ///< [n_classes] mean share of a receiver's light that is cut off

  /// The families' corrections of off-specular cells' rows, in their order: patch of the lobe grid.
  std::vector<std::uint64_t> family_first;  ///< [n_off_specular + 1], or empty without families
  std::vector<std::uint16_t> family_patch;
};

/// @param of_surface  see `shininess_of_surfaces`
/// @throws Interrupted
ShineLinks link_shine(const Zone& zone, const Cells& cells, const Network& network, std::size_t n_classes,
                      const std::vector<Shininess>& of_surface, const LobeStates& states,
                      const MirrorRays& mirrors, const Job& job);

}  // namespace dim
