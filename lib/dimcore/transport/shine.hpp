#pragma once

#include <vector>

#include "transport/shine_links.hpp"
#include "transport/surface_optics.hpp"

namespace dim {

/// What shiny surfaces add to a ray network: light by direction from off-specular cells, and rays that go on
/// at mirrors. physics.md section 6.
///
/// An off-specular cell g keeps psi(g, r), the flux it reflects by its lobe into patch r of its hemisphere,
/// per area. It goes down the rays of g's own row, so that all of it arrives somewhere. Light that reaches a
/// mirror is followed from the receiver's side: the receiver's ray goes on in the mirror direction and sees
/// what it meets, times the mirror's k_s F at that angle.
class Shine {
 public:
  /// @param caster  and all the others must outlive this
  /// @throws Interrupted
  Shine(const Zone& zone, const Cells& cells, const Network& network, const ReflectanceClasses& classes,
        const RayCaster& caster, const MirrorRayOptions& mirror_rays, const Job& job);
  Shine(const Shine&) = delete;
  Shine& operator=(const Shine&) = delete;

  /// False where every surface is diffusing: nothing else here is needed.
  bool any() const { return n_off_specular() > 0 || has_mirrors(); }
  bool has_mirrors() const { return !mirrors_.empty(); }
  /// Surfaces that are mirrors.
  const std::vector<int>& mirrors() const { return mirrors_; }
  Shininess of_surface(std::size_t surface) const { return of_surface_[surface]; }
  Shininess of_cell(std::size_t cell) const { return of_surface(cells_.surface_of(cell)); }

  const LobeStates& states() const { return states_; }
  const PatchGrid& grid() const { return states_.grid(); }
  std::size_t n_off_specular() const { return states_.cells_with_lobe().size(); }
  /// Cells with a lobe, ascending.
  const std::vector<std::uint32_t>& off_specular() const { return states_.cells_with_lobe(); }
  /// Index into off_specular(), or -1.
  std::int32_t index_of(std::size_t cell) const { return states_.index_of(cell); }
  std::size_t n_states() const { return states_.size(); }

  const ShineLinks& links() const { return links_; }

  const MirrorRays& mirror_rays() const { return mirror_rays_; }

  const LobeMatrix& lobe(std::size_t klass, int finish) const { return optics_.lobe(klass, finish); }
  const LobeKernel& lobe_kernel(std::size_t klass, int finish) const {
    return optics_.lobe_kernel(klass, finish);
  }
  const AlbedoTable& albedo(std::size_t klass, int finish) const { return optics_.albedo(klass, finish); }
  /// Mean albedo of each slice of the lobe grid.
  const std::vector<double>& slice_albedo(std::size_t klass, int finish) const {
    return optics_.slice_albedo(klass, finish);
  }
  /// Facets of an off-specular finish.
  const Facets& facets(int finish) const { return optics_.facets(finish); }

  /// Mean share of a receiver's light that is cut off after mirrors, in the class where it is largest.
  double cut_off() const;

 private:
  const Cells& cells_;
  std::vector<Shininess> of_surface_;
  LobeStates states_;
  SurfaceOptics optics_;
  MirrorRays mirror_rays_;
  std::vector<int> mirrors_;
  ShineLinks links_;
};

}  // namespace dim
