#include "photometry/intensity.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr double kAngleSlack_rad = 1e-9;

/// Weights of the two end values in the integral of (linear in gamma) sin(gamma) over one interval:
/// int (a + b g) sin g dg = w_lower I_lower + w_upper I_upper. Written about the interval's middle, where
/// the plain form I0 cos g0 - I1 cos g1 + b (sin g1 - sin g0) would cancel for narrow intervals.
struct SineWeights {
  double lower;
  double upper;
};

SineWeights sine_weights(double gamma0, double gamma1) {
  const double h = 0.5 * (gamma1 - gamma0);
  const double middle = gamma0 + h;
  // cos h - sin(h)/h
  const double bend =
      h < 1e-2 ? h * h * (-1.0 / 3 + h * h * (1.0 / 30 - h * h / 840.0)) : std::cos(h) - std::sin(h) / h;
  const double even = std::sin(middle) * std::sin(h);
  const double odd = std::cos(middle) * bend;
  return {even + odd, even - odd};
}

}  // namespace

IntensityTable::IntensityTable(Kind kind, double intensity_cd)
    : kind_(kind), zero_behind_(kind == Kind::kLambertian), max_cd_(intensity_cd) {
  flux_lm_ = (kind == Kind::kIsotropic ? 4.0 : 1.0) * kPi * intensity_cd;
  if (intensity_cd == 0.0) zero_behind_ = true;
}

IntensityTable IntensityTable::isotropic(double intensity_cd) { return {Kind::kIsotropic, intensity_cd}; }

IntensityTable IntensityTable::lambertian(double intensity_cd) { return {Kind::kLambertian, intensity_cd}; }

IntensityTable::IntensityTable(const IntensityDistribution& distribution)
    : kind_(distribution.type == PhotometricType::kC ? Kind::kTable : Kind::kTurnedTable),
      type_(distribution.type),
      n_gamma_(distribution.gamma_rad.size()),
      c_(distribution.c_rad),
      gamma_(distribution.gamma_rad),
      cd_(distribution.intensity_cd) {
  if (cd_.size() != c_.n_nodes() * n_gamma_)
    throw InternalError("intensity table: " + std::to_string(cd_.size()) + " values for " +
                        std::to_string(c_.n_nodes()) + " planes of " + std::to_string(n_gamma_));
  check_angles();
  for (const double cd : cd_)
    if (!(cd >= 0.0) || !std::isfinite(cd))
      throw InternalError("intensity table: negative or non-finite intensity");
  summarise();
}

void IntensityTable::check_angles() const {
  if (gamma_.front_rad() < 0.0 || gamma_.back_rad() > kPi + kAngleSlack_rad)
    throw InternalError("intensity table: angle from the pole outside 0..pi");
  if (kind_ == Kind::kTurnedTable) {
    if (c_.front_rad() < -kPi - kAngleSlack_rad || c_.back_rad() > kPi + kAngleSlack_rad)
      throw InternalError("intensity table: planes outside -pi..pi");
    return;
  }
  if (std::abs(c_.front_rad()) > kAngleSlack_rad || std::abs(c_.back_rad() - 2 * kPi) > kAngleSlack_rad)
    throw InternalError("intensity table: planes do not span the whole turn");
}

double IntensityTable::at_turned(const Vec3& dir_local) const {
  const bool b = type_ == PhotometricType::kB;
  const double to_pole = b ? dir_local.x : dir_local.y;
  const double round = b ? dir_local.y : dir_local.x;
  const double from_pole = half_turn_angle(std::hypot(round, dir_local.z), -to_pole);
  double plane = whole_turn_angle(round, dir_local.z);
  if (plane > kPi) plane -= 2 * kPi;
  if (!gamma_.contains(from_pole) || !c_.contains(plane)) return 0.0;
  return between_planes(plane, from_pole);
}

// Whether any light leaves at more than 90 degrees from the aim. `plane_max_cd` is the largest intensity of
// each plane, `lit_end` one past the last angle of a plane with light.
bool IntensityTable::lit_behind(const std::vector<double>& plane_max_cd, std::size_t lit_end) const {
  const double limit = kPi / 2 + kAngleSlack_rad;
  if (kind_ == Kind::kTable)
    return lit_end > 0 && gamma_.nodes_rad()[std::min(lit_end, n_gamma_ - 1)] > limit;
  const auto& plane = c_.nodes_rad();
  for (std::size_t p = 0; p < plane.size(); ++p) {
    if (plane_max_cd[p] == 0.0) continue;
    const double low = plane[p > 0 ? p - 1 : p];
    const double high = plane[std::min(p + 1, plane.size() - 1)];
    if (low < -limit || high > limit) return true;
  }
  return false;
}

void IntensityTable::summarise() {
  const auto& c = c_.nodes_rad();
  const auto& gamma = gamma_.nodes_rad();
  // Integral over C first: the trapezium rule is exact for an interpolant linear in C.
  std::vector<double> round(n_gamma_, 0.0);
  std::vector<double> plane_max_cd(c.size(), 0.0);
  std::size_t lit_end = 0;  // one past the last gamma with light
  axial_ = kind_ == Kind::kTable;
  if (kind_ == Kind::kTable) ring_max_cd_.assign(n_gamma_, 0.0);
  for (std::size_t p = 0; p < c.size(); ++p) {
    const double before = p > 0 ? c[p] - c[p - 1] : 0.0;
    const double after = p + 1 < c.size() ? c[p + 1] - c[p] : 0.0;
    const double* row = cd_.data() + p * n_gamma_;
    for (std::size_t g = 0; g < n_gamma_; ++g) {
      round[g] += 0.5 * (before + after) * row[g];
      plane_max_cd[p] = std::max(plane_max_cd[p], row[g]);
      if (kind_ == Kind::kTable) ring_max_cd_[g] = std::max(ring_max_cd_[g], row[g]);
      if (row[g] > 0.0) lit_end = std::max(lit_end, g + 1);
      if (row[g] != cd_[g]) axial_ = false;
    }
    max_cd_ = std::max(max_cd_, plane_max_cd[p]);
  }
  for (std::size_t g = 0; g + 1 < n_gamma_; ++g) {
    const SineWeights weights = sine_weights(gamma[g], gamma[g + 1]);
    flux_lm_ += weights.lower * round[g] + weights.upper * round[g + 1];
  }
  zero_behind_ = !lit_behind(plane_max_cd, lit_end);
  summarise_emission();
}

void IntensityTable::summarise_emission() {
  const auto& c = c_.nodes_rad();
  const auto& gamma = gamma_.nodes_rad();
  emitted_.assign(1, 0.0);
  emitted_.reserve((c.size() - 1) * (n_gamma_ - 1) + 1);
  for (std::size_t p = 0; p + 1 < c.size(); ++p) {
    for (std::size_t g = 0; g + 1 < n_gamma_; ++g) {
      const double* row = cd_.data() + p * n_gamma_ + g;
      const double mean_cd = 0.25 * (row[0] + row[1] + row[n_gamma_] + row[n_gamma_ + 1]);
      emitted_.push_back(emitted_.back() +
                         mean_cd * (c[p + 1] - c[p]) * (std::cos(gamma[g]) - std::cos(gamma[g + 1])));
    }
  }
}

Vec3 IntensityTable::direction_of(double plane_rad, double from_pole_rad) const {
  const double across = std::sin(from_pole_rad), along = std::cos(from_pole_rad);
  const double cosine = across * std::cos(plane_rad), sine = across * std::sin(plane_rad);
  if (kind_ != Kind::kTurnedTable) return {cosine, sine, along};
  return type_ == PhotometricType::kB ? Vec3(-along, sine, cosine) : Vec3(sine, -along, cosine);
}

IntensityTable::Emission IntensityTable::emission(double a, double b) const {
  if (!(flux_lm_ > 0.0)) return {{0.0, 0.0, 1.0}, 0.0};
  if (kind_ == Kind::kIsotropic || kind_ == Kind::kLambertian) {
    const double z = kind_ == Kind::kIsotropic ? 1.0 - 2.0 * b : std::sqrt(1.0 - b);
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {{r * std::cos(2.0 * kPi * a), r * std::sin(2.0 * kPi * a), z}, 1.0};
  }
  const double wanted = a * emitted_.back();
  const auto found = std::upper_bound(emitted_.begin(), emitted_.end() - 1, wanted);
  const auto part = static_cast<std::size_t>(found - emitted_.begin()) - 1;
  const std::size_t p = part / (n_gamma_ - 1), g = part % (n_gamma_ - 1);
  const double share_lm = emitted_[part + 1] - emitted_[part];
  const double t = std::clamp((wanted - emitted_[part]) / share_lm, 0.0, 1.0);
  const double c0 = c_.nodes_rad()[p], c1 = c_.nodes_rad()[p + 1];
  const double z0 = std::cos(gamma_.nodes_rad()[g]), z1 = std::cos(gamma_.nodes_rad()[g + 1]);
  const double gamma = std::clamp(std::acos(std::clamp(z0 + b * (z1 - z0), -1.0, 1.0)),
                                  gamma_.nodes_rad()[g], gamma_.nodes_rad()[g + 1]);
  const double plane = c0 + t * (c1 - c0);
  // Density of the draw: share_lm / emitted_.back() over the part's solid angle.
  const double density_per_sr = share_lm / emitted_.back() / ((c1 - c0) * (z0 - z1));
  return {direction_of(plane, gamma), between_planes(plane, gamma) / flux_lm_ / density_per_sr};
}

double IntensityTable::bound_cd(const Vec3& dir_local, double half_angle_rad) const {
  if (kind_ != Kind::kTable) return max_cd_;
  const double gamma = half_turn_angle(std::hypot(dir_local.x, dir_local.y), dir_local.z);
  const auto& nodes = gamma_.nodes_rad();
  // From the node at or before the cone to the one at or behind it.
  auto first = std::upper_bound(nodes.begin(), nodes.end(), gamma - half_angle_rad);
  if (first != nodes.begin()) --first;
  auto last = std::lower_bound(nodes.begin(), nodes.end(), gamma + half_angle_rad);
  if (last != nodes.end()) ++last;
  double bound = 0.0;
  for (auto node = first; node < last; ++node)
    bound = std::max(bound, ring_max_cd_[static_cast<std::size_t>(node - nodes.begin())]);
  return bound;
}

double IntensityTable::at_c_gamma(double c_rad, double gamma_rad) const {
  if (kind_ == Kind::kIsotropic) return max_cd_;
  if (kind_ == Kind::kLambertian) return gamma_rad < kPi / 2 ? max_cd_ * std::cos(gamma_rad) : 0.0;
  if (kind_ == Kind::kTurnedTable) {
    const double across = std::sin(gamma_rad);
    return at_turned({across * std::cos(c_rad), across * std::sin(c_rad), std::cos(gamma_rad)});
  }
  if (!gamma_.contains(gamma_rad)) return 0.0;
  const double turns = std::floor(c_rad / (2 * kPi));
  return between_planes(std::clamp(c_rad - turns * 2 * kPi, 0.0, 2 * kPi), gamma_rad);
}

}  // namespace dim
