#include "spectrum/lattice.hpp"

#include <algorithm>

namespace dim {
namespace {

bool is_finer_than_lattice(const SpectralCurve& curve) {
  constexpr double kRounding = 1e-6;
  const auto& points = curve.points();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const bool visible = points[i + 1].first > kVisibleLow_nm && points[i].first < kVisibleHigh_nm;
    if (visible && points[i + 1].first - points[i].first < kTableStep_nm * (1.0 - kRounding)) return true;
  }
  return false;
}

}  // namespace

LatticeValues on_lattice(const SpectralCurve& curve) {
  LatticeValues values;
  const bool fine = is_finer_than_lattice(curve);
  for (std::size_t i = 0; i < kTableSize; ++i)
    values[i] = fine ? curve.mean(cell_edge_nm(i), cell_edge_nm(i + 1)) : curve.at(lattice_nm(i));
  return values;
}

double cell_overlap_nm(std::size_t i, double low_nm, double high_nm) {
  return std::max(0.0, std::min(cell_edge_nm(i + 1), high_nm) - std::max(cell_edge_nm(i), low_nm));
}

}  // namespace dim
