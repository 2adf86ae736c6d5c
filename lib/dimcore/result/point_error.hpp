#pragma once

#include <optional>
#include <vector>

#include "result/luminous.hpp"

namespace dim {

/// How far the illuminance of a measuring point may be from the model's own, lx, by where that comes from. Photometry,
/// reflectances and geometry count as given.
struct PointError {
  double cells_lx = 0.0;   ///< estimate: the correction for the cells' size itself
  double rays_lx = 0.0;    ///< estimate: half the difference of two halves of the point's rays, with its plane's mean
  double cell_rays_lx = 0.0;  ///< estimate: the same of the rays of the cells that it sees
  double direct_lx = 0.0;  ///< estimate: standard deviation of the visible shares of direct light
  double bound_lx = 0.0;   ///< bound: inter-reflection that is left out

  /// What the error does not exceed at about 95 % of points: the bound, and twice the root of the estimates' squares.
  /// That of cells counts 0.8, so that it covers what the correction leaves in the rooms of
  /// docs/accuracy-and-speed.md.
  double total_lx() const;
};

/// Of all measuring points, sources mixed. Differences of cells and of rays are common to all sources and mix as light
/// does; direct light is found for each source apart.
/// @returns [n_points]; nothing where the solution does not know (`--solver track`, off-specular surfaces, daylight)
std::optional<std::vector<PointError>> point_errors(const LuminanceDatabase& database, const Mix& mix);

/// The error of a set's measuring points that 95 % of them do not exceed, relative to their illuminance, and its parts; points
/// that are dark or not valid are left out.
struct StatedShare {
  double total = 0.0;
  double cells = 0.0, rays = 0.0, cell_rays = 0.0, direct = 0.0, bound = 0.0;  ///< each by itself, the same way
};
StatedShare stated_share(const std::vector<PointError>& errors, const std::vector<double>& lx,
                         const std::vector<MeasuringPoint>& points, const PointSet& of);

/// Of the mean illuminances of surfaces, the same way: what the correction for the cells' size changes of them, and what
/// half of their cells' rays would (`cell_rays_lx`).
/// @param figures  of the same mix, see `surface_figures`
/// @returns [n_surfaces]; nothing where the solution does not know
std::optional<std::vector<PointError>> surface_errors(const LuminanceDatabase& database, const Mix& mix,
                                                      const std::vector<SurfaceFigures>& figures);

/// The light of all surfaces, lm, and what it is stated to be off by.
struct SurfaceLight {
  double lm = 0.0, error_lm = 0.0;
};
/// @returns nothing where the solution does not know the error
std::optional<SurfaceLight> surface_light(const LuminanceDatabase& database, const Mix& mix);

/// Of the mean of a set's valid points: rays and direct light of points are apart, all else they have in common.
PointError mean_error(const std::vector<PointError>& errors, const std::vector<MeasuringPoint>& points,
                      const PointSet& set);

}  // namespace dim
