#pragma once

#include "geometry/shadow_plates.hpp"
#include "light/outside.hpp"
#include "light/receiver_area.hpp"
#include "light/slot_sums.hpp"

namespace dim {

/// Direct light through windows on any receiver.
///
/// E = integral of tau(incidence) L(direction) w(direction), w the receiver's response, over the solid angle that the visible part of a window
/// fills. Paths are spread evenly over that solid angle, what is seen above the horizon and below it apart, each
/// traced to the glass where something can be in the way, and on outside where something stands. Their number
/// depends on the receiver and the window alone.
class WindowLight {
 public:
  WindowLight(const Zone& zone, const Windows& windows, const Panes& panes, const Outside& outside,
              const RayCaster& caster, const ShadowPlates& plates);

  /// Adds sky, ground and outside surfaces through all windows, and what comes in through no window.
  void add(const ReceiverArea& receiver, SlotSums& sums) const;

 private:
  struct Sight;
  void add(const ReceiverArea& receiver, std::size_t window, SlotSums& sums) const;
  void add_path(const Sight& sight, const Vec3& from, const Vec3& direction, double weight, SlotSums& sums) const;
  void add_dome(const ReceiverArea& receiver, SlotSums& sums) const;

  const Zone& zone_;
  const Windows& windows_;
  const Panes& panes_;
  const Outside& outside_;
  const RayCaster& caster_;
  const ShadowPlates& plates_;
  std::vector<std::uint64_t> stream_;      // [n_windows]
  std::vector<std::size_t> place_in_group_;  // [n_windows]
  std::vector<Frame> klems_frame_;
  std::vector<char> scatters_;             // [n_windows] in some slot
  double tolerance_m_;
};

}  // namespace dim
