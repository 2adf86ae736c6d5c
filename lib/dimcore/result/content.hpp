#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "network/cells.hpp"
#include "photometry/intensity.hpp"
#include "scene/lights.hpp"
#include "transport/solution.hpp"

namespace dim {

/// C = 0, 5, … 360 degrees and gamma = 0, 1, … 180 degrees: fine enough for any photometric file.
inline constexpr std::size_t kShownPlanes = 73;
inline constexpr std::size_t kShownGammas = 181;

/// A luminaire as a picture needs it: where its opening is and how bright it looks.
struct ShownLuminaire {
  std::string name;
  std::size_t source = 0;  ///< index into the sources
  Vec3 at{0.0}, c0{1, 0, 0}, c90{0, 1, 0}, aim{0, 0, -1};
  LuminousOpening opening;
  std::size_t photometry = 0;  ///< index into ResultContent::photometry
  double factor = 1.0;
  bool body = false;     ///< the opening also obstructs
  int mirror_depth = 0;  ///< mirrors one after the other that the cells' direct light has images of it in
};

/// Mean intensity over C at each degree of gamma from 0 to 180, cd.
using MeanIntensity = std::vector<double>;

/// A fitting's light, before a luminaire's factor.
struct ShownPhotometry {
  std::string name;
  double flux_lm = 0.0;
  double watts = 0.0;  ///< 0 where not known
  MeanIntensity mean;
  std::vector<float> intensity_cd;  ///< [kShownPlanes, kShownGammas]
};

/// The spectrum of a source. Where nobody said it, equal energy stands in.
struct ShownSpectrum {
  SpectralCurve curve{1.0};
  bool known = false;
};

/// All of a solution but the light itself: what a luminance database holds in memory, whether it was read
/// from a file or comes from the solver.
struct ResultContent {
  Zone zone;
  Bands bands;
  ReflectanceClasses classes;
  std::vector<Source> sources;
  std::vector<ShownSpectrum> spectra;  ///< [n_sources]
  std::vector<ShownLuminaire> luminaires;
  std::vector<ShownPhotometry> photometry;
  /// Made from ShownPhotometry::intensity_cd.
  std::vector<IntensityTable> intensities;
  std::vector<std::uint32_t> off_specular;  ///< cells with a lobe, ascending
  PatchGrid directional_grid;
  Cells cells;
  std::size_t n_direct_classes = 1;
  std::optional<SkyRecord> sky;
};

/// @throws InternalError  a luminaire that belongs to no source
ResultContent content_of(const Zone& zone, const Cells& cells, const Lights& lights, const Solution& solution);

/// Intensities on the grid of directions, C slowest, as a table.
IntensityTable shown_intensity(const std::vector<float>& intensity_cd);

}  // namespace dim
