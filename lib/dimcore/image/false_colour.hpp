#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "image/colour_map.hpp"
#include "image/raster.hpp"
#include "image/scale.hpp"

namespace dim {

struct FalseColourOptions {
  ScaleKind kind = ScaleKind::linear;
  /// Ends of the scale in the raster's scalar unit; each automatic where absent (automatic_scale).
  std::optional<double> low = {};
  std::optional<double> high = {};
  /// Words above the legend, for example "Illuminance"; may be empty.
  std::string title = {};
};

struct FalseColourResult {
  Picture8 picture;  ///< without the legend, same size as the raster
  Scale scale;
  std::size_t n_below = 0;  ///< pixels below the scale, shown in its first colour
  std::size_t n_above = 0;  ///< pixels above the scale, shown in its last colour
};

/// Paints the raster's scalar with colour_map on a linear or logarithmic scale; pixels that are NaN get
/// kNoValueColour. Not dithered, so that a colour can be read back.
/// @throws InputError  an impossible range
/// @throws LimitError, InternalError  see check_raster; the raster has no scalar
FalseColourResult false_colour(const Raster& raster, const FalseColourOptions& options = {});

}  // namespace dim
