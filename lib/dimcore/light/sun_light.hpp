#pragma once

#include <optional>

#include "light/obstructions.hpp"
#include "light/outside.hpp"
#include "light/receiver_area.hpp"
#include "light/slot_sums.hpp"
#include "light/sun_sight.hpp"

namespace dim {

/// Direct light of the sun through windows on any receiver. None where the sun does not shine.
class SunLight {
 public:
  /// @param obstructions  of the zone alone
  SunLight(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
           const Obstructions& obstructions);

  void add(const ReceiverArea& receiver, SlotSums& sums) const;

 private:
  const Windows& windows_;
  const Panes& panes_;
  const OutsideLight& light_;
  std::vector<std::size_t> place_in_group_;  // [n_windows]
  std::optional<SunSight> sight_;            // where the sun shines
};

}  // namespace dim
