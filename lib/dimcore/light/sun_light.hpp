#pragma once

#include "light/outside.hpp"
#include "light/receiver_area.hpp"
#include "light/slot_sums.hpp"

namespace dim {

/// Direct light of the sun through windows on any receiver, by rays to its disc. None where the sun does not shine.
class SunLight {
 public:
  SunLight(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
           const RayCaster& caster);

  void add(const ReceiverArea& receiver, SlotSums& sums) const;

 private:
  const Zone& zone_;
  const Windows& windows_;
  const Panes& panes_;
  const Outside& outside_;
  const RayCaster& caster_;
};

}  // namespace dim
