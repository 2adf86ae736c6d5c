#include "transport/cycle_kernel.hpp"

#include "base/target_clones.hpp"
#include "transport/lanes.hpp"

namespace dim {
namespace {

using Eight = Lane<float>;

DIM_INLINE const Eight& eight(const float* at) { return *reinterpret_cast<const Eight*>(at); }
DIM_INLINE Eight& eight(float* at) { return *reinterpret_cast<Eight*>(at); }
DIM_INLINE void make_positive(Eight& x) { x = x < 0.0F ? -x : x; }
DIM_INLINE void raise(Eight& x, const Eight& least) { x = x < least ? least : x; }

// Calls f(place in a [n_cells, width] array, column, weight of the inner product) for eight columns at a time.
template <class F>
DIM_INLINE void for_lanes(const CycleRows& rows, F&& f) {
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    const float* rho = rows.rho + rows.surface[i] * rows.width;
    for (std::size_t c = 0; c < rows.width; c += kColumnsPerLane)
      f(i, i * rows.width + c, c, eight(rho + c));
  }
}

}  // namespace

DIM_TARGET_CLONES void take_arriving(const CycleRows& rows, const double* arriving, const float* row_scale,
                                     float* along) {
  for_lanes(rows, [&](std::size_t i, std::size_t at, std::size_t c, const Eight& rho) __attribute__((always_inline)) {
    const auto from = __builtin_convertvector(
        *reinterpret_cast<const Lane<double>*>(arriving + (at - rows.first * rows.width)), Eight);
    const Eight reduced = eight(rows.residual + at) - row_scale[i] * from;
    eight(rows.reduced_residual + at) = reduced;
    eight(along + c) += rows.area_m2[i] * rho * reduced * eight(rows.reduced + at);
  });
}

DIM_TARGET_CLONES void turn(const CycleRows& rows, const float* back, float* sums) {
  for_lanes(rows, [&](std::size_t i, std::size_t at, std::size_t c, const Eight& rho) __attribute__((always_inline)) {
    const Eight residual = eight(rows.residual + at);
    const Eight reduced = eight(rows.reduced_residual + at) - eight(back + c) * eight(rows.reduced + at);
    eight(rows.direction + at) = residual - eight(back + c) * eight(rows.direction + at);
    eight(rows.reduced + at) = reduced;
    const Eight weighted = rows.area_m2[i] * rho * reduced;
    eight(sums + c) += weighted * reduced;
    eight(sums + rows.width + c) += weighted * residual;
    eight(sums + 2 * rows.width + c) += rows.area_m2[i] * rho * residual * residual;
  });
}

DIM_TARGET_CLONES void go(const CycleRows& rows, const float* step, const float* start, const float* floor,
                          const float* column_scale, float* exitance, float* worst) {
  for_lanes(rows, [&](std::size_t i, std::size_t at, std::size_t c, const Eight& rho) __attribute__((always_inline)) {
    const Eight change = eight(rows.change + at) + eight(step + c) * eight(rows.direction + at);
    const Eight residual = eight(rows.residual + at) - eight(step + c) * eight(rows.reduced + at);
    eight(rows.change + at) = change;
    eight(rows.residual + at) = residual;
    eight(exitance + at) = column_scale[i] * rho * residual;
    Eight local = residual, value = eight(start + at) + change;
    make_positive(local);
    make_positive(value);
    raise(value, eight(floor + c));
    local = rho > 0.0F ? local / value : Eight{};
    raise(eight(worst + c), local);
  });
}

}  // namespace dim
