#pragma once

#include <string>
#include <vector>

#include "base/hdf5_file.hpp"
#include "base/job.hpp"
#include "photometry/opening.hpp"
#include "scene/zone.hpp"
#include "transport/simulate.hpp"

namespace dim {

inline constexpr int kLumVersion = 1;

/// A luminaire as a picture needs it: where its opening is and how bright it looks.
struct ShownLuminaire {
  std::string name;
  std::size_t source = 0;  ///< index into the sources
  Vec3 at{0.0}, c0{1, 0, 0}, c90{0, 1, 0}, aim{0, 0, -1};
  LuminousOpening opening;
  std::size_t photometry = 0;  ///< index into LuminanceDatabase::photometry
  double factor = 1.0;
  bool body = false;     ///< the opening also obstructs
  int mirror_depth = 0;  ///< mirrors one after the other that the cells' direct light has images of it in
};

/// Mean intensity over C at each degree of gamma from 0 to 180, cd.
using MeanIntensity = std::vector<double>;

/// Writes a luminance database (`.lum`), whole or not at all; `-` is standard output. Layout:
/// docs/formats.md.
/// @param rays_hash  of the network the solution was made on
/// @returns the content's hash
/// @throws IoError, Interrupted
std::string save_lum(const std::string& path, const Zone& zone, const Cells& cells, const Lights& lights,
                     const Solution& solution, const std::string& rays_hash, const Job& job = {});

/// An opened luminance database. What is small is read at once, irradiances as asked for.
class LuminanceDatabase {
 public:
  /// @throws IoError  missing, damaged, foreign or newer file
  explicit LuminanceDatabase(const std::string& path, const Job& job = {});

  const Zone& zone() const { return zone_; }
  const Bands& bands() const { return bands_; }
  const std::vector<Source>& sources() const { return sources_; }
  const std::vector<ShownLuminaire>& luminaires() const { return luminaires_; }
  const std::vector<MeanIntensity>& photometry() const { return photometry_; }
  /// Relative spectra of the sources, in their order; empty in files of programs that did not store them.
  const std::vector<SpectralCurve>& spectra() const { return spectra_; }
  /// Intensity of each photometry in every direction, on a grid of 5 degrees in C and 1 in gamma.
  const std::vector<IntensityTable>& intensities() const { return intensities_; }
  const std::string& hash() const { return file_.hash(); }
  const std::string& rays_hash() const { return rays_hash_; }
  std::size_t n_cells() const { return n_cells_; }

  /// Total irradiance of all cells from one source, W/m2. [n_bands, n_cells]
  std::vector<float> cell_irradiance(std::size_t source) const;
  /// The same of direct light alone.
  std::vector<float> direct_cell_irradiance(std::size_t source) const;
  /// Cells that also reflect by a lobe, ascending, and the grid of its patches.
  const std::vector<std::uint32_t>& off_specular_cells() const { return off_specular_; }
  const PatchGrid& directional_grid() const { return directional_grid_; }
  /// Radiance by lobes from one source, W/(m2 sr); of direct light alone. [n_bands, n_off_specular,
  /// n_patches]
  std::vector<float> lobe_radiance(std::size_t source) const;
  std::vector<float> direct_lobe_radiance(std::size_t source) const;
  /// Total irradiance of all measuring points from one source, W/m2. [n_bands, n_points]
  std::vector<float> point_irradiance(std::size_t source) const;

 private:
  void load_directional();
  std::vector<float> directional(const std::string& dataset, std::size_t source) const;
  std::vector<float> of_source(const std::string& dataset, std::size_t source, std::size_t n) const;

  std::string path_;
  Hdf5Reader file_;
  Zone zone_;
  Bands bands_;
  std::vector<Source> sources_;
  std::vector<ShownLuminaire> luminaires_;
  std::vector<MeanIntensity> photometry_;
  std::vector<IntensityTable> intensities_;
  std::vector<std::uint32_t> off_specular_;
  PatchGrid directional_grid_;
  std::vector<SpectralCurve> spectra_;
  std::string rays_hash_;
  std::size_t n_cells_ = 0;
};

}  // namespace dim
