#pragma once

#include <vector>

#include "base/job.hpp"
#include "glare/glare_field.hpp"

namespace dim {

/// Eyes over the points of a measuring plane or sensors, all at one height above the lowest surface of the
/// room, each looking level in directions the same angle apart, the first along +x.
struct ObserverGrid {
  double height_m = 1.2;  ///< EN 12464-1: 1.2 sitting, 1.65 standing
  int n_directions = 24;  ///< one every 15 degrees
};

struct ObserverRating {
  std::size_t point = 0;  ///< of the set
  Vec3 eye{0.0};          ///< zone-centred
  int direction = 0;
  double direction_rad = 0.0;  ///< from +x towards +y
  UnifiedGlareRating rating;
};

/// [n_points x n_directions], directions fastest; NaN where the eye is in something or no source counts.
/// @throws Interrupted
std::vector<ObserverRating> observer_ratings(const Zone& zone, const GlareField& field, const PointSet& set,
                                             const ObserverGrid& grid, const Job& job);

/// The rating of the greatest UGR; nothing where none has one.
const ObserverRating* worst_of(const std::vector<ObserverRating>& ratings);

}  // namespace dim
