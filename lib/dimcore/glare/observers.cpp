#include "glare/observers.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dim {
namespace {

double lowest_m(const Zone& zone) {
  double lowest = std::numeric_limits<double>::max();
  for (const auto& surface : zone.surfaces) {
    if (surface.outside) continue;
    for (const auto& ring : surface.polygon.corners())
      for (const Vec3& corner : ring) lowest = std::min(lowest, corner.z);
  }
  return lowest;
}

}  // namespace

std::vector<ObserverRating> observer_ratings(const Zone& zone, const GlareField& field, const PointSet& set,
                                             const ObserverGrid& grid, const Job& job) {
  const double eye_z = lowest_m(zone) + grid.height_m;
  const auto n_directions = static_cast<std::size_t>(grid.n_directions);
  std::vector<ObserverRating> ratings(set.count * n_directions);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, set.count, 1), [&](const auto& range) {
    for (std::size_t p = range.begin(); p != range.end() && !job.stopped(); ++p) {
      Vec3 eye = zone.points[set.first + p].position;
      eye.z = eye_z;
      const EyePlace place = field.at(eye);
      for (std::size_t k = 0; k < n_directions; ++k) {
        ObserverRating& rating = ratings[p * n_directions + k];
        rating.point = p;
        rating.eye = eye;
        rating.direction = static_cast<int>(k);
        rating.direction_rad = 2.0 * kPi * static_cast<double>(k) / grid.n_directions;
        const Vec3 forward(std::cos(rating.direction_rad), std::sin(rating.direction_rad), 0.0);
        rating.rating = glare_at(place, LineOfSight::along(forward));
      }
    }
  });
  job.check();
  return ratings;
}

const ObserverRating* worst_of(const std::vector<ObserverRating>& ratings) {
  const ObserverRating* worst = nullptr;
  for (const auto& rating : ratings)
    if (!std::isnan(rating.rating.ugr) && (!worst || rating.rating.ugr > worst->rating.ugr)) worst = &rating;
  return worst;
}

}  // namespace dim
