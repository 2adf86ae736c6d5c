#pragma once

#include <vector>

#include "image/cell_blend.hpp"
#include "network/cells.hpp"
#include "result/luminous.hpp"

namespace dim {

/// Light in the channels that a picture needs: a waveband of the sources of one spectrum. XYZ follows from
/// them exactly at the end, whatever coloured mirrors and lobes did to them on the way.
class LightChannels {
 public:
  LightChannels(const LuminanceDatabase& database, const Mix& mix);

  std::size_t size() const { return xyz_.size(); }
  std::size_t n_bands() const { return n_bands_; }
  std::size_t band(std::size_t channel) const { return channel % n_bands_; }
  /// First channel of a source; its bands follow.
  std::size_t first_of(std::size_t source) const { return kind_[source] * n_bands_; }
  /// XYZ of 1 W/(m2 sr) in a channel, Y in cd/m2.
  const Vec3& xyz(std::size_t channel) const { return xyz_[channel]; }
  /// W for each lm of a source's own light, in a channel of its kind.
  double watts_per_lumen(std::size_t channel) const { return watts_per_lumen_[channel]; }

 private:
  std::size_t n_bands_;
  std::vector<std::size_t> kind_;  // [n_sources]
  std::vector<Vec3> xyz_;
  std::vector<double> watts_per_lumen_;
};

/// Radiance or irradiance by channel.
using Light = std::vector<double>;

enum class Shading {
  cell,    ///< flat cells
  smooth,  ///< interpolated; direct light point by point where it changes fast
  gather   ///< direct light point by point, inter-reflected light interpolated
};

/// The mixed light of all cells, and by direction of those with a lobe.
class LightField {
 public:
  LightField(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
             const LightChannels& channels, Shading shading);

  /// Irradiance at a point of a surface as its cells have it, added to `light`.
  void add_irradiance(std::size_t surface, const Vec2& local, Light& light) const;

  /// The share of the direct light there that is to be found point by point and put in the place of the
  /// cells' own (`take_direct`), 0..1; continuous.
  double open_share(std::size_t surface, const Vec2& local) const;
  /// Takes a share of the direct light that `add_irradiance` brings off again.
  void take_direct(std::size_t surface, const Vec2& local, double share, Light& light) const;

  /// Illuminance of the cell there, all light, lx.
  double illuminance_lx(std::size_t surface, const Vec2& local) const;

  /// Radiance by the surface's lobe towards a direction of its frame, direct light left out, added to
  /// `light`.
  void add_lobe(std::size_t surface, const Vec2& local, const Vec3& towards, Light& light) const;

 private:
  void find_fast_cells(const std::vector<double>& direct_lx);
  template <class Function>
  void visit(std::size_t surface, const Vec2& local, Function&& f) const;

  const Cells& cells_;
  std::size_t n_;
  Shading shading_;
  CellBlend blend_;
  std::vector<float> irradiance_;  // [n_cells, n]
  std::vector<float> direct_;      // [n_cells, n], where shading is smooth
  std::vector<double> lx_;         // [n_cells], all light
  std::vector<char> fast_;         // [n_cells]: direct light changes fast
  PatchGrid grid_;
  std::vector<std::int32_t> lobe_of_;  // [n_cells] index, -1 without a lobe
  std::vector<float> lobes_;           // [n_off_specular, n_patches, n]
};

}  // namespace dim
