#include "sky/sky_by_patches.hpp"

#include <algorithm>

#include "sky/sky_integral.hpp"

namespace dim {
namespace {

/// Multiplies luminances by 1 + x sin h + y cos h so that they have the horizontal and cylindrical sums
/// wanted.
void tilt_to(const SkySums& wanted, const SkyPatches& patches, std::vector<double>& luminances) {
  double horizontal = 0.0, cylinder = 0.0, hh = 0.0, hc = 0.0, cc = 0.0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const double h = patches.horizontal_sr(p), c = patches.cylinder_sr(p), l = luminances[p];
    horizontal += l * h;
    cylinder += l * c;
    hh += l * h * h / patches.solid_angle_sr(p);
    hc += l * h * c / patches.solid_angle_sr(p);
    cc += l * c * c / patches.solid_angle_sr(p);
  }
  const double to_h = wanted.horizontal_sr - horizontal, to_c = wanted.cylinder_sr - cylinder;
  const double determinant = hh * cc - hc * hc;
  if (determinant <= 0.0) return;  // no light at all
  const double x = (to_h * cc - to_c * hc) / determinant, y = (to_c * hh - to_h * hc) / determinant;
  for (std::size_t p = 0; p < patches.size(); ++p)
    luminances[p] *=
        1.0 + (x * patches.horizontal_sr(p) + y * patches.cylinder_sr(p)) / patches.solid_angle_sr(p);
}

/// The rise of a band: the median of those of its patches, limited by the darkest of them.
double rise_of(const SkyPatches& patches, std::size_t band, const std::vector<double>& means,
               std::vector<double> rises) {
  const auto first = means.begin() + static_cast<std::ptrdiff_t>(patches.first_of_band(band));
  const auto last = means.begin() + static_cast<std::ptrdiff_t>(patches.first_of_band(band + 1));
  const auto middle = rises.begin() + static_cast<std::ptrdiff_t>(rises.size() / 2);
  std::nth_element(rises.begin(), middle, rises.end());
  const double most = 2.0 * *std::min_element(first, last);
  return std::clamp(*middle, -most, most);
}

/// A model's relative luminances.
struct Relative {
  SkyByPatches sky;
  double horizontal_sr = 0.0;
};

template <typename Rule>
Relative relative_sky(const SkyModel& model, const Vec3& sun, const SkyPatches& patches) {
  Relative relative{{std::vector<double>(patches.size()), std::vector<double>(patches.n_ramps(), 0.0)}};
  auto& [means, rises] = relative.sky;
  std::vector<double> rise_of_patch(patches.size(), 0.0);
  SkySums all;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const auto sums = integrate_sky<Rule>(patches.box(p), sun, [&](const Vec3& d) { return model(d, sun); });
    means[p] = sums.sr / patches.solid_angle_sr(p);
    all.horizontal_sr += sums.horizontal_sr;
    all.cylinder_sr += sums.cylinder_sr;
    // The ramp less 1/2 has the mean square 1/12.
    const std::size_t band = patches.band_of(p);
    if (band == patches.n_ramps()) continue;
    const double low = patches.sine(band), high = patches.sine(band + 1);
    rise_of_patch[p] = 12.0 * (sums.horizontal_sr - 0.5 * (low + high) * sums.sr) /
                       ((high - low) * patches.solid_angle_sr(p));
  }
  relative.horizontal_sr = all.horizontal_sr;
  if (model.is_table()) return relative;
  for (std::size_t band = 0; band < patches.n_ramps(); ++band) {
    const std::size_t first = patches.first_of_band(band), last = patches.first_of_band(band + 1);
    rises[band] = rise_of(patches, band, means,
                          {rise_of_patch.begin() + static_cast<std::ptrdiff_t>(first),
                           rise_of_patch.begin() + static_cast<std::ptrdiff_t>(last)});
    const double of_band = rises[band] * static_cast<double>(last - first);
    all.horizontal_sr -= of_band * patches.ramp_horizontal_sr(band);
    all.cylinder_sr -= of_band * patches.ramp_cylinder_sr(band);
  }
  tilt_to(all, patches, means);
  return relative;
}

SkyByPatches scaled(SkyByPatches sky, double factor) {
  for (auto* values : {&sky.mean_cd_m2, &sky.rise_cd_m2})
    for (double& value : *values) value *= factor;
  return sky;
}

}  // namespace

std::vector<double> SkyByPatches::columns_cd_m2(const SkyPatches& patches, double ground_cd_m2) const {
  std::vector<double> columns = mean_cd_m2;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::size_t band = patches.band_of(p);
    if (band < patches.n_ramps()) columns[p] -= 0.5 * rise_cd_m2[band];
  }
  columns.push_back(ground_cd_m2);
  columns.insert(columns.end(), rise_cd_m2.begin(), rise_cd_m2.end());
  return columns;
}

SkyByPatches sky_by_patches(const Sky& sky, const SkyPatches& patches) {
  return scaled(relative_sky<FineSky>(sky.model(), sky.sun(), patches).sky, sky.scale_cd_m2());
}

SkyByPatches quick_sky_by_patches(const SkyModel& model, const Vec3& sun, double horizontal_lx,
                                  const SkyPatches& patches) {
  if (horizontal_lx == 0.0)
    return {std::vector<double>(patches.size(), 0.0), std::vector<double>(patches.n_ramps(), 0.0)};
  Relative relative = relative_sky<QuickSky>(model, sun, patches);
  return scaled(std::move(relative.sky), sky_scale(horizontal_lx, relative.horizontal_sr));
}

}  // namespace dim
