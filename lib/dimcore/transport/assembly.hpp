#pragma once

#include <vector>

#include "light/first_flight.hpp"
#include "transport/daylight_columns.hpp"
#include "transport/direct_columns.hpp"
#include "transport/gather.hpp"
#include "transport/solution.hpp"

namespace dim {

/// Diffuse reflectances of surfaces for every column of a plan.
Reflectances diffuse_reflectances(const Zone& zone, const ModelPlan& plan);

/// Puts a solution together, from columns as they are solved into rows as they are stored; what ended below zero
/// by rounding is zero.
class Assembly {
 public:
  Assembly(const Room& room, const ModelPlan& plan, const Shine& shine, const Bands& bands);

  /// Direct light of luminaires and images, before `DirectColumns::add_followed`.
  /// @returns the same as columns
  struct DirectAsColumns {
    Columns<float> cell, point;
  };
  DirectAsColumns add_direct(const DirectColumns& direct);

  /// All light, the counts, and the energy balance of every source and band.
  /// @param flights   [n_sources]
  /// @param daylight  null without a sky
  void add_total(Gathered<float> gathered, const DirectColumns& direct, const std::vector<FirstFlight>& flights,
                 const DaylightSources* daylight);

  /// @throws InputError  naming the first source whose light is beyond what single precision holds
  Solution finish();

 private:
  const ModelPlan& plan_;
  const Shine& shine_;
  const Cells& cells_;
  std::size_t n_zone_surfaces_;
  std::vector<float> surface_direct_deviation_;
  std::vector<float> point_direct_deviation_;  // kept where the other parts of the error are known as well
  Solution solution_;
};

}  // namespace dim
