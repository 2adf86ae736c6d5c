#pragma once

#include "import/import_input.hpp"

namespace dim {

/// Radiance scene: polygons and rings with materials `plastic metal trans glass mirror`; surfaces of `light`
/// and `glow` become Lambertian luminaires of their flux. What is not understood is named.
/// @throws InputError  also for commands (`!xform`), `instance` and `mesh`, by name: what they stand for is
/// not there
ImportedModel read_radiance(const ImportInput& input);

}  // namespace dim
