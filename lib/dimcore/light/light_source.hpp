#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/beam.hpp"
#include "geometry/ray.hpp"
#include "geometry/ray_caster.hpp"
#include "reflection/mirror.hpp"
#include "scene/lights.hpp"
#include "scene/zone.hpp"

namespace dim {

/// A luminaire, or its image in a sequence of mirrors, as a receiver sees it. What it brings to a receiver is
/// for `PairIntegrator` to say.
///
/// An image is the luminaire reflected in the mirrors' planes one after the other; reflection keeps lengths
/// and angles, so that its intensity in a direction is that of the reflected frame. Light takes the path
/// through all mirrors' polygons, both ends and every leg in between unblocked.
struct LightSource {
  Luminaire luminaire;  ///< in its own place, or where its image is (without its names)
  const Fitting* fitting = nullptr;
  std::size_t original = 0;  ///< index into Lights::luminaires
  std::uint64_t stream = 0;  ///< its own chance, of where it is and shines and of nothing else
  std::vector<int> mirrors;  ///< surfaces, from the light to the receiver; empty: the luminaire itself
  Beam beam;                 ///< where its light can be: for receivers outside there is nothing to test
  bool in_the_way = true;    ///< false where nothing can stand between two points of the zone
  /// The beam's limits are the mirrors' own edges, since these are convex: from a point source, light is
  /// everywhere within.
  bool beam_is_tight = true;

  /// Luminous flux, lm, the luminaire's factor included.
  double power_lm() const { return luminaire.factor * fitting->intensity.flux_lm(); }

  /// A ray that the luminaire sends out, at four coordinates in [0, 1): from its opening evenly, in a direction
  /// drawn from the intensity table; the mean weight over many is the share of the flux that the table's cells
  /// tell right, 1 but for their curvature.
  struct Emission {
    Ray ray;
    double weight = 0.0;
  };
  Emission emit(const std::array<double, 4>& x) const;
};

/// The luminaires themselves.
/// @param in_the_way  see `LightSource`
std::vector<LightSource> own_sources(const Zone& zone, const Lights& lights, bool in_the_way = true);

/// Makes images of sources in one mirror more, again and again.
class MirrorImages {
 public:
  /// @param mirrors  surfaces that are mirrors
  MirrorImages(const Zone& zone, const std::vector<int>& mirrors);

  /// The images that light can take: of each source in every mirror that its beam meets from the front.
  /// Mirrors count as the hull of their outline here; `path_blocked` looks closer. Order: by source, then by
  /// mirror; the same on any number of threads.
  /// @returns nothing where there are more than `most`
  std::optional<std::vector<LightSource>> of(std::span<const LightSource> sources, std::size_t most) const;

 private:
  struct Mirror {
    int surface;
    Ring3 hull;
    bool is_convex;
  };
  std::vector<LightSource> of(const LightSource& source) const;

  const Zone& zone_;
  std::vector<Mirror> mirrors_;
};

/// Every luminaire, then its images in up to as many of the mirrors as its depth says.
/// @param depth  [n_luminaires] >= 0
/// @throws LimitError  more than a million images
std::vector<LightSource> sources_with_images(const Zone& zone, const Lights& lights, const std::vector<int>& mirrors,
                                   const std::vector<int>& depth);

/// The point mirrored in a surface's plane.
Vec3 mirrored(const Zone& zone, int surface, const Vec3& point);

/// Whether every path from a convex receiver to a convex opening goes through all of the source's mirrors:
/// where these are convex, those between the corners tell. False where that is not certain.
bool mirrors_pass_all(const Zone& zone, const LightSource& source, std::span<const Vec3> receiver,
                      std::span<const Vec3> on_image);

/// Whether the path from `receiver` to `on_image` (a point of the source's opening, where the image has it)
/// misses one of the mirrors or is blocked.
/// @param skip  plate the receiver lies on, or -1
bool path_blocked(const Zone& zone, const RayCaster& caster, const LightSource& source, const Vec3& receiver,
                  const Vec3& on_image, int skip);

/// Multiplies by what the source's mirrors leave of light on its path to a receiver.
/// @param towards        unit vector from the receiver to the image
/// @param tint           [n_classes]
/// @param reflection_of  (class, finish) -> const BandReflection&
template <class ReflectionOf>
void tint_by_mirrors(const Zone& zone, const LightSource& source, Vec3 towards, std::span<double> tint,
                     ReflectionOf&& reflection_of) {
  for (auto mirror = source.mirrors.rbegin(); mirror != source.mirrors.rend(); ++mirror) {
    const Surface& surface = zone.surfaces[static_cast<std::size_t>(*mirror)];
    meet_mirror(surface.polygon.frame().n, towards, tint,
                [&](std::size_t k) -> const BandReflection& { return reflection_of(k, surface.finish); });
  }
}

}  // namespace dim
