#pragma once

#include <cstddef>

namespace dim {

/// Points and steps that the kernel takes together.
inline constexpr std::size_t kPointLanes = 16;
inline constexpr std::size_t kStepLanes = 4;

/// out[step, point] = sum over patches of luminance[step, patch] * coefficient[patch, point], in this order
/// and in single precision, for kStepLanes steps and kPointLanes points.
///
/// @param luminance     [kStepLanes, n_patches]
/// @param coefficients  [n_patches, kPointLanes]
/// @param out           [kStepLanes, kPointLanes]
void multiply_steps(const float* luminance, const float* coefficients, std::size_t n_patches, float* out);

}  // namespace dim
