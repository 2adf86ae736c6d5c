#pragma once

#include "base/job.hpp"
#include "image/raster.hpp"
#include "image/shader.hpp"
#include "network/cells.hpp"
#include "result/luminous.hpp"

namespace dim {

enum class ScalarQuantity { illuminance, luminance };

struct RenderOptions {
  View view;
  int samples = 3;  ///< rays through each pixel: samples x samples, >= 1
  Shading shading = Shading::smooth;
  ScalarQuantity scalar = ScalarQuantity::illuminance;
  bool spectral = false;  ///< also fill Raster::radiance
};

/// A view of the zone: every pixel the mean over its rays of what they met, see `Shader`. Openings without
/// area (points, lines) are not seen. Openings have no illuminance: NaN in the scalar raster, as outside the circle of a
/// round view, which is black.
/// @throws LimitError   before any work, when the picture does not fit job.memory_limit_bytes
/// @throws Interrupted
Raster render_view(const LuminanceDatabase& database, const Cells& cells, const Mix& mix,
                   const RenderOptions& options, const Job& job);

/// XYZ of the light that is to look neutral: all sources, weighted by their flux in the mix.
Vec3 scene_white(const LuminanceDatabase& database, const Mix& mix);

}  // namespace dim
