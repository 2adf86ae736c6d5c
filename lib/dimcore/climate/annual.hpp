#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/job.hpp"
#include "climate/coefficients.hpp"
#include "sky/epw.hpp"

namespace dim {

/// The light outside at every step of a weather file, in patches.
struct AnnualSky {
  explicit AnnualSky(int subdivision) : patches(subdivision) {}

  SkyPatches patches;
  double step_h = 1.0;
  std::size_t n_steps = 0;
  std::vector<std::size_t> lit;           ///< steps with any light, ascending
  std::vector<float> luminance_cd_m2;     ///< [n_lit, n_columns] of the patches
  std::vector<Vec3> sun;                  ///< [n_lit] towards it, x east, y north, z up
  std::vector<double> sun_normal_lx;      ///< [n_lit] across its beam; 0 where it does not shine
  std::vector<Irradiance> irradiance;     ///< [n_lit] as the weather has it
  std::vector<double> sky_horizontal_lx;  ///< [n_steps]
};

/// @throws Interrupted
AnnualSky annual_sky(const Weather& weather, int subdivision, double ground_reflectance, const Job& job = {});

/// One moment, as a year of one step.
AnnualSky sky_of_moment(const SkyAndSun& light, int subdivision, double ground_reflectance,
                        const Irradiance& irradiance = {});

/// Light through some windows in one state, and when they are in it.
struct WindowPart {
  DaylightCoefficients coefficients;
  SunFactors sun;
  std::vector<bool> active;      ///< [n_lit] steps that its light counts at; empty: all
  bool counts_as_direct = true;  ///< its sun is in `direct_sun_lx`, at all steps
};

/// Illuminance of some points at every step, by parts.
struct PointBlock {
  std::size_t first = 0;  ///< point
  std::size_t n_points = 0;
  std::size_t n_steps = 0;
  std::vector<float> sky_lx;         ///< [n_points, n_steps]: sky and ground, direct and reflected
  std::vector<float> sun_lx;         ///< [n_points, n_steps]: the sun's, direct and reflected
  /// [n_points, n_steps]: what comes straight from the sun; where windows change their state, in the one they have as
  /// long as nobody operates them
  std::vector<float> direct_sun_lx;

  std::span<const float> sky(std::size_t point) const { return row(sky_lx, point); }
  std::span<const float> sun(std::size_t point) const { return row(sun_lx, point); }
  std::span<const float> direct_sun(std::size_t point) const { return row(direct_sun_lx, point); }

 private:
  std::span<const float> row(const std::vector<float>& values, std::size_t point) const {
    return std::span(values).subspan(point * n_steps, n_steps);
  }
};

/// E[step, point] = sum over patches of D_p L_p, and the sun: straight by its factor, reflected by the
/// patches that stand for it less their own direct part. Points go in blocks, so that memory does not grow
/// with them; blocks are handed over in order, one at a time. The same numbers on any number of threads.
///
/// @param each  called with every block
/// @throws Interrupted
/// @error 1e-6 of the sum: single precision over the patches
void annual_illuminance(const AnnualSky& sky, const DaylightCoefficients& coefficients, const SunFactors& sun,
                        const std::function<void(const PointBlock&)>& each, const Job& job = {});

/// The same of windows that change: the sum of their parts. @param parts  of the same points
void annual_illuminance(const AnnualSky& sky, const std::vector<WindowPart>& parts,
                        const std::function<void(const PointBlock&)>& each, const Job& job = {});

}  // namespace dim
