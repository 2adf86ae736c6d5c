#include "sky/sky_patches.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"

namespace dim {
namespace {

constexpr std::array<int, 7> kTregenzaBands = {30, 30, 24, 24, 18, 12, 6};

Vec3 at(double altitude_rad, double turn_rad) {
  const double level = std::cos(altitude_rad);
  return {level * std::cos(turn_rad), level * std::sin(turn_rad), std::sin(altitude_rad)};
}

}  // namespace

SkyPatches::SkyPatches(int subdivision) : subdivision_(subdivision) {
  if (subdivision != 1 && subdivision != 2 && subdivision != 4)
    throw InternalError("a sky is subdivided by 1, 2 or 4");
  band_rad_ = 0.5 * kPi / (7.0 * subdivision + 0.5);
  for (int band = 0; band < 7 * subdivision; ++band) {
    first_.push_back(boxes_.size());
    const int n = subdivision * kTregenzaBands[static_cast<std::size_t>(band / subdivision)];
    const double width = 2.0 * kPi / n;
    for (int i = 0; i < n; ++i)
      boxes_.push_back({band * band_rad_, (band + 1) * band_rad_, (i - 0.5) * width, (i + 0.5) * width});
  }
  first_.push_back(boxes_.size());
  boxes_.push_back({7 * subdivision * band_rad_, 0.5 * kPi, 0.0, 2.0 * kPi});
  first_.push_back(boxes_.size());
  for (std::size_t band = 0; band + 1 < first_.size(); ++band) {
    band_.insert(band_.end(), first_[band + 1] - first_[band], band);
    sine_.push_back(std::sin(boxes_[first_[band]].low_rad));
  }
}

double SkyPatches::solid_angle_sr(std::size_t patch) const {
  if (patch == ground()) return 2.0 * kPi;
  const SkyBox& b = boxes_[patch];
  // sin high - sin low, without cancellation.
  return 2.0 * std::cos(0.5 * (b.high_rad + b.low_rad)) * std::sin(0.5 * (b.high_rad - b.low_rad)) *
         (b.last_rad - b.first_rad);
}

double SkyPatches::horizontal_sr(std::size_t patch) const {
  const SkyBox& b = boxes_[patch];
  return 0.5 * std::sin(b.high_rad + b.low_rad) * std::sin(b.high_rad - b.low_rad) *
         (b.last_rad - b.first_rad);
}

double SkyPatches::cylinder_sr(std::size_t patch) const {
  const SkyBox& b = boxes_[patch];
  const double height = b.high_rad - b.low_rad;
  return 0.5 * (height + std::cos(b.high_rad + b.low_rad) * std::sin(height)) * (b.last_rad - b.first_rad);
}

double SkyPatches::ramp_horizontal_sr(std::size_t band) const {
  return solid_angle_sr(first_[band]) * (sine_[band + 1] - sine_[band]) / 12.0;
}

double SkyPatches::ramp_cylinder_sr(std::size_t band) const {
  const std::size_t patch = first_[band];
  const SkyBox& b = boxes_[patch];
  const double low = sine_[band], high = sine_[band + 1];
  // Of sine times cosine of the altitude over the patch, less that of the middle sine.
  const double sine_cylinder =
      (std::pow(std::cos(b.low_rad), 3) - std::pow(std::cos(b.high_rad), 3)) / 3.0 * (b.last_rad - b.first_rad);
  return (sine_cylinder - 0.5 * (low + high) * cylinder_sr(patch)) / (high - low);
}

Vec3 SkyPatches::centre(std::size_t patch) const {
  if (patch == ground()) return {0, 0, -1};
  if (patch + 1 == size()) return {0, 0, 1};
  const SkyBox& b = boxes_[patch];
  return at(0.5 * (b.low_rad + b.high_rad), 0.5 * (b.first_rad + b.last_rad));
}

std::size_t SkyPatches::patch_of(const Vec3& direction) const {
  const double altitude = std::atan2(direction.z, std::hypot(direction.x, direction.y));
  if (!(altitude > 0.0)) return ground();
  const auto band = static_cast<std::size_t>(altitude / band_rad_);
  if (band + 2 >= first_.size()) return size() - 1;
  const std::size_t n = first_[band + 1] - first_[band];
  const double turns = std::atan2(direction.y, direction.x) / (2.0 * kPi);
  const auto place = static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(n) + 0.5);
  return first_[band] + place % n;
}

Vec3 SkyPatches::direction(std::size_t patch, double s, double t) const {
  const SkyBox b = patch == ground() ? SkyBox{-0.5 * kPi, 0.0, 0.0, 2.0 * kPi} : boxes_[patch];
  const double low = std::sin(b.low_rad), high = std::sin(b.high_rad);
  const double sine = low + s * (high - low), turn = b.first_rad + t * (b.last_rad - b.first_rad);
  const double level = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return {level * std::cos(turn), level * std::sin(turn), sine};
}

}  // namespace dim
