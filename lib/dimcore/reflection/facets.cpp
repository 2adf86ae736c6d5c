#include "reflection/facets.hpp"

#include <algorithm>
#include <cmath>

namespace dim {
namespace {

constexpr std::size_t kSteps = 4096;
constexpr std::size_t kGuides = 4096;  // to find a step by
constexpr double kFarthest = 6.0;      // in units of m: what lies beyond is below 1e-15 of all

}  // namespace

Facets::Facets(FacetDistribution distribution, double rms_slope)
    : distribution_(distribution), rms_slope_(rms_slope) {
  if (distribution_ == FacetDistribution::beckmann) return;
  step_rad_ = std::min(kPi / 2.0, kFarthest * rms_slope_) / kSteps;
  const auto integrand = [&](double delta) {
    const double x = delta / rms_slope_;
    return 2.0 * kPi * std::exp(-x * x) * std::cos(delta) * std::sin(delta);
  };
  cumulative_.push_back(0.0);
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double low = static_cast<double>(i) * step_rad_;
    cumulative_.push_back(cumulative_.back() + step_rad_ / 6.0 *
                                                   (integrand(low) + 4.0 * integrand(low + step_rad_ / 2.0) +
                                                    integrand(low + step_rad_)));
  }
  c1_ = 1.0 / cumulative_.back();
  for (double& share : cumulative_) share *= c1_;
  for (std::size_t g = 0, step = 0; g < kGuides; ++g) {
    while (step + 1 < kSteps && cumulative_[step + 1] <= static_cast<double>(g) / kGuides) ++step;
    guide_.push_back(static_cast<std::uint16_t>(step));
  }
}

double Facets::density(double cos_tilt) const {
  const double cosine = std::clamp(cos_tilt, 0.0, 1.0);
  if (cosine == 0.0 && distribution_ == FacetDistribution::beckmann) return 0.0;
  const double sine2 = (1.0 - cosine) * (1.0 + cosine);
  if (distribution_ == FacetDistribution::gaussian) {
    const double x = std::atan2(std::sqrt(sine2), cosine) / rms_slope_;
    return c1_ * std::exp(-x * x);
  }
  const double cos2 = cosine * cosine, m2 = rms_slope_ * rms_slope_;
  return std::exp(-sine2 / (cos2 * m2)) / (kPi * m2 * cos2 * cos2);
}

double Facets::tilt_rad(double u) const {
  if (distribution_ == FacetDistribution::beckmann)
    return std::atan(rms_slope_ * std::sqrt(-std::log1p(-std::min(u, 1.0 - 1e-16))));
  std::size_t step = guide_[std::min(static_cast<std::size_t>(u * kGuides), kGuides - 1)];
  while (step + 1 < kSteps && cumulative_[step + 1] <= u) ++step;
  const double low = cumulative_[step], high = cumulative_[step + 1];
  // Area grows with the square of the tilt near 0: between steps, interpolate the square.
  const auto i = static_cast<double>(step);
  const double t = high > low ? std::clamp((u - low) / (high - low), 0.0, 1.0) : 0.0;
  return step_rad_ * std::sqrt(i * i + t * (2.0 * i + 1.0));
}

double facet_weight(const Vec3& half, const Vec3& in, const Vec3& out) {
  const double facing = glm::dot(in, half);
  if (!(facing > 0.0) || !(out.z > 0.0) || !(half.z > 0.0)) return 0.0;
  if (!(in.z > 0.0)) return 2.0;
  return std::min({facing / (in.z * half.z), 2.0 * out.z / in.z, 2.0});
}

}  // namespace dim
