#pragma once

#include <optional>

#include "import/imported_model.hpp"
#include "import/radiance_tokens.hpp"

namespace dim {

/// The finish that a Radiance material is, by Radiance's weights of red, green and blue (0.265, 0.670,
/// 0.065): `plastic` and `metal` have their diffuse colour, specularity and roughness, `trans` scatters,
/// `glass` has the transmittance at normal incidence that its transmissivity gives at its index, `light` and
/// `glow` a luminance at 179 lm/W. Nothing for other types.
/// @throws InputError  too few numbers, or values below 0
std::optional<ImportedMaterial> radiance_material(const RadiancePrimitive& primitive);

}  // namespace dim
