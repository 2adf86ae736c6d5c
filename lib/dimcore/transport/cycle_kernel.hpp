#pragma once

#include <cstddef>
#include <cstdint>

namespace dim {

/// Rows [first, last) of single-precision arrays [n_cells, width] in one cycle of conjugate residuals, width a
/// multiple of eight. Names as in `ConjugateResiduals`.
struct CycleRows {
  std::size_t width, first, last;
  const std::uint32_t* surface;  ///< [n_cells]
  const float* rho;            ///< [n_surfaces, width]
  const float* area_m2;        ///< [n_cells]

  float* change;            ///< x - x at the start
  float* residual;          ///< r
  float* direction;         ///< p
  float* reduced;           ///< (1 - K R) p
  float* reduced_residual;  ///< (1 - K R) r
};

/// (1 - K R) r from what arrives of r.
/// @param arriving  [last - first, width]; @param along  [width] its products with (1 - K R) p are added to
void take_arriving(const CycleRows& rows, const double* arriving, const float* row_scale, float* along);

/// p and (1 - K R) p made conjugate to the last ones. @param back  [width] how much of those is taken off
/// @param sums  [3, width] squares of (1 - K R) p, its products with r, and squares of r are added to
void turn(const CycleRows& rows, const float* back, float* sums);

/// A step [width] along p. @param start, floor  [n_cells, width], [width]: what residuals are measured by
/// @param exitance  [n_cells, width] of the new residuals; @param worst  [width]
void go(const CycleRows& rows, const float* step, const float* start, const float* floor,
        const float* column_scale, float* exitance, float* worst);

}  // namespace dim
