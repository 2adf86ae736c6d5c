#pragma once

#include <vector>

#include "base/job.hpp"
#include "transport/cell_light.hpp"
#include "transport/direct_lobes.hpp"
#include "transport/shine.hpp"

namespace dim {

/// What became of light that mirrors reflect, by class, lm.
struct MirrorFate {
  std::vector<double> reflected;  ///< by mirrors, all that arrives somewhere or escapes
  std::vector<double> escaped;    ///< of that, out of the zone or onto backs
  std::vector<double>
      not_followed;  ///< reflected, too, but given up: next to nothing was left, or no end seen

  explicit MirrorFate(std::size_t n_classes)
      : reflected(n_classes, 0.0), escaped(n_classes, 0.0), not_followed(n_classes, 0.0) {}
};

/// What mirrors reflect of direct light on them.
class MirroredLight {
 public:
  MirroredLight(const Room& room, const ModelPlan& plan, const Shine& shine);

  /// Most that a mirror cell reflects of a light, over all classes, lm.
  double reflected_lm(const CellLight& light) const;

  /// Counts what mirrors reflect of lights whose next images there are.
  void pass_on(const std::vector<CellLight>& lights, const Job& job);

  /// Follows what mirrors reflect of lights that have no further images.
  /// @param ray_lm  [n_luminaires] flux of one ray, > 0
  void follow(const std::vector<CellLight>& lights, const std::vector<double>& ray_lm, const Job& job);

  /// By column, lm: see `MirrorFate`.
  const std::vector<double>& reflected() const { return reflected_; }
  const std::vector<double>& escaped() const { return escaped_; }
  const std::vector<double>& not_followed() const { return not_followed_; }
  /// What rays brought to cells. [n_cells, n_columns] lx; empty without rays
  std::vector<double>& brought() { return brought_; }
  /// The same to off-specular cells, by direction. [n_off_specular]
  const std::vector<std::vector<RayLight>>& rays() const { return rays_; }
  std::size_t n_rays() const { return n_rays_; }
  /// Flux sent on by rays, by source, lm.
  const std::vector<double>& sent_lm() const { return sent_lm_; }

 private:
  struct Landing {
    std::size_t cell, source;
    Vec3 direction;
  };
  // What one run of lights came to; runs are summed in order.
  struct Run {
    std::vector<MirrorFate> of_source;
    std::vector<Landing> landings;
    std::vector<double> flux;  // [landings, n_classes]
    std::size_t n_rays = 0;
    std::vector<double> sent_lm;
  };
  template <class Handle>
  void for_runs(const std::vector<CellLight>& lights, const Job& job, Handle&& handle);
  void pass_on(const CellLight& light, Run& run) const;
  void follow(const CellLight& light, double ray_lm, Run& run) const;
  bool leaves(const PairIntegrator::Path& path, int mirror) const;
  void add(const Run& run);

  const Room& room_;
  const ModelPlan& plan_;
  const Shine& shine_;
  std::vector<double> reflected_, escaped_, not_followed_, sent_lm_;
  std::vector<double> brought_;
  std::vector<std::vector<RayLight>> rays_;
  std::size_t n_rays_ = 0;
};

}  // namespace dim
