#pragma once

#include <vector>

#include "base/job.hpp"
#include "network/ray_pattern.hpp"
#include "transport/cell_light.hpp"
#include "transport/plan.hpp"
#include "transport/shine.hpp"

namespace dim {

/// Light that a ray carried to a cell.
struct RayLight {
  Vec3 direction{0, 0, -1};  ///< that it travels along, unit
  std::size_t source = 0;
  std::vector<double> lx;  ///< [n_classes] mean over the cell
};

/// What off-specular cells make of direct light.
class DirectLobes {
 public:
  /// @param of_sources  [n_off_specular] light of luminaires and images on each off-specular cell
  /// @param of_rays      [n_off_specular] light that rays carried on from the last images
  DirectLobes(const Room& room, const ModelPlan& plan, const Shine& shine,
              const std::vector<std::vector<CellLight>>& of_sources,
              const std::vector<std::vector<RayLight>>& of_rays);

  /// Flux into patches, per area. [n_states, n_sources * n_classes]
  std::vector<float> psi_of_sources(const Job& job) const;
  std::vector<float> psi_of_rays(const Job& job) const;

  /// What measuring points see of it without a mirror between: along each of their rays, of sources at the
  /// exact angles, which patches would smear. [n_points, n_sources * n_classes]
  /// @param psi_of_rays  may be empty
  std::vector<double> at_points(const std::vector<float>& psi_of_rays, const Job& job) const;

 private:
  struct Coming;
  std::size_t n_all() const { return plan_.n_columns(); }
  template <class Reflect>
  std::vector<float> psi(const Job& job, Reflect&& reflect) const;
  void reflect(const Coming& coming, std::size_t index, std::vector<double>& psi) const;
  void reflect_source(const CellLight& light, std::vector<double>& psi) const;
  void see(std::size_t point, const std::vector<float>& psi_of_rays, double* columns) const;
  void see(const Ray& ray, const CellLight& light, std::uint64_t stream, double w, double* columns) const;

  const Room& room_;
  const ModelPlan& plan_;
  const Shine& shine_;
  const std::vector<std::vector<CellLight>>& of_sources_;
  const std::vector<std::vector<RayLight>>& of_rays_;
};

}  // namespace dim
