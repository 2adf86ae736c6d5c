#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "base/vec.hpp"
#include "hemisphere/turn.hpp"

namespace dim {

struct PatchGrid;

/// The directions of one slice, with what they share computed once.
class PatchSlice {
 public:
  PatchSlice(const PatchGrid& grid, int slice);

  /// See PatchGrid::direction.
  Vec3 direction(int sector, double s, double t) const {
    const double cos2 = low2_ + s * range2_;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cos2));
    const Vec2 azimuth = cos_sin_of_turn((sector + t) * turn_per_sector_);
    return {sine * azimuth.x, sine * azimuth.y, std::sqrt(cos2)};
  }

 private:
  double low2_, range2_, turn_per_sector_;
};

/// Unit hemisphere cut into a slices uniform in cos(theta) times b equal sectors of azimuth: a*b patches of
/// the same solid angle 2 pi/(a b). Patch k = slice * b + sector; slice 0 lies on the horizon. physics.md
/// section 3.
struct PatchGrid {
  int n_slices = 16;   ///< a >= 1
  int n_sectors = 32;  ///< b >= 1

  std::size_t n_patches() const {
    return static_cast<std::size_t>(n_slices) * static_cast<std::size_t>(n_sectors);
  }
  double solid_angle_sr() const { return 2.0 * kPi / (static_cast<double>(n_slices) * n_sectors); }

  /// Irradiance weight of every patch of a slice, cos(theta) times solid angle; over all patches they add up
  /// to pi exactly.
  double weight_sr(int slice) const { return (slice + 0.5) / n_slices * solid_angle_sr(); }

  /// Direction in the cell's frame (z = normal) inside a patch. `s`, `t` in [0, 1): the density is
  /// proportional to cos(theta), so that `weight_sr` is also the unbiased weight.
  Vec3 direction(int slice, int sector, double s, double t) const {
    return PatchSlice(*this, slice).direction(sector, s, t);
  }

  /// Direction through the middle of a patch, cos(theta) = (slice + 1/2)/a.
  Vec3 centre(int slice, int sector) const;

  /// Patch that holds a direction (z > 0) of the cell's frame.
  std::size_t patch_of(const Vec3& direction) const;

  bool operator==(const PatchGrid&) const = default;
};

inline PatchSlice::PatchSlice(const PatchGrid& grid, int slice) {
  const double low = static_cast<double>(slice) / grid.n_slices, high = (slice + 1.0) / grid.n_slices;
  low2_ = low * low;
  range2_ = high * high - low2_;
  turn_per_sector_ = 1.0 / grid.n_sectors;
}

/// "AxB" gives a slices by b sectors; a plain number N the most nearly square patches with a*b = N.
/// @throws InputError naming `option` unless the text is one of these with 1 <= a*b <= 1e7
PatchGrid parse_patches(const std::string& text, const std::string& option);

}  // namespace dim
