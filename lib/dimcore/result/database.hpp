#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/job.hpp"
#include "result/content.hpp"
#include "result/transfer.hpp"

namespace dim {

/// A luminance database: from a file, whose light is read as asked for, or straight from the solver. Tables,
/// mixes and pictures do not tell the two apart.
class LuminanceDatabase {
 public:
  /// @throws IoError  missing, damaged, foreign, older or newer file
  explicit LuminanceDatabase(const std::string& path, const Job& job = {});
  /// @throws InternalError  a luminaire that belongs to no source
  LuminanceDatabase(const Zone& zone, const Cells& cells, const Lights& lights, Solution solution);

  const Zone& zone() const { return content_.zone; }
  const Bands& bands() const { return content_.bands; }
  /// How finishes reflect in each class of bands, as solved with.
  const ReflectanceClasses& classes() const { return content_.classes; }
  const std::vector<Source>& sources() const { return content_.sources; }
  /// The outside that it was made for; nothing without daylight.
  const std::optional<SkyRecord>& sky() const { return content_.sky; }
  const std::vector<ShownSpectrum>& spectra() const { return content_.spectra; }
  const std::vector<ShownLuminaire>& luminaires() const { return content_.luminaires; }
  const std::vector<ShownPhotometry>& photometry() const { return content_.photometry; }
  /// Intensity of each photometry in every direction, on a grid of 5 degrees in C and 1 in gamma.
  const std::vector<IntensityTable>& intensities() const { return content_.intensities; }
  /// Of the file's content; empty in memory.
  const std::string& hash() const { return hash_; }
  const std::string& rays_hash() const { return rays_hash_; }
  const Cells& cells() const { return content_.cells; }
  std::size_t n_cells() const { return content_.cells.size(); }
  /// Cells that also reflect by a lobe, ascending, and the grid of its patches.
  const std::vector<std::uint32_t>& off_specular_cells() const { return content_.off_specular; }
  const PatchGrid& directional_grid() const { return content_.directional_grid; }

  /// Gives a source another spectrum: no new solution is needed for it, since transfer is apart from spectra.
  /// @throws InputError  where reflectances were weighted with the light of the lamps' own spectra
  void set_spectrum(std::size_t source, const SpectralCurve& spectrum);

  /// Transfer of one source as stored: lx (lobes: cd/m2) by class, see `Solution`.
  std::vector<float> transfer(TransferPart part, std::size_t source) const;

  /// Total irradiance of all cells from one source, W/m2. [n_bands, n_cells]
  std::vector<float> cell_irradiance(std::size_t source) const;
  /// The same of direct light alone.
  std::vector<float> direct_cell_irradiance(std::size_t source) const;
  /// Radiance by lobes from one source, W/(m2 sr); of direct light alone. [n_bands, n_off_specular,
  /// n_patches]
  std::vector<float> lobe_radiance(std::size_t source) const;
  std::vector<float> direct_lobe_radiance(std::size_t source) const;
  /// Total irradiance of all measuring points from one source, W/m2. [n_bands, n_points]
  std::vector<float> point_irradiance(std::size_t source) const;

 private:
  std::vector<float> by_band(TransferPart part, std::size_t source) const;

  ResultContent content_;
  std::unique_ptr<TransferStore> light_;
  std::string hash_, rays_hash_;
};

}  // namespace dim
