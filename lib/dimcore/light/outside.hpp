#pragma once

#include <vector>

#include "base/job.hpp"
#include "geometry/ray_caster.hpp"
#include "light/outside_light.hpp"
#include "network/cells.hpp"
#include "scene/zone.hpp"

namespace dim {

/// What is seen out of a window: sky and ground, and before them the outside surfaces, lit by sky, ground, sun and
/// each other. The ground is an infinite plane; what stands on it throws no shadow on it.
class Outside {
 public:
  /// @param caster      of the zone's surfaces, in their order
  /// @param reflectance [n_classes][n_surfaces] of outside surfaces, each in [0, 1)
  /// @throws Interrupted
  Outside(const Zone& zone, const RayCaster& caster, const OutsideLight& light,
          const std::vector<std::vector<double>>& reflectance, const Job& job);

  const OutsideLight& light() const { return light_; }
  std::size_t n_cells() const { return cells_.size(); }

  /// What a ray meets that left the zone. Backs of surfaces are black.
  /// @param skip  plate that it starts on, or -1
  OutsideSeen seen(const Vec3& from, const Vec3& direction, int skip) const;
  /// The same of a hit that is known. @param hit  of the caster
  OutsideSeen seen(const Vec3& from, const Vec3& direction, const Hit& hit) const;

  /// Luminance of an outside cell, cd/m2: [n_columns]
  const double* luminance_cd_m2(std::size_t klass, std::size_t cell) const {
    return &luminance_cd_m2_[(klass * n_cells() + cell) * light_.n_columns()];
  }

 private:
  struct Links;
  Links links(const Job& job) const;
  void add_sun(Links& links) const;

  const RayCaster& caster_;
  const OutsideLight& light_;
  Zone around_;                   // the outside surfaces alone
  std::vector<int> around_of_;    // [n_surfaces] their place in it, -1 for others
  std::vector<int> surface_of_;   // and back
  Cells cells_;
  double ground_m_;
  std::vector<double> luminance_cd_m2_;  // [n_classes, n_cells, n_columns]
};

}  // namespace dim
