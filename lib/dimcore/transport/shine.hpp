#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/job.hpp"
#include "geometry/ray_caster.hpp"
#include "network/cells.hpp"
#include "network/network.hpp"
#include "network/ray_pattern.hpp"
#include "reflection/lobe.hpp"
#include "transport/optics.hpp"

namespace dim {

/// What shiny surfaces add to a ray network: light by direction from off-specular cells, and rays that go on
/// at mirrors.
///
/// An off-specular cell g keeps psi(g, r), the flux it reflects by its lobe into patch r of its hemisphere,
/// per area. It goes down the rays of g's own row, so that all of it arrives somewhere: flux is conserved
/// exactly. Light that reaches a mirror is followed from the receiver's side: the receiver's ray goes on in
/// the mirror direction and sees what it meets, times the mirror's k_s F at that angle, until that is not a
/// mirror or `depth` mirrors have been met.
class Shine {
 public:
  /// Light of a cell (its diffuse part) that a receiver sees by way of mirrors.
  struct MirrorLink {
    std::uint32_t patch;     ///< of the receiver's row
    std::uint32_t cell;      ///< seen
    std::uint32_t patch_in;  ///< of its lobe grid, where light that goes the other way comes in
    std::uint32_t tint;
  };
  /// Light of an off-specular cell that reaches a receiver: of psi[state] the share `weight` (flux per area
  /// of the receiver; at a measuring point the irradiance).
  struct LobeLink {
    std::uint32_t state;     ///< off-specular cell * lobe patches + patch
    std::uint32_t patch_in;  ///< of the receiver's lobe grid, where it comes in
    std::uint32_t tint;
    float weight;
  };

  Shine(const Zone& zone, const Cells& cells, const Network& network, const ReflectanceClasses& classes,
        const RayCaster& caster, int depth, const Job& job);

  /// False where every surface is diffusing: nothing else here is needed.
  bool any() const { return n_off_specular() > 0 || !mirrors_.empty(); }
  bool has_mirrors() const { return !mirrors_.empty(); }
  /// Surfaces that are mirrors.
  const std::vector<int>& mirrors() const { return mirrors_; }
  Shininess of_surface(std::size_t surface) const { return of_surface_[surface]; }
  Shininess of_cell(std::size_t cell) const { return of_surface_[cells_.surface_of(cell)]; }

  const PatchGrid& grid() const { return grid_; }
  std::size_t n_off_specular() const { return off_specular_.size(); }
  /// Cells with a lobe, ascending.
  const std::vector<std::uint32_t>& off_specular() const { return off_specular_; }
  /// Index into off_specular(), or -1.
  std::int32_t index_of(std::size_t cell) const { return index_of_[cell]; }
  std::size_t n_states() const { return off_specular_.size() * grid_.n_patches(); }

  /// Patch of the lobe grid that a patch of the network's lies in.
  std::size_t lobe_patch(std::size_t network_patch) const;

  /// Patch of a shiny cell's lobe grid where light that travels along `direction` comes in; 0 for other
  /// cells.
  std::uint32_t patch_in(std::size_t cell, const Vec3& direction) const;

  /// Links of receiver i: cells, then measuring points.
  const std::vector<std::uint64_t>& mirror_first() const { return mirror_first_; }
  const std::vector<MirrorLink>& mirror_links() const { return mirror_links_; }
  const std::vector<std::uint64_t>& lobe_first() const { return lobe_first_; }
  const std::vector<LobeLink>& lobe_links() const { return lobe_links_; }
  /// Factor of a tint in a class; tint 0 is 1.
  double tint(std::uint32_t tint, std::size_t klass) const { return tints_[tint * n_classes_ + klass]; }

  /// k_s F of a mirror.
  double mirror_reflectance(std::size_t klass, int finish, double cos_incidence) const {
    return classes_.at(klass, finish).fresnel(cos_incidence);
  }
  const LobeMatrix& lobe(std::size_t klass, int finish) const { return *lobes_[klass][at(finish)]; }
  const AlbedoTable& albedo(std::size_t klass, int finish) const { return *albedos_[klass][at(finish)]; }
  /// Mean albedo of each slice of the lobe grid.
  const std::vector<double>& slice_albedo(std::size_t klass, int finish) const {
    return *slice_albedos_[klass][at(finish)];
  }
  /// Facets of an off-specular finish.
  const Facets& facets(int finish) const { return *facets_[at(finish)]; }

  /// Share of rays (by weight) that still met a mirror at the last depth.
  double cut_off() const { return cut_off_; }

 private:
  struct RowLinks;
  using Sink = std::function<std::size_t(std::size_t patch)>;

  static std::size_t at(int finish) { return static_cast<std::size_t>(finish); }
  void make_optics(const ReflectanceClasses& classes, const std::vector<Shininess>& of_finish);
  template <class OnLanding>
  bool follow(const Ray& ray, int skip, const RayCaster& caster, OnLanding&& on_landing) const;
  void follow_mirrors(RowLinks& links, const RowRays& rays, const PatchGrid& patches, const Sink& sink_of,
                      std::size_t point_row, const RayCaster& caster) const;
  void send_lobes(RowLinks& links, std::size_t index, const RayCaster& caster) const;
  template <class MakeRow>
  std::vector<RowLinks> rows(std::size_t n, const Job& job, MakeRow&& make_row) const;
  std::uint32_t keep_tints(const RowLinks& row);
  std::uint32_t state_towards(std::size_t cell, const Vec3& direction) const;
  double lobe_share(const PatchGrid& patches, std::size_t patch, std::size_t lobe_patch) const;

  const Zone& zone_;
  const Cells& cells_;
  const Network& network_;
  const ReflectanceClasses& classes_;
  int depth_;
  PatchGrid grid_;
  std::size_t n_classes_;
  std::vector<Shininess> of_surface_;
  std::vector<int> mirrors_;
  std::vector<std::uint32_t> off_specular_;
  std::vector<std::int32_t> index_of_;
  std::vector<std::uint64_t> mirror_first_, lobe_first_;
  std::vector<MirrorLink> mirror_links_;
  std::vector<LobeLink> lobe_links_;
  std::vector<double> tints_;
  std::vector<std::unique_ptr<Facets>> facets_;
  std::vector<std::vector<std::shared_ptr<const LobeMatrix>>> lobes_;
  std::vector<std::vector<std::shared_ptr<const AlbedoTable>>> albedos_;
  std::vector<std::vector<std::shared_ptr<const std::vector<double>>>> slice_albedos_;
  double cut_off_ = 0.0;
};

}  // namespace dim
