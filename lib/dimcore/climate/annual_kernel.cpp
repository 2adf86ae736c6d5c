#include "climate/annual_kernel.hpp"

#include <cstring>

#include "base/target_clones.hpp"

namespace dim {

DIM_TARGET_CLONES void multiply_steps(const float* luminance, const float* coefficients,
                                      std::size_t n_patches, float* out) {
  float sums[kStepLanes][kPointLanes] = {};
  for (std::size_t p = 0; p < n_patches; ++p) {
    const float* row = coefficients + p * kPointLanes;
    for (std::size_t step = 0; step < kStepLanes; ++step) {
      const float factor = luminance[step * n_patches + p];
      for (std::size_t point = 0; point < kPointLanes; ++point) sums[step][point] += factor * row[point];
    }
  }
  std::memcpy(out, sums, sizeof sums);
}

}  // namespace dim
