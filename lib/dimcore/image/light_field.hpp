#pragma once

#include <vector>

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

/// The mixed light of all cells, and by direction of those with a lobe.
class LightField {
 public:
  /// @param smooth    interpolate between the middles of neighbouring cells of a surface
  /// @param indirect  irradiance without direct light, which the caller adds
  LightField(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
             const LightChannels& channels, bool smooth, bool indirect);

  /// Irradiance at a point of a surface, added to `light`. Constant from the outer middles of cells to the
  /// edge.
  void add_irradiance(std::size_t surface, const Vec2& local, Light& light) const;

  /// Radiance by the surface's lobe towards a direction of its frame, direct light left out, added to
  /// `light`.
  void add_lobe(std::size_t surface, const Vec2& local, const Vec3& towards, Light& light) const;

 private:
  struct Weighted {
    std::size_t cell;
    double weight;
  };
  // At most four cells, their weights adding up to 1.
  std::size_t cells_at(std::size_t surface, const Vec2& local, Weighted (&found)[4]) const;

  const Zone& zone_;
  const Cells& cells_;
  std::size_t n_;
  bool smooth_;
  std::vector<float> irradiance_;  // [n_cells, n]
  PatchGrid grid_;
  std::vector<std::int32_t> lobe_of_;  // [n_cells] index, -1 without a lobe
  std::vector<float> lobes_;           // [n_off_specular, n_patches, n]
};

}  // namespace dim
