#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/ray_caster.hpp"
#include "network/cells.hpp"
#include "network/ray_pattern.hpp"
#include "reflection/mirror.hpp"
#include "transport/optics.hpp"

namespace dim {

/// How far rays are followed from mirror to mirror.
struct MirrorRayOptions {
  double tolerance = 1e-4;  ///< until no class has more than this left of the ray's weight
  int most = 1024;          ///< and at most so many mirrors
};

/// Follows rays on at mirrors, for all reflectance classes at once.
class MirrorRays {
 public:
  /// @param of_surface  see `shininess_of_surfaces`
  MirrorRays(const Zone& zone, const Cells& cells, const ReflectanceClasses& classes,
             const std::vector<Shininess>& of_surface, const RayCaster& caster,
             const MirrorRayOptions& options)
      : zone_(zone),
        cells_(cells),
        classes_(classes),
        of_surface_(of_surface),
        caster_(caster),
        options_(options) {}

  enum class End {
    landed,   ///< on a surface that is not a mirror
    escaped,  ///< nowhere
    cut       ///< it has met mirrors enough
  };

  /// Calls on_landing(cell, direction) wherever the ray comes down after the first mirror: on further mirrors
  /// and where it ends.
  ///
  /// @param ray      meets `mirror` first: taken as known, not traced again
  /// @param tint     [n_classes] of the ray's light, multiplied with each mirror's k_s F before each call;
  ///                 afterwards what has landed, escaped or was cut
  template <class OnLanding>
  End follow(const Ray& ray, std::size_t mirror, std::span<double> tint, OnLanding&& on_landing) const {
    const Frame* frame = &zone_.surfaces[mirror].polygon.frame();
    Vec3 direction = ray.direction;
    Vec3 at = ray.from - frame->height(ray.from) / glm::dot(direction, frame->n) * direction;
    for (int met = 1;; ++met) {
      const double left = meet_mirror(frame->n, direction, tint, [&](std::size_t q) -> const BandReflection& {
        return classes_.at(q, zone_.surfaces[mirror].finish);
      });
      if (left <= options_.tolerance || met >= options_.most) return End::cut;
      const Hit hit = caster_.nearest(at, direction, static_cast<int>(mirror));
      const auto plate = static_cast<std::size_t>(hit.plate);
      if (hit.plate < 0 || hit.back || plate >= zone_.surfaces.size() || zone_.surfaces[plate].outside)
        return End::escaped;
      on_landing(cells_.cell_hit(plate, hit.local, direction),
                 direction);
      if (of_surface_[plate] != Shininess::mirror) return End::landed;
      at += hit.t * direction;
      mirror = plate;
      frame = &zone_.surfaces[mirror].polygon.frame();
    }
  }

 private:
  const Zone& zone_;
  const Cells& cells_;
  const ReflectanceClasses& classes_;
  const std::vector<Shininess>& of_surface_;
  const RayCaster& caster_;
  MirrorRayOptions options_;
};

}  // namespace dim
