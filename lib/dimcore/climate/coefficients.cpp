#include "climate/coefficients.hpp"

#include <algorithm>
#include <cmath>

#include "sky/direction.hpp"

namespace dim {
namespace {

/// The two patches of a band whose middles are on either side of the sun, and their shares.
void add_in_band(const SkyPatches& patches, double altitude, double turn, double share,
                 std::vector<SunShare>& shares) {
  const auto at = [&](double t) {
    return patches.patch_of(
        {std::cos(altitude) * std::cos(t), std::cos(altitude) * std::sin(t), std::sin(altitude)});
  };
  const std::size_t inside = at(turn);
  const SkyBox& box = patches.box(inside);
  const double width = box.last_rad - box.first_rad;
  if (inside + 1 == patches.size()) return shares.push_back({inside, share});
  const double off = std::remainder(turn - 0.5 * (box.first_rad + box.last_rad), 2.0 * kPi) / width;
  shares.push_back({inside, share * (1.0 - std::abs(off))});
  shares.push_back({at(turn + (off < 0.0 ? -width : width)), share * std::abs(off)});
}

}  // namespace

std::vector<SunShare> sun_shares(const SkyPatches& patches, const Vec3& towards) {
  const std::size_t inside = patches.patch_of(towards);
  if (inside == patches.ground()) return {};
  const double altitude = altitude_rad(towards), turn = std::atan2(towards.y, towards.x);
  const double height = patches.box(0).high_rad;
  // Middles of bands lie at half heights; below the first and above the last there is one band.
  const double place = std::clamp(altitude / height - 0.5, 0.0, 7.0 * patches.subdivision());
  const double low = std::floor(place), upper_share = place - low;
  std::vector<SunShare> shares;
  add_in_band(patches, (low + 0.5) * height, turn, 1.0 - upper_share, shares);
  if (upper_share > 0.0)
    add_in_band(patches, std::min((low + 1.5) * height, 0.5 * kPi), turn, upper_share, shares);
  return shares;
}

SunFactors spread_sun(const DaylightCoefficients& coefficients) {
  return [&coefficients, patches = SkyPatches(coefficients.subdivision)](
             const Vec3& towards, std::size_t first, std::span<float> factors) {
    const std::size_t patch = patches.patch_of(towards);
    if (patch == patches.ground()) return std::fill(factors.begin(), factors.end(), 0.0F);
    const float* row = &coefficients.direct_lx[patch * coefficients.n_points + first];
    for (std::size_t i = 0; i < factors.size(); ++i)
      factors[i] = static_cast<float>(static_cast<double>(row[i]) / patches.solid_angle_sr(patch));
  };
}

}  // namespace dim
