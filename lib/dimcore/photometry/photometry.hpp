#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "photometry/intensity.hpp"
#include "photometry/opening.hpp"
#include "spectrum/curve.hpp"

namespace dim {

/// Which planes a photometric file lists; the rest follow by reflection.
enum class Symmetry {
  kAxial,            ///< one plane for all
  kQuadrilateral,    ///< C 0-90, reflected in both principal planes
  kBilateral0_180,   ///< C 0-180, reflected in the plane C0-C180
  kBilateral90_270,  ///< C 90-270, reflected in the plane C90-C270
  kNone,             ///< the whole turn; types A and B: every plane listed
  kLateral           ///< types A and B: H 0-90, reflected in the plane H = 0
};

/// "axial", "quadrilateral", "bilateral 0-180", "bilateral 90-270", "none", "symmetric 0-90"
const char* symmetry_name(Symmetry symmetry);

/// How lamp output changes when the luminaire is tilted from the position it was measured in (LM-63 TILT).
struct LampTilt {
  int geometry = 1;               ///< 1 lamp vertical, 2 horizontal and staying so, 3 horizontal and tilting
  std::vector<double> angle_rad;  ///< ascending, between the aim and straight down
  std::vector<double> factor;
};

/// The factor on the luminaire's intensities for an angle between its aim and straight down: linear between
/// the table's angles, constant beyond them. A table that ends at 90 degrees or below serves angles above 90
/// by reflection (a lamp base up or down), as LM-63 has it.
/// @param tilt_rad  0..pi
double tilt_factor(const LampTilt& tilt, double tilt_rad);

/// One of the sets of lamps that an EULUMDAT file gives for a luminaire, or an emitter of a TM-33 file.
struct LampSet {
  int n_lamps = 1;  ///< of the set
  std::string type;
  double flux_lm = 0.0;  ///< of the whole set
  std::string colour;    ///< colour appearance or temperature, as in the file
  std::string rendering;
  double watts = 0.0;  ///< of the set with its ballast; 0 where not said
};

/// A luminaire as its photometric file describes it.
struct Photometry {
  IntensityDistribution distribution;  ///< all the file's factors applied
  LuminousOpening opening;
  Symmetry symmetry = Symmetry::kAxial;

  std::string format;      ///< "LM-63-2002", "EULUMDAT", "TM-33-18"
  std::string identifier;  ///< LM-63: first line of the file; empty where it has none (1986) and in EULUMDAT
  int format_year = 1986;  ///< LM-63: 1986, 1991, 1995, 2002 or 2019, the rules it was read by; else 0
  /// In the file's order; keywords in capitals without brackets, continuation lines joined by a blank, text
  /// in UTF-8. A label line of LM-63-1986 has an empty keyword.
  std::vector<std::pair<std::string, std::string>> keywords;

  int n_lamps = 1;
  std::optional<double> lumens_per_lamp;  ///< absent: absolute photometry (-1 in the file)
  double multiplier = 1.0;
  double ballast_factor = 1.0;
  double ballast_lamp_factor = 1.0;       ///< only LM-63-1986 and 1991 have one
  std::optional<double> file_generation;  ///< LM-63-2019: how the data were made, 1.0 to 1.9; not a factor
  std::optional<double> watts;
  std::optional<LampTilt> tilt;  ///< of LM-63; the distribution is that of the measured position
  /// Of EULUMDAT, where the distribution is that of the first; of TM-33, where it is that of all together.
  std::vector<LampSet> lamp_sets;
  std::optional<SpectralCurve> spectrum;  ///< relative; of TM-33

  double flux_lm = 0.0;  ///< integral of `distribution`
  double max_cd = 0.0;
  std::optional<double> declared_lamp_flux_lm;  ///< n_lamps x lumens_per_lamp, relative photometry only
  std::optional<double> declared_flux_lm;       ///< of the luminaire, where a keyword states it

  /// Value of the first keyword of this name (capitals, no brackets), or empty.
  std::string keyword(const std::string& name) const;
};

}  // namespace dim
