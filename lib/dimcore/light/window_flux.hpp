#pragma once

#include <array>
#include <vector>

#include "light/outside.hpp"
#include "light/pane.hpp"

namespace dim {

/// Light as it falls on the outer faces of windows and comes in through them, by rays from the windows: what
/// scattering panes glow with, and what the energy balance counts as emitted. Shares no code with `WindowLight` but
/// the ray caster and the outside.
class WindowFlux {
 public:
  /// @throws Interrupted
  WindowFlux(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
             const RayCaster& caster, const Job& job);

  /// Flux into the zone, lm: [n_columns] of a slot.
  const std::vector<double>& flux_lm(std::size_t slot) const { return flux_lm_[slot]; }
  /// What of the light that goes straight on leaves the zone again without meeting a surface, lm, and what meets backs
  /// of surfaces.
  const std::vector<double>& escaped_lm(std::size_t slot) const { return escaped_lm_[slot]; }
  const std::vector<double>& lost_lm(std::size_t slot) const { return lost_lm_[slot]; }

  /// Luminance of a scattering pane towards the zone, cd/m2: [n_directions, n_columns], for each Klems patch, or
  /// one for all directions where it scatters evenly; empty where it does not scatter.
  const std::vector<double>& glow_cd_m2(std::size_t slot, std::size_t place_in_group) const {
    return glow_cd_m2_[slot][place_in_group];
  }

 private:
  enum Fate : std::size_t { stays, escapes, is_lost };
  using ByFate = std::array<std::vector<double>, 3>;
  // Illuminance of a window's outer face, lx: by Klems patch of incidence and column, and as straight panes pass it.
  struct Incident {
    std::vector<double> by_patch_lx;  // [145, n_columns]; empty where nothing scatters
    ByFate passed_lx;                 // [n_columns] each
  };
  class Gatherer;
  Incident incident(const Window& window, const Pane& pane, std::size_t outside_class, std::uint64_t stream) const;
  std::vector<double> glow(const Pane& pane, const Incident& light) const;
  Fate fate(const Vec3& on_glass, const Vec3& inwards, int plate) const;

  const Zone& zone_;
  const Outside& outside_;
  const RayCaster& caster_;
  std::vector<std::vector<double>> flux_lm_, escaped_lm_, lost_lm_;
  std::vector<std::vector<std::vector<double>>> glow_cd_m2_;
};

}  // namespace dim
