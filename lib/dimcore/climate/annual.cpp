#include "climate/annual.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "climate/annual_kernel.hpp"
#include "sky/sky_by_patches.hpp"
#include "sky/weather_light.hpp"

namespace dim {
namespace {

constexpr std::size_t kBlockPoints = 256;

/// What stands for the sun's reflected light at one step: factors on patches.
struct ReflectedSun {
  std::array<std::size_t, 4> patch{};
  std::array<float, 4> luminance_cd_m2{};
  std::size_t n = 0;
};

std::vector<ReflectedSun> reflected_suns(const AnnualSky& sky) {
  std::vector<ReflectedSun> suns(sky.lit.size());
  for (std::size_t i = 0; i < suns.size(); ++i) {
    if (sky.sun_normal_lx[i] <= 0.0) continue;
    for (const auto& share : sun_shares(sky.patches, sky.sun[i])) {
      suns[i].patch[suns[i].n] = share.patch;
      suns[i].luminance_cd_m2[suns[i].n++] =
          static_cast<float>(share.share * sky.sun_normal_lx[i] / sky.patches.solid_angle_sr(share.patch));
    }
  }
  return suns;
}

/// Coefficients of kPointLanes points side by side; lanes beyond the last point are 0.
struct LaneCoefficients {
  std::vector<float> total, reflected;  ///< [n_columns, kPointLanes]

  LaneCoefficients(const DaylightCoefficients& of, std::size_t first, std::size_t count) {
    const std::size_t n_rows = of.total_lx.size() / of.n_points;
    total.resize(n_rows * kPointLanes);
    reflected.resize(n_rows * kPointLanes);
    for (std::size_t row = 0; row < n_rows; ++row) {
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t from = row * of.n_points + first + k;
        total[row * kPointLanes + k] = of.total_lx[from];
        reflected[row * kPointLanes + k] = of.total_lx[from] - of.direct_lx[from];
      }
    }
  }
};

/// A `WindowPart` without what it owns.
struct Part {
  const DaylightCoefficients& coefficients;
  const SunFactors& sun;
  std::vector<std::size_t> active;  // places among the lit steps
  std::vector<bool> is_active;      // [n_lit]
  bool counts_as_direct;
};

Part part_of(const AnnualSky& sky, const DaylightCoefficients& coefficients, const SunFactors& sun,
             std::vector<bool> active, bool counts_as_direct) {
  if (active.empty()) active.assign(sky.lit.size(), true);
  Part part{coefficients, sun, {}, std::move(active), counts_as_direct};
  for (std::size_t i = 0; i < part.is_active.size(); ++i)
    if (part.is_active[i]) part.active.push_back(i);
  return part;
}

/// Points of a block that are computed together.
struct Lanes {
  std::size_t in_block, count;
};

void add_sky(const AnnualSky& sky, const Part& part, const LaneCoefficients& coefficients, const Lanes& lanes,
             PointBlock& block) {
  const std::size_t n_rows = sky.patches.n_columns();
  std::vector<float> luminance(kStepLanes * n_rows);
  std::array<float, kStepLanes * kPointLanes> sums;
  for (std::size_t i = 0; i < part.active.size(); i += kStepLanes) {
    const std::size_t n = std::min(kStepLanes, part.active.size() - i);
    for (std::size_t step = 0; step < n; ++step)
      std::copy_n(&sky.luminance_cd_m2[part.active[i + step] * n_rows], n_rows,
                  luminance.begin() + static_cast<std::ptrdiff_t>(step * n_rows));
    multiply_steps(luminance.data(), coefficients.total.data(), n_rows, sums.data());
    for (std::size_t step = 0; step < n; ++step)
      for (std::size_t k = 0; k < lanes.count; ++k)
        block.sky_lx[(lanes.in_block + k) * block.n_steps + sky.lit[part.active[i + step]]] +=
            sums[step * kPointLanes + k];
  }
}

void add_sun(const AnnualSky& sky, const Part& part, const std::vector<ReflectedSun>& suns,
             const LaneCoefficients& coefficients, const Lanes& lanes, PointBlock& block) {
  std::array<float, kPointLanes> factors;
  for (std::size_t i = 0; i < sky.lit.size(); ++i) {
    if (sky.sun_normal_lx[i] <= 0.0 || !(part.is_active[i] || part.counts_as_direct)) continue;
    part.sun(sky.sun[i], block.first + lanes.in_block, std::span(factors).first(lanes.count));
    const ReflectedSun& reflected = suns[i];
    for (std::size_t k = 0; k < lanes.count; ++k) {
      const auto direct = static_cast<float>(static_cast<double>(factors[k]) * sky.sun_normal_lx[i]);
      const std::size_t at = (lanes.in_block + k) * block.n_steps + sky.lit[i];
      if (part.counts_as_direct) block.direct_sun_lx[at] += direct;
      if (!part.is_active[i]) continue;
      float sum = direct;
      for (std::size_t j = 0; j < reflected.n; ++j)
        sum += reflected.luminance_cd_m2[j] * coefficients.reflected[reflected.patch[j] * kPointLanes + k];
      block.sun_lx[at] += sum;
    }
  }
}

void add_parts(const AnnualSky& sky, const std::vector<Part>& parts, const std::function<void(const PointBlock&)>& each,
               const Job& job) {
  const std::size_t n_points = parts.front().coefficients.n_points;
  const auto suns = reflected_suns(sky);
  for (std::size_t first = 0; first < n_points; first += kBlockPoints) {
    PointBlock block;
    block.first = first;
    block.n_points = std::min(kBlockPoints, n_points - first);
    block.n_steps = sky.n_steps;
    for (auto* values : {&block.sky_lx, &block.sun_lx, &block.direct_sun_lx})
      values->assign(block.n_points * sky.n_steps, 0.0F);
    const std::size_t n_groups = (block.n_points + kPointLanes - 1) / kPointLanes;
    tbb::parallel_for(std::size_t{0}, n_groups, [&](std::size_t group) {
      job.check();
      const std::size_t in_block = group * kPointLanes;
      const Lanes lanes{in_block, std::min(kPointLanes, block.n_points - in_block)};
      for (const auto& part : parts) {
        const LaneCoefficients coefficients(part.coefficients, first + in_block, lanes.count);
        add_sky(sky, part, coefficients, lanes, block);
        add_sun(sky, part, suns, coefficients, lanes, block);
      }
    });
    each(block);
    job.report("year", static_cast<double>(first + block.n_points) / static_cast<double>(n_points));
  }
}

void make_room(AnnualSky& sky) {
  sky.sky_horizontal_lx.assign(sky.n_steps, 0.0);
  sky.luminance_cd_m2.resize(sky.lit.size() * sky.patches.n_columns());
  sky.sun.resize(sky.lit.size());
  sky.sun_normal_lx.resize(sky.lit.size());
  sky.irradiance.resize(sky.lit.size());
}

/// @param i  place among the lit steps
void set_step(const SkyAndSun& light, double ground_reflectance, std::size_t i, AnnualSky& sky) {
  const double sun_lx = light.sun.z > 0.0 ? light.direct_normal_lx : 0.0;
  const double horizontal_lx = light.sky_horizontal_lx + sun_lx * std::max(0.0, light.sun.z);
  const auto cd_m2 = quick_sky_by_patches(light.model, light.model_sun(), light.sky_horizontal_lx, sky.patches)
                         .columns_cd_m2(sky.patches, ground_reflectance * horizontal_lx / kPi);
  std::transform(cd_m2.begin(), cd_m2.end(), &sky.luminance_cd_m2[i * cd_m2.size()],
                 [](double l) { return static_cast<float>(l); });
  sky.sun[i] = light.sun;
  sky.sun_normal_lx[i] = sun_lx;
  sky.sky_horizontal_lx[sky.lit[i]] = light.sky_horizontal_lx;
}

}  // namespace

AnnualSky annual_sky(const Weather& weather, int subdivision, double ground_reflectance, const Job& job) {
  AnnualSky sky(subdivision);
  sky.step_h = weather.step_h;
  sky.n_steps = weather.steps.size();
  for (std::size_t i = 0; i < sky.n_steps; ++i) {
    const Irradiance& light = weather.steps[i].irradiance;
    if (light.direct_normal_W_m2 > 0.0 || light.diffuse_horizontal_W_m2 > 0.0) sky.lit.push_back(i);
  }
  make_room(sky);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sky.lit.size()), [&](const auto& range) {
    job.check();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      sky.irradiance[i] = weather.steps[sky.lit[i]].irradiance;
      set_step(sky_and_sun_of(weather, weather.steps[sky.lit[i]]), ground_reflectance, i, sky);
    }
  });
  return sky;
}

AnnualSky sky_of_moment(const SkyAndSun& light, int subdivision, double ground_reflectance,
                        const Irradiance& irradiance) {
  AnnualSky sky(subdivision);
  sky.n_steps = 1;
  sky.lit = {0};
  make_room(sky);
  sky.irradiance[0] = irradiance;
  set_step(light, ground_reflectance, 0, sky);
  return sky;
}

void annual_illuminance(const AnnualSky& sky, const DaylightCoefficients& coefficients, const SunFactors& sun,
                        const std::function<void(const PointBlock&)>& each, const Job& job) {
  add_parts(sky, {part_of(sky, coefficients, sun, {}, true)}, each, job);
}

void annual_illuminance(const AnnualSky& sky, const std::vector<WindowPart>& parts,
                        const std::function<void(const PointBlock&)>& each, const Job& job) {
  std::vector<Part> all;
  for (const auto& part : parts)
    all.push_back(part_of(sky, part.coefficients, part.sun, part.active, part.counts_as_direct));
  if (!all.empty()) add_parts(sky, all, each, job);
}

}  // namespace dim
