#include "hemisphere/patch_mask.hpp"

namespace dim {
namespace {

constexpr double kSlack_rad = 1e-6;  // for rounding

}  // namespace

void PatchMask::mark_cone(const Vec3& middle, double reach) {
  const double distance = glm::length(middle);
  const double half_width = reach < distance ? std::asin(reach / distance) + kSlack_rad : kPi;
  const double theta = distance > 0.0 ? std::acos(std::clamp(middle.z / distance, -1.0, 1.0)) : 0.0;
  if (theta - half_width >= kPi / 2) return;
  const auto slice_at = [&](double angle) {
    return std::clamp(static_cast<int>(std::cos(angle) * grid_.n_slices), 0, grid_.n_slices - 1);
  };
  const int first_slice = slice_at(std::min(theta + half_width, kPi / 2));
  const int last_slice = slice_at(std::max(theta - half_width, 0.0));
  const int b = grid_.n_sectors;
  int first_sector = 0, n_sectors = b;
  // A cone round the pole or its opposite has every azimuth.
  if (half_width < theta && theta + half_width < kPi) {
    const double per_turn = b / (2.0 * kPi);
    const double azimuth = std::atan2(middle.y, middle.x);
    const double half_turn = std::asin(std::min(1.0, std::sin(half_width) / std::sin(theta))) + kSlack_rad;
    first_sector = static_cast<int>(std::floor((azimuth - half_turn) * per_turn));
    n_sectors =
        std::min(b, static_cast<int>(std::floor((azimuth + half_turn) * per_turn)) - first_sector + 1);
  }
  for (int slice = first_slice; slice <= last_slice; ++slice) {
    for (int k = 0; k < n_sectors; ++k)
      marked_[static_cast<std::size_t>(slice * b + ((first_sector + k) % b + b) % b)] = 1;
  }
  any_ = true;
}

}  // namespace dim
