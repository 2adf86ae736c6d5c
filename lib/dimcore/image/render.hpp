#pragma once

#include "base/job.hpp"
#include "image/raster.hpp"
#include "network/cells.hpp"
#include "result/luminous.hpp"

namespace dim {

enum class ScalarQuantity { illuminance, luminance };

struct RenderOptions {
  View view;
  int samples = 3;     ///< rays through each pixel: samples x samples, >= 1
  bool smooth = true;  ///< interpolate cells within a surface (never across its edge); else flat cells
  ScalarQuantity scalar = ScalarQuantity::illuminance;
  bool spectral = false;  ///< also fill Raster::radiance
};

/// A view of the zone: every pixel the mean over its rays of what they meet first, a cell or a luminaire's
/// opening. An opening shows the luminance that its mean intensity over C gives in that direction; openings
/// without area (points, lines) are not seen. Openings have no illuminance: NaN in the scalar raster.
Raster render_view(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
                   const RenderOptions& options, const Job& job);

/// XYZ of the light that is to look neutral: all sources, weighted by their flux in the mix.
Vec3 scene_white(const LuminanceDatabase& database, const Mix& mix);

}  // namespace dim
