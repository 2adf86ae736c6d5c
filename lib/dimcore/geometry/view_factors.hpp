#pragma once

#include <cstdint>
#include <vector>

#include "base/job.hpp"
#include "geometry/ray_caster.hpp"

namespace dim {

/// Diffuse view factors between polygons: of the light that leaves polygon i evenly in area and by the cosine
/// law, the share F_ij that falls on the lit side of polygon j with nothing in its way.
struct ViewFactors {
  struct Entry {
    std::uint32_t to = 0;
    double value = 0.0;
  };
  /// One row per plate, its entries by ascending `to`; pairs that are not listed do not see each other.
  /// Exactly reciprocal up to one rounding: A_i F_ij = A_j F_ji.
  std::vector<std::vector<Entry>> rows;
  std::vector<double> row_sums;  ///< estimates 1 - escaped - behind, from independent samples: not forced to
  std::vector<double> escaped;   ///< share of each polygon's rays that met nothing
  std::vector<double> behind;    ///< share that met the back of a plate whose back is not open: a leak
  /// How well the rays alone are reciprocal, the check of the ray tracing before pairs are refined: sum, and
  /// root of the sum of squares, of |A_i F_ij - A_j F_ji| over all pairs, over the area of all polygons.
  double reciprocity_total = 0.0;
  double reciprocity_rms = 0.0;

  double at(std::size_t from, std::size_t to) const;
};

/// Rays a polygon sends out by default.
inline constexpr int kViewFactorRays = 32768;

/// View factors of all pairs of plates, obstruction included.
///
/// First every polygon sends `rays_per_polygon` rays, evenly spread over its area (holes left out exactly)
/// and by the cosine law: they find the pairs that see each other and the shares that escape. Each such pair
/// is then
///
///   A_i F_ij = (exchange with nothing between, exact: pair_exchange_m2) x (visible share),
///
/// the visible share from lines between the two, spread by solid angle. Where the first eighth of the lines
/// is all free the share is 1, and the factor exact. Else rays_per_polygon * sqrt(F) lines are sent, F the
/// larger of the pair's two factors, so that small factors, too, become good; more where there are so few
/// pairs that it costs nothing.
///
/// Relative errors measured at the default number of rays:
///   opposed and perpendicular rectangles, nothing between, factors 0.0005 to 0.9         below 1e-6
///   closed forms: half hidden, behind a partition, through a hole, factors 0.002 to 0.1  at most 0.3 %
///   54 polygons of a furnished room against 16 times the rays, pairs partly hidden,
///     the larger factor above 0.1, 0.01, 0.001                          RMS 0.06 %, 0.13 %, 0.19 %
///   slivers of factors below 1e-4 may be missed
/// Time on one core: 0.7 s for 54 polygons, 36 s for 966 (a room full of desks).
///
/// The same for any number of threads.
///
/// @param plates            near the origin, as RayCaster wants them; open_back: what hits the back passes
/// @param diameter_m        size of the zone
/// @param rays_per_polygon  >= 1; errors fall about as its root, time grows with it
/// @throws Interrupted when the job is stopped
ViewFactors view_factors(const std::vector<Plate>& plates, double diameter_m,
                         int rays_per_polygon = kViewFactorRays, const Job& job = {});

}  // namespace dim
