#pragma once

#include <memory>
#include <vector>

#include "reflection/lobe_kernel.hpp"
#include "transport/optics.hpp"

namespace dim {

/// What light by direction needs of the finishes that shine: facets, and in every reflectance class the
/// albedo and the lobe on patches. Classes in which a finish reflects alike share theirs.
class SurfaceOptics {
 public:
  /// @param of_surface  see `shininess_of_surfaces`
  SurfaceOptics(const Zone& zone, const ReflectanceClasses& classes, const std::vector<Shininess>& of_surface,
                const PatchGrid& lobe_grid);

  /// Of an off-specular finish.
  const LobeMatrix& lobe(std::size_t klass, int finish) const { return *in_class(klass, finish).lobe; }
  const LobeKernel& lobe_kernel(std::size_t klass, int finish) const {
    return *in_class(klass, finish).kernel;
  }
  const Facets& facets(int finish) const { return *facets_[static_cast<std::size_t>(finish)]; }
  /// Of any finish that shines: k_s rho_s by angle, and its mean over each slice of the lobe grid.
  const AlbedoTable& albedo(std::size_t klass, int finish) const { return in_class(klass, finish).albedo; }
  const std::vector<double>& slice_albedo(std::size_t klass, int finish) const {
    return in_class(klass, finish).slice_albedo;
  }

 private:
  struct InClass {
    AlbedoTable albedo;
    std::vector<double> slice_albedo;
    std::unique_ptr<const LobeMatrix> lobe;
    std::unique_ptr<const LobeKernel> kernel;
  };

  const InClass& in_class(std::size_t klass, int finish) const {
    return *in_class_[klass][static_cast<std::size_t>(finish)];
  }
  void add_finish(const Finish& finish, std::size_t index, Shininess kind, const ReflectanceClasses& classes,
                  const PatchGrid& grid);

  std::vector<std::unique_ptr<Facets>> facets_;                        // [n_finishes]
  std::vector<std::vector<std::shared_ptr<const InClass>>> in_class_;  // [n_classes][n_finishes]
};

}  // namespace dim
