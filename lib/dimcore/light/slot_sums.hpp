#pragma once

#include <vector>

#include "light/window_flux.hpp"

namespace dim {

/// What one receiver gets, by slot: in columns; from outside cells and scattering panes first as weights, brought to
/// columns at the end, since every one of them adds to all columns.
class SlotSums {
 public:
  SlotSums(const Windows& windows, const Panes& panes, const Outside& outside, const WindowFlux& flux);

  void clear();

  /// A path through a window of the slot's group. @param weight  response of the receiver times solid angle, sr
  /// @param cos_incidence  on the glass
  void add(std::size_t slot, std::size_t place_in_group, const OutsideSeen& seen, double cos_incidence,
           double weight) {
    const Pane& pane = panes_.slots()[slot].panes[place_in_group];
    add_seen(slot, seen, weight * pane.straight_at(cos_incidence));
  }
  /// A path through no window.
  void add_seen(std::size_t slot, const OutsideSeen& seen, double weight) {
    seen.each_column([&](std::size_t c, double cd_m2) { light_lx_[slot * n_columns_ + c] += weight * cd_m2; });
    if (seen.cell >= 0) of_cells_[slot * n_cells_ + static_cast<std::size_t>(seen.cell)] += weight;
  }
  /// A line to a window, for its scattering panes. @param klems_patch  that light travels in
  void add_glow(std::size_t window, std::size_t klems_patch, double weight) {
    glow_[window * klems::kPatches + klems_patch] += weight;
  }

  void add_column(std::size_t slot, std::size_t column, double lx) { light_lx_[slot * n_columns_ + column] += lx; }

  /// Illuminance in each slot and column, lx: [n_slots, n_columns].
  const std::vector<double>& finish();

 private:
  const Windows& windows_;
  const Panes& panes_;
  const Outside& outside_;
  const WindowFlux& flux_;
  std::size_t n_columns_, n_cells_;
  std::vector<double> light_lx_, of_cells_, glow_;
};

}  // namespace dim
