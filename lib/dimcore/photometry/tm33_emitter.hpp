#pragma once

#include <optional>

#include "photometry/photometry.hpp"
#include "photometry/xml_document.hpp"

namespace dim {

/// One Emitter of a TM-33 file.
struct Tm33Emitter {
  LampSet lamps;         ///< quantity, description, rated lumens of all, colour, rendering, watts
  bool absolute = true;  ///< absolute photometry: rated lumens are not what the intensities refer to
  double factor = 1.0;   ///< multiplier and ballast factor, applied
  IntensityDistribution distribution;
  Symmetry symmetry = Symmetry::kAxial;
  double flux_lm = 0.0;
  std::optional<double> declared_flux_lm;
  std::optional<SpectralCurve> spectrum;
};

/// @throws InputError  see read_tm33
Tm33Emitter read_tm33_emitter(const XmlDocument& xml, pugi::xml_node emitter, Warnings& warnings);

}  // namespace dim
