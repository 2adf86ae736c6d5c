#pragma once

#include <cstddef>

namespace dim {

/// Columns are worked on eight at a time, one SIMD operation for all eight, so that the order of every sum,
/// and so every bit, is the same whatever the machine's vector width.
inline constexpr std::size_t kColumnsPerLane = 8;

template <class Real>
struct LaneOf;
template <>
struct LaneOf<double> {
  using type = double __attribute__((vector_size(kColumnsPerLane * sizeof(double)), aligned(8)));
};
template <>
struct LaneOf<float> {
  using type = float __attribute__((vector_size(kColumnsPerLane * sizeof(float)), aligned(4)));
};
/// Eight columns of one row, wherever they stand in memory.
template <class Real>
using Lane = typename LaneOf<Real>::type;

}  // namespace dim
