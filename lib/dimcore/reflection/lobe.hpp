#pragma once

#include <cstdint>
#include <vector>

#include "hemisphere/patches.hpp"
#include "reflection/specular.hpp"

namespace dim {

/// k_s rho_s(theta) at equal steps of cos(theta), linear between.
class AlbedoTable {
 public:
  AlbedoTable() = default;
  /// @param facets  null for a mirror
  AlbedoTable(const BandReflection& reflection, const Facets* facets);
  double at(double cos_incidence) const;
  /// Mean over a slice of a patch grid, weighted with cos(theta). [n_slices]
  std::vector<double> of_slices(const PatchGrid& grid) const;

 private:
  std::vector<double> values_;
};

/// Where facets send light from the patches of a hemisphere, without Fresnel's F: the same for every
/// wavelength. Made from low-discrepancy facets for a patch of each slice; reciprocal (what goes from patch a
/// to b, weighted with a's w, is what goes from b to a).
struct LobeShape {
  struct Bin {
    std::uint16_t slice_in = 0, slice_out = 0;
    std::uint32_t turn = 0;  ///< sector out minus sector in, modulo the sectors
    double flux = 0.0;       ///< w_in/pi times the share
    double facing = 1.0;     ///< mean cosine of incidence on the facets
  };
  PatchGrid grid;
  std::vector<Bin> bins;  ///< sorted by slice_in
};
LobeShape lobe_shape(const PatchGrid& grid, const Facets& facets);

/// A lobe on patches in one waveband: of the flux that comes in through a patch, which share goes out through
/// which.
///
/// Each patch's shares add up to its exact albedo k_s rho_s, however narrow the lobe; and w_a share(a -> b) =
/// w_b share(b -> a) to about 1e-3 of the largest.
class LobeMatrix {
 public:
  LobeMatrix() = default;
  LobeMatrix(const LobeShape& shape, const BandReflection& reflection,
             const std::vector<double>& slice_albedo);

  struct Entry {
    std::uint32_t slice_out = 0;
    std::uint32_t turn = 0;
    double share = 0.0;
  };
  /// Entries of incoming patches of a slice: [first(slice), first(slice + 1)).
  const Entry* begin(int slice) const { return entries_.data() + first_[static_cast<std::size_t>(slice)]; }
  const Entry* end(int slice) const { return entries_.data() + first_[static_cast<std::size_t>(slice) + 1]; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::size_t> first_;
};

/// Where light from one exact direction goes: `n` facets drawn, each with its direction out and its share
/// before F.
struct FacetSample {
  Vec3 out{0.0};
  double weight = 0.0;
  double facing = 1.0;
};
FacetSample sample_facet(const Facets& facets, const Vec3& in, double u, double v);

}  // namespace dim
