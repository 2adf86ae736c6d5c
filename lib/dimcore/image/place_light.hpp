#pragma once

#include <array>
#include <span>
#include <vector>

#include "image/lamps.hpp"

namespace dim {

/// Where a pixel looks at a surface.
struct LitPlace {
  Vec2 local{0.0};
  std::array<Vec2, 4> footprint{};  ///< of the pixel, counter-clockwise
  bool whole = false;               ///< the pixel shows nothing else, and the mean over its footprint is wanted
  double weight = 1.0;              ///< of the pixel: shadows are looked at as closely
  std::uint64_t chance = 0;         ///< its own
};

/// Direct light at many places close together on one surface, as a tile of a picture sees them.
///
/// The places are halved and halved again. Each time it is told exactly, lamp by lamp, whether anything can stand
/// between it and the part of the surface: where nothing can, its light is smooth and is interpolated between nine
/// points as soon as that follows it; where something hides it wholly there is none; what stands partly in the way
/// is found place by place, along lines in proportion to the lamp's share of the light there.
class PlaceLight {
 public:
  PlaceLight(const Zone& zone, const Lamps& lamps, const LightField& field);

  /// Direct illuminance, factors and tints of mirrors not taken off, lx.
  /// @param places  of one surface
  /// @param lx      [n_places, n_lamps], written
  void find(std::size_t surface, std::span<const LitPlace> places, std::vector<double>& lx) const;

 private:
  struct Part;
  struct Open;
  class Halving;

  // Sphere round an opening.
  struct Ball {
    Vec3 middle{0.0};
    double radius_m = 0.0;
  };
  double bound_lx(std::size_t lamp, const Vec3& middle, double radius_m) const;

  const Zone& zone_;
  const Lamps& lamps_;
  const LightField& field_;
  std::vector<Ball> balls_;
  std::vector<PairIntegrator> free_;
  std::array<std::vector<PairIntegrator>, 3> shadowed_;  // few, some, many lines
};

}  // namespace dim
