#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace dim {

enum class FacetDistribution { gaussian, beckmann };

/// Slopes of a rough surface's micro-facets: D(delta) with int D cos(delta) d omega = 1 over the hemisphere.
///
/// gaussian: c1 exp(-(delta/m)^2), equation (14), c1 by quadrature for any m; beckmann (Cook & Torrance
/// 1982): exp(-(tan(delta)/m)^2) / (pi m^2 cos^4(delta)). m is the RMS slope, > 0.
class Facets {
 public:
  Facets(FacetDistribution distribution, double rms_slope);

  /// D, 1/sr. @param cos_tilt of the facet against the surface, 0..1
  double density(double cos_tilt) const;

  /// Tilt angle below which the share `u` (0..1) of all facet area, projected on the surface, lies: with u
  /// and an azimuth uniform, facets come with density D cos(delta).
  double tilt_rad(double u) const;

 private:
  FacetDistribution distribution_;
  double rms_slope_;
  double c1_ = 0.0;
  double step_rad_ = 0.0;
  std::vector<double> cumulative_;    // gaussian: int_0^{i step} D cos sin 2 pi
  std::vector<std::uint16_t> guide_;  // of equal parts of u: a step that does not lie above any u of the part
};

/// A facet's share of the light from `in`, over D cos(delta): (i.h) G / (cos(in) cos(delta)), 0..2, with G
/// the masking of V-shaped cavities (Torrance & Sparrow 1967), equation (13). Zero where the facet faces away
/// or sends the light below the surface. Its mean over facets drawn with D cos(delta), times F, is the
/// directional albedo; never above 1, since facets opposite in azimuth add up to at most 2.
double facet_weight(const Vec3& half, const Vec3& in, const Vec3& out);

}  // namespace dim
