#pragma once

#include <string>
#include <vector>

#include "database/fitting_entry.hpp"
#include "spectrum/curve.hpp"

namespace dim {

/// Text as a TOML basic string, in quotes.
std::string toml_quoted(const std::string& text);

/// A curve as a TOML value: a number where it is the same everywhere, else [[nm, value], ...]; nine
/// significant digits.
std::string toml_curve(const SpectralCurve& curve);

/// The TOML of a fitting entry; `entry.file` is written as it is.
std::string fitting_entry_text(const FittingEntry& entry);

/// What a new surface entry says.
struct SurfaceDraft {
  std::string title, source, licence, note;
  bool glazing = false;
  SpectralCurve diffuse;        ///< opaque
  SpectralCurve transmittance;  ///< glazing
  SpectralCurve reflectance;    ///< glazing
};

/// The TOML of a surface entry.
std::string surface_entry_text(const SurfaceDraft& draft);

}  // namespace dim
