#include "light/slot_sums.hpp"

#include <algorithm>

namespace dim {

SlotSums::SlotSums(const Windows& windows, const Panes& panes, const Outside& outside, const WindowFlux& flux)
    : windows_(windows),
      panes_(panes),
      outside_(outside),
      flux_(flux),
      n_columns_(outside.light().n_columns()),
      n_cells_(outside.n_cells()),
      light_lx_(panes.slots().size() * n_columns_),
      of_cells_(panes.slots().size() * n_cells_),
      glow_(windows.windows.size() * klems::kPatches) {}

void SlotSums::clear() {
  for (auto* sums : {&light_lx_, &of_cells_, &glow_}) std::fill(sums->begin(), sums->end(), 0.0);
}

const std::vector<double>& SlotSums::finish() {
  const auto add = [&](std::size_t slot, double weight, const double* cd_m2) {
    if (weight == 0.0) return;
    for (std::size_t c = 0; c < n_columns_; ++c) light_lx_[slot * n_columns_ + c] += weight * cd_m2[c];
  };
  for (std::size_t s = 0; s < panes_.slots().size(); ++s) {
    const PaneSlot& slot = panes_.slots()[s];
    for (std::size_t j = 0; j < n_cells_; ++j)
      add(s, of_cells_[s * n_cells_ + j], outside_.luminance_cd_m2(slot.outside_class, j));
    const auto& members = windows_.groups[slot.group].windows;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const auto& glow_cd_m2 = flux_.glow_cd_m2(s, k);
      if (glow_cd_m2.empty()) continue;
      const bool evenly = glow_cd_m2.size() == n_columns_;
      for (std::size_t out = 0; out < klems::kPatches; ++out)
        add(s, glow_[members[k] * klems::kPatches + out], &glow_cd_m2[evenly ? 0 : out * n_columns_]);
    }
  }
  return light_lx_;
}

}  // namespace dim
